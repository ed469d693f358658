//! Forms that rays meet by a test of their own, where others have triangles.

mod implicit;

pub use implicit::Implicit;

use glam::{Vec2, Vec3};
use luch_mesh::height_map::HeightField;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// A form that is traced as it is, without triangles.
///
/// Each has a mesh in the workshop that approaches it, with the same texture coordinates. Light is not drawn from such a form: one
/// that glows is found by chance alone.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Traced {
    /// A cylinder, a cone or what lies between.
    Frustum(Frustum),
    /// Heights over a grid, two triangles a cell; see [`HeightField`] for where they lie.
    HeightField(Arc<HeightField>),
    /// A surface where a formula is zero.
    Implicit(Implicit),
}

/// A round body that stands upright around the origin: a cylinder if both radii are equal, a cone if one is zero.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Frustum {
    /// Radius at the lower end, metres.
    pub bottom_radius: f32,
    /// Radius at the upper end, metres.
    pub top_radius: f32,
    /// Length along y, metres; the origin is in the middle.
    pub height: f32,
    /// With a disc at both ends.
    pub capped: bool,
}

impl Traced {
    /// What is wrong with it, if anything.
    pub fn problem(&self) -> Option<String> {
        match self {
            Self::Frustum(Frustum { bottom_radius, top_radius, height, .. }) => {
                let all = [bottom_radius, top_radius, height];
                let sound = all.into_iter().all(|size| *size >= 0.0 && size.is_finite());
                let is_body = *height > 0.0 && bottom_radius.max(*top_radius) > 0.0;
                (!sound || !is_body).then(|| {
                    format!(
                        "radii {bottom_radius} and {top_radius} and height {height}, expected finite ones, the height and one radius more than 0"
                    )
                })
            }
            Self::HeightField(field) => field.check().err().map(|error| error.to_string()),
            Self::Implicit(surface) => surface.problem(),
        }
    }

    /// The least and the greatest corner of a box around it, metres.
    pub fn corners(&self) -> [Vec3; 2] {
        match self {
            Self::Frustum(Frustum { bottom_radius, top_radius, height, .. }) => {
                let radius = bottom_radius.max(*top_radius);
                let corner = Vec3::new(radius, 0.5 * height, radius);
                [-corner, corner]
            }
            Self::HeightField(field) => {
                let [low, high] = field.range().unwrap_or([0.0; 2]);
                let half = 0.5 * field.size;
                [Vec3::new(-half.x, low, -half.y), Vec3::new(half.x, high, half.y)]
            }
            Self::Implicit(surface) => surface.corners(),
        }
    }

    /// Whether a point lies inside the body that it encloses.
    pub fn encloses(&self, point: Vec3) -> bool {
        match self {
            Self::Frustum(Frustum { bottom_radius, top_radius, height, capped }) => {
                let part = point.y / height + 0.5;
                let radius = bottom_radius + (top_radius - bottom_radius) * part;
                *capped && (0.0..=1.0).contains(&part) && Vec2::new(point.x, point.z).length() < radius
            }
            Self::HeightField(_) => false,
            Self::Implicit(surface) => surface.encloses(point),
        }
    }

    /// Whether it encloses a body.
    pub fn is_closed(&self) -> bool {
        match self {
            Self::Frustum(frustum) => frustum.capped,
            Self::HeightField(_) => false,
            Self::Implicit(surface) => surface.is_closed(),
        }
    }
}
