//! Squared distances to planes, added up.

use std::ops::AddAssign;

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

    /// The weighted sum of the squared distances of a place.
    #[inline]
    pub(super) fn sum(&self, x: DVec3) -> f64 {
        let Self { diagonal: d, others: o, linear: l, constant, .. } = self;
        let across = DVec3::new(o.z * x.y + o.y * x.z, o.z * x.x + o.x * x.z, o.y * x.x + o.x * x.y);
        (*d * x + across + *l * 2.0).dot(x) + constant
    }
}

impl AddAssign for Quadric {
    fn add_assign(&mut self, other: Self) {
        self.diagonal += other.diagonal;
        self.others += other.others;
        self.linear += other.linear;
        self.constant += other.constant;
        self.weight += other.weight;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_the_sum_of_squared_distances() {
        let planes = [(DVec3::X, DVec3::new(1.0, 0.0, 0.0), 2.0), (DVec3::new(0.6, 0.0, 0.8), DVec3::Y, 1.0)];
        let mut sum = Quadric::default();
        planes.iter().for_each(|&(normal, place, weight)| sum += Quadric::of_plane(normal, place, weight));
        let at = DVec3::new(3.0, -2.0, 0.5);
        let distances = planes.map(|(normal, place, weight)| {
            let distance = normal.dot(at - place);
            distance * distance * weight
        });
        assert!((sum.sum(at) - (distances[0] + distances[1])).abs() < 1e-12);
    }
}
