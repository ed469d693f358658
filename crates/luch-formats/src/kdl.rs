//! KDL 2.0 (<https://kdl.dev/spec>), read from hostile hands: a text becomes nodes with the place of everything in it.
//!
//! Written here because a scene file may come from anywhere: time and memory grow in proportion to the text, nesting is
//! bounded, and reading goes on after a mistake, so that all of them are told at once. Tests compare the result with
//! that of the `kdl` crate.

mod node;
mod number;
mod scanner;
mod string;
#[cfg(test)]
mod tests;

pub(crate) use node::parse;
use std::ops::Range;

/// Most blocks inside one another.
pub(crate) const DEEPEST: usize = 48;

/// A node: a name, values, and further nodes in a block.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Node {
    pub(crate) name: Word,
    /// Arguments and properties in the order they are written.
    pub(crate) entries: Vec<Entry>,
    pub(crate) children: Vec<Node>,
}

/// An argument, or a property if it has a name.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Entry {
    pub(crate) name: Option<Word>,
    pub(crate) value: Value,
    /// Bytes of the value.
    pub(crate) span: Range<usize>,
}

/// A name and its bytes in the text.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Word {
    pub(crate) text: String,
    pub(crate) span: Range<usize>,
}

/// What an argument or property may be.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Value {
    Text(String),
    Integer(i128),
    Float(f64),
    Bool(bool),
    Null,
}

/// A mistake in the text.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct SyntaxError {
    pub(crate) span: Range<usize>,
    pub(crate) message: String,
    pub(crate) help: Option<&'static str>,
}
