//! Counts, errors, topology and seams are kept.

use glam::Vec3;

use super::*;
use crate::{Generator, generate, measure};

fn to(triangles: usize) -> Settings {
    Settings { triangles, ..Settings::default() }
}

#[test]
fn the_count_is_reached_and_topology_stays() {
    // Equal places are one here; the teapot has one twice, where its handle touches the body.
    for generator in Generator::examples().into_iter().filter(|g| !matches!(g, Generator::Teapot { .. })) {
        let mesh = generator.refined(3).mesh();
        let goal = mesh.triangles.len() / 4;
        let simple = simplify(&mesh, &to(goal)).mesh;
        assert_eq!(simple.validate(), [], "{generator:?}");
        let report = measure::closedness(&simple);
        assert_eq!(report.is_closed(), generator.is_closed(), "{generator:?}: {report}");
        assert_eq!(report.euler_characteristic, generator.euler_characteristic(), "{generator:?}: {report}");
        assert_eq!((report.pinched, report.duplicates), (0, 0), "{generator:?}");
        // Coarse bodies and those of hard facets have nothing to spare.
        let has_spare = mesh.triangles.len() > 99 && !matches!(generator, Generator::Polyhedron { .. });
        let reached = simple.triangles.len() <= goal + 1 || !has_spare;
        assert!(reached, "{generator:?}: {} of {goal}", simple.triangles.len());
        if generator.is_closed() && mesh.triangles.len() > 400 {
            let ratio = measure::volume(&simple) / measure::volume(&mesh);
            assert!((0.95..1.02).contains(&ratio), "{generator:?}: {ratio}");
        }
    }
}

#[test]
fn what_is_flat_costs_nothing() {
    let mesh = generate::cuboid(Vec3::new(1.0, 2.0, 3.0), [10, 8, 6]);
    let simple = simplify(&mesh, &Settings { error: 1e-5, ..to(12) });
    assert_eq!(simple.mesh.triangles.len(), 12);
    assert_eq!(simple.mesh.positions.len(), 8);
    assert!(simple.error < 1e-5);
    assert!((measure::volume(&simple.mesh) - 6.0).abs() < 1e-5);
    // Hard edges are seams of the normals: they are still there.
    for t in 0..12 {
        let facet = simple.mesh.area_normal(t).normalize();
        assert!(simple.mesh.corner_normals(t).unwrap().iter().all(|n| n.dot(facet) > 0.999));
    }
    let sheet = generate::plane(glam::Vec2::ONE, [20, 20]);
    let simple = simplify(&sheet, &Settings { error: 1e-5, ..to(0) }).mesh;
    assert_eq!(simple.triangles.len(), 2);
    assert!((measure::area(&simple) - 1.0).abs() < 1e-6);
    let uvs = |t| simple.corner_uvs(t, 0).unwrap();
    let area = |[a, b, c]: [glam::Vec2; 3]| (b - a).perp_dot(c - a) / 2.0;
    assert!(((0..2).map(uvs).map(area).sum::<f32>() - 1.0).abs() < 1e-6);
    let kept = simplify(&sheet, &Settings { keeps_borders: true, error: 1e-5, ..to(0) }).mesh;
    assert_eq!(measure::closedness(&kept).boundary.unwrap().count, 80);
}

/// The surface moves no farther than the error says, times what a mean of squares can hide.
#[test]
fn the_error_is_about_the_distance() {
    let ball = generate::icosphere(1.0, 5);
    let mut last = 0.0;
    for triangles in [10_000, 2_000, 400, 80] {
        let simple = simplify(&ball, &to(triangles));
        assert!(simple.error > last);
        last = simple.error;
        let closest = |t: usize| simple.mesh.corners(t).iter().sum::<Vec3>().length() / 3.0;
        let deepest = (0..simple.mesh.triangles.len()).map(closest).fold(1.0, f32::min);
        assert!(
            f64::from(1.0 - deepest) < simple.error * 6.0 + 1e-3,
            "{triangles}: {deepest} {}",
            simple.error
        );
        let bounded = simplify(&ball, &Settings { error: simple.error, ..to(0) });
        assert!(bounded.error <= simple.error);
    }
}

#[test]
fn threads_do_not_matter() {
    let mesh = generate::torus(1.0, 0.4, 80, 50);
    let results = [1, 3].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        pool.install(|| simplify(&mesh, &to(900)))
    });
    assert_eq!(results[0], results[1]);
}

#[test]
fn clusters_are_as_wide_as_asked() {
    let ball = generate::icosphere(1.0, 5);
    for cells in [4, 10, 30] {
        let simple = cluster(&ball, cells);
        assert_eq!(simple.mesh.validate(), []);
        assert!(simple.mesh.triangles.len() < ball.triangles.len());
        // A sphere of n cells across has some n² π of them, each with two triangles.
        let expected = f64::from(cells * cells) * 2.0 * std::f64::consts::PI;
        let ratio = simple.mesh.triangles.len() as f64 / expected;
        assert!((0.5..2.5).contains(&ratio), "{cells}: {ratio}");
        assert!(simple.mesh.positions.iter().all(|p| (p.length() - 1.0).abs() < 1e-6));
    }
}
