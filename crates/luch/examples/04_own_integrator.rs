//! An algorithm of your own: how far away things are, as heat.
//!
//! `cargo run --release -p luch --example 04_own_integrator -- heat.png`

use luch::bvh::{Coherence, Ray};
use luch::prelude::*;
use luch::render::{CameraSample, Stopped};
use std::path::PathBuf;
use std::sync::atomic::AtomicU64;

/// White near, red farther, black at `reach` and beyond.
struct Heat {
    reach: f32,
}

impl Integrator for Heat {
    fn radiance(
        &self,
        world: &World,
        samples: &[CameraSample],
        radiance: &mut [Rgb],
        stop: &Stop,
    ) -> Result<(), Stopped> {
        if stop.is_due() {
            return Err(Stopped);
        }
        // All rays at once: that is what the hardware likes.
        let rays: Vec<Ray> = samples.iter().map(|sample| sample.ray).collect();
        let mut hits = vec![None; rays.len()];
        world.geometry.nearest_hits(&world.scene, &rays, &mut hits, Coherence::Coherent, |i| i as u64);
        for (hit, radiance) in hits.into_iter().zip(radiance) {
            let heat = hit.map_or(0.0, |hit| (1.0 - hit.hit.t / self.reach).max(0.0));
            *radiance = Rgb::new(heat, heat * heat, heat * heat * heat);
        }
        Ok(())
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args().nth(1).map_or_else(|| "heat.png".into(), PathBuf::from);
    let scene = luch::scene::preset::cornell_box();
    let view = View::new(&scene.cameras[0].camera, &scene.settings);
    let world = World::build(scene)?;
    let mut film = Film::new(view.width(), view.height());
    render_pass(&world, &view, &Heat { reach: 8.0 }, &mut film, 0..16, &Stop::new(), &AtomicU64::new(0))?;
    save_image(&path, &film.to_image(), &Default::default(), &Default::default())?;
    Ok(())
}
