//! Noise: bounds, smoothness, and bits that stay.

use crate::samples::tape;

#[test]
fn noise_is_bounded_zero_at_whole_points_and_even() {
    let tape = tape("noise(x, y, z)");
    let (mut least, mut greatest, mut sum, mut squares) = (0.0_f64, 0.0_f64, 0.0, 0.0);
    let count = 200_000;
    let mut steepest = 0.0_f64;
    for i in 0..count {
        let point = [0.819_172_513, 0.671_043_607, 0.549_700_478]
            .map(|step| 64.0 * (f64::from(i) * step).fract() - 32.0);
        let mut gradient = [0.0; 3];
        let value = tape.gradient(&point, &mut gradient);
        least = least.min(value);
        greatest = greatest.max(value);
        steepest = gradient.iter().fold(steepest, |most, slope| most.max(slope.abs()));
        sum += value;
        squares += value * value;
    }
    assert!(least > -1.0 && greatest < 1.0 && least < -0.7 && greatest > 0.7, "{least} {greatest}");
    // The bound of the slope that ranges rest on.
    assert!(steepest < 6.625, "{steepest}");
    let mean = sum / f64::from(count);
    let deviation = (squares / f64::from(count)).sqrt();
    assert!(mean.abs() < 0.01, "{mean}");
    assert!((0.2..0.4).contains(&deviation), "{deviation}");
    for corner in 0..64 {
        let point = [corner & 3, corner >> 2 & 3, corner >> 4].map(|coordinate| f64::from(coordinate) - 2.0);
        assert_eq!(tape.value(&point), 0.0);
    }
}

#[test]
fn noise_has_two_continuous_derivatives_across_cells() {
    let tape = tape("noise(x, y, z)");
    for cell in -3..4 {
        let x = f64::from(cell);
        let slope = |x: f64| {
            let mut gradient = [0.0; 3];
            tape.gradient(&[x, 0.37, 0.61], &mut gradient);
            gradient[0]
        };
        let step = 1e-6;
        assert!((slope(x - step) - slope(x + step)).abs() < 1e-4);
        let (before, after) = ((slope(x) - slope(x - step)) / step, (slope(x + step) - slope(x)) / step);
        // The third derivative is at most some hundred; rounding ε/h.
        assert!((before - after).abs() < 2e-3, "{before} {after}");
    }
}

#[test]
fn curvature_stays_below_the_bound_of_ranges() {
    let tape = tape("noise(x, y, z)");
    let step = 1e-5;
    for i in 0..20_000 {
        let point =
            [0.819_172_513, 0.671_043_607, 0.549_700_478].map(|ratio| 16.0 * (f64::from(i) * ratio).fract());
        let (mut here, mut there) = ([0.0; 3], [0.0; 3]);
        for axis in 0..3 {
            let mut moved = point;
            moved[axis] += step;
            tape.gradient(&point, &mut here);
            tape.gradient(&moved, &mut there);
            for (here, there) in here.iter().zip(there) {
                assert!(((there - here) / step).abs() < 28.7);
            }
        }
    }
}

#[test]
fn the_bits_of_noise_stay() {
    // Digest of 1000 values, so that no change goes unseen: surfaces made with noise would change with it.
    let tape = tape("noise(x, y, z) + fbm(x, y, z, 5)");
    let digest = (0..1000).fold(0_u64, |digest, i| {
        let point = [0.1, 0.37, -0.73].map(|step| f64::from(i) * step);
        digest.rotate_left(5) ^ tape.value(&point).to_bits()
    });
    assert_eq!(digest, 0x17d3_fa68_26e4_4be7, "{digest:#x}");
}

#[test]
fn far_and_odd_places_are_answered() {
    let tape = tape("noise(x, y, z)");
    for far in [1e9, -1e15, 1e300] {
        let value = tape.value(&[far + 0.5, 0.5, 0.5]);
        assert!((-1.0..=1.0).contains(&value), "{far}: {value}");
    }
    // After 2³² it repeats.
    let period = 4_294_967_296.0;
    assert_eq!(tape.value(&[0.25, 0.5, 0.75]), tape.value(&[0.25 + period, 0.5 - period, 0.75]));
    assert!(tape.value(&[f64::NAN, 0.0, 0.0]).is_nan() && tape.value(&[0.5, f64::INFINITY, 0.5]).is_nan());
}
