//! Volume identities over bodies that cross, touch, contain each other, or share faces.

use glam::{EulerRot, Quat, Vec3};

use super::*;
use crate::{Generator, generate};

fn moved(mesh: &TriangleMesh, turn: Quat, by: Vec3) -> TriangleMesh {
    let mut mesh = mesh.clone();
    mesh.positions.iter_mut().for_each(|p| *p = turn * *p + by);
    mesh.normals.values.iter_mut().for_each(|n| *n = turn * *n);
    mesh
}

/// V(A ∪ B) + V(A ∩ B) = V(A) + V(B), V(A − B) = V(A) − V(A ∩ B), all closed.
fn check(a: &TriangleMesh, b: &TriangleMesh, context: &str) {
    let volume = |operation, one: &TriangleMesh, other: &TriangleMesh| {
        let mesh = boolean(one, other, operation).unwrap_or_else(|error| panic!("{context}: {error}"));
        assert_eq!(mesh.validate(), [], "{context} {operation:?}");
        let report = measure::closedness(&mesh);
        let sound = report.boundary.is_none() && report.inconsistent.is_none();
        assert!(sound, "{context} {operation:?}: {report}");
        measure::volume(&mesh)
    };
    let (of_a, of_b) = (measure::volume(a), measure::volume(b));
    let union = volume(Operation::Union, a, b);
    let common = volume(Operation::Intersection, a, b);
    let rest = volume(Operation::Difference, a, b);
    // Positions are rounded to single precision: an error of area times size times 2⁻²³, with room.
    let most = (measure::area(a) + measure::area(b)) * 4e-7 * 4.0;
    assert!(
        (union + common - of_a - of_b).abs() < most,
        "{context}: {union} + {common} is not {of_a} + {of_b}"
    );
    assert!((of_a - common - rest).abs() < most, "{context}: {of_a} - {common} is not {rest}");
    assert!(common > -most && union > of_a.max(of_b) - most, "{context}");
}

#[test]
fn volumes_add_up_wherever_two_bodies_are() {
    let bodies: Vec<_> =
        Generator::examples().into_iter().filter(Generator::is_closed).map(|g| g.mesh()).collect();
    let mut state = 7u32;
    let mut number = || {
        state = state.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
        (state >> 8) as f32 / (1 << 24) as f32
    };
    for round in 0..40 {
        let one = &bodies[round % bodies.len()];
        let other = &bodies[(round * 3 + 1) % bodies.len()];
        let turn = Quat::from_euler(EulerRot::XYZ, number() * 6.0, number() * 6.0, number() * 6.0);
        let by = Vec3::new(number(), number(), number()) * 2.0 - Vec3::ONE;
        check(one, &moved(other, turn, by), &format!("round {round}"));
    }
}

#[test]
fn faces_edges_and_corners_may_coincide() {
    let cube = generate::cuboid(Vec3::splat(2.0), [1; 3]);
    for x in [-2.0, -1.0, 0.0, 1.0, 2.0, 3.0] {
        for y in [0.0, 1.0, 2.0] {
            for z in [0.0, 2.0] {
                let by = Vec3::new(x, y, z);
                check(&cube, &moved(&cube, Quat::IDENTITY, by), &format!("cubes {by}"));
            }
        }
    }
    // Exactly: a quarter overlaps.
    let shifted = moved(&cube, Quat::IDENTITY, Vec3::new(1.0, 1.0, 0.0));
    let common = boolean(&cube, &shifted, Operation::Intersection).unwrap();
    assert_eq!(measure::volume(&common), 2.0);
    let nothing = boolean(&cube, &cube, Operation::Difference).unwrap();
    assert!(nothing.triangles.is_empty());
    let same = boolean(&cube, &cube, Operation::Union).unwrap();
    assert_eq!(measure::volume(&same), 8.0);
}

#[test]
fn attributes_come_along() {
    let mut cube = generate::cuboid(Vec3::splat(2.0), [1; 3]);
    cube.slots = vec![3; 12];
    let ball = generate::icosphere(1.2, 3);
    let rest = boolean(&cube, &ball, Operation::Difference).unwrap();
    assert_eq!(rest.validate(), []);
    let mut of_ball = 0;
    for t in 0..rest.triangles.len() {
        let facet = rest.area_normal(t).normalize();
        let normals = rest.corner_normals(t).expect("normals");
        let corners = rest.corners(t);
        if rest.slot(t) == 3 {
            assert!(normals.iter().all(|n| n.dot(facet) > 0.999), "{normals:?} {facet}");
        } else if corners.iter().all(|p| p.length() < 1.201) {
            of_ball += 1;
            // The hollow's normals point to the centre.
            assert!(normals.iter().zip(corners).all(|(n, p)| n.dot(-p.normalize()) > 0.99));
        }
    }
    assert!(of_ball > 100);
}

#[test]
fn what_encloses_nothing_is_refused() {
    let cube = generate::cuboid(Vec3::ONE, [1; 3]);
    let sheet = generate::plane(glam::Vec2::ONE, [2; 2]);
    let error = boolean(&cube, &sheet, Operation::Union).unwrap_err().to_string();
    assert!(error.starts_with("the second mesh encloses no body: open: 8 border edges"), "{error}");
    let mut broken = cube.clone();
    broken.triangles[0][0] = 99;
    assert!(matches!(boolean(&broken, &cube, Operation::Union), Err(BooleanError::Invalid { .. })));
    broken = cube.clone();
    broken.positions[0].x = f32::NAN;
    assert!(matches!(boolean(&broken, &cube, Operation::Union), Err(BooleanError::Invalid { .. })));
    assert!(boolean(&TriangleMesh::default(), &cube, Operation::Union).is_err());
}
