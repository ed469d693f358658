//! Curves: Bezier, B-spline, rational.

use glam::{DVec3, DVec4};

use super::knots::{Interval, Knots};
use super::{ControlPoint, PatchError, checked};

/// A rational B-spline curve. With equal weights it is a B-spline, with one span a Bezier curve.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    knots: Knots,
    /// `(w x, w y, w z, w)`.
    points: Vec<DVec4>,
}

/// A point of a curve with its derivatives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurvePoint {
    /// The place.
    pub position: DVec3,
    /// First derivative.
    pub first: DVec3,
    /// Second derivative.
    pub second: DVec3,
}

impl Curve {
    /// A curve from knots and points.
    ///
    /// # Errors
    /// If the counts do not fit, or a point or weight is out of range.
    pub fn new(knots: Knots, points: &[ControlPoint]) -> Result<Self, PatchError> {
        if points.len() != knots.point_count() {
            return Err(PatchError::PointCount { found: points.len(), expected: knots.point_count() });
        }
        Ok(Self { knots, points: checked(points)? })
    }

    /// A Bezier curve over 0 to 1; the degree is one less than the number of points.
    ///
    /// # Errors
    /// If there are fewer than two or too many points, or one is out of range.
    pub fn bezier(points: &[ControlPoint]) -> Result<Self, PatchError> {
        Self::new(Knots::bezier(points.len().saturating_sub(1))?, points)
    }

    /// A B-spline from the first to the last point with equal spans over 0 to 1.
    ///
    /// # Errors
    /// If there are not more points than the degree, or one is out of range.
    pub fn b_spline(degree: usize, points: &[ControlPoint]) -> Result<Self, PatchError> {
        Self::new(Knots::clamped(degree, points.len())?, points)
    }

    /// Straight lines from point to point.
    ///
    /// # Errors
    /// If there are fewer than two points, or one is out of range.
    pub fn polyline(points: &[DVec3]) -> Result<Self, PatchError> {
        let points: Vec<_> = points.iter().copied().map(ControlPoint::new).collect();
        Self::b_spline(1, &points)
    }

    pub(super) fn from_parts(knots: Knots, points: Vec<DVec4>) -> Self {
        Self { knots, points }
    }

    /// Its degree and knots.
    pub fn knots(&self) -> &Knots {
        &self.knots
    }

    /// Its points.
    pub fn points(&self) -> impl Iterator<Item = ControlPoint> {
        self.points.iter().copied().map(ControlPoint::from_homogeneous)
    }

    /// Where it is defined.
    pub fn domain(&self) -> Interval {
        self.knots.domain()
    }

    /// The point at `t`; parameters outside the domain continue the first or last piece.
    pub fn position(&self, t: f64) -> DVec3 {
        let basis = self.knots.basis(t, 0);
        let sum = self.sum(basis.first, &basis.orders[0]);
        sum.truncate() / sum.w
    }

    /// The point at `t` with its derivatives.
    pub fn evaluate(&self, t: f64) -> CurvePoint {
        let basis = self.knots.basis(t, 2);
        let [value, first, second] = [0, 1, 2].map(|k| self.sum(basis.first, &basis.orders[k]));
        let position = value.truncate() / value.w;
        // The quotient rule, solved for one derivative after the other.
        let velocity = (first.truncate() - position * first.w) / value.w;
        let bend = (second.truncate() - velocity * (2.0 * first.w) - position * second.w) / value.w;
        CurvePoint { position, first: velocity, second: bend }
    }

    fn sum(&self, first: usize, basis: &[f64]) -> DVec4 {
        basis.iter().zip(&self.points[first..]).map(|(b, point)| *point * *b).sum()
    }

    /// The same curve with one more knot, and so one more point to pull at.
    ///
    /// # Errors
    /// If `t` is not inside the domain, or is a knot as often as the degree.
    pub fn with_knot(&self, t: f64) -> Result<Self, PatchError> {
        let (knots, points) = self.knots.insert(&self.points, t)?;
        Ok(Self { knots, points })
    }

