//! Where outlines come from: paths, notation, nesting.

use std::f64::consts::PI;

use glam::DVec2;
use luch_mesh::outline::shapes::{self, Gear};
use luch_mesh::outline::{FillRule, Outline, OutlineError, nested, notation, signed_area, svg_path};
use proptest::prelude::*;

fn points(text: &str) -> Vec<DVec2> {
    let paths = svg_path(text, 0.001).unwrap_or_else(|error| panic!("{text}: {error}"));
    assert_eq!(paths.len(), 1, "{text}");
    paths[0].points.clone()
}

fn area(text: &str) -> f64 {
    notation::outlines(text, 1e-5).unwrap_or_else(|e| panic!("{text}: {e}")).iter().map(Outline::area).sum()
}

#[test]
fn every_spelling_of_a_path_is_read() {
    let square = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]].map(DVec2::from);
    for text in [
        "M0 0L2 0L2 1L0 1Z",
        "M 0,0 2,0 2,1 0,1 z",
        "m0 0 2 0 0 1-2 0z",
        "M0 0H2V1H0Z",
        "M0 0h2v1h-2z",
        "  M0.0.0 L+2e0-0 2 .1E1,L0,1 0,0 Z ",
    ] {
        assert_eq!(points(text), square, "{text}");
    }
    // Smooth curves mirror the last control point; without a curve before, they begin at the point itself.
    assert_eq!(points("M0 0C0 1 1 1 1 0S2-1 2 0"), points("M0 0C0 1 1 1 1 0C1-1 2-1 2 0"));
    assert_eq!(points("M0 0Q1 2 2 0T4 0"), points("M0 0Q1 2 2 0Q3-2 4 0"));
    assert_eq!(points("M0 0 1 0S2 1 3 0"), points("M0 0 1 0C1 0 2 1 3 0"));
    assert_eq!(points("m1 1c0 1 1 1 1 0s1-1 1 0"), points("M1 1C1 2 2 2 2 1S3 0 3 1"));
    // Flags need no blanks.
    assert_eq!(points("M0 0A1 1 0 0 1 2 0"), points("M0 0a1,1,0,012,0"));
    // After Z the pen is where the stroke began.
    let two = svg_path("M1 1h1v1zl0-1h1z", 0.1).unwrap();
    assert_eq!((two.len(), two[1].points[0], two[1].points[1]), (2, DVec2::ONE, DVec2::X));
    assert!(two.iter().all(|path| path.is_closed));
}

#[test]
fn curves_enclose_what_they_should() {
    let near = |found: f64, truth: f64| assert!((found / truth - 1.0).abs() < 2e-4, "{found} is not {truth}");
    near(area("M-1 0A1 1 0 0 1 1 0A1 1 0 0 1-1 0Z"), PI);
    // The larger part of a circle over a chord as long as the radius, and the smaller.
    let segment = PI / 6.0 - 3f64.sqrt() / 4.0;
    near(area("M0 0A1 1 0 0 0 1 0Z"), segment);
    near(area("M0 0A1 1 0 1 1 1 0Z"), PI - segment);
    // An ellipse, tilted.
    near(area("M2 0A2 1 30 1 1 -2 0A2 1 30 1 1 2 0Z"), area("M-2 0A2 1 30 0 0 2 0A2 1 30 0 0 -2 0Z"));
    // Radii that do not reach are enlarged: half a circle of radius 1.
    near(area("M-1 0A.1 .1 0 0 1 1 0Z"), PI / 2.0);
    // Under a parabola: two thirds of the box of its height. A cubic with control heights h: 3/4 h times its width.
    near(area("M0 0Q1 2 2 0Z"), 2.0 / 3.0 * 2.0);
    near(area("M0 0C0 1 2 1 2 0Z"), 1.2);
}

#[test]
fn mistakes_in_paths_say_where() {
    let message = |text: &str| svg_path(text, 0.1).unwrap_err().to_string();
    assert_eq!(message("L1 1"), "at character 1: found “L”, expected M: a path begins with it");
    assert_eq!(message("M1 1 X2"), "at character 6: found “X”, expected one of M, L, H, V, C, S, Q, T, A, Z");
    assert_eq!(message("M1 1 L2"), "at character 8: the path ends, expected a number");
    assert_eq!(message("M1 1 L2 é"), "at character 9: found “é”, expected a number");
    assert_eq!(message("M1 1 A1 1 0 2 0 3 3"), "at character 13: found “2”, expected 0 or 1");
    assert_eq!(message("M1e999 1"), "at character 2: found “1”, expected a number");
    assert_eq!(message("M1 1 5"), "at character 7: the path ends, expected a number");
    assert!(svg_path("", 0.1).unwrap().is_empty());
    assert!(svg_path("M0 0", f64::NAN).is_err() && svg_path("M0 0", 0.0).is_err());
    let endless = format!("M0 0{}", "h1v1".repeat(1 << 16));
    assert!(matches!(svg_path(&endless, 0.1), Err(OutlineError::TooManyPoints { .. })));
    // Curves that ask for a point every atom get a bounded number.
    assert!(points("M0 0C1e9 0 0 1e9 1 1").len() <= 4097);
}

