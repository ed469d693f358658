//! The first root of a formula that is a polynomial along the line.
//!
//! The line is put into the formula once. In Bernstein form a polynomial has no more roots than its coefficients have changes of
//! sign, and by de Casteljau's halving these become the signs of its values; see Farouki & Rajan (1987), "On the numerical
//! condition of polynomials in Bernstein form". All signs are taken with the bound of all errors. Signs that change once leave
//! one place for roots, which Newton's method finds and values on both sides of it prove. Where errors hide the signs a smaller
//! piece of the line is put in, and at last ranges decide.

use super::{FirstRoot, Line, Piece, RootFinder};
use crate::tape::{Along, MOST_COEFFICIENTS, Polynomial};

/// So many times a smaller piece is put in.
const MOST_LEVELS: u32 = 2;

/// Halvings after which s is not divided further.
const MOST_HALVINGS: u32 = 40;

/// Steps of Newton's method, or of halving where it leads away.
const MOST_NEWTON_STEPS: u32 = 100;

/// A part of the piece, in s from −1 to 1, with its Bernstein coefficients.
#[derive(Clone, Copy, Debug)]
pub(super) struct Part {
    from: f64,
    to: f64,
    halvings: u32,
    bernstein: [f64; MOST_COEFFICIENTS],
}

/// What the signs of coefficients say.
enum Signs {
    /// All are sure and alike.
    Alike,
    /// They change once; the polynomial of straight lines between coefficients does so at this place of the part.
    Change { place: f64, positive_first: bool },
    /// No coefficient is much more than its error.
    Hidden,
    /// They change more than once, or not surely.
    Unsure,
}

/// How s belongs to parameters.
#[derive(Clone, Copy)]
struct Map {
    middle: f64,
    half: f64,
}

impl Map {
    fn parameter(self, s: f64) -> f64 {
        self.middle + self.half * s
    }

    /// What the parameter may be off by.
    fn rounding(self) -> f64 {
        2.0 * f64::EPSILON * (self.middle.abs() + self.half)
    }
}

impl RootFinder<'_> {
    /// The first root in a piece of the line; `level` says how often the piece has been made smaller.
    pub(super) fn by_polynomial(&mut self, along: &Along, line: Line, piece: Piece, level: u32) -> FirstRoot {
        let middle = 0.5 * piece.first + 0.5 * piece.last;
        let half = (piece.last - middle).max(middle - piece.first) * (1.0 + 4.0 * f64::EPSILON);
        let map = Map { middle, half };
        if self.room.len() < along.room() {
            self.room.resize(along.room(), 0.0);
        }
        let polynomial = along.polynomial(line.origin, line.direction, middle, half, &mut self.room);
        let Some(polynomial) = polynomial.filter(|_| half > map.rounding() && 2.0 * half > self.tolerance)
        else {
            return self.by_intervals(line, piece);
        };
        let base = self.parts.len();
        let bernstein = along.bernstein(&polynomial);
        self.parts.push(Part { from: -1.0, to: 1.0, halvings: 0, bernstein });
        while self.parts.len() > base {
            let Some(part) = self.parts.pop() else { break };
            self.steps += 1;
            if self.steps > self.most_steps {
                return FirstRoot::Exhausted(map.parameter(part.from).max(piece.first));
            }
            let bernstein = &part.bernstein[..=polynomial.degree];
            let narrow = match signs(bernstein, polynomial.bernstein_error(part.halvings)) {
                Signs::Alike => continue,
                Signs::Change { place, positive_first } => {
                    let root = root(&polynomial, &part, place, positive_first, 0.02 * self.tolerance / half);
                    match self.proven(&polynomial, map, piece, &part, root, positive_first) {
                        Proven::Root(parameter) => return FirstRoot::Crossing(parameter),
                        Proven::Within(part) => part,
                    }
                }
                Signs::Unsure
                    if part.halvings < MOST_HALVINGS && half * (part.to - part.from) > self.tolerance =>
                {
                    let [left, right] = halves(&part, polynomial.degree);
                    self.parts.push(right);
                    self.parts.push(left);
                    continue;
                }
                Signs::Hidden | Signs::Unsure => part,
            };
            let smaller = Piece {
                first: (map.parameter(narrow.from) - map.rounding()).max(piece.first),
                last: (map.parameter(narrow.to) + map.rounding()).min(piece.last),
            };
            let found = if level < MOST_LEVELS && narrow.to - narrow.from < 0.5 {
                self.by_polynomial(along, line, smaller, level + 1)
            } else {
                self.by_intervals(line, smaller)
            };
            if found != FirstRoot::None {
                return found;
            }
        }
        FirstRoot::None
    }

    /// Proves that what is before the root has no other, and that the sign has changed behind it; else makes the part as small as
    /// can be proven.
    fn proven(
        &self,
        polynomial: &Polynomial,
        map: Map,
        piece: Piece,
        part: &Part,
        root: f64,
        positive_first: bool,
    ) -> Proven {
        let error = polynomial.value_error();
        let sign = if positive_first { 1.0 } else { -1.0 };
        // A quarter on each side, and less than another quarter for the rounding of the parameter.
        let reach = 0.25 * self.tolerance / map.half;
        let exact = self.tolerance > 8.0 * map.rounding();
        let mut margin = reach.max(8.0 * f64::EPSILON);
        for _ in 0..6 {
            // The signs at the ends of the part are sure.
            let (before, behind) = (root - margin, root + margin);
            let sure_before = before <= part.from || sign * polynomial.at(before).value > error;
            let sure_behind = behind >= part.to || sign * polynomial.at(behind).value < -error;
            if sure_before && sure_behind {
                let inside = before > part.from && behind < part.to;
                let (first, last) = (map.parameter(before), map.parameter(behind));
                if margin == reach && exact && inside && first >= piece.first && last <= piece.last {
                    return Proven::Root(map.parameter(root));
                }
                return Proven::Within(Part {
                    from: before.max(part.from),
                    to: behind.min(part.to),
                    ..*part
                });
            }
            margin *= 32.0;
        }
        Proven::Within(*part)
    }
}

