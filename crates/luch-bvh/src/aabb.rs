//! Boxes with sides along the axes.

use glam::{Affine3A, Vec3};

/// A box with sides along the axes: all points between two corners, both included.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aabb {
    /// The corner with the least coordinates.
    pub min: Vec3,
    /// The corner with the greatest coordinates.
    pub max: Vec3,
}

impl Aabb {
    /// The box of no points: growing it by a point gives that point.
    pub const fn empty() -> Self {
        Self { min: Vec3::INFINITY, max: Vec3::NEG_INFINITY }
    }

    /// The least box around the points. Coordinates that are not numbers are passed over.
    pub fn of_points(points: impl IntoIterator<Item = Vec3>) -> Self {
        let mut bounds = Self::empty();
        for point in points {
            bounds.grow(point);
        }
        bounds
    }

    /// Makes the box contain `point`. Coordinates that are not numbers are passed over.
    pub fn grow(&mut self, point: Vec3) {
        self.min = least(self.min, point);
        self.max = greatest(self.max, point);
    }

    /// The least box around both.
    pub fn union(&self, other: &Self) -> Self {
        Self { min: least(self.min, other.min), max: greatest(self.max, other.max) }
    }

    /// Half of the surface area, the measure of the surface area heuristic; 0 for the empty box.
    pub fn surface_area(&self) -> f32 {
        self.half_area() as f32
    }

    /// [`Aabb::surface_area`] in double precision, where no finite box overflows.
    pub(crate) fn half_area(&self) -> f64 {
        if self.is_empty() {
            return 0.0;
        }
        let [x, y, z] = [0, 1, 2].map(|axis| f64::from(self.max[axis]) - f64::from(self.min[axis]));
        x * y + y * z + z * x
    }

    /// The middle. Not a number for boxes without one: the empty box and the whole space.
    pub fn centroid(&self) -> Vec3 {
        self.min * 0.5 + self.max * 0.5
    }

    /// Whether the point lies inside or on the surface.
    pub fn contains(&self, point: Vec3) -> bool {
        self.min.cmple(point).all() && point.cmple(self.max).all()
    }

    /// Whether no point lies inside; also true when a corner is not a number.
    pub fn is_empty(&self) -> bool {
        !self.min.cmple(self.max).all()
    }

    /// A box around the image of this box under an affine map, a little too large rather than too small:
    /// it covers the rounding of the map, of its inverse and of points taken through either.
    pub fn transformed(&self, map: &Affine3A) -> Self {
        if self.is_empty() {
            return Self::empty();
        }
        // Arvo, "Transforming axis-aligned bounding boxes" (1990): each matrix entry times the bound that makes it least
        // or greatest. Zero entries are left out, so an infinite box stays infinite only where it must.
        let mut min = [0.0_f64; 3];
        let mut max = [0.0_f64; 3];
        for row in 0..3 {
            min[row] = f64::from(map.translation[row]);
            max[row] = min[row];
            for column in 0..3 {
                let entry = f64::from(map.matrix3.col(column)[row]);
                if entry != 0.0 {
                    let at_min = entry * f64::from(self.min[column]);
                    let at_max = entry * f64::from(self.max[column]);
                    min[row] += at_min.min(at_max);
                    max[row] += at_min.max(at_max);
                }
            }
        }
        let exact = Self { min: narrow(min), max: narrow(max) };
        let sizes = [exact.min.to_array(), exact.max.to_array()].concat();
        let size = sizes.into_iter().map(f32::abs).filter(|size| size.is_finite()).fold(0.0, f32::max);
        exact.padded(size * PADDING)
    }

    /// The box moved outward on every side by `margin` and then to the next representable number.
    pub(crate) fn padded(&self, margin: f32) -> Self {
        let outward = |low: f32, high: f32| ((low - margin).next_down(), (high + margin).next_up());
        let (x, y, z) = (
            outward(self.min.x, self.max.x),
            outward(self.min.y, self.max.y),
            outward(self.min.z, self.max.z),
        );
        Self { min: Vec3::new(x.0, y.0, z.0), max: Vec3::new(x.1, y.1, z.1) }
    }

