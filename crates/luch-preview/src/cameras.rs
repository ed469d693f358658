//! Cameras that are found by what is to be seen: around everything, from customary sides.

use glam::{Mat3, Vec3};
use luch_bvh::Aabb;
use luch_scene::{Camera, Projection};

/// Part of the picture's half that is left free on each side.
const MARGIN: f32 = 0.04;

/// A side from which things are looked at. The front faces +Z, up is +Y.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StandardView {
    /// From +Z.
    Front,
    /// From −Z.
    Back,
    /// From −X.
    Left,
    /// From +X.
    Right,
    /// From +Y; the front is at the lower edge.
    Top,
    /// From −Y; the front is at the upper edge.
    Bottom,
    /// From the front, the right and above.
    ThreeQuarter,
}

impl StandardView {
    /// All of them.
    pub const ALL: [Self; 7] =
        [Self::Front, Self::Back, Self::Left, Self::Right, Self::Top, Self::Bottom, Self::ThreeQuarter];

    /// The name on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Front => "front",
            Self::Back => "back",
            Self::Left => "left",
            Self::Right => "right",
            Self::Top => "top",
            Self::Bottom => "bottom",
            Self::ThreeQuarter => "three-quarter",
        }
    }

    /// The one called `name`.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|view| view.name() == name)
    }

    /// The direction in which the camera looks, not of unit length.
    pub const fn direction(self) -> Vec3 {
        match self {
            Self::Front => Vec3::NEG_Z,
            Self::Back => Vec3::Z,
            Self::Left => Vec3::X,
            Self::Right => Vec3::NEG_X,
            Self::Top => Vec3::NEG_Y,
            Self::Bottom => Vec3::Y,
            Self::ThreeQuarter => Vec3::new(-0.7, -0.5, -1.0),
        }
    }
}

/// A pinhole that looks along `direction` and sees a whole box, as large as fits; see [`frame_all_parallel`] for parallel rays.
///
/// `field_of_view_y` in radians, taken between 0.001 and 3; `aspect` is width over height of the picture. The up of the
/// picture is +Y, or the front or the back if the camera looks straight down or up. An empty box counts as a small one about
/// the origin, a direction without length as that of [`StandardView::ThreeQuarter`].
pub fn frame_all(bounds: &Aabb, direction: Vec3, field_of_view_y: f32, aspect: f32) -> Camera {
    let frame = Frame::new(bounds, direction);
    let field_of_view_y = if field_of_view_y > 0.0 { field_of_view_y.clamp(0.001, 3.0) } else { 0.6 };
    let slope_y = libm::tanf(field_of_view_y / 2.0) * (1.0 - MARGIN);
    let slope_x = slope_y * sound_aspect(aspect);
    // So far back that every corner lies within the slopes.
    let needed = |corner: Vec3| corner.z + (corner.x.abs() / slope_x).max(corner.y.abs() / slope_y);
    let distance = frame.corners.map(needed).into_iter().fold(f32::MIN_POSITIVE, f32::max);
    frame.camera(distance, Projection::Perspective { field_of_view_y })
}

/// A camera with parallel rays that looks along `direction` and sees a whole box; the rest as in [`frame_all`].
pub fn frame_all_parallel(bounds: &Aabb, direction: Vec3, aspect: f32) -> Camera {
    let frame = Frame::new(bounds, direction);
    let aspect = sound_aspect(aspect);
    let extent = |corner: Vec3| corner.y.abs().max(corner.x.abs() / aspect);
    let half = frame.corners.map(extent).into_iter().fold(f32::MIN_POSITIVE, f32::max);
    let depth = frame.corners.map(|corner| corner.z).into_iter().fold(f32::MIN_POSITIVE, f32::max);
    frame.camera(depth * 2.0, Projection::Orthographic { height: 2.0 * half / (1.0 - MARGIN) })
}

fn sound_aspect(aspect: f32) -> f32 {
    if aspect > 0.0 { aspect.clamp(1e-3, 1e3) } else { 1.0 }
}

/// A box in the axes of a camera.
struct Frame {
    middle: Vec3,
    orientation: Mat3,
    /// From the middle, along right, up and backward.
    corners: [Vec3; 8],
}

impl Frame {
    fn new(bounds: &Aabb, direction: Vec3) -> Self {
        let is_sound = !bounds.is_empty() && bounds.min.is_finite() && bounds.max.is_finite();
        let (middle, half) = match is_sound {
            true => (bounds.centroid(), bounds.max * 0.5 - bounds.min * 0.5),
            false => (Vec3::ZERO, Vec3::splat(0.5)),
        };
        // A point gets a little space about it, so that there is something to stand back from.
        let least = (middle.abs().max_element() * 1e-4).max(1e-30);
        let half = half.max(Vec3::splat(if half.max_element() > least { 0.0 } else { least }));
        let forward =
            direction.try_normalize().unwrap_or_else(|| StandardView::ThreeQuarter.direction().normalize());
        let backward = -forward;
        let right = Vec3::Y.cross(backward).try_normalize().filter(|_| backward.y.abs() < 0.9999);
        let right = right.unwrap_or(Vec3::X - backward * backward.x).normalize();
        let orientation = Mat3::from_cols(right, backward.cross(right), backward);
        let corners = std::array::from_fn(|corner| {
            let sign = |axis: usize| if corner >> axis & 1 == 0 { -1.0 } else { 1.0 };
            orientation.transpose() * (half * Vec3::new(sign(0), sign(1), sign(2)))
        });
        Self { middle, orientation, corners }
    }

    fn camera(&self, distance: f32, projection: Projection) -> Camera {
        Camera {
            position: self.middle + self.orientation.z_axis * distance,
            orientation: self.orientation,
            projection,
            lens_radius: 0.0,
            focus_distance: distance,
        }
    }
}
