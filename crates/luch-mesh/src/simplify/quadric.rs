//! Squared distances to planes, added up.

use std::ops::{Add, AddAssign};

use glam::DVec3;

/// The sum of weighted squared distances to planes, as a function of the place: xᵀ A x + 2 b · x + c.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Quadric {
    /// xx, yy, zz.
    diagonal: DVec3,
    /// yz, zx, xy.
    others: DVec3,
    linear: DVec3,
    constant: f64,
    pub(super) weight: f64,
}

impl Quadric {
    /// The plane through a place with a unit normal.
    pub(super) fn of_plane(normal: DVec3, place: DVec3, weight: f64) -> Self {
        let distance = -normal.dot(place);
        Self {
            diagonal: normal * normal * weight,
            others: DVec3::new(normal.y * normal.z, normal.z * normal.x, normal.x * normal.y) * weight,
            linear: normal * (distance * weight),
            constant: distance * distance * weight,
            weight,
        }
    }

    /// The mean of the squared distances of a place.
    pub(super) fn error(&self, x: DVec3) -> f64 {
        let squares = (self.diagonal * x).dot(x);
        let products =
            2.0 * (self.others.x * x.y * x.z + self.others.y * x.z * x.x + self.others.z * x.x * x.y);
        let sum = squares + products + 2.0 * self.linear.dot(x) + self.constant;
        // Rounding may give a hair below zero.
        if self.weight > 0.0 { (sum / self.weight).max(0.0) } else { 0.0 }
    }
}

impl Add for Quadric {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            diagonal: self.diagonal + other.diagonal,
            others: self.others + other.others,
            linear: self.linear + other.linear,
            constant: self.constant + other.constant,
            weight: self.weight + other.weight,
        }
    }
}

impl AddAssign for Quadric {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_the_mean_squared_distance() {
        let planes = [(DVec3::X, DVec3::new(1.0, 0.0, 0.0), 2.0), (DVec3::new(0.6, 0.0, 0.8), DVec3::Y, 1.0)];
        let mut sum = Quadric::default();
        planes.iter().for_each(|&(normal, place, weight)| sum += Quadric::of_plane(normal, place, weight));
        let at = DVec3::new(3.0, -2.0, 0.5);
        let distances = planes.map(|(normal, place, weight)| {
            let distance = normal.dot(at - place);
            distance * distance * weight
        });
        assert!((sum.error(at) - (distances[0] + distances[1]) / 3.0).abs() < 1e-12);
    }
}