    /// Square of the distance from a point to the box, 0 inside. Monotone in floating point: a box inside another is
    /// never nearer, whatever is rounded.
    pub(crate) fn distance_squared(&self, point: Vec3) -> f32 {
        let mut sum = 0.0;
        for axis in 0..3 {
            let below = self.min[axis] - point[axis];
            let above = point[axis] - self.max[axis];
            let mut outside = 0.0;
            if below > outside {
                outside = below;
            }
            if above > outside {
                outside = above;
            }
            sum += outside * outside;
        }
        sum
    }
}

/// Part by which boxes are widened to cover rounding: 2⁻¹⁸.
pub(crate) const PADDING: f32 = 1.0 / 262_144.0;

fn narrow(value: [f64; 3]) -> Vec3 {
    Vec3::new(value[0] as f32, value[1] as f32, value[2] as f32)
}

/// Per axis the lesser; `from` where `other` is not a number. Plain comparison compiles to one instruction.
fn least(from: Vec3, other: Vec3) -> Vec3 {
    let pick = |a: f32, b: f32| if b < a { b } else { a };
    Vec3::new(pick(from.x, other.x), pick(from.y, other.y), pick(from.z, other.z))
}

/// Per axis the greater; `from` where `other` is not a number.
fn greatest(from: Vec3, other: Vec3) -> Vec3 {
    let pick = |a: f32, b: f32| if b > a { b } else { a };
    Vec3::new(pick(from.x, other.x), pick(from.y, other.y), pick(from.z, other.z))
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::vec3;

    #[test]
    fn the_empty_box_is_neutral() {
        let point = vec3(1.0, -2.0, 3.0);
        let bounds = Aabb::of_points([point]);
        assert_eq!(Aabb::empty().union(&bounds), bounds);
        assert!(Aabb::empty().is_empty() && !bounds.is_empty());
        assert_eq!((Aabb::empty().surface_area(), bounds.surface_area()), (0.0, 0.0));
        assert!(Aabb::empty().transformed(&Affine3A::IDENTITY).is_empty());
    }

    #[test]
    fn a_box_of_one_two_three() {
        let bounds = Aabb::of_points([vec3(1.0, 1.0, 1.0), vec3(2.0, 3.0, 4.0), vec3(f32::NAN, 2.0, 2.0)]);
        assert_eq!(bounds.surface_area(), 2.0 + 6.0 + 3.0);
        assert_eq!(bounds.centroid(), vec3(1.5, 2.0, 2.5));
        assert!(bounds.contains(vec3(2.0, 3.0, 4.0)) && !bounds.contains(vec3(2.1, 3.0, 4.0)));
        assert_eq!(bounds.distance_squared(vec3(4.0, 2.0, 0.0)), 4.0 + 1.0);
    }

    #[test]
    fn a_transformed_box_contains_its_corners() {
        let bounds = Aabb::of_points([vec3(-1.0, 0.5, 2.0), vec3(3.0, 0.7, 2.5)]);
        let map = Affine3A::from_rotation_y(0.3)
            * Affine3A::from_scale(vec3(2.0, -1.0, 0.1))
            * Affine3A::from_translation(vec3(1e4, 3.0, -7.0));
        let image = bounds.transformed(&map);
        for corner in 0..8 {
            let pick = |bit: u32, axis: usize| {
                if corner >> bit & 1 == 0 { bounds.min[axis] } else { bounds.max[axis] }
            };
            assert!(image.contains(map.transform_point3(vec3(pick(0, 0), pick(1, 1), pick(2, 2)))));
        }
    }

    #[test]
    fn an_infinite_box_stays_infinite_where_it_must() {
        let slab = Aabb { min: vec3(f32::NEG_INFINITY, 0.0, 0.0), max: vec3(f32::INFINITY, 1.0, 1.0) };
        let moved = slab.transformed(&Affine3A::from_translation(vec3(5.0, 5.0, 5.0)));
        assert_eq!((moved.min.x, moved.max.x), (f32::NEG_INFINITY, f32::INFINITY));
        assert!(moved.min.y > 4.9 && moved.max.y < 6.1);
    }
}
