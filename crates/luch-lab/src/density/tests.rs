//! Known optima, unbiased weights, measured against computed.

use super::*;
use crate::integral::{HashedPoints, Integral, SequencePoints};
use luch_sampling::Sequence;

const POINTS: HashedPoints = HashedPoints { seed: 77 };

fn bell() -> Integral {
    Integral::new("cos(x)^77", "x=-pi/2..pi/2").unwrap()
}

#[test]
fn the_best_width_is_found() {
    let scan = normal_scan(&bell(), 0.0, 0.05, 0.6, 60).unwrap();
    assert!((scan.integral - 0.284_730_875_959_477_4).abs() < 1e-13);
    // A minimum is flat: the place is known to the root of the precision of the values.
    assert!((scan.best.deviation - 0.113_230_66).abs() < 1e-6, "{:?}", scan.best);
    assert!((scan.best.variance - 2.222_155_691e-6).abs() < 1e-14, "{:?}", scan.best);
    assert!((scan.best.relative_deviation - 0.005_235_5).abs() < 1e-7);
    // Too narrow is worse than too wide: 0.08 against 0.15.
    let at = |sigma: f64| normal_scan(&bell(), 0.0, sigma, 2.0 * sigma, 2).unwrap().rows[0].variance;
    assert!((at(0.08) / at(0.15) - 0.128_679_367_386_951 / 0.008_685_186_320_736_89).abs() < 1e-6);
    assert!(normal_scan(&bell(), 0.0, 0.0, 1.0, 5).is_none());
    assert!(normal_scan(&Integral::new("1", "x=-inf..inf").unwrap(), 0.0, 0.1, 1.0, 5).is_none());
}

#[test]
fn weights_of_two_techniques() {
    // A peak and a broad hill, each found by one density alone.
    let integral = Integral::new("exp(-((x-0.2)/0.02)^2)*8 + 1 + x", "x=0..1").unwrap();
    let integral = integral.with_density("truncated(0.2, 0.02)").unwrap();
    let mis = mis(&integral, "uniform", &POINTS, 1 << 16).unwrap().unwrap();
    let row = |kind: MisWeights| mis.rows.iter().find(|row| row.weights == kind).unwrap();
    for kind in [MisWeights::Second, MisWeights::Balance, MisWeights::Power, MisWeights::Optimal] {
        let row = row(kind);
        let z = (row.estimate - mis.integral) / row.standard_error;
        assert!(z.abs() < 4.0, "{row:?}");
        let measured = row.standard_error * row.standard_error * f64::from(1 << 16);
        assert!((measured / row.variance - 1.0).abs() < 0.1, "{row:?}: {measured}");
    }
    assert!(row(MisWeights::Balance).variance < row(MisWeights::Second).variance);
    let best = row(MisWeights::Optimal).variance;
    assert!(mis.rows.iter().all(|row| row.variance >= best), "{:?}", mis.rows);
    // An integrand that is a mixture of both densities is found exactly by the optimal weights.
    let both = Integral::new("2 + 3*2*x", "x=0..1").unwrap().with_density("power(1)").unwrap();
    let exact = super::mis(&both, "uniform", &POINTS, 64).unwrap().unwrap();
    let optimal = exact.rows.iter().find(|row| row.weights == MisWeights::Optimal).unwrap();
    assert!((optimal.estimate - 5.0).abs() < 1e-9 && optimal.variance.abs() < 1e-9, "{optimal:?}");
    assert!(super::mis(&integral, "rubbish", &POINTS, 64).is_err());
}

