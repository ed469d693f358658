//! What every member of the BSDF family promises.

use glam::Vec3;
use luch_render::{Bsdf, BsdfSample};
use luch_sampling::check::{directions_match_pdf, sidak};
use luch_sampling::{Domain, Sampler, Sequence};

/// Independent numbers: `count` times u, v and choice.
fn numbers(seed: u64, count: u64) -> impl Iterator<Item = [f32; 4]> {
    (0..count)
        .map(move |index| Sampler::at(Sequence::Independent, seed, [0, 0], index).group(Domain::new(0, 0)))
}

fn direction(cosine: f32, azimuth: f32) -> Vec3 {
    let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
    Vec3::new(sine * libm::cosf(azimuth), sine * libm::sinf(azimuth), cosine)
}

/// A uniform direction of the sphere.
fn uniform(u: [f32; 4]) -> Vec3 {
    direction(1.0 - 2.0 * u[0], std::f32::consts::TAU * u[1])
}

/// Directions that break careless formulas.
fn adversarial() -> Vec<Vec3> {
    let mut all = Vec::new();
    for cosine in [1.0, 0.999_999_9, 0.5, 0.1, 1e-3, 1e-6, 1e-20, 1e-38, 0.0, -0.0] {
        for azimuth in [0.0, 1.0, std::f32::consts::PI] {
            for sign in [1.0, -1.0] {
                let mut direction = direction(cosine, azimuth);
                direction.z *= sign;
                all.push(direction);
            }
        }
    }
    all
}

/// η of the side that a direction is on, outside 1.
fn index_of(bsdf: &Bsdf, direction: Vec3) -> f32 {
    if direction.z < 0.0 { bsdf.ior() } else { 1.0 }
}

/// What a sample carries as energy: radiance scaling divided out.
fn energy(bsdf: &Bsdf, outgoing: Vec3, sample: &BsdfSample) -> [f32; 3] {
    let ratio = index_of(bsdf, sample.incoming) / index_of(bsdf, outgoing);
    (sample.weight() * (ratio * ratio)).to_array()
}

/// Mean and standard error of the energy scattered, per channel.
struct Albedo {
    mean: [f64; 3],
    error: [f64; 3],
}

fn albedo(bsdf: &Bsdf, outgoing: Vec3, seed: u64, count: u64) -> Albedo {
    let (mut sum, mut square) = ([0.0; 3], [0.0; 3]);
    for [u, v, choice, _] in numbers(seed, count) {
        if let Some(sample) = bsdf.sample(outgoing, [u, v], choice) {
            for (channel, value) in energy(bsdf, outgoing, &sample).into_iter().enumerate() {
                sum[channel] += f64::from(value);
                square[channel] += f64::from(value) * f64::from(value);
            }
        }
    }
    let n = count as f64;
    let mean = sum.map(|sum| sum / n);
    let error = [0, 1, 2].map(|c| ((square[c] / n - mean[c] * mean[c]).max(0.0) / n).sqrt());
    Albedo { mean, error }
}

#[test]
fn samples_follow_their_density() {
    let cosines = [0.8, 0.15, -0.75];
    let examples = Bsdf::examples();
    let level = sidak(0.01, (examples.len() * cosines.len()) as u32);
    let mut failures = Vec::new();
    for (index, (name, bsdf)) in examples.iter().enumerate() {
        for (turn, &cosine) in cosines.iter().enumerate() {
            // Models that are alike on both sides need no look from behind.
            if cosine < 0.0 && !bsdf.transmits() {
                continue;
            }
            let outgoing = direction(cosine, 0.4 + turn as f32);
            let fit = directions_match_pdf(
                100_000,
                (index * 10 + turn) as u64,
                |[u, v, choice, _]| {
                    let sample = bsdf.sample(outgoing, [u, v], choice)?;
                    (!sample.specular).then_some(sample.incoming)
                },
                |incoming| bsdf.pdf(outgoing, incoming),
            );
            if !fit.agrees(level) {
                failures.push(format!("{name} at {cosine}: {fit:?}"));
            }
        }
    }
    assert!(failures.is_empty(), "{failures:#?}");
}

