//! Ambient occlusion: which part of the cosine-weighted hemisphere is open within a distance.

use super::Integrator;
use crate::stop::{Stop, Stopped};
use crate::surface::SurfacePoint;
use crate::view::CameraSample;
use crate::world::World;
use crate::{opacity_key, purpose};
use luch_bvh::{Coherence, Ray};
use luch_image::Rgb;
use luch_sampling::warp::cosine_hemisphere;

/// Ambient occlusion; what meets nothing is white.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Occlusion {
    /// Metres; infinite for all the way.
    pub distance: f32,
}

impl Integrator for Occlusion {
    fn radiance(
        &self,
        world: &World,
        samples: &[CameraSample],
        radiance: &mut [Rgb],
        stop: &Stop,
    ) -> Result<(), Stopped> {
        stop.check()?;
        let rays: Vec<Ray> = samples.iter().map(|sample| sample.ray).collect();
        let mut hits = vec![None; rays.len()];
        let key = |i: usize| opacity_key(&samples[i].sampler, purpose::opacity(0));
        world.geometry.nearest_hits(&world.scene, &rays, &mut hits, Coherence::Coherent, key);
        stop.check()?;

        // A ray from each surface seen, on the side it is seen from.
        let (mut rays_out, mut owners) = (Vec::new(), Vec::new());
        for (i, hit) in hits.iter().enumerate() {
            radiance[i] = Rgb::WHITE;
            let Some(hit) = hit else { continue };
            let point = SurfacePoint::new(&world.scene, &world.geometry, &rays[i], *hit);
            let [u, v, ..] = samples[i].sampler.group(purpose::scatter(0));
            let mut local = cosine_hemisphere([u, v]);
            if !point.is_front() {
                local.z = -local.z;
            }
            let direction = point.frame.to_world(local);
            if point.exit().is_honest(direction) {
                rays_out.push(Ray { t_max: self.distance, ..point.exit().ray_toward(direction) });
                owners.push(i);
            } else {
                radiance[i] = Rgb::BLACK;
            }
        }
        let mut occluded = vec![false; rays_out.len()];
        let key = |i: usize| opacity_key(&samples[owners[i]].sampler, purpose::light_opacity(0));
        world.geometry.occluded(&world.scene, &rays_out, &mut occluded, Coherence::Incoherent, key);
        for (owner, occluded) in owners.into_iter().zip(occluded) {
            if occluded {
                radiance[owner] = Rgb::BLACK;
            }
        }
        Ok(())
    }
}
