//! Tensor-product surfaces: Bezier, B-spline, rational.

use glam::{DVec3, DVec4};

use super::bezier::{Net, SurfacePoint, unit_cross};
use super::knots::{Interval, Knots};
use super::{ControlPoint, Curve, PatchError, checked};

/// One of the two parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// The first.
    U,
    /// The second.
    V,
}

/// A border of the parameter rectangle. Along it the other parameter grows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// v at its least.
    Bottom,
    /// u at its most.
    Right,
    /// v at its most.
    Top,
    /// u at its least.
    Left,
}

impl Side {
    /// All four, counter-clockwise.
    pub const ALL: [Self; 4] = [Self::Bottom, Self::Right, Self::Top, Self::Left];
}

/// A rational B-spline surface. Its outside is where u to v turns counter-clockwise.
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    knots: [Knots; 2],
    /// `(w x, w y, w z, w)`, u running fastest.
    points: Vec<DVec4>,
}

impl Surface {
    /// A surface from the knots along u and v and its points, u running fastest.
    ///
    /// # Errors
    /// If the counts do not fit, or a point or weight is out of range.
    pub fn new(knots: [Knots; 2], points: &[ControlPoint]) -> Result<Self, PatchError> {
        let expected = knots[0].point_count().saturating_mul(knots[1].point_count());
        if points.len() != expected {
            return Err(PatchError::PointCount { found: points.len(), expected });
        }
        Ok(Self { knots, points: checked(points)? })
    }

    /// A Bezier patch over the unit square, `degrees[0] + 1` points along u.
    ///
    /// # Errors
    /// As [`Surface::new`].
    pub fn bezier(degrees: [usize; 2], points: &[ControlPoint]) -> Result<Self, PatchError> {
        Self::new([Knots::bezier(degrees[0])?, Knots::bezier(degrees[1])?], points)
    }

    /// A clamped B-spline with equal spans over the unit square, `counts[0]` points along u.
    ///
    /// # Errors
    /// As [`Surface::new`].
    pub fn b_spline(
        degrees: [usize; 2],
        counts: [usize; 2],
        points: &[ControlPoint],
    ) -> Result<Self, PatchError> {
        Self::new([Knots::clamped(degrees[0], counts[0])?, Knots::clamped(degrees[1], counts[1])?], points)
    }

    /// Degree and knots along u and v.
    pub fn knots(&self) -> &[Knots; 2] {
        &self.knots
    }

    /// The knots along one direction.
    pub fn knots_along(&self, direction: Direction) -> &Knots {
        match direction {
            Direction::U => &self.knots[0],
            Direction::V => &self.knots[1],
        }
    }

    /// Its points, u running fastest.
    pub fn points(&self) -> impl Iterator<Item = ControlPoint> {
        self.points.iter().copied().map(ControlPoint::from_homogeneous)
    }

    /// True if the weights are not all the same.
    pub fn is_rational(&self) -> bool {
        self.points.iter().any(|point| point.w != self.points[0].w)
    }

    /// The point at `(u, v)`; parameters outside continue the outermost pieces.
    pub fn position(&self, u: f64, v: f64) -> DVec3 {
        let [along_u, along_v] = [self.knots[0].basis(u, 0), self.knots[1].basis(v, 0)];
        let columns = self.knots[0].point_count();
        let mut sum = DVec4::ZERO;
        for (j, up) in along_v.orders[0].iter().enumerate() {
            let row = &self.points[(along_v.first + j) * columns + along_u.first..];
            sum += row.iter().zip(&along_u.orders[0]).map(|(point, b)| *point * *b).sum::<DVec4>() * *up;
        }
        sum.truncate() / sum.w
    }

    /// The point at `(u, v)` with its derivatives; parameters outside continue the outermost pieces.
    pub fn evaluate(&self, u: f64, v: f64) -> SurfacePoint {
        let [along_u, along_v] = [self.knots[0].basis(u, 2), self.knots[1].basis(v, 2)];
        let columns = self.knots[0].point_count();
        let sum = |order_u: usize, order_v: usize| -> DVec4 {
            let row = |j: usize| -> DVec4 {
                let points = &self.points[(along_v.first + j) * columns + along_u.first..];
                points.iter().zip(&along_u.orders[order_u]).map(|(point, b)| *point * *b).sum()
            };
            along_v.orders[order_v].iter().enumerate().map(|(j, b)| row(j) * *b).sum()
        };
        SurfacePoint::from_homogeneous([sum(0, 0), sum(1, 0), sum(0, 1), sum(2, 0), sum(1, 1), sum(0, 2)])
    }

