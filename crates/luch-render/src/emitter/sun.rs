//! A lamp at infinite distance, with or without a visible disc.

use super::EmitterSample;
use glam::Vec3;
use luch_image::Rgb;
use luch_sampling::Frame;
use luch_sampling::warp::Cone;
use std::f32::consts::PI;

/// A sun.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SunEmitter {
    /// Frame whose normal points to the sun.
    frame: Frame,
    irradiance: Rgb,
    disc: Option<SunDisc>,
}

#[derive(Clone, Copy, Debug)]
struct SunDisc {
    cone: Cone,
    /// Squared length of the chord from the middle to the rim: of a small disc the cosine has no digits left.
    squared_chord: f32,
    radiance: Rgb,
}

impl SunEmitter {
    /// A sun whose light goes along `direction`; `angular_radius` in radians, 0 for a point.
    pub(crate) fn new(direction: Vec3, irradiance: Rgb, angular_radius: f32) -> Self {
        let sine = libm::sinf(angular_radius);
        let half_chord = libm::sinf(angular_radius / 2.0);
        let disc = Cone::from_half_angle(angular_radius).map(|cone| SunDisc {
            cone,
            squared_chord: 4.0 * half_chord * half_chord,
            // A facing surface gathers π sin² of a uniform disc.
            radiance: irradiance / (PI * sine * sine),
        });
        Self { frame: Frame::from_normal(-direction), irradiance, disc }
    }

    pub(crate) fn sample(&self, u: [f32; 2]) -> Option<EmitterSample> {
        match &self.disc {
            None => EmitterSample::checked(self.frame.normal, None, self.irradiance, 1.0, true),
            Some(disc) => {
                let incoming = self.frame.to_world(disc.cone.sample(u));
                EmitterSample::checked(incoming, None, disc.radiance, 1.0 / disc.cone.solid_angle(), false)
            }
        }
    }

    /// Radiance and density of a direction that meets nothing.
    pub(crate) fn toward(&self, direction: Vec3) -> Option<(Rgb, f32)> {
        let disc = self.disc.as_ref()?;
        let inside = direction.distance_squared(self.frame.normal) <= disc.squared_chord;
        inside.then(|| (disc.radiance, 1.0 / disc.cone.solid_angle()))
    }

    pub(crate) fn power(&self, scene_radius: f32) -> f32 {
        self.irradiance.luminance() * PI * scene_radius * scene_radius
    }
}
