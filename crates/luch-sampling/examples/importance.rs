//! The integral of cos⁷⁷ over [−π/2, π/2] by samples of different densities: same value, very different error.
#![allow(clippy::print_stdout)]

use std::f64::consts::{FRAC_1_PI, FRAC_PI_2, PI};

use luch_sampling::{Domain, Estimate, Sampler, Sequence, warp};

/// The integrand, zero outside its domain: a normal number that falls there simply counts as zero.
fn peak(x: f64) -> f64 {
    if x.abs() < FRAC_PI_2 { libm::pow(libm::cos(x), 77.0) } else { 0.0 }
}

fn report(name: &str, sample: impl Fn(f64) -> f64) {
    let estimate: Estimate = (0..10_000)
        .map(|index| Sampler::at(Sequence::Independent, 1, [0, 0], index).group(Domain::new(0, 0)))
        .map(|u| sample(f64::from(u[0])))
        .collect();
    let (Some(mean), Some(variance)) = (estimate.mean(), estimate.variance()) else { return };
    println!("{name:14} {mean:.6}   variance of a sample {variance:.3e}");
}

fn main() {
    report("uniform", |u| peak(PI * (u - 0.5)) / FRAC_1_PI);
    for deviation in [0.3, 0.15, 0.113, 0.08] {
        report(&format!("normal {deviation}"), |u| {
            let x = warp::normal(u, 0.0, deviation);
            peak(x) / warp::normal_pdf(x, 0.0, deviation)
        });
    }
    println!("exactly        0.284731");
}
