//! Which part of a lamp's area is seen from a point, asked of the geometry alone, in the scenes of F15.

use super::world;
use glam::{Vec2, Vec3};
use luch_bvh::{Coherence, Ray};
use luch_lab::problem::polygon::lens;
use luch_lab::truth::formulas::disc_left_of;
use luch_lab::truth::{DISTANCE, Family};
use luch_render::World;
use luch_sampling::{Domain, Estimate, Sampler, Sequence, warp};

/// The world of the first case whose name begins so.
fn world_of(name: &str) -> World {
    let cases = Family::F15.cases();
    world(cases.into_iter().find(|case| case.name.starts_with(name)).expect(name).scene)
}

/// The part of the lamp's area that is visible from a point: places by `warp`, asked of the geometry.
fn visible_fraction(
    world: &World,
    from: Vec3,
    sequence: Sequence,
    place: impl Fn([f32; 2]) -> Vec3,
) -> Estimate {
    let replicate = |pixel: u32| {
        let rays: Vec<Ray> = (0..4096)
            .map(|i| {
                let [u, v, ..] = Sampler::at(sequence, 5, [pixel, 0], i).group(Domain::new(0, 0));
                Ray { t_max: 0.9999, ..Ray::segment(from + Vec3::Y * 1e-4, place([u, v])) }
            })
            .collect();
        let mut hidden = vec![false; rays.len()];
        world.geometry.occluded(&world.scene, &rays, &mut hidden, Coherence::Incoherent, |_| 0);
        hidden.iter().filter(|hidden| !**hidden).count() as f64 / rays.len() as f64
    };
    (0..64).map(replicate).collect()
}

#[track_caller]
fn expect_fraction(world: &World, from: Vec3, truth: f64, place: impl Fn([f32; 2]) -> Vec3) {
    for sequence in Sequence::ALL {
        let estimate = visible_fraction(world, from, sequence, &place);
        let (mean, error) = (estimate.mean().unwrap(), estimate.standard_error().unwrap());
        // Places are single precision.
        let good = (mean - truth).abs() <= DISTANCE * error + 1e-5 * truth && error <= 0.005 * truth;
        assert!(good, "from {from} with {}: {mean} ± {error}, expected {truth}", sequence.name());
    }
}

#[test]
fn a_rectangle_behind_a_half_plane() {
    let (width, depth, height, edge) = (2.0_f32, 1.0_f32, 3.0_f32, 1.0_f32);
    let world = world_of("rectangle behind a half-plane");
    for p in [-0.5_f32, -0.25, 0.0, 0.2, 0.5] {
        let fraction = (0.5 + p * (height - edge) / (edge * width)).clamp(0.0, 1.0);
        let place = |[u, v]: [f32; 2]| Vec3::new((u - 0.5) * width, height, (v - 0.5) * depth);
        expect_fraction(&world, Vec3::X * p, f64::from(fraction), place);
    }
}

#[test]
fn a_rectangle_behind_a_rectangle() {
    let (lamp_half, blocker_half, height, low) = (1.0_f32, 0.25_f32, 4.0_f32, 2.0_f32);
    let world = world_of("rectangle behind a rectangle");
    let k = height / low;
    for [p, q] in [[0.0_f32, 0.0], [0.3, 0.1], [0.6, 0.6], [1.6, 0.0]] {
        // The shadow of the blocker on the lamp's plane, cut to the lamp.
        let cut = |c: f32| [-1.0, 1.0].map(|s| (c + (s * blocker_half - c) * k).clamp(-lamp_half, lamp_half));
        let (x, z) = (cut(p), cut(q));
        let fraction = 1.0 - (x[1] - x[0]) * (z[1] - z[0]) / (4.0 * lamp_half * lamp_half);
        let place = |[u, v]: [f32; 2]| Vec3::new(2.0 * u - 1.0, height, 2.0 * v - 1.0);
        expect_fraction(&world, Vec3::new(p, 0.0, q), f64::from(fraction), place);
    }
}

/// A place of a disc of radius 1.
fn on_disc(u: [f32; 2], height: f32) -> Vec3 {
    let Vec2 { x, y } = warp::disc(u);
    Vec3::new(x, height, y)
}

#[test]
fn a_disc_cut_by_a_straight_edge() {
    for s in [-0.5, 0.3] {
        let world = world_of(&format!("disc cut at {s} "));
        expect_fraction(&world, Vec3::ZERO, disc_left_of(s), |u| on_disc(u, 2.0));
    }
}

#[test]
fn a_disc_behind_a_disc() {
    let (blocker, height, low) = (0.4_f32, 4.0_f32, 2.0_f32);
    let world = world_of("disc behind a disc");
    let k = f64::from(height / low);
    for p in [0.0_f32, 0.3, 0.7, 1.2] {
        let (image, center) = (f64::from(blocker) * k, f64::from(p) * (1.0 - k));
        let fraction = 1.0 - lens(1.0, image, center.abs()) / std::f64::consts::PI;
        expect_fraction(&world, Vec3::X * p, fraction, |u| on_disc(u, height));
    }
}
