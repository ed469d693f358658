//! The domain of the lecture: its radius, and uniformity in it.

use super::*;
use luch_sampling::check::chi_square;
use luch_sampling::{Domain, Sampler, Sequence};

#[test]
fn radius_of_the_disc() {
    for (glossiness, radius) in [(1.0, 0.0), (0.5, 1.0), (0.9, 0.158_384_44), (0.75, 0.414_213_56)] {
        let glossy = Glossy::new(Rgb::WHITE, glossiness);
        assert!((glossy.radius() - radius).abs() < 1e-6, "{glossiness}: {}", glossy.radius());
    }
}

#[test]
fn tilts_are_uniform_in_the_disc() {
    // At normal incidence and radius 1 every tilt reflects above the surface.
    let glossy = Glossy::new(Rgb::WHITE, 0.5);
    let count = 100_000;
    let (rings, sectors) = (10, 12);
    let mut counts = vec![0_u64; rings * sectors];
    for index in 0..count {
        let [u, v, ..] = Sampler::at(Sequence::Independent, 3, [0, 0], index).group(Domain::new(0, 0));
        let sample = glossy.sample(Vec3::Z, [u, v]).expect("above the surface");
        let normal = (sample.incoming + Vec3::Z).normalize();
        let (dx, dy) = (normal.x / normal.z, normal.y / normal.z);
        let squared = dx * dx + dy * dy;
        assert!(squared <= 1.0 + 1e-5, "outside the disc: {squared}");
        let ring = ((squared * rings as f32) as usize).min(rings - 1);
        let turn = (libm::atan2f(dy, dx) + PI) / (2.0 * PI);
        counts[ring * sectors + ((turn * sectors as f32) as usize).min(sectors - 1)] += 1;
    }
    let expected = vec![count as f64 / counts.len() as f64; counts.len()];
    let test = chi_square(&counts, &expected);
    assert!(test.p_value > 0.001, "{test:?}");
}

#[test]
fn every_reflection_above_the_surface_weighs_the_colour() {
    let color = Rgb::new(0.9, 0.5, 0.1);
    for glossiness in [0.05, 0.5, 0.97, 0.9995, 1.0] {
        let glossy = Glossy::new(color, glossiness);
        let outgoing = Vec3::new(0.6, 0.0, 0.8);
        for index in 0..1000 {
            let [u, v, ..] = Sampler::at(Sequence::Independent, 4, [0, 0], index).group(Domain::new(0, 0));
            if let Some(sample) = glossy.sample(outgoing, [u, v]) {
                assert!((sample.weight().r - color.r).abs() < 1e-6);
                assert!(sample.incoming.z > 0.0);
            }
        }
    }
}

#[test]
fn full_glossiness_is_a_mirror() {
    let glossy = Glossy::new(Rgb::WHITE, 1.0);
    let sample = glossy.sample(Vec3::new(0.6, 0.0, 0.8), [0.1, 0.2]).expect("a mirror reflects");
    assert!(sample.specular);
    assert_eq!(sample.incoming, Vec3::new(-0.6, 0.0, 0.8));
}
