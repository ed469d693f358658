//! Frame: turns directions about +Z into directions about a normal, and back.

use glam::Vec3;

/// A right-handed orthonormal basis; `normal` is the local z axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// The local x axis, of unit length.
    pub tangent: Vec3,
    /// The local y axis, of unit length.
    pub bitangent: Vec3,
    /// The local z axis, of unit length.
    pub normal: Vec3,
}

impl Frame {
    /// A frame about a normal of unit length; the tangents are arbitrary but always the same for the same normal.
    ///
    /// Duff et al., "Building an orthonormal basis, revisited" (2017): no division by small numbers, no branch.
    #[inline]
    pub fn from_normal(normal: Vec3) -> Self {
        let sign = 1f32.copysign(normal.z);
        let a = -1.0 / (sign + normal.z);
        let b = normal.x * normal.y * a;
        Self {
            tangent: Vec3::new(1.0 + sign * normal.x * normal.x * a, sign * b, -sign * normal.x),
            bitangent: Vec3::new(b, sign + normal.y * normal.y * a, -normal.y),
            normal,
        }
    }

    /// A frame about a normal of unit length whose tangent lies on the side of `tangent` (any length), made perpendicular.
    ///
    /// Falls back to [`from_normal`](Self::from_normal) when `tangent` is zero, not finite or along the normal.
    #[inline]
    pub fn from_normal_and_tangent(normal: Vec3, tangent: Vec3) -> Self {
        let across = tangent - normal * normal.dot(tangent);
        // What is left of the tangent must stand clear of the rounding of the projection.
        if across.length_squared() > 1e-10 * tangent.length_squared() {
            // Projecting twice takes away what the first rounding left along the normal.
            let across = across.normalize_or_zero();
            if let Some(tangent) = (across - normal * normal.dot(across)).try_normalize() {
                return Self { tangent, bitangent: normal.cross(tangent), normal };
            }
        }
        Self::from_normal(normal)
    }

    /// World coordinates of a local vector.
    #[inline]
    pub fn to_world(&self, local: Vec3) -> Vec3 {
        self.tangent * local.x + self.bitangent * local.y + self.normal * local.z
    }

    /// Local coordinates of a world vector.
    #[inline]
    pub fn to_local(&self, world: Vec3) -> Vec3 {
        Vec3::new(self.tangent.dot(world), self.bitangent.dot(world), self.normal.dot(world))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Domain, Sampler, Sequence, warp};

    fn assert_orthonormal(frame: &Frame) {
        let Frame { tangent, bitangent, normal } = *frame;
        for axis in [tangent, bitangent, normal] {
            assert!((axis.length() - 1.0).abs() < 4.0 * f32::EPSILON, "{frame:?}");
        }
        assert!((tangent.cross(bitangent) - normal).length() < 8.0 * f32::EPSILON, "{frame:?}");
    }

    #[test]
    fn frames_are_right_handed_and_orthonormal() {
        let axes =
            [Vec3::X, Vec3::Y, Vec3::Z, Vec3::NEG_X, Vec3::NEG_Y, Vec3::NEG_Z, Vec3::new(0.0, 0.0, -0.0)];
        for normal in &axes[..6] {
            assert_orthonormal(&Frame::from_normal(*normal));
            for tangent in axes {
                assert_orthonormal(&Frame::from_normal_and_tangent(*normal, 3.0 * tangent));
            }
        }
        for index in 0..10_000 {
            let u = Sampler::at(Sequence::Sobol, 1, [0, 0], index).group(Domain::new(0, 0));
            let normal = warp::sphere([u[0], u[1]]);
            let frame = Frame::from_normal(normal);
            assert_orthonormal(&frame);
            let tangent = warp::sphere([u[2], u[3]]);
            let turned = Frame::from_normal_and_tangent(normal, tangent);
            assert_orthonormal(&turned);
            assert!(turned.tangent.dot(tangent) >= 0.0);
            assert!((frame.to_local(frame.to_world(tangent)) - tangent).length() < 1e-6);
        }
    }

    #[test]
    fn hostile_tangents_fall_back() {
        for tangent in [Vec3::ZERO, Vec3::splat(f32::NAN), Vec3::splat(f32::INFINITY), Vec3::Z * 5.0] {
            assert_eq!(Frame::from_normal_and_tangent(Vec3::Z, tangent), Frame::from_normal(Vec3::Z));
        }
    }
}
