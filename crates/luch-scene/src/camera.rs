//! The eye.

use glam::{Affine3A, Mat3, Vec3};
use serde::{Deserialize, Serialize};

/// Where the picture is taken from, and how. The camera looks down its own −Z, +Y is up in the picture.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Camera {
    /// Place of the eye.
    pub position: Vec3,
    /// Camera axes in the world: right, up, backward, as columns; orthonormal.
    pub orientation: Mat3,
    /// How directions become places in the picture.
    pub projection: Projection,
    /// Radius of the lens in metres; 0 is a pinhole.
    pub lens_radius: f32,
    /// Distance, along the viewing axis, of the plane that is sharp; more than 0.
    pub focus_distance: f32,
}

/// How directions become places in the picture.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Projection {
    /// Straight lines stay straight, distant things are small.
    Perspective {
        /// Angle between the lower and the upper edge of the picture, radians, less than π.
        field_of_view_y: f32,
    },
    /// Parallel rays.
    Orthographic {
        /// Height of what is seen, metres.
        height: f32,
    },
}

impl Camera {
    /// A pinhole at `position` that looks at `target`; `field_of_view_y` in radians.
    ///
    /// If `up` is parallel to the view, another direction is taken for it.
    pub fn looking_at(position: Vec3, target: Vec3, up: Vec3, field_of_view_y: f32) -> Self {
        Self {
            position,
            orientation: orientation(target - position, up),
            projection: Projection::Perspective { field_of_view_y },
            lens_radius: 0.0,
            focus_distance: (target - position).length().max(f32::MIN_POSITIVE),
        }
    }

    /// The camera carried along by `placement`; scale and shear are dropped.
    pub fn placed(mut self, placement: &Affine3A) -> Self {
        self.position = placement.transform_point3(self.position);
        let backward = placement.transform_vector3(self.orientation.z_axis);
        let up = placement.transform_vector3(self.orientation.y_axis);
        self.orientation = orientation(-backward, up);
        self
    }
}

/// Right, up and backward for a view along `forward`.
fn orientation(forward: Vec3, up: Vec3) -> Mat3 {
    let backward = -forward.try_normalize().unwrap_or(Vec3::NEG_Z);
    let right = up.cross(backward).try_normalize().unwrap_or_else(|| {
        let other = if backward.y.abs() < 0.9 { Vec3::Y } else { Vec3::NEG_Z };
        other.cross(backward).normalize()
    });
    Mat3::from_cols(right, backward.cross(right), backward)
}
