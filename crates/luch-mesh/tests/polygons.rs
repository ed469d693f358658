//! Triangulation: the area of the triangles is that of the polygon, whatever its form.

use glam::{Quat, Vec2, Vec3};
use luch_mesh::{PolygonMesh, TriangleMesh, measure};
use proptest::prelude::*;

/// A polygon mesh of one face with holes, its plane turned somewhere else.
fn face(borders: &[Vec<Vec2>], turn: Quat) -> PolygonMesh {
    let mut mesh = PolygonMesh::default();
    let mut loops: Vec<Vec<u32>> = Vec::new();
    for border in borders {
        let first = mesh.positions.len() as u32;
        mesh.positions.extend(border.iter().map(|p| turn * p.extend(0.0) + Vec3::splat(3.0)));
        loops.push((first..mesh.positions.len() as u32).collect());
    }
    let holes: Vec<&[u32]> = loops[1..].iter().map(Vec::as_slice).collect();
    mesh.add_face_with_holes(&loops[0], &holes);
    mesh
}

/// Area by the shoelace formula.
fn shoelace(border: &[Vec2]) -> f64 {
    let next = border.iter().cycle().skip(1);
    border.iter().zip(next).map(|(a, b)| a.as_dvec2().perp_dot(b.as_dvec2())).sum::<f64>() / 2.0
}

/// All triangles face as the polygon does, use every corner and cover it once.
fn check(borders: &[Vec<Vec2>], turn: Quat) {
    let polygon = face(borders, turn);
    let result = polygon.triangulation();
    assert_eq!(result.dropped_faces, 0);
    let mesh = result.mesh;
    let expected = shoelace(&borders[0]) - borders[1..].iter().map(|hole| shoelace(hole).abs()).sum::<f64>();
    let scale = borders[0].iter().map(|p| p.length_squared()).fold(1.0, f32::max);
    let slack = f64::from(scale) * 1e-5;
    let outward = (turn * Vec3::Z).as_dvec3();
    let signed: f64 =
        (0..mesh.triangles.len()).map(|t| mesh.area_normal(t).as_dvec3().dot(outward) / 2.0).sum();
    assert!((signed - expected).abs() < slack, "{signed} instead of {expected}");
    // Signed and unsigned area agree: nothing is covered twice or backward.
    assert!(
        (measure::area(&mesh) - expected).abs() < slack,
        "{} instead of {expected}",
        measure::area(&mesh)
    );
    let corners: usize = borders.iter().map(Vec::len).sum();
    assert_eq!(mesh.triangles.len(), corners + 2 * (borders.len() - 1) - 2);
    let mut used: Vec<u32> = mesh.triangles.concat();
    used.sort_unstable();
    used.dedup();
    assert_eq!(used.len(), corners);
    // The border of the triangles is the border of the polygon.
    assert_eq!(measure::closedness(&mesh).boundary.unwrap().count, corners);
}

fn points(list: &[[f32; 2]]) -> Vec<Vec2> {
    list.iter().map(|p| Vec2::from(*p)).collect()
}

#[test]
fn known_shapes() {
    let square = points(&[[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]]);
    let arrow = points(&[[0.0, 0.0], [4.0, 0.0], [1.0, 1.0], [0.0, 4.0]]);
    let comb = points(&[
        [0.0, 0.0],
        [7.0, 0.0],
        [7.0, 3.0],
        [6.0, 1.0],
        [5.0, 3.0],
        [4.0, 1.0],
        [3.0, 3.0],
        [2.0, 1.0],
        [1.0, 3.0],
        [0.0, 1.0],
    ]);
    // Corners on straight borders, as neighbours with finer pieces need them.
    let straight = points(&[
        [0.0, 0.0],
        [1.0, 0.0],
        [2.0, 0.0],
        [4.0, 0.0],
        [4.0, 2.0],
        [4.0, 4.0],
        [2.0, 4.0],
        [0.0, 4.0],
    ]);
    let hexagon = points(&[[2.0, 0.0], [1.0, 1.7], [-1.0, 1.7], [-2.0, 0.0], [-1.0, -1.7], [1.0, -1.7]]);
    for shape in [square, arrow, comb, straight, hexagon] {
        for first in 0..shape.len() {
            let mut turned = shape.clone();
            turned.rotate_left(first);
            check(&[turned], Quat::from_rotation_y(0.3 * first as f32));
        }
    }
}

#[test]
fn holes_in_either_direction() {
    let outer = points(&[[0.0, 0.0], [9.0, 0.0], [9.0, 5.0], [0.0, 5.0]]);
    let hole = points(&[[1.0, 1.0], [3.0, 1.0], [3.0, 3.0], [2.0, 3.0], [1.0, 3.0]]);
    let mut reversed: Vec<Vec2> = hole.iter().map(|p| *p + Vec2::X * 4.0).collect();
    reversed.reverse();
    check(&[outer, hole, reversed], Quat::from_rotation_x(1.0));
}

