//! A formula as a user keeps it: its text and its parameters.

use crate::error::FormulaError;
use crate::expression::Expression;
use crate::parser::{self, CONSTANTS, FUNCTIONS, Form, usage};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// A text and the values of its parameters: plain data that can be stored and compared.
///
/// ```
/// use luch_formula::Formula;
///
/// let ring = Formula::new("(hypot(x, y) - major)^2 + z^2 = minor^2").with("major", 2.0).with("minor", 0.5);
/// let solid = ring.parse_equation(&["x", "y", "z"]).unwrap();
/// assert_eq!(solid.variables(), ["x", "y", "z"]);
/// ```
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Formula {
    /// As it was written.
    pub text: String,
    /// The values of names in the text that are not variables.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub parameters: BTreeMap<String, f64>,
}

impl Formula {
    /// A text without parameters.
    pub fn new(text: impl Into<String>) -> Self {
        Self { text: text.into(), parameters: BTreeMap::new() }
    }

    /// The same with one parameter more, or with another value of it.
    #[must_use]
    pub fn with(mut self, name: impl Into<String>, value: f64) -> Self {
        self.parameters.insert(name.into(), value);
        self
    }

    /// Reads the formula as a number that depends on the variables.
    ///
    /// # Errors
    ///
    /// The text is not a formula, or a name is unknown, or a name is given twice.
    pub fn parse(&self, variables: &[&str]) -> Result<Expression, FormulaError> {
        self.read(variables, Form::Value)
    }

    /// Reads the formula as an equation: `a = b` means a − b, and a text without `=` is taken as it is.
    ///
    /// # Errors
    ///
    /// As [`parse`](Self::parse).
    pub fn parse_equation(&self, variables: &[&str]) -> Result<Expression, FormulaError> {
        self.read(variables, Form::Equation)
    }

    fn read(&self, variables: &[&str], form: Form) -> Result<Expression, FormulaError> {
        let parameters = self.parameters.iter().map(|(name, value)| (name.as_str(), *value));
        parser::read(&self.text, variables, parameters, form)
    }
}

/// Reads a formula without parameters.
///
/// # Errors
///
/// As [`Formula::parse`].
pub fn parse(text: &str, variables: &[&str]) -> Result<Expression, FormulaError> {
    parser::read(text, variables, std::iter::empty(), Form::Value)
}

/// Reads an equation without parameters.
///
/// # Errors
///
/// As [`Formula::parse`].
pub fn parse_equation(text: &str, variables: &[&str]) -> Result<Expression, FormulaError> {
    parser::read(text, variables, std::iter::empty(), Form::Equation)
}

/// A function of the language, for help texts.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FunctionDescription {
    /// Its name.
    pub name: &'static str,
    /// How it is written: `atan2(y, x)`.
    pub usage: String,
    /// What it gives.
    pub meaning: &'static str,
}

/// All functions of the language, by kind.
pub fn functions() -> Vec<FunctionDescription> {
    let described = |function: &parser::Function| {
        let parser::Function { name, meaning, .. } = *function;
        FunctionDescription { name, usage: usage(function), meaning }
    };
    FUNCTIONS.iter().map(described).collect()
}

/// A constant of the language.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConstantDescription {
    /// Its name.
    pub name: &'static str,
    /// Its value.
    pub value: f64,
}

/// All constants of the language.
pub fn constants() -> Vec<ConstantDescription> {
    CONSTANTS.iter().map(|&(name, value)| ConstantDescription { name, value }).collect()
}
