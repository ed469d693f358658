//! A calculation along a piece of a line, as a polynomial with a bound of its error.
//!
//! The piece is mapped to s from −1 to 1. A number of the calculation is Σ cᵢ sⁱ, and the true values as well as those that the
//! evaluators compute lie within the error of it, wherever on the piece. What coefficients lose by rounding goes into the error,
//! and so does the rounding of the evaluators: half a unit of the last place an operation, as everywhere in this crate counted
//! as one.

use super::{Instruction, Program, Tape};
use crate::operation::{Binary, Operation, Unary};

/// The greatest degree of a calculation that is followed.
const GREATEST_DEGREE: usize = 16;

/// The coefficients of such a one.
pub(crate) const MOST_COEFFICIENTS: usize = GREATEST_DEGREE + 1;

/// More room than this, in numbers, is not taken.
const MOST_ROOM: usize = 4096;

/// One more than any sum of rounding errors of up to some dozen operations.
const SLACK: f64 = 1.0 + 32.0 * f64::EPSILON;

/// A calculation that is a polynomial of its inputs: sums, products, powers, quotients by constants.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Along {
    constants: Vec<f64>,
    first_constant: usize,
    steps: Vec<Step>,
    output: Block,
    room: usize,
    /// Bernstein coefficients over −1 to 1 of the powers of s, a row for each coefficient.
    to_bernstein: Vec<f64>,
}

