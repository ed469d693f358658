//! Lamps of any shape that are half there shine half as much as whole ones, whatever that is.

use super::world;
use glam::Vec3;
use luch_lab::truth::measure::Look;
use luch_lab::truth::stage::{aimed_at_floor, ceiling, facing_down, floor, lamp};
use luch_lab::truth::{Reads, Way};
use luch_render::Stop;
use luch_sampling::{Estimate, Sequence};
use luch_scene::{Integrator, Opacity, Scene, Shape};

fn measure(scene: &Scene, way: Integrator, seed: u64) -> Estimate {
    let (world, camera) = (world(scene.clone()), aimed_at_floor(0.0, 0.0));
    let (world, camera) = (&world, &camera);
    let look = Look { world, camera, reads: Reads::EveryPixel, way, sequence: Sequence::Sobol, seed };
    look.measure(0.005, &Stop::new()).unwrap().replicates
}

#[test]
fn a_lamp_that_is_half_there_shines_half() {
    let mut scene = Scene::default();
    floor(&mut scene, 1.0);
    ceiling(&mut scene, [-1.0; 2], [1.0; 2], 1.0, lamp(4.0));
    scene.instances[1].placement = facing_down(Vec3::Y);
    for shape in [Shape::Sphere { radius: 0.7 }, Shape::Disc { radius: 1.0 }] {
        scene.shapes[1] = shape.into();
        scene.materials[1].opacity = Opacity::Opaque;
        let there = measure(&scene, Way::PLAIN, 1);
        scene.materials[1].opacity = Opacity::Blend { alpha: 0.5.into() };
        // A sphere that is half there also lets its far side's back through, which does not shine.
        for way in [Way::PATH, Way::DIRECT, Way::PLAIN] {
            let half = measure(&scene, way, 2);
            let off = half.mean().unwrap() - there.mean().unwrap() / 2.0;
            let error = half.standard_error().unwrap() + there.standard_error().unwrap() / 2.0;
            assert!(off.abs() <= 4.0 * error, "{way:?}: {half:?} is not half of {there:?}");
            assert!(error < 0.01 * half.mean().unwrap());
        }
    }
}