#[test]
fn nesting_follows_the_rule() {
    let square = |side: f64, turns: bool| {
        let mut points = shapes::rectangle(DVec2::splat(side));
        if turns {
            points.reverse();
        }
        points
    };
    let count = |borders: &[Vec<DVec2>], rule| -> Vec<usize> {
        let outlines = nested(borders, rule).unwrap();
        for outline in &outlines {
            assert!(signed_area(&outline.outer) > 0.0 && outline.holes.iter().all(|h| signed_area(h) < 0.0));
        }
        outlines.iter().map(|outline| outline.holes.len()).collect()
    };
    let [large, middle, small] = [6.0, 4.0, 2.0].map(|side| square(side, false));
    let middle_turned = square(4.0, true);
    let three = [small.clone(), large.clone(), middle.clone()];
    // An island in a hole; all one area; an island again.
    assert_eq!(count(&three, FillRule::EvenOdd), [0, 1]);
    assert_eq!(count(&three, FillRule::NonZero), [0]);
    assert_eq!(count(&[small.clone(), large.clone(), middle_turned.clone()], FillRule::NonZero), [0, 1]);
    // All clockwise is as good as all counter-clockwise.
    assert_eq!(count(&[square(6.0, true), middle.clone()], FillRule::NonZero), [1]);
    assert_eq!(area("rectangle 6; rectangle 4; rectangle 2"), 36.0 - 16.0 + 4.0);
    assert_eq!(area("nonzero; rectangle 6; rectangle 4"), 36.0);
    // Side by side with a common corner and a common edge.
    assert_eq!(area("rectangle 2; rectangle 2 at 2 2; rectangle 2 at 2 0"), 12.0);
    // A hole that touches the border from within.
    assert_eq!(area("rectangle 4; points 0 -2, 1 0, -1 0"), 14.0);
    let crossing = nested(&[large.clone(), shapes::rectangle(DVec2::new(8.0, 1.0))], FillRule::EvenOdd);
    assert!(matches!(crossing, Err(OutlineError::Crossing { place }) if place.abs() == DVec2::new(3.0, 0.5)));
    let bow = [[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.5]].map(DVec2::from);
    assert!(matches!(nested(&[bow.into()], FillRule::EvenOdd), Err(OutlineError::Crossing { .. })));
    // Nothing that has an area.
    for empty in [vec![], vec![vec![]], vec![vec![DVec2::ONE; 9]], vec![vec![DVec2::X, DVec2::Y]]] {
        assert_eq!(nested(&empty, FillRule::EvenOdd), Err(OutlineError::Empty));
    }
    assert!(nested(&[vec![DVec2::NAN; 3]], FillRule::EvenOdd).is_err());
}

#[test]
fn notation_knows_all_forms() {
    let near = |text: &str, truth: f64| {
        let found = area(text);
        assert!((found / truth - 1.0).abs() < 2e-4, "{text}: {found} is not {truth}");
    };
    near("circle 2", 4.0 * PI);
    near("circle 2 6", 6.0 * 3f64.sqrt());
    near("ellipse 2 1 at 5 5", 2.0 * PI);
    near("polygon 4 1", 2.0);
    near("star 2 1 0.5", 1.0);
    near("rectangle 3", 9.0);
    near("rounded-rectangle 3 2 0.5", 6.0 - (4.0 - PI) * 0.25);
    near("rounded-rectangle 2 2 9", PI);
    near("points 0 0, 1 0, 0 1", 0.5);
    near(" M0 0H1V1Z ; circle 0.1 at 0.7,0.3 ", 0.5 - 0.01 * PI);
    let message = |text: &str| notation::outlines(text, 0.1).unwrap_err().to_string();
    assert_eq!(message("circle"), "at character 1: found “circle”, expected circle RADIUS [PIECES]");
    assert_eq!(message("circle 1;  circle x"), "at character 12: circle: found “x”, expected a number");
    assert_eq!(message("circle 1; M0 0 L5"), "at character 18: the path ends, expected a number");
    assert!(message("cirkle 1").contains("expected circle, ellipse"));
    assert_eq!(
        message("rectangle -1"),
        "at character 1: found “rectangle -1”, expected rectangle WIDTH [HEIGHT]"
    );
    assert!(message("circle 1 at 2").contains("expected two"));
    assert!(message("").contains("empty") && message("circle 1;").contains("empty"));
    assert_eq!(notation::line("points 1 2 3 4", 0.1).unwrap(), [[1.0, 2.0], [3.0, 4.0]].map(DVec2::from));
}

