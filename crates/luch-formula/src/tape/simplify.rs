//! Shorter tapes for parts of space.
//!
//! Where one side of a minimum, a maximum or a choice is always taken, the other need not be computed (Keeter 2020, "Massively
//! parallel rendering of complex closed-form implicit surfaces").

use super::Tape;
use crate::interval::Interval;
use crate::operation::{Binary, Operation};

/// Which side a step takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Choice {
    Open,
    First,
    Second,
}

/// What the ranges of one evaluation decide.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Choices {
    /// One a step.
    pub(super) taken: Vec<Choice>,
}

impl Choices {
    /// How many steps are decided. If none, the simplified tape is the tape.
    pub fn decided(&self) -> usize {
        self.taken.iter().filter(|choice| **choice != Choice::Open).count()
    }
}

/// The range of the first output over a box, and what is decided there.
#[derive(Clone, Debug, PartialEq)]
pub struct Traced {
    /// The range of the first output.
    pub value: Interval,
    /// What to give to [`Tape::simplify`].
    pub choices: Choices,
}

/// Which operand a step passes on, bit for bit, everywhere in the box.
pub(super) fn choice(operation: &Operation, of: impl Fn(u32) -> Interval) -> Choice {
    match *operation {
        Operation::Binary { function: Binary::Minimum, a, b } => between(of(a), of(b)),
        Operation::Binary { function: Binary::Maximum, a, b } => {
            let negative = |range: Interval| Interval { low: -range.high, high: -range.low, ..range };
            between(negative(of(a)), negative(of(b)))
        }
        Operation::Select { condition, .. } => match of(condition).truth() {
            Some(true) => Choice::First,
            Some(false) => Choice::Second,
            None => Choice::Open,
        },
        _ => Choice::Open,
    }
}

/// Of a minimum. Of equals the second is taken; where one is undefined the other is.
fn between(a: Interval, b: Interval) -> Choice {
    if b.is_empty() || (a.high < b.low && !a.partial) {
        Choice::First
    } else if a.is_empty() || (b.high <= a.low && !b.partial) {
        Choice::Second
    } else {
        Choice::Open
    }
}

impl Tape {
    /// A tape without what is decided. It has the same inputs and outputs, and gives the same bits at every point of the box
    /// the choices come from.
    ///
    /// # Panics
    ///
    /// If the choices were made by a tape of another length.
    pub fn simplify(&self, choices: &Choices) -> Self {
        let program = &*self.program;
        assert_eq!(choices.taken.len(), program.operations.len(), "choices of this tape");
        if choices.decided() == 0 {
            return self.clone();
        }
        let fixed = program.inputs + program.constants.len();
        // What stands for a step: itself, or the operand it passes on.
        let mut stands: Vec<u32> = (0..(fixed + program.operations.len()) as u32).collect();
        let mut operations = program.operations.clone();
        for (moment, operation) in operations.iter_mut().enumerate() {
            *operation = operation.with_operands(|operand| stands[operand as usize]);
            let [first, second, third] = operation.operands();
            let sides =
                if matches!(operation, Operation::Select { .. }) { [second, third] } else { [first, second] };
            match choices.taken[moment] {
                Choice::Open => {}
                Choice::First => stands[fixed + moment] = sides[0],
                Choice::Second => stands[fixed + moment] = sides[1],
            }
        }
        let outputs = program.outputs.iter().map(|&output| stands[output as usize]).collect();
        Self::assemble(program.inputs, program.constants.clone(), operations, outputs)
    }
}
