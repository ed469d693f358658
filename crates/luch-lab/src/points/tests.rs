//! The contract of all rules, and what is special to each.

use super::matrices::{four, progressive, sobol};
use super::*;
use crate::measure::{pair_qualities, quality};
use luch_sampling::check;

/// A size and dimension that every rule accepts.
fn some(rule: Rule) -> (usize, usize) {
    if rule == Rule::BlueNoise { (64, 2) } else { (64, 3) }
}

#[test]
fn names_lead_back() {
    for rule in Rule::ALL {
        assert_eq!(Rule::from_name(rule.name()), Some(rule));
        assert!(!rule.description().is_empty());
    }
    assert_eq!(Rule::from_name("randu"), Some(Rule::Independent(crate::generator::Generator::Randu)));
    assert_eq!(Rule::from_name("sobel"), None);
}

/// Sizes in so many dimensions that every rule has.
fn accepted(rule: Rule, count: u64, dimensions: usize) -> u64 {
    rule.nearest_count(count, dimensions)
}

#[test]
fn points_lie_in_the_cube_and_repeat() {
    for rule in Rule::ALL {
        for dimensions in [1, 2, 3, 7, 32, 64] {
            if !rule.dimensions().contains(&dimensions) {
                continue;
            }
            for count in [1, 2, 63, 64, 65, 300] {
                let count = accepted(rule, count, dimensions) as usize;
                let points = rule.points(count, dimensions, 7, 3).unwrap();
                assert_eq!((points.len(), points.dimensions()), (count, dimensions));
                assert!(
                    points.flat().iter().all(|x| (0.0..1.0).contains(x)),
                    "{rule:?} {dimensions} {count}"
                );
                assert_eq!(rule.points(count, dimensions, 7, 3).unwrap(), points);
                let other = rule.points(count, dimensions, 7, 4).unwrap();
                assert_eq!(other != points, rule.is_random(), "{rule:?} {dimensions} {count}");
            }
        }
    }
}

#[test]
fn sequences_have_prefixes_and_stretches_are_parts_of_the_whole() {
    for rule in Rule::ALL {
        let d = some(rule).1;
        for dimensions in [d, 2] {
            if rule.is_sequence() {
                let (long, short) = (rule.points(700, dimensions, 1, 2), rule.points(130, dimensions, 1, 2));
                assert_eq!(long.unwrap().prefix(130), short.unwrap(), "{rule:?}");
            }
            let count = accepted(rule, 5000, dimensions);
            let design = Design { count, dimensions, seed: 1, replicate: 2 };
            if !rule.is_streamed() {
                let error = rule.fill(&design, 0, &mut [0.0; 6]);
                assert_eq!(error, Err(PointsError::NotStreamed { rule: rule.name() }));
                continue;
            }
            let whole = rule.points(count as usize, dimensions, 1, 2).unwrap();
            for (first, length) in
                [(0, 1), (0, 130), (100, 300), (127, 2), (128, 128), (1000, 1001), (4000, 500)]
            {
                let mut part = vec![0.0; length * dimensions];
                rule.fill(&design, first, &mut part).unwrap();
                let start = first as usize * dimensions;
                assert_eq!(part, whole.flat()[start..start + part.len()], "{rule:?} {first} {length}");
            }
        }
    }
}

#[test]
fn stretches_far_out_are_reached() {
    for rule in Rule::ALL.into_iter().filter(|rule| rule.is_streamed()) {
        let count = accepted(rule, 1 << 32, 2);
        let design = Design { count, dimensions: 2, seed: 1, replicate: 2 };
        let mut last = [0.0; 6];
        rule.fill(&design, count - 3, &mut last).unwrap();
        assert!(last.iter().all(|x| (0.0..1.0).contains(x)), "{rule:?} {last:?}");
        assert!(matches!(rule.fill(&design, count - 2, &mut last), Err(PointsError::Stretch { .. })));
        assert!(matches!(rule.fill(&design, u64::MAX, &mut last), Err(PointsError::Stretch { .. })));
    }
}

