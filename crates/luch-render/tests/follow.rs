//! Paths told step by step carry home what the integrator sees, bit by bit, and their steps add up to it.

use luch_image::Rgb;
use luch_render::{Integrator, PathEnd, PathTracer, Stop, View, World};
use luch_scene::{Light, Scene, preset};

const SAMPLES: u64 = 6;

fn scenes() -> Vec<(&'static str, Scene)> {
    let mut glass = preset::cornell_box();
    for material in &mut glass.materials {
        if let luch_scene::Surface::Diffuse { color } = material.surface
            && material.emission.is_none()
        {
            material.surface =
                luch_scene::Surface::Dielectric { ior: 1.5, roughness: 0.3.into(), tint: color };
        }
    }
    let mut lamps = preset::cornell_box();
    lamps.lights.push(Light::Point { position: glam::Vec3::new(0.1, 1.0, 0.2), intensity: Rgb::gray(0.3) });
    lamps.environment = Some(luch_scene::Environment::Constant { radiance: Rgb::gray(0.2) });
    vec![
        ("box", preset::cornell_box()),
        ("glass", glass),
        ("lamps", lamps),
        ("furnace", preset::furnace(Rgb::gray(0.5), Rgb::WHITE)),
    ]
}

#[test]
fn followed_paths_are_the_samples() {
    let mut ends = Vec::new();
    for (name, mut scene) in scenes() {
        (scene.settings.width, scene.settings.height) = (12, 12);
        let view = View::new(&scene.cameras[0].camera, &scene.settings);
        let world = World::build(scene).expect("a sound scene");
        for tracer in [PathTracer { max_depth: 64, reuse: false }, PathTracer { max_depth: 2, reuse: true }] {
            for place in 0..144 {
                for index in 0..SAMPLES {
                    let sample = view.start([place % 12, place / 12], index);
                    let followed = tracer.follow(&world, &sample, &Stop::new()).expect("nobody stops this");
                    let mut seen = [Rgb::BLACK];
                    let alone = PathTracer { reuse: false, ..tracer };
                    alone.radiance(&world, &[sample], &mut seen, &Stop::new()).expect("nobody stops this");
                    assert_eq!(followed.radiance, seen[0], "{name}, {place}, {index}");

                    let found = followed.vertices.iter().filter_map(|v| v.found).map(|f| f.contribution);
                    let asked = followed.vertices.iter().filter_map(|v| v.asked).map(|a| a.contribution);
                    let parts: Vec<Rgb> = found.chain(asked).collect();
                    let sum: Rgb = parts.iter().fold(Rgb::BLACK, |sum, part| sum + *part);
                    // Each addition rounds once on either side.
                    let rounding = 2.0 * parts.len() as f32 * f32::EPSILON * sum.max_channel();
                    let off = (sum - followed.radiance).map(f32::abs).max_channel();
                    assert!(off <= rounding, "{name}, {place}, {index}: {sum:?} {:?}", followed.radiance);
                    ends.push(followed.end);
                }
            }
        }
    }
    for end in [PathEnd::Escaped, PathEnd::Depth, PathEnd::Absorbed, PathEnd::Roulette] {
        assert!(ends.contains(&end), "no path ended by {end:?}");
    }
}

#[test]
fn told_weights_and_densities_explain_the_contributions() {
    let mut scene = preset::cornell_box();
    (scene.settings.width, scene.settings.height) = (8, 8);
    let view = View::new(&scene.cameras[0].camera, &scene.settings);
    let world = World::build(scene).expect("a sound scene");
    let (mut found, mut asked, mut blocked) = (0, 0, 0);
    for place in 0..64 {
        for index in 0..16 {
            let sample = view.start([place % 8, place / 8], index);
            let followed = PathTracer::default().follow(&world, &sample, &Stop::new()).expect("not stopped");
            for vertex in &followed.vertices {
                if let (Some(light), Some(pdf_bsdf)) = (vertex.found, vertex.found.and_then(|f| f.pdf_bsdf)) {
                    found += 1;
                    let (b, l) = (f64::from(pdf_bsdf), f64::from(light.pdf_light));
                    let expected = b * b / (b * b + l * l);
                    assert!((f64::from(light.weight) - expected).abs() < 1e-5);
                    let bare = light.contribution.r / vertex.throughput.r / light.weight;
                    let material = world.scene.materials.iter().find_map(|material| material.emission);
                    let lamp = material.expect("the box has a lamp").radiance.factor.r;
                    assert!((bare - lamp).abs() < 1e-4 * lamp, "{bare} {lamp}");
                }
                if let Some(lamp) = vertex.asked {
                    asked += 1;
                    blocked += u32::from(lamp.contribution.is_black() && !lamp.unblocked.is_black());
                    assert!(lamp.contribution.is_black() || lamp.contribution == lamp.unblocked);
                    let (b, l) = (f64::from(lamp.pdf_bsdf), f64::from(lamp.pdf_light));
                    assert!((f64::from(lamp.weight) - l * l / (b * b + l * l)).abs() < 1e-5);
                }
            }
        }
    }
    assert!(found > 10 && asked > 500 && blocked > 50, "{found} {asked} {blocked}");
}
