//! Ranges of values and derivatives over boxes.

use super::point::with_registers;
use super::simplify::{Choices, Traced, choice};
use super::{Program, Tape};
use crate::interval::{self, Interval, IntervalDerivative, SineAndCosine};
use crate::operation::{Binary, Operation, Unary};

impl Tape {
    /// A range that holds every value of the first output over a box.
    ///
    /// # Panics
    ///
    /// If there is not one range for each input.
    pub fn interval(&self, inputs: &[Interval]) -> Interval {
        let mut result = [Interval::UNKNOWN];
        self.intervals(inputs, &mut result);
        result[0]
    }

    /// The ranges of the first outputs over a box, as many as there is room for.
    ///
    /// # Panics
    ///
    /// If there is not one range for each input, or more room than outputs.
    pub fn intervals(&self, inputs: &[Interval], ranges: &mut [Interval]) {
        self.check_inputs(inputs.len());
        assert!(ranges.len() <= self.outputs(), "a tape gives no more than its outputs");
        with_registers(self.program.registers, Interval::ZERO, |registers| {
            self.enclose(inputs, registers, |_, _| {});
            for (range, &register) in ranges.iter_mut().zip(&self.program.output_registers) {
                *range = registers[register as usize];
            }
        });
    }

    /// The range of the first output over a box, and which sides of choices are taken everywhere in it.
    ///
    /// # Panics
    ///
    /// If there is not one range for each input.
    pub fn trace(&self, inputs: &[Interval]) -> Traced {
        self.check_inputs(inputs.len());
        let mut taken = Vec::with_capacity(self.program.operations.len());
        with_registers(self.program.registers, Interval::ZERO, |registers| {
            self.enclose(inputs, registers, |operation, registers| {
                taken.push(choice(operation, |register| registers[register as usize]));
            });
            let value = registers[self.program.output_registers[0] as usize];
            Traced { value, choices: Choices { taken } }
        })
    }

    fn enclose(
        &self,
        inputs: &[Interval],
        registers: &mut [Interval],
        mut before: impl FnMut(&Operation, &[Interval]),
    ) {
        let program: &Program = &self.program;
        registers[..inputs.len()].copy_from_slice(inputs);
        for (register, &constant) in registers[inputs.len()..].iter_mut().zip(&program.constants) {
            *register = Interval::point(constant);
        }
        for instruction in &program.instructions {
            before(&instruction.operation, registers);
            registers[instruction.out as usize] =
                value(&instruction.operation, |register| registers[register as usize]);
        }
    }

    /// The range of the first output over a box, and of its derivative along one parameter on which the inputs depend as their
    /// own derivatives say.
    ///
    /// ```
    /// use luch_formula::{Interval, IntervalDerivative, Tape, parse};
    ///
    /// // Along the ray (0, 0, −5) + t (0, 0, 1), t from 3 to 4.5, a ball is entered once.
    /// let ball = parse("x^2 + y^2 + z^2 - 1", &["x", "y", "z"]).unwrap();
    /// let tape = Tape::new(&ball, &["x", "y", "z"]).unwrap();
    /// let fixed = IntervalDerivative { value: Interval::point(0.0), derivative: Interval::point(0.0) };
    /// let moving = IntervalDerivative { value: Interval::new(-2.0, -0.5), derivative: Interval::point(1.0) };
    /// let range = tape.interval_derivative(&[fixed, fixed, moving]);
    /// assert!(range.value.contains_zero() && range.derivative.high < 0.0);
    /// ```
    ///
    /// # Panics
    ///
    /// If there is not one range for each input.
    pub fn interval_derivative(&self, inputs: &[IntervalDerivative]) -> IntervalDerivative {
        const ZERO: IntervalDerivative =
            IntervalDerivative { value: Interval::ZERO, derivative: Interval::ZERO };
        with_registers(self.program.registers, ZERO, |registers| self.enclose_derivative(inputs, registers))
    }