#[test]
fn refusals_say_what_would_do() {
    let message =
        |rule: Rule, count, dimensions| rule.points(count, dimensions, 0, 0).unwrap_err().to_string();
    assert_eq!(
        message(Rule::Jittered, 100, 3),
        "`jittered` cannot place 100 points in 3 dimensions: the number must be k^d, a whole number to the power of the \
         dimensions; the nearest below is 64"
    );
    assert!(message(Rule::Sobol, 0, 3).contains("at least 1"));
    assert!(message(Rule::Sobol, 5, 65).contains("1 to 64"));
    assert!(message(Rule::BlueNoise, 5, 3).contains("2 to 2"));
    assert!(message(Rule::Sobol, 1 << 30, 64).contains("more than"));
    assert!(message(Rule::MultiJittered, 7, 2).contains("nearest below is 6"));
    assert!(matches!(Rule::Sobol.points_into(2, 0, 0, &mut [0.0; 3]), Err(PointsError::Stretch { .. })));
    assert!(Rule::Sobol.points_into(0, 0, 0, &mut [0.0; 3]).is_err());
}

#[test]
fn random_rules_are_uniform_and_unbiased() {
    const REPLICATES: u64 = 1000;
    for rule in Rule::ALL.into_iter().filter(|rule| rule.is_random()) {
        let (count, dimensions) = some(rule);
        let mut picked = vec![Vec::new(); dimensions];
        let mut means = Vec::new();
        for replicate in 0..REPLICATES {
            let points = rule.points(count, dimensions, 99, replicate).unwrap();
            // A point at random: fixed ones may belong to fixed cells.
            let point = points.point(luch_sampling::hash::word(5, replicate) as usize % count);
            picked.iter_mut().zip(point).for_each(|(list, &x)| list.push(x));
            let value =
                |p: &[f64]| p.iter().map(|x| libm::exp(*x) / (std::f64::consts::E - 1.0)).product::<f64>();
            means.push(points.iter().map(value).sum::<f64>() / count as f64);
        }
        for (dimension, values) in picked.iter().enumerate() {
            let p = check::uniformity(values).p_value;
            // 60 such tests at one in ten thousand.
            assert!(p > check::sidak(1e-2, 60), "{rule:?} {dimension}: {p}");
        }
        let n = REPLICATES as f64;
        let mean = means.iter().sum::<f64>() / n;
        let variance = means.iter().map(|m| (m - mean) * (m - mean)).sum::<f64>() / (n - 1.0);
        let error = (variance / n).sqrt();
        assert!((mean - 1.0).abs() < 4.0 * error, "{rule:?}: {mean} ± {error}");
    }
}

#[test]
fn sobol_numbers_are_those_of_joe_and_kuo() {
    // FNV-1a over the 32-bit direction numbers of 64 dimensions, little-endian. The same digest comes out of an independent
    // implementation's table.
    let mut digest = 0xcbf2_9ce4_8422_2325u64;
    for columns in sobol() {
        for byte in columns.iter().flat_map(|word| word.to_le_bytes()) {
            digest = (digest ^ u64::from(byte)).wrapping_mul(0x100_0000_01b3);
        }
    }
    assert_eq!(digest, DIGEST);
    let points = Rule::Sobol.points(4, 3, 0, 0).unwrap();
    assert_eq!(points.flat(), [0.0, 0.0, 0.0, 0.5, 0.5, 0.5, 0.25, 0.75, 0.75, 0.75, 0.25, 0.25]);
    for index in [0u32, 1, 77, 1 << 20] {
        let own: Vec<u32> = sobol()[..4]
            .iter()
            .map(|c| (0..32).filter(|b| index >> b & 1 == 1).fold(0, |w, b| w ^ c[b as usize]))
            .collect();
        assert_eq!(own, luch_sampling::sequence::sobol::point(index));
    }
}

#[test]
fn randomised_sobol_points_stay_nets_of_the_same_quality() {
    let plain = Rule::Sobol.points(1 << 10, 6, 0, 0).unwrap();
    let qualities = pair_qualities(&plain).unwrap();
    assert_eq!(qualities[0].quality, 0);
    for rule in [Rule::SobolShifted, Rule::SobolLinear, Rule::SobolOwen, Rule::SobolHashed] {
        for replicate in 0..4 {
            let points = rule.points(1 << 10, 6, 1, replicate).unwrap();
            assert_eq!(pair_qualities(&points).unwrap(), qualities, "{rule:?}");
        }
    }
}

