//! A lamp at infinite distance, with or without a visible disc.

use super::{EmitterSample, FarLight};
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
    /// Sine and cosine of the angular radius.
    angle: [f32; 2],
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
            angle: [sine, libm::cosf(angular_radius)],
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
    pub(crate) fn toward(&self, direction: Vec3) -> Option<FarLight> {
        let disc = self.disc.as_ref()?;
        let inside = direction.distance_squared(self.frame.normal) <= disc.squared_chord;
        inside.then(|| FarLight { radiance: disc.radiance, pdf: 1.0 / disc.cone.solid_angle() })
    }

    /// Where the sun stands; unit length.
    pub(crate) fn direction(&self) -> Vec3 {
        self.frame.normal
    }

    /// Irradiance of a surface that faces it, as luminance.
    pub(crate) fn irradiance(&self) -> f32 {
        self.irradiance.luminance()
    }

    /// Sine and cosine of the angle under which its radius is seen.
    pub(crate) fn angle(&self) -> [f32; 2] {
        self.disc.as_ref().map_or([0.0, 1.0], |disc| disc.angle)
    }
}
