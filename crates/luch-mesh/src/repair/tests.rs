//! Bodies that are broken in known ways become what they were.

use glam::Vec3;

use super::*;
use crate::generate::{self, Generator};
use crate::measure;

fn polygons(generator: Generator) -> PolygonMesh {
    PolygonMesh::from(&generator.mesh())
}

fn volume(mesh: &PolygonMesh) -> f64 {
    measure::volume(&mesh.triangulate())
}

fn closedness(mesh: &PolygonMesh) -> measure::Closedness {
    measure::closedness(&mesh.triangulate())
}

/// Numbers below `most`, the same each time.
fn numbers(seed: u32, most: usize) -> impl Iterator<Item = usize> {
    let mut state = seed;
    std::iter::repeat_with(move || {
        state = state.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
        (state >> 8) as usize % most
    })
}

#[test]
fn a_good_mesh_is_left_alone() {
    for generator in Generator::examples().into_iter().filter(Generator::is_closed) {
        let mesh = polygons(generator);
        let outcome = repair(&mesh, 0.0);
        assert_eq!(outcome.report, Report::default(), "{generator:?}");
        assert_eq!(outcome.mesh.positions, mesh.positions);
        assert_eq!(outcome.mesh.corners, mesh.corners);
    }
}

/// Every triangle alone, some turned, some twice, a few missing, stray positions: the body comes back.
#[test]
fn a_heap_of_triangles_becomes_a_body_again() {
    for (number, generator) in Generator::examples().into_iter().filter(Generator::is_closed).enumerate() {
        let whole = polygons(generator);
        let mut heap = PolygonMesh::default();
        let missing: Vec<usize> = numbers(number as u32, whole.face_count()).take(1).collect();
        let turned: Vec<usize> =
            numbers(number as u32 + 100, whole.face_count()).take(whole.face_count() / 5).collect();
        for face in 0..whole.face_count() {
            if missing.contains(&face) {
                continue;
            }
            let first = heap.positions.len() as u32;
            let corners = &whole.corners[whole.face(face)];
            heap.positions.extend(corners.iter().map(|&v| whole.positions[v as usize]));
            let is_turned = turned.contains(&face);
            heap.add_face(&if is_turned {
                [first, first + 2, first + 1]
            } else {
                [first, first + 1, first + 2]
            });
            if face % 7 == 0 {
                heap.add_face(&[first, first + 1, first + 2]);
            }
        }
        heap.positions.push(Vec3::splat(50.0));
        heap.add_face(&[0, 0, 1]);
        heap.add_face(&[0, 1, 1_000_000]);
        let outcome = repair(&heap, 0.0);
        let report = closedness(&outcome.mesh);
        assert!(report.is_closed() && report.pinched == 0, "{generator:?}: {report} {}", outcome.report);
        assert_eq!(report.euler_characteristic, generator.euler_characteristic(), "{generator:?}");
        assert!((volume(&outcome.mesh) - volume(&whole)).abs() < 1e-5, "{generator:?}");
        assert_eq!(outcome.report.filled_holes, 1);
        assert_eq!(outcome.mesh.face_count(), whole.face_count(), "{generator:?}");
    }
}

#[test]
fn a_lid_of_least_area_is_flat() {
    // An open cylinder: both rims are filled, area and volume are those of the closed one.
    let open = PolygonMesh::from(&generate::cylinder(1.0, 2.0, 24, 1, false));
    let closed = PolygonMesh::from(&generate::cylinder(1.0, 2.0, 24, 1, true));
    for filling in [Filling::LeastArea, Filling::Polygon, Filling::Fan] {
        let filled = fill_holes(&open, filling, 100);
        assert_eq!(filled.count, 2);
        assert!(closedness(&filled.mesh).is_closed(), "{filling:?}");
        assert!((volume(&filled.mesh) - volume(&closed)).abs() < 1e-5, "{filling:?}");
        let area = |mesh: &PolygonMesh| measure::area(&mesh.triangulate());
        assert!((area(&filled.mesh) - area(&closed)).abs() < 1e-5, "{filling:?}");
    }
    assert_eq!(fill_holes(&open, Filling::LeastArea, 23).count, 0);
}

#[test]
fn holes_of_a_sphere_are_filled_whatever_is_missing() {
    let whole = PolygonMesh::from(&generate::sphere(1.0, 16, 10));
    for seed in 0..40 {
        let missing: Vec<usize> = numbers(seed, whole.face_count()).take(1 + seed as usize).collect();
        let kept: Vec<u32> =
            (0..whole.face_count() as u32).filter(|&f| !missing.contains(&(f as usize))).collect();
        let outcome = repair(&faces::with_faces(&whole, &kept), 0.0);
        let report = closedness(&outcome.mesh);
        assert!(report.is_closed() && report.pinched == 0, "{seed}: {report}");
    }
}

