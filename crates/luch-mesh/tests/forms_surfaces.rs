//! What is known about single forms beyond area and volume.

use glam::Vec3;
use luch_mesh::edges::Edges;
use luch_mesh::generate::{KleinForm, Solid};
use luch_mesh::workshop::{NoFiles, Pipeline};
use luch_mesh::{Generator, measure};

fn border_edges(generator: Generator) -> usize {
    let mesh = generator.mesh();
    Edges::new(&mesh.triangles, mesh.positions.len())
        .iter(&mesh.triangles)
        .filter(|e| e.half_edges.len() == 1)
        .count()
}

#[test]
fn the_teapot_is_newells() {
    for divisions in [2, 7, 32] {
        let generator = Generator::Teapot { size: 1.0, divisions };
        let mesh = generator.mesh();
        // Borders: the rim and the lid in four quarters, both ends of handle and spout in two halves. So nothing else is
        // open: all other borders of patches meet.
        assert_eq!(border_edges(generator), 16 * divisions as usize);
        // Mirrored in the plane of spout and handle it is the same.
        let mut places: Vec<_> =
            mesh.positions.iter().map(|p| p.to_array().map(|x| (x + 0.0).to_bits())).collect();
        let mut mirrored: Vec<_> =
            mesh.positions.iter().map(|p| [p.x, p.y, -p.z].map(|x| (x + 0.0).to_bits())).collect();
        places.sort_unstable();
        mirrored.sort_unstable();
        assert_eq!(places, mirrored);
        // Exact normals at the tip of the lid and in the middle of the bottom.
        let normals_at = |place: Vec3| -> Vec<Vec3> {
            let corners = (0..mesh.triangles.len()).flat_map(|t| (0..3).map(move |k| (t, k)));
            corners
                .filter(|&(t, k)| mesh.corners(t)[k] == place)
                .map(|(t, k)| mesh.corner_normals(t).unwrap()[k])
                .collect()
        };
        for (place, normal) in [(Vec3::new(0.0, 3.15, 0.0), Vec3::Y), (Vec3::ZERO, Vec3::NEG_Y)] {
            let found = normals_at(place);
            assert!(found.len() >= 4 && found.iter().all(|n| *n == normal), "{found:?}");
        }
    }
    let bounds = measure::bounds(&Generator::Teapot { size: 1.0, divisions: 64 }.mesh());
    assert!((bounds.min - Vec3::new(-3.0, 0.0, -2.0)).abs().max_element() < 1e-4, "{}", bounds.min);
    assert!((bounds.max - Vec3::new(3.434, 3.15, 2.0)).abs().max_element() < 1e-3, "{}", bounds.max);
    // Sizes are factors.
    let half = Generator::Teapot { size: 0.5, divisions: 3 }.mesh();
    let whole = Generator::Teapot { size: 1.0, divisions: 3 }.mesh();
    assert!(half.positions.iter().zip(&whole.positions).all(|(a, b)| *a * 2.0 == *b));
}

#[test]
fn surfaces_of_one_side() {
    for form in [KleinForm::Bottle, KleinForm::FigureEight] {
        let generator = Generator::KleinBottle { form, size: 2.0, segments: 64, sides: 20 };
        assert_eq!(border_edges(generator), 0);
        assert!(!generator.is_orientable() && !generator.is_closed());
        let mesh = generator.mesh();
        let report = measure::closedness(&mesh);
        assert_eq!((report.euler_characteristic, report.genus, report.components), (0, None, 1));
        // Going around once, a consistent winding cannot be found: colour the triangles and run into a contradiction.
        assert!(!can_be_wound(generator), "{form:?}");
        // Height of the middle line 2, or a circle of diameter 2 and an eight of 0.4 each side.
        let size = measure::bounds(&mesh).max - measure::bounds(&mesh).min;
        assert!(size.max_element() < 3.2, "{size}");
    }
    let band =
        |half_twists| Generator::Moebius { radius: 2.0, width: 1.0, half_twists, segments: 60, stacks: 4 };
    for half_twists in 0..6 {
        let generator = band(half_twists);
        assert_eq!(can_be_wound(generator), half_twists % 2 == 0);
        assert_eq!(generator.is_orientable(), half_twists % 2 == 0);
        assert_eq!(border_edges(generator), 120);
        // One border or two: count the loops.
        assert_eq!(border_loops(generator), if half_twists % 2 == 0 { 2 } else { 1 });
    }
    assert!(can_be_wound(Generator::Teapot { size: 1.0, divisions: 2 }));
}

