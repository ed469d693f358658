//! Many points: each instruction is done for 128 of them before the next one.
//!
//! So the cost of reading an instruction vanishes, the loop over the points becomes vector code, and the registers stay in the
//! nearest cache. The register of a result is never that of an operand, so that the compiler knows that they do not overlap.

use super::bulk_noise::noise_values;
use super::point::settled;
use super::{Instruction, Program, Tape};
use crate::operation::{Operation, VisitBinary, VisitSlopes, VisitUnary, binary, select, unary, whole_power};
use crate::simd::{Level, Task, dispatch};

/// Points that are evaluated together: enough to hide the cost of an instruction, few enough for fifty registers in the cache.
pub(super) const LANES: usize = 128;

/// Lanes are taken in groups: the width of the widest vector.
const WIDTH: usize = 8;

pub(super) type Register = [f64; LANES];

impl Tape {
    /// The first output at many points. `inputs` has one list for each variable, with one number for each point.
    ///
    /// # Panics
    ///
    /// If there is not one list for each input, or a list is not as long as the result.
    pub fn evaluate(&self, inputs: &[&[f64]], values: &mut [f64]) {
        self.evaluator().evaluate(inputs, values);
    }

    /// The first output at many points, and its derivatives by the first inputs, one list each.
    ///
    /// ```
    /// let variables = ["x", "y"];
    /// let product = luch_formula::parse("x * y", &variables).unwrap();
    /// let tape = luch_formula::Tape::new(&product, &variables).unwrap();
    /// let (mut values, mut by_x, mut by_y) = ([0.0; 2], [0.0; 2], [0.0; 2]);
    /// tape.gradients(&[&[1.0, 2.0], &[3.0, 4.0]], &mut values, &mut [&mut by_x, &mut by_y]);
    /// assert_eq!((values, by_x, by_y), ([3.0, 8.0], [3.0, 4.0], [1.0, 2.0]));
    /// ```
    ///
    /// # Panics
    ///
    /// If there is not one list for each input, there are more derivatives than inputs, or lengths differ.
    pub fn gradients(&self, inputs: &[&[f64]], values: &mut [f64], derivatives: &mut [&mut [f64]]) {
        self.evaluator().gradients(inputs, values, derivatives);
    }

    /// Room for evaluations: make one and keep it where there are many small ones.
    pub fn evaluator(&self) -> Evaluator<'_> {
        self.evaluator_at(Level::Avx512)
    }

    /// The same with vector instructions of some level at most. Changes how long it takes, never a result.
    pub fn evaluator_at(&self, level: Level) -> Evaluator<'_> {
        let program = &*self.program;
        let mut registers = vec![[0.0; LANES]; program.registers];
        for (register, &constant) in registers[program.inputs..].iter_mut().zip(&program.constants) {
            *register = [constant; LANES];
        }
        Evaluator { tape: self, level, registers, slopes: Vec::new() }
    }
}

/// A tape with room for evaluations at many points.
#[derive(Clone, Debug)]
pub struct Evaluator<'t> {
    pub(super) tape: &'t Tape,
    pub(super) level: Level,
    pub(super) registers: Vec<Register>,
    /// The derivatives of all registers by the first input, then by the second.
    pub(super) slopes: Vec<Register>,
}

impl Evaluator<'_> {
    /// As [`Tape::evaluate`].
    ///
    /// # Panics
    ///
    /// As there.
    pub fn evaluate(&mut self, inputs: &[&[f64]], values: &mut [f64]) {
        self.evaluate_many(inputs, &mut [values]);
    }

    /// The first outputs at many points, one list each, as many as there are lists.
    ///
    /// # Panics
    ///
    /// If there is not one list for each input, there are more lists than outputs, or lengths differ.
    pub fn evaluate_many(&mut self, inputs: &[&[f64]], values: &mut [&mut [f64]]) {
        let length = values.first().map_or(0, |list| list.len());
        self.check(inputs, length);
        assert!(values.iter().all(|list| list.len() == length), "one number for each point");
        assert!(values.len() <= self.tape.outputs(), "a tape gives no more than its outputs");
        let program = &*self.tape.program;
        dispatch(
            self.level,
            Values { program, registers: &mut self.registers, inputs, outputs: values, length },
        );
    }

    pub(super) fn check(&self, inputs: &[&[f64]], length: usize) {
        self.tape.check_inputs(inputs.len());
        assert!(inputs.iter().all(|list| list.len() == length), "one number for each point");
    }
}

struct Values<'a, 'o> {
    program: &'a Program,
    registers: &'a mut [Register],
    inputs: &'a [&'a [f64]],
    outputs: &'a mut [&'o mut [f64]],
    length: usize,
}

impl Task for Values<'_, '_> {
    #[inline(always)]
    fn run(self) {
        for start in (0..self.length).step_by(LANES) {
            let count = LANES.min(self.length - start);
            load(self.program, self.inputs, self.registers, start, count);
            for Instruction { out, operation, .. } in &self.program.instructions {
                let (out, others) = apart(self.registers, *out);
                compute(operation, &others, &mut out[..in_groups(count)]);
            }
            for (output, &register) in self.outputs.iter_mut().zip(&self.program.output_registers) {
                store(&self.registers[register as usize], &mut output[start..start + count]);
            }
        }
    }
}

