//! One rational Bezier piece: evaluation, halving, bounds of derivatives.

use glam::{DVec3, DVec4};

/// A surface point with its derivatives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint {
    /// The place.
    pub position: DVec3,
    /// Along u.
    pub du: DVec3,
    /// Along v.
    pub dv: DVec3,
    /// Twice along u.
    pub duu: DVec3,
    /// Along u and v.
    pub duv: DVec3,
    /// Twice along v.
    pub dvv: DVec3,
}

impl SurfacePoint {
    /// The unit normal, counter-clockwise from u to v; `None` where the surface has none by first derivatives.
    pub fn normal(&self) -> Option<DVec3> {
        unit_cross(self.du, self.dv)
    }

    /// From derivatives of the homogeneous point, in the order value, u, v, uu, uv, vv.
    pub(super) fn from_homogeneous(parts: [DVec4; 6]) -> Self {
        let [value, u, v, uu, uv, vv] = parts;
        let position = value.truncate() / value.w;
        // The quotient rule, solved for one derivative after the other.
        let du = (u.truncate() - position * u.w) / value.w;
        let dv = (v.truncate() - position * v.w) / value.w;
        let duu = (uu.truncate() - du * (2.0 * u.w) - position * uu.w) / value.w;
        let duv = (uv.truncate() - dv * u.w - du * v.w - position * uv.w) / value.w;
        let dvv = (vv.truncate() - dv * (2.0 * v.w) - position * vv.w) / value.w;
        Self { position, du, dv, duu, duv, dvv }
    }
}

/// The direction of a cross product, unless the two are parallel within rounding.
pub(super) fn unit_cross(one: DVec3, other: DVec3) -> Option<DVec3> {
    let (one, other) = (one.try_normalize()?, other.try_normalize()?);
    let cross = one.cross(other);
    if cross.length_squared() < 1e-16 { None } else { cross.try_normalize() }
}

/// Bounds of the lengths of derivatives over a piece, for parameters from 0 to 1.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Bounds {
    pub(super) u: f64,
    pub(super) v: f64,
    pub(super) uu: f64,
    pub(super) uv: f64,
    pub(super) vv: f64,
}

impl Bounds {
    pub(super) fn max(self, other: Self) -> Self {
        Self {
            u: self.u.max(other.u),
            v: self.v.max(other.v),
            uu: self.uu.max(other.uu),
            uv: self.uv.max(other.uv),
            vv: self.vv.max(other.vv),
        }
    }
}

/// Points `(w x, w y, w z, w)` of a patch over the unit square, u running fastest.
#[derive(Clone, Debug)]
pub(super) struct Net {
    pub(super) degrees: [usize; 2],
    pub(super) points: Vec<DVec4>,
}

impl Net {
    fn at(&self, i: usize, j: usize) -> DVec4 {
        self.points[j * (self.degrees[0] + 1) + i]
    }

    /// The points in space.
    pub(super) fn places(&self) -> impl Iterator<Item = DVec3> {
        self.points.iter().map(|p| p.truncate() / p.w)
    }

    /// The row of points at a side.
    pub(super) fn side(&self, side: super::Side) -> Vec<DVec4> {
        let [p, q] = self.degrees;
        match side {
            super::Side::Bottom => (0..=p).map(|i| self.at(i, 0)).collect(),
            super::Side::Top => (0..=p).map(|i| self.at(i, q)).collect(),
            super::Side::Left => (0..=q).map(|j| self.at(0, j)).collect(),
            super::Side::Right => (0..=q).map(|j| self.at(p, j)).collect(),
        }
    }

    pub(super) fn evaluate(&self, u: f64, v: f64) -> SurfacePoint {
        let [p, q] = self.degrees;
        let (along_u, [zeroth, first, second]) = (bernstein(p, u), bernstein(q, v));
        let mut parts = [DVec4::ZERO; 6];
        for (j, ((b0, b1), b2)) in zeroth.into_iter().zip(first).zip(second).enumerate() {
            let mut row = [DVec4::ZERO; 3];
            for i in 0..=p {
                for (sum, basis) in row.iter_mut().zip(&along_u) {
                    *sum += self.at(i, j) * basis[i];
                }
            }
            let terms = [row[0] * b0, row[1] * b0, row[0] * b1, row[2] * b0, row[1] * b1, row[0] * b2];
            parts.iter_mut().zip(terms).for_each(|(part, term)| *part += term);
        }
        SurfacePoint::from_homogeneous(parts)
    }

