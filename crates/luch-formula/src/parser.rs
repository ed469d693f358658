//! From text to a calculation: operator precedence by one loop, with a limit on depth.
//!
//! Precedence, weakest first: `or`; `and`; `not`; comparisons; `+ -`; `* /`; unary `-`; `^`, which goes from right to left and
//! takes a sign in its exponent. The calculation grows while the text is read; there is no tree that could be too deep to drop.

mod functions;
mod names;

pub(crate) use functions::{FUNCTIONS, Function, usage};
pub(crate) use names::CONSTANTS;

use crate::error::{FormulaError, FormulaErrorKind};
use crate::expression::Expression;
use crate::graph::{Graph, Id};
use crate::operation::{Binary, Unary};
use crate::token::{Piece, Token, is_name, tokens};
use names::{KEYWORDS, closest};
use std::collections::HashMap;
use std::ops::Range;

/// The longest text that is read, in bytes.
pub(crate) const LONGEST: usize = 1 << 20;

/// How deep things may stand inside one another.
pub(crate) const DEEPEST: usize = 200;

/// Whether `a = b` may stand at the end.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Form {
    Value,
    Equation,
}

/// Reads a formula whose free names are the variables and parameters.
pub(crate) fn read<'a>(
    text: &str,
    variables: &[&str],
    parameters: impl Iterator<Item = (&'a str, f64)>,
    form: Form,
) -> Result<Expression, FormulaError> {
    if text.len() > LONGEST {
        let kind = FormulaErrorKind::TooLong { length: text.len(), limit: LONGEST };
        return Err(FormulaError::new(kind, 0..0, ""));
    }
    let mut parser = Parser {
        text,
        tokens: tokens(text)?,
        at: 0,
        depth: 0,
        graph: Graph::default(),
        names: HashMap::new(),
        given: Vec::new(),
    };
    for name in variables {
        let id = parser.graph.variable(name);
        parser.give(name, id)?;
    }
    for (name, value) in parameters {
        let id = parser.graph.constant(value);
        parser.give(name, id)?;
    }
    let root = parser.formula(form)?;
    Ok(Expression::from_graph(&parser.graph, root))
}

struct Parser<'t> {
    text: &'t str,
    tokens: Vec<Token>,
    at: usize,
    depth: usize,
    graph: Graph,
    names: HashMap<String, Id>,
    /// The names in the order in which they were given.
    given: Vec<String>,
}

/// How tightly operators hold, weakest first.
mod level {
    pub(super) const OR: u8 = 1;
    pub(super) const AND: u8 = 2;
    pub(super) const NOT: u8 = 3;
    pub(super) const COMPARE: u8 = 4;
    pub(super) const SUM: u8 = 5;
    pub(super) const PRODUCT: u8 = 6;
    pub(super) const SIGN: u8 = 7;
    pub(super) const POWER: u8 = 8;
}

