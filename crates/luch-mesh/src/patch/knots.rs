//! Knots and the B-spline basis over them.
//!
//! Formulas of Cox and de Boor; the derivatives follow Piegl and Tiller, "The NURBS Book" (1997), section 2.3.

use glam::DVec4;

use super::{MAX_DEGREE, PatchError};

/// A piece of the parameter line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// Where it begins.
    pub start: f64,
    /// Where it ends; above `start`.
    pub end: f64,
}

impl Interval {
    /// Its length.
    pub fn length(self) -> f64 {
        self.end - self.start
    }

    /// The parameter at a fraction of the way; exact at 0 and 1.
    pub fn at(self, fraction: f64) -> f64 {
        if fraction >= 1.0 { self.end } else { self.start + self.length() * fraction }
    }
}

/// A degree and a row of knots that fits it.
#[derive(Clone, Debug, PartialEq)]
pub struct Knots {
    degree: usize,
    values: Vec<f64>,
}

/// The basis functions that are not zero at a parameter, with derivatives.
#[derive(Clone, Debug)]
pub struct Basis {
    /// The place of the first of them.
    pub first: usize,
    /// For each order of derivative, from 0, the `degree + 1` values.
    pub orders: Vec<Vec<f64>>,
}

impl Knots {
    /// Knots as they are given; they need not be clamped.
    ///
    /// # Errors
    /// If the degree is not 1 to [`MAX_DEGREE`], a knot falls, is not finite or is repeated more than `degree` times inside
    /// the domain (`degree + 1` at its ends), or the domain is empty.
    pub fn new(degree: usize, values: Vec<f64>) -> Result<Self, PatchError> {
        if !(1..=MAX_DEGREE).contains(&degree) {
            return Err(PatchError::Degree { degree });
        }
        let count = values.len();
        if count < 2 * (degree + 1) {
            return Err(PatchError::Domain { count, degree });
        }
        for (index, &value) in values.iter().enumerate() {
            let falls = index > 0 && value < values[index - 1];
            let repeats_inside = index > degree + 1 && index + 1 < count && value == values[index - degree];
            let repeats = index > degree && value == values[index - degree - 1];
            // At the far end one more is right: the run of knots then reaches the last.
            let at_end = value == values[count - 1];
            if !value.is_finite()
                || value.abs() > 1e15
                || falls
                || repeats
                || (repeats_inside && !at_end && value != values[degree])
            {
                return Err(PatchError::Knot { index, value });
            }
        }
        let knots = Self { degree, values };
        let Interval { start, end } = knots.domain();
        // Spans must be wide enough that their differences have meaning.
        let least = (end - start) * 1e-9;
        if start >= end {
            return Err(PatchError::Domain { count, degree });
        }
        for (index, pair) in knots.values.windows(2).enumerate() {
            if pair[0] != pair[1] && pair[1] - pair[0] < least {
                return Err(PatchError::Knot { index: index + 1, value: pair[1] });
            }
        }
        Ok(knots)
    }

    /// One Bezier piece over 0 to 1.
    ///
    /// # Errors
    /// If the degree is not 1 to [`MAX_DEGREE`].
    pub fn bezier(degree: usize) -> Result<Self, PatchError> {
        Self::clamped(degree, degree.saturating_add(1))
    }

    /// Equal spans over 0 to 1 for `count` points; the curve begins at the first and ends at the last point.
    ///
    /// # Errors
    /// If the degree is not 1 to [`MAX_DEGREE`] or there are not more points than that.
    pub fn clamped(degree: usize, count: usize) -> Result<Self, PatchError> {
        if !(1..=MAX_DEGREE).contains(&degree) {
            return Err(PatchError::Degree { degree });
        }
        if count <= degree {
            return Err(PatchError::PointCount { found: count, expected: degree + 1 });
        }
        let spans = count - degree;
        let inner = (1..spans).map(|i| i as f64 / spans as f64);
        let mut values = vec![0.0; degree + 1];
        values.extend(inner);
        values.extend(std::iter::repeat_n(1.0, degree + 1));
        Self::new(degree, values)
    }

    /// The degree.
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// All knots.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// How many points they ask for.
    pub fn point_count(&self) -> usize {
        self.values.len() - self.degree - 1
    }

    /// Where the curve is defined.
    pub fn domain(&self) -> Interval {
        Interval { start: self.values[self.degree], end: self.values[self.point_count()] }
    }

    /// The distinct knots from start to end of the domain.
    pub fn breaks(&self) -> Vec<f64> {
        let mut breaks = self.values[self.degree..=self.point_count()].to_vec();
        breaks.dedup();
        breaks
    }

    /// How often a knot stands in the row.
    pub fn multiplicity(&self, knot: f64) -> usize {
        self.values.iter().filter(|&&value| value == knot).count()
    }

    /// The place `i` of the span `values[i] <= t < values[i + 1]`; parameters outside go to the first or last span.
    pub fn span(&self, t: f64) -> usize {
        let inner = &self.values[self.degree + 1..self.point_count()];
        let mut span = self.degree + inner.partition_point(|&knot| knot <= t);
        // At and past the end the last span that is not empty counts.
        while span > self.degree && self.values[span] >= self.values[span + 1] {
            span -= 1;
        }
        span
    }

