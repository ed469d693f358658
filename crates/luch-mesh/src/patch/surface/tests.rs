use super::*;
use crate::patch::shapes;

#[test]
fn round_bodies_are_exact() {
    let sphere = shapes::sphere(1.5).unwrap();
    let torus = shapes::torus(2.0, 0.5).unwrap();
    for i in 0..=40 {
        for j in 0..=40 {
            let (u, v) = (f64::from(i) / 40.0, f64::from(j) / 40.0);
            let p = sphere.evaluate(u, v).position;
            assert!((p.length() - 1.5).abs() < 1e-12);
            assert!(sphere.normal(u, v).unwrap().distance(p / 1.5) < 1e-9, "{u} {v}");
            let q = torus.evaluate(u, v).position;
            let tube = DVec3::new(q.x, 0.0, q.z).length() - 2.0;
            assert!((tube * tube + q.y * q.y - 0.25).abs() < 1e-12);
        }
    }
}

#[test]
fn derivatives_are_those_of_the_surface() {
    let torus = shapes::torus(2.0, 0.5).unwrap();
    let step = 1e-5;
    for (u, v) in [(0.1, 0.2), (0.33, 0.61), (0.9, 0.4), (0.55, 0.05)] {
        let here = torus.evaluate(u, v);
        let [left, right] = [u - step, u + step].map(|u| torus.evaluate(u, v));
        let [below, above] = [v - step, v + step].map(|v| torus.evaluate(u, v));
        let scale = 2.0 * step;
        // Third derivatives stay below 10⁴ here, times step²/6.
        let near = |difference: DVec3, derivative: DVec3| {
            assert!((difference / scale).distance(derivative) < 1e-5 * (1.0 + derivative.length()));
        };
        near(right.position - left.position, here.du);
        near(above.position - below.position, here.dv);
        near(right.du - left.du, here.duu);
        near(above.du - below.du, here.duv);
        near(above.dv - below.dv, here.dvv);
    }
}

#[test]
fn new_knots_keep_the_surface_and_sides_are_its_borders() {
    let torus = shapes::torus(2.0, 0.5).unwrap();
    let finer = torus.with_knot(Direction::U, 0.3).unwrap().with_knot(Direction::V, 0.6).unwrap();
    assert_eq!(finer.points().count(), 100);
    for k in 0..=20 {
        let t = f64::from(k) / 20.0;
        let there = torus.evaluate(t, 1.0 - t).position;
        assert!(finer.evaluate(t, 1.0 - t).position.distance(there) < 1e-13);
        for (side, [u, v]) in
            [(Side::Bottom, [t, 0.0]), (Side::Right, [1.0, t]), (Side::Top, [t, 1.0]), (Side::Left, [0.0, t])]
        {
            assert!(finer.side(side).position(t).distance(finer.evaluate(u, v).position) < 1e-13);
        }
    }
    assert!(torus.with_knot(Direction::V, 0.5).is_err());
    assert_eq!(torus.transposed().transposed(), torus);
}

#[test]
fn pieces_share_their_sides_bit_for_bit() {
    let torus = shapes::torus(0.7, 0.3).unwrap();
    let pieces = torus.with_knot(Direction::U, 0.3).unwrap().bezier_pieces();
    assert_eq!(pieces.len(), 5 * 4);
    for row in pieces.chunks(5) {
        for pair in row.windows(2) {
            assert_eq!(pair[0].side(Side::Right), pair[1].side(Side::Left));
        }
        assert_eq!(row[4].side(Side::Right), row[0].side(Side::Left));
    }
    for k in 0..15 {
        assert_eq!(pieces[k].side(Side::Top), pieces[k + 5].side(Side::Bottom));
    }
}
