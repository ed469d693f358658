//! Derivatives at many points: of each step first the value, then its slopes, then the derivatives by every input.

use super::bulk::{
    Evaluator, LANES, Lanes, Others, Register, SlopeLanes, apart, compute, in_groups, load, store,
};
use super::bulk_noise::noise_slopes;
use super::{Instruction, Program};
use crate::operation::{
    Binary, Operation, VisitUnary, binary_slopes, chain, is_true, unary_slope, whole_power_slope,
};
use crate::simd::{Task, dispatch};

impl Evaluator<'_> {
    /// As [`Tape::gradients`](super::Tape::gradients).
    ///
    /// # Panics
    ///
    /// As there.
    pub fn gradients(&mut self, inputs: &[&[f64]], values: &mut [f64], derivatives: &mut [&mut [f64]]) {
        self.check(inputs, values.len());
        let same = derivatives.iter().all(|list| list.len() == values.len());
        assert!(same && derivatives.len() <= inputs.len(), "a list of derivatives for each input at most");
        let program = &*self.tape.program;
        let count = derivatives.len();
        self.slopes.clear();
        self.slopes.resize(count * program.registers, [0.0; LANES]);
        for input in 0..count {
            self.slopes[input * program.registers + input] = [1.0; LANES];
        }
        let (registers, slopes) = (&mut self.registers, &mut self.slopes);
        dispatch(self.level, Gradients { program, registers, slopes, inputs, values, derivatives });
    }
}

struct Gradients<'a, 'o> {
    program: &'a Program,
    registers: &'a mut [Register],
    slopes: &'a mut [Register],
    inputs: &'a [&'a [f64]],
    values: &'a mut [f64],
    derivatives: &'a mut [&'o mut [f64]],
}

impl Task for Gradients<'_, '_> {
    #[inline(always)]
    fn run(self) {
        let program = self.program;
        let length = self.values.len();
        let mut local = [[0.0; LANES]; 3];
        for start in (0..length).step_by(LANES) {
            let count = LANES.min(length - start);
            let lanes = in_groups(count);
            load(program, self.inputs, self.registers, start, count);
            for Instruction { out, operation, depends } in &program.instructions {
                let (value, registers) = apart(self.registers, *out);
                compute(operation, &registers, &mut value[..lanes]);
                local_slopes(operation, &registers, value, &mut local, lanes);
                for (input, by_input) in self.slopes.chunks_exact_mut(program.registers).enumerate() {
                    let (derivative, by_input) = apart(by_input, *out);
                    let moving = depends.map(|operand| operand.includes(input));
                    derive(operation, &registers, &local, &by_input, moving, &mut derivative[..lanes]);
                }
            }
            let output = program.output_registers[0] as usize;
            store(&self.registers[output], &mut self.values[start..start + count]);
            let by_inputs = self.slopes.chunks_exact(program.registers.max(1));
            for (derivatives, by_input) in self.derivatives.iter_mut().zip(by_inputs) {
                store(&by_input[output], &mut derivatives[start..start + count]);
            }
        }
    }
}

/// The slopes of a step by its operands, unless they are known beforehand or stand in registers.
#[inline(always)]
fn local_slopes(
    operation: &Operation,
    registers: &Others<'_>,
    value: &Register,
    local: &mut [Register; 3],
    lanes: usize,
) {
    let of = |register: u32| registers.of(register);
    let [first, second, third] = local;
    let (first, second, third) = (&mut first[..lanes], &mut second[..lanes], &mut third[..lanes]);
    match *operation {
        Operation::Unary { function, a } => {
            unary_slope(function, Lanes { operands: [of(a), value], out: first });
        }
        Operation::Binary { function: Binary::Add | Binary::Subtract | Binary::Multiply, .. }
        | Operation::Select { .. } => {}
        Operation::Binary { function, a, b } => {
            binary_slopes(function, SlopeLanes { operands: [of(a), of(b), value], first, second });
        }
        Operation::WholePower { base, exponent } => {
            let lanes = Lanes { operands: [of(base)], out: first };
            match exponent {
                2 => lanes.visit(|x| whole_power_slope(x, 2)),
                3 => lanes.visit(|x| whole_power_slope(x, 3)),
                4 => lanes.visit(|x| whole_power_slope(x, 4)),
                _ => lanes.visit(|x| whole_power_slope(x, exponent)),
            }
        }
        Operation::Noise { x, y, z } => {
            noise_slopes([of(x), of(y), of(z)], [first, second, third]);
        }
    }
}

/// The derivative of a step by one input; `moving` says which operands depend on it. Those that do not are not looked at.
#[inline(always)]
fn derive(
    operation: &Operation,
    registers: &Others<'_>,
    local: &[Register; 3],
    by_input: &Others<'_>,
    moving: [bool; 3],
    out: &mut [f64],
) {
    let of = |register: u32| by_input.of(register);
    if moving == [false; 3] {
        return out.fill(0.0);
    }
    match *operation {
        Operation::Unary { a, .. } | Operation::WholePower { base: a, .. } => {
            chain_one(&local[0], of(a), out)
        }
        Operation::Binary { function: Binary::Add, a, b } => {
            for ((&a, &b), out) in of(a).iter().zip(of(b)).zip(out) {
                *out = a + b;
            }
        }
        Operation::Binary { function: Binary::Subtract, a, b } => {
            for ((&a, &b), out) in of(a).iter().zip(of(b)).zip(out) {
                *out = a - b;
            }
        }
        Operation::Binary { function, a, b } => {
            let [first, second] = match function {
                Binary::Multiply => [registers.of(b), registers.of(a)],
                _ => [&local[0], &local[1]],
            };
            match moving {
                [true, true, _] => chain_two([first, second], [of(a), of(b)], out),
                [true, ..] => chain_one(first, of(a), out),
                _ => chain_one(second, of(b), out),
            }
        }
        Operation::Select { condition, yes, no } => {
            let (condition, yes, no) = (registers.of(condition), of(yes), of(no));
            for (lane, out) in out.iter_mut().enumerate() {
                *out = if is_true(condition[lane]) { yes[lane] } else { no[lane] };
            }
        }
        Operation::Noise { x, y, z } => {
            let [along_x, along_y, along_z] = local;
            let (x, y, z) = (of(x), of(y), of(z));
            for (lane, out) in out.iter_mut().enumerate() {
                let plane = chain(along_x[lane], x[lane]) + chain(along_y[lane], y[lane]);
                *out = plane + chain(along_z[lane], z[lane]);
            }
        }
    }
}

#[inline(always)]
fn chain_one(slope: &Register, derivative: &Register, out: &mut [f64]) {
    for ((&slope, &derivative), out) in slope.iter().zip(derivative).zip(out) {
        *out = chain(slope, derivative);
    }
}

#[inline(always)]
fn chain_two(slopes: [&Register; 2], derivatives: [&Register; 2], out: &mut [f64]) {
    for (lane, out) in out.iter_mut().enumerate() {
        *out = chain(slopes[0][lane], derivatives[0][lane]) + chain(slopes[1][lane], derivatives[1][lane]);
    }
}
