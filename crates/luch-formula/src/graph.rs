//! A growing calculation: every step once, constants computed at once.
//!
//! Steps stand in one list, each after its operands, so that nothing ever walks it by recursion. A step that is there already is
//! not added again. Only identities are used that hold for every number, bit for bit.

mod composed;

pub(crate) use composed::MOST_OCTAVES;

use crate::operation::{Binary, Operation, Unary, select};
use std::collections::HashMap;
use std::f64::consts::E;

/// A step, or where numbers come from.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Node {
    Constant(f64),
    /// The number of a name.
    Variable(u32),
    Operation(Operation),
}

impl PartialEq for Node {
    fn eq(&self, other: &Self) -> bool {
        self.key() == other.key()
    }
}

impl Node {
    fn key(self) -> Key {
        match self {
            Self::Constant(value) => Key::Constant(value.to_bits()),
            Self::Variable(name) => Key::Variable(name),
            Self::Operation(operation) => Key::Operation(operation),
        }
    }
}

#[derive(Clone, Copy, PartialEq, Eq, Hash)]
enum Key {
    Constant(u64),
    Variable(u32),
    Operation(Operation),
}

/// The number of a step.
pub(crate) type Id = u32;

/// The greatest whole exponent that becomes multiplications: 11 of them at most, each right to half a unit of the last place.
const GREATEST_EXPONENT: f64 = 64.0;

/// The list of steps.
#[derive(Clone, Default)]
pub(crate) struct Graph {
    nodes: Vec<Node>,
    names: Vec<String>,
    lookup: HashMap<Key, Id>,
    name_lookup: HashMap<String, Id>,
}

impl Graph {
    pub(crate) fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    /// Only the steps that the root needs, in order, the root last, and the names they use.
    pub(crate) fn finish(&self, root: Id) -> (Vec<Node>, Vec<String>) {
        let mut needed = vec![false; root as usize + 1];
        needed[root as usize] = true;
        for (id, node) in self.nodes[..=root as usize].iter().enumerate().rev() {
            if let (true, Node::Operation(operation)) = (needed[id], node) {
                for operand in operation.operands() {
                    needed[operand as usize] = true;
                }
            }
        }
        let mut place = vec![0; root as usize + 1];
        let mut name_place = vec![None; self.names.len()];
        let (mut nodes, mut names) = (Vec::new(), Vec::new());
        for (id, node) in self.nodes[..=root as usize].iter().enumerate().filter(|(id, _)| needed[*id]) {
            place[id] = nodes.len() as Id;
            nodes.push(match *node {
                Node::Constant(value) => Node::Constant(value),
                Node::Variable(name) => {
                    let number = *name_place[name as usize].get_or_insert_with(|| {
                        names.push(self.names[name as usize].clone());
                        names.len() as u32 - 1
                    });
                    Node::Variable(number)
                }
                Node::Operation(operation) => {
                    Node::Operation(operation.with_operands(|operand| place[operand as usize]))
                }
            });
        }
        (nodes, names)
    }

    /// Adds a finished calculation, with something else in the place of its variables; returns its root.
    pub(crate) fn add_nodes(&mut self, nodes: &[Node], mut variable: impl FnMut(&mut Self, u32) -> Id) -> Id {
        let mut place: Vec<Id> = Vec::with_capacity(nodes.len());
        for node in nodes {
            let id = match *node {
                Node::Constant(value) => self.constant(value),
                Node::Variable(name) => variable(self, name),
                Node::Operation(operation) => {
                    self.operation(operation.with_operands(|operand| place[operand as usize]))
                }
            };
            place.push(id);
        }
        place.last().copied().unwrap_or_else(|| self.constant(f64::NAN))
    }

    fn push(&mut self, node: Node) -> Id {
        let Self { nodes, lookup, .. } = self;
        *lookup.entry(node.key()).or_insert_with(|| {
            nodes.push(node);
            nodes.len() as Id - 1
        })
    }