/// The lanes that are computed for some points.
#[inline(always)]
pub(super) fn in_groups(count: usize) -> usize {
    count.next_multiple_of(WIDTH).min(LANES)
}

/// Puts points into the registers of the inputs that are used; a last group that is not full repeats its last point.
#[inline(always)]
pub(super) fn load(
    program: &Program,
    inputs: &[&[f64]],
    registers: &mut [Register],
    start: usize,
    count: usize,
) {
    for &input in &program.used_inputs {
        let register = &mut registers[input as usize];
        let values = &inputs[input as usize][start..start + count];
        register[..count].copy_from_slice(values);
        register[count..in_groups(count)].fill(values[count - 1]);
    }
}

#[inline(always)]
pub(super) fn store(register: &Register, output: &mut [f64]) {
    for (output, &value) in output.iter_mut().zip(register) {
        *output = settled(value);
    }
}

/// All registers but one.
pub(super) struct Others<'r> {
    before: &'r [Register],
    after: &'r [Register],
}

impl Others<'_> {
    #[inline(always)]
    pub(super) fn of(&self, register: u32) -> &Register {
        let register = register as usize;
        match register.checked_sub(self.before.len() + 1) {
            None => &self.before[register],
            Some(register) => &self.after[register],
        }
    }
}

/// Takes one register out, to be written.
#[inline(always)]
pub(super) fn apart(registers: &mut [Register], out: u32) -> (&mut Register, Others<'_>) {
    let (before, rest) = registers.split_at_mut(out as usize);
    let (out, after) = rest.split_first_mut().expect("instructions write to registers of the tape");
    (out, Others { before, after })
}

/// One operation for as many lanes as the result has.
#[inline(always)]
pub(super) fn compute(operation: &Operation, registers: &Others<'_>, out: &mut [f64]) {
    let of = |register: u32| registers.of(register);
    match *operation {
        Operation::Unary { function, a } => unary(function, Lanes { operands: [of(a)], out }),
        Operation::Binary { function, a, b } => binary(function, Lanes { operands: [of(a), of(b)], out }),
        Operation::WholePower { base, exponent } => {
            let lanes = Lanes { operands: [of(base)], out };
            // Small exponents are compiled on their own.
            match exponent {
                2 => VisitUnary::visit(lanes, |x| whole_power(x, 2)),
                3 => VisitUnary::visit(lanes, |x| whole_power(x, 3)),
                4 => VisitUnary::visit(lanes, |x| whole_power(x, 4)),
                _ => whole_powers(of(base), exponent, lanes.out),
            }
        }
        Operation::Select { condition, yes, no } => {
            let (condition, yes, no) = (of(condition), of(yes), of(no));
            for (lane, out) in out.iter_mut().enumerate() {
                *out = select(condition[lane], yes[lane], no[lane]);
            }
        }
        Operation::Noise { x, y, z } => noise_values([of(x), of(y), of(z)], out),
    }
}

/// As [`whole_power`], with all lanes in every product.
#[inline(always)]
pub(super) fn whole_powers(base: &Register, exponent: u8, out: &mut [f64]) {
    let mut square = *base;
    let mut rest = exponent;
    let mut is_first = true;
    loop {
        if rest & 1 == 1 {
            for (out, &square) in out.iter_mut().zip(&square) {
                *out = if is_first { square } else { *out * square };
            }
            is_first = false;
        }
        rest >>= 1;
        if rest == 0 {
            return;
        }
        for square in &mut square {
            *square *= *square;
        }
    }
}

/// Applies a function to all lanes of its operands.
pub(super) struct Lanes<'a, const N: usize> {
    pub(super) operands: [&'a Register; N],
    pub(super) out: &'a mut [f64],
}

impl VisitUnary for Lanes<'_, 1> {
    type Output = ();
    #[inline(always)]
    fn visit(self, function: impl Fn(f64) -> f64) {
        let [x] = self.operands;
        for (&x, out) in x.iter().zip(self.out) {
            *out = function(x);
        }
    }
}

impl VisitBinary for Lanes<'_, 2> {
    type Output = ();
    #[inline(always)]
    fn visit(self, function: impl Fn(f64, f64) -> f64) {
        let [x, y] = self.operands;
        for ((&x, &y), out) in x.iter().zip(y).zip(self.out) {
            *out = function(x, y);
        }
    }
}

/// Computes two slopes from two operands and the value.
pub(super) struct SlopeLanes<'a> {
    pub(super) operands: [&'a Register; 3],
    pub(super) first: &'a mut [f64],
    pub(super) second: &'a mut [f64],
}

impl VisitSlopes for SlopeLanes<'_> {
    type Output = ();
    #[inline(always)]
    fn visit(self, slopes: impl Fn(f64, f64, f64) -> [f64; 2]) {
        let [x, y, value] = self.operands;
        for (lane, (first, second)) in self.first.iter_mut().zip(self.second).enumerate() {
            [*first, *second] = slopes(x[lane], y[lane], value[lane]);
        }
    }
}
