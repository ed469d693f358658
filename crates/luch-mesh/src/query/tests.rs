use std::f64::consts::PI;

use glam::{Affine3A, DVec3};
use luch_bvh::{BruteForce, Ray, TriangleTest};
use proptest::prelude::*;

use super::*;
use crate::generate::{self, Generator};
use crate::scatter;

/// Points in the box of twice the bounds.
fn points_about(mesh: &TriangleMesh, count: u32) -> Vec<Vec3> {
    let bounds = mesh.bounds();
    let (middle, half) = (bounds.centroid(), bounds.max - bounds.min + Vec3::splat(0.1));
    let at = |i| {
        Vec3::from_array(std::array::from_fn(|axis| {
            luch_sampling::sequence::halton::point(i)[axis] as f32 * 2.0 - 1.0
        }))
    };
    (1..=count).map(|i| middle + half * at(i)).collect()
}

#[test]
fn nearest_points_are_those_of_the_plain_loop() {
    for generator in Generator::examples() {
        let mesh = generator.mesh();
        let surface = Surface::new(&mesh);
        let points = points_about(&mesh, 60);
        for (point, found) in points.iter().zip(surface.nearest_of_all(&points)) {
            let mut best: Option<Nearest> = None;
            for t in 0..mesh.triangles.len() {
                let corners = mesh.corners(t).map(|corner| corner.as_dvec3());
                let weights = nearest::nearest_weights(corners, point.as_dvec3());
                let on = corners[0] * weights[0] + corners[1] * weights[1] + corners[2] * weights[2];
                let squared = on.distance_squared(point.as_dvec3());
                if best.is_none_or(|best| squared.sqrt() < best.distance) {
                    best = Some(Nearest { point: on, distance: squared.sqrt(), triangle: t as u32, weights });
                }
            }
            assert_eq!(found.map(|n| n.distance), best.map(|n| n.distance), "{generator:?}");
            assert_eq!(surface.nearest_within(*point, found.unwrap().distance * 0.99), None);
        }
    }
}

#[test]
fn distances_to_true_shapes_within_the_tessellation() {
    // The mesh of a ball lies between the ball and the sphere of its faces' middles.
    let ball = generate::icosphere(1.0, 4);
    let sag = (0..ball.triangles.len())
        .map(|t| 1.0 - ball.corners(t).iter().sum::<Vec3>().length() / 3.0)
        .fold(0.0, f32::max);
    let surface = Surface::new(&ball);
    for point in points_about(&ball, 300) {
        let exact = point.as_dvec3().length() - 1.0;
        let found = surface.signed_distance(point).unwrap();
        assert!(
            found >= exact - 1e-6 && found <= exact + f64::from(sag) * 1.01 + 1e-6,
            "{point}: {found} for {exact}"
        );
    }
    // A box is its mesh.
    let size = DVec3::new(1.0, 2.0, 3.0);
    let cuboid = generate::cuboid(size.as_vec3(), [2, 3, 1]);
    let surface = Surface::new(&cuboid);
    for point in points_about(&cuboid, 300) {
        let beyond = point.as_dvec3().abs() - size / 2.0;
        let exact = beyond.max(DVec3::ZERO).length() + beyond.max_element().min(0.0);
        let found = surface.signed_distance(point).unwrap();
        assert!((found - exact).abs() < 1e-12, "{point}: {found} for {exact}");
    }
    let torus = generate::torus(2.0, 0.5, 256, 128);
    let surface = Surface::new(&torus);
    for point in points_about(&torus, 200) {
        let p = point.as_dvec3();
        let exact = libm::hypot(libm::hypot(p.x, p.z) - 2.0, p.y) - 0.5;
        // Sagittas of both circles.
        let sag = 2.5 * (1.0 - libm::cos(PI / 256.0)) + 0.5 * (1.0 - libm::cos(PI / 128.0));
        let found = surface.signed_distance(point).unwrap();
        assert!((found - exact).abs() <= sag + 1e-6, "{point}: {found} for {exact}");
    }
}

#[test]
fn inside_by_all_three_means() {
    let mut upward = generate::torus(2.0, 0.75, 48, 24);
    upward.transform(&Affine3A::from_rotation_x(0.3));
    let surface = Surface::new(&upward);
    let points = points_about(&upward, 500);
    let winding = winding_numbers(&upward, &points);
    let rays: Vec<Ray> = points.iter().map(|&p| Ray::new(p, Vec3::new(0.31, 0.57, 0.76))).collect();
    let hits = Rays::new(&upward).all_hits(&rays);
    for (i, is_inside) in surface.is_inside_of_all(&points).into_iter().enumerate() {
        assert_eq!(is_inside, winding[i] > 0.5);
        assert_eq!(is_inside, hits[i].len() % 2 == 1);
        assert!((winding[i] - f64::from(u8::from(is_inside))).abs() < 0.02, "{}", winding[i]);
    }
}

