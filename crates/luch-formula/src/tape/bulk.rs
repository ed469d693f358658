//! Many points: each instruction is done for 128 of them before the next one.
//!
//! So the cost of reading an instruction vanishes, the loop over the points becomes vector code, and the registers stay in the
//! nearest cache. Numbers stand in groups of eight that are read and written whole, hence an instruction may put its result
//! where an operand was.

use super::point::settled;
use super::{Instruction, Program, Tape};
use crate::noise::noise;
use crate::operation::{Operation, VisitBinary, VisitSlopes, VisitUnary, binary, select, unary, whole_power};
use crate::simd::{Level, Task, dispatch};
use std::cell::Cell;

/// Numbers in a group: one register of AVX-512.
pub(super) const WIDTH: usize = 8;

/// Groups in a register.
pub(super) const GROUPS: usize = 16;

/// Points that are evaluated together.
pub(super) const LANES: usize = WIDTH * GROUPS;

pub(super) type Group = Cell<[f64; WIDTH]>;
pub(super) type Register = [Group; GROUPS];

pub(super) fn empty_register() -> Register {
    [const { Cell::new([0.0; WIDTH]) }; GROUPS]
}

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
        let registers: Vec<Register> = (0..program.registers).map(|_| empty_register()).collect();
        for (register, &constant) in registers[program.inputs..].iter().zip(&program.constants) {
            for group in register {
                group.set([constant; WIDTH]);
            }
        }
        Evaluator { tape: self, level, registers, slopes: Vec::new() }
    }
}

/// A tape with room for evaluations at many points.
#[derive(Debug)]
pub struct Evaluator<'t> {
    pub(super) tape: &'t Tape,
    pub(super) level: Level,
    pub(super) registers: Vec<Register>,
    /// Derivatives of registers, and numbers in between; see [`gradients`](Self::gradients).
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
        let length = self.check(inputs, values);
        assert!(values.len() <= self.tape.outputs(), "a tape gives no more than its outputs");
        let task = Values {
            program: &self.tape.program,
            registers: &self.registers,
            inputs,
            outputs: values,
            length,
        };
        dispatch(self.level, task);
    }

    /// How many points there are.
    pub(super) fn check(&self, inputs: &[&[f64]], lists: &[&mut [f64]]) -> usize {
        self.tape.check_inputs(inputs.len());
        let length = lists.first().map_or(0, |list| list.len());
        let same =
            inputs.iter().all(|list| list.len() == length) && lists.iter().all(|list| list.len() == length);
        assert!(same || lists.is_empty(), "one number for each point");
        length
    }
}

struct Values<'a, 'o> {
    program: &'a Program,
    registers: &'a [Register],
    inputs: &'a [&'a [f64]],
    outputs: &'a mut [&'o mut [f64]],
    length: usize,
}

impl Task for Values<'_, '_> {
    #[inline(always)]
    fn run(self) {
        for start in (0..self.length).step_by(LANES) {
            let count = LANES.min(self.length - start);
            let groups = count.div_ceil(WIDTH);
            load(self.inputs, self.registers, start, count);
            for Instruction { out, operation } in &self.program.instructions {
                compute(operation, self.registers, &self.registers[*out as usize], groups);
            }
            for (output, &register) in self.outputs.iter_mut().zip(&self.program.output_registers) {
                store(&self.registers[register as usize], &mut output[start..start + count]);
            }
        }
    }
}

/// Puts points into the registers of the inputs; a last group that is not full repeats its last point.
#[inline(always)]
pub(super) fn load(inputs: &[&[f64]], registers: &[Register], start: usize, count: usize) {
    for (input, register) in inputs.iter().zip(registers) {
        let (whole, rest) = input[start..start + count].as_chunks::<WIDTH>();
        for (values, group) in whole.iter().zip(register) {
            group.set(*values);
        }
        if let Some(&last) = rest.last() {
            let mut values = [last; WIDTH];
            values[..rest.len()].copy_from_slice(rest);
            register[whole.len()].set(values);
        }
    }
}

#[inline(always)]
pub(super) fn store(register: &Register, output: &mut [f64]) {
    let (whole, rest) = output.as_chunks_mut::<WIDTH>();
    for (values, group) in whole.iter_mut().zip(register) {
        *values = each(group.get(), settled);
    }
    let values = register[whole.len() % GROUPS].get();
    for (output, value) in rest.iter_mut().zip(values) {
        *output = settled(value);
    }
}

#[inline(always)]
fn each(x: [f64; WIDTH], function: impl Fn(f64) -> f64) -> [f64; WIDTH] {
    let mut result = [0.0; WIDTH];
    for lane in 0..WIDTH {
        result[lane] = function(x[lane]);
    }
    result
}

