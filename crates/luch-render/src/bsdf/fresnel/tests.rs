//! Known reflectances.

use super::*;

#[test]
fn normal_incidence() {
    for (eta, known) in [(1.5, 0.04), (1.33, 0.020_059_312), (1.0 / 1.5, 0.04)] {
        assert!((dielectric_reflectance(1.0, eta) - known).abs() < 1e-7, "{eta}");
    }
    // Brewster's angle, tan θ = n: one of two polarisations vanishes, the other is ((n² − 1) / (n² + 1))².
    let cosine = 1.0 / (1.0 + 1.5_f32 * 1.5).sqrt();
    let ratio = 1.25_f32 / 3.25;
    assert!((dielectric_reflectance(cosine, 1.5) - 0.5 * ratio * ratio).abs() < 1e-6);
}

#[test]
fn total_reflection_and_grazing() {
    // The critical angle of 1.5 has sin = 2/3.
    assert_eq!(dielectric_reflectance(0.74, 1.0 / 1.5), 1.0);
    assert!(dielectric_reflectance(0.76, 1.0 / 1.5) < 1.0);
    assert_eq!(dielectric_reflectance(0.0, 1.5), 1.0);
}

#[test]
fn both_sides_agree() {
    // Nearer to grazing the reflectance is too steep for the digits of the cosine.
    for step in 10..100 {
        let cosine = step as f32 / 100.0;
        let refracted = (1.0 - (1.0 - cosine * cosine) / 2.25).sqrt();
        let there = dielectric_reflectance(cosine, 1.5);
        assert!((there - dielectric_reflectance(refracted, 1.0 / 1.5)).abs() < 1e-5, "{cosine}");
        assert!((there - reflectance_of_cosines(cosine, refracted, 1.5)).abs() < 1e-6, "{cosine}");
    }
}

#[test]
fn means_of_dielectrics() {
    for (eta, outside, inside) in [
        (1.33, 0.065_930_849_299_405, 0.471_949_148_792_7),
        (1.5, 0.091_777_959_342_351, 0.596_345_759_707_71),
    ] {
        assert!((dielectric_reflectance_mean(eta) - outside).abs() < 1e-12, "{eta}");
        assert!((dielectric_reflectance_mean(1.0 / eta) - inside).abs() < 1e-12, "{eta}");
    }
    assert!(dielectric_reflectance_mean(1.0).abs() < 1e-12);
    // Just beside the value that is taken as 1, cancellation must not show.
    assert!(dielectric_reflectance_mean(1.001).abs() < 1e-3);
}

#[test]
fn conductors() {
    // Normal incidence: ((η − 1)² + k²) / ((η + 1)² + k²). Without absorption a metal is a dielectric.
    let (eta, k) = (0.18_f32, 3.43_f32);
    let known = ((eta - 1.0) * (eta - 1.0) + k * k) / ((eta + 1.0) * (eta + 1.0) + k * k);
    assert!((conductor_reflectance(1.0, eta, k) - known).abs() < 1e-6);
    for cosine in [0.1, 0.4, 0.9] {
        let difference = conductor_reflectance(cosine, 1.5, 0.0) - dielectric_reflectance(cosine, 1.5);
        assert!(difference.abs() < 1e-5, "{cosine}");
    }
    assert!((conductor_reflectance(0.0, eta, k) - 1.0).abs() < 1e-6);
}

#[test]
fn means_of_conductors() {
    for (eta, k) in [(0.18, 3.43), (1.33, 1.88), (0.056, 4.28), (3.64, 2.92), (1.37, 7.6)] {
        let steps = 4000;
        let exact: f64 = (0..steps)
            .map(|step| {
                let cosine = (step as f32 + 0.5) / steps as f32;
                f64::from(2.0 * cosine * conductor_reflectance(cosine, eta, k)) / f64::from(steps)
            })
            .sum();
        let mean = f64::from(conductor_reflectance_mean(eta, k));
        assert!((mean - exact).abs() < 5e-4, "{eta} + {k} i: {mean}, {exact}");
    }
}

#[test]
fn schlick() {
    let f0 = Rgb::gray(0.04);
    assert_eq!(schlick_reflectance(1.0, f0, 1.0), f0);
    assert_eq!(schlick_reflectance(0.0, f0, 1.0), Rgb::WHITE);
    assert!((schlick_reflectance_mean(f0, 1.0).r - (0.04 + 0.96 / 21.0)).abs() < 1e-7);
}