/// Whether triangles can be turned round so that all neighbours agree.
fn can_be_wound(generator: Generator) -> bool {
    let mesh = generator.mesh();
    let edges = Edges::new(&mesh.triangles, mesh.positions.len());
    let mut neighbours = vec![Vec::new(); mesh.triangles.len()];
    for edge in edges.iter(&mesh.triangles) {
        if let &[one, other] = edge.half_edges {
            let start = |h: u32| luch_mesh::edges::half_edge_ends(&mesh.triangles, h)[0];
            let agrees = start(one) != start(other);
            neighbours[one as usize / 3].push((other as usize / 3, agrees));
            neighbours[other as usize / 3].push((one as usize / 3, agrees));
        }
    }
    let mut turned: Vec<Option<bool>> = vec![None; mesh.triangles.len()];
    for first in 0..turned.len() {
        let mut pending = Vec::new();
        if turned[first].is_none() {
            turned[first] = Some(false);
            pending.push(first);
        }
        while let Some(triangle) = pending.pop() {
            for &(other, agrees) in &neighbours[triangle] {
                let wanted = turned[triangle].map(|turned| turned == agrees);
                match turned[other] {
                    None => {
                        turned[other] = wanted;
                        pending.push(other);
                    }
                    found if found != wanted => return false,
                    _ => {}
                }
            }
        }
    }
    true
}

fn border_loops(generator: Generator) -> usize {
    let mesh = generator.mesh();
    let edges = Edges::new(&mesh.triangles, mesh.positions.len());
    let border: Vec<[u32; 2]> =
        edges.iter(&mesh.triangles).filter(|e| e.half_edges.len() == 1).map(|e| e.vertices).collect();
    let mut left = border.clone();
    let mut loops = 0;
    while let Some([start, mut at]) = left.pop() {
        loops += 1;
        while at != start {
            let next = left.iter().position(|edge| edge.contains(&at)).expect("borders are loops");
            let [a, b] = left.swap_remove(next);
            at = if a == at { b } else { a };
        }
    }
    loops
}

#[test]
fn solids_have_the_faces_of_their_names() {
    let expected = [
        (4, 4),
        (8, 6),
        (6, 8),
        (20, 12),
        (12, 20),
        (12, 8),
        (24, 14),
        (24, 14),
        (60, 32),
        (60, 32),
        (12, 14),
        (30, 32),
    ];
    for (solid, (vertices, faces)) in Solid::ALL.into_iter().zip(expected) {
        let polygons = Generator::Polyhedron { solid, radius: 2.0 }.polygons();
        assert_eq!((polygons.positions.len(), polygons.face_count()), (vertices, faces), "{solid:?}");
        // All corners on the sphere, all edges alike.
        assert!(polygons.positions.iter().all(|p| (p.length() - 2.0).abs() < 1e-6), "{solid:?}");
        let mut lengths = Vec::new();
        for face in 0..faces {
            let corners = &polygons.corners[polygons.face(face)];
            let place = |k: usize| polygons.positions[corners[k % corners.len()] as usize];
            lengths.extend((0..corners.len()).map(|k| place(k).distance(place(k + 1))));
        }
        let bounds = lengths.iter().fold([f32::MAX, 0.0], |[low, high], l| [low.min(*l), high.max(*l)]);
        assert!(bounds[1] - bounds[0] < 2e-6, "{solid:?}: {bounds:?}");
    }
}

