//! Solids from functions that are negative inside: sets of points, blends, and moves.
//!
//! A move of a solid is the opposite move of the point at which its function is asked. All moves act on the variables `x`, `y`
//! and `z`.

use super::Expression;

impl Expression {
    /// The points in either solid: the lesser of both functions.
    pub fn union(&self, other: &Self) -> Self {
        self.min(other)
    }

    /// The points in both solids: the greater of both functions.
    pub fn intersection(&self, other: &Self) -> Self {
        self.max(other)
    }

    /// The points in this solid that are not in the other.
    pub fn difference(&self, other: &Self) -> Self {
        self.max(-other)
    }

    /// A union whose seam is rounded where the functions differ by less than `width`: the lesser of both less
    /// (width − |a − b|)² / (4 width). Its slope is continuous. A width of zero or less rounds nothing.
    pub fn smooth_union(&self, other: &Self, width: f64) -> Self {
        if width.is_nan() || width <= 0.0 {
            return self.union(other);
        }
        let near = (width - (self - other).abs()).max(0.0);
        self.min(other) - near.squared() / (4.0 * width)
    }

    /// The intersection with a rounded seam; see [`smooth_union`](Self::smooth_union).
    pub fn smooth_intersection(&self, other: &Self, width: f64) -> Self {
        -(-self).smooth_union(&-other, width)
    }

    /// The difference with a rounded seam; see [`smooth_union`](Self::smooth_union).
    pub fn smooth_difference(&self, other: &Self, width: f64) -> Self {
        self.smooth_intersection(&-other, width)
    }

    /// The solid grown by a length, or shrunk by a negative one: exactly so if the function is a distance.
    pub fn offset(&self, length: f64) -> Self {
        self - length
    }

    /// A skin of the given thickness about the surface.
    pub fn shell(&self, thickness: f64) -> Self {
        self.abs() - 0.5 * thickness
    }

    /// Moved by a vector.
    pub fn translated(&self, by: [f64; 3]) -> Self {
        let [x, y, z] = coordinates();
        self.substitute(&[("x", x - by[0]), ("y", y - by[1]), ("z", z - by[2])])
    }

    /// Larger by a factor. The function is scaled too, so that a distance stays one.
    pub fn scaled(&self, factor: f64) -> Self {
        let [x, y, z] = coordinates();
        self.substitute(&[("x", x / factor), ("y", y / factor), ("z", z / factor)]) * factor
    }

    /// Turned about an axis through the origin, counter-clockwise seen from its tip. Rodrigues' formula gives the matrix. An
    /// axis without a direction turns nothing.
    pub fn rotated(&self, axis: [f64; 3], radians: f64) -> Self {
        let length = (axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]).sqrt();
        if !(length > 0.0 && length.is_finite()) {
            return self.clone();
        }
        let n = axis.map(|coordinate| coordinate / length);
        // The point turns the other way.
        let (sin, cos) = (libm::sin(-radians), libm::cos(radians));
        let point = coordinates();
        let row = |i: usize| {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            let rest = 1.0 - cos;
            let mut of = [0.0; 3];
            of[i] = cos + rest * n[i] * n[i];
            of[j] = rest * n[i] * n[j] - sin * n[k];
            of[k] = rest * n[i] * n[k] + sin * n[j];
            &(&point[0] * of[0] + &point[1] * of[1]) + &point[2] * of[2]
        };
        self.substitute(&[("x", row(0)), ("y", row(1)), ("z", row(2))])
    }

    /// Each point is asked where a matrix with its three rows of four numbers takes it: the inverse of the move of the solid.
    pub fn transformed(&self, inverse: &[[f64; 4]; 3]) -> Self {
        let [x, y, z] = coordinates();
        let row = |of: &[f64; 4]| &x * of[0] + &y * of[1] + &z * of[2] + of[3];
        self.substitute(&[("x", row(&inverse[0])), ("y", row(&inverse[1])), ("z", row(&inverse[2]))])
    }

    /// Twisted about the y axis: what stands at height y is turned by that many radians a unit of height.
    pub fn twisted(&self, radians_per_unit: f64) -> Self {
        let [x, y, z] = coordinates();
        let angle = y * radians_per_unit;
        let (sin, cos) = (angle.sin(), angle.cos());
        self.substitute(&[("x", &x * &cos - &z * &sin), ("z", &x * &sin + &z * &cos)])
    }

    /// Repeated along each axis whose period is more than zero, once in each period, the first about the origin.
    pub fn repeated(&self, period: [f64; 3]) -> Self {
        let mut replacements = Vec::new();
        for (name, period) in ["x", "y", "z"].into_iter().zip(period) {
            if period > 0.0 {
                replacements
                    .push((name, (Self::variable(name) + 0.5 * period).modulo(period) - 0.5 * period));
            }
        }
        self.substitute(&replacements)
    }
}

fn coordinates() -> [Expression; 3] {
    ["x", "y", "z"].map(Expression::variable)
}