/// Where a polynomial lies: the sum of the sizes of its coefficients, its error, then the coefficients.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Block {
    start: usize,
    degree: usize,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Step {
    function: Function,
    a: Block,
    b: Block,
    out: Block,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Function {
    Negate,
    Add,
    Subtract,
    Multiply,
    /// By a constant.
    Divide,
}

/// Blocks in the making.
#[derive(Default)]
struct Layout {
    steps: Vec<Step>,
    room: usize,
}

impl Layout {
    fn block(&mut self, degree: usize) -> Option<Block> {
        let start = self.room;
        self.room += degree + 3;
        (degree <= GREATEST_DEGREE && self.room <= MOST_ROOM).then_some(Block { start, degree })
    }

    fn step(&mut self, function: Function, a: Block, b: Block) -> Option<Block> {
        let out = self.block(match function {
            Function::Multiply => a.degree + b.degree,
            _ => a.degree.max(b.degree),
        })?;
        self.steps.push(Step { function, a, b, out });
        Some(out)
    }

    /// In the order of the evaluators.
    fn whole_power(&mut self, base: Block, exponent: u8) -> Option<Block> {
        let (mut square, mut rest, mut power) = (base, exponent, None);
        while rest != 0 {
            if rest & 1 == 1 {
                power = Some(match power {
                    Some(power) => self.step(Function::Multiply, power, square)?,
                    None => square,
                });
            }
            rest >>= 1;
            if rest != 0 {
                square = self.step(Function::Multiply, square, square)?;
            }
        }
        power
    }
}

impl Along {
    /// None if the first output is no polynomial, or one of too high a degree.
    fn new(program: &Program) -> Option<Self> {
        let Program { inputs, ref constants, ref instructions, registers, ref output_registers, .. } =
            *program;
        let mut layout = Layout::default();
        let mut blocks = Vec::with_capacity(registers);
        for _ in 0..inputs {
            blocks.push(layout.block(1)?);
        }
        let first_constant = layout.room;
        for constant in constants {
            if !constant.is_finite() {
                return None;
            }
            blocks.push(layout.block(0)?);
        }
        let fixed = blocks.len();
        blocks.resize(registers, Block { start: 0, degree: 0 });
        for Instruction { out, operation, .. } in instructions {
            let of = |register: u32| blocks[register as usize];
            let block = match *operation {
                Operation::Unary { function: Unary::Negate, a } => {
                    layout.step(Function::Negate, of(a), of(a))?
                }
                Operation::Binary { function: Binary::Add, a, b } => {
                    layout.step(Function::Add, of(a), of(b))?
                }
                Operation::Binary { function: Binary::Subtract, a, b } => {
                    layout.step(Function::Subtract, of(a), of(b))?
                }
                Operation::Binary { function: Binary::Multiply, a, b } => {
                    layout.step(Function::Multiply, of(a), of(b))?
                }
                Operation::Binary { function: Binary::Divide, a, b }
                    if (inputs..fixed).contains(&(b as usize)) && constants[b as usize - inputs] != 0.0 =>
                {
                    layout.step(Function::Divide, of(a), of(b))?
                }
                Operation::WholePower { base, exponent } => layout.whole_power(of(base), exponent)?,
                _ => return None,
            };
            blocks[*out as usize] = block;
        }
        let output = blocks[output_registers[0] as usize];
        Some(Self {
            constants: constants.clone(),
            first_constant,
            steps: layout.steps,
            output,
            room: layout.room,
            to_bernstein: powers_in_bernstein_form(output.degree),
        })
    }

    /// How many numbers [`polynomial`](Self::polynomial) needs to work with.
    pub(crate) fn room(&self) -> usize {
        self.room
    }

    /// The polynomial over the parameters `middle` ± `half` of a line. None if its numbers are too large.
    pub(crate) fn polynomial(
        &self,
        origin: &[f64],
        direction: &[f64],
        middle: f64,
        half: f64,
        room: &mut [f64],
    ) -> Option<Polynomial> {
        for ((block, &origin), &direction) in room.chunks_exact_mut(4).zip(origin).zip(direction) {
            let (moved, reach) = (direction * middle, direction * half);
            // Three roundings here, two of the evaluators, each of half a unit of less than this sum.
            let error = 4.0 * f64::EPSILON * (origin.abs() + moved.abs() + reach.abs());
            block[2] = origin + moved;
            block[3] = reach;
            finish(block, error);
        }
        let constants = room[self.first_constant..].chunks_exact_mut(3);
        for (block, &constant) in constants.zip(&self.constants) {
            block.copy_from_slice(&[constant.abs(), 0.0, constant]);
        }
        for step in &self.steps {
            let (before, after) = room.split_at_mut(step.out.start);
            let of = |block: Block| &before[block.start..][..block.degree + 3];
            apply(step.function, of(step.a), of(step.b), &mut after[..step.out.degree + 3]);
        }
        let block = &room[self.output.start..][..self.output.degree + 3];
        let [size, error] = [block[0], block[1]];
        if !(size.is_finite() && error.is_finite()) {
            return None;
        }
        let mut coefficients = [0.0; MOST_COEFFICIENTS];
        coefficients[..=self.output.degree].copy_from_slice(&block[2..]);
        Some(Polynomial { coefficients, degree: self.output.degree, size, error })
    }

    /// Bernstein coefficients over −1 to 1, right to [`Polynomial::bernstein_error`].
    pub(crate) fn bernstein(&self, polynomial: &Polynomial) -> [f64; MOST_COEFFICIENTS] {
        let coefficients = &polynomial.coefficients[..=polynomial.degree];
        let mut bernstein = [0.0; MOST_COEFFICIENTS];
        for (value, row) in bernstein.iter_mut().zip(self.to_bernstein.chunks_exact(coefficients.len())) {
            *value = row.iter().zip(coefficients).fold(0.0, |sum, (weight, c)| sum + weight * c);
        }
        bernstein
    }
}

/// A function of s from −1 to 1, to within an error.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Polynomial {
    coefficients: [f64; MOST_COEFFICIENTS],
    pub(crate) degree: usize,
    /// At least the sum of the sizes of the coefficients.
    size: f64,
    error: f64,
}

/// A value and a slope.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ValueAndSlope {
    pub(crate) value: f64,
    pub(crate) slope: f64,
}

impl Polynomial {
    /// By Horner's rule, for s within −1 to 1; see [`value_error`](Self::value_error).
    pub(crate) fn at(&self, s: f64) -> ValueAndSlope {
        let (mut value, mut slope) = (0.0, 0.0);
        for &coefficient in self.coefficients[..=self.degree].iter().rev() {
            slope = slope * s + value;
            value = value * s + coefficient;
        }
        ValueAndSlope { value, slope }
    }

