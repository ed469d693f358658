//! F15: lamps and skies that are seen in part.

use super::formulas::{beside_wall, part_of_disc, polygon};
use super::stage::{aimed_at_floor, black, ceiling, facing_down, floor, lamp, put, surround};
use super::{Case, Family, Way};
use glam::{Affine3A, DVec3, Vec3};
use luch_scene::preset::parallelogram;
use luch_scene::{Integrator, Scene, Shape};

const ALBEDO: f32 = 0.8;
const RADIANCE: f32 = 4.0;
/// Everything beyond this is far away.
const FAR: f32 = 400.0;
const SAMPLED: [Integrator; 2] = [Way::PATH, Way::DIRECT];
const ALL: [Integrator; 3] = [Way::PATH, Way::PLAIN, Way::DIRECT];

fn over_floor(build: impl FnOnce(&mut Scene)) -> Scene {
    let mut scene = Scene::default();
    floor(&mut scene, ALBEDO);
    build(&mut scene);
    scene
}

/// A case at a point of the floor that sees a form factor of `factor`.
fn case(name: &str, scene: &Scene, [x, z]: [f32; 2], factor: f64) -> Case {
    let truth = f64::from(ALBEDO) * f64::from(RADIANCE) * factor;
    Case::new(Family::F15, format!("{name} from ({x}, {z})"), scene, aimed_at_floor(x, z), truth)
}

fn factor_of_rectangle(x: [f32; 2], z: [f32; 2], height: f32, [px, pz]: [f32; 2]) -> f64 {
    let corners = [[x[0], z[0]], [x[1], z[0]], [x[1], z[1]], [x[0], z[1]]];
    let corners = corners.map(|[x, z]| Vec3::new(x, height, z).as_dvec3());
    polygon(Vec3::new(px, 0.0, pz).as_dvec3(), DVec3::Y, &corners)
}

pub(super) fn in_part() -> Vec<Case> {
    let parts = [half_plane, wide_half_plane, rectangle_behind_rectangle, cut_disc, disc_behind_disc, wall];
    parts.into_iter().flat_map(|part| part()).collect()
}

fn half_plane() -> Vec<Case> {
    let (height, edge) = (3.0_f32, 1.0_f32);
    let scene = over_floor(|scene| {
        ceiling(scene, [-1.0, -0.5], [1.0, 0.5], height, lamp(RADIANCE));
        ceiling(scene, [-FAR, -FAR], [0.0, FAR], edge, black());
    });
    let at = |p: f32| {
        let cut = (-p * (height - edge) / edge).clamp(-1.0, 1.0);
        let factor = factor_of_rectangle([cut, 1.0], [-0.5, 0.5], height, [p, 0.0]);
        case("rectangle behind a half-plane,", &scene, [p, 0.0], factor).by(&SAMPLED)
    };
    [-0.25, 0.0, 0.2, 0.5].map(at).into()
}

fn wide_half_plane() -> Vec<Case> {
    let scene = over_floor(|scene| {
        ceiling(scene, [-2.0, -2.0], [2.0, 2.0], 2.0, lamp(RADIANCE));
        ceiling(scene, [-FAR, -FAR], [0.0, FAR], 1.0, black());
    });
    let at = |p: f32| {
        let factor = factor_of_rectangle([-p, 2.0], [-2.0, 2.0], 2.0, [p, 0.0]);
        case("wide rectangle behind a half-plane,", &scene, [p, 0.0], factor).by(&ALL)
    };
    [-0.3, 0.0, 0.9].map(at).into()
}