    /// The unit normal; where a side has shrunk to a point, the limit from inside. `None` if there is none.
    pub fn normal(&self, u: f64, v: f64) -> Option<DVec3> {
        let point = self.evaluate(u, v);
        let [u_range, v_range] = [self.knots[0].domain(), self.knots[1].domain()];
        let towards = |t: f64, range: Interval| if t <= range.start.midpoint(range.end) { 1.0 } else { -1.0 };
        let scale = [u_range.length(), v_range.length()];
        let [du, dv, duv] = [point.du * scale[0], point.dv * scale[1], point.duv * (scale[0] * scale[1])];
        let size = du.length() + dv.length() + duv.length();
        point
            .normal()
            .filter(|_| du.length().min(dv.length()) > 1e-9 * size)
            .or_else(|| unit_cross(duv * towards(v, v_range), dv).filter(|_| du.length() <= 1e-9 * size))
            .or_else(|| unit_cross(du, duv * towards(u, u_range)).filter(|_| dv.length() <= 1e-9 * size))
            .or_else(|| {
                [1e-6, 1e-4, 1e-2].into_iter().find_map(|step| {
                    let inside = |t: f64, range: Interval| t + (range.start.midpoint(range.end) - t) * step;
                    self.evaluate(inside(u, u_range), inside(v, v_range)).normal()
                })
            })
    }

    /// The same surface with one more knot.
    ///
    /// # Errors
    /// If `t` is not inside the domain, or is a knot as often as the degree.
    pub fn with_knot(&self, direction: Direction, t: f64) -> Result<Self, PatchError> {
        let [columns, rows] = [self.knots[0].point_count(), self.knots[1].point_count()];
        match direction {
            Direction::U => {
                let mut points = Vec::with_capacity(self.points.len() + rows);
                let mut knots = self.knots.clone();
                for row in self.points.chunks(columns) {
                    let (longer, line) = self.knots[0].insert(row, t)?;
                    knots[0] = longer;
                    points.extend(line);
                }
                Ok(Self { knots, points })
            }
            Direction::V => Ok(self.transposed().with_knot(Direction::U, t)?.transposed()),
        }
    }

    /// The same surface with u and v exchanged; its outside becomes its inside.
    pub fn transposed(&self) -> Self {
        let [columns, rows] = [self.knots[0].point_count(), self.knots[1].point_count()];
        let points =
            (0..columns).flat_map(|i| (0..rows).map(move |j| self.points[j * columns + i])).collect();
        Self { knots: [self.knots[1].clone(), self.knots[0].clone()], points }
    }

    /// The curve at a side, the other parameter growing along it. The knots must be clamped there, or the curve is that of
    /// the outermost points.
    pub fn side(&self, side: Side) -> Curve {
        let [columns, rows] = [self.knots[0].point_count(), self.knots[1].point_count()];
        let column = |i: usize| (0..rows).map(move |j| self.points[j * columns + i]).collect();
        match side {
            Side::Bottom => Curve::from_parts(self.knots[0].clone(), self.points[..columns].to_vec()),
            Side::Top => {
                Curve::from_parts(self.knots[0].clone(), self.points[(rows - 1) * columns..].to_vec())
            }
            Side::Left => Curve::from_parts(self.knots[1].clone(), column(0)),
            Side::Right => Curve::from_parts(self.knots[1].clone(), column(columns - 1)),
        }
    }

    /// The Bezier pieces as surfaces over the unit square, u running fastest.
    pub fn bezier_pieces(&self) -> Vec<Self> {
        let [p, q] = [0, 1].map(|axis| self.knots[axis].degree());
        let knots = match (Knots::bezier(p), Knots::bezier(q)) {
            (Ok(along_u), Ok(along_v)) => [along_u, along_v],
            _ => return Vec::new(),
        };
        self.nets().into_iter().map(|net| Self { knots: knots.clone(), points: net.points }).collect()
    }

    /// The Bezier pieces, u running fastest. Neighbours share their common side to the last bit.
    pub(super) fn nets(&self) -> Vec<Net> {
        let columns = self.knots[0].point_count();
        let [p, q] = [0, 1].map(|axis| self.knots[axis].degree());
        // Each row in pieces along u, then each column of those in pieces along v.
        let rows: Vec<_> = self.points.chunks(columns).map(|row| self.knots[0].bezier_pieces(row)).collect();
        let [across, up] = [0, 1].map(|axis| self.knots[axis].breaks().len() - 1);
        let mut nets =
            vec![Net { degrees: [p, q], points: vec![DVec4::ZERO; (p + 1) * (q + 1)] }; across * up];
        for piece_u in 0..across {
            for i in 0..=p {
                let column: Vec<DVec4> = rows.iter().map(|row| row[piece_u][i]).collect();
                for (piece_v, line) in self.knots[1].bezier_pieces(&column).into_iter().enumerate() {
                    for (j, point) in line.into_iter().enumerate() {
                        nets[piece_v * across + piece_u].points[j * (p + 1) + i] = point;
                    }
                }
            }
        }
        nets
    }
}

#[cfg(test)]
mod tests;
