//! The first root along a line, with a guarantee.
//!
//! A formula that is a polynomial becomes one of the parameter first, see [`polynomial`]; all others, and the places where
//! rounding hides the signs of a polynomial, go by ranges, see [`intervals`].

mod intervals;
mod polynomial;

use crate::interval::{Interval, IntervalDerivative};
use crate::tape::Tape;

/// What a search along a line found. Parameters are those of the line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FirstRoot {
    /// There is none.
    None,
    /// A continuous function changes its sign within the tolerance of this parameter, and has no root before it.
    Crossing(f64),
    /// Zero cannot be told from the values here, and the sign stays: the function touches zero (a double root), or comes so
    /// near that rounding, or a piece as short as the tolerance, does not show the difference. Nothing before it.
    Touching(f64),
    /// The sign changes, but nothing vouches for continuity: a jump, or a root of infinite slope. Nothing before it.
    Jump(f64),
    /// The steps are used up. Nothing before this parameter; unknown from there.
    Exhausted(f64),
}

impl FirstRoot {
    /// Where a root is, in the sense of [`Crossing`](Self::Crossing) or [`Touching`](Self::Touching).
    pub fn parameter(&self) -> Option<f64> {
        match *self {
            Self::Crossing(parameter) | Self::Touching(parameter) => Some(parameter),
            Self::None | Self::Jump(_) | Self::Exhausted(_) => None,
        }
    }
}

/// Looks for roots of a tape's first output along lines.
///
/// ```
/// use luch_formula::{FirstRoot, RootFinder, Tape, parse};
///
/// let variables = ["x", "y", "z"];
/// let ball = Tape::new(&parse("x^2 + y^2 + z^2 - 1", &variables).unwrap(), &variables).unwrap();
/// let mut finder = RootFinder::new(&ball, 1e-9);
/// let hit = finder.first(&[0.0, 0.0, -5.0], &[0.0, 0.0, 1.0], 0.0, 100.0);
/// assert!(matches!(hit, FirstRoot::Crossing(t) if (t - 4.0).abs() < 1e-9));
/// let miss = finder.first(&[2.0, 0.0, -5.0], &[0.0, 0.0, 1.0], 0.0, 100.0);
/// assert_eq!(miss, FirstRoot::None);
/// ```
#[derive(Clone, Debug)]
pub struct RootFinder<'t> {
    tape: &'t Tape,
    tolerance: f64,
    most_steps: usize,
    intervals_only: bool,
    steps: usize,
    registers: Vec<IntervalDerivative>,
    inputs: Vec<IntervalDerivative>,
    sides: Vec<Interval>,
    point: Vec<f64>,
    waiting: Vec<Piece>,
    room: Vec<f64>,
    parts: Vec<polynomial::Part>,
}

/// Steps of a search unless others are asked for.
const MOST_STEPS: usize = 20_000;

/// The farthest parameter.
const FARTHEST: f64 = 1e300;

#[derive(Clone, Copy, Debug)]
struct Piece {
    first: f64,
    last: f64,
}

/// The line of one search.
#[derive(Clone, Copy)]
struct Line<'l> {
    origin: &'l [f64],
    direction: &'l [f64],
}

impl<'t> RootFinder<'t> {
    /// A finder whose roots are right to the tolerance. A tolerance below the resolution of numbers, or none, means as near as
    /// numbers come.
    pub fn new(tape: &'t Tape, tolerance: f64) -> Self {
        // Room is taken when it is needed.
        Self {
            tape,
            tolerance: if tolerance > 0.0 { tolerance } else { 0.0 },
            most_steps: MOST_STEPS,
            intervals_only: false,
            steps: 0,
            registers: Vec::new(),
            inputs: Vec::new(),
            sides: Vec::new(),
            point: Vec::new(),
            waiting: Vec::new(),
            room: Vec::new(),
            parts: Vec::new(),
        }
    }

    /// Another budget: pieces that are looked at in one search. The default is 20 000; a smooth function takes some dozens.
    #[must_use]
    pub fn most_steps(mut self, steps: usize) -> Self {
        self.most_steps = steps;
        self
    }

    /// Treats polynomials as all other functions: slower, and the reference that the quick way is tested against.
    #[must_use]
    pub fn intervals_only(mut self) -> Self {
        self.intervals_only = true;
        self
    }

    /// The first root of f(origin + t · direction) for t from `first` to `last`, both included.
    ///
    /// A pole is no root: where the values stay unbounded in the shortest piece it is passed over. Infinite ends are cut to
    /// 1e300; an empty range, or one with an end that is not a number, has no root.
    ///
    /// # Panics
    ///
    /// If origin or direction have not one coordinate for each input of the tape.
    pub fn first(&mut self, origin: &[f64], direction: &[f64], first: f64, last: f64) -> FirstRoot {
        let inputs = self.tape.inputs();
        assert!(origin.len() == inputs && direction.len() == inputs, "a coordinate for each input");
        if first.is_nan() || last.is_nan() || first > last {
            return FirstRoot::None;
        }
        let line = Line { origin, direction };
        let piece = Piece { first: first.max(-FARTHEST), last: last.min(FARTHEST) };
        self.steps = 0;
        match self.tape.along() {
            Some(along) if !self.intervals_only => self.by_polynomial(along, line, piece, 0),
            _ => self.by_intervals(line, piece),
        }
    }
}

/// The first root of a tape of one variable, right to the tolerance; see [`RootFinder::first`] for what is told about it.
///
/// ```
/// use luch_formula::{Tape, first_root, parse};
///
/// let cubic = Tape::new(&parse("(t - 1)*(t - 2)*(t - 3)", &["t"]).unwrap(), &["t"]).unwrap();
/// let root = first_root(&cubic, 1.5, 10.0, 1e-12).unwrap();
/// assert!((root - 2.0).abs() < 1e-12);
/// assert_eq!(first_root(&cubic, 4.0, 10.0, 1e-12), None);
/// ```
///
/// # Panics
///
/// If the tape has not exactly one input.
pub fn first_root(tape: &Tape, first: f64, last: f64, tolerance: f64) -> Option<f64> {
    RootFinder::new(tape, tolerance).first(&[0.0], &[1.0], first, last).parameter()
}
