//! Known answers of the tests of generators.

use super::*;
use crate::generator::Lcg;

#[test]
fn spectral_table() {
    // ν₂ … ν₆ of the literature (Knuth, TAOCP 2, 3.3.4, table 1, and computed with whole numbers of any length).
    let table: [(Generator, [f64; 5]); 8] = [
        (Generator::Randu, [23_171.9, 10.9, 10.8, 10.8, 10.8]),
        (Generator::Minstd16807, [16_807.0, 638.9, 147.2, 66.6, 29.9]),
        (Generator::Minstd48271, [44_617.7, 1_197.4, 217.8, 66.4, 37.4]),
        (Generator::AnsiC, [41_962.0, 753.7, 161.1, 44.0, 31.8]),
        (Generator::Msvc, [62_889.1, 1_435.3, 157.0, 33.4, 33.4]),
        (Generator::Lcg32, [70_277.4, 1_524.0, 252.4, 64.0, 32.2]),
        (Generator::Drand48, [9_212_060.6, 59_070.8, 2_188.3, 558.7, 218.3]),
        (Generator::Lcg64, [2_968_276_297.0, 2_529_487.0, 64_129.8, 6_757.4, 1_358.8]),
    ];
    for (generator, expected) in table {
        let results = spectral(&generator.lcg().unwrap(), 8);
        assert_eq!(results.len(), 7);
        for (result, expected) in results.iter().zip(expected) {
            let digit = if expected > 2e6 && expected.fract() == 0.0 { 0.5 } else { 0.05 };
            let nu = result.nu();
            assert!(
                (nu - expected).abs() <= digit * 1.001,
                "{generator:?} {}: {nu}, {expected}",
                result.dimension
            );
        }
    }
    assert_eq!(spectral(&Generator::Randu.lcg().unwrap(), 3)[1].nu_squared, 118);
}

#[test]
fn shortest_vectors_belong_to_the_dual_lattice_and_loops_find_none_shorter() {
    for generator in Generator::ALL {
        let Some(lcg) = generator.lcg() else { continue };
        for result in spectral(&lcg, 8) {
            let (mut sum, mut power) = (0i128, 1i128);
            let modulus = lcg.lattice_modulus as i128;
            for &h in &result.vector {
                sum = (sum + h % modulus * (power % modulus) % modulus).rem_euclid(modulus);
                power = (power.unsigned_abs() * u128::from(lcg.multiplier) % lcg.lattice_modulus) as i128;
            }
            assert_eq!(sum, 0, "{generator:?} {result:?}");
            assert_eq!(
                result.vector.iter().map(|h| h.unsigned_abs().pow(2)).sum::<u128>(),
                result.nu_squared
            );
        }
    }
    // All vectors within a box, for a modulus so small that one can look at them.
    for multiplier in [3u64, 45, 101, 333, 517] {
        let lcg = Lcg { multiplier, increment: 1, modulus: 1009, lattice_modulus: 1009 };
        let mut least = i128::MAX;
        let multiplier = i128::from(multiplier);
        for x in -40i128..=40 {
            for y in -40i128..=40 {
                for z in -40i128..=40 {
                    let inside = (x + multiplier * y + multiplier * multiplier * z).rem_euclid(1009) == 0;
                    if inside && [x, y, z] != [0; 3] {
                        least = least.min(x * x + y * y + z * z);
                    }
                }
            }
        }
        assert_eq!(spectral(&lcg, 3)[1].nu_squared, least as u128, "{multiplier}");
    }
}

#[test]
fn randu_has_fifteen_planes() {
    let lcg = Generator::Randu.lcg().unwrap();
    let planes = Planes::of(&lcg, 3).unwrap();
    assert_eq!((planes.vector.as_slice(), planes.count, planes.offset), (&[9, -6, 1][..], 15, 0.0));
    assert!((planes.distance - 1.0 / 118f64.sqrt()).abs() < 1e-15);
    let across: f64 = planes.view.iter().zip(&planes.normal).map(|(a, b)| a * b).sum();
    assert!(across.abs() < 1e-15);
    let mut stream = Generator::Randu.start(1);
    let mut seen = std::collections::BTreeSet::new();
    for _ in 0..100_000 {
        let [x, y, z] = [stream.unit_f64(), stream.unit_f64(), stream.unit_f64()];
        let plane = 9.0 * x - 6.0 * y + z;
        assert_eq!(plane, plane.round());
        seen.insert(plane as i64);
    }
    assert_eq!(seen.into_iter().collect::<Vec<_>>(), (-5..=9).collect::<Vec<_>>());
    assert_eq!((most_planes(1 << 31, 3).round(), most_planes(1 << 31, 6).round()), (2344.0, 108.0));
}

