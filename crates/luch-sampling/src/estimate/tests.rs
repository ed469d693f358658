//! Known answers, order independence and hostile samples.

use proptest::prelude::*;

use super::*;

#[test]
fn small_known_answers() {
    let empty = Estimate::new();
    assert_eq!((empty.mean(), empty.variance(), empty.z_score(0.0)), (None, None, None));
    let one: Estimate = [3.0].into_iter().collect();
    assert_eq!((one.mean(), one.variance(), one.confidence_interval(0.95)), (Some(3.0), None, None));
    let three: Estimate = [1.0, 2.0, 3.0].into_iter().collect();
    assert_eq!((three.mean(), three.variance()), (Some(2.0), Some(1.0)));
    // t(2 degrees, 97.5 %) = 4.302652729749464.
    let interval = three.confidence_interval(0.95).unwrap();
    assert!((interval.high - (2.0 + 4.302_652_729_749_464 / 3f64.sqrt())).abs() < 1e-12, "{interval:?}");
    assert!((three.z_score(1.0).unwrap() - 3f64.sqrt()).abs() < 1e-15);
    assert_eq!(three.confidence_interval(1.0), None);
}

#[test]
fn variance_does_not_cancel() {
    // Spread of one around 1e15, and of a single rounding step around one.
    let far: Estimate = [1e15 + 1.0, 1e15 + 2.0, 1e15 + 3.0].into_iter().collect();
    assert_eq!(far.variance(), Some(1.0));
    let step = f64::EPSILON;
    let near: Estimate = [1.0, 1.0 + step].into_iter().collect();
    assert_eq!(near.variance(), Some(step * step / 2.0));
    let equal: Estimate = std::iter::repeat_n(0.1, 1000).collect();
    assert_eq!((equal.mean(), equal.variance()), (Some(0.1), Some(0.0)));
}

#[test]
fn extremes_neither_overflow_nor_vanish() {
    let huge: Estimate = [f64::MAX, f64::MAX, -f64::MAX, f64::MAX].into_iter().collect();
    assert_eq!(huge.mean(), Some(f64::MAX / 2.0));
    let all_huge: Estimate = [f64::MAX; 5].into_iter().collect();
    assert_eq!((all_huge.mean(), all_huge.variance()), (Some(f64::MAX), Some(0.0)));
    assert_eq!(huge.variance(), Some(f64::INFINITY));
    let tiny: Estimate = [5e-324, 5e-324, 1e300, -1e300].into_iter().collect();
    assert_eq!(tiny.sum.value(), 1e-323);
    let odd: Estimate = [f64::NAN, 1.0, f64::INFINITY, f64::NEG_INFINITY].into_iter().collect();
    assert_eq!((odd.count(), odd.not_finite(), odd.mean()), (1, 3, Some(1.0)));
}

#[test]
fn agrees_with_the_textbook_on_mild_samples() {
    let samples: Vec<f64> = (0..10_000).map(|i| libm::sin(f64::from(i))).collect();
    let estimate: Estimate = samples.iter().copied().collect();
    let mean = samples.iter().sum::<f64>() / 1e4;
    let variance = samples.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / 9999.0;
    assert!((estimate.mean().unwrap() - mean).abs() < 1e-15);
    assert!((estimate.variance().unwrap() / variance - 1.0).abs() < 1e-13);
}

fn any_finite() -> impl Strategy<Value = f64> {
    prop_oneof![
        -1.0f64..1.0,
        any::<f64>().prop_filter("finite", |x| x.is_finite()),
        Just(0.0),
        Just(f64::MAX),
        Just(-f64::MAX),
        Just(5e-324),
    ]
}

proptest! {
    #[test]
    fn any_split_and_order_gives_the_same_bits(
        samples in prop::collection::vec(any_finite(), 0..60),
        cuts in prop::collection::vec(0usize..60, 0..6),
        seed in any::<u64>(),
    ) {
        let whole: Estimate = samples.iter().copied().collect();
        // Shuffle by hashed keys, split at the cuts, merge right to left.
        let mut order: Vec<usize> = (0..samples.len()).collect();
        order.sort_by_key(|&i| crate::hash::combine(seed, i as u64));
        let mut cuts: Vec<usize> = cuts.into_iter().map(|cut| cut.min(samples.len())).collect();
        cuts.extend([0, samples.len()]);
        cuts.sort_unstable();
        let mut merged = Estimate::new();
        for pair in cuts.windows(2).rev() {
            let mut part: Estimate = order[pair[0]..pair[1]].iter().map(|&i| samples[i]).collect();
            part.merge(&merged);
            merged = part;
        }
        prop_assert_eq!(&merged, &whole);
        prop_assert_eq!(merged.mean().map(f64::to_bits), whole.mean().map(f64::to_bits));
        prop_assert_eq!(merged.variance().map(f64::to_bits), whole.variance().map(f64::to_bits));
    }

    #[test]
    fn sums_are_rounded_correctly(a in any_finite(), b in any_finite()) {
        // A sum of two is what the processor rounds correctly itself.
        let mut sum = ExactSum::new();
        sum.add(a);
        sum.add(b);
        prop_assert_eq!(sum.value(), a + b);
        let mut product = ExactSum::new();
        product.add_product(a, b);
        prop_assert_eq!(product.value(), a * b);
    }
}
