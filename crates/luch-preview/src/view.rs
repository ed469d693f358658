//! Where points of the world lie in the picture: the renderer's own mapping, the other way round.
//!
//! The renderer sends the ray of a place (x, y), in pixels from the upper left corner, through the slopes
//! `(x − width/2) · s` and `(height/2 − y) · s` with `s = 2 tan(angle/2) / height`, or with `s = metres / height` if its rays
//! are parallel. Everything here happens in *view space*: x to the right and y downward, both already divided by `s`, and
//! the depth along the viewing axis. There a point lies at `x / depth`, `y / depth` samples from the middle of the picture,
//! or at `x`, `y` if rays are parallel. The lens is a pinhole.

use crate::PreviewError;
use glam::{Affine3A, DAffine3, DMat3, DVec2, DVec3, Mat3};
use luch_scene::{Camera, Projection};

/// How wide and how high a picture is, in pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Size {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
}

/// How view space becomes the picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Rays {
    /// All from the eye.
    Central,
    /// All along the viewing axis.
    Parallel,
}

/// A camera with a grid of samples.
#[derive(Clone, Debug)]
pub(crate) struct View {
    /// Samples in a row, rows of samples.
    pub(crate) size: Size,
    pub(crate) rays: Rays,
    /// The middle of the picture, in samples from its upper left corner.
    pub(crate) middle: DVec2,
    /// From the world to view space.
    pub(crate) to_view: DAffine3,
    /// Samples in one unit of slope, or in a metre if rays are parallel.
    pub(crate) samples_per_unit: f64,
    /// From view space to the world, directions only.
    to_world: DMat3,
}

/// A straight line of sight in any affine frame; its parameter is the depth.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sight {
    pub(crate) origin: DVec3,
    pub(crate) direction: DVec3,
}

impl Sight {
    pub(crate) fn at(&self, depth: f64) -> DVec3 {
        self.origin + self.direction * depth
    }

    pub(crate) fn through(&self, map: &DAffine3) -> Self {
        Self { origin: map.transform_point3(self.origin), direction: map.transform_vector3(self.direction) }
    }
}

impl View {
    /// What `camera` sees in a picture of `size` with `factor` samples along each side of a pixel.
    pub(crate) fn new(camera: &Camera, size: Size, factor: u32) -> Result<Self, PreviewError> {
        let wrong = |what| Err(PreviewError::Camera { what });
        if !camera.position.is_finite() {
            return wrong("position is not finite");
        }
        let axes = wide(&camera.orientation);
        let determinant = axes.determinant();
        if !axes.is_finite() || !determinant.is_finite() || determinant.abs() < 1e-6 {
            return wrong("axes do not span space");
        }
        let (rays, half_height) = match camera.projection {
            Projection::Perspective { field_of_view_y } => {
                if !(field_of_view_y > 0.0 && field_of_view_y < std::f32::consts::PI) {
                    return wrong("angle is not between 0 and π");
                }
                (Rays::Central, libm::tanf(field_of_view_y / 2.0))
            }
            Projection::Orthographic { height } => (Rays::Parallel, height / 2.0),
        };
        // In single precision, as the renderer computes it.
        let scale = f64::from(2.0 * half_height / size.height as f32) / f64::from(factor);
        if !(scale > 0.0 && scale.is_finite()) {
            return wrong("view has no height");
        }
        let samples_per_unit = 1.0 / scale;
        let squeeze = DMat3::from_diagonal(DVec3::new(samples_per_unit, -samples_per_unit, -1.0));
        let matrix = squeeze * axes.inverse();
        let to_view = DAffine3 { matrix3: matrix, translation: -(matrix * camera.position.as_dvec3()) };
        let size = Size { width: size.width * factor, height: size.height * factor };
        let middle = DVec2::new(f64::from(size.width), f64::from(size.height)) / 2.0;
        let to_world = axes * DMat3::from_diagonal(DVec3::new(scale, -scale, -1.0));
        Ok(Self { size, rays, middle, to_view, samples_per_unit, to_world })
    }

    /// From an instance's coordinates to view space.
    pub(crate) fn place(&self, placement: &Affine3A) -> DAffine3 {
        self.to_view * wide_affine(placement)
    }

    /// What x and y of a point in view space are divided by.
    #[inline]
    pub(crate) fn divisor(&self, depth: f64) -> f64 {
        match self.rays {
            Rays::Central => depth,
            Rays::Parallel => 1.0,
        }
    }

    /// The depth as a number that is linear over the picture on every plane.
    #[inline]
    pub(crate) fn linear(&self, depth: f64) -> f64 {
        match self.rays {
            Rays::Central => 1.0 / depth,
            Rays::Parallel => depth,
        }
    }

    /// The other way: both are their own inverses.
    pub(crate) fn depth(&self, linear: f64) -> f64 {
        self.linear(linear)
    }

    /// The line of sight through a place of the picture, in view space.
    pub(crate) fn sight(&self, place: DVec2) -> Sight {
        let from_middle = place - self.middle;
        match self.rays {
            Rays::Central => Sight { origin: DVec3::ZERO, direction: from_middle.extend(1.0) },
            Rays::Parallel => Sight { origin: from_middle.extend(0.0), direction: DVec3::Z },
        }
    }

    /// Unit direction from what is seen at a place of the picture to the eye, in the world.
    pub(crate) fn toward_eye(&self, place: DVec2) -> DVec3 {
        (self.to_world * -self.sight(place).direction).normalize()
    }

    /// How wide a sample is at a depth, in metres.
    pub(crate) fn footprint(&self, depth: f64) -> f64 {
        self.divisor(depth) / self.samples_per_unit
    }
}

fn wide(matrix: &Mat3) -> DMat3 {
    DMat3::from_cols(matrix.x_axis.as_dvec3(), matrix.y_axis.as_dvec3(), matrix.z_axis.as_dvec3())
}

/// A placement in double precision.
pub(crate) fn wide_affine(map: &Affine3A) -> DAffine3 {
    DAffine3 {
        matrix3: wide(&Mat3::from(map.matrix3)),
        translation: glam::Vec3::from(map.translation).as_dvec3(),
    }
}