#[test]
fn pairs_are_nets_of_quality_zero() {
    for rule in [Rule::ZeroTwo, Rule::Pmj02, Rule::Sz] {
        for replicate in 0..8 {
            let points = rule.points(1 << 10, 8, 3, replicate).unwrap();
            for m in 0..=10 {
                let prefix = points.prefix(1 << m);
                for pair in pair_qualities(&prefix).unwrap() {
                    if pair.first % 2 == 0 && pair.second == pair.first + 1 {
                        assert_eq!(pair.quality, 0, "{rule:?} {m} {pair:?}");
                    }
                }
            }
        }
    }
}

#[test]
fn progressive_points_fill_cells_diagonally() {
    for replicate in 0..4 {
        let points = Rule::Pmj02.points(512, 2, 3, replicate).unwrap();
        for k in 0..4 {
            let (before, side) = (1usize << (2 * k), f64::from(2 << k));
            let cell = |i: usize| [points.point(i)[0], points.point(i)[1]].map(|x| (x * side) as u32);
            for i in 0..before {
                let (old, new) = (cell(i), cell(i + before));
                assert_eq!(old.map(|c| c ^ 1), new, "{k} {i}");
                // The last two quarters of the cell, in either order.
                let rest = [cell(i + 2 * before), cell(i + 3 * before)];
                let other = [[old[0] ^ 1, old[1]], [old[0], old[1] ^ 1]];
                assert!(rest == other || rest == [other[1], other[0]], "{k} {i}");
            }
        }
    }
    assert_ne!(progressive(1), progressive(2));
}

#[test]
fn groups_of_four_are_nets_in_base_four() {
    // The first 4^m points, all shapes of boxes 4^−k₁ × … × 4^−k₄ with Σ k = m.
    let columns = four();
    for m in 1..=5u32 {
        let words: Vec<[u32; 4]> = (0..1u32 << (2 * m))
            .map(|i| {
                columns
                    .map(|c| (0..32).filter(|b| i >> b & 1 == 1).fold(0, |word, bit| word ^ c[bit as usize]))
            })
            .collect();
        for shape in 0..(m + 1).pow(4) {
            let k = [0, 1, 2, 3].map(|place| shape / (m + 1).pow(place) % (m + 1));
            if k.iter().sum::<u32>() != m {
                continue;
            }
            let mut seen = vec![false; words.len()];
            for word in &words {
                let cell = word
                    .iter()
                    .zip(k)
                    .fold(0u64, |cell, (&w, k)| cell << (2 * k) | u64::from(w) >> (32 - 2 * k));
                assert!(!std::mem::replace(&mut seen[cell as usize], true), "{m} {k:?}");
            }
        }
    }
}

#[test]
fn cells_and_slices_are_filled_once() {
    let once = |places: Vec<usize>, name: &str| {
        let mut seen = vec![false; places.len()];
        for place in places {
            assert!(!std::mem::replace(&mut seen[place], true), "{name}");
        }
    };
    for rule in [Rule::LatinHypercube, Rule::MultiJittered, Rule::CorrelatedMultiJittered] {
        let points = rule.points(72, 5, 1, 1).unwrap();
        for d in 0..5 {
            once(points.iter().map(|p| (p[d] * 72.0) as usize).collect(), rule.name());
        }
        if rule != Rule::LatinHypercube {
            for pair in [0, 2] {
                let cell = |p: &[f64]| (p[pair] * 8.0) as usize * 9 + (p[pair + 1] * 9.0) as usize;
                once(points.iter().map(cell).collect(), rule.name());
            }
        }
    }
    for rule in [Rule::Jittered, Rule::Midpoints] {
        let points = rule.points(125, 3, 1, 1).unwrap();
        let cell = |p: &[f64]| p.iter().fold(0, |cell, x| cell * 5 + (x * 5.0) as usize);
        once(points.iter().map(cell).collect(), rule.name());
    }
}

#[test]
fn halton_points_are_mirrored_digits() {
    let points = Rule::Halton.points(6000, 4, 0, 0).unwrap();
    for (i, point) in points.iter().enumerate() {
        let exact = luch_sampling::sequence::halton::point(i as u32);
        for (x, y) in point.iter().zip(exact) {
            assert!((x - y).abs() < 1e-15, "{i}");
        }
    }
    let set = Rule::Hammersley.points(10, 3, 0, 0).unwrap();
    assert_eq!((set.point(7)[0], set.point(7)[1]), (0.7, points.point(7)[0]));
}