    /// The unit normal; where a side has shrunk to a point, its limit from inside.
    pub(super) fn normal(&self, u: f64, v: f64) -> Option<DVec3> {
        let point = self.evaluate(u, v);
        if let Some(normal) = point.normal() {
            return Some(normal);
        }
        // Next to a side that is a point, du is duv times the distance: its direction is that of ±duv.
        let inward = |t: f64| if t <= 0.5 { 1.0 } else { -1.0 };
        let scale = point.du.length() + point.dv.length() + point.duv.length();
        let vanishes = |vector: DVec3| vector.length() <= 1e-9 * scale;
        let limit = match (vanishes(point.du), vanishes(point.dv)) {
            (true, false) => unit_cross(point.duv * inward(v), point.dv),
            (false, true) => unit_cross(point.du, point.duv * inward(u)),
            _ => None,
        };
        // Any other singular point: the normal a little inside.
        limit.or_else(|| {
            [1e-6, 1e-4, 1e-2].into_iter().find_map(|step| {
                let inside = |t: f64| t + (0.5 - t) * step;
                self.evaluate(inside(u), inside(v)).normal()
            })
        })
    }

    /// Both halves along one axis (de Casteljau).
    fn halves(&self, axis: usize) -> [Self; 2] {
        let [p, q] = self.degrees;
        let [mut low, mut high] = [self.clone(), self.clone()];
        let (lines, degree) = if axis == 0 { (q + 1, p) } else { (p + 1, q) };
        let place = |line: usize, k: usize| if axis == 0 { line * (p + 1) + k } else { k * (p + 1) + line };
        for line in 0..lines {
            let mut row: Vec<DVec4> = (0..=degree).map(|k| self.points[place(line, k)]).collect();
            for level in 0..=degree {
                low.points[place(line, level)] = row[0];
                high.points[place(line, degree - level)] = row[degree - level];
                for k in 0..degree - level {
                    row[k] = (row[k] + row[k + 1]) * 0.5;
                }
            }
        }
        [low, high]
    }

    /// Bounds of the derivatives, tightened by halving both ways three times.
    pub(super) fn bounds(&self) -> Bounds {
        let mut nets = vec![self.clone()];
        for axis in [0, 1, 0, 1, 0, 1] {
            nets = nets.iter().flat_map(|net| net.halves(axis)).collect();
        }
        let all = nets.iter().map(Self::hull_bounds).fold(Bounds::default(), Bounds::max);
        Bounds { u: 8.0 * all.u, v: 8.0 * all.v, uu: 64.0 * all.uu, uv: 64.0 * all.uv, vv: 64.0 * all.vv }
    }

    /// Bounds from differences of the points: derivatives of a Bezier patch lie in the hull of those. For S = A / w the
    /// quotient rule bounds one derivative by those before; A is taken from the middle of the points, which keeps S small.
    fn hull_bounds(&self) -> Bounds {
        let [p, q] = self.degrees;
        let centre = self.places().sum::<DVec3>() / self.points.len() as f64;
        let at = |i: usize, j: usize| {
            let point = self.at(i, j);
            (point.truncate() - centre * point.w).extend(point.w)
        };
        let differences = |[columns, rows]: [usize; 2], factor: usize, of: &dyn Fn(usize, usize) -> DVec4| {
            let places = (0..rows).flat_map(|j| (0..columns).map(move |i| (i, j)));
            Differences(places.map(|(i, j)| of(i, j) * factor as f64).collect())
        };
        let u = differences([p, q + 1], p, &|i, j| at(i + 1, j) - at(i, j));
        let v = differences([p + 1, q], q, &|i, j| at(i, j + 1) - at(i, j));
        let uu =
            differences([p - 1, q + 1], p * (p - 1), &|i, j| at(i + 2, j) - at(i + 1, j) * 2.0 + at(i, j));
        let uv =
            differences([p, q], p * q, &|i, j| at(i + 1, j + 1) - at(i + 1, j) - at(i, j + 1) + at(i, j));
        let vv =
            differences([p + 1, q - 1], q * (q - 1), &|i, j| at(i, j + 2) - at(i, j + 1) * 2.0 + at(i, j));
        let weights = || self.points.iter().map(|point| point.w);
        let least = weights().fold(f64::INFINITY, f64::min);
        let radius = self.places().map(|place| (place - centre).length()).fold(0.0, f64::max);
        let [wu, wv] = [u.weight(), v.weight()];
        let du = (u.vector(DVec3::ZERO) + wu * radius) / least;
        let dv = (v.vector(DVec3::ZERO) + wv * radius) / least;
        let mut bounds = Bounds {
            u: du,
            v: dv,
            uu: (uu.vector(DVec3::ZERO) + 2.0 * wu * du + uu.weight() * radius) / least,
            uv: (uv.vector(DVec3::ZERO) + wu * dv + wv * du + uv.weight() * radius) / least,
            vv: (vv.vector(DVec3::ZERO) + 2.0 * wv * dv + vv.weight() * radius) / least,
        };
        if weights().all(|weight| weight == least) {
            return bounds;
        }
        // Terms of the quotient rule mostly cancel. In the middle they are known; around it first derivatives differ by no
        // more than the bounds so far allow, and derivatives of the weight by no more than their spread. Each round is tighter.
        let middle = self.evaluate(0.5, 0.5);
        let ([mean_u, spread_u], [mean_v, spread_v]) = (u.weight_range(), v.weight_range());
        let [size_u, size_v] = [middle.du.length(), middle.dv.length()];
        for _ in 0..3 {
            let [off_u, off_v] = [(bounds.uu + bounds.uv) / 2.0, (bounds.uv + bounds.vv) / 2.0];
            let tighter_uu = uu.vector(middle.du * (2.0 * mean_u))
                + 2.0 * (spread_u * size_u + wu * off_u)
                + uu.weight() * radius;
            let tighter_vv = vv.vector(middle.dv * (2.0 * mean_v))
                + 2.0 * (spread_v * size_v + wv * off_v)
                + vv.weight() * radius;
            let tighter_uv = uv.vector(middle.dv * mean_u + middle.du * mean_v)
                + (spread_u * size_v + wu * off_v)
                + (spread_v * size_u + wv * off_u)
                + uv.weight() * radius;
            bounds.uu = bounds.uu.min(tighter_uu / least);
            bounds.uv = bounds.uv.min(tighter_uv / least);
            bounds.vv = bounds.vv.min(tighter_vv / least);
            bounds.u = bounds.u.min(size_u + off_u);
            bounds.v = bounds.v.min(size_v + off_v);
        }
        bounds
    }
}