    pub(crate) fn constant(&mut self, value: f64) -> Id {
        // All undefined numbers are one.
        self.push(Node::Constant(if value.is_nan() { f64::NAN } else { value }))
    }

    pub(crate) fn variable(&mut self, name: &str) -> Id {
        let number = match self.name_lookup.get(name) {
            Some(number) => *number,
            None => {
                let number = self.names.len() as u32;
                self.names.push(name.to_owned());
                self.name_lookup.insert(name.to_owned(), number);
                number
            }
        };
        self.push(Node::Variable(number))
    }

    /// The value of a step that is a constant.
    pub(crate) fn constant_of(&self, id: Id) -> Option<f64> {
        match self.nodes[id as usize] {
            Node::Constant(value) => Some(value),
            _ => None,
        }
    }

    fn unary_of(&self, id: Id, function: Unary) -> Option<Id> {
        match self.nodes[id as usize] {
            Node::Operation(Operation::Unary { function: found, a }) if found == function => Some(a),
            _ => None,
        }
    }

    /// Adds a step of any kind.
    pub(crate) fn operation(&mut self, operation: Operation) -> Id {
        match operation {
            Operation::Unary { function, a } => self.unary(function, a),
            Operation::Binary { function, a, b } => self.binary(function, a, b),
            Operation::Select { condition, yes, no } => self.select(condition, yes, no),
            Operation::WholePower { .. } | Operation::Noise { .. } => self.fold(operation),
        }
    }

    /// Computes a step whose operands are constants, else adds it.
    fn fold(&mut self, operation: Operation) -> Id {
        let known = operation.operands().iter().all(|&operand| self.constant_of(operand).is_some());
        if known {
            let value = operation.value(|operand| self.constant_of(operand).unwrap_or(f64::NAN));
            return self.constant(value);
        }
        self.push(Node::Operation(operation))
    }

    pub(crate) fn unary(&mut self, function: Unary, a: Id) -> Id {
        match function {
            Unary::Negate => {
                if let Some(inner) = self.unary_of(a, Unary::Negate) {
                    return inner;
                }
            }
            Unary::Absolute => {
                if self.unary_of(a, Unary::Absolute).is_some() {
                    return a;
                }
                if let Some(inner) = self.unary_of(a, Unary::Negate) {
                    return self.unary(Unary::Absolute, inner);
                }
            }
            _ => {}
        }
        self.fold(Operation::Unary { function, a })
    }

    pub(crate) fn binary(&mut self, function: Binary, a: Id, b: Id) -> Id {
        let (constant_a, constant_b) = (self.constant_of(a), self.constant_of(b));
        if constant_a.is_some() && constant_b.is_some() && function != Binary::Power {
            return self.fold(Operation::Binary { function, a, b });
        }
        let is = |constant: Option<f64>, value: f64| constant.is_some_and(|c| c.to_bits() == value.to_bits());
        match function {
            Binary::Add => {
                // Only −0 leaves every number as it is: −0 + 0 is 0.
                if is(constant_a, -0.0) {
                    return b;
                }
                if is(constant_b, -0.0) {
                    return a;
                }
                if let Some(inner) = self.unary_of(b, Unary::Negate) {
                    return self.binary(Binary::Subtract, a, inner);
                }
                if let Some(inner) = self.unary_of(a, Unary::Negate) {
                    return self.binary(Binary::Subtract, b, inner);
                }
            }
            Binary::Subtract => {
                if is(constant_b, 0.0) {
                    return a;
                }
                if let Some(inner) = self.unary_of(b, Unary::Negate) {
                    return self.binary(Binary::Add, a, inner);
                }
            }
            Binary::Multiply => {
                for (constant, other) in [(constant_a, b), (constant_b, a)] {
                    if is(constant, 1.0) {
                        return other;
                    }
                    if is(constant, -1.0) {
                        return self.unary(Unary::Negate, other);
                    }
                }
            }
            Binary::Divide => {
                if let Some(inverse) = constant_b.and_then(exact_inverse) {
                    let inverse = self.constant(inverse);
                    return self.binary(Binary::Multiply, a, inverse);
                }
            }
            Binary::Minimum | Binary::Maximum if a == b => return a,
            Binary::Power => return self.power(a, b),
            _ => {}
        }
        // One order for what has none, so that y·x is found to be x·y.
        let (a, b) = match function {
            Binary::Add | Binary::Multiply | Binary::Equal | Binary::NotEqual | Binary::And | Binary::Or => {
                (a.min(b), a.max(b))
            }
            _ => (a, b),
        };
        self.fold(Operation::Binary { function, a, b })
    }

