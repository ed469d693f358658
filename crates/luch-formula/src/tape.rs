//! An expression made ready to be evaluated: a list of instructions on registers.
//!
//! Registers hold the inputs first, then the constants, then what is computed; a register is taken again when its number has
//! been used for the last time, so that the working set stays small. The same list serves numbers, derivatives and ranges.

mod along;
mod build;
mod bulk;
mod bulk_gradient;
mod bulk_noise;
mod enclose;
mod point;
mod simplify;

pub(crate) use along::{Along, MOST_COEFFICIENTS, Polynomial};
pub use bulk::Evaluator;
pub use simplify::{Choices, Traced};

use crate::operation::Operation;
use std::sync::{Arc, OnceLock};

/// A compiled calculation: some numbers from an ordered list of inputs.
///
/// Every way of evaluating gives the same bits, on every machine; undefined results are all the same not-a-number.
///
/// ```
/// use luch_formula::{Interval, Tape, parse};
///
/// let variables = ["x", "y", "z"];
/// let heart = parse("(x^2+9/4*y^2+z^2-1)^3 - x^2*z^3 - 9/80*y^2*z^3", &variables).unwrap();
/// let tape = Tape::new(&heart, &variables).unwrap();
/// assert_eq!(tape.value(&[0.0, 0.0, 0.0]), -1.0);
///
/// // Many points, one list a variable.
/// let mut values = [0.0; 3];
/// tape.evaluate(&[&[0.0, 1.0, 2.0], &[0.0; 3], &[0.0; 3]], &mut values);
/// assert_eq!(values, [-1.0, 0.0, 27.0]);
///
/// // The derivatives.
/// let mut gradient = [0.0; 3];
/// tape.gradient(&[2.0, 0.0, 0.0], &mut gradient);
/// assert_eq!(gradient, [108.0, 0.0, 0.0]);
///
/// // Far from the origin there is no surface.
/// let far = tape.interval(&[Interval::new(2.0, 3.0), Interval::new(0.0, 1.0), Interval::new(-1.0, 1.0)]);
/// assert!(far.low > 0.0);
/// ```
#[derive(Clone, Debug)]
pub struct Tape {
    program: Arc<Program>,
}

/// What a tape is made of.
#[derive(Debug)]
struct Program {
    inputs: usize,
    constants: Vec<f64>,
    /// With the numbers of steps: inputs, constants, then these.
    operations: Vec<Operation>,
    /// The steps that are results.
    outputs: Vec<u32>,
    /// The inputs that the outputs depend on.
    used_inputs: Vec<u32>,
    /// The operations with registers; the result's is none of the operands'.
    instructions: Vec<Instruction>,
    output_registers: Vec<u32>,
    registers: usize,
    /// Made when it is asked for; none if the first output is no polynomial.
    along: OnceLock<Option<Along>>,
}

/// An operation on registers.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Instruction {
    out: u32,
    operation: Operation,
    /// The inputs on which each operand depends, one bit each.
    depends: [Dependence; 3],
}

/// A set of inputs, one bit each; the last bit stands for all from the 64th on.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Dependence(u64);

impl Dependence {
    fn on(input: usize) -> Self {
        Self(1 << input.min(63))
    }

    fn includes(self, input: usize) -> bool {
        self.0 & Self::on(input).0 != 0
    }
}

/// An expression uses a variable that the list lacks, or the list is longer than a tape can take.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum TapeError {
    /// A variable of the expression that is not in the list.
    #[error("the formula depends on `{name}`, which is not among the inputs {inputs}")]
    MissingInput {
        /// The variable.
        name: String,
        /// The inputs, separated by commas.
        inputs: String,
    },
    /// No expression was given.
    #[error("a tape needs at least one expression")]
    NoOutput,
}

impl Tape {
    /// How many inputs it takes.
    pub fn inputs(&self) -> usize {
        self.program.inputs
    }

    /// How many numbers it gives.
    pub fn outputs(&self) -> usize {
        self.program.outputs.len()
    }

    /// How many operations one evaluation takes.
    pub fn operations(&self) -> usize {
        self.program.operations.len()
    }

    /// How many numbers are held at once.
    pub fn registers(&self) -> usize {
        self.program.registers
    }

    fn check_inputs(&self, given: usize) {
        assert_eq!(given, self.program.inputs, "one input for each variable of the tape");
    }
}

impl PartialEq for Tape {
    fn eq(&self, other: &Self) -> bool {
        // All else follows from these.
        let (a, b) = (&*self.program, &*other.program);
        a.inputs == b.inputs
            && a.constants == b.constants
            && a.operations == b.operations
            && a.outputs == b.outputs
    }
}
