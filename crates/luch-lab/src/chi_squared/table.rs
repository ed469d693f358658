//! Cells and things picked by weight.

use super::Routine;
use super::emitter::{built, glowing};
use glam::{Affine3A, Vec3};
use luch_image::Rgb;
use luch_sampling::check::Area;
use luch_sampling::{Alias, Domain, Piecewise1d, Piecewise2d, Sampler, Sequence};
use luch_scene::{Light, Scene, Shape};
use std::sync::Arc;

/// A bumpy table with empty places.
fn weights(cells: usize) -> Vec<f32> {
    (0..cells)
        .map(|cell| if cell % 7 == 3 { 0.0 } else { libm::expf(2.0 * libm::sinf(cell as f32 * 0.37)) })
        .collect()
}

fn piecewise() -> Vec<Option<Routine>> {
    let line = Piecewise1d::new(&weights(20)).ok().map(|line| {
        let asked = line.clone();
        Routine::places(
            "piecewise-1d",
            "20 cells, twice",
            Area::UNIT_SQUARE,
            ["first", "second"],
            move |u| Some([u[0], u[1]].map(|u| f64::from(line.sample(u).position))),
            move |place| place.map(|x| f64::from(asked.pdf(x as f32))).iter().product(),
        )
    });
    let square = Piecewise2d::new(24, 16, &weights(24 * 16)).ok().map(|table| {
        let asked = table.clone();
        Routine::places(
            "piecewise-2d",
            "24 × 16 cells",
            Area::UNIT_SQUARE,
            ["x", "y"],
            move |u| Some(table.sample([u[0], u[1]]).position.map(f64::from)),
            move |[x, y]| f64::from(asked.pdf([x as f32, y as f32])),
        )
    });
    vec![line, square]
}

fn alias(count: usize) -> Option<Routine> {
    let weights = weights(count);
    let table = Alias::new(&weights).ok()?;
    let total: f64 = weights.iter().map(|&weight| f64::from(weight)).sum();
    let probabilities = weights.iter().map(|&weight| f64::from(weight) / total).collect();
    let pick = move |u| Some(table.sample_f64(u).index);
    Some(Routine::choice("alias", format!("{count} weights"), probabilities, pick))
}

/// Lamps of all kinds in a box, and which of them a receiver picks.
fn lights(parameters: &str, from: Vec3, normal: Vec3) -> Option<Routine> {
    let mut scene = Scene::default();
    for i in 0..120 {
        let sampler = Sampler::at(Sequence::Independent, 11, [0, 0], i);
        let [x, y, z, power] = sampler.group(Domain::new(0, 0));
        let center = Vec3::new(x, y, z) * 10.0;
        let strength = 0.01 * libm::powf(10.0, 4.0 * power);
        if i % 3 == 0 {
            scene.lights.push(Light::Point { position: center, intensity: Rgb::gray(strength) });
            continue;
        }
        let radius = 0.1 + 0.2 * sampler.group(Domain::new(0, 1))[0];
        let shape = if i % 3 == 1 { Shape::Sphere { radius } } else { Shape::Disc { radius } };
        let (shape, material) = (scene.add_shape(shape), scene.add_material(glowing(false)));
        scene.add_instance(shape, material, Affine3A::from_translation(center));
    }
    let world = built(scene)?;
    let asked = Arc::clone(&world);
    let probability = |emitter: usize| f64::from(asked.lights.probability(emitter as u32, from, normal));
    let probabilities = (0..asked.lights.count()).map(probability).collect();
    let pick = move |u| Some(world.lights.choose(from, normal, u)?.emitter as usize);
    Some(Routine::choice("light", parameters, probabilities, pick))
}

pub(super) fn routines() -> Vec<Routine> {
    let picks = vec![
        alias(50),
        alias(1000),
        lights("one of 120 lamps, on a floor", Vec3::new(4.0, 1.0, 6.0), Vec3::Y),
        lights("one of 120 lamps, anywhere", Vec3::new(-3.0, 2.0, 4.0), Vec3::ZERO),
    ];
    piecewise().into_iter().chain(picks).flatten().collect()
}
