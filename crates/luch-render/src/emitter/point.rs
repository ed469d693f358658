//! Lamps of no size: a point and a spot.

use super::EmitterSample;
use crate::lights::LightBounds;
use glam::Vec3;
use luch_image::Rgb;
use std::f32::consts::FRAC_PI_2;

/// A point that shines in all directions alike.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PointEmitter {
    pub(crate) position: Vec3,
    /// W·sr⁻¹.
    pub(crate) intensity: Rgb,
}

impl PointEmitter {
    pub(crate) fn sample(&self, from: Vec3) -> Option<EmitterSample> {
        let way = self.position - from;
        let irradiance = self.intensity / way.length_squared();
        EmitterSample::checked(way.try_normalize()?, Some(self.position), irradiance, 1.0, true)
    }

    pub(crate) fn bounds(&self) -> LightBounds {
        LightBounds::round(self.position, 0.0, self.intensity.luminance())
    }
}

/// A point that shines into a cone.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SpotEmitter {
    position: Vec3,
    direction: Vec3,
    intensity: Rgb,
    inner_angle: f32,
    outer_angle: f32,
    cos_inner: f32,
    cos_outer: f32,
}

impl SpotEmitter {
    /// Angles in radians from the axis.
    pub(crate) fn new(
        position: Vec3,
        direction: Vec3,
        intensity: Rgb,
        inner_angle: f32,
        outer_angle: f32,
    ) -> Self {
        let (cos_inner, cos_outer) = (libm::cosf(inner_angle), libm::cosf(outer_angle));
        Self { position, direction, intensity, inner_angle, outer_angle, cos_inner, cos_outer }
    }

    /// Part of the intensity on the axis that goes along a direction (KHR_lights_punctual).
    fn falloff(&self, direction: Vec3) -> f32 {
        let cosine = direction.dot(self.direction);
        if cosine >= self.cos_inner {
            1.0
        } else if cosine <= self.cos_outer {
            0.0
        } else {
            let part = (cosine - self.cos_outer) / (self.cos_inner - self.cos_outer);
            part * part
        }
    }

    pub(crate) fn sample(&self, from: Vec3) -> Option<EmitterSample> {
        let way = self.position - from;
        let incoming = way.try_normalize()?;
        let irradiance = self.intensity * (self.falloff(-incoming) / way.length_squared());
        EmitterSample::checked(incoming, Some(self.position), irradiance, 1.0, true)
    }

    pub(crate) fn bounds(&self) -> LightBounds {
        // Full up to the inner angle; from there to the outer one a cosine bounds the decline, if that is no more than a quarter turn.
        let start = self.inner_angle.max(self.outer_angle - FRAC_PI_2);
        LightBounds {
            axis: self.direction,
            cos_normals: libm::cosf(start),
            cos_falloff: libm::cosf(self.outer_angle - start).max(0.0),
            ..LightBounds::round(self.position, 0.0, self.intensity.luminance())
        }
    }
}
