//! A formula in text becomes a fast function.
//!
//! ```
//! use luch_formula::{Formula, Tape};
//!
//! let variables = ["x", "y", "z"];
//! let formula = Formula::new("(x^2 + 9/4*y^2 + z^2 - 1)^3 - x^2*z^3 - 9/80*y^2*z^3");
//! let heart = formula.parse(&variables)?;
//! let tape = Tape::new(&heart, &variables)?;
//! assert_eq!(tape.value(&[0.0, 0.0, 0.0]), -1.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # The steps
//!
//! 1. [`Formula`]: text and parameters, as they are stored. [`FormulaError`] tells what is wrong in it and where.
//! 2. [`Expression`]: the calculation, to be put together with others: unions, blends, moves, substitution.
//! 3. [`Tape`]: the calculation compiled for an ordered list of variables. It gives
//!    values ([`value`](Tape::value), in bulk [`evaluate`](Tape::evaluate)),
//!    derivatives ([`gradient`](Tape::gradient), [`gradients`](Tape::gradients)),
//!    ranges over boxes ([`interval`](Tape::interval), [`interval_derivative`](Tape::interval_derivative)),
//!    and shorter tapes for boxes ([`trace`](Tape::trace), [`simplify`](Tape::simplify)).
//! 4. [`RootFinder`]: the first root along a ray, proven to be the first.
//!
//! All evaluators give the same bits, one point or many, on every machine and with all vector instructions.
//!
//! # The language
//!
//! | | |
//! |---|---|
//! | numbers | `2`, `0.5`, `1.5e-3` |
//! | constants | `pi`, `tau`, `e`, `phi` (the golden ratio), `inf`, `nan`; the caller's names come before them |
//! | operators, weakest first | `or`; `and`; `not`; `<` `<=` `>` `>=` `==` `!=`; `+` `-`; `*` `/`; unary `-`; `^` |
//! | powers | from right to left: `2^3^2` is `2^9`, `-x^2` is `-(x^2)`, and `2^-1` is allowed |
//! | products without a sign | after a number only: `2x`, `2(x + 1)`, `2x^2`; not after `/` or `^`, where they could mean two things |
//! | truth | comparisons give 1 or 0; true is what is neither 0 nor undefined |
//! | choices | `if(x > 0, a, b)` |
//! | definitions | `r = hypot(x, y); r^2 + z^2 - 1` |
//! | functions | see [`functions`] |
//!
//! Minimum and maximum give the defined number where one is not, so that a union survives a hole in one of its parts.
//!
//! ```
//! use luch_formula::{Expression, parse};
//!
//! let value = |text| parse(text, &[]).map(|expression: Expression| expression.as_constant().unwrap());
//! assert_eq!(value("-3^2"), Ok(-9.0));
//! assert_eq!(value("2^3^2"), Ok(512.0));
//! assert_eq!(value("1 < 2 and not 3 < 2"), Ok(1.0));
//! assert_eq!(value("a = 2; b = 3a; a*b"), Ok(12.0));
//! println!("{}", value("2 * (3 + 4").unwrap_err());
//! // expected an operator or `)`, found the end
//! //  1 | 2 * (3 + 4
//! //    |           ^
//! ```

mod error;
mod expression;
mod formula;
mod graph;
mod interval;
mod noise;
mod operation;
mod parser;
mod root;
mod simd;
mod special;
mod tape;
mod token;

pub use error::{FormulaError, FormulaErrorKind};
pub use expression::Expression;
pub use formula::{
    ConstantDescription, Formula, FunctionDescription, constants, functions, parse, parse_equation,
};
pub use interval::{Interval, IntervalDerivative};
pub use root::{FirstRoot, RootFinder, first_root};
pub use simd::Level;
pub use tape::{Choices, Evaluator, Tape, TapeError, Traced};

/// The page of the crate is run as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
