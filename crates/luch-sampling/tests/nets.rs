//! Sobol' points are the nets they promise to be, before and after randomisation.

use luch_sampling::check::{crowded_box, l2_star_discrepancy};
use luch_sampling::sequence::{halton, sobol};
use luch_sampling::{Domain, Estimate, Sampler, Sequence};

const FIRST_PAIR: [usize; 2] = [0, 1];
const SECOND_PAIR: [usize; 2] = [2, 3];

fn pairs(points: impl Iterator<Item = [u32; 4]>, pair: [usize; 2]) -> Vec<[u32; 2]> {
    points.map(|point| pair.map(|dimension| point[dimension])).collect()
}

/// Every way of making the first (or any aligned) 2^m points.
fn families(m: u32, start: u32) -> Vec<(&'static str, Vec<[u32; 4]>)> {
    let indices = || start..=start + ((1 << m) - 1);
    let domain = Domain::new(2, 3);
    let sampler = |index: u32| Sampler::at(Sequence::Sobol, 9, [3, 4], 2 * u64::from(index) + 1);
    vec![
        ("plain", indices().map(sobol::point).collect()),
        ("hashed", indices().map(|index| sobol::scrambled(index, 77)).collect()),
        ("shuffled and hashed", indices().map(|index| sobol::words(1234, index)).collect()),
        ("of a sampler", indices().map(|index| sampler(index).group_words(domain)).collect()),
    ]
}

#[test]
fn elementary_intervals_of_the_first_pair_hold_one_point_each() {
    for m in 0..=16 {
        for (name, points) in families(m, 0) {
            assert_eq!(crowded_box(&pairs(points.into_iter(), FIRST_PAIR), 0), None, "{name}, m = {m}");
        }
    }
    for m in [4, 8, 12] {
        let exact = (0..1 << m).map(|index| sobol::owen_exact(index, 5));
        assert_eq!(crowded_box(&pairs(exact, FIRST_PAIR), 0), None, "exact, m = {m}");
    }
}

#[test]
fn blocks_far_beyond_two_to_the_sixteen_are_nets_too() {
    for start in [1 << 20, 5 << 24, 0xffff << 16] {
        for m in [3, 10, 16] {
            for (name, points) in families(m, start) {
                let points = pairs(points.into_iter(), FIRST_PAIR);
                assert_eq!(crowded_box(&points, 0), None, "{name}, {m} from {start}");
            }
        }
    }
}

/// The degrees 2 and 3 of the polynomials of the second pair bound its quality by (2 − 1) + (3 − 1) = 3, as for all four.
#[test]
fn the_second_pair_and_the_whole_keep_their_quality() {
    for m in 3..=16 {
        for (name, points) in families(m, 0) {
            let points = pairs(points.into_iter(), SECOND_PAIR);
            assert_eq!(crowded_box(&points, 3), None, "second pair {name}, m = {m}");
        }
    }
    for m in 3..=12 {
        for (name, points) in families(m, 0) {
            assert_eq!(crowded_box(&points, 3), None, "{name}, m = {m}");
        }
    }
}

/// Each single coordinate of each sequence but the independent one is stratified in base 2, or as a Halton base allows.
#[test]
fn coordinates_are_stratified_one_by_one() {
    for dimension in 0..4 {
        let line: Vec<[u32; 1]> = (0..1 << 14).map(|i| [sobol::words(3, i)[dimension]]).collect();
        assert_eq!(crowded_box(&line, 0), None, "dimension {dimension}");
    }
    let line: Vec<[u32; 1]> = (0..1 << 14).map(|i| [halton::words(3, i)[0]]).collect();
    assert_eq!(crowded_box(&line, 0), None);
}

#[test]
fn plain_points_have_the_known_discrepancy() {
    let unit = |word: u32| f64::from(word) / 4_294_967_296.0;
    let sobol: Vec<[f64; 2]> =
        (0..64).map(sobol::point).map(|point| [unit(point[0]), unit(point[1])]).collect();
    let halton: Vec<[f64; 2]> = (0..64).map(halton::point).map(|point| [point[0], point[1]]).collect();
    let [sobol, halton] = [sobol, halton].map(|points| l2_star_discrepancy(&points));
    assert!((sobol - 0.012_869_849_626_469).abs() < 1e-14, "{sobol}");
    assert!((halton - 0.016_409_436_360_003).abs() < 1e-14, "{halton}");
}

/// E[(L2*)²] of N independent points is (2^−d − 3^−d)/N.
#[test]
fn independent_points_have_the_discrepancy_of_chance() {
    let squares: Estimate = (0..400)
        .map(|pixel| {
            let points: Vec<[f64; 2]> = (0..64)
                .map(|index| {
                    Sampler::at(Sequence::Independent, 1, [pixel, 0], index).group(Domain::new(0, 0))
                })
                .map(|u| [f64::from(u[0]), f64::from(u[1])])
                .collect();
            let discrepancy = l2_star_discrepancy(&points);
            discrepancy * discrepancy
        })
        .collect();
    let z = squares.z_score((0.25 - 1.0 / 9.0) / 64.0).unwrap();
    assert!(z.abs() < 4.0, "{z} standard errors");
}

/// Squared errors of a mean over N points, one per randomisation.
fn squared_errors(
    count: u32,
    replicates: u64,
    truth: f64,
    f: impl Fn(f64, f64) -> f64,
    point: impl Fn(u32, u64) -> [u32; 4],
) -> Estimate {
    (0..replicates)
        .map(|seed| {
            let sum: f64 = (0..count)
                .map(|index| point(index, seed).map(|word| f64::from(word) / 4_294_967_296.0))
                .map(|u| f(u[0], u[1]))
                .sum();
            let error = sum / f64::from(count) - truth;
            error * error
        })
        .collect()
}

#[test]
fn the_hash_scrambles_as_well_as_exact_trees() {
    let disc = |x: f64, y: f64| f64::from((x - 0.5) * (x - 0.5) + (y - 0.5) * (y - 0.5) <= 0.25);
    let smooth = |x: f64, y: f64| libm::exp(x + y) / 2.952_492_442_012_56;
    compare("disc", 256, 1500, std::f64::consts::FRAC_PI_4, disc, 9.3e-3);
    compare("smooth", 256, 1500, 1.0, smooth, 1.75e-4);
    compare("smooth", 4096, 150, 1.0, smooth, 3.04e-6);
}

/// The errors of hashed and exact scrambles agree within their standard errors, and are near the known ones.
fn compare(name: &str, count: u32, replicates: u64, truth: f64, f: fn(f64, f64) -> f64, known: f64) {
    let hashed = squared_errors(count, replicates, truth, f, sobol::scrambled);
    let exact = squared_errors(count, replicates, truth, f, sobol::owen_exact);
    let [(h, h_error), (e, e_error)] =
        [&hashed, &exact].map(|s| (s.mean().unwrap(), s.standard_error().unwrap()));
    let z = (h - e) / (h_error * h_error + e_error * e_error).sqrt();
    assert!(z.abs() < 4.0, "{name}, {count} points: {} against {}", h.sqrt(), e.sqrt());
    // The known figures come from fewer replicates, so they are compared to the fifth they hold.
    assert!((h.sqrt() / known - 1.0).abs() < 0.2, "{name}, {count} points: {}", h.sqrt());
}
