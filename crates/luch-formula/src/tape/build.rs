//! From an expression to instructions.

use super::{Dependence, Instruction, Program, Tape, TapeError};
use crate::expression::Expression;
use crate::graph::{Graph, Id, Node};
use crate::operation::Operation;
use std::sync::{Arc, OnceLock};

impl Tape {
    /// Compiles an expression of the listed variables.
    ///
    /// # Errors
    ///
    /// The expression depends on a variable that is not listed.
    pub fn new(expression: &Expression, inputs: &[&str]) -> Result<Self, TapeError> {
        Self::of_many(&[expression], inputs)
    }

    /// Compiles several expressions of the same variables; what they share is computed once.
    ///
    /// # Errors
    ///
    /// An expression depends on a variable that is not listed, or there is no expression.
    pub fn of_many(expressions: &[&Expression], inputs: &[&str]) -> Result<Self, TapeError> {
        if expressions.is_empty() {
            return Err(TapeError::NoOutput);
        }
        let unknown = expressions.iter().flat_map(|expression| expression.variables());
        if let Some(name) = unknown.into_iter().find(|name| !inputs.contains(&name.as_str())) {
            return Err(TapeError::MissingInput { name: name.clone(), inputs: inputs.join(", ") });
        }
        let mut graph = Graph::default();
        let input_ids: Vec<Id> = inputs.iter().map(|name| graph.variable(name)).collect();
        let roots: Vec<Id> = expressions.iter().map(|expression| expression.add_to(&mut graph)).collect();

        // Inputs come first, then constants, then operations.
        let nodes = graph.nodes();
        let constant_ids: Vec<Id> =
            (0..nodes.len() as Id).filter(|&id| matches!(nodes[id as usize], Node::Constant(_))).collect();
        let mut place = vec![0; nodes.len()];
        for (number, &id) in input_ids.iter().enumerate() {
            place[id as usize] = number as u32;
        }
        let mut constants = Vec::with_capacity(constant_ids.len());
        for &id in &constant_ids {
            place[id as usize] = (inputs.len() + constants.len()) as u32;
            constants.extend(graph.constant_of(id));
        }
        let first = inputs.len() + constants.len();
        let mut operations = Vec::new();
        for (id, node) in nodes.iter().enumerate() {
            if let Node::Operation(operation) = node {
                place[id] = (first + operations.len()) as u32;
                operations.push(operation.with_operands(|operand| place[operand as usize]));
            }
        }
        let outputs = roots.iter().map(|&root| place[root as usize]).collect();
        Ok(Self::assemble(inputs.len(), constants, operations, outputs))
    }

    /// Drops what no output needs and hands out registers.
    pub(super) fn assemble(
        inputs: usize,
        constants: Vec<f64>,
        operations: Vec<Operation>,
        outputs: Vec<u32>,
    ) -> Self {
        let (constants, operations, outputs) = without_unused(inputs, &constants, &operations, &outputs);
        let fixed = inputs + constants.len();

        // When each number is used for the last time; results never end.
        let mut last_use = vec![0; fixed + operations.len()];
        for (moment, operation) in operations.iter().enumerate() {
            for operand in operation.operands() {
                last_use[operand as usize] = moment;
            }
        }
        for &output in &outputs {
            last_use[output as usize] = usize::MAX;
        }

        let mut used_inputs: Vec<u32> =
            operations.iter().flat_map(|operation| operation.operands()).chain(outputs.clone()).collect();
        used_inputs.retain(|&number| (number as usize) < inputs);
        used_inputs.sort_unstable();
        used_inputs.dedup();

        // Constants depend on nothing.
        let mut depends: Vec<Dependence> = (0..inputs).map(Dependence::on).collect();
        depends.resize(fixed, Dependence::default());

        let mut register_of: Vec<u32> = (0..(fixed + operations.len()) as u32).collect();
        let mut free: Vec<u32> = Vec::new();
        let mut registers = fixed as u32;
        let mut instructions = Vec::with_capacity(operations.len());
        for (moment, operation) in operations.iter().enumerate() {
            let placed = operation.with_operands(|operand| register_of[operand as usize]);
            // The result gets its register before those of the operands are free: they must not overlap.
            let out = free.pop().unwrap_or_else(|| {
                registers += 1;
                registers - 1
            });
            let mut ended = operation.operands();
            ended.sort_unstable();
            for (index, &operand) in ended.iter().enumerate() {
                let repeated = index > 0 && ended[index - 1] == operand;
                if operand as usize >= fixed && last_use[operand as usize] == moment && !repeated {
                    free.push(register_of[operand as usize]);
                }
            }
            register_of[fixed + moment] = out;
            let of_operands = operation.operands().map(|operand| depends[operand as usize]);
            depends.push(Dependence(of_operands.iter().fold(0, |all, of_operand| all | of_operand.0)));
            instructions.push(Instruction { out, operation: placed, depends: of_operands });
        }
        let output_registers = outputs.iter().map(|&output| register_of[output as usize]).collect();
        Self {
            program: Arc::new(Program {
                inputs,
                constants,
                operations,
                outputs,
                used_inputs,
                instructions,
                output_registers,
                registers: registers as usize,
                along: OnceLock::new(),
            }),
        }
    }
}

/// The constants and operations that outputs depend on, renumbered.
fn without_unused(
    inputs: usize,
    constants: &[f64],
    operations: &[Operation],
    outputs: &[u32],
) -> (Vec<f64>, Vec<Operation>, Vec<u32>) {
    let fixed = inputs + constants.len();
    let mut needed = vec![false; fixed + operations.len()];
    for &output in outputs {
        needed[output as usize] = true;
    }
    for (moment, operation) in operations.iter().enumerate().rev() {
        if needed[fixed + moment] {
            for operand in operation.operands() {
                needed[operand as usize] = true;
            }
        }
    }
    let mut place: Vec<u32> =
        (0..inputs as u32).chain(std::iter::repeat_n(0, needed.len() - inputs)).collect();
    let mut kept_constants = Vec::new();
    for (number, &constant) in constants.iter().enumerate().filter(|(number, _)| needed[inputs + number]) {
        place[inputs + number] = (inputs + kept_constants.len()) as u32;
        kept_constants.push(constant);
    }
    let first = inputs + kept_constants.len();
    let mut kept = Vec::new();
    for (moment, operation) in operations.iter().enumerate().filter(|(moment, _)| needed[fixed + moment]) {
        place[fixed + moment] = (first + kept.len()) as u32;
        kept.push(operation.with_operands(|operand| place[operand as usize]));
    }
    let outputs = outputs.iter().map(|&output| place[output as usize]).collect();
    (kept_constants, kept, outputs)
}