/// Homogeneous differences, whose hull holds a derivative.
struct Differences(Vec<DVec4>);

impl Differences {
    /// The longest vector part, less a shift.
    fn vector(&self, shift: DVec3) -> f64 {
        self.0.iter().map(|difference| (difference.truncate() - shift).length()).fold(0.0, f64::max)
    }

    /// The largest weight part.
    fn weight(&self) -> f64 {
        self.0.iter().map(|difference| difference.w.abs()).fold(0.0, f64::max)
    }

    /// The middle of the weight parts, and how far they are from it.
    fn weight_range(&self) -> [f64; 2] {
        let low = self.0.iter().map(|difference| difference.w).fold(f64::INFINITY, f64::min);
        let high = self.0.iter().map(|difference| difference.w).fold(f64::NEG_INFINITY, f64::max);
        [(low + high) / 2.0, (high - low) / 2.0]
    }
}

/// Bernstein polynomials of a degree and their first two derivatives.
fn bernstein(degree: usize, t: f64) -> [Vec<f64>; 3] {
    let raised = |lower: &[f64]| {
        let at = |i: usize| lower.get(i).copied().unwrap_or(0.0);
        (0..=lower.len())
            .map(|i| at(i) * (1.0 - t) + if i > 0 { at(i - 1) * t } else { 0.0 })
            .collect::<Vec<_>>()
    };
    let differences = |lower: &[f64], factor: f64| {
        let at = |i: usize| lower.get(i).copied().unwrap_or(0.0);
        (0..=lower.len()).map(|i| (if i > 0 { at(i - 1) } else { 0.0 } - at(i)) * factor).collect::<Vec<_>>()
    };
    // B'' comes from the polynomials two degrees lower, B' from those one degree lower.
    let mut row = vec![1.0];
    let [mut first, mut second] = [vec![0.0; degree + 1], vec![0.0; degree + 1]];
    for lower in 0..degree {
        if lower + 2 == degree {
            let once = differences(&row, (degree - 1) as f64);
            second = differences(&once, degree as f64);
        }
        if lower + 1 == degree {
            first = differences(&row, degree as f64);
        }
        row = raised(&row);
    }
    [row, first, second]
}

/// The point of a rational Bezier curve; exact at both ends.
pub(super) fn curve_point(points: &[DVec4], t: f64) -> DVec3 {
    let [basis, ..] = bernstein(points.len() - 1, t);
    let sum: DVec4 = points.iter().zip(&basis).map(|(point, b)| *point * *b).sum();
    sum.truncate() / sum.w
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::patch::shapes;

    /// The bounds hold at every point, and are not far from the truth.
    #[test]
    fn bounds_of_derivatives_hold_and_are_tight() {
        for surface in [shapes::sphere(1.0), shapes::torus(2.0, 0.5)].map(Result::unwrap) {
            for net in surface.nets() {
                let bounds = net.bounds();
                let mut found = Bounds::default();
                for i in 0..=32 {
                    for j in 0..=32 {
                        let point = net.evaluate(f64::from(i) / 32.0, f64::from(j) / 32.0);
                        found = found.max(Bounds {
                            u: point.du.length(),
                            v: point.dv.length(),
                            uu: point.duu.length(),
                            uv: point.duv.length(),
                            vv: point.dvv.length(),
                        });
                    }
                }
                let pairs = [
                    (found.u, bounds.u),
                    (found.v, bounds.v),
                    (found.uu, bounds.uu),
                    (found.uv, bounds.uv),
                    (found.vv, bounds.vv),
                ];
                for (found, bound) in pairs {
                    assert!(found <= bound * (1.0 + 1e-12) && bound < 2.5 * found, "{found:?} {bounds:?}");
                }
            }
        }
    }
}