#[test]
fn a_control_variate_saves_what_its_correlation_says() {
    let f = Integral::new("exp(x)", "x=0..1").unwrap();
    let g = Integral::new("x", "x=0..1").unwrap().with_truth("0.5").unwrap();
    let found = control_variate(&f, &g, &POINTS, 1 << 16).unwrap();
    assert!(((found.estimate - (std::f64::consts::E - 1.0)) / found.standard_error).abs() < 4.0);
    // Correlation of eˣ and x: covariance (3 − e)/2, variances (e − 1)(3 − e)/2 and 1/12.
    let e = std::f64::consts::E;
    let correlation = (3.0 - e) / 2.0 / ((e - 1.0) * (3.0 - e) / 2.0 / 12.0).sqrt();
    let expected = 1.0 - correlation * correlation;
    assert!((found.variance / found.plain_variance / expected - 1.0).abs() < 0.05, "{found:?} {expected}");
    assert!(control_variate(&f, &f, &POINTS, 1000).is_none(), "its integral is not known");
    assert_eq!(control_figure(&f, &g, &found).unwrap().layers.len(), 3);
}

#[test]
fn roulette_and_splitting_by_variance_times_time() {
    let dear = TwoStages {
        direct_mean: 1.0,
        direct_variance: 4.0,
        weight_mean: 0.2,
        weight_variance: 0.01,
        amount_mean: 1.0,
        amount_variance: 0.01,
        first_cost: 1.0,
        second_cost: 50.0,
    };
    let uncertain = TwoStages {
        direct_variance: 0.1,
        weight_mean: 1.0,
        amount_variance: 9.0,
        first_cost: 20.0,
        second_cost: 1.0,
        ..dear
    };
    assert!(
        dear.best_rate() < 1.0 && uncertain.best_rate() > 1.0,
        "{} {}",
        dear.best_rate(),
        uncertain.best_rate()
    );
    for stage in [dear, uncertain] {
        for rate in [0.25, 1.0, 2.0, 3.5] {
            let played = stage.play(rate, 200_000, 5);
            let truth = stage.direct_mean + stage.weight_mean * stage.amount_mean;
            assert!(played.z_score(truth).unwrap().abs() < 4.0, "{stage:?} at {rate}");
            assert!(
                (played.variance().unwrap() / stage.variance(rate) - 1.0).abs() < 0.05,
                "{stage:?} at {rate}"
            );
        }
    }
    let figure = stages_figure(&[("dear".into(), dear), ("uncertain".into(), uncertain)]);
    assert_eq!(figure.layers.len(), 3);
}

#[test]
fn only_the_grid_minds_dimensions() {
    let sizes: Vec<u64> = (6..=14).map(|k| 1 << k).collect();
    let sobol = SequencePoints { sequence: Sequence::Sobol, seed: 3 };
    let study = dimensions(&[1, 2, 5, 10], &sizes, 48, &POINTS, &sobol).unwrap();
    for row in &study.rows {
        match row.rule {
            Rule::MonteCarlo => assert!((row.slope.unwrap() + 0.5).abs() < 0.08, "{row:?}"),
            Rule::QuasiMonteCarlo if row.dimensions <= 2 => assert!(row.slope.unwrap() < -1.3, "{row:?}"),
            // Between sizes the grid changes in jumps; over 8 octaves the exponent −2/d shows.
            Rule::Grid if row.dimensions <= 5 => {
                assert!((row.slope.unwrap() + 2.0 / row.dimensions as f64).abs() < 0.06, "{row:?}");
            }
            _ => {}
        }
    }
    assert_eq!(dimensions_figure(&study).figures.len(), 3);
    assert!(dimension_integral(33).is_err() && dimension_integral(0).is_err());
}

#[test]
fn the_square_is_sampled_as_its_density_says() {
    for density in
        ["uniform", CENTERED, "x=power(2), y=0.5*uniform+0.5*truncated(0.3,0.1)", "normal(0.5, 0.3)"]
    {
        let fit = square_fit(density, FitSettings::default()).unwrap();
        assert!(fit.agrees(1e-3), "{density}: {fit:?}");
    }
    let sheet = square_sheet(CENTERED, &POINTS, 1000).unwrap();
    assert_eq!(sheet.figures.len(), 3);
    assert!(square_sheet("gauss", &POINTS, 10).is_err());
}