    /// Basis functions and their derivatives up to `order` (orders above the degree are zero).
    pub fn basis(&self, t: f64, order: usize) -> Basis {
        let (degree, knots, span) = (self.degree, &self.values, self.span(t));
        // Table of basis functions in the upper part, of knot differences in the lower.
        let mut table = vec![vec![0.0; degree + 1]; degree + 1];
        let (mut left, mut right) = (vec![0.0; degree + 1], vec![0.0; degree + 1]);
        table[0][0] = 1.0;
        for j in 1..=degree {
            left[j] = t - knots[span + 1 - j];
            right[j] = knots[span + j] - t;
            let mut saved = 0.0;
            for r in 0..j {
                table[j][r] = right[r + 1] + left[j - r];
                let part = table[r][j - 1] / table[j][r];
                table[r][j] = saved + right[r + 1] * part;
                saved = left[j - r] * part;
            }
            table[j][j] = saved;
        }
        let mut orders = vec![vec![0.0; degree + 1]; order + 1];
        for j in 0..=degree {
            orders[0][j] = table[j][degree];
        }
        // Derivatives: coefficients a of the functions of lower degree, two rows in turn.
        for r in 0..=degree {
            let mut a = [vec![0.0; degree + 1], vec![0.0; degree + 1]];
            a[0][0] = 1.0;
            let (mut now, mut next) = (0, 1);
            for k in 1..=order.min(degree) {
                let mut sum = 0.0;
                let low = degree - k;
                if r >= k {
                    a[next][0] = a[now][0] / table[low + 1][r - k];
                    sum = a[next][0] * table[r - k][low];
                }
                let from = if r + 1 >= k { 1 } else { k - r };
                let to = if r <= low + 1 { k - 1 } else { degree - r };
                for j in from..=to {
                    let at = r + j - k;
                    a[next][j] = (a[now][j] - a[now][j - 1]) / table[low + 1][at];
                    sum += a[next][j] * table[at][low];
                }
                if r <= low {
                    a[next][k] = -a[now][k - 1] / table[low + 1][r];
                    sum += a[next][k] * table[r][low];
                }
                orders[k][r] = sum;
                std::mem::swap(&mut now, &mut next);
            }
        }
        let mut factor = degree as f64;
        for (k, values) in orders.iter_mut().enumerate().skip(1) {
            values.iter_mut().for_each(|value| *value *= factor);
            factor *= degree.saturating_sub(k) as f64;
        }
        Basis { first: span - degree, orders }
    }

    /// The knots with one more, and the points that keep the curve as it is (Boehm 1980).
    ///
    /// # Errors
    /// If the knot lies outside the domain or is there as often as the degree already.
    pub(super) fn insert(&self, points: &[DVec4], t: f64) -> Result<(Self, Vec<DVec4>), PatchError> {
        let Interval { start, end } = self.domain();
        if !(start < t && t < end) || self.multiplicity(t) >= self.degree {
            return Err(PatchError::Knot { index: self.values.len(), value: t });
        }
        let (degree, span) = (self.degree, self.span(t));
        let mut values = self.values.clone();
        values.insert(span + 1, t);
        let inserted = Self::new(degree, values)?;
        let new = (0..=points.len()).map(|i| {
            if i + degree <= span {
                points[i]
            } else if i > span {
                points[i - 1]
            } else {
                let alpha = (t - self.values[i]) / (self.values[i + degree] - self.values[i]);
                points[i - 1] * (1.0 - alpha) + points[i] * alpha
            }
        });
        Ok((inserted, new.collect()))
    }

    /// The points of each Bezier piece between two breaks. Neighbours share their common point to the last bit.
    ///
    /// The points are values of the polar form (blossom) at the ends of the piece: Ramshaw 1989.
    pub(super) fn bezier_pieces(&self, points: &[DVec4]) -> Vec<Vec<DVec4>> {
        let degree = self.degree;
        let mut pieces: Vec<Vec<DVec4>> = Vec::new();
        for ends in self.breaks().windows(2) {
            let span = self.span(ends[0]);
            let blossom = |ends_taken: usize| {
                let mut row = points[span - degree..=span].to_vec();
                for level in 1..=degree {
                    let t = if level <= ends_taken { ends[1] } else { ends[0] };
                    for i in (level..=degree).rev() {
                        let low = self.values[span - degree + i];
                        let high = self.values[span + 1 + i - level];
                        let alpha = (t - low) / (high - low);
                        row[i] = row[i - 1] * (1.0 - alpha) + row[i] * alpha;
                    }
                }
                row[degree]
            };
            let mut piece: Vec<DVec4> = (0..=degree).map(blossom).collect();
            if let Some(before) = pieces.last() {
                piece[0] = before[degree];
            }
            pieces.push(piece);
        }
        pieces
    }
}

#[cfg(test)]
mod tests;
