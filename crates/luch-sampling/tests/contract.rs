//! What every sequence must keep, whatever its quality.

use luch_sampling::check::{chi_square, sidak};
use luch_sampling::{Domain, Estimate, Sampler, Sequence};

/// Indices from both streams: the first, some early, one beyond 2¹⁶ and one beyond 2³².
const INDICES: [u64; 6] = [0, 1, 2, 7, 200_003, (1 << 33) - 6];

#[test]
fn values_lie_in_the_unit_interval_and_depend_on_nothing_else() {
    for sequence in Sequence::ALL {
        let draw = |index: u64| {
            let sampler = Sampler::at(sequence, 5, [index as u32 % 7, 3], index);
            assert_eq!(u64::from(sampler.stream()), index & 1);
            [Domain::new(0, 0), Domain::new(3, 15), Domain::new((1 << 28) - 1, 2)]
                .map(|domain| sampler.group(domain))
        };
        let forward: Vec<_> = (0..4096).map(draw).collect();
        assert!(forward.iter().flatten().flatten().all(|u| (0.0..1.0).contains(u)), "{sequence:?}");
        let mut backward: Vec<_> = (0..4096).rev().map(draw).collect();
        backward.reverse();
        assert_eq!(forward, backward, "{sequence:?}");
        for index in [1 << 20, (1 << 33) - 1, 1 << 33, u64::MAX] {
            assert!(draw(index).iter().flatten().all(|u| (0.0..1.0).contains(u)), "{sequence:?} at {index}");
        }
    }
}

#[test]
fn groups_and_words_agree() {
    for sequence in Sequence::ALL {
        let sampler = Sampler::at(sequence, 1, [2, 3], 12_345);
        let domain = Domain::new(1, 4);
        let from_words = sampler.group_words(domain).map(|word| (word >> 8) as f32 / 16_777_216.0);
        assert_eq!(sampler.group(domain), from_words);
    }
}

#[test]
fn every_point_is_uniform_over_the_randomisations() {
    const SIDE: usize = 16;
    const PIXELS: u32 = 1 << 15;
    // Eight coordinates: two groups of four. All pairs of them, for every sequence and index.
    let pairs: Vec<[usize; 2]> = (0..8).flat_map(|a| (0..a).map(move |b| [a, b])).collect();
    let level = sidak(0.01, (pairs.len() * INDICES.len() * Sequence::ALL.len()) as u32);
    for sequence in Sequence::ALL {
        for index in INDICES {
            let mut counts = vec![vec![0u64; SIDE * SIDE]; pairs.len()];
            for pixel in 0..PIXELS {
                let sampler = Sampler::at(sequence, 11, [pixel & 255, pixel >> 8], index);
                let [a, b] = [Domain::new(0, 0), Domain::new(2, 1)].map(|domain| sampler.group(domain));
                let u = [a[0], a[1], a[2], a[3], b[0], b[1], b[2], b[3]];
                for (count, [i, j]) in counts.iter_mut().zip(&pairs) {
                    let [i, j] = [u[*i], u[*j]].map(|x| (x * SIDE as f32) as usize);
                    count[i * SIDE + j] += 1;
                }
            }
            let expected = vec![f64::from(PIXELS) / (SIDE * SIDE) as f64; SIDE * SIDE];
            for (count, pair) in counts.iter().zip(&pairs) {
                let test = chi_square(count, &expected);
                assert!(test.p_value > level, "{sequence:?}, index {index}, coordinates {pair:?}: {test:?}");
            }
        }
    }
}