#[test]
fn reflectors_are_alike_on_both_sides() {
    let flip = |direction: Vec3| Vec3::new(direction.x, direction.y, -direction.z);
    for (name, bsdf) in Bsdf::examples().into_iter().filter(|(_, bsdf)| !bsdf.transmits()) {
        for u in numbers(6, 1000) {
            let outgoing = uniform([u[0], u[1], 0.0, 0.0]);
            let front = bsdf.sample(outgoing, [u[2], u[3]], u[1]);
            let back = bsdf.sample(flip(outgoing), [u[2], u[3]], u[1]);
            let turned = back.map(|sample| BsdfSample { incoming: flip(sample.incoming), ..sample });
            assert_eq!(front, turned, "{name}");
            let incoming = front.map_or(Vec3::Z, |sample| sample.incoming);
            let (one, other) =
                (bsdf.evaluate(outgoing, incoming), bsdf.evaluate(flip(outgoing), flip(incoming)));
            assert_eq!(one, other, "{name}");
        }
    }
}

#[test]
fn a_sample_agrees_with_value_and_density() {
    for (name, bsdf) in Bsdf::examples() {
        let (mut drawn, mut off) = (0, 0);
        for u in numbers(7, 4000) {
            let outgoing = uniform([u[0], u[1], 0.0, 0.0]);
            let Some(sample) = bsdf.sample(outgoing, [u[2], u[3]], (u[0] * 977.0).fract()) else { continue };
            assert!((sample.incoming.length() - 1.0).abs() < 1e-5, "{name}: not a unit vector");
            if sample.specular {
                assert_eq!(bsdf.pdf(outgoing, sample.incoming).max(0.0), bsdf.pdf(outgoing, sample.incoming));
                continue;
            }
            drawn += 1;
            let value = bsdf.eval(outgoing, sample.incoming).to_array();
            let pdf = bsdf.pdf(outgoing, sample.incoming);
            let close = |a: f32, b: f32| (a - b).abs() <= 1e-3 * a.abs().max(b.abs());
            let same = value.iter().zip(sample.value.to_array()).all(|(&a, b)| close(a, b));
            if !same || !close(pdf, sample.pdf) {
                off += 1;
            }
        }
        // The lecture's lobe has a rim: single precision may put a sample of it on either side.
        let allowed = if bsdf.is_reciprocal() { 0 } else { 1 + drawn / 500 };
        assert!(off <= allowed, "{name}: {off} of {drawn} samples disagree");
    }
}

#[test]
fn delta_lobes_are_declared() {
    for (name, bsdf) in Bsdf::examples() {
        for u in numbers(8, 500) {
            let outgoing = uniform([u[0], u[1], 0.0, 0.0]);
            if let Some(sample) = bsdf.sample(outgoing, [u[2], u[3]], (u[0] * 977.0).fract()) {
                assert!(sample.specular || !bsdf.is_specular(), "{name}");
                assert!(bsdf.transmits() || sample.incoming.z * outgoing.z > 0.0, "{name}");
            }
        }
    }
}

#[test]
fn values_are_finite_and_not_negative() {
    let edges = adversarial();
    for (name, bsdf) in Bsdf::examples() {
        let check = |outgoing: Vec3, incoming: Vec3| {
            let value = bsdf.evaluate(outgoing, incoming);
            let fine = value.value.to_array().iter().all(|channel| channel.is_finite() && *channel >= 0.0);
            assert!(
                fine && value.pdf.is_finite() && value.pdf >= 0.0,
                "{name}: {outgoing} {incoming} {value:?}"
            );
            if value.pdf == 0.0 {
                assert!(
                    value.value.is_black(),
                    "{name}: light that is never drawn, {outgoing} {incoming} {value:?}"
                );
            }
        };
        for &outgoing in &edges {
            for &incoming in &edges {
                check(outgoing, incoming);
                check(outgoing, -outgoing);
                check(outgoing, Vec3::new(-outgoing.x, -outgoing.y, outgoing.z));
            }
            for u in [0.0, 0.3, 1.0 - f32::EPSILON / 2.0] {
                for choice in [0.0, 0.5, 1.0 - f32::EPSILON / 2.0] {
                    if let Some(sample) =
                        bsdf.sample(outgoing, [u, 1.0 - f32::EPSILON / 2.0 - u * 0.9], choice)
                    {
                        let weight = sample.weight();
                        assert!(weight.is_finite() && weight.to_array().iter().all(|c| *c >= 0.0), "{name}");
                    }
                }
            }
        }
        for u in numbers(9, 100_000 / 60) {
            check(uniform(u), uniform([u[2], u[3], 0.0, 0.0]));
        }
    }
}

