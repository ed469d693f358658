//! Lights that are not surfaces.

use crate::Id;
use glam::{Mat3, Vec3};
use luch_image::{Bitmap, Rgb};
use serde::{Deserialize, Serialize};

/// A lamp without a surface that could be hit.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Light {
    /// Shines from a point, the same in all directions.
    Point {
        /// Where.
        position: Vec3,
        /// Radiant intensity, W·sr⁻¹.
        intensity: Rgb,
    },
    /// Shines from a point into a cone.
    Spot {
        /// Where.
        position: Vec3,
        /// Axis of the cone, unit length.
        direction: Vec3,
        /// Radiant intensity on the axis, W·sr⁻¹.
        intensity: Rgb,
        /// Half-angle up to which the intensity is full, radians.
        inner_angle: f32,
        /// Half-angle from which it is zero, radians, at least the inner one, at most π. Between the two the intensity is
        /// (clamp((cos θ − cos outer) / (cos inner − cos outer)))², as in KHR_lights_punctual.
        outer_angle: f32,
    },
    /// Shines from very far.
    Sun {
        /// Where the light goes, unit length.
        direction: Vec3,
        /// Irradiance on a surface facing it, W·m⁻².
        irradiance: Rgb,
        /// Half-angle under which the disc is seen, radians; 0 for a point. The real sun has 0.004 65.
        angular_radius: f32,
    },
}

/// What surrounds the scene at infinite distance.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Environment {
    /// The same radiance from everywhere.
    Constant {
        /// Radiance, W·sr⁻¹·m⁻².
        radiance: Rgb,
    },
    /// A picture in latitude and longitude: top row +Y, middle column −Z, a quarter to the right of it +X.
    LatLong {
        /// The picture.
        image: Id<Bitmap>,
        /// Radiance of a pixel of value 1.
        scale: Rgb,
        /// Turns directions of the picture into directions of the world.
        rotation: Mat3,
    },
}