    /// The same with registers of the caller, as many as the tape has.
    pub(crate) fn enclose_derivative(
        &self,
        inputs: &[IntervalDerivative],
        registers: &mut [IntervalDerivative],
    ) -> IntervalDerivative {
        self.check_inputs(inputs.len());
        let program = &*self.program;
        registers[..inputs.len()].copy_from_slice(inputs);
        for (register, &constant) in registers[inputs.len()..].iter_mut().zip(&program.constants) {
            *register = IntervalDerivative { value: Interval::point(constant), derivative: Interval::ZERO };
        }
        for instruction in &program.instructions {
            let of = |register: u32| registers[register as usize];
            let mut result = match instruction.operation {
                Operation::Noise { x, y, z } => noise([x, y, z].map(of)),
                Operation::Unary { function: Unary::Sin, a } => {
                    let SineAndCosine { sine, cosine } = interval::sine_and_cosine(of(a).value);
                    let derivative = interval::chain(cosine, of(a).derivative);
                    IntervalDerivative { value: sine, derivative }
                }
                Operation::Unary { function: Unary::Cos, a } => {
                    let SineAndCosine { sine, cosine } = interval::sine_and_cosine(of(a).value);
                    let slope = interval::unary(Unary::Negate, sine);
                    IntervalDerivative { value: cosine, derivative: interval::chain(slope, of(a).derivative) }
                }
                _ => {
                    let value = value(&instruction.operation, |register| of(register).value);
                    let derivative = derivative(&instruction.operation, value, of);
                    IntervalDerivative { value, derivative }
                }
            };
            if result.value.partial {
                result.derivative = Interval::UNKNOWN;
            }
            registers[instruction.out as usize] = result;
        }
        registers[program.output_registers[0] as usize]
    }
}

fn value(operation: &Operation, of: impl Fn(u32) -> Interval) -> Interval {
    match *operation {
        Operation::Unary { function, a } => interval::unary(function, of(a)),
        Operation::Binary { function, a, b } => interval::binary(function, of(a), of(b), a == b),
        Operation::WholePower { base, exponent } => interval::whole_power(of(base), exponent),
        Operation::Select { condition, yes, no } => match of(condition).truth() {
            Some(true) => of(yes),
            Some(false) => of(no),
            None => of(yes).hull(&of(no)),
        },
        Operation::Noise { x, y, z } => interval::noise([of(x), of(y), of(z)]),
    }
}

fn derivative(operation: &Operation, value: Interval, of: impl Fn(u32) -> IntervalDerivative) -> Interval {
    let sum = |a: Interval, b: Interval| interval::binary(Binary::Add, a, b, false);
    match *operation {
        Operation::Unary { function, a } => {
            interval::chain(interval::unary_slope(function, of(a).value, value), of(a).derivative)
        }
        Operation::Binary { function: Binary::Minimum | Binary::Maximum, a, b } => {
            let (first, second) = (of(a), of(b));
            match choice(operation, |register| of(register).value) {
                super::simplify::Choice::First => first.derivative,
                super::simplify::Choice::Second => second.derivative,
                // Where one side begins to be undefined the value may jump to the other.
                _ if first.value.partial || second.value.partial => Interval::UNKNOWN,
                _ => first.derivative.hull(&second.derivative),
            }
        }
        Operation::Binary { function, a, b } => {
            let (first, second) = (of(a), of(b));
            let [along_a, along_b] = interval::binary_slopes(function, first.value, second.value, value);
            let along_a = interval::chain(along_a, first.derivative);
            if a == b && function == Binary::Multiply {
                return sum(along_a, along_a);
            }
            sum(along_a, interval::chain(along_b, second.derivative))
        }
        Operation::WholePower { base, exponent } => {
            interval::chain(interval::whole_power_slope(of(base).value, exponent), of(base).derivative)
        }
        Operation::Select { condition, yes, no } => {
            let decides = of(condition);
            match decides.value.truth() {
                Some(true) => of(yes).derivative,
                Some(false) => of(no).derivative,
                // A condition that does not change along the way changes no side.
                None if decides.derivative == Interval::ZERO => of(yes).derivative.hull(&of(no).derivative),
                None => Interval::UNKNOWN,
            }
        }
        Operation::Noise { x, y, z } => noise([of(x), of(y), of(z)]).derivative,
    }
}

/// Noise is looked at once for both.
fn noise(place: [IntervalDerivative; 3]) -> IntervalDerivative {
    let sum = |a: Interval, b: Interval| interval::binary(Binary::Add, a, b, false);
    let range = interval::noise_with_slopes(place.map(|coordinate| coordinate.value));
    let parts: [Interval; 3] =
        std::array::from_fn(|axis| interval::chain(range.slopes[axis], place[axis].derivative));
    IntervalDerivative { value: range.value, derivative: sum(sum(parts[0], parts[1]), parts[2]) }
}