    /// Whole exponents up to 64 become multiplications, 1/2 a square root, and powers of e the exponential function: these are
    /// what the signs mean, not approximations of something else.
    fn power(&mut self, a: Id, b: Id) -> Id {
        if let Some(exponent) = self.constant_of(b) {
            if exponent == 0.5 {
                return self.unary(Unary::SquareRoot, a);
            }
            if exponent == exponent.trunc() && exponent.abs() <= GREATEST_EXPONENT {
                let power = match exponent.abs() as u8 {
                    0 => return self.constant(1.0),
                    1 => a,
                    exponent => self.operation(Operation::WholePower { base: a, exponent }),
                };
                if exponent > 0.0 {
                    return power;
                }
                let one = self.constant(1.0);
                return self.binary(Binary::Divide, one, power);
            }
        }
        if self.constant_of(a).is_some_and(|base| base == E) {
            return self.unary(Unary::Exp, b);
        }
        self.fold(Operation::Binary { function: Binary::Power, a, b })
    }

    pub(crate) fn select(&mut self, condition: Id, yes: Id, no: Id) -> Id {
        if yes == no {
            return yes;
        }
        if let Some(condition) = self.constant_of(condition) {
            return if select(condition, 1.0, 0.0) == 1.0 { yes } else { no };
        }
        self.push(Node::Operation(Operation::Select { condition, yes, no }))
    }

    /// Folds a list with a function of two, pairwise, so that rounding and depth grow slowly. An empty list gives `empty`.
    pub(crate) fn reduce(&mut self, function: Binary, ids: &[Id], empty: f64) -> Id {
        let mut row = ids.to_vec();
        while row.len() > 1 {
            row = row
                .chunks(2)
                .map(|pair| if let [a, b] = pair { self.binary(function, *a, *b) } else { pair[0] })
                .collect();
        }
        row.first().copied().unwrap_or_else(|| self.constant(empty))
    }
}

/// One divided by a power of two, where that is exact and neither infinite nor small beyond full precision.
fn exact_inverse(value: f64) -> Option<f64> {
    let is_power = value.is_normal() && value.to_bits() << 12 == 0;
    Some(1.0 / value).filter(|inverse| is_power && inverse.is_normal())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shared_steps_stand_once() {
        let mut graph = Graph::default();
        let (x, y) = (graph.variable("x"), graph.variable("y"));
        let product = graph.binary(Binary::Multiply, x, y);
        let swapped = graph.binary(Binary::Multiply, y, x);
        assert_eq!(product, swapped);
        assert_eq!(graph.nodes().len(), 3);
    }

    #[test]
    fn dead_steps_are_left_out() {
        let mut graph = Graph::default();
        let (x, y) = (graph.variable("x"), graph.variable("y"));
        graph.unary(Unary::Sin, x);
        let root = graph.unary(Unary::Cos, y);
        let (nodes, names) = graph.finish(root);
        assert_eq!((nodes.len(), names), (2, vec!["y".to_owned()]));
    }

    #[test]
    fn only_powers_of_two_have_exact_inverses() {
        assert_eq!(exact_inverse(8.0), Some(0.125));
        assert_eq!(exact_inverse(-0.5), Some(-2.0));
        for other in
            [3.0, 0.0, f64::INFINITY, f64::NAN, f64::MAX, 5e-324, f64::from_bits(0x7fe0_0000_0000_0000)]
        {
            assert_eq!(exact_inverse(other), None, "{other}");
        }
    }
}