#[test]
fn open_meshes_know_their_inside_by_winding() {
    let mut pot = generate::sphere(1.0, 32, 16);
    let lid = pot.triangles.len() / 10;
    pot.triangles.truncate(pot.triangles.len() - lid);
    pot.normals = Default::default();
    pot.uv_sets.clear();
    let surface = Surface::new(&pot);
    assert!(surface.is_inside(Vec3::ZERO) && surface.signed_distance(Vec3::ZERO).unwrap() < 0.0);
    assert!(!surface.is_inside(Vec3::Y * 1.5) && !surface.is_inside(Vec3::NEG_Y * 1.5));
}

#[test]
fn rays_hit_what_the_plain_loop_hits() {
    let mesh = generate::torus(2.0, 0.5, 16, 8);
    let points = points_about(&mesh, 400);
    let rays: Vec<Ray> = points.windows(2).map(|pair| Ray::new(pair[0], pair[1] - pair[0])).collect();
    let plain = BruteForce::new(&mesh.positions, &mesh.triangles, TriangleTest::Watertight);
    let prepared = Rays::new(&mesh);
    let (first, all, met) = (prepared.first_hits(&rays), prepared.all_hits(&rays), prepared.is_met(&rays));
    for (i, ray) in rays.iter().enumerate() {
        assert_eq!(first[i], plain.nearest(ray));
        assert_eq!(met[i], first[i].is_some());
        assert_eq!(all[i].first().copied(), first[i]);
        assert_eq!(all[i].len(), plain.hits(ray, false).count());
    }
    assert!(met.iter().any(|met| *met) && met.iter().any(|met| !*met));
}

#[test]
fn hausdorff_of_shifted_and_refined_meshes() {
    // A sheet lifted by a quarter is a quarter away, everywhere.
    let sheet = generate::plane(glam::Vec2::new(2.0, 3.0), [3, 4]);
    let mut lifted = sheet.clone();
    lifted.transform(&Affine3A::from_translation(Vec3::Y * 0.25));
    for side in hausdorff(&sheet, &lifted, &Default::default()).unwrap() {
        let figures = [side.greatest, side.upper_bound, side.mean, side.root_mean_square];
        assert!(figures.iter().all(|figure| (figure - 0.25).abs() < 1e-9), "{side:?}");
    }
    // Moved along itself by a quarter, the far edge is a quarter off.
    let mut moved = sheet.clone();
    moved.transform(&Affine3A::from_translation(Vec3::X * 0.25));
    let side = hausdorff(&sheet, &moved, &Default::default()).unwrap()[0];
    assert!(
        (side.greatest - 0.25).abs() < 1e-9 && side.upper_bound < 0.25 + 1e-3 && side.mean < 0.02,
        "{side:?}"
    );
    // The farthest point may lie inside a face: a cube's face against a ball around it.
    let cube = generate::cuboid(Vec3::splat(2.0), [1, 1, 1]);
    let ball = generate::icosphere(2.0, 5);
    let side = hausdorff(&cube, &ball, &Default::default()).unwrap()[0];
    assert!((side.greatest - 1.0).abs() < 5e-3 && side.upper_bound - side.greatest < 1e-3, "{side:?}");
    // The exact one lies between the bounds.
    let samples = scatter::uniform(&cube, 2000, 1);
    let surface = Surface::new(&ball);
    assert!(samples.iter().all(|s| surface.nearest(s.position).unwrap().distance <= side.upper_bound));
    assert!(hausdorff(&cube, &TriangleMesh::default(), &Default::default()).is_none());
}

proptest! {
    #[test]
    fn any_triangles_whatever(
        numbers in prop::collection::vec(prop_oneof![-2.0f32..2.0, Just(0.0), Just(f32::NAN), Just(3e38), Just(-1e-40)], 0..60),
        indices in prop::collection::vec(prop::array::uniform3(0u32..22), 0..20),
    ) {
        let positions: Vec<Vec3> = numbers.chunks_exact(3).map(Vec3::from_slice).collect();
        let mesh = TriangleMesh::new(positions, indices);
        let surface = Surface::new(&mesh);
        for point in [Vec3::ZERO, Vec3::splat(0.7), Vec3::NAN, Vec3::splat(3e38)] {
            let found = surface.signed_distance(point);
            prop_assert_eq!(found.map(f64::abs), surface.nearest(point).map(|nearest| nearest.distance));
            surface.is_inside(point);
        }
        let options = DeviationOptions { samples: 10, most_pieces: 2000, ..Default::default() };
        if let Some(side) = deviation(&mesh, &surface, &options) {
            prop_assert!(side.greatest <= side.upper_bound);
        }
    }
}
