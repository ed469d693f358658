//! Derivatives at many points: each step first its value, then its slopes, then the derivatives by every input.

use super::bulk::{
    Evaluator, GROUPS, Group, LANES, Lanes, Register, SlopeLanes, WIDTH, compute, each_two, empty_register,
    load, store,
};
use super::{Instruction, Program};
use crate::noise::noise;
use crate::operation::{
    Binary, Operation, VisitUnary, binary_slopes, chain, is_true, unary_slope, whole_power_slope,
};
use crate::simd::{Task, dispatch};

/// Registers for what lies between: a value, and three slopes.
const BETWEEN: usize = 4;

impl Evaluator<'_> {
    /// As [`Tape::gradients`](super::Tape::gradients).
    ///
    /// # Panics
    ///
    /// As there.
    pub fn gradients(&mut self, inputs: &[&[f64]], values: &mut [f64], derivatives: &mut [&mut [f64]]) {
        let length = self.check(inputs, &[&mut *values]);
        let same = derivatives.iter().all(|list| list.len() == length);
        assert!(same && derivatives.len() <= inputs.len(), "a list of derivatives for each input at most");
        let program = &*self.tape.program;
        let count = derivatives.len();
        self.slopes.clear();
        self.slopes.resize_with(BETWEEN + count * program.registers, empty_register);
        for input in 0..count {
            for group in &self.slopes[BETWEEN + input * program.registers + input] {
                group.set([1.0; WIDTH]);
            }
        }
        let (between, slopes) = self.slopes.split_at(BETWEEN);
        let task =
            Gradients { program, registers: &self.registers, between, slopes, inputs, values, derivatives };
        dispatch(self.level, task);
    }
}

struct Gradients<'a, 'o> {
    program: &'a Program,
    registers: &'a [Register],
    between: &'a [Register],
    /// All registers' derivatives by the first input, then by the second.
    slopes: &'a [Register],
    inputs: &'a [&'a [f64]],
    values: &'a mut [f64],
    derivatives: &'a mut [&'o mut [f64]],
}

impl Task for Gradients<'_, '_> {
    #[inline(always)]
    fn run(self) {
        let program = self.program;
        let length = self.values.len();
        for start in (0..length).step_by(LANES) {
            let count = LANES.min(length - start);
            let groups = count.div_ceil(WIDTH);
            load(self.inputs, self.registers, start, count);
            for Instruction { out, operation } in &program.instructions {
                let between = self.between;
                compute(operation, self.registers, &between[0], groups);
                let slopes = local_slopes(operation, self.registers, between, groups);
                for by_input in self.slopes.chunks_exact(program.registers) {
                    derive(operation, self.registers, slopes, by_input, &by_input[*out as usize], groups);
                }
                for (value, out) in between[0][..groups].iter().zip(&self.registers[*out as usize]) {
                    out.set(value.get());
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

/// The slopes of a step by its operands, in registers between or where they stand already.
#[inline(always)]
fn local_slopes<'a>(
    operation: &Operation,
    registers: &'a [Register],
    between: &'a [Register],
    groups: usize,
) -> [&'a Register; 3] {
    let of = |register: u32| &registers[register as usize];
    let [value, first, second, third] = between else { unreachable!("four registers") };
    match *operation {
        Operation::Unary { function, a } => {
            let operands = [&of(a)[..groups], &value[..groups]];
            unary_slope(function, Lanes { operands, out: &first[..groups] });
        }
        // These need none, or have them.
        Operation::Binary { function: Binary::Add | Binary::Subtract, .. } | Operation::Select { .. } => {}
        Operation::Binary { function: Binary::Multiply, a, b } => return [of(b), of(a), third],
        Operation::Binary { function, a, b } => {
            let operands = [&of(a)[..groups], &of(b)[..groups], &value[..groups]];
            binary_slopes(function, SlopeLanes { operands, out: [&first[..groups], &second[..groups]] });
        }
        Operation::WholePower { base, exponent } => {
            let lanes = Lanes { operands: [&of(base)[..groups]], out: &first[..groups] };
            match exponent {
                2 => lanes.visit(|x| whole_power_slope(x, 2)),
                3 => lanes.visit(|x| whole_power_slope(x, 3)),
                _ => lanes.visit(|x| whole_power_slope(x, exponent)),
            }
        }
        Operation::Noise { x, y, z } => {
            for group in 0..groups {
                let (x, y, z) = (of(x)[group].get(), of(y)[group].get(), of(z)[group].get());
                let mut slopes = [[0.0; WIDTH]; 3];
                for lane in 0..WIDTH {
                    let gradient = noise(x[lane], y[lane], z[lane]).gradient;
                    for axis in 0..3 {
                        slopes[axis][lane] = gradient[axis];
                    }
                }
                for (register, slopes) in [first, second, third].into_iter().zip(slopes) {
                    register[group].set(slopes);
                }
            }
        }
    }
    [first, second, third]
}

/// The derivative of a step by one input.
#[inline(always)]
fn derive(
    operation: &Operation,
    registers: &[Register],
    slopes: [&Register; 3],
    by_input: &[Register],
    out: &Register,
    groups: usize,
) {
    let of = |register: u32| &by_input[register as usize][..groups];
    let out = &out[..groups];
    let slope = |number: usize| &slopes[number][..groups];
    match *operation {
        Operation::Unary { a, .. } => chain_one(slope(0), of(a), out),
        Operation::WholePower { base, .. } => chain_one(slope(0), of(base), out),
        Operation::Binary { function: Binary::Add, a, b } => pairwise(of(a), of(b), out, |x, y| x + y),
        Operation::Binary { function: Binary::Subtract, a, b } => pairwise(of(a), of(b), out, |x, y| x - y),
        Operation::Binary { a, b, .. } => {
            for (group, out) in out.iter().enumerate() {
                let first = each_two(slope(0)[group].get(), of(a)[group].get(), chain);
                let second = each_two(slope(1)[group].get(), of(b)[group].get(), chain);
                out.set(each_two(first, second, |x, y| x + y));
            }
        }
        Operation::Select { condition, yes, no } => {
            let condition = &registers[condition as usize][..groups];
            for group in 0..groups {
                let (condition, yes, no) =
                    (condition[group].get(), of(yes)[group].get(), of(no)[group].get());
                let mut result = [0.0; WIDTH];
                for lane in 0..WIDTH {
                    result[lane] = if is_true(condition[lane]) { yes[lane] } else { no[lane] };
                }
                out[group].set(result);
            }
        }
        Operation::Noise { x, y, z } => {
            for (group, out) in out.iter().enumerate() {
                let along_x = each_two(slope(0)[group].get(), of(x)[group].get(), chain);
                let along_y = each_two(slope(1)[group].get(), of(y)[group].get(), chain);
                let along_z = each_two(slope(2)[group].get(), of(z)[group].get(), chain);
                let sum = each_two(along_x, along_y, |x, y| x + y);
                out.set(each_two(sum, along_z, |x, y| x + y));
            }
        }
    }
}

#[inline(always)]
fn chain_one(slope: &[Group], derivative: &[Group], out: &[Group]) {
    pairwise(slope, derivative, out, chain);
}

#[inline(always)]
fn pairwise(x: &[Group], y: &[Group], out: &[Group], function: impl Fn(f64, f64) -> f64) {
    debug_assert!(out.len() <= GROUPS);
    for ((x, y), out) in x.iter().zip(y).zip(out) {
        out.set(each_two(x.get(), y.get(), &function));
    }
}