proptest! {
    /// Star-shaped polygons: a random radius at each of n rising angles.
    #[test]
    fn stars_of_any_form(radii in prop::collection::vec(0.2f32..5.0, 4..60), turn in 0.0f32..6.0) {
        let count = radii.len() as f32;
        let star: Vec<Vec2> = radii
            .iter()
            .enumerate()
            .map(|(i, r)| {
                let (sin, cos) = libm::sincosf(i as f32 / count * std::f32::consts::TAU);
                Vec2::new(cos, sin) * *r
            })
            .collect();
        let tilt = Quat::from_axis_angle(Vec3::new(0.6, 0.8, 0.0), turn);
        check(std::slice::from_ref(&star), tilt);
        // With a small hole around the middle.
        let hole: Vec<Vec2> = (0..5).map(|i| {
            let (sin, cos) = libm::sincosf(i as f32 * 1.25);
            Vec2::new(cos, sin) * 0.05
        }).collect();
        check(&[star, hole], tilt);
    }

    /// Whatever the indices and numbers: no panic, no index out of range, the same twice.
    #[test]
    fn nonsense_does_no_harm(
        numbers in prop::collection::vec(prop_oneof![Just(0.0f32), Just(1.0), Just(f32::NAN), Just(f32::MAX), -2.0f32..2.0], 0..36),
        faces in prop::collection::vec(prop::collection::vec(0u32..14, 0..9), 0..6),
        hole_at in 0u32..40,
    ) {
        let mut mesh = PolygonMesh { positions: numbers.chunks_exact(3).map(Vec3::from_slice).collect(), ..Default::default() };
        for face in &faces {
            mesh.add_face(face);
        }
        mesh.holes.push(luch_mesh::polygon_mesh::Hole { face: hole_at % 7, start: hole_at });
        let result = mesh.triangulation();
        prop_assert!(result.mesh.triangles.iter().flatten().all(|&i| (i as usize) < mesh.positions.len()));
        prop_assert_eq!(result.faces.len(), result.mesh.triangles.len());
    }
}

#[test]
fn a_closed_mesh_of_quads_stays_closed() {
    let mut mesh = PolygonMesh::default();
    let corner = |i: u32| Vec3::new((i & 1) as f32, (i >> 1 & 1) as f32, (i >> 2) as f32);
    mesh.positions = (0..8).map(corner).collect();
    for face in [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]] {
        mesh.add_face(&face);
    }
    let triangles = mesh.triangulate();
    assert!(measure::closedness(&triangles).is_closed());
    assert_eq!((measure::volume(&triangles), measure::area(&triangles)), (1.0, 6.0));
}

#[test]
fn a_face_that_is_not_flat_keeps_all_its_corners() {
    // Seen along its normal the last corner lies on the edge before it.
    let mut mesh = PolygonMesh {
        positions: [[-5, 0, 5], [5, 0, 5], [5, 0, -5], [-5, 0, -5], [0, 5, -5]]
            .map(|p| Vec3::from(p.map(|x| x as f32)))
            .to_vec(),
        ..Default::default()
    };
    mesh.add_face(&[0, 1, 2, 3, 4]);
    let triangles = mesh.triangulate();
    let report = measure::closedness(&triangles);
    assert_eq!(
        (triangles.triangles.len(), report.boundary.unwrap().count, report.non_manifold),
        (3, 5, None)
    );
}

#[test]
fn degenerate_faces_are_counted() {
    let mut mesh = PolygonMesh {
        positions: vec![Vec3::ZERO, Vec3::X, Vec3::X * 2.0, Vec3::X * 3.0],
        ..Default::default()
    };
    mesh.add_face(&[0, 1, 2, 3]);
    mesh.add_face(&[0, 1, 1, 0]);
    mesh.add_face(&[0, 0, 1]);
    mesh.add_face(&[0, 1]);
    mesh.add_face(&[0, 1, 99]);
    assert_eq!(mesh.triangulation().dropped_faces, 5);
}

#[test]
fn triangles_become_polygons_and_triangles_again() {
    for generator in luch_mesh::Generator::examples() {
        let mut mesh = generator.mesh();
        mesh.slots = (0..mesh.triangles.len()).map(|t| t as u16 % 3).collect();
        let again: TriangleMesh = PolygonMesh::from(&mesh).triangulate();
        assert_eq!(mesh, again, "{generator:?}");
    }
}

#[test]
fn an_enormous_concave_face_is_cut_at_once_and_counted() {
    let mut mesh = PolygonMesh::default();
    let count = 40_000;
    mesh.positions =
        (0..count).map(|i| Vec3::new(i as f32, (i % 7) as f32 * (count - i) as f32, 0.0)).collect();
    mesh.add_face(&(0..count as u32).collect::<Vec<_>>());
    let result = mesh.triangulation();
    assert_eq!((result.fanned_faces, result.mesh.triangles.len()), (1, count - 2));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    /// Faces that cross and touch themselves, with many corners on a line: no more triangles than the face has room
    /// for, and no panic whatever the ends of the faces say.
    #[test]
    fn faces_that_cross_themselves_do_no_harm(
        places in prop::collection::vec((0u8..5, 0u8..3), 4..40),
        ends in prop::collection::vec(0u32..50, 0..4),
    ) {
        let mut mesh = PolygonMesh {
            positions: places.iter().map(|&(x, y)| Vec3::new(f32::from(x), f32::from(y), 0.0)).collect(),
            ..Default::default()
        };
        let count = mesh.positions.len();
        mesh.add_face(&(0..count as u32).collect::<Vec<_>>());
        let triangles = mesh.triangulate();
        prop_assert!(triangles.triangles.len() <= 2 * count);
        // Ends in no order at all.
        mesh.face_ends.extend(ends);
        mesh.triangulation();
    }
}