#[test]
fn neighbours_in_every_direction_are_uncorrelated() {
    type Neighbour = fn(Sequence, u32, u64) -> [f32; 4];
    let neighbours: [(&str, Neighbour); 7] = [
        ("next pixel in x", |s, p, i| Sampler::at(s, 3, [p + 1, 8], i).group(Domain::new(1, 2))),
        ("next pixel in y", |s, p, i| Sampler::at(s, 3, [p, 9], i).group(Domain::new(1, 2))),
        ("mirrored pixel", |s, p, i| Sampler::at(s, 3, [8, p], i).group(Domain::new(1, 2))),
        ("next seed", |s, p, i| Sampler::at(s, 4, [p, 8], i).group(Domain::new(1, 2))),
        ("next purpose", |s, p, i| Sampler::at(s, 3, [p, 8], i).group(Domain::new(1, 3))),
        ("next bounce", |s, p, i| Sampler::at(s, 3, [p, 8], i).group(Domain::new(2, 2))),
        ("other stream", |s, p, i| Sampler::at(s, 3, [p, 8], i ^ 1).group(Domain::new(1, 2))),
    ];
    for sequence in Sequence::ALL {
        for (name, neighbour) in neighbours {
            for index in [0, 5, 1000] {
                let mut products: [[Estimate; 4]; 4] = Default::default();
                // Every second pixel, so that no number enters two products.
                for pixel in (100..16_484).step_by(2) {
                    let own = Sampler::at(sequence, 3, [pixel, 8], index).group(Domain::new(1, 2));
                    let other = neighbour(sequence, pixel, index);
                    for (row, a) in products.iter_mut().zip(own) {
                        for (product, b) in row.iter_mut().zip(other) {
                            product.add((f64::from(a) - 0.5) * (f64::from(b) - 0.5));
                        }
                    }
                }
                for z in products.iter().flatten().filter_map(|product| product.z_score(0.0)) {
                    assert!(z.abs() < 4.0, "{sequence:?}, {name}, index {index}: {z} standard errors");
                }
            }
        }
    }
}

/// Two groups are padded side by side. If their points came in the same order, the mean of a product would hardly get better
/// with their number. It must scatter at most twice as much as that of independent pairs: twice, since points 2k and 2k + 1
/// lie in opposite halves in both groups, so that each pair of points decides about one sign only.
#[test]
fn groups_are_shuffled_against_each_other() {
    const POINTS: u64 = 64;
    for sequence in Sequence::ALL {
        for [i, j] in [[0, 0], [0, 1], [1, 2], [3, 3]] {
            let mut scatter = Estimate::new();
            for pixel in 0..3000 {
                let mean = (0..POINTS)
                    .map(|index| {
                        let sampler = Sampler::at(sequence, 21, [pixel, 0], 2 * index);
                        let [a, b] = [Domain::new(0, 1), Domain::new(1, 1)].map(|d| sampler.group(d));
                        (f64::from(a[i]) - 0.5) * (f64::from(b[j]) - 0.5)
                    })
                    .sum::<f64>()
                    / POINTS as f64;
                scatter.add(mean * mean);
            }
            // Independent pairs: (1/12)²/N.
            let z = scatter.z_score(2.0 / (144.0 * POINTS as f64)).unwrap();
            assert!(z < 4.0, "{sequence:?}, coordinates {i} and {j}: {z} standard errors above");
        }
    }
}

type Integrand = fn([f32; 4]) -> f64;

/// (A − B)²/4 is an unbiased estimate of the squared error of (A + B)/2.
#[test]
fn twin_streams_tell_their_error() {
    let disc = |u: [f32; 4]| {
        let (x, y) = (u[0] - 0.5, u[1] - 0.5);
        f64::from(x * x + y * y <= 0.25)
    };
    let smooth = |u: [f32; 4]| {
        let e = std::f64::consts::E - 1.0;
        libm::exp(f64::from(u[0]) + f64::from(u[1])) / (e * e)
    };
    for sequence in Sequence::ALL {
        let cases: [(&str, Integrand, f64); 2] =
            [("disc", disc, std::f64::consts::FRAC_PI_4), ("smooth", smooth, 1.0)];
        for (name, f, truth) in cases {
            let (mut difference, mut error) = (Estimate::new(), Estimate::new());
            for pixel in 0..2000 {
                let mut sums = [0.0; 2];
                for index in 0..256 {
                    let sampler = Sampler::at(sequence, 77, [pixel, 1], index);
                    sums[sampler.stream() as usize] += f(sampler.group(Domain::new(0, 0)));
                }
                let [a, b] = sums.map(|sum| sum / 128.0);
                let (estimated, squared) =
                    ((a - b) * (a - b) / 4.0, (0.5 * (a + b) - truth) * (0.5 * (a + b) - truth));
                difference.add(estimated - squared);
                error.add(squared);
            }
            let z = difference.z_score(0.0).unwrap();
            // The comparison means something: the squared error itself is known to about five per cent.
            let relative = error.standard_error().unwrap() / error.mean().unwrap();
            assert!(
                z.abs() < 4.0 && relative < 0.05,
                "{sequence:?} on {name}: {z} standard errors, {relative}"
            );
        }
    }
}