    /// The same curve with a degree one higher. Every piece gets knots of its own.
    ///
    /// # Errors
    /// If the degree is the highest already.
    pub fn elevated(&self) -> Result<Self, PatchError> {
        let degree = self.knots.degree() + 1;
        let breaks = self.knots.breaks();
        let mut values = vec![breaks[0]; degree + 1];
        let mut points: Vec<DVec4> = Vec::new();
        for (piece, end) in self.pieces().iter().zip(&breaks[1..]) {
            // Point i lies on the line from point i - 1 to point i, at 1 - i / degree.
            let raised = (0..=degree).map(|i| {
                let share = i as f64 / degree as f64;
                match i {
                    0 => piece[0],
                    _ if i == degree => piece[degree - 1],
                    _ => piece[i - 1] * share + piece[i] * (1.0 - share),
                }
            });
            points.extend(raised.skip(usize::from(!points.is_empty())));
            values.extend(std::iter::repeat_n(*end, degree));
        }
        values.push(breaks[breaks.len() - 1]);
        Ok(Self { knots: Knots::new(degree, values)?, points })
    }

    /// The same points from end to start.
    pub fn reversed(&self) -> Self {
        let Interval { start, end } = self.domain();
        let values = self.knots.values().iter().rev().map(|t| start + end - t).collect();
        // Mirrored knots can differ in the last bit only, which leaves their order and counts as they are.
        let knots = Knots::new(self.knots.degree(), values).unwrap_or_else(|_| self.knots.clone());
        Self { knots, points: self.points.iter().rev().copied().collect() }
    }

    /// The Bezier pieces as curves over 0 to 1.
    pub fn bezier_pieces(&self) -> Vec<Self> {
        let knots = |piece: &Vec<DVec4>| Knots::bezier(piece.len() - 1);
        self.pieces()
            .into_iter()
            .filter_map(|piece| Some(Self { knots: knots(&piece).ok()?, points: piece }))
            .collect()
    }

    pub(super) fn pieces(&self) -> Vec<Vec<DVec4>> {
        self.knots.bezier_pieces(&self.points)
    }

    /// Its length, to about twelve digits where it is smooth: Gauss's rule of five points, halved until two rounds agree.
    pub fn arc_length(&self) -> f64 {
        let breaks = self.knots.breaks();
        let total: f64 = breaks.windows(2).map(|ends| self.length_by_gauss(ends[0], ends[1])).sum();
        breaks.windows(2).map(|ends| self.refined_length(ends[0], ends[1], total, 0)).sum()
    }

    fn refined_length(&self, start: f64, end: f64, total: f64, depth: u32) -> f64 {
        let middle = start.midpoint(end);
        let whole = self.length_by_gauss(start, end);
        let halves = self.length_by_gauss(start, middle) + self.length_by_gauss(middle, end);
        // A cusp converges slowly; twelve halvings leave it to 1/4096 of its piece.
        if depth >= 12 || (whole - halves).abs() <= 1e-13 * total {
            return halves;
        }
        self.refined_length(start, middle, total, depth + 1)
            + self.refined_length(middle, end, total, depth + 1)
    }

    fn length_by_gauss(&self, start: f64, end: f64) -> f64 {
        // Roots and weights of the Legendre polynomial of degree five, in closed form.
        let inner = 2.0 * (10.0f64 / 7.0).sqrt();
        let root_of_70 = 70f64.sqrt();
        let nodes = [
            (0.0, 128.0 / 225.0),
            ((5.0 - inner).sqrt() / 3.0, (322.0 + 13.0 * root_of_70) / 900.0),
            ((5.0 + inner).sqrt() / 3.0, (322.0 - 13.0 * root_of_70) / 900.0),
        ];
        let (middle, half) = (start.midpoint(end), (end - start) / 2.0);
        let speed = |x: f64| self.evaluate(middle + half * x).first.length();
        nodes
            .iter()
            .map(
                |&(node, weight)| {
                    if node == 0.0 { weight * speed(0.0) } else { weight * (speed(node) + speed(-node)) }
                },
            )
            .sum::<f64>()
            * half
    }
}

#[cfg(test)]
mod tests;
