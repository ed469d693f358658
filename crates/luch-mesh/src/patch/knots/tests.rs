use super::*;

fn odd_knots() -> Vec<Knots> {
    [
        (1, vec![0.0, 0.0, 1.0, 1.0]),
        (2, vec![0.0, 0.0, 0.0, 0.25, 0.25, 0.75, 1.0, 1.0, 1.0]),
        (3, vec![-1.0, -1.0, -1.0, -1.0, 0.5, 2.0, 2.0, 2.0, 2.5, 3.0, 3.0, 3.0, 3.0]),
        // Not clamped.
        (3, vec![0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0]),
        (5, vec![0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.3, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0]),
    ]
    .map(|(degree, values)| Knots::new(degree, values).unwrap())
    .into()
}

#[test]
fn basis_functions_are_positive_and_sum_to_one() {
    for knots in odd_knots() {
        let domain = knots.domain();
        for i in 0..=100 {
            let basis = knots.basis(domain.at(f64::from(i) / 100.0), 3);
            assert!(basis.first + knots.degree() < knots.point_count());
            assert!(basis.orders[0].iter().all(|&b| b >= 0.0));
            let sums: Vec<f64> = basis.orders.iter().map(|order| order.iter().sum()).collect();
            assert!((sums[0] - 1.0).abs() < 1e-14, "{sums:?}");
            let size = |order: usize| basis.orders[order].iter().map(|b| b.abs()).sum::<f64>();
            assert!((1..4).all(|k| sums[k].abs() <= 1e-13 * size(k)), "{sums:?}");
        }
    }
}

#[test]
fn derivatives_are_those_of_the_functions() {
    for knots in odd_knots() {
        let breaks = knots.breaks();
        for ends in breaks.windows(2) {
            let middle = ends[0].midpoint(ends[1]) + 0.1 * (ends[1] - ends[0]);
            let step = 1e-4 * (ends[1] - ends[0]);
            let at = |t: f64| knots.basis(t, 2);
            let (below, here, above) = (at(middle - step), at(middle), at(middle + step));
            for j in 0..=knots.degree() {
                for k in 0..2 {
                    let difference = (above.orders[k][j] - below.orders[k][j]) / (2.0 * step);
                    // The central difference is off by step²/6 times the third derivative: below 1e-6 of the scale here.
                    let scale = 100.0 / power(ends[1] - ends[0], k + 1);
                    assert!((difference - here.orders[k + 1][j]).abs() < 1e-6 * scale);
                }
            }
        }
    }
}

fn power(base: f64, exponent: usize) -> f64 {
    std::iter::repeat_n(base, exponent).product()
}

#[test]
fn bad_knots_are_refused() {
    let bad: [(usize, Vec<f64>); 8] = [
        (0, vec![0.0, 1.0]),
        (26, vec![0.0; 60]),
        (1, vec![0.0, 0.0, 1.0]),
        (1, vec![0.0, 0.0, 0.0, 0.0]),
        (1, vec![0.0, 1.0, 0.5, 2.0]),
        (2, vec![0.0, 0.0, 0.0, f64::NAN, 1.0, 1.0, 1.0]),
        (2, vec![0.0, 0.0, 0.0, 0.5, 0.5, 0.5, 1.0, 1.0, 1.0]),
        (1, vec![0.0, 0.0, 0.0, 1.0, 1.0]),
    ];
    for (degree, values) in bad {
        assert!(Knots::new(degree, values.clone()).is_err(), "{degree} {values:?}");
    }
    assert!(Knots::clamped(3, 3).is_err());
    assert!(Knots::clamped(usize::MAX, 3).is_err() && Knots::bezier(usize::MAX).is_err());
}