#[test]
fn no_energy_is_made() {
    for (name, bsdf) in Bsdf::examples() {
        for (turn, cosine) in [0.95, 0.5, 0.1, -0.9, -0.3].into_iter().enumerate() {
            let albedo = albedo(&bsdf, direction(cosine, 2.0), 100 + turn as u64, 20_000);
            for channel in 0..3 {
                // The tables of lost energy are good to half a per cent.
                let limit = 1.005 + 4.0 * albedo.error[channel];
                assert!(albedo.mean[channel] <= limit, "{name} at {cosine}: {:?}", albedo.mean);
            }
        }
    }
}

#[test]
fn light_is_exchanged_alike_both_ways() {
    for (name, bsdf) in Bsdf::examples() {
        if !bsdf.is_reciprocal() {
            continue;
        }
        for u in numbers(11, 4000) {
            let (one, other) = (uniform(u), uniform([u[2], u[3], 0.0, 0.0]));
            let scaled = |outgoing: Vec3, incoming: Vec3| {
                let index = index_of(&bsdf, outgoing);
                bsdf.eval(outgoing, incoming) / (incoming.z.abs() * index * index)
            };
            let (there, back) = (scaled(one, other).to_array(), scaled(other, one).to_array());
            for channel in 0..3 {
                let tolerance = 2e-3 * there[channel].max(back[channel]) + 1e-6;
                assert!(
                    (there[channel] - back[channel]).abs() <= tolerance,
                    "{name}: {one} {other} {there:?} {back:?}"
                );
            }
        }
    }
}

#[test]
fn lossless_surfaces_lose_nothing() {
    let mut tested = 0;
    for (name, bsdf) in Bsdf::examples() {
        let white = name.contains("white")
            || (name.starts_with("dielectric") && !name.contains("red"))
            || name.starts_with("principled glass")
            || name == "principled half glass";
        if !white {
            continue;
        }
        tested += 1;
        for (turn, cosine) in [0.97, 0.6, 0.25, 0.08, -0.97, -0.74, -0.3].into_iter().enumerate() {
            let albedo = albedo(&bsdf, direction(cosine, 1.0), 200 + turn as u64, 40_000);
            for channel in 0..3 {
                let difference = (albedo.mean[channel] - 1.0).abs();
                let limit = 0.005 + 4.0 * albedo.error[channel];
                assert!(difference <= limit, "{name} at {cosine}: {:?} ± {:?}", albedo.mean, albedo.error);
                assert!(albedo.error[channel] < 0.01, "{name} at {cosine}: noise {:?}", albedo.error);
            }
        }
    }
    assert!(tested > 20);
}

#[test]
fn phong_has_its_known_albedo() {
    // Ground truth: (n + 2) / 2π ∫ cosⁿα cos θ over the hemisphere.
    let known: [(&str, [f64; 4]); 2] = [
        ("phong 1", [1.0, 0.880_843, 0.608_998, 0.458_442]),
        ("phong 77", [1.0, 0.866_025, 0.500_000, 0.259_206]),
    ];
    let examples = Bsdf::examples();
    for (name, values) in known {
        let (_, bsdf) = examples.iter().find(|(other, _)| *other == name).expect("an example of that name");
        for (degrees, value) in [0.0_f32, 30.0, 60.0, 75.0].into_iter().zip(values) {
            let albedo = albedo(bsdf, direction(libm::cosf(degrees.to_radians()), 0.0), 300, 100_000);
            let difference = (albedo.mean[0] - value).abs();
            assert!(
                difference <= 4.0 * albedo.error[0] + 1e-6,
                "{name} at {degrees}°: {} ± {} instead of {value}",
                albedo.mean[0],
                albedo.error[0]
            );
        }
    }
}

#[test]
fn samples_refuse_nonsense() {
    let white = luch_image::Rgb::WHITE;
    assert!(BsdfSample::checked(Vec3::Z, white, 1.0, false).is_some());
    assert!(BsdfSample::checked(Vec3::Z, white, 0.0, false).is_none());
    assert!(BsdfSample::checked(Vec3::Z, white, f32::INFINITY, false).is_none());
    assert!(BsdfSample::checked(Vec3::Z, white * f32::NAN, 1.0, false).is_none());
    assert!(BsdfSample::checked(Vec3::NAN, white, 1.0, false).is_none());
}
