//! What every generator promises.

use std::f64::consts::PI;

use glam::Vec3;
use luch_mesh::edges::{Edges, half_edge_ends};
use luch_mesh::generate::Solid;
use luch_mesh::{Generator, TriangleMesh, measure};

fn for_each(check: impl Fn(Generator, &TriangleMesh)) {
    for generator in Generator::examples() {
        check(generator, &generator.mesh());
        let finer = generator.refined(2);
        check(finer, &finer.mesh());
    }
}

#[test]
fn indices_are_in_range_and_values_finite() {
    for_each(|generator, mesh| assert_eq!(mesh.validate(), [], "{generator:?}"));
}

#[test]
fn every_position_is_used_and_there_is_only_one_at_a_place() {
    for_each(|generator, mesh| {
        assert_eq!(luch_mesh::clean::remove_unused_positions(mesh).removed, 0, "{generator:?}");
        // The lower end of the teapot's handle touches the body in one point.
        let touching = usize::from(matches!(generator, Generator::Teapot { .. }));
        assert_eq!(luch_mesh::weld::weld_exact(mesh).merged, touching, "{generator:?}");
        assert_eq!(luch_mesh::clean::remove_degenerate(mesh).removed, 0, "{generator:?}");
    });
}

/// Conformity: edges and vertices of neighbours match, each inner edge has two triangles of opposite direction, except
/// where a surface of one side meets itself.
#[test]
fn inner_edges_have_two_triangles_of_opposite_direction() {
    for_each(|generator, mesh| {
        let edges = Edges::new(&mesh.triangles, mesh.positions.len());
        let (mut borders, mut turned) = (0, 0);
        for edge in edges.iter(&mesh.triangles) {
            let starts: Vec<u32> =
                edge.half_edges.iter().map(|&h| half_edge_ends(&mesh.triangles, h)[0]).collect();
            match *starts {
                [_] => borders += 1,
                [one, other] => turned += usize::from(one == other),
                _ => panic!("{generator:?}: {} triangles at {:?}", starts.len(), edge.vertices),
            }
        }
        assert_eq!(borders > 0, generator.has_border(), "{generator:?}");
        // One seam across.
        let expected = match generator {
            _ if generator.is_orientable() => 0,
            Generator::Moebius { stacks, .. } => stacks as usize,
            Generator::KleinBottle { sides, .. } => sides as usize,
            _ => panic!("{generator:?} has two sides"),
        };
        assert_eq!(turned, expected, "{generator:?}");
    });
}

#[test]
fn polygons_are_what_the_triangles_come_from() {
    for_each(|generator, mesh| {
        let polygons = generator.polygons();
        assert_eq!(polygons.positions, mesh.positions, "{generator:?}");
        let corners = |face: usize| polygons.face(face).len();
        let triangles: usize = (0..polygons.face_count()).map(|face| corners(face) - 2).sum();
        assert_eq!(triangles, mesh.triangles.len(), "{generator:?}");
        // The other way to cut them agrees in number and in measures of what is flat.
        let cut = polygons.triangulation();
        assert_eq!(
            (cut.mesh.triangles.len(), cut.dropped_faces, cut.fanned_faces),
            (triangles, 0, 0),
            "{generator:?}"
        );
        let (least, counted) = (triangles as u64, generator.triangle_count());
        // Roundings without radius are counted, but not made.
        let is_tight = counted <= 2 * least + 200 || matches!(generator, Generator::RoundedCuboid { .. });
        assert!(counted >= least && is_tight, "{generator:?}: {least} of {counted}");
    });
}

#[test]
fn grids_are_of_quads() {
    let sizes = |generator: Generator| {
        let polygons = generator.polygons();
        let mut sizes: Vec<usize> =
            (0..polygons.face_count()).map(|face| polygons.face(face).len()).collect();
        sizes.sort_unstable();
        sizes.dedup();
        (polygons.face_count(), sizes)
    };
    assert_eq!(sizes(Generator::Cuboid { size: Vec3::ONE, divisions: [1; 3] }), (6, vec![4]));
    assert_eq!(sizes(Generator::Plane { size: glam::Vec2::ONE, divisions: [3, 2] }), (6, vec![4]));
    assert_eq!(
        sizes(Generator::RoundedCuboid { size: Vec3::ONE, radius: 0.25, segments: 2 }),
        (150, vec![4])
    );
    assert_eq!(sizes(Generator::Prism { sides: 6, radius: 1.0, height: 1.0 }), (8, vec![4, 6]));
    assert_eq!(
        sizes(Generator::Polyhedron { solid: Solid::TruncatedIcosahedron, radius: 1.0 }),
        (32, vec![5, 6])
    );
    assert_eq!(sizes(Generator::Polyhedron { solid: Solid::Dodecahedron, radius: 1.0 }), (12, vec![5]));
    let torus = Generator::Torus { major_radius: 1.0, minor_radius: 0.5, segments: 6, sides: 5 };
    assert_eq!(sizes(torus), (30, vec![4]));
}

#[test]
fn closedness_and_euler_characteristic_are_as_declared() {
    for_each(|generator, mesh| {
        let report = measure::closedness(mesh);
        assert_eq!(report.is_closed(), generator.is_closed(), "{generator:?}: {report}");
        assert_eq!(report.euler_characteristic, generator.euler_characteristic(), "{generator:?}");
        let pieces = generator.component_count();
        assert_eq!((report.components, report.pinched, report.duplicates), (pieces, 0, 0), "{generator:?}");
        let genus = report.is_closed().then_some(1 - generator.euler_characteristic() as u64 / 2);
        assert_eq!(report.genus, genus, "{generator:?}");
    });
}

