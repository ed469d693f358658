//! Subdivision of only what wants it: closed, on the limit surface, and as fine as it was asked to be.

use glam::{Vec2, Vec3};
use luch_mesh::polygon_mesh::SharpVertex;
use luch_mesh::query::Surface;
use luch_mesh::subdivide::{
    Border, Scheme, Settings, UvRule, crease_all, crease_by_angle, subdivide, subdivide_adaptively,
};
use luch_mesh::{Generator, PolygonMesh, measure};

const SCHEMES: [Scheme; 2] = [Scheme::CatmullClark, Scheme::Loop];

fn settings(scheme: Scheme) -> Settings {
    Settings { scheme, ..Settings::default() }
}

/// Edges are at most this long, and four times as long where x is below 0.
fn shorter_than(length: f32) -> impl Fn(&[Vec3]) -> bool {
    move |corners| {
        let is_far = corners.iter().all(|corner| corner.x < 0.0);
        let most = if is_far { 4.0 * length } else { length };
        corners.iter().zip(corners.iter().cycle().skip(1)).all(|(a, b)| a.distance(*b) <= most)
    }
}

fn cages() -> Vec<PolygonMesh> {
    let cube = Generator::Cuboid { size: Vec3::splat(2.0), divisions: [1; 3] };
    let mut cages: Vec<PolygonMesh> = Generator::examples()
        .into_iter()
        .filter(|generator| generator.is_closed())
        .map(|generator| generator.polygons())
        .filter(|cage| cage.face_count() < 3000)
        .collect();
    for sharpness in [0.5, 2.0, 2.7, f32::INFINITY] {
        let mut creased = cube.polygons();
        crease_by_angle(&mut creased, 1.0, sharpness);
        creased.creases.truncate(5);
        creased.sharp_vertices.push(SharpVertex { vertex: 7, sharpness });
        cages.push(creased);
    }
    cages
}

#[test]
fn what_is_closed_stays_closed() {
    for (place, cage) in cages().iter().enumerate() {
        for scheme in SCHEMES {
            let size = measure::bounding_sphere(&cage.triangulate()).unwrap().radius;
            let mesh = subdivide_adaptively(cage, &settings(scheme), &shorter_than(size / 6.0)).unwrap();
            let triangles = mesh.triangulate();
            assert_eq!(triangles.validate(), [], "{place} {scheme:?}");
            let (before, after) = (measure::closedness(&cage.triangulate()), measure::closedness(&triangles));
            assert_eq!(after.is_closed(), before.is_closed(), "{place} {scheme:?}: {after}");
            assert_eq!(after.euler_characteristic, before.euler_characteristic, "{place} {scheme:?}");
        }
    }
}

/// Faces of one level only are the limit of that level; of several, their vertices lie on the surface.
#[test]
fn vertices_lie_on_the_limit_surface() {
    for scheme in SCHEMES {
        for sharpness in [0.0, 1.5, f32::INFINITY] {
            let mut cage = Generator::Cuboid { size: Vec3::splat(2.0), divisions: [1; 3] }.polygons();
            crease_by_angle(&mut cage, 1.0, sharpness);
            cage.creases.truncate(5);
            let uniform = subdivide(&cage, &Settings { levels: 7, limit: true, ..settings(scheme) }).unwrap();
            let uniform = uniform.triangulate();
            let query = Surface::new(&uniform);
            let mesh = subdivide_adaptively(&cage, &settings(scheme), &shorter_than(0.2)).unwrap();
            let mut middles = 0;
            for vertex in &mesh.positions {
                let distance = query.nearest(*vertex).unwrap().distance;
                // The fine mesh is off by h²κ/8 with h = 2/128; middles of fans by that of coarse faces.
                if distance > 1e-4 {
                    middles += 1;
                    assert!(distance < 0.02, "{scheme:?} {sharpness}: {vertex} {distance}");
                }
            }
            assert!(middles * 4 < mesh.positions.len(), "{scheme:?} {sharpness}: {middles}");
        }
    }
}

#[test]
fn near_faces_are_finer_and_far_ones_fewer() {
    let cage = Generator::Icosphere { radius: 1.0, subdivisions: 1 }.polygons();
    for scheme in SCHEMES {
        let some = subdivide_adaptively(&cage, &settings(scheme), &shorter_than(0.05)).unwrap();
        let fine = |corners: &[Vec3]| {
            corners.iter().zip(corners.iter().cycle().skip(1)).all(|(a, b)| a.distance(*b) <= 0.05)
        };
        let uniform = subdivide_adaptively(&cage, &settings(scheme), &fine).unwrap();
        assert!(
            some.face_count() * 10 < uniform.face_count() * 7,
            "{} {}",
            some.face_count(),
            uniform.face_count()
        );
        for face in 0..some.face_count() {
            let corners: Vec<Vec3> =
                some.face(face).map(|corner| some.positions[some.corners[corner] as usize]).collect();
            assert!(shorter_than(0.0501)(&corners) || corners.len() == 3, "{corners:?}");
        }
        // Nothing wanted is level 0.
        let coarse = subdivide_adaptively(&cage, &settings(scheme), &|_| true).unwrap();
        let limit = subdivide(&cage, &Settings { limit: true, ..settings(scheme) }).unwrap();
        assert_eq!(coarse.triangulate().positions, limit.triangulate().positions);
    }
}

#[test]
fn without_end_it_stops_with_an_error() {
    let cage = Generator::Icosphere { radius: 1.0, subdivisions: 1 }.polygons();
    assert!(subdivide_adaptively(&cage, &settings(Scheme::Loop), &|_| false).is_err());
}

#[test]
fn a_flat_sheet_keeps_its_uvs_and_colours() {
    let mut sheet = Generator::Plane { size: Vec2::splat(2.0), divisions: [3, 3] }.polygons();
    sheet.colors = luch_mesh::polygon_mesh::CornerAttribute::per_position(
        sheet.positions.iter().map(|p| p.extend(1.0)).collect(),
    );
    crease_all(&mut sheet, 0.0);
    let settings = Settings {
        scheme: Scheme::CatmullClark,
        uvs: UvRule::Linear,
        border: Border::CornersFixed,
        ..Settings::default()
    };
    let fine = subdivide_adaptively(&sheet, &settings, &shorter_than(0.1)).unwrap();
    assert!(fine.face_count() > 200);
    let triangles = fine.triangulate();
    assert!((measure::area(&triangles) - 4.0).abs() < 1e-5);
    for t in 0..triangles.triangles.len() {
        assert!(triangles.area_normal(t).normalize().distance(Vec3::Y) < 1e-5);
        assert!(triangles.corner_normals(t).unwrap().iter().all(|n| n.distance(Vec3::Y) < 1e-5));
    }
    // Colours are the places of the cage, blended linearly: those of the sheet's inner, which do not move along it.
    let uvs = triangles.uv_sets.first().expect("uvs stay");
    assert!(uvs.values.iter().all(|uv| uv.min_element() >= -1e-6 && uv.max_element() <= 1.0 + 1e-6));
}
