//! Known values of the lobe.

use super::*;
use std::f32::consts::PI;

#[test]
fn values() {
    let phong = Phong::new(Rgb::gray(0.3), Rgb::gray(0.5), 77.0);
    // Straight back at normal incidence: diffuse / π + specular (n + 2) / 2π.
    let value = phong.evaluate(Vec3::Z, Vec3::Z).value.r;
    let known = 0.3 / PI + 0.5 * 79.0 / (2.0 * PI);
    assert!((value / known - 1.0).abs() < 1e-5, "{value} {known}");
    // Ten degrees off the mirror direction.
    let tilted = Vec3::new(libm::sinf(PI / 18.0), 0.0, libm::cosf(PI / 18.0));
    let power = libm::powf(tilted.z, 77.0);
    let known = (0.3 / PI + 0.5 * 79.0 / (2.0 * PI) * power) * tilted.z;
    let value = phong.evaluate(Vec3::Z, tilted).value.r;
    assert!((value / known - 1.0).abs() < 1e-4, "{value} {known}");
}

#[test]
fn narrow_lobe_keeps_its_digits() {
    // At n = 10⁶ the lobe falls to 1/e at α = √(2/n).
    let phong = Phong::new(Rgb::BLACK, Rgb::WHITE, 1e6);
    let angle = libm::sqrtf(2e-6);
    let tilted = Vec3::new(libm::sinf(angle), 0.0, libm::cosf(angle));
    let ratio = phong.evaluate(Vec3::Z, tilted).value.r / phong.evaluate(Vec3::Z, Vec3::Z).value.r;
    assert!((ratio - libm::expf(-1.0)).abs() < 1e-4, "{ratio}");
}

#[test]
fn black_is_drawn_as_nothing_worth() {
    let phong = Phong::new(Rgb::BLACK, Rgb::BLACK, 10.0);
    let sample = phong.sample(Vec3::Z, [0.3, 0.6], 0.5).expect("a direction");
    assert!(sample.value.is_black());
}