#[inline(always)]
pub(super) fn each_two(x: [f64; WIDTH], y: [f64; WIDTH], function: impl Fn(f64, f64) -> f64) -> [f64; WIDTH] {
    let mut result = [0.0; WIDTH];
    for lane in 0..WIDTH {
        result[lane] = function(x[lane], y[lane]);
    }
    result
}

/// One operation for some groups.
#[inline(always)]
pub(super) fn compute(operation: &Operation, registers: &[Register], out: &Register, groups: usize) {
    let of = |register: u32| &registers[register as usize][..groups];
    let out = &out[..groups];
    match *operation {
        Operation::Unary { function, a } => unary(function, Lanes { operands: [of(a)], out }),
        Operation::Binary { function, a, b } => binary(function, Lanes { operands: [of(a), of(b)], out }),
        Operation::WholePower { base, exponent } => {
            let lanes = Lanes { operands: [of(base)], out };
            // Small exponents are compiled on their own.
            match exponent {
                2 => VisitUnary::visit(lanes, |x| x * x),
                3 => VisitUnary::visit(lanes, |x| whole_power(x, 3)),
                4 => VisitUnary::visit(lanes, |x| whole_power(x, 4)),
                _ => {
                    for (base, out) in of(base).iter().zip(out) {
                        out.set(whole_power_of_group(base.get(), exponent));
                    }
                }
            }
        }
        Operation::Select { condition, yes, no } => {
            for (((condition, yes), no), out) in of(condition).iter().zip(of(yes)).zip(of(no)).zip(out) {
                let (condition, yes, no) = (condition.get(), yes.get(), no.get());
                let mut result = [0.0; WIDTH];
                for lane in 0..WIDTH {
                    result[lane] = select(condition[lane], yes[lane], no[lane]);
                }
                out.set(result);
            }
        }
        Operation::Noise { x, y, z } => {
            for (((x, y), z), out) in of(x).iter().zip(of(y)).zip(of(z)).zip(out) {
                let (x, y, z) = (x.get(), y.get(), z.get());
                let mut result = [0.0; WIDTH];
                for lane in 0..WIDTH {
                    result[lane] = noise(x[lane], y[lane], z[lane]).value;
                }
                out.set(result);
            }
        }
    }
}

/// As [`whole_power`], with eight lanes in every product.
#[inline(always)]
fn whole_power_of_group(base: [f64; WIDTH], exponent: u8) -> [f64; WIDTH] {
    let (mut square, mut rest, mut power) = (base, exponent, None);
    loop {
        if rest & 1 == 1 {
            power = Some(power.map_or(square, |power| each_two(power, square, |x, y| x * y)));
        }
        rest >>= 1;
        if rest == 0 {
            return power.unwrap_or(square);
        }
        square = each(square, |x| x * x);
    }
}

/// Applies a function to all lanes of its operands.
pub(super) struct Lanes<'a, const N: usize> {
    pub(super) operands: [&'a [Group]; N],
    pub(super) out: &'a [Group],
}

impl VisitUnary for Lanes<'_, 1> {
    type Output = ();
    #[inline(always)]
    fn visit(self, function: impl Fn(f64) -> f64) {
        for (x, out) in self.operands[0].iter().zip(self.out) {
            out.set(each(x.get(), &function));
        }
    }
}

impl VisitBinary for Lanes<'_, 2> {
    type Output = ();
    #[inline(always)]
    fn visit(self, function: impl Fn(f64, f64) -> f64) {
        for ((x, y), out) in self.operands[0].iter().zip(self.operands[1]).zip(self.out) {
            out.set(each_two(x.get(), y.get(), &function));
        }
    }
}

/// Computes two slopes from two operands and the value.
pub(super) struct SlopeLanes<'a> {
    pub(super) operands: [&'a [Group]; 3],
    pub(super) out: [&'a [Group]; 2],
}

impl VisitSlopes for SlopeLanes<'_> {
    type Output = ();
    #[inline(always)]
    fn visit(self, slopes: impl Fn(f64, f64, f64) -> [f64; 2]) {
        let [x, y, value] = self.operands;
        for (group, x) in x.iter().enumerate() {
            let (x, y, value) = (x.get(), y[group].get(), value[group].get());
            let (mut first, mut second) = ([0.0; WIDTH], [0.0; WIDTH]);
            for lane in 0..WIDTH {
                [first[lane], second[lane]] = slopes(x[lane], y[lane], value[lane]);
            }
            self.out[0][group].set(first);
            self.out[1][group].set(second);
        }
    }
}