/// Whether a root is proven.
enum Proven {
    /// At this parameter.
    Root(f64),
    /// Only that the rest of the part has none.
    Within(Part),
}

/// Reads the signs of Bernstein coefficients that are right to an error.
///
/// With one sure change the function and all its neighbours within the error have exactly one change of sign each: before the
/// place where the polynomial meets the error all values have the first sign, and behind the place where it meets the negative
/// error the second.
fn signs(bernstein: &[f64], error: f64) -> Signs {
    let (mut least, mut greatest) = (f64::INFINITY, f64::NEG_INFINITY);
    for &value in bernstein {
        least = if value < least { value } else { least };
        greatest = if value > greatest { value } else { greatest };
    }
    if least > error || greatest < -error {
        return Signs::Alike;
    }
    if greatest <= 4.0 * error && least >= -4.0 * error {
        return Signs::Hidden;
    }
    let last = bernstein.len() - 1;
    let positive_first = bernstein[0] > 0.0;
    let sign = if positive_first { 1.0 } else { -1.0 };
    let before = bernstein.iter().take_while(|&&value| sign * value > error).count();
    let behind = bernstein.iter().rev().take_while(|&&value| sign * value < -error).count();
    // What lies between may have any sign.
    let between = &bernstein[before..(last + 1 - behind).max(before)];
    if before == 0 || behind == 0 || between.iter().any(|value| value.abs() > error) {
        return Signs::Unsure;
    }
    let (i, j) = (before - 1, last + 1 - behind);
    let (a, b) = (bernstein[i], bernstein[j]);
    let place = (i as f64 + (j - i) as f64 * (a / (a - b))) / last as f64;
    Signs::Change { place, positive_first }
}

/// The root of a polynomial that has one in a part, by Newton's method kept between two signs.
fn root(polynomial: &Polynomial, part: &Part, place: f64, positive_first: bool, near: f64) -> f64 {
    let (mut low, mut high) = (part.from, part.to);
    let mut s = low + (high - low) * place;
    for _ in 0..MOST_NEWTON_STEPS {
        let at = polynomial.at(s);
        if (at.value > 0.0) == positive_first {
            low = s;
        } else {
            high = s;
        }
        let newton = s - at.value / at.slope;
        let next = if newton >= low && newton <= high { newton } else { 0.5 * (low + high) };
        let step = (next - s).abs();
        s = next;
        if step <= near || step <= 2.0 * f64::EPSILON {
            break;
        }
    }
    s
}

/// De Casteljau's halving.
fn halves(part: &Part, degree: usize) -> [Part; 2] {
    let middle = 0.5 * (part.from + part.to);
    let halvings = part.halvings + 1;
    let mut left = Part { to: middle, halvings, ..*part };
    let mut right = Part { from: middle, halvings, ..*part };
    let values = &mut right.bernstein[..=degree];
    for round in 1..=degree {
        for i in 0..=degree - round {
            values[i] = 0.5 * (values[i] + values[i + 1]);
        }
        left.bernstein[round] = values[0];
    }
    [left, right]
}
