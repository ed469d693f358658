//! The point nearest to some planes, within a cell.
//!
//! Ju et al., "Dual Contouring of Hermite Data" (2002): the sum of squared distances is least where the normal equations hold.
//! They are solved about the mean of the points, by eigenvectors; directions that the planes say little about are left out.

use glam::{DMat3, DVec3};

/// Eigenvalues below this part of the greatest are left out: the squares of the singular values that Ju et al. cut at a tenth.
const LEAST_EIGENVALUE: f64 = 0.01;

/// Planes, collected.
#[derive(Clone, Debug, Default)]
pub(super) struct Quadric {
    points: Vec<DVec3>,
    normals: Vec<DVec3>,
}

impl Quadric {
    /// Adds the plane through `point` across the unit vector `normal`.
    pub(super) fn add(&mut self, point: DVec3, normal: DVec3) {
        self.points.push(point);
        self.normals.push(normal);
    }

    /// Leaves no plane.
    pub(super) fn clear(&mut self) {
        self.points.clear();
        self.normals.clear();
    }

    /// The point that is nearest to all planes, not farther outside the box from `low` to `high` than half its side; where they
    /// leave a choice, near the mean of the points.
    pub(super) fn solve(&self, low: DVec3, high: DVec3) -> DVec3 {
        // A sharp edge may pass a cell by that sees both its sides: held inside, it would be cut off.
        let room = (high - low) * 0.5;
        let (low, high) = (low - room, high + room);
        let mean = self.points.iter().sum::<DVec3>() / self.points.len().max(1) as f64;
        let mut system = System { mean, matrix: DMat3::ZERO, right: DVec3::ZERO };
        for (point, normal) in self.points.iter().zip(&self.normals) {
            system.matrix += DMat3::from_cols(*normal * normal.x, *normal * normal.y, *normal * normal.z);
            system.right += *normal * normal.dot(*point - mean);
        }
        let slack = (high - low) * 1e-9;
        let is_within = |point: DVec3| point.cmpge(low - slack).all() && point.cmple(high + slack).all();
        let free = system.solve([None; 3]);
        if is_within(free) {
            return free.clamp(low, high);
        }
        // An edge may run through the box although its point nearest to the mean lies outside. On each face, edge and corner
        // of the box the same problem has fewer unknowns.
        let mut best = (f64::INFINITY, mean.clamp(low, high));
        for choice in 1..27 {
            let held = |axis: usize| match choice / [1, 3, 9][axis] % 3 {
                0 => None,
                1 => Some(low[axis]),
                _ => Some(high[axis]),
            };
            let point = system.solve([0, 1, 2].map(held));
            let error = self.error(point);
            if is_within(point) && error < best.0 {
                best = (error, point.clamp(low, high));
            }
        }
        best.1
    }

    /// The sum of squared distances.
    fn error(&self, point: DVec3) -> f64 {
        let squares = self.points.iter().zip(&self.normals).map(|(p, n)| {
            let distance = n.dot(point - *p);
            distance * distance
        });
        squares.fold(0.0, |sum, square| sum + square)
    }
}

/// The normal equations about the mean.
struct System {
    mean: DVec3,
    matrix: DMat3,
    right: DVec3,
}

impl System {
    /// The solution of least length from the mean, with some coordinates held.
    fn solve(&self, held: [Option<f64>; 3]) -> DVec3 {
        let mut start = DVec3::ZERO;
        let mut is_free = DVec3::ONE;
        for axis in 0..3 {
            if let Some(coordinate) = held[axis] {
                start[axis] = coordinate - self.mean[axis];
                is_free[axis] = 0.0;
            }
        }
        let right = (self.right - self.matrix * start) * is_free;
        let mask = DMat3::from_diagonal(is_free);
        let Eigen { values, vectors } = eigen(mask * self.matrix * mask);
        let kept = (0..3).filter(|&n| values[n] > LEAST_EIGENVALUE * values[0]);
        let step = |n: usize| vectors.col(n) * (vectors.col(n).dot(right) / values[n]);
        self.mean + start + kept.map(step).sum::<DVec3>()
    }
}

/// Eigenvalues, falling, and unit eigenvectors as columns.
pub(super) struct Eigen {
    pub(super) values: [f64; 3],
    pub(super) vectors: DMat3,
}

/// Cyclic Jacobi rotations (Golub and Van Loan, "Matrix Computations", section 8.5) on a symmetric matrix.
pub(super) fn eigen(matrix: DMat3) -> Eigen {
    let mut a = matrix.to_cols_array_2d();
    let mut v = DMat3::IDENTITY.to_cols_array_2d();
    // Convergence is quadratic; a handful of sweeps reach rounding.
    for _ in 0..8 {
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            if a[p][q] == 0.0 {
                continue;
            }
            let theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
            let t = 1.0f64.copysign(theta) / (theta.abs() + (theta * theta + 1.0).sqrt());
            let c = 1.0 / (t * t + 1.0).sqrt();
            let s = t * c;
            for row in &mut a {
                (row[p], row[q]) = (c * row[p] - s * row[q], s * row[p] + c * row[q]);
            }
            let (ap, aq) = (a[p], a[q]);
            for k in 0..3 {
                (a[p][k], a[q][k]) = (c * ap[k] - s * aq[k], s * ap[k] + c * aq[k]);
            }
            let (vp, vq) = (v[p], v[q]);
            for k in 0..3 {
                (v[p][k], v[q][k]) = (c * vp[k] - s * vq[k], s * vp[k] + c * vq[k]);
            }
        }
    }
    let mut order = [0, 1, 2];
    order.sort_by(|&one, &other| a[other][other].total_cmp(&a[one][one]));
    let [x, y, z] = order.map(|n| DVec3::from(v[n]));
    Eigen { values: order.map(|n| a[n][n]), vectors: DMat3::from_cols(x, y, z) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_planes_meet_in_a_corner_and_two_in_the_nearest_point_of_an_edge() {
        let corner = DVec3::new(0.3, -0.2, 0.1);
        let normals = [
            DVec3::new(1.0, 0.2, 0.1).normalize(),
            DVec3::new(-0.3, 1.0, 0.0).normalize(),
            DVec3::new(0.1, 0.2, 1.0).normalize(),
        ];
        let (low, high) = (DVec3::splat(-1.0), DVec3::splat(1.0));
        let mut quadric = Quadric::default();
        for normal in normals {
            // Any point of each plane.
            quadric.add(corner + normal.any_orthogonal_vector() * 0.5, normal);
        }
        assert!((quadric.solve(low, high) - corner).length() < 1e-12);
        // Two planes: on both, and no further along their edge than the mean of the points.
        quadric.clear();
        quadric.add(DVec3::new(0.0, 0.5, 0.25), DVec3::X);
        quadric.add(DVec3::new(0.5, 0.0, 0.75), DVec3::Y);
        assert!((quadric.solve(low, high) - DVec3::new(0.0, 0.0, 0.5)).length() < 1e-12);
        // One plane twice: the mean.
        quadric.clear();
        quadric.add(DVec3::new(0.0, 0.5, 0.25), DVec3::X);
        quadric.add(DVec3::new(0.0, 0.1, 0.75), DVec3::X);
        assert!((quadric.solve(low, high) - DVec3::new(0.0, 0.3, 0.5)).length() < 1e-12);
        // Nearly parallel planes that meet far away: no further than the cell.
        quadric.add(DVec3::new(0.1, 0.1, 0.1), DVec3::new(1.0, 0.3, 0.0).normalize());
        let point = quadric.solve(low, high);
        assert!(point.cmpge(low).all() && point.cmple(high).all());
    }
}
