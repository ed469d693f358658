//! Every density integrates to one, and its samples follow it.

use super::*;
use luch_sampling::check::chi_square;

const FORMS: [&str; 9] = [
    "uniform",
    "normal(0.3, 0.2)",
    "truncated(0.3, 0.2)",
    "truncated(9, 1)",
    "exponential(2.5)",
    "power(2)",
    "power(-0.5)",
    "table(1, 0, 3, 2)",
    "0.25*uniform + 0.75*truncated(0.5, 0.1)",
];

#[test]
fn samples_follow_the_density() {
    let domain = Domain::parse("x=-0.5..2").unwrap();
    let side = &domain.sides()[0];
    for form in FORMS {
        let density = Density::parse(form, &domain).unwrap();
        let axis = &density.axes()[0];
        // Cells over a range wide enough for the tails; what lies beyond is one more cell.
        let (low, high, cells) = (-2.0, 4.0, 96);
        let width = (high - low) / f64::from(cells);
        let mut expected: Vec<f64> = (0..cells)
            .map(|cell| {
                // The midpoint rule with many points: the power −1/2 has an integrable end.
                let steps = 4000;
                let at = |i: i32| low + width * (f64::from(cell) + (f64::from(i) + 0.5) / f64::from(steps));
                (0..steps).map(|i| axis.pdf(at(i), side)).sum::<f64>() * width / f64::from(steps)
            })
            .collect();
        let inside: f64 = expected.iter().sum();
        assert!((inside - 1.0).abs() < 4e-3, "{form}: {inside}");
        expected.push((1.0 - inside).max(0.0));
        let count = 40_000u64;
        let mut observed = vec![0; expected.len()];
        for i in 0..count {
            let u = (luch_sampling::hash::word(5, i) >> 11) as f64 / 9_007_199_254_740_992.0;
            let drawn = axis.draw(u, side);
            assert_eq!(drawn.pdf, axis.pdf(drawn.x, side), "{form}");
            let cell = (drawn.x - low) / width;
            let cell = if (0.0..f64::from(cells)).contains(&cell) { cell as usize } else { cells as usize };
            observed[cell] += 1;
        }
        let expected: Vec<f64> =
            expected.iter().map(|e| if *e > 1e-9 { e * count as f64 } else { 0.0 }).collect();
        let observed: Vec<u64> =
            observed.iter().zip(&expected).map(|(o, e)| if *e == 0.0 && *o < 3 { 0 } else { *o }).collect();
        let test = chi_square(&observed, &expected);
        assert!(test.p_value > 1e-4, "{form}: {test:?}");
    }
}

#[test]
fn the_lecture_s_four_numbers() {
    // rho of the unit segment and square is 1, of [0, 5] 0.2, of [0, 2] × [0, 2] 0.25.
    for (text, expected) in
        [("x=0..1", 1.0), ("x=0..1,y=0..1", 1.0), ("x=0..5", 0.2), ("x=0..2,y=0..2", 0.25)]
    {
        let domain = Domain::parse(text).unwrap();
        let density = Density::uniform(&domain);
        assert_eq!(density.pdf(&vec![0.5; domain.dimensions()], &domain), expected);
    }
}

#[test]
fn errors_name_the_place() {
    let domain = Domain::parse("x=0..1,y=0..inf").unwrap();
    for (text, column, message) in [
        ("gauss(0,1)", 1, "unknown density"),
        ("x=normal(0)", 3, "does not take 1"),
        ("x=normal(0,-1),y=exponential(1)", 1, "must be positive"),
        ("x=uniform", 1, "finite ends"),
        ("z=uniform", 1, "unknown axis"),
        ("x=uniform,x=uniform", 11, "twice"),
        ("y=exponential(1),x=0.1*uniform+0.8*power(1)", 1, "add up to 1"),
        ("x=normal(0,foo)", 12, "unknown name"),
        ("x=normal(0,1", 13, "expected `)`"),
        ("", 1, "unknown density"),
    ] {
        let error = Density::parse(text, &domain).unwrap_err();
        assert!(error.message().contains(message), "{text}: {error}");
        assert_eq!(error.column(), column, "{text}: {error}");
    }
}
