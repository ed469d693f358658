//! Formulas as values that can be put together.

mod combine;
mod functions;

use crate::graph::{Graph, Id, Node};
use crate::operation::{Binary, Operation};
use std::sync::Arc;

/// A calculation of one number from named variables.
///
/// It is a list of steps in which nothing stands twice. Expressions are put together with `+ - * /`, functions like
/// [`sin`](Self::sin) and [`min`](Self::min), and [`substitute`](Self::substitute). A clone is cheap. Every step copies what it
/// is made of, so long rows are better joined by [`least`](Self::least), [`greatest`](Self::greatest) and [`sum`](Self::sum)
/// than one by one.
///
/// ```
/// use luch_formula::{Expression, Tape};
///
/// let [x, y] = ["x", "y"].map(Expression::variable);
/// let disc = (x.squared() + y.squared()).sqrt() - 1.0;
/// let moved = disc.substitute(&[("x", &x - 3.0)]);
/// let both = disc.min(&moved);
/// let tape = Tape::new(&both, &["x", "y"]).unwrap();
/// assert_eq!(tape.value(&[3.0, 0.5]), -0.5);
/// ```
///
/// Two expressions are equal if they are the same steps in the same order: equal ones have equal values, and so may unequal
/// ones.
#[derive(Clone, Debug, PartialEq)]
pub struct Expression {
    /// Each after its operands; the last is the value.
    nodes: Arc<[Node]>,
    names: Arc<[String]>,
}

impl Expression {
    pub(crate) fn from_graph(graph: &Graph, root: Id) -> Self {
        let (nodes, names) = graph.finish(root);
        Self { nodes: nodes.into(), names: names.into() }
    }

    /// A number.
    pub fn constant(value: f64) -> Self {
        let mut graph = Graph::default();
        let root = graph.constant(value);
        Self::from_graph(&graph, root)
    }

    /// A variable.
    pub fn variable(name: &str) -> Self {
        let mut graph = Graph::default();
        let root = graph.variable(name);
        Self::from_graph(&graph, root)
    }

    /// The names of the variables its value depends on, in the order of their first use.
    pub fn variables(&self) -> &[String] {
        &self.names
    }

    /// Its value, if it depends on nothing.
    pub fn as_constant(&self) -> Option<f64> {
        match *self.nodes {
            [Node::Constant(value)] => Some(value),
            _ => None,
        }
    }

    /// How many operations one evaluation takes.
    pub fn operations(&self) -> usize {
        self.nodes.iter().filter(|node| matches!(node, Node::Operation(_))).count()
    }

    /// The same with expressions in the place of variables, all at once: what is put in is not looked into again. Names that
    /// do not occur are ignored; of a name given twice the first counts.
    pub fn substitute<E: Into<Expression> + Clone>(&self, replacements: &[(&str, E)]) -> Self {
        let mut graph = Graph::default();
        let known: Vec<(&str, Self)> =
            replacements.iter().map(|(name, with)| (*name, with.clone().into())).collect();
        let mut places = vec![None; self.names.len()];
        let root = graph.add_nodes(&self.nodes, |graph, number| {
            *places[number as usize].get_or_insert_with(|| {
                let name = &self.names[number as usize];
                match known.iter().find(|(replaced, _)| replaced == name) {
                    Some((_, with)) => with.add_to(graph),
                    None => graph.variable(name),
                }
            })
        });
        Self::from_graph(&graph, root)
    }

    /// Adds it to a calculation; returns its root.
    pub(crate) fn add_to(&self, graph: &mut Graph) -> Id {
        graph.add_nodes(&self.nodes, |graph, number| graph.variable(&self.names[number as usize]))
    }

    /// A calculation made of some expressions.
    pub(crate) fn build(parts: &[&Self], build: impl FnOnce(&mut Graph, &[Id]) -> Id) -> Self {
        let mut graph = Graph::default();
        let ids: Vec<Id> = parts.iter().map(|part| part.add_to(&mut graph)).collect();
        let root = build(&mut graph, &ids);
        Self::from_graph(&graph, root)
    }

    fn reduce(function: Binary, parts: &[Self], empty: f64) -> Self {
        let parts: Vec<&Self> = parts.iter().collect();
        Self::build(&parts, |graph, ids| graph.reduce(function, ids, empty))
    }

    /// The least of all; infinite if there are none.
    pub fn least(parts: &[Self]) -> Self {
        Self::reduce(Binary::Minimum, parts, f64::INFINITY)
    }

    /// The greatest of all; minus infinite if there are none.
    pub fn greatest(parts: &[Self]) -> Self {
        Self::reduce(Binary::Maximum, parts, f64::NEG_INFINITY)
    }

    /// The sum of all, added in pairs; zero if there are none.
    pub fn sum(parts: &[Self]) -> Self {
        Self::reduce(Binary::Add, parts, 0.0)
    }

    /// `yes` where this is true (neither zero nor undefined), else `no`.
    pub fn select(&self, yes: &Self, no: &Self) -> Self {
        Self::build(&[self, yes, no], |graph, ids| graph.select(ids[0], ids[1], ids[2]))
    }

    /// Smooth noise between −1 and 1 at a place, zero at whole points.
    pub fn noise(place: [&Self; 3]) -> Self {
        Self::build(&place, |graph, ids| {
            graph.operation(Operation::Noise { x: ids[0], y: ids[1], z: ids[2] })
        })
    }
}

impl From<f64> for Expression {
    fn from(value: f64) -> Self {
        Self::constant(value)
    }
}

impl From<&Expression> for Expression {
    fn from(value: &Expression) -> Self {
        value.clone()
    }
}
