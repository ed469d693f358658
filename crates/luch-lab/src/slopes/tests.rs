//! The table of slopes, reproduced.

use super::*;
use crate::generator::Generator;

#[test]
fn means_are_those_of_a_fine_rule() {
    for dimensions in 1..=4 {
        let points = Rule::SobolOwen.points(1 << 16, dimensions, 3, 3).unwrap();
        for integrand in Integrand::ALL {
            let mean = integrand.mean(dimensions).unwrap();
            let found = points.iter().map(|p| integrand.value(p)).sum::<f64>() / points.len() as f64;
            // Errors of indicators in four dimensions stay below one in a thousand here.
            assert!((mean - found).abs() < 1e-3, "{integrand:?} {dimensions}: {mean} {found}");
            assert_eq!(Integrand::from_name(integrand.name()), Some(integrand));
        }
    }
    assert_eq!((Integrand::Kink.mean(5), Integrand::Smooth.mean(0)), (None, None));
}

#[test]
fn slopes_are_the_known_ones() {
    let mut wrong = Vec::new();
    for expected in EXPECTED {
        // Shifted Halton points err by a few odd sizes, whose luck 48 replicates do not even out.
        let replicates = if expected.rule == Rule::HaltonShifted { 192 } else { 48 };
        let settings = SlopeSettings { resamplings: 0, replicates, ..SlopeSettings::default() };
        let rows = measure(expected.rule, expected.dimensions, &settings).unwrap();
        for (row, slope) in rows.iter().zip(expected.slopes) {
            let Some(slope) = slope else { continue };
            let found = row.fit.unwrap().slope;
            if (found - slope).abs() > tolerance(row.rule, row.integrand) {
                wrong.push(format!(
                    "{:?} {} {:?}: {found:.3}, known {slope}",
                    row.rule, row.dimensions, row.integrand
                ));
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn scrambling_beats_chance_a_hundred_times() {
    let settings = SlopeSettings { first: 10, last: 10, ..SlopeSettings::default() };
    let error = |rule| measure(rule, 2, &settings).unwrap()[1].errors[0].rmse;
    let independent = error(Rule::Independent(Generator::DEFAULT));
    for rule in [Rule::SobolOwen, Rule::SobolHashed, Rule::Pmj02, Rule::ZeroTwo, Rule::Sz] {
        assert!(error(rule) < independent / 100.0, "{rule:?}");
    }
}

#[test]
fn exactness_is_said_and_intervals_hold_their_slopes() {
    // A lattice of one point a slice sees no error of a constant; the additive integrand in one dimension is not constant.
    let settings = SlopeSettings { first: 6, last: 9, replicates: 16, ..SlopeSettings::default() };
    let rows = measure(Rule::SobolOwen, 2, &settings).unwrap();
    for row in &rows {
        let (fit, [low, high]) = (row.fit.unwrap(), row.interval.unwrap());
        assert!(low <= fit.slope && fit.slope <= high && low < high, "{row:?}");
        assert!(!row.is_exact());
    }
    assert_eq!(rows, measure(Rule::SobolOwen, 2, &settings).unwrap());
    // One replicate gives errors and a slope, but no interval.
    let plain = measure(Rule::Sobol, 2, &settings).unwrap();
    assert!(plain.iter().all(|row| row.fit.is_some() && row.interval.is_none()));
    assert!(measure(Rule::BlueNoise, 3, &settings).is_err());
}
