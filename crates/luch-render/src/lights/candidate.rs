//! Points of lights that many receivers weigh: drawn without regard to who receives.

use super::Lights;
use crate::emitter::{Emitter, EmitterSample};
use crate::surface::SurfacePoint;
use glam::Vec3;
use luch_image::Rgb;
use luch_scene::{Scene, Shape};

/// A point of an emitter, or a direction to it, drawn with a density that is the same for all receivers.
#[derive(Clone, Copy, Debug)]
pub struct Candidate {
    /// The emitter it belongs to.
    pub emitter: u32,
    place: Place,
}

#[derive(Clone, Copy, Debug)]
enum Place {
    /// On a flat lamp, in parts of its edges, uniform by area.
    Flat([f32; 2]),
    /// Infinitely far.
    Far(EmitterSample),
    /// Where a light without extent is.
    Single,
}

/// A candidate as plain data, for loops over receivers.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shone {
    /// The point, or the direction if it is infinitely far.
    pub(crate) place: Vec3,
    /// Of the lamp, on the side that shines.
    pub(crate) normal: Vec3,
    pub(crate) two_sided: bool,
    pub(crate) radiance: Rgb,
    /// Density per area; 0 if it is infinitely far.
    pub(crate) pdf_area: f32,
    /// Density per solid angle if it is infinitely far.
    pub(crate) pdf: f32,
    pub(crate) delta: bool,
}

impl Lights {
    /// Whether every emitter can be drawn from without regard to the receiver.
    pub fn is_shareable(&self) -> bool {
        !self.others.iter().any(|emitter| matches!(emitter, Emitter::Ball(_) | Emitter::Disc(_)))
    }

    /// Draws a point of an emitter; `None` if it cannot be shared or sends nothing from there.
    pub fn candidate(&self, emitter: u32, scene: &Scene, u: [f32; 2]) -> Option<Candidate> {
        let place = match (emitter as usize).checked_sub(self.flat.len()) {
            None => Place::Flat(self.flat[emitter as usize].place_by_area(u)),
            Some(other) => match &self.others[other] {
                Emitter::Sun(sun) => Place::Far(sun.sample(u)?),
                Emitter::Environment(environment) => Place::Far(environment.sample(scene, u)?),
                Emitter::Point(_) | Emitter::Spot(_) => Place::Single,
                Emitter::Ball(_) | Emitter::Disc(_) => return None,
            },
        };
        Some(Candidate { emitter, place })
    }

    /// What a candidate sends; `None` for lights whose radiance depends on where it is seen from.
    pub(crate) fn shone(&self, candidate: &Candidate, scene: &Scene) -> Option<Shone> {
        match candidate.place {
            Place::Flat(place) => {
                let lamp = &self.flat[candidate.emitter as usize];
                Some(Shone {
                    place: lamp.point(place),
                    normal: lamp.normal,
                    two_sided: lamp.two_sided,
                    radiance: lamp.radiance_at(scene, place),
                    pdf_area: 1.0 / lamp.area,
                    pdf: 0.0,
                    delta: false,
                })
            }
            Place::Far(sample) => Some(Shone {
                place: sample.incoming,
                normal: Vec3::ZERO,
                two_sided: true,
                radiance: sample.radiance,
                pdf_area: 0.0,
                pdf: sample.pdf,
                delta: sample.delta,
            }),
            Place::Single => None,
        }
    }

    /// A candidate as seen from a receiver; its density is that of the candidate alone, without the choice of emitter.
    #[inline]
    pub fn toward(&self, candidate: &Candidate, scene: &Scene, from: Vec3) -> Option<EmitterSample> {
        match candidate.place {
            Place::Flat(place) => self.flat[candidate.emitter as usize].toward_place(scene, from, place),
            Place::Far(sample) => Some(sample),
            Place::Single => self.sample_emitter(candidate.emitter, scene, from, [0.0; 2]),
        }
    }

    /// The emitter that a point of a surface belongs to, and the density per area with which candidates of it are drawn there;
    /// `None` if there are none.
    pub(crate) fn candidate_pdf_area(&self, point: &SurfacePoint) -> Option<CandidateDensity> {
        let Shape::Mesh(_) = point.place.shape else { return None };
        let emitter = self.emitter_at(point.hit.instance, point.place.primitive as u32)?;
        let pdf_area = 1.0 / self.flat.get(emitter as usize)?.area;
        Some(CandidateDensity { emitter, pdf_area })
    }
}

/// How densely candidates are drawn from an emitter.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CandidateDensity {
    pub(crate) emitter: u32,
    /// Without the choice of emitter.
    pub(crate) pdf_area: f32,
}
