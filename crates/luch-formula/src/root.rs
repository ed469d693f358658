//! The first root along a line, with a guarantee.
//!
//! The piece in question is halved, the near half first. A piece whose range of values holds no zero has no root; nor has one
//! that the mean value theorem proves free of it: f(m) + f′·(t − m). Where the range of derivatives holds no zero the function
//! is monotone, signs at the ends decide, and a bracketing method finds the root. The idea is that of Mitchell (1990),
//! "Robust ray intersection with interval arithmetic".

use crate::interval::{Interval, IntervalDerivative, binary};
use crate::operation::Binary;
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
    registers: Vec<IntervalDerivative>,
    inputs: Vec<IntervalDerivative>,
    sides: Vec<Interval>,
    point: Vec<f64>,
    waiting: Vec<Piece>,
}

/// Steps of a search unless others are asked for.
const MOST_STEPS: usize = 20_000;

/// A piece with a pole in it is halved until it is this part of the tolerance.
const POLE: f64 = 1e-9;

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
        let zero = IntervalDerivative { value: Interval::ZERO, derivative: Interval::ZERO };
        Self {
            tape,
            tolerance: if tolerance > 0.0 { tolerance } else { 0.0 },
            most_steps: MOST_STEPS,
            registers: vec![zero; tape.registers()],
            inputs: vec![zero; tape.inputs()],
            sides: vec![Interval::ZERO; tape.inputs()],
            point: vec![0.0; tape.inputs()],
            waiting: Vec::new(),
        }
    }

    /// Another budget: pieces that are looked at in one search. The default is 20 000; a smooth function takes some dozens.
    #[must_use]
    pub fn most_steps(mut self, steps: usize) -> Self {
        self.most_steps = steps;
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
        self.waiting.clear();
        self.waiting.push(Piece { first: first.max(-FARTHEST), last: last.min(FARTHEST) });
        let mut steps = 0;
        while let Some(piece) = self.waiting.pop() {
            steps += 1;
            if steps > self.most_steps {
                return FirstRoot::Exhausted(piece.first);
            }
            let found = self.look(line, piece);
            if found != FirstRoot::None {
                return found;
            }
        }
        FirstRoot::None
    }

    /// Looks at a piece; puts its halves back if it is not settled.
    fn look(&mut self, line: Line, piece: Piece) -> FirstRoot {
        let Piece { first, last } = piece;
        let range = self.range(line, first, last);
        if !range.value.contains_zero() {
            return FirstRoot::None;
        }
        let middle = 0.5 * first + 0.5 * last;
        let smooth = range.derivative.is_bounded() && range.value.is_bounded();
        if smooth && first < last {
            let at_middle = self.sure_value(line, middle);
            let reach = binary(
                Binary::Subtract,
                Interval { low: first, high: last, partial: false },
                Interval::point(middle),
                false,
            );
            let change = binary(Binary::Multiply, range.derivative, reach, false);
            let bound = binary(Binary::Add, at_middle, change, false);
            if !bound.contains_zero() {
                return FirstRoot::None;
            }
            if !range.derivative.contains_zero() {
                return self.monotone(line, piece);
            }
        }
        let shortest =
            if range.value.is_bounded() || range.value.partial && range.value.width() < f64::INFINITY {
                self.tolerance
            } else {
                self.tolerance * POLE
            };
        let divisible = first < middle && middle < last;
        if divisible && last - first > shortest {
            self.waiting.push(Piece { first: middle, last });
            self.waiting.push(Piece { first, last: middle });
            return FirstRoot::None;
        }
        if range.value.width() == f64::INFINITY {
            return FirstRoot::None;
        }
        let (at_first, at_last) = (self.value(line, first), self.value(line, last));
        match (at_first < 0.0 && at_last > 0.0) || (at_first > 0.0 && at_last < 0.0) {
            true if smooth => FirstRoot::Crossing(middle),
            true => FirstRoot::Jump(middle),
            false => FirstRoot::Touching(middle),
        }
    }

    /// A piece in which the function is continuous and monotone: the signs at its ends tell.
    fn monotone(&mut self, line: Line, piece: Piece) -> FirstRoot {
        let Piece { first, last } = piece;
        let (at_first, at_last) = (self.value(line, first), self.value(line, last));
        let changes = (at_first < 0.0 && at_last > 0.0) || (at_first > 0.0 && at_last < 0.0);
        if changes {
            return FirstRoot::Crossing(self.bracket(line, piece, at_first, at_last));
        }
        // The sign stays; but where rounding hides it the root may be right there.
        if self.sure_value(line, first).contains_zero() {
            return if at_first == 0.0 { FirstRoot::Crossing(first) } else { FirstRoot::Touching(first) };
        }
        if self.sure_value(line, last).contains_zero() {
            return if at_last == 0.0 { FirstRoot::Crossing(last) } else { FirstRoot::Touching(last) };
        }
        FirstRoot::None
    }

    /// A root between two signs: false position with halved weights (Illinois; Dowell & Jarratt 1971), and halving wherever that
    /// is slow.
    fn bracket(&mut self, line: Line, piece: Piece, at_first: f64, at_last: f64) -> f64 {
        let (mut a, mut b) = (piece.first, piece.last);
        let (mut weight_a, mut weight_b) = (at_first, at_last);
        let mut halve = false;
        loop {
            let width = b - a;
            let middle = 0.5 * a + 0.5 * b;
            if width <= self.tolerance || !(a < middle && middle < b) {
                return middle;
            }
            let slanted = a - weight_a * (width / (weight_b - weight_a));
            // A step from the nearer end at least, so that both ends close in.
            let margin = 0.25 * self.tolerance;
            let guess = if halve || !(slanted > a && slanted < b) {
                middle
            } else {
                slanted.clamp(a + margin.min(0.5 * width), b - margin.min(0.5 * width))
            };
            let value = self.value(line, guess);
            if value == 0.0 || value.is_nan() || !(a < guess && guess < b) {
                return guess;
            }
            if (value < 0.0) == (at_first < 0.0) {
                (a, weight_a, weight_b) = (guess, value, 0.5 * weight_b);
            } else {
                (b, weight_b, weight_a) = (guess, value, 0.5 * weight_a);
            }
            halve = b - a > 0.5 * width;
        }
    }

    fn value(&mut self, line: Line, parameter: f64) -> f64 {
        for ((input, origin), direction) in self.point.iter_mut().zip(line.origin).zip(line.direction) {
            *input = origin + parameter * direction;
        }
        self.tape.value(&self.point)
    }

    /// The range of the value at one parameter: as wide as rounding makes it.
    fn sure_value(&mut self, line: Line, parameter: f64) -> Interval {
        let parameter = Interval::point(parameter);
        for ((side, origin), direction) in self.sides.iter_mut().zip(line.origin).zip(line.direction) {
            *side = along(*origin, *direction, parameter);
        }
        self.tape.interval(&self.sides)
    }

    fn range(&mut self, line: Line, first: f64, last: f64) -> IntervalDerivative {
        let parameter = Interval { low: first, high: last, partial: false };
        for ((input, origin), direction) in self.inputs.iter_mut().zip(line.origin).zip(line.direction) {
            let value = along(*origin, *direction, parameter);
            *input = IntervalDerivative { value, derivative: Interval::point(*direction) };
        }
        self.tape.enclose_derivative(&self.inputs, &mut self.registers)
    }
}

/// A coordinate of a piece of a line.
fn along(origin: f64, direction: f64, parameter: Interval) -> Interval {
    let moved = binary(Binary::Multiply, parameter, Interval::point(direction), false);
    binary(Binary::Add, Interval::point(origin), moved, false)
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
