//! The pure substances are the members of the same name.

use super::*;
use crate::bsdf::{Conductor, ConductorFresnel};

const COLOR: Rgb = Rgb::new(0.9, 0.6, 0.2);

fn pairs() -> Vec<(Vec3, Vec3)> {
    let direction = |x: f32, y: f32, z: f32| Vec3::new(x, y, z).normalize();
    let all = [
        direction(0.3, 0.2, 0.9),
        direction(-0.5, 0.1, 0.4),
        direction(0.9, -0.7, 0.1),
        direction(0.2, 0.2, -0.8),
        direction(-0.9, 0.3, -0.3),
    ];
    all.iter().flat_map(|&one| all.iter().map(move |&other| (one, other))).collect()
}

#[test]
fn metal_is_a_conductor() {
    let parameters = PrincipledParameters { base_color: COLOR, metallic: 1.0, ..Default::default() };
    let metal = Principled::new(parameters);
    let conductor = Conductor::new(ConductorFresnel::from_color(COLOR), parameters.roughness);
    for (outgoing, incoming) in pairs() {
        let (one, other) = (metal.evaluate(outgoing, incoming), conductor.evaluate(outgoing, incoming));
        assert!((one.value - other.value).map(f32::abs).max_channel() < 1e-6, "{one:?} {other:?}");
    }
}

#[test]
fn a_clear_solid_is_a_dielectric() {
    let parameters = PrincipledParameters { base_color: COLOR, transmission: 1.0, ..Default::default() };
    let solid = Principled::new(parameters);
    let glass = Dielectric::new(parameters.ior, parameters.roughness, COLOR);
    for (outgoing, incoming) in pairs() {
        assert_eq!(solid.evaluate(outgoing, incoming), glass.evaluate(outgoing, incoming));
    }
    let outgoing = Vec3::new(0.6, 0.0, 0.8);
    for choice in [0.01, 0.5, 0.9] {
        assert_eq!(solid.sample(outgoing, [0.2, 0.7], choice), glass.sample(outgoing, [0.2, 0.7], choice));
    }
}

#[test]
fn normal_reflectance_follows_the_index() {
    let surface = Principled::new(PrincipledParameters { roughness: 0.0, ..Default::default() });
    let sample = surface.sample(Vec3::Z, [0.5; 2], 0.0).expect("the coat reflects");
    assert!(sample.specular && (sample.value.r - 0.04).abs() < 1e-6, "{sample:?}");
}

#[test]
fn no_specular_is_lambert() {
    let parameters = PrincipledParameters { base_color: COLOR, specular: 0.0, ..Default::default() };
    let surface = Principled::new(parameters);
    let value = surface.evaluate(Vec3::Z, Vec3::new(0.6, 0.0, 0.8)).value;
    assert!((value - COLOR * (0.8 * FRAC_1_PI)).map(f32::abs).max_channel() < 1e-6, "{value:?}");
}

#[test]
fn a_thin_wall_does_not_bend() {
    let parameters = PrincipledParameters {
        base_color: COLOR,
        transmission: 1.0,
        thin_walled: true,
        roughness: 0.0,
        ..Default::default()
    };
    let wall = Principled::new(parameters);
    let outgoing = Vec3::new(0.6, 0.0, 0.8);
    let sample = wall.sample(outgoing, [0.5; 2], 0.9).expect("light comes through");
    assert_eq!(sample.incoming, -outgoing);
    assert_eq!(wall.refraction_ior(), 1.0);
    assert!(wall.is_specular() && wall.transmits());
}
