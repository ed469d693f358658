//! Ground truth F15: lamps seen in part, by irradiance and by the part of their area that is visible.

use super::formulas::{beside_wall, disc_left_of, lens, part_of_disc, polygon};
use super::measure::{DIRECT, OCCLUSION, PATH, PLAIN, aimed, complaint, expect};
use super::stage::{black, ceiling, facing_down, floor, lamp, put, surround, world};
use glam::{Affine3A, DVec3, Vec2, Vec3};
use luch::bvh::{Coherence, Ray};
use luch::prelude::*;
use luch::sampling::{Domain, Estimate, Sampler, Sequence, warp};
use luch::scene::preset::parallelogram;

const ALBEDO: f32 = 0.8;
/// Everything beyond this is far away.
const FAR: f32 = 400.0;

fn at(x: f32, z: f32) -> Camera {
    aimed(Vec3::new(x + 0.02, 0.1, z + 0.03), Vec3::new(x, 0.0, z))
}

fn factor_of_rectangle(x: [f32; 2], z: [f32; 2], height: f32, point: Vec3) -> f64 {
    let corners = [[x[0], z[0]], [x[1], z[0]], [x[1], z[1]], [x[0], z[1]]];
    polygon(point.as_dvec3(), DVec3::Y, &corners.map(|[x, z]| Vec3::new(x, height, z).as_dvec3()))
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
fn expect_fraction(what: &str, world: &World, from: Vec3, truth: f64, place: impl Fn([f32; 2]) -> Vec3) {
    for sequence in Sequence::ALL {
        let estimate = visible_fraction(world, from, sequence, &place);
        let complaint = if truth > 0.0 { complaint(&estimate, truth) } else { None };
        let exact = truth != 0.0 || estimate.mean() == Some(0.0);
        assert!(complaint.is_none() && exact, "{what} with {}: {complaint:?}", sequence.name());
    }
}

#[test]
fn a_rectangle_behind_a_half_plane() {
    let (width, depth, height, edge) = (2.0_f32, 1.0_f32, 3.0_f32, 1.0_f32);
    let mut scene = Scene::default();
    floor(&mut scene, ALBEDO);
    ceiling(&mut scene, [-1.0, -0.5], [1.0, 0.5], height, lamp(4.0));
    ceiling(&mut scene, [-FAR, -FAR], [0.0, FAR], edge, black());
    let world = world(scene);
    for p in [-0.5_f32, -0.25, 0.0, 0.2, 0.5] {
        let point = Vec3::X * p;
        let cut = (-p * (height - edge) / edge).clamp(-1.0, 1.0);
        let fraction = (0.5 + p * (height - edge) / (edge * width)).clamp(0.0, 1.0);
        let place = |[u, v]: [f32; 2]| Vec3::new((u - 0.5) * width, height, (v - 0.5) * depth);
        expect_fraction("half-plane", &world, point, f64::from(fraction), place);
        let factor = factor_of_rectangle([cut, 1.0], [-0.5, 0.5], height, point);
        let truth = f64::from(ALBEDO) * 4.0 * factor;
        if fraction > 0.0 {
            expect(&format!("half-plane, {p}"), &world, &at(p, 0.0), truth, &[PATH, DIRECT]);
        }
    }
}

#[test]
fn a_wide_rectangle_behind_a_half_plane_by_every_strategy() {
    let mut scene = Scene::default();
    floor(&mut scene, ALBEDO);
    ceiling(&mut scene, [-2.0, -2.0], [2.0, 2.0], 2.0, lamp(4.0));
    ceiling(&mut scene, [-FAR, -FAR], [0.0, FAR], 1.0, black());
    let world = world(scene);
    for p in [-0.3_f32, 0.0, 0.9] {
        let truth = f64::from(ALBEDO) * 4.0 * factor_of_rectangle([-p, 2.0], [-2.0, 2.0], 2.0, Vec3::X * p);
        expect(&format!("half-plane, {p}"), &world, &at(p, 0.0), truth, &[PATH, PLAIN, DIRECT]);
    }
}

#[test]
fn b_rectangle_behind_a_rectangle() {
    let (lamp_half, blocker_half, height, low) = (1.0_f32, 0.25_f32, 4.0_f32, 2.0_f32);
    let mut scene = Scene::default();
    floor(&mut scene, ALBEDO);
    ceiling(&mut scene, [-lamp_half; 2], [lamp_half; 2], height, lamp(4.0));
    ceiling(&mut scene, [-blocker_half; 2], [blocker_half; 2], low, black());
    let world = world(scene);
    let k = height / low;
    for [p, q] in [[0.0_f32, 0.0], [0.3, 0.1], [0.6, 0.6], [1.6, 0.0]] {
        // The shadow of the blocker on the lamp's plane, cut to the lamp.
        let cut = |c: f32| [-1.0, 1.0].map(|s| (c + (s * blocker_half - c) * k).clamp(-lamp_half, lamp_half));
        let (x, z) = (cut(p), cut(q));
        let fraction = 1.0 - (x[1] - x[0]) * (z[1] - z[0]) / (4.0 * lamp_half * lamp_half);
        let point = Vec3::new(p, 0.0, q);
        let place = |[u, v]: [f32; 2]| Vec3::new(2.0 * u - 1.0, height, 2.0 * v - 1.0);
        expect_fraction("rectangle", &world, point, f64::from(fraction), place);
        let whole = factor_of_rectangle([-lamp_half, lamp_half], [-lamp_half, lamp_half], height, point);
        let hidden = if x[0] < x[1] && z[0] < z[1] { factor_of_rectangle(x, z, height, point) } else { 0.0 };
        let truth = f64::from(ALBEDO) * 4.0 * (whole - hidden);
        expect(&format!("rectangle, ({p}, {q})"), &world, &at(p, q), truth, &[PATH, DIRECT]);
    }
}

#[test]
fn c_disc_cut_by_a_straight_edge() {
    let (height, edge) = (2.0_f32, 1.0_f32);
    for s in [-0.5_f32, 0.3] {
        let mut scene = Scene::default();
        floor(&mut scene, ALBEDO);
        put(&mut scene, Shape::Disc { radius: 1.0 }, lamp(4.0), facing_down(Vec3::Y * height));
        // From the origin, an edge at s / 2 halfway up cuts the disc at s.
        ceiling(&mut scene, [s * edge / height, -FAR], [FAR, FAR], edge, black());
        let world = world(scene);
        let place = |u: [f32; 2]| {
            let Vec2 { x, y } = warp::disc(u);
            Vec3::new(x, height, y)
        };
        expect_fraction("edge", &world, Vec3::ZERO, disc_left_of(f64::from(s)), place);
        let factor = part_of_disc(1.0, f64::from(height), 0.0, |x, _| x < f64::from(s));
        expect(
            &format!("edge, {s}"),
            &world,
            &at(0.0, 0.0),
            f64::from(ALBEDO) * 4.0 * factor,
            &[PATH, PLAIN, DIRECT],
        );
    }
}

#[test]
fn d_disc_behind_a_disc() {
    let (blocker, height, low) = (0.4_f32, 4.0_f32, 2.0_f32);
    let mut scene = Scene::default();
    floor(&mut scene, ALBEDO);
    put(&mut scene, Shape::Disc { radius: 1.0 }, lamp(4.0), facing_down(Vec3::Y * height));
    put(&mut scene, Shape::Disc { radius: blocker }, black(), Affine3A::from_translation(Vec3::Y * low));
    let world = world(scene);
    let k = f64::from(height / low);
    for p in [0.0_f32, 0.3, 0.7, 1.2] {
        let (image, center) = (f64::from(blocker) * k, f64::from(p) * (1.0 - k));
        let fraction = 1.0 - lens(1.0, image, center.abs()) / std::f64::consts::PI;
        let place = |u: [f32; 2]| {
            let Vec2 { x, y } = warp::disc(u);
            Vec3::new(x, height, y)
        };
        expect_fraction("disc", &world, Vec3::X * p, fraction, place);
        let sees = |x: f64, y: f64| (x - center) * (x - center) + y * y > image * image;
        let factor = part_of_disc(1.0, f64::from(height), f64::from(p), sees);
        expect(&format!("disc, {p}"), &world, &at(p, 0.0), f64::from(ALBEDO) * 4.0 * factor, &[PATH, DIRECT]);
    }
}

#[test]
fn e_sky_beside_a_wall() {
    for (distance, height) in [(1.0_f32, 1.0_f32), (0.5, 2.0)] {
        let mut scene = Scene::default();
        floor(&mut scene, ALBEDO);
        let wall = parallelogram(Vec3::new(-distance, 0.0, -FAR), Vec3::Y * height, Vec3::Z * 2.0 * FAR);
        put(&mut scene, Shape::Mesh(wall), black(), Affine3A::IDENTITY);
        surround(&mut scene, 1.5);
        let world = world(scene);
        let open = beside_wall(f64::from(distance), f64::from(height));
        expect("wall", &world, &at(0.0, 0.0), open, &[OCCLUSION]);
        expect("wall", &world, &at(0.0, 0.0), f64::from(ALBEDO) * 1.5 * open, &[PATH, PLAIN, DIRECT]);
        // Nothing is near enough to count.
        let near = luch::scene::Integrator::Occlusion { distance: 0.9 * distance };
        expect("reach", &world, &at(0.0, 0.0), 1.0, &[near]);
    }
}