fn rectangle_behind_rectangle() -> Vec<Case> {
    let (lamp_half, blocker_half, height, low) = (1.0_f32, 0.25_f32, 4.0_f32, 2.0_f32);
    let scene = over_floor(|scene| {
        ceiling(scene, [-lamp_half; 2], [lamp_half; 2], height, lamp(RADIANCE));
        ceiling(scene, [-blocker_half; 2], [blocker_half; 2], low, black());
    });
    let k = height / low;
    let at = |[p, q]: [f32; 2]| {
        // The shadow of the blocker on the lamp's plane, cut to the lamp.
        let cut = |c: f32| [-1.0, 1.0].map(|s| (c + (s * blocker_half - c) * k).clamp(-lamp_half, lamp_half));
        let (x, z) = (cut(p), cut(q));
        let whole = factor_of_rectangle([-lamp_half, lamp_half], [-lamp_half, lamp_half], height, [p, q]);
        let is_hidden = x[0] < x[1] && z[0] < z[1];
        let hidden = if is_hidden { factor_of_rectangle(x, z, height, [p, q]) } else { 0.0 };
        case("rectangle behind a rectangle,", &scene, [p, q], whole - hidden).by(&SAMPLED)
    };
    [[0.0, 0.0], [0.3, 0.1], [0.6, 0.6], [1.6, 0.0]].map(at).into()
}

fn cut_disc() -> Vec<Case> {
    let (height, edge) = (2.0_f32, 1.0_f32);
    let cut = |s: f32| {
        let scene = over_floor(|scene| {
            put(scene, Shape::Disc { radius: 1.0 }, lamp(RADIANCE), facing_down(Vec3::Y * height));
            // From the origin, an edge at s / 2 halfway up cuts the disc at s.
            ceiling(scene, [s * edge / height, -FAR], [FAR, FAR], edge, black());
        });
        let factor = part_of_disc(1.0, f64::from(height), 0.0, |x, _| x < f64::from(s));
        case(&format!("disc cut at {s}"), &scene, [0.0, 0.0], factor).by(&ALL)
    };
    [-0.5, 0.3].map(cut).into()
}

fn disc_behind_disc() -> Vec<Case> {
    let (blocker, height, low) = (0.4_f32, 4.0_f32, 2.0_f32);
    let scene = over_floor(|scene| {
        put(scene, Shape::Disc { radius: 1.0 }, lamp(RADIANCE), facing_down(Vec3::Y * height));
        put(scene, Shape::Disc { radius: blocker }, black(), Affine3A::from_translation(Vec3::Y * low));
    });
    let k = f64::from(height / low);
    let at = |p: f32| {
        let (image, center) = (f64::from(blocker) * k, f64::from(p) * (1.0 - k));
        let sees = |x: f64, y: f64| (x - center) * (x - center) + y * y > image * image;
        let factor = part_of_disc(1.0, f64::from(height), f64::from(p), sees);
        case("disc behind a disc,", &scene, [p, 0.0], factor).by(&SAMPLED)
    };
    [0.0, 0.3, 0.7, 1.2].map(at).into()
}

fn wall() -> Vec<Case> {
    let mut cases = Vec::new();
    for (distance, height) in [(1.0_f32, 1.0_f32), (0.5, 2.0)] {
        let scene = over_floor(|scene| {
            let foot = Vec3::new(-distance, 0.0, -FAR);
            let mesh = parallelogram(foot, Vec3::Y * height, Vec3::Z * 2.0 * FAR);
            put(scene, Shape::Mesh(mesh), black(), Affine3A::IDENTITY);
            surround(scene, 1.5);
        });
        let open = beside_wall(f64::from(distance), f64::from(height));
        let case = |what: &str, truth| {
            let name = format!("{what}, {distance} from a wall of {height}");
            Case::new(Family::F15, name, &scene, aimed_at_floor(0.0, 0.0), truth)
        };
        cases.push(case("open part", open).by(&[Way::OCCLUSION]));
        cases.push(case("sky", f64::from(ALBEDO) * 1.5 * open).by(&ALL));
        // Nothing is near enough to count.
        let near = Integrator::Occlusion { distance: 0.9 * distance };
        cases.push(case("open part nearby", 1.0).exactly_by(&[near]));
    }
    cases
}
