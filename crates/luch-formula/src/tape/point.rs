//! One point at a time.

use super::Tape;
use crate::noise::noise;
use crate::operation::{
    Binary, Once, Operation, binary_slopes, chain, is_true, unary_slope, whole_power_slope,
};

/// Lends some registers, from the stack if they are few.
pub(super) fn with_registers<T: Copy, R>(count: usize, zero: T, body: impl FnOnce(&mut [T]) -> R) -> R {
    match count {
        0..=16 => body(&mut [zero; 16][..count]),
        17..=64 => body(&mut [zero; 64][..count]),
        _ => body(&mut vec![zero; count]),
    }
}

/// All undefined numbers are one.
#[inline(always)]
pub(super) fn settled(value: f64) -> f64 {
    if value.is_nan() { f64::NAN } else { value }
}

impl Tape {
    /// The first output at a point.
    ///
    /// # Panics
    ///
    /// If there is not one coordinate for each input.
    pub fn value(&self, point: &[f64]) -> f64 {
        let mut values = [0.0];
        self.values(point, &mut values);
        values[0]
    }

    /// The first outputs at a point, as many as there is room for.
    ///
    /// # Panics
    ///
    /// If there is not one coordinate for each input, or more room than outputs.
    pub fn values(&self, point: &[f64], values: &mut [f64]) {
        self.check_inputs(point.len());
        assert!(values.len() <= self.outputs(), "a tape gives no more than its outputs");
        let program = &*self.program;
        with_registers(program.registers, 0.0, |registers| {
            self.load(point, registers);
            for instruction in &program.instructions {
                registers[instruction.out as usize] =
                    instruction.operation.value(|register| registers[register as usize]);
            }
            for (value, &register) in values.iter_mut().zip(&program.output_registers) {
                *value = settled(registers[register as usize]);
            }
        });
    }

    fn load(&self, point: &[f64], registers: &mut [f64]) {
        registers[..point.len()].copy_from_slice(point);
        registers[point.len()..][..self.program.constants.len()].copy_from_slice(&self.program.constants);
    }

    /// The first output at a point, and its derivatives by the first inputs, as many as there is room for.
    ///
    /// Where the function jumps its derivative is that of the piece; in a kink it is that of the side that was taken, and zero
    /// for `abs`.
    ///
    /// # Panics
    ///
    /// If there is not one coordinate for each input, or more room than inputs.
    pub fn gradient(&self, point: &[f64], derivatives: &mut [f64]) -> f64 {
        self.check_inputs(point.len());
        let count = derivatives.len();
        assert!(count <= point.len(), "a derivative for each input at most");
        let program = &*self.program;
        with_registers(program.registers, 0.0, |registers| {
            with_registers(program.registers * count, 0.0, |slopes| {
                self.load(point, registers);
                for (input, own) in slopes.chunks_exact_mut(count.max(1)).take(count).enumerate() {
                    own[input] = 1.0;
                }
                for instruction in &program.instructions {
                    let value = instruction.operation.value(|register| registers[register as usize]);
                    for axis in 0..count {
                        let slope = derivative(
                            &instruction.operation,
                            instruction.depends.map(|operand| operand.includes(axis)),
                            value,
                            |register| registers[register as usize],
                            |register| slopes[register as usize * count + axis],
                        );
                        slopes[instruction.out as usize * count + axis] = slope;
                    }
                    registers[instruction.out as usize] = value;
                }
                let output = program.output_registers[0] as usize;
                for (derivative, slope) in derivatives.iter_mut().zip(&slopes[output * count..]) {
                    *derivative = settled(*slope);
                }
                settled(registers[output])
            })
        })
    }
}

/// The derivative of a step from those of its operands; `moving` says which of them depend on the input.
#[inline(always)]
fn derivative(
    operation: &Operation,
    moving: [bool; 3],
    value: f64,
    of: impl Fn(u32) -> f64,
    slope_of: impl Fn(u32) -> f64,
) -> f64 {
    if moving == [false; 3] {
        return 0.0;
    }
    match *operation {
        Operation::Unary { function, a } => chain(unary_slope(function, Once([of(a), value])), slope_of(a)),
        Operation::Binary { function: Binary::Add, a, b } => slope_of(a) + slope_of(b),
        Operation::Binary { function: Binary::Subtract, a, b } => slope_of(a) - slope_of(b),
        Operation::Binary { function, a, b } => {
            let [first, second] = binary_slopes(function, Once([of(a), of(b), value]));
            match moving {
                [true, true, _] => chain(first, slope_of(a)) + chain(second, slope_of(b)),
                [true, ..] => chain(first, slope_of(a)),
                _ => chain(second, slope_of(b)),
            }
        }
        Operation::WholePower { base, exponent } => {
            chain(whole_power_slope(of(base), exponent), slope_of(base))
        }
        Operation::Select { condition, yes, no } => {
            if is_true(of(condition)) {
                slope_of(yes)
            } else {
                slope_of(no)
            }
        }
        Operation::Noise { x, y, z } => {
            let [along_x, along_y, along_z] = noise(of(x), of(y), of(z)).gradient;
            chain(along_x, slope_of(x)) + chain(along_y, slope_of(y)) + chain(along_z, slope_of(z))
        }
    }
}