#[test]
fn gears_have_teeth_as_wide_as_gaps() {
    for teeth in [4, 5, 9, 17, 40, 200] {
        for degrees in [14.5f64, 20.0, 25.0] {
            let gear = Gear { teeth, module: 0.5, pressure_angle: degrees.to_radians(), pieces: 8 };
            let border = gear.border().unwrap();
            let pitch = 0.25 * f64::from(teeth);
            let distance = |p: &DVec2| p.length() - pitch;
            assert!(border.iter().all(|p| (-0.625 - 1e-9..0.5 + 1e-9).contains(&distance(p))), "{gear:?}");
            assert_eq!(
                nested(std::slice::from_ref(&border), FillRule::NonZero).unwrap().len(),
                1,
                "{gear:?}"
            );
            // Where flanks cross the pitch circle the angles from flank to flank are all alike.
            let crossings: Vec<f64> = (0..border.len())
                .filter_map(|k| {
                    let [a, b] = [border[k], border[(k + 1) % border.len()]];
                    let [from, to] = [distance(&a), distance(&b)];
                    ((from < 0.0) != (to < 0.0)).then(|| a.lerp(b, from / (from - to)))
                })
                .map(|p| libm::atan2(p.y, p.x))
                .collect();
            assert_eq!(crossings.len(), 2 * teeth as usize, "{gear:?}");
            for pair in crossings.windows(2) {
                let step = (pair[1] - pair[0]).rem_euclid(2.0 * PI) * f64::from(teeth) / PI;
                // Chords of a flank in eight pieces lie a little within it.
                assert!((step - 1.0).abs() < 0.01, "{gear:?}: {step}");
            }
        }
    }
    let refused = |gear: Gear| assert!(gear.border().is_err(), "{gear:?}");
    refused(Gear { teeth: 3, module: 1.0, pressure_angle: 0.3, pieces: 8 });
    refused(Gear { teeth: u32::MAX, module: 1.0, pressure_angle: 0.3, pieces: 8 });
    refused(Gear { teeth: 20, module: 1.0, pressure_angle: f64::NAN, pieces: 8 });
    refused(Gear { teeth: 6, module: 1.0, pressure_angle: 0.69, pieces: 8 });
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 256, ..ProptestConfig::default() })]

    #[test]
    fn any_text_is_read_or_refused(text in "[MmLlHhVvCcSsQqTtAaZz0-9eE .,+-]{0,60}") {
        if let Ok(paths) = svg_path(&text, 0.01) {
            prop_assert!(paths.iter().all(|path| path.points.len() > 1));
            let borders: Vec<_> = paths.into_iter().map(|path| path.points).collect();
            let _ = nested(&borders, FillRule::NonZero);
        }
        let _ = notation::outlines(&text, 0.01);
    }

    #[test]
    fn any_notation_is_read_or_refused(text in "(circle|star|gear|points|rectangle|at|;|M|[0-9]{1,3}|[-.é ]){0,20}") {
        let _ = notation::outlines(&text, 0.01);
    }

    /// Crossing edges are found whatever the order: against trying all pairs.
    #[test]
    fn crossings_are_found(points in prop::collection::vec((-8i32..8, -8i32..8), 3..9)) {
        let border: Vec<DVec2> = points.iter().map(|(x, y)| DVec2::new(f64::from(*x), f64::from(*y))).collect();
        let edge = |k: usize| [border[k], border[(k + 1) % border.len()]];
        let side = |[a, b]: [DVec2; 2], p: DVec2| (b - a).perp_dot(p - a);
        let crosses = (0..border.len()).any(|i| (0..i).any(|j| {
            let (one, other) = (edge(i), edge(j));
            side(one, other[0]) * side(one, other[1]) < 0.0 && side(other, one[0]) * side(other, one[1]) < 0.0
        }));
        let found = nested(std::slice::from_ref(&border), FillRule::EvenOdd);
        // Without area there is nothing to look at.
        if found != Err(OutlineError::Empty) {
            prop_assert_eq!(crosses, matches!(found, Err(OutlineError::Crossing { .. })));
        }
    }
}