#[test]
fn points_of_congruences_lie_on_their_planes() {
    for generator in [Generator::AnsiC, Generator::Lcg32, Generator::Minstd16807] {
        let lcg = generator.lcg().unwrap();
        let planes = Planes::of(&lcg, 4).unwrap();
        let mut stream = generator.start(5);
        for _ in 0..1000 {
            let x: [f64; 4] = std::array::from_fn(|_| stream.unit_f64());
            let product: f64 = planes.vector.iter().zip(x).map(|(&h, x)| h as f64 * x).sum();
            let off = product - planes.offset;
            assert!((off - off.round()).abs() < 1e-9, "{generator:?}: {off}");
        }
        assert!(planes.count as f64 <= most_planes(lcg.modulus, 4));
    }
}

#[test]
fn randu_sees_one_value_of_the_killer() {
    let result = killer(&mut Generator::Randu.start(1), 1000);
    assert!((result.statistic - 1.0).abs() < 1e-12 && result.p_value < 1e-100);
}

#[test]
fn berlekamp_and_massey_find_registers() {
    // x⁴ + x + 1 makes 000100110101111 and on.
    let mut bits = vec![false, false, false, true];
    for i in 4..200 {
        bits.push(bits[i - 3] ^ bits[i - 4]);
    }
    assert_eq!(berlekamp_massey(&bits), 4);
    assert_eq!(berlekamp_massey(&[false; 100]), 0);
    let mut lonely = vec![false; 100];
    lonely[99] = true;
    assert_eq!(berlekamp_massey(&lonely), 100);
    // The Thue–Morse word's first 64 bits, against the plain algorithm written with a polynomial of bits.
    let word: Vec<bool> = (0..1000u32).map(|i| (i * i % 7 + i.count_ones()) % 2 == 1).collect();
    for length in [1, 2, 63, 64, 65, 128, 500, 1000] {
        assert_eq!(berlekamp_massey(&word[..length]), plain_massey(&word[..length]), "{length}");
    }
}

fn plain_massey(bits: &[bool]) -> usize {
    let n = bits.len();
    let (mut c, mut b) = (vec![false; n + 1], vec![false; n + 1]);
    (c[0], b[0]) = (true, true);
    let (mut length, mut last) = (0usize, -1isize);
    for i in 0..n {
        let discrepancy = (0..=length).fold(false, |sum, j| sum ^ (c[j] && bits[i - j]));
        if discrepancy {
            let kept = c.clone();
            let shift = (i as isize - last) as usize;
            for j in 0..=n - shift.min(n) {
                c[j + shift] ^= b[j];
            }
            if 2 * length <= i {
                length = i + 1 - length;
                last = i as isize;
                b = kept;
            }
        }
    }
    length
}

#[test]
fn linear_complexity_knows_the_size_of_the_state() {
    let twister = linear_complexity(&mut Generator::Mt19937.start(5), Part::Low(1), 50_000);
    assert_eq!(twister.statistic, 19_937.0);
    let shift = linear_complexity(&mut Generator::Xorshift128Plus.start(5), Part::Low(1), 1000);
    assert_eq!(shift.statistic, 128.0);
    // Full distribution for few bits: every sequence of 10 bits.
    let mut counts = [0u32; 11];
    for word in 0..1024u32 {
        let bits: Vec<bool> = (0..10).map(|i| word >> i & 1 == 1).collect();
        counts[berlekamp_massey(&bits)] += 1;
    }
    assert_eq!(counts, [1, 2, 8, 32, 128, 512, 256, 64, 16, 4, 1]);
}

#[test]
fn tails_agree_with_a_reference() {
    assert!((normal_two_sided(1.959_963_984_540_054) - 0.05).abs() < 1e-14);
    // Poisson with mean 16: P(Y ≤ 6) = 0.00401, P(Y ≥ 30) = 0.00128 (sums of the terms).
    let term = |k: u64| (1..=k).fold(libm::exp(-16.0), |t, i| t * 16.0 / i as f64);
    let lower: f64 = (0..=6).map(term).sum();
    let upper: f64 = (30..200).map(term).sum();
    assert!((poisson_two_sided(6, 16.0) / (2.0 * lower) - 1.0).abs() < 1e-12);
    assert!((poisson_two_sided(30, 16.0) / (2.0 * upper) - 1.0).abs() < 1e-12);
    assert!(poisson_two_sided(400, 16.0) < 1e-300 * 1e10 && poisson_two_sided(16, 16.0) > 0.9);
}

#[test]
fn names_lead_back() {
    for test in Test::ALL {
        assert_eq!(Test::from_name(test.name()), Some(test));
    }
}
