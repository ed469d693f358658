//! Snell, Fresnel and the scaling of radiance.

use super::*;

#[test]
fn snell() {
    let glass = Dielectric::new(1.5, 0.0, Rgb::WHITE);
    let outgoing = Vec3::new(0.6, 0.0, 0.8);
    let inside = glass.sample(outgoing, [0.0; 2], 0.999).expect("refracted");
    assert!((inside.incoming - Vec3::new(-0.4, 0.0, -(1.0_f32 - 0.16).sqrt())).length() < 1e-6);
    // The way back.
    let outside = glass.sample(inside.incoming, [0.0; 2], 0.999).expect("refracted");
    assert!((outside.incoming - outgoing).length() < 1e-6);
    // Radiance is 1.5² times as large inside: the two scalings cancel.
    assert!((inside.weight().r - 1.0 / 2.25).abs() < 1e-6);
    assert!((outside.weight().r * inside.weight().r - 1.0).abs() < 1e-6);
}

#[test]
fn reflection_is_chosen_as_often_as_fresnel_says() {
    let glass = Dielectric::new(1.5, 0.0, Rgb::new(0.5, 1.0, 1.0));
    let reflected = glass.sample(Vec3::Z, [0.0; 2], 0.039).expect("reflected");
    assert!(reflected.incoming.z > 0.0 && (reflected.pdf - 0.04).abs() < 1e-7);
    assert_eq!(reflected.weight(), Rgb::WHITE);
    let refracted = glass.sample(Vec3::Z, [0.0; 2], 0.041).expect("refracted");
    assert!(refracted.incoming.z < 0.0 && (refracted.pdf - 0.96).abs() < 1e-6);
    // The tint counts once per crossing.
    assert!((refracted.weight().r - 0.5 * refracted.weight().g).abs() < 1e-7);
}

#[test]
fn total_reflection() {
    let glass = Dielectric::new(1.5, 0.0, Rgb::WHITE);
    let outgoing = Vec3::new(0.8, 0.0, -0.6);
    let sample = glass.sample(outgoing, [0.0; 2], 0.999_999).expect("reflected");
    assert_eq!(sample.incoming, Vec3::new(-0.8, 0.0, -0.6));
    assert_eq!(sample.pdf, 1.0);
}

#[test]
fn equal_indices_let_everything_through() {
    let nothing = Dielectric::new(1.0, 0.5, Rgb::WHITE);
    let outgoing = Vec3::new(0.6, 0.0, 0.8);
    let sample = nothing.sample(outgoing, [0.3, 0.8], 0.0).expect("straight through");
    assert!((sample.incoming + outgoing).length() < 1e-6 && sample.specular);
    assert!((sample.weight().r - 1.0).abs() < 1e-6);
}

#[test]
fn barely_rough_reflects_like_smooth() {
    // Share of energy that is reflected at roughness 0.05, by the probability of drawing the upper side.
    let rough = Dielectric::new(1.5, 0.05, Rgb::WHITE);
    let outgoing = Vec3::new(0.6, 0.0, 0.8);
    let steps = 200;
    let mut reflected = 0;
    for index in 0..steps * steps {
        let choice = ((index * 7919) % (steps * steps)) as f32 / (steps * steps) as f32;
        let u = [(index % steps) as f32 / steps as f32, (index / steps) as f32 / steps as f32];
        reflected +=
            u32::from(rough.sample(outgoing, u, choice).is_some_and(|sample| sample.incoming.z > 0.0));
    }
    let share = reflected as f32 / (steps * steps) as f32;
    let known = dielectric_reflectance(0.8, 1.5);
    let error = (known / (steps * steps) as f32).sqrt();
    assert!((share - known).abs() < 4.0 * error, "{share} ± {error}, {known}");
}
