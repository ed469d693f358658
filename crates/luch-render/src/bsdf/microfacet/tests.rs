//! Normalisation, masking and visible normals of GGX.

use super::*;
use luch_sampling::{Domain, Sampler, Sequence};
use std::f32::consts::PI;

fn numbers(count: u64) -> impl Iterator<Item = [f32; 4]> {
    (0..count).map(|index| Sampler::at(Sequence::Independent, 1, [0, 0], index).group(Domain::new(0, 0)))
}

/// Directions by angle from +Z and azimuth.
fn direction(angle: f32, azimuth: f32) -> Vec3 {
    Vec3::new(
        libm::sinf(angle) * libm::cosf(azimuth),
        libm::sinf(angle) * libm::sinf(azimuth),
        libm::cosf(angle),
    )
}

/// ∫ f over the upper hemisphere, with steps that grow with tan θ / α.
fn hemisphere(alpha: f32, f: impl Fn(Vec3) -> f32) -> f64 {
    let (steps, turns) = (2000, 128);
    let mut sum = 0.0;
    for step in 0..steps {
        let quantile = (step as f32 + 0.5) / steps as f32;
        let tangent = alpha * quantile / (1.0 - quantile);
        let angle = libm::atanf(tangent);
        let width = alpha / ((1.0 - quantile) * (1.0 - quantile)) / (1.0 + tangent * tangent) / steps as f32;
        for turn in 0..turns {
            let azimuth = 2.0 * PI * (turn as f32 + 0.5) / turns as f32;
            let value = f(direction(angle, azimuth)) * libm::sinf(angle) * width * 2.0 * PI / turns as f32;
            sum += f64::from(value);
        }
    }
    sum
}

#[test]
fn distributions_are_normalised() {
    for alpha in [0.01, 0.1, 0.5, 1.0] {
        let ggx = Ggx::new(alpha);
        let area = hemisphere(alpha, |normal| ggx.density(normal) * normal.z);
        assert!((area - 1.0).abs() < 1e-3, "alpha {alpha}: projected area {area}");
        for angle in [0.0, 0.7, 1.4] {
            let outgoing = direction(angle, 0.3);
            let visible = hemisphere(alpha, |normal| ggx.visible_pdf(outgoing, normal));
            assert!((visible - 1.0).abs() < 2e-3, "alpha {alpha}, angle {angle}: visible normals {visible}");
        }
    }
}

#[test]
fn weak_furnace() {
    // Without shadowing of the light, a mirror's facets give back everything, counted over the whole sphere:
    // the mean of G₁ D / (4 cos o) over reflections of visible normals is 1 by construction, so compare with an integral.
    for alpha in [0.2_f32, 0.7] {
        let ggx = Ggx::new(alpha);
        let outgoing = direction(0.9, 0.0);
        let (steps, turns) = (600, 600);
        let mut sum = 0.0_f64;
        for step in 0..steps {
            let height = 2.0 * (step as f32 + 0.5) / steps as f32 - 1.0;
            for turn in 0..turns {
                let azimuth = 2.0 * PI * (turn as f32 + 0.5) / turns as f32;
                let incoming = direction(libm::acosf(height), azimuth);
                let normal = (outgoing + incoming).normalize();
                if normal.z > 0.0 {
                    sum += f64::from(ggx.masking(outgoing) * ggx.density(normal) / (4.0 * outgoing.z));
                }
            }
        }
        let furnace = sum * 4.0 * std::f64::consts::PI / f64::from(steps * turns);
        assert!((furnace - 1.0).abs() < 2e-3, "alpha {alpha}: {furnace}");
    }
}

#[test]
fn visible_normals_follow_their_density() {
    // Means of the sampled normals against means under the density.
    for alpha in [0.05, 0.4, 1.0] {
        let ggx = Ggx::new(alpha);
        for angle in [0.2, 1.2, 1.5] {
            let outgoing = direction(angle, 0.0);
            let count = 100_000;
            let (mut sum, mut square) = (Vec3::ZERO.as_dvec3(), Vec3::ZERO.as_dvec3());
            for [u, v, ..] in numbers(count) {
                let normal = ggx.sample_visible(outgoing, [u, v]).as_dvec3();
                sum += normal;
                square += normal * normal;
            }
            let mean = sum / count as f64;
            let error = ((square / count as f64 - mean * mean).max(glam::DVec3::ZERO) / count as f64)
                .to_array()
                .map(f64::sqrt);
            let axes = [Vec3::X, Vec3::Y, Vec3::Z];
            for ((axis, mean), error) in axes.into_iter().zip(mean.to_array()).zip(error) {
                let known = hemisphere(alpha, |normal| normal.dot(axis) * ggx.visible_pdf(outgoing, normal));
                assert!(
                    (mean - known).abs() < 4.0 * error + 1e-3,
                    "{alpha} {angle}: {mean} ± {error}, {known}"
                );
            }
        }
    }
}

#[test]
fn a_sample_of_visible_normals_weighs_at_most_one() {
    for alpha in [0.001, 0.05, 0.3, 1.0] {
        let ggx = Ggx::new(alpha);
        for [u, v, height, azimuth] in numbers(20_000) {
            let outgoing = direction(libm::acosf(height), azimuth * 2.0 * PI);
            let normal = ggx.sample_visible(outgoing, [u, v]);
            assert!(normal.z >= 0.0 && outgoing.dot(normal) > -1e-6);
            let incoming = 2.0 * outgoing.dot(normal) * normal - outgoing;
            if incoming.z > 0.0 {
                let weight = ggx.shadowing_given_masking(outgoing, incoming);
                assert!((0.0..=1.0 + 1e-6).contains(&weight), "{weight}");
                // The same weight from value and density.
                let long =
                    ggx.visibility(outgoing, incoming) * outgoing.z * incoming.z / ggx.masking(outgoing);
                assert!((weight - long).abs() < 1e-4, "{weight} {long}");
            }
        }
    }
}

#[test]
fn smooth_roughness_has_no_distribution() {
    assert!(Ggx::from_roughness(0.0).is_none());
    assert!(Ggx::from_roughness(0.03).is_none());
    assert!(Ggx::from_roughness(f32::NAN).is_none());
    assert_eq!(Ggx::from_roughness(0.5).map(|ggx| ggx.alpha()), Some(0.25));
}