#[test]
fn exponents_of_one_make_an_ellipsoid() {
    let radii = Vec3::new(1.0, 2.0, 3.0);
    let round = Generator::Ellipsoid { radii, segments: 12, rings: 8 }.mesh();
    let superellipsoid =
        Generator::Superellipsoid { radii, around: 1.0, upright: 1.0, segments: 12, rings: 8 }.mesh();
    for (a, b) in round.positions.iter().zip(&superellipsoid.positions) {
        assert!((*a - *b).length() < 1e-6, "{a} {b}");
    }
    for (a, b) in round.normals.values.iter().zip(&superellipsoid.normals.values) {
        assert!((*a - *b).length() < 1e-6, "{a} {b}");
    }
}

#[test]
fn hard_and_smooth_edges_are_where_they_should_be() {
    // Of a pipe: normals along the radius on both sides, upright on the rings.
    let tube =
        Generator::Tube { outer_radius: 2.0, inner_radius: 1.0, height: 1.0, segments: 16, stacks: 2 }.mesh();
    for t in 0..tube.triangles.len() {
        let facet = tube.area_normal(t).normalize();
        for (corner, normal) in tube.corners(t).iter().zip(tube.corner_normals(t).unwrap()) {
            let radial = Vec3::new(corner.x, 0.0, corner.z).normalize();
            let truth = if facet.y.abs() > 0.5 { facet.round() } else { radial * facet.dot(radial).signum() };
            assert!((normal - truth).length() < 1e-6, "{normal} is not {truth}");
        }
    }
    // Of bodies with flat sides: the facet's own.
    let flat = [
        Generator::Prism { sides: 7, radius: 1.0, height: 2.0 },
        Generator::Pyramid { sides: 5, radius: 1.0, top_radius: 0.25, height: 2.0 },
        Generator::Pyramid { sides: 4, radius: 1.0, top_radius: 0.0, height: 2.0 },
        Generator::Polyhedron { solid: Solid::TruncatedIcosahedron, radius: 1.0 },
    ];
    for generator in flat {
        let mesh = generator.mesh();
        for t in 0..mesh.triangles.len() {
            let facet = mesh.area_normal(t).normalize();
            assert!(
                mesh.corner_normals(t).unwrap().iter().all(|n| (*n - facet).length() < 2e-6),
                "{generator:?}"
            );
        }
    }
    // Of a rounded box: no two normals at one place.
    let round = Generator::RoundedCuboid { size: Vec3::ONE, radius: 0.25, segments: 3 }.mesh();
    let mut of_position = vec![None; round.positions.len()];
    for (corners, normals) in round.triangles.iter().zip(&round.normals.triangles) {
        for (corner, normal) in corners.iter().zip(normals) {
            assert_eq!(*of_position[*corner as usize].get_or_insert(*normal), *normal);
        }
    }
}

#[test]
fn counts_are_known_before_memory_is_taken() {
    let refused = |line: &str| {
        let error = Pipeline::parse(line).and_then(|p| p.run(&mut NoFiles)).unwrap_err().to_string();
        assert!(error.contains("at most 67108864"), "{line}: {error}");
    };
    refused("cuboid --divisions 4096");
    refused("capsule --segments 4096 --rings 4096");
    refused("tube --segments 4096 --stacks 4096");
    refused("spring --turns 1000 --segments 4096 --sides 4096");
    let message =
        |line: &str| Pipeline::parse(line).and_then(|p| p.run(&mut NoFiles)).unwrap_err().to_string();
    assert!(message("sphere --radius 1e31").contains("expected a number from"));
    assert!(message("cuboid --size 1,1,1e200").contains("lengths are from"));
    assert!(message("tube --inner-radius 1").contains("less than the radius"));
    assert!(message("torus-knot --p 4 --q 2").contains("several rings"));
    assert!(message("grid --divisions 2.5").contains("whole numbers"));
    assert!(message("plane --size 1,2,3").contains("one or two"));
    assert!(message("extrude-outline --outline 'star 5 1'").contains("expected star TIPS OUTER INNER"));
    assert!(message("extrude-outline --outline 'circle 1 4096' --layers 65536").contains("faces"));
    assert!(message("sweep --outline 'circle 1' --path 1,2").contains("three for each point"));
    for generator in Generator::examples() {
        let enormous = generator.refined(u32::MAX);
        assert!(enormous.triangle_count() < 1 << 34, "{generator:?}");
    }
}
