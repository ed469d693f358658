//! Barycentric coordinates: P = λ₁ A + λ₂ B + λ₃ C, and the same formula for normals, uvs and everything else.

use std::ops::{Add, Mul};

use glam::Vec3;

/// The weights of the three corners of a triangle. They sum to 1; inside the triangle all lie in 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Barycentric {
    /// Weights λ₁, λ₂, λ₃ of the corners A, B, C.
    pub weights: [f32; 3],
}

impl Barycentric {
    /// From the two-number form P = A + (B − A) λ₂ + (C − A) λ₃.
    pub fn from_two(second: f32, third: f32) -> Self {
        Self { weights: [1.0 - second - third, second, third] }
    }

    /// The two-number form: λ₂ and λ₃.
    pub fn to_two(self) -> [f32; 2] {
        [self.weights[1], self.weights[2]]
    }

    /// The weights of the point of the triangle's plane nearest to `point`; `None` if the triangle has no area.
    pub fn of_point(point: Vec3, triangle: [Vec3; 3]) -> Option<Self> {
        let [a, b, c] = triangle.map(|v| v.as_dvec3());
        let normal = (b - a).cross(c - a);
        let area_squared = normal.length_squared();
        let offset = point.as_dvec3() - a;
        let second = offset.cross(c - a).dot(normal) / area_squared;
        let third = (b - a).cross(offset).dot(normal) / area_squared;
        let weights = [1.0 - second - third, second, third].map(|w| w as f32);
        weights.iter().all(|w| w.is_finite()).then_some(Self { weights })
    }

    /// The weighted sum of corner values: positions, normals, uvs, colours, …
    pub fn interpolate<T: Copy + Mul<f32, Output = T> + Add<Output = T>>(self, corners: [T; 3]) -> T {
        corners[0] * self.weights[0] + corners[1] * self.weights[1] + corners[2] * self.weights[2]
    }

    /// True if the point lies in the triangle, border included.
    pub fn is_inside(self) -> bool {
        self.weights.iter().all(|&w| (0.0..=1.0).contains(&w))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec2;
    use proptest::prelude::*;

    fn vector() -> impl Strategy<Value = Vec3> {
        prop::array::uniform3(-10.0f32..10.0).prop_map(Vec3::from)
    }

    proptest! {
        #[test]
        fn both_forms_give_the_same_point(a in vector(), b in vector(), c in vector(), u in 0.0f32..1.0, v in 0.0f32..1.0) {
            // Fold the square onto the triangle λ₂ + λ₃ ≤ 1.
            let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
            let at = Barycentric::from_two(u, v);
            prop_assert_eq!(at.to_two(), [u, v]);
            let two_numbers = a + (b - a) * u + (c - a) * v;
            // Ten operations on numbers up to 40, each rounded to half a unit in the last place.
            prop_assert!((at.interpolate([a, b, c]) - two_numbers).abs().max_element() <= 10.0 * 40.0 * f32::EPSILON);
            prop_assert!((at.weights.iter().sum::<f32>() - 1.0).abs() <= 2.0 * f32::EPSILON);
        }

        #[test]
        fn a_point_is_found_again(a in vector(), b in vector(), c in vector(), u in 0.0f32..1.0, v in 0.0f32..1.0) {
            let triangle = [a, b, c];
            let height = (b - a).cross(c - a).length() / (b - a).length().max((c - a).length()).max((c - b).length());
            prop_assume!(height > 0.1);
            let point = Barycentric::from_two(u, v).interpolate(triangle);
            let [second, third] = Barycentric::of_point(point, triangle).unwrap().to_two();
            // The point is rounded to about 1e-5; divided by the height that is the error of the weights.
            prop_assert!((second - u).abs() < 2e-5 / height && (third - v).abs() < 2e-5 / height);
        }

        #[test]
        fn inside_is_inside_the_bounds(a in vector(), b in vector(), c in vector(), u in 0.0f32..0.5, v in 0.0f32..0.5) {
            let at = Barycentric::from_two(u, v);
            prop_assert!(at.is_inside());
            let point = at.interpolate([a, b, c]);
            let slack = Vec3::splat(1e-5);
            prop_assert!(point.cmpge(a.min(b).min(c) - slack).all() && point.cmple(a.max(b).max(c) + slack).all());
        }
    }

    #[test]
    fn corners_and_centre_by_hand() {
        let uvs = [Vec2::ZERO, Vec2::X, Vec2::Y];
        assert_eq!(Barycentric::from_two(0.0, 0.0).interpolate(uvs), Vec2::ZERO);
        assert_eq!(Barycentric::from_two(1.0, 0.0).interpolate(uvs), Vec2::X);
        assert_eq!(Barycentric::from_two(0.25, 0.5).interpolate(uvs), Vec2::new(0.25, 0.5));
        assert!(!Barycentric::from_two(0.75, 0.5).is_inside());
        assert_eq!(Barycentric::of_point(Vec3::ONE, [Vec3::ZERO, Vec3::X, Vec3::X * 2.0]), None);
    }
}
