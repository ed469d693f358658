//! Directions in which surfaces scatter: every example of every model, seen from four angles.

use super::Routine;
use glam::Vec3;
use luch_render::Bsdf;

/// Cosines of the viewing direction; the last is on the inside.
const COSINES: [f32; 4] = [0.95, 0.5, 0.1, -0.6];

pub(super) fn direction(cosine: f32, azimuth: f32) -> Vec3 {
    let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
    Vec3::new(sine * libm::cosf(azimuth), sine * libm::sinf(azimuth), cosine)
}

/// A draw of a direction, delta lobes left out.
pub(super) fn draw(bsdf: &Bsdf, outgoing: Vec3, [u, v, choice, _]: [f32; 4]) -> Option<Vec3> {
    let sample = bsdf.sample(outgoing, [u, v], choice)?;
    (!sample.specular).then_some(sample.incoming)
}

pub(super) fn routines() -> Vec<Routine> {
    let mut all = Vec::new();
    for (example, (name, bsdf)) in Bsdf::examples().into_iter().enumerate() {
        // A delta lobe has no density that could be tested.
        if bsdf.is_specular() {
            continue;
        }
        let (model, rest) = name.split_once(' ').unwrap_or((name, ""));
        for (turn, cosine) in COSINES.into_iter().enumerate() {
            // Models that are alike on both sides need no look from behind.
            if cosine < 0.0 && !bsdf.transmits() {
                continue;
            }
            let outgoing = direction(cosine, (example + 2 * turn) as f32);
            all.push(Routine::directions(
                model,
                format!("{rest}, cos {cosine}"),
                Vec3::Z,
                move |u| draw(&bsdf, outgoing, u),
                move |incoming| bsdf.pdf(outgoing, incoming),
            ));
        }
    }
    all
}
