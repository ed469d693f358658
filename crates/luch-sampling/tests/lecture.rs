//! Integrals with known values, by the one estimator f/ρ.

use luch_sampling::check::sidak;
use luch_sampling::{Domain, Estimate, Sampler, Sequence, warp};

/// Independent numbers, so that standard errors hold.
fn groups(seed: u64, count: u64) -> impl Iterator<Item = [f64; 4]> {
    (0..count).map(move |index| {
        Sampler::at(Sequence::Independent, seed, [0, 0], index)
            .group(Domain::new(0, 0))
            .map(|u| f64::from(u) + 1.0 / 33_554_432.0)
    })
}

fn assert_close(name: &str, estimate: &Estimate, truth: f64) {
    let z = estimate.z_score(truth).unwrap();
    assert!(z.abs() < 4.0, "{name}: {:?}, expected {truth}, {z} standard errors", estimate.mean());
}

/// A density normalises its domain: 1 on the unit segment and square, 0.2 on [0, 5], 0.25 on [0, 2]².
#[test]
fn densities_normalise_their_domains() {
    const COUNT: u64 = 1 << 16;
    // ∫x² over the segments, ∫xy over the squares, each as the mean of f/ρ with a uniform density.
    for (end, density, truth) in [(1.0, 1.0, 1.0 / 3.0), (5.0, 0.2, 125.0 / 3.0)] {
        let volume: Estimate = groups(1, COUNT).map(|_| 1.0 / density).collect();
        assert_eq!(volume.mean(), Some(end));
        let square: Estimate = groups(1, COUNT).map(|u| (end * u[0]) * (end * u[0]) / density).collect();
        assert_close("x²", &square, truth);
    }
    for (side, density, truth) in [(1.0, 1.0, 0.25), (2.0, 0.25, 4.0)] {
        let volume: Estimate = groups(2, COUNT).map(|_| 1.0 / density).collect();
        assert_eq!(volume.mean(), Some(side * side));
        let product: Estimate = groups(2, COUNT).map(|u| (side * u[0]) * (side * u[1]) / density).collect();
        assert_close("xy", &product, truth);
    }
}

/// What a number in [0, 1) contributes.
type Sampled<'a> = &'a dyn Fn(f64) -> f64;

/// ∫cos⁷⁷ over [−π/2, π/2]: value, and variance of one sample, for uniform and normal densities.
#[test]
fn a_peak_by_uniform_and_by_normal_samples() {
    use std::f64::consts::{FRAC_1_PI, FRAC_PI_2, PI};
    const TRUTH: f64 = 0.284_730_875_947_739_5;
    let f = |x: f64| if x.abs() < FRAC_PI_2 { libm::pow(libm::cos(x), 77.0) } else { 0.0 };
    let by_normal = |u: f64, deviation: f64| {
        let x = warp::normal(u, 0.0, deviation);
        f(x) / warp::normal_pdf(x, 0.0, deviation)
    };
    let uniform = |u: f64| f(PI * (u - 0.5)) / FRAC_1_PI;
    let cases: [(&str, Sampled, f64); 4] = [
        ("uniform", &uniform, 0.552_468_893_752_759),
        ("normal 0.15", &|u| by_normal(u, 0.15), 0.008_685_186_320_736_89),
        ("normal 0.13", &|u| by_normal(u, 0.13), 0.002_452_196_838_888_75),
        ("normal 1/√77", &|u| by_normal(u, 1.0 / 77f64.sqrt()), 8.752_705_742_72e-6),
    ];
    for (name, sample, variance) in cases {
        let values: Vec<f64> = groups(77, 1 << 18).map(|u| sample(u[0])).collect();
        assert_close(name, &values.iter().copied().collect(), TRUTH);
        let deviations: Estimate = values.iter().map(|v| (v - TRUTH) * (v - TRUTH)).collect();
        assert_close(&format!("variance of {name}"), &deviations, variance);
    }
}

#[test]
fn probability_of_an_acute_triangle() {
    const TRUTH: f64 = 0.274_793_516_993_588_5;
    let estimate: Estimate = (0..1 << 19)
        .map(|index| {
            let sampler = Sampler::at(Sequence::Independent, 3, [1, 0], index);
            let [p, q] = [Domain::new(0, 0), Domain::new(0, 1)].map(|d| sampler.group(d).map(f64::from));
            let corners = [[p[0], p[1]], [p[2], p[3]], [q[0], q[1]]];
            let acute = (0..3).all(|i| {
                let [a, b, c] = [corners[i], corners[(i + 1) % 3], corners[(i + 2) % 3]];
                (b[0] - a[0]) * (c[0] - a[0]) + (b[1] - a[1]) * (c[1] - a[1]) > 0.0
            });
            f64::from(acute)
        })
        .collect();
    assert_close("acute", &estimate, TRUTH);
}

#[test]
fn pi_from_the_disc() {
    for sequence in Sequence::ALL {
        // One mean per independent randomisation makes an honest error bar for every sequence.
        let estimate: Estimate = (0..64)
            .map(|pixel| {
                let inside = (0..4096)
                    .map(|index| Sampler::at(sequence, 5, [pixel, 0], 2 * index).group(Domain::new(0, 0)))
                    .filter(|u| (u[0] - 0.5) * (u[0] - 0.5) + (u[1] - 0.5) * (u[1] - 0.5) <= 0.25)
                    .count();
                4.0 * inside as f64 / 4096.0
            })
            .collect();
        assert_close(sequence.name(), &estimate, std::f64::consts::PI);
    }
}

/// An interval of level 95 % holds the truth 95 times in a hundred.
#[test]
fn confidence_intervals_keep_their_promise() {
    let hits: Estimate = (0..4000)
        .map(|pixel| {
            let sample: Estimate = (0..5)
                .map(|index| {
                    Sampler::at(Sequence::Independent, 4, [pixel, 0], index).group(Domain::new(0, 0))
                })
                .map(|u| warp::normal(f64::from(u[0]), 3.0, 2.0))
                .collect();
            f64::from(sample.confidence_interval(0.95).unwrap().contains(3.0))
        })
        .collect();
    assert_close("coverage", &hits, 0.95);
    assert!((sidak(0.05, 10) - 0.005_116_196_891_823_743).abs() < 1e-15);
}
