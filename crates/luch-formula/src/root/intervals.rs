//! The first root by ranges of values and derivatives: right for every function.
//!
//! The piece in question is halved, the near half first. A piece whose range of values holds no zero has no root; nor has one
//! that the mean value theorem proves free of it: f(m) + f′·(t − m). The same theorem clears a neighbourhood of the middle.
//! Where the range of derivatives holds no zero the function is monotone, signs at the ends decide, and a bracketing method finds
//! the root. The idea is that of Mitchell (1990), "Robust ray intersection with interval arithmetic".

use super::{FirstRoot, Line, Piece, RootFinder};
use crate::interval::{Interval, IntervalDerivative, binary, down, up};
use crate::operation::Binary;

/// A piece with a pole in it is halved until it is this part of the tolerance.
const POLE: f64 = 1e-9;

impl RootFinder<'_> {
    /// The first root in a piece.
    pub(super) fn by_intervals(&mut self, line: Line, piece: Piece) -> FirstRoot {
        const ZERO: IntervalDerivative =
            IntervalDerivative { value: Interval::ZERO, derivative: Interval::ZERO };
        self.registers.resize(self.tape.registers(), ZERO);
        self.inputs.resize(self.tape.inputs(), ZERO);
        self.sides.resize(self.tape.inputs(), Interval::ZERO);
        self.point.resize(self.tape.inputs(), 0.0);
        self.waiting.clear();
        self.waiting.push(piece);
        while let Some(piece) = self.waiting.pop() {
            self.steps += 1;
            if self.steps > self.most_steps {
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
        let mut clear = Clear { before: 0.0, behind: 0.0 };
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
            clear = clear_around(at_middle, range.derivative);
        }
        let shortest =
            if range.value.is_bounded() || range.value.partial && range.value.width() < f64::INFINITY {
                self.tolerance
            } else {
                self.tolerance * POLE
            };
        let divisible = first < middle && middle < last;
        if divisible && last - first > shortest {
            // Rounded toward the middle, beyond which nothing is given away.
            let (left, right) =
                (up(middle - clear.before).min(middle), down(middle + clear.behind).max(middle));
            if right <= last {
                self.waiting.push(Piece { first: right, last });
            }
            if left >= first {
                self.waiting.push(Piece { first, last: left });
            }
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

/// How far from a place there is no root.
struct Clear {
    before: f64,
    behind: f64,
}

/// By the mean value theorem: a value cannot come to zero sooner than its steepest slope leads there.
fn clear_around(value: Interval, derivative: Interval) -> Clear {
    let (size, falls, rises) = if value.low > 0.0 {
        (value.low, -derivative.low, derivative.high)
    } else if value.high < 0.0 {
        (-value.high, derivative.high, -derivative.low)
    } else {
        return Clear { before: 0.0, behind: 0.0 };
    };
    // The quotient is rounded, and too small a one vanishes.
    let reach = |slope: f64| if slope > 0.0 { down(size / slope).max(0.0) } else { f64::INFINITY };
    Clear { before: reach(rises), behind: reach(falls) }
}