    /// How far [`at`](Self::at) may be from the function, if s itself is right to two units of the last place of 1.
    ///
    /// Horner's rule errs by 2n half units of the size (Higham 2002, section 5.1), and the slope is n times the size at most.
    pub(crate) fn value_error(&self) -> f64 {
        let count = (self.degree + 1) as f64;
        (self.error + 4.0 * count * f64::EPSILON * self.size) * SLACK
    }

    /// How far Bernstein coefficients, halved so many times, may be from those of a polynomial that the function stays within
    /// its error of, plus that error. Weights are right to half a unit, sums of n + 1 products to n + 1, means to half a unit
    /// each, and no number is greater than the size.
    pub(crate) fn bernstein_error(&self, halvings: u32) -> f64 {
        let count = (self.degree + 1) as f64;
        (self.error + (2.0 + f64::from(halvings)) * count * f64::EPSILON * self.size) * SLACK
    }
}

fn apply(function: Function, a: &[f64], b: &[f64], out: &mut [f64]) {
    let [size_a, error_a, coefficients_a @ ..] = a else { return };
    let [size_b, error_b, coefficients_b @ ..] = b else { return };
    let error = match function {
        Function::Negate => {
            for (out, a) in out[2..].iter_mut().zip(coefficients_a) {
                *out = -a;
            }
            *error_a
        }
        Function::Add | Function::Subtract => {
            let sign = if function == Function::Add { 1.0 } else { -1.0 };
            out[2..].fill(0.0);
            for (out, a) in out[2..].iter_mut().zip(coefficients_a) {
                *out = *a;
            }
            for (out, b) in out[2..].iter_mut().zip(coefficients_b) {
                *out += sign * b;
            }
            error_a + error_b
        }
        Function::Multiply => {
            out[2..].fill(0.0);
            for (i, a) in coefficients_a.iter().enumerate() {
                for (out, b) in out[2 + i..].iter_mut().zip(coefficients_b) {
                    *out += a * b;
                }
            }
            // A coefficient is a sum of so many products at most.
            let terms = coefficients_a.len().min(coefficients_b.len()) as f64;
            size_a * error_b
                + size_b * error_a
                + error_a * error_b
                + (terms + 2.0) * f64::EPSILON * (size_a * size_b)
        }
        Function::Divide => {
            let divisor = coefficients_b[0];
            for (out, a) in out[2..].iter_mut().zip(coefficients_a) {
                *out = a / divisor;
            }
            error_a / divisor.abs()
        }
    };
    finish(out, error);
}

/// Sets the size of a block, and its error, to which one rounding of coefficients and one of the evaluators is added.
fn finish(block: &mut [f64], error: f64) {
    let size = SLACK * block[2..].iter().fold(0.0, |sum, c| sum + c.abs());
    block[0] = size;
    // The last summand is more than all products that are too small to be seen.
    block[1] = (error + 2.0 * f64::EPSILON * size) * SLACK + f64::MIN_POSITIVE;
}

/// The Bernstein coefficients of degree n over −1 to 1 of sⁱ: those of (v − (1 − v))ⁱ (v + (1 − v))ⁿ⁻ⁱ. Whole numbers below
/// 2⁵³ up to the quotient.
fn powers_in_bernstein_form(degree: usize) -> Vec<f64> {
    let choose = |n: usize, k: usize| (0..k).fold(1.0, |c, i| c * (n - i) as f64 / (i + 1) as f64);
    let mut rows = Vec::with_capacity((degree + 1) * (degree + 1));
    for j in 0..=degree {
        for i in 0..=degree {
            // So many of the i factors give v.
            let with_v = i.saturating_sub(degree - j)..=i.min(j);
            let sum: f64 = with_v
                .map(|k| {
                    let sign = if (i - k).is_multiple_of(2) { 1.0 } else { -1.0 };
                    sign * choose(i, k) * choose(degree - i, j - k)
                })
                .sum();
            rows.push(sum / choose(degree, j));
        }
    }
    rows
}

impl Tape {
    /// The first output along lines, if it is a polynomial.
    pub(crate) fn along(&self) -> Option<&Along> {
        self.program.along.get_or_init(|| Along::new(&self.program)).as_ref()
    }
}