#[test]
fn scrambled_halton_points_stay_a_sequence_in_every_base() {
    let points = Rule::HaltonScrambled.points(20_000, 6, 3, 1).unwrap();
    for (d, base) in [2u32, 3, 5, 7, 11, 13].into_iter().enumerate() {
        let mut cells = base as usize;
        while cells <= 10_000 {
            for start in [0, cells] {
                let mut seen = vec![false; cells];
                for i in start..start + cells {
                    let cell = (points.point(i)[d] * cells as f64) as usize;
                    assert!(!std::mem::replace(&mut seen[cell], true), "base {base}, {cells} from {start}");
                }
            }
            cells *= base as usize;
        }
    }
}

#[test]
fn kronecker_steps_are_powers_of_golden_ratios() {
    let fraction = |word: u64| word as f64 / 18_446_744_073_709_551_616.0;
    let golden = lattice::kronecker_steps(1)[0];
    assert!(golden.abs_diff(0x9e37_79b9_7f4a_7c15) < 8);
    // Roberts: the plastic number's inverse and its square.
    let [a, b] = [0, 1].map(|i| fraction(lattice::kronecker_steps(2)[i]));
    assert!((a - 0.754_877_666_246_692_7).abs() < 1e-15 && (b - 0.569_840_290_998_053_2).abs() < 1e-15);
}

#[test]
fn lattice_points_are_as_good_as_the_construction_says() {
    // Component by component: no other odd number has a worst-case error less than 1/1.77 of this one's.
    for m in [6, 8, 9] {
        let n = 1u64 << m;
        let kernel = |i: u64, z: u64, d: usize| {
            let x = (i * z % n) as f64 / n as f64;
            let pi = std::f64::consts::PI;
            1.0 + 2.0 * pi * pi * (x * x - x + 1.0 / 6.0) / (d + 1) as f64
        };
        let mut products: Vec<f64> = (0..n).map(|i| kernel(i, 1, 0)).collect();
        for (d, &component) in GENERATING_VECTOR.iter().enumerate().take(8).skip(1) {
            let squared = |z: u64| {
                let sum: f64 = (0..n).zip(&products).map(|(i, product)| product * kernel(i, z, d)).sum();
                sum / n as f64 - 1.0
            };
            let least = (1..n).step_by(2).map(squared).fold(f64::INFINITY, f64::min);
            let own = squared(u64::from(component));
            assert!(own.sqrt() < 1.77 * least.sqrt(), "{n} {d}: {own} {least}");
            products
                .iter_mut()
                .zip(0..)
                .for_each(|(product, i)| *product *= kernel(i, u64::from(component), d));
        }
    }
    let points = Rule::LatticeShifted.points(64, 2, 1, 1).unwrap();
    // Differences from the first point are multiples of 1/64.
    for point in &points {
        for (x, y) in point.iter().zip(points.point(0)) {
            let steps = (x - y) * 64.0;
            assert!((steps - steps.round()).abs() < 1e-6);
        }
    }
}

#[test]
fn blue_noise_keeps_its_distance() {
    let least = |rule: Rule| crate::measure::least_distance(&rule.points(1024, 2, 1, 0).unwrap(), true);
    let independent = Rule::Independent(crate::generator::Generator::DEFAULT);
    // The closest packing of 1024 points keeps 0.0336.
    let own = least(Rule::BlueNoise);
    assert!(own > 0.018 && own > 10.0 * least(independent), "{own}");
}

#[test]
fn quality_of_one_dimension_is_perfect_for_digital_rules() {
    for rule in [Rule::SobolOwen, Rule::SobolHashed, Rule::Sz, Rule::Pmj02, Rule::ZeroTwo] {
        let points = rule.points(256, 1, 4, 4).unwrap();
        assert_eq!(quality(&points), Some(0), "{rule:?}");
    }
}

/// See [`sobol_numbers_are_those_of_joe_and_kuo`].
const DIGEST: u64 = 0xb605_d28f_20cb_a3d9;