impl Parser<'_> {
    /// Takes a name of the caller.
    fn give(&mut self, name: &str, id: Id) -> Result<(), FormulaError> {
        let reason = if !is_name(name) {
            Some("is not a name: it needs letters, digits and underscores, and no digit first")
        } else if KEYWORDS.contains(&name) {
            Some("is a word of the language")
        } else if self.names.contains_key(name) {
            Some("is given twice")
        } else {
            None
        };
        if let Some(reason) = reason {
            return Err(self.bad_name(name, reason, 0..0));
        }
        self.names.insert(name.to_owned(), id);
        self.given.push(name.to_owned());
        Ok(())
    }

    fn bad_name(&self, name: &str, reason: &str, span: Range<usize>) -> FormulaError {
        let kind = FormulaErrorKind::BadName { name: name.to_owned(), reason: reason.to_owned() };
        self.error(kind, span)
    }

    fn error(&self, kind: FormulaErrorKind, span: Range<usize>) -> FormulaError {
        FormulaError::new(kind, span, self.text)
    }

    fn piece(&self) -> &Piece {
        &self.tokens[self.at].piece
    }

    fn span(&self) -> Range<usize> {
        self.tokens[self.at].span.clone()
    }

    fn word(&self) -> &str {
        &self.text[self.span()]
    }

    /// Steps over a piece; the end stays.
    fn advance(&mut self) {
        self.at = (self.at + 1).min(self.tokens.len() - 1);
    }

    fn found(&self) -> String {
        match self.piece() {
            Piece::End => "the end".into(),
            _ => format!("`{}`", self.word()),
        }
    }

    fn unexpected(&self, expected: &str, hint: &str) -> FormulaError {
        let kind = FormulaErrorKind::Unexpected {
            expected: expected.to_owned(),
            found: self.found(),
            hint: hint.to_owned(),
        };
        self.error(kind, self.span())
    }

    /// Definitions, each with its semicolon, and the value.
    fn formula(&mut self, form: Form) -> Result<Id, FormulaError> {
        let last_semicolon = self.tokens.iter().rposition(|token| token.piece == Piece::Semicolon);
        while last_semicolon.is_some_and(|last| self.at <= last) {
            self.definition()?;
        }
        let value = self.expression(0)?;
        match (self.piece(), form) {
            (Piece::End, _) => Ok(value),
            (Piece::Assign, Form::Equation) => {
                self.advance();
                let other = self.expression(0)?;
                match self.piece() {
                    Piece::End => Ok(self.graph.binary(Binary::Subtract, value, other)),
                    _ => Err(self.unexpected("the end", "an equation has two sides")),
                }
            }
            _ => Err(self.after_value("an operator or the end")),
        }
    }

    /// `name = value;`
    fn definition(&mut self) -> Result<(), FormulaError> {
        let (name, span) = (self.word().to_owned(), self.span());
        if *self.piece() != Piece::Name || self.tokens[self.at + 1].piece != Piece::Assign {
            // Whatever is wrong with the value comes first.
            if *self.piece() != Piece::Semicolon {
                self.expression(0)?;
                if *self.piece() != Piece::Semicolon {
                    return Err(self.after_value("an operator or the end"));
                }
            }
            return Err(self.unexpected("a definition before it", "write name = value; and the formula last"));
        }
        if KEYWORDS.contains(&name.as_str()) {
            return Err(self.bad_name(&name, "is a word of the language", span));
        }
        if self.names.contains_key(&name) {
            return Err(self.bad_name(&name, "has a meaning already", span));
        }
        self.advance();
        self.advance();
        let value = self.expression(0)?;
        if *self.piece() != Piece::Semicolon {
            return Err(self.after_value("an operator or `;`"));
        }
        self.advance();
        self.names.insert(name.clone(), value);
        self.given.push(name);
        Ok(())
    }

    /// The error for a piece that follows a value and may not.
    fn after_value(&self, expected: &str) -> FormulaError {
        let hint = match self.piece() {
            Piece::Open | Piece::Name | Piece::Number(_) => "write * between factors",
            Piece::Assign => "== compares; name = value; defines",
            Piece::Close => "there is no ( to it",
            _ => "",
        };
        self.unexpected(expected, hint)
    }

    /// What holds at least as tightly as `least`.
    fn expression(&mut self, least: u8) -> Result<Id, FormulaError> {
        self.depth += 1;
        if self.depth > DEEPEST {
            return Err(self.error(FormulaErrorKind::TooDeep { limit: DEEPEST }, self.span()));
        }
        let mut value = self.operand(least)?;
        while let Some((function, held)) = self.operator()
            && held >= least
        {
            self.advance();
            // The power goes from right to left, and its exponent may have a sign.
            let right = self.expression(if held == level::POWER { level::SIGN } else { held + 1 })?;
            value = self.apply(function, value, right);
            if held == level::COMPARE && self.operator().is_some_and(|(_, next)| next == level::COMPARE) {
                let hint = "write a < b and b < c";
                return Err(self.unexpected("an end of the comparison", hint));
            }
        }
        self.depth -= 1;
        Ok(value)
    }

    /// Whether the number here, with its signs, is a divisor or an exponent: `1/2x` and `2^3x` could mean two things each.
    fn is_ambiguous_before_factor(&self) -> bool {
        let before = self.tokens[..self.at].iter().rev();
        let unsigned =
            before.map(|token| &token.piece).find(|piece| !matches!(piece, Piece::Plus | Piece::Minus));
        matches!(unsigned, Some(Piece::Over | Piece::Power))
    }

    /// Whether the piece here could be a factor after a number.
    fn is_factor(&self) -> bool {
        match self.piece() {
            Piece::Open => true,
            Piece::Name => !KEYWORDS.contains(&self.word()),
            _ => false,
        }
    }

    fn operator(&self) -> Option<(Operator, u8)> {
        use Operator::{Of, Swapped};
        Some(match self.piece() {
            Piece::Plus => (Of(Binary::Add), level::SUM),
            Piece::Minus => (Of(Binary::Subtract), level::SUM),
            Piece::Times => (Of(Binary::Multiply), level::PRODUCT),
            Piece::Over => (Of(Binary::Divide), level::PRODUCT),
            Piece::Power => (Of(Binary::Power), level::POWER),
            Piece::Less => (Of(Binary::Less), level::COMPARE),
            Piece::LessOrEqual => (Of(Binary::LessOrEqual), level::COMPARE),
            Piece::Greater => (Swapped(Binary::Less), level::COMPARE),
            Piece::GreaterOrEqual => (Swapped(Binary::LessOrEqual), level::COMPARE),
            Piece::Equal => (Of(Binary::Equal), level::COMPARE),
            Piece::NotEqual => (Of(Binary::NotEqual), level::COMPARE),
            Piece::Name if self.word() == "and" => (Of(Binary::And), level::AND),
            Piece::Name if self.word() == "or" => (Of(Binary::Or), level::OR),
            _ => return None,
        })
    }

    fn apply(&mut self, operator: Operator, left: Id, right: Id) -> Id {
        match operator {
            Operator::Of(function) => self.graph.binary(function, left, right),
            Operator::Swapped(function) => self.graph.binary(function, right, left),
        }
    }

    fn operand(&mut self, least: u8) -> Result<Id, FormulaError> {
        match *self.piece() {
            Piece::Number(value) => {
                let ambiguous = self.is_ambiguous_before_factor();
                self.advance();
                let number = self.graph.constant(value);
                if !self.is_factor() {
                    return Ok(number);
                }
                if ambiguous {
                    let hint = "write * and parentheses: this could mean two things";
                    return Err(self.unexpected("an operator", hint));
                }
                let factor = self.expression(level::SIGN)?;
                Ok(self.graph.binary(Binary::Multiply, number, factor))
            }
            Piece::Minus => {
                self.advance();
                let value = self.expression(level::SIGN)?;
                Ok(self.graph.unary(Unary::Negate, value))
            }
            Piece::Plus => {
                self.advance();
                self.expression(level::SIGN)
            }
            Piece::Open => {
                self.advance();
                let value = self.expression(0)?;
                if *self.piece() != Piece::Close {
                    return Err(self.after_value("an operator or `)`"));
                }
                self.advance();
                Ok(value)
            }
            Piece::Name if self.word() == "not" => {
                if least > level::NOT {
                    return Err(self.unexpected("a value", "put (not …) in parentheses"));
                }
                self.advance();
                let value = self.expression(level::NOT)?;
                Ok(self.graph.unary(Unary::Not, value))
            }
            Piece::Name if !KEYWORDS.contains(&self.word()) => self.named(),
            _ => Err(self.unexpected("a value", "")),
        }
    }

    /// A name, or a function with its arguments.
    fn named(&mut self) -> Result<Id, FormulaError> {
        let (name, span) = (self.word().to_owned(), self.span());
        self.advance();
        let called = *self.piece() == Piece::Open;
        if let Some(&id) = self.names.get(&name) {
            if called {
                return Err(self.unexpected("an operator", &format!("write {name}*(…) for a product")));
            }
            return Ok(id);
        }
        if called {
            return self.call(&name, span);
        }
        if let Some((_, value)) = CONSTANTS.iter().find(|(constant, _)| *constant == name) {
            return Ok(self.graph.constant(*value));
        }
        if let Some(function) = FUNCTIONS.iter().find(|function| function.name == name) {
            let hint = format!("{name} is a function: write {}", usage(function));
            return Err(self.unexpected("`(`", &hint));
        }
        let constants = CONSTANTS.iter().map(|(name, _)| *name);
        let candidates = self.given.iter().map(String::as_str).chain(constants);
        let kind = FormulaErrorKind::UnknownName {
            suggestion: closest(&name, candidates),
            known: self.given.clone(),
            name,
        };
        Err(self.error(kind, span))
    }

    fn call(&mut self, name: &str, span: Range<usize>) -> Result<Id, FormulaError> {
        let Some(function) = FUNCTIONS.iter().find(|function| function.name == name) else {
            let names = FUNCTIONS.iter().map(|function| function.name);
            let kind = FormulaErrorKind::UnknownFunction {
                name: name.to_owned(),
                suggestion: closest(name, names.clone()),
                known: names.map(str::to_owned).collect(),
            };
            return Err(self.error(kind, span));
        };
        self.advance();
        let mut arguments = Vec::new();
        if *self.piece() == Piece::Close {
            self.advance();
        } else {
            loop {
                arguments.push(self.expression(0)?);
                match self.piece() {
                    Piece::Comma => self.advance(),
                    Piece::Close => break self.advance(),
                    _ => return Err(self.after_value("an operator, `,` or `)`")),
                }
            }
        }
        let whole = span.start..self.tokens[self.at - 1].span.end;
        if !function.accepts(arguments.len()) {
            let kind = FormulaErrorKind::ArgumentCount {
                function: name.to_owned(),
                accepted: function.accepted(),
                given: arguments.len(),
                usage: usage(function),
            };
            return Err(self.error(kind, whole));
        }
        (function.build)(&mut self.graph, &arguments)
            .map_err(|what| self.error(FormulaErrorKind::BadArgument { what }, whole))
    }
}

/// An operator as a function of its sides, or of its sides swapped.
#[derive(Clone, Copy)]
enum Operator {
    Of(Binary),
    Swapped(Binary),
}