#[test]
fn faces_wind_outward_and_normals_agree() {
    for_each(|generator, mesh| {
        if generator.is_closed() {
            assert!(measure::volume(mesh) > 0.0, "{generator:?}");
        }
        for t in 0..mesh.triangles.len() {
            let facet = mesh.area_normal(t).normalize();
            for normal in mesh.corner_normals(t).unwrap() {
                assert!((normal.length() - 1.0).abs() < 1e-6, "{generator:?}");
                // A corner's true normal lies within a quarter turn of the facet, by far except on coarse shapes.
                assert!(normal.dot(facet) > 0.3, "{generator:?}: {normal} on {facet}");
            }
            use Generator::{Annulus, Disc, Plane, Polygon};
            if let Plane { .. } | Disc { .. } | Annulus { .. } | Polygon { .. } = generator {
                assert!(facet.y > 1.0 - 1e-6, "{generator:?}: {facet}");
            }
        }
    });
}

/// A uv map keeps the sense of rotation: text on it reads the right way.
#[test]
fn uvs_are_not_mirrored_and_stay_near_the_square() {
    for_each(|generator, mesh| {
        for t in 0..mesh.triangles.len() {
            let [a, b, c] = mesh.corner_uvs(t, 0).unwrap();
            assert!((b - a).perp_dot(c - a) > 0.0, "{generator:?}: triangle {t}: {a} {b} {c}");
            for uv in [a, b, c] {
                assert!(
                    (-0.001..1.6).contains(&uv.x) && (-0.001..1.001).contains(&uv.y),
                    "{generator:?}: {uv}"
                );
            }
        }
    });
}

/// Each halving of the pieces divides the error of area and volume by four: within 15 % once the mesh is fine.
#[test]
fn area_and_volume_approach_the_shape_with_the_square_of_the_resolution() {
    for generator in Generator::examples() {
        if generator.area_of_shape().is_none() && generator.volume_of_shape().is_none() {
            continue;
        }
        let errors = |factor: u32| {
            let mesh = generator.refined(factor).mesh();
            let error =
                |found: f64, truth: Option<f64>| truth.map_or(0.0, |truth| (found / truth - 1.0).abs());
            [
                error(measure::area(&mesh), generator.area_of_shape()),
                error(measure::volume(&mesh), generator.volume_of_shape()),
            ]
        };
        // Meshes that are fine already need not become as much finer.
        let factor = if generator.triangle_count() < 400 { 8 } else { 4 };
        let (coarse, fine) = (errors(factor), errors(2 * factor));
        for (coarse, fine) in coarse.into_iter().zip(fine) {
            // Flat shapes are exact up to the rounding of their positions.
            if coarse > 1e-6 {
                let ratio = coarse / fine;
                assert!((3.4..4.6).contains(&ratio), "{generator:?}: {coarse} then {fine}");
            }
        }
    }
}

#[test]
fn measures_of_the_polyhedra_are_exact() {
    // A prism over a regular n-gon of circumradius r.
    let (n, r, h) = (12.0, 1.0, 2.0);
    let cylinder = luch_mesh::generate::cylinder(1.0, 2.0, 12, 3, true);
    let polygon = n / 2.0 * r * r * libm::sin(2.0 * PI / n);
    close(measure::volume(&cylinder), polygon * h);
    close(measure::area(&cylinder), 2.0 * polygon + n * 2.0 * r * libm::sin(PI / n) * h);
    // A pyramid over the same.
    let cone = luch_mesh::generate::cone(1.0, 0.0, 2.0, 12, 1, true);
    close(measure::volume(&cone), polygon * h / 3.0);
    // The regular icosahedron in the unit sphere has edges of 4 / √(10 + 2 √5).
    let icosahedron = luch_mesh::generate::icosphere(1.0, 0);
    let edge = 4.0 / (10.0 + 2.0 * 5f64.sqrt()).sqrt();
    close(measure::area(&icosahedron), 5.0 * 3f64.sqrt() * edge * edge);
    close(measure::volume(&icosahedron), 5.0 / 12.0 * (3.0 + 5f64.sqrt()) * edge * edge * edge);
    // Boxes to the last bit.
    let cuboid = luch_mesh::generate::cuboid(Vec3::new(1.0, 2.0, 4.0), [1, 2, 4]);
    assert_eq!((measure::area(&cuboid), measure::volume(&cuboid)), (28.0, 8.0));
}

fn close(found: f64, truth: f64) {
    // Positions are rounded to f32.
    assert!((found / truth - 1.0).abs() < 4.0 * f64::from(f32::EPSILON), "{found} is not {truth}");
}

#[test]
fn nonsense_counts_still_give_a_body() {
    for (segments, rings) in [(0, 0), (1, 1), (2, u32::MAX)] {
        let sphere = luch_mesh::generate::sphere(1.0, segments, rings);
        assert!(measure::closedness(&sphere).is_closed());
    }
    assert!(luch_mesh::generate::cone(0.0, 0.0, 1.0, 8, 1, true).triangles.is_empty());
}
