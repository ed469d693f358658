//! The environment: drawn by the cosine and by its brightness, weighed by the balance heuristic.

use super::lamp::{Receiver, Sample, scaled};
use glam::Vec3;
use luch_render::World;
use luch_sampling::{Frame, warp};

/// A world of nothing but the environment.
pub(super) struct Beyond<'a> {
    pub(super) alone: &'a World,
}

pub(super) fn sample(receiver: &Receiver<'_>, beyond: &Beyond<'_>, u: [f64; 4], key: u64) -> Sample {
    let World { scene, lights, .. } = beyond.alone;
    let frame = Frame::from_normal(receiver.normal);
    let pair = |i: usize| [u[i] as f32, u[i + 1] as f32];
    let cosine_pdf = |direction: Vec3| f64::from(warp::cosine_hemisphere_pdf(frame.to_local(direction)));
    let mut found = Sample::default();

    let direction = frame.to_world(warp::cosine_hemisphere(pair(0)));
    if receiver.is_free(direction, f32::INFINITY, key) {
        found.seen = 1.0;
        let cosine = f64::from(direction.dot(receiver.normal).max(0.0));
        for light in lights.beyond(scene, receiver.at, Vec3::ZERO, direction) {
            let weighed = cosine / (cosine_pdf(direction) + f64::from(light.pdf));
            found.add(scaled(light.radiance, weighed));
        }
    }
    if let Some(drawn) = lights.sample(scene, receiver.at, Vec3::ZERO, 0.5, pair(2)) {
        let cosine = f64::from(drawn.incoming.dot(receiver.normal).max(0.0));
        if cosine > 0.0 && receiver.is_free(drawn.incoming, f32::INFINITY, key) {
            found.add(scaled(drawn.radiance, cosine / (cosine_pdf(drawn.incoming) + f64::from(drawn.pdf))));
        }
    }
    found
}

impl Sample {
    fn add(&mut self, light: [f64; 3]) {
        self.light.iter_mut().zip(light).for_each(|(sum, light)| *sum += light);
    }
}