#[test]
fn turned_faces_are_turned_back_and_cavities_stay() {
    let outer = generate::cuboid(Vec3::splat(4.0), [1; 3]);
    let inner = generate::icosphere(1.0, 1);
    let mut mesh = PolygonMesh::from(&outer);
    let first = mesh.positions.len() as u32;
    mesh.normals = Default::default();
    mesh.uv_sets.clear();
    mesh.positions.extend(&inner.positions);
    for triangle in &inner.triangles {
        // Outward as well: wrong for a cavity.
        mesh.add_face(&triangle.map(|v| v + first));
    }
    let expected = 64.0 - measure::volume(&inner);
    for seed in 0..5 {
        let mut broken = mesh.clone();
        let turned: Vec<usize> = numbers(seed, mesh.face_count()).take(30).collect();
        let turned: Vec<bool> = (0..mesh.face_count()).map(|face| turned.contains(&face)).collect();
        faces::flip_faces(&mut broken, &turned);
        let oriented = orient(&broken).mesh;
        assert!(closedness(&oriented).is_closed());
        assert!((volume(&oriented) - expected).abs() < 1e-4, "{}", volume(&oriented));
    }
}

#[test]
fn turned_faces_take_their_normals_along() {
    let mut mesh = PolygonMesh::from(&generate::cuboid(Vec3::ONE, [1; 3]));
    let whole = mesh.clone();
    faces::flip_faces(
        &mut mesh,
        &[true, false, true, true, false, false, false, false, false, false, false, false],
    );
    let back = orient(&mesh);
    assert_eq!(back.count, 3);
    let triangles = back.mesh.triangulate();
    for t in 0..12 {
        assert_eq!(triangles.corners(t), whole.triangulate().corners(t));
        let facet = triangles.area_normal(t).normalize();
        assert!(triangles.corner_normals(t).unwrap().iter().all(|n| n.dot(facet) > 0.99));
    }
}

#[test]
fn two_cubes_at_an_edge_are_parted_and_stay_closed() {
    let cube = generate::cuboid(Vec3::ONE, [1; 3]);
    let mut mesh = PolygonMesh { positions: cube.positions.clone(), ..PolygonMesh::default() };
    mesh.positions.extend(cube.positions.iter().map(|p| *p + Vec3::new(1.0, 1.0, 0.0)));
    for triangle in &cube.triangles {
        mesh.add_face(triangle);
    }
    for triangle in &cube.triangles {
        mesh.add_face(&triangle.map(|v| v + 8));
    }
    let touching = merge(&mesh, 0.0);
    assert_eq!(touching.count, 2);
    assert!(closedness(&touching.mesh).non_manifold.is_some());
    let parted = make_manifold(&touching.mesh);
    let report = closedness(&parted.mesh);
    assert!(report.is_closed() && report.pinched == 0 && report.components == 2, "{report}");
    assert_eq!(parted.count, 2);
    // At a single vertex too.
    let mut mesh = mesh.clone();
    mesh.positions[8..].iter_mut().for_each(|p| p.z += 1.0);
    let touching = merge(&mesh, 0.0);
    assert_eq!(closedness(&touching.mesh).pinched, 1);
    assert_eq!(closedness(&make_manifold(&touching.mesh).mesh).pinched, 0);
}

#[test]
fn the_largest_piece_stays() {
    let mut mesh = PolygonMesh::from(&generate::sphere(1.0, 12, 8));
    mesh.uv_sets.clear();
    mesh.normals = Default::default();
    let small = generate::cuboid(Vec3::splat(0.3), [1; 3]);
    let first = mesh.positions.len() as u32;
    mesh.positions.extend(small.positions.iter().map(|p| *p + Vec3::X * 5.0));
    for triangle in &small.triangles {
        mesh.add_face(&triangle.map(|v| v + first));
    }
    let largest = keep_largest(&mesh);
    assert_eq!(largest.count, 1);
    assert_eq!(largest.mesh.face_count(), mesh.face_count() - 12);
    assert_eq!(remove_unused(&largest.mesh).count, 8);
}

#[test]
fn sound_faces_are_sound() {
    let mut mesh = PolygonMesh {
        positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::ONE, Vec3::NAN],
        ..Default::default()
    };
    for face in
        [&[0u32, 1, 2][..], &[0, 0, 1, 1, 2, 2, 0], &[0, 1], &[0, 1, 4], &[0, 1, 9], &[], &[0, 1, 3, 1, 2]]
    {
        mesh.add_face(face);
    }
    let result = sound(&mesh);
    assert_eq!(result.mesh.validate_faces(), Ok(()));
    assert_eq!(result.dropped_faces, 4);
    assert!(result.faces.iter().take(2).eq(&[0, 1]));
}

impl PolygonMesh {
    fn validate_faces(&self) -> Result<(), String> {
        for face in 0..self.face_count() {
            let mut corners = self.corners[self.face(face)].to_vec();
            let count = corners.len();
            corners.sort_unstable();
            corners.dedup();
            let finite = corners.iter().all(|&v| self.positions[v as usize].is_finite());
            if corners.len() != count || count < 3 || !finite {
                return Err(format!("face {face}"));
            }
        }
        Ok(())
    }
}
