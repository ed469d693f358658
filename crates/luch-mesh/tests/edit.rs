//! Editing: volumes, areas, counts and closedness as geometry says.

use std::f64::consts::PI;

use glam::{DAffine3, DVec3, Vec2, Vec3};
use luch_mesh::edit::{
    self, Cut, Deformation, Extrusion, Grouping, Inset, Plane, Quadrangulation, Selection, Side, Span,
};
use luch_mesh::polygon_mesh::Crease;
use luch_mesh::{PolygonMesh, generate, measure};

fn cube(size: f32) -> PolygonMesh {
    PolygonMesh::from(&generate::cuboid(Vec3::splat(size), [1; 3]))
}

/// A cube of six quads.
fn quad_cube(size: f32) -> PolygonMesh {
    let all = [true; 12];
    let quads = edit::quadrangulate(&cube(size), &all, &Quadrangulation { bend: 0.1, skew: 0.1 });
    assert_eq!(quads.face_count(), 6);
    quads
}

fn torus() -> PolygonMesh {
    PolygonMesh::from(&generate::torus(1.0, 0.3, 32, 16))
}

fn volume(mesh: &PolygonMesh) -> f64 {
    measure::volume(&mesh.triangulate())
}

fn area(mesh: &PolygonMesh) -> f64 {
    measure::area(&mesh.triangulate())
}

fn all(mesh: &PolygonMesh) -> Vec<bool> {
    vec![true; mesh.face_count()]
}

fn all_vertices(mesh: &PolygonMesh) -> Vec<bool> {
    vec![true; mesh.positions.len()]
}

fn select(mesh: &PolygonMesh, rule: &str) -> Vec<bool> {
    Selection::parse(rule).unwrap().faces(mesh)
}

/// Positions are rounded to f32: relative errors of some units in the last place.
fn close(found: f64, truth: f64) {
    assert!((found - truth).abs() <= 4e-6 * truth.abs().max(1.0), "{found} is not {truth}");
}

fn assert_closed(mesh: &PolygonMesh, pieces: usize, genus: u64) {
    let half_edges = luch_mesh::polygon_mesh::HalfEdges::new(mesh);
    let open = half_edges.opposites().iter().filter(|other| other.is_none()).count();
    assert_eq!(open, 0, "half-edges without a counterpart");
    let triangles = mesh.triangulate();
    assert_eq!(triangles.validate(), []);
    let report = measure::closedness(&triangles);
    assert!(report.is_closed(), "{report}");
    assert_eq!((report.components, report.genus), (pieces, Some(genus)), "{report}");
    assert_eq!((report.duplicates, report.collapsed), (0, 0));
}

#[test]
fn extruding_adds_area_times_height() {
    for mesh in [cube(1.0), quad_cube(1.0)] {
        let top = select(&mesh, "normal(0,1,0, 10deg)");
        let tower = edit::extrude(&mesh, &top, &Extrusion::along_normals(2.0)).unwrap();
        close(volume(&tower), 3.0);
        assert_closed(&tower, 1, 0);
        // Four walls, and no vertex left behind: four new ones.
        assert_eq!((tower.face_count(), tower.positions.len()), (mesh.face_count() + 4, 12));
        // A slanted way changes nothing about base times height.
        let slanted = edit::extrude(&mesh, &top, &Extrusion::by(DVec3::new(0.5, 2.0, -1.0))).unwrap();
        close(volume(&slanted), 3.0);
        assert_closed(&slanted, 1, 0);
    }
}

#[test]
fn extruding_faces_one_by_one_gives_prisms() {
    let mesh = quad_cube(1.0);
    let extrusion = Extrusion { grouping: Grouping::Individual, ..Extrusion::along_normals(0.5) };
    let cross = edit::extrude(&mesh, &all(&mesh), &extrusion).unwrap();
    close(volume(&cross), 1.0 + 6.0 * 0.5);
    assert_eq!(cross.face_count(), 6 + 24);
    assert_closed(&cross, 1, 0);
}

#[test]
fn extruding_a_corner_region_moves_its_faces_by_the_distance() {
    let mesh = quad_cube(1.0);
    let corner = select(&mesh, "normal(1,0,0, 5deg) or normal(0,1,0, 5deg) or normal(0,0,1, 5deg)");
    let grown = edit::extrude(&mesh, &corner, &Extrusion::along_normals(1.0)).unwrap();
    assert_closed(&grown, 1, 0);
    // The moved faces lie in the planes one metre outside.
    for face in (0..6).filter(|&face| corner[face]) {
        let corners = &grown.corners[grown.face(face)];
        let far = corners.iter().filter(|&&v| grown.positions[v as usize].max_element() > 1.4).count();
        assert_eq!(far, 4);
    }
}

#[test]
fn extruding_a_sheet_with_a_base_makes_a_body() {
    let sheet = PolygonMesh::from(&generate::plane(Vec2::new(2.0, 3.0), [4, 5]));
    let extrusion = Extrusion { base: true, ..Extrusion::along_normals(0.5) };
    let slab = edit::extrude(&sheet, &all(&sheet), &extrusion).unwrap();
    close(volume(&slab), 3.0);
    assert_closed(&slab, 1, 0);
    let border = Selection::parse("border").unwrap().edges(&sheet);
    let tray = edit::extrude_borders(&sheet, &border, DVec3::Y).unwrap();
    close(area(&tray), 6.0 + 10.0);
    assert_eq!(tray.face_count(), sheet.face_count() + 18);
}

#[test]
fn insets_keep_the_area_and_the_width() {
    let mesh = quad_cube(2.0);
    for grouping in [Grouping::Region, Grouping::Individual] {
        let top = select(&mesh, "normal(0,1,0, 5deg)");
        let inset = edit::inset(&mesh, &top, &Inset { width: 0.25, depth: 0.0, grouping }).unwrap();
        assert_closed(&inset, 1, 0);
        close(area(&inset), 24.0);
        close(volume(&inset), 8.0);
        let shrunken = select(&inset, "faces(0-5) and normal(0,1,0, 5deg)");
        let middle = edit::delete_faces(&inset, &shrunken.iter().map(|flag| !flag).collect::<Vec<_>>());
        close(area(&middle), 1.5 * 1.5);
        // uvs of the ring are those of the place: the same texture as before.
        let scale = |mesh: &PolygonMesh| {
            let triangles = mesh.triangulate();
            let uv: f64 = (0..triangles.triangles.len())
                .map(|t| triangles.corner_uvs(t, 0).unwrap())
                .map(|[a, b, c]| f64::from((b - a).perp_dot(c - a)) / 2.0)
                .sum();
            uv
        };
        close(scale(&inset), scale(&mesh));
    }
    // Too wide: held just below the middle, still closed, no face turned round.
    let most =
        edit::inset(&mesh, &all(&mesh), &Inset { width: 9.0, depth: 0.0, grouping: Grouping::Individual });
    let most = most.unwrap();
    assert_closed(&most, 1, 0);
    close(area(&most), 24.0);
    // Sunk in by a depth: a frustum is missing.
    let top = select(&mesh, "normal(0,1,0, 5deg)");
    let sunk =
        edit::inset(&mesh, &top, &Inset { width: 0.5, depth: -0.6, grouping: Grouping::Region }).unwrap();
    close(volume(&sunk), 8.0 - 0.6 * (4.0 + 1.0 + 2.0) / 3.0);
}

#[test]
fn bevelling_a_cube_cuts_off_known_volumes() {
    let (size, width) = (2.0, 0.25);
    let edges_of = |mesh: &PolygonMesh, rule: &str| Selection::parse(rule).unwrap().edges(mesh);
    for mesh in [quad_cube(2.0), cube(2.0)] {
        // All edges: the faces shrink to squares, edges become rectangles, corners become triangles.
        let beveled = edit::bevel_edges(&mesh, &edges_of(&mesh, "sharp(30deg)"), width).unwrap();
        assert_closed(&beveled.mesh, 1, 0);
        assert_eq!(beveled.mesh.face_count(), mesh.face_count() + 12 + 8);
        let inner = size - 2.0 * width;
        // A cube inside, six slabs, twelve half prisms, eight corner tetrahedra.
        let truth = inner.powi_exact(3)
            + 6.0 * inner * inner * width
            + 12.0 * inner * width * width / 2.0
            + 8.0 * width.powi_exact(3) / 6.0;
        close(volume(&beveled.mesh), truth);
    }
    // One edge alone: a prism is gone, constant over the whole length.
    for mesh in [quad_cube(2.0), cube(2.0)] {
        let top_front = edges_of(&mesh, "sharp(30deg) and box(-9,0.9,0.9, 9,9,9)");
        assert_eq!(top_front.len(), 1);
        let beveled = edit::bevel_edges(&mesh, &top_front, width).unwrap();
        assert_closed(&beveled.mesh, 1, 0);
        close(volume(&beveled.mesh), 8.0 - size * width * width / 2.0);
        // Nothing is folded over: the area is that of the body.
        let bevel = size * width * 2f64.sqrt();
        close(area(&beveled.mesh), 24.0 - 2.0 * size * width + bevel - width * width);
    }
    // The ring around the top.
    let mesh = quad_cube(2.0);
    let beveled =
        edit::bevel_edges(&mesh, &edges_of(&mesh, "sharp(30deg) and box(-9,0.9,-9, 9,9,9)"), width).unwrap();
    assert_closed(&beveled.mesh, 1, 0);
    let low = size * size;
    let high = (size - 2.0 * width) * (size - 2.0 * width);
    close(volume(&beveled.mesh), low * (size - width) + width * (low + high + (low * high).sqrt()) / 3.0);
    // Too wide: held back, still a body.
    let most = edit::bevel_edges(&mesh, &edges_of(&mesh, "all"), 50.0).unwrap();
    assert!(most.width < 1.0 && most.width > 0.9, "{}", most.width);
    assert_closed(&most.mesh, 1, 0);
    // Corners: eight tetrahedra.
    let cut = edit::bevel_vertices(&mesh, &all_vertices(&mesh), 0.5).unwrap();
    assert_closed(&cut.mesh, 1, 0);
    close(volume(&cut.mesh), 8.0 - 8.0 * 0.125 / 6.0);
    assert_eq!(cut.mesh.face_count(), 14);
}

trait PowExact {
    fn powi_exact(self, exponent: u32) -> f64;
}

impl PowExact for f64 {
    fn powi_exact(self, exponent: u32) -> f64 {
        (0..exponent).map(|_| self).product()
    }
}

#[test]
fn bevels_of_any_edges_of_round_bodies_stay_closed() {
    for mesh in [
        PolygonMesh::from(&generate::icosphere(1.0, 1)),
        PolygonMesh::from(&generate::cylinder(1.0, 2.0, 12, 2, true)),
        torus(),
    ] {
        let edges = Selection::All.edges(&mesh);
        let genus = measure::closedness(&mesh.triangulate()).genus.unwrap();
        for step in [1, 2, 3, 5, 7] {
            let some: Vec<[u32; 2]> = edges.iter().step_by(step).copied().collect();
            let beveled = edit::bevel_edges(&mesh, &some, 0.02).unwrap();
            assert_closed(&beveled.mesh, 1, genus);
            assert!(volume(&beveled.mesh) <= volume(&mesh) * 1.001);
        }
    }
}

#[test]
fn cutting_a_torus_upright_gives_two_caps() {
    let mesh = torus();
    let plane = Plane::through(DVec3::new(0.01, 0.0, 0.0), DVec3::X).unwrap();
    let cut =
        |keep, cap| edit::cut(&mesh, &all(&mesh), &Cut { plane, keep, cap, cap_slot: Some(7) }).unwrap();
    let half = cut(Side::Above, true);
    assert_closed(&half, 1, 0);
    let caps: Vec<usize> = (0..half.face_count()).filter(|&face| half.slots[face] == 7).collect();
    assert_eq!(caps.len(), 2);
    close(volume(&half) + volume(&cut(Side::Below, true)), volume(&mesh));
    let both = cut(Side::Both, true);
    assert_closed(&both, 2, 0);
    close(volume(&both), volume(&mesh));
    let split = cut(Side::Both, false);
    assert_closed(&split, 1, 1);
    close(area(&split), area(&mesh));
    // Lying down: one cap that is a ring.
    let plane = Plane { normal: DVec3::Y, distance: 0.013 };
    let lower =
        edit::cut(&mesh, &all(&mesh), &Cut { plane, keep: Side::Below, cap: true, cap_slot: None }).unwrap();
    assert_closed(&lower, 1, 1);
    assert_eq!(lower.holes.len(), 1);
}

#[test]
fn planes_through_vertices_and_along_faces_are_no_trouble() {
    for mesh in [cube(2.0), quad_cube(2.0), PolygonMesh::from(&generate::cuboid(Vec3::splat(2.0), [2, 2, 2]))]
    {
        let whole = volume(&mesh);
        let cases = [
            (DVec3::Y, DVec3::ZERO, 0.5),
            (DVec3::Y, DVec3::Y, 1.0),
            (DVec3::Y, DVec3::NEG_Y, 0.0),
            (DVec3::new(1.0, 1.0, 0.0), DVec3::ZERO, 0.5),
            (DVec3::new(1.0, 1.0, 1.0), DVec3::ZERO, 0.5),
            (DVec3::new(1.0, 1.0, 1.0), DVec3::ONE, 1.0),
            (DVec3::new(1.0, 0.0, 0.0), DVec3::new(5.0, 0.0, 0.0), 1.0),
        ];
        for (normal, point, below) in cases {
            let plane = Plane::through(point, normal).unwrap();
            let part = |keep| {
                edit::cut(&mesh, &all(&mesh), &Cut { plane, keep, cap: true, cap_slot: None }).unwrap()
            };
            let (low, high) = (part(Side::Below), part(Side::Above));
            close(volume(&low), whole * below);
            close(volume(&high), whole * (1.0 - below));
            for part in [low, high].iter().filter(|part| part.face_count() > 0) {
                assert_closed(part, 1, 0);
            }
        }
    }
}

/// The uvs of the plane are a linear function of the place; so they are at every cut.
#[test]
fn uvs_at_a_cut_are_those_of_the_place() {
    let mesh = PolygonMesh::from(&generate::plane(Vec2::new(2.0, 3.0), [3, 2]));
    let plane = Plane::through(DVec3::new(0.1, 0.0, 0.2), DVec3::new(1.0, 0.0, 0.7)).unwrap();
    let cut =
        edit::cut(&mesh, &all(&mesh), &Cut { plane, keep: Side::Both, cap: false, cap_slot: None }).unwrap();
    assert!(cut.face_count() > mesh.face_count());
    let uvs = &cut.uv_sets[0];
    for (&vertex, &uv) in cut.corners.iter().zip(&uvs.corners) {
        let (place, uv) = (cut.positions[vertex as usize], uvs.values[uv as usize]);
        let truth = Vec2::new(place.x / 2.0 + 0.5, 0.5 - place.z / 3.0);
        assert!((uv - truth).length() < 1e-6, "{place}: {uv} is not {truth}");
    }
}

#[test]
fn layers_add_up() {
    let mesh = torus();
    for axis in [DVec3::Y, DVec3::X, DVec3::new(0.3, 1.0, 0.2)] {
        let layers = edit::slice(&mesh, axis, 5, None).unwrap();
        let report = measure::closedness(&layers.triangulate());
        assert!(report.is_closed(), "{axis}: {report}");
        close(volume(&layers), volume(&mesh));
        assert!(edit::components(&layers).len() >= 5);
    }
}

#[test]
fn splits_keep_area_and_form() {
    for mesh in [cube(1.0), quad_cube(1.0), torus()] {
        let edges = Selection::All.edges(&mesh);
        let (before, euler) = (area(&mesh), measure::closedness(&mesh.triangulate()).euler_characteristic);
        let split = edit::split_edges(&mesh, &edges, 2).unwrap();
        let poked = edit::poke(&mesh, &all(&mesh), 0.0).unwrap();
        let quads = edit::split_quads(&mesh, &all(&mesh)).unwrap();
        let some = edit::split_quads(&mesh, &select(&mesh, "normal(0,1,0, 40deg)")).unwrap();
        let triangles = edit::triangulate_faces(&mesh, &all(&mesh)).unwrap();
        for made in [&split, &poked, &quads, &some, &triangles] {
            close(area(made), before);
            let report = measure::closedness(&made.triangulate());
            assert!(report.is_closed(), "{report}");
            assert_eq!(report.euler_characteristic, euler);
        }
        assert_eq!(split.positions.len(), mesh.positions.len() + 2 * edges.len());
        assert_eq!(quads.face_count(), mesh.corners.len());
        assert_eq!(poked.face_count(), mesh.corners.len());
        assert_eq!(quads.positions.len(), mesh.positions.len() + edges.len() + mesh.face_count());
    }
}

#[test]
fn dissolving_gives_the_fewest_faces_of_a_cube() {
    let fine = PolygonMesh::from(&generate::cuboid(Vec3::ONE, [4, 3, 2]));
    let plain = edit::dissolve_flat(&fine, &all(&fine), 1e-3);
    assert_eq!((plain.face_count(), plain.positions.len(), plain.corners.len()), (6, 8, 24));
    assert_closed(&plain, 1, 0);
    close(volume(&plain), 1.0);
    // A step leaves a ring: a face with a hole.
    let mesh = quad_cube(2.0);
    let top = select(&mesh, "normal(0,1,0, 5deg)");
    let inset =
        edit::inset(&mesh, &top, &Inset { width: 0.5, depth: 0.0, grouping: Grouping::Region }).unwrap();
    let step = edit::extrude(&inset, &top, &Extrusion::along_normals(1.0)).unwrap();
    let merged = edit::dissolve_flat(&step, &all(&step), 1e-3);
    assert_eq!((merged.face_count(), merged.holes.len()), (11, 1));
    assert_closed(&merged, 1, 0);
    close(volume(&merged), volume(&step));
    // A corner taken out of an octahedron's top: four faces become one.
    let bevel =
        edit::bevel_vertices(&mesh, &[true, false, false, false, false, false, false, false], 0.5).unwrap();
    let back = edit::poke(&bevel.mesh, &select(&bevel.mesh, "corners(3)"), 0.3).unwrap();
    let last = back.positions.len() as u32 - 1;
    let flat = edit::dissolve_vertices(&back, &Selection::Vertices(vec![[last; 2]]).vertices(&back));
    assert_eq!(flat.face_count(), bevel.mesh.face_count());
    close(volume(&flat), volume(&bevel.mesh));
}

#[test]
fn collapsing_an_edge_takes_two_triangles_and_a_vertex() {
    let mesh = PolygonMesh::from(&generate::icosphere(1.0, 2));
    let edges = Selection::All.edges(&mesh);
    let made = edit::collapse_edges(&mesh, &edges[10..11]);
    assert_eq!((made.face_count(), made.positions.len()), (mesh.face_count() - 2, mesh.positions.len() - 1));
    assert_closed(&made, 1, 0);
}

#[test]
fn taking_apart_and_counting_pieces() {
    let mesh = cube(1.0);
    let top = select(&mesh, "normal(0,1,0, 10deg)");
    assert_eq!(edit::delete_faces(&mesh, &top).face_count(), 10);
    let detached = edit::detach(&mesh, &top);
    assert_eq!((detached.positions.len(), edit::components(&detached).len()), (12, 2));
    let ripped = edit::rip(&mesh, &Selection::parse("sharp(30deg)").unwrap().edges(&mesh));
    let pieces = edit::components(&ripped);
    assert_eq!((ripped.positions.len(), pieces.len()), (24, 6));
    assert!(pieces.iter().all(|piece| (area(piece) - 1.0).abs() < 1e-6 && piece.positions.len() == 4));
    let twice = edit::duplicate(&mesh, &all(&mesh), DVec3::X * 3.0).unwrap();
    assert_closed(&twice, 2, 0);
    close(volume(&edit::component(&twice, 1).unwrap()), 1.0);
    assert!(edit::component(&twice, 2).is_err());
    // Turning half round and back is nothing.
    let turned = edit::flip_faces(&edit::flip_faces(&mesh, &top), &top);
    close(volume(&turned), 1.0);
    assert_eq!(turned.corners, mesh.corners);
}

#[test]
fn thickness_makes_bodies_of_known_volume() {
    let sheet = PolygonMesh::from(&generate::plane(Vec2::new(2.0, 1.0), [3, 2]));
    let board = edit::solidify(&sheet, 0.1, 0.0).unwrap();
    assert_closed(&board, 1, 0);
    close(volume(&board), 0.2);
    let hollow = edit::solidify(&quad_cube(2.0), 0.25, 0.0).unwrap();
    assert_closed(&hollow, 2, 0);
    close(volume(&hollow), 8.0 - 1.5 * 1.5 * 1.5);
    let open = edit::delete_faces(&quad_cube(2.0), &select(&quad_cube(2.0), "normal(0,1,0, 5deg)"));
    assert_closed(&edit::solidify(&open, 0.25, 0.5).unwrap(), 1, 0);
}

#[test]
fn a_bridge_makes_a_hole_through_a_cube() {
    let mesh = PolygonMesh::from(&generate::cuboid(Vec3::splat(3.0), [3, 3, 3]));
    let top = select(&mesh, "box(-0.6,1.4,-0.6, 0.6,2,0.6)");
    let bottom = select(&mesh, "box(-0.6,-2,-0.6, 0.6,-1.4,0.6)");
    let tube = edit::bridge(&mesh, [&top, &bottom], [&[]; 2]).unwrap();
    assert_closed(&tube, 1, 1);
    close(volume(&tube), 27.0 - 3.0);
    // Two borders of different length.
    let open = |segments| PolygonMesh::from(&generate::cylinder(1.0, 1.0, segments, 1, false));
    let mut other = open(7);
    other.positions.iter_mut().for_each(|p| p.y += 3.0);
    let pair = edit::append(&open(12), &other, 0).unwrap();
    let edges = |rule: &str| Selection::parse(rule).unwrap().edges(&pair);
    let (low, high) =
        (edges("border and box(-2,0.4,-2, 2,0.6,2)"), edges("border and box(-2,2.4,-2, 2,2.6,2)"));
    assert_eq!((low.len(), high.len()), (12, 7));
    let joined = edit::bridge(&pair, [&[]; 2], [&low, &high]).unwrap();
    let report = measure::closedness(&joined.triangulate());
    assert_eq!((report.components, report.boundary.unwrap().count), (1, 19));
    assert_eq!((report.inconsistent, report.non_manifold), (None, None));
    assert!(edit::bridge(&pair, [&[]; 2], [&[], &high]).is_err());
}

#[test]
fn affine_maps_scale_the_volume_by_their_determinant() {
    let mesh = torus();
    let whole = all_vertices(&mesh);
    let before = volume(&mesh);
    let axis = DVec3::new(1.0, 2.0, 3.0).normalize();
    let stretch = Deformation::Stretch { axis, center: DVec3::ONE, along: 2.5, across: 1.0 };
    close(volume(&edit::deform(&mesh, &whole, &stretch)), 2.5 * before);
    let shear = Deformation::Shear { axis: DVec3::Y, center: DVec3::ZERO, way: DVec3::new(0.7, 0.0, -0.4) };
    close(volume(&edit::deform(&mesh, &whole, &shear)), before);
    let turned = edit::transform(&mesh, &whole, &edit::rotation_about(DVec3::ONE, axis, 1.0));
    close(volume(&turned), before);
    let plane = Plane::through(DVec3::ONE, axis).unwrap();
    let mirrored = edit::transform(&mesh, &whole, &plane.reflection());
    close(volume(&mirrored), before);
    // Normals still point out of their faces.
    for made in [turned, mirrored, edit::deform(&mesh, &whole, &shear)] {
        let triangles = made.triangulate();
        for t in 0..triangles.triangles.len() {
            let facet = triangles.area_normal(t);
            assert!(triangles.corner_normals(t).unwrap().iter().all(|normal| normal.dot(facet) > 0.0));
        }
    }
    let back = edit::transform(&mesh, &whole, &DAffine3::from_translation(DVec3::ONE));
    close(volume(&back), before);
}

/// A bar along y with many rings.
fn bar(rings: u32) -> PolygonMesh {
    PolygonMesh::from(&generate::cuboid(Vec3::new(0.5, 4.0, 0.5), [1, rings, 1]))
}

#[test]
fn twisting_keeps_the_volume_in_the_limit() {
    let error = |rings| {
        let mesh = bar(rings);
        let whole = all_vertices(&mesh);
        let span = Span::of(&mesh, &whole, DVec3::Y, DVec3::ZERO).unwrap();
        let twisted = edit::deform(&mesh, &whole, &Deformation::Twist { span, angle: PI });
        assert_closed(&twisted, 1, 0);
        (volume(&twisted) - 1.0).abs()
    };
    let (coarse, fine) = (error(16), error(64));
    // The sides are one square wide, cut along the same diagonal: the error goes with the turn of one ring.
    assert!((3.5..4.6).contains(&(coarse / fine)), "{coarse} then {fine}");
}

#[test]
fn bending_keeps_the_length_of_the_axis_and_the_volume() {
    let mesh = bar(128);
    let whole = all_vertices(&mesh);
    let span = Span::of(&mesh, &whole, DVec3::Y, DVec3::ZERO).unwrap();
    let bend = Deformation::Bend { span, angle: PI / 2.0, toward: DVec3::X };
    let bent = edit::deform(&mesh, &whole, &bend);
    assert_closed(&bent, 1, 0);
    // Pappus: the middle of the section runs along an arc as long as the bar.
    assert!((volume(&bent) - 1.0).abs() < 1e-4, "{}", volume(&bent));
    let steps = 1000;
    let axis = |step: i32| bend.map(DVec3::Y * (f64::from(step) / f64::from(steps) * 4.0 - 2.0));
    let length: f64 = (0..steps).map(|step| axis(step).distance(axis(step + 1))).sum();
    assert!((length - 4.0).abs() < 1e-5, "{length}");
    // A quarter circle ends at its radius aside and ahead.
    let radius = 4.0 / (PI / 2.0);
    assert!((axis(steps) - DVec3::new(radius, -2.0 + radius, 0.0)).length() < 1e-12);
}

#[test]
fn tapering_a_bar_to_a_point_leaves_a_third() {
    let mesh = bar(1);
    let whole = all_vertices(&mesh);
    let span = Span::of(&mesh, &whole, DVec3::Y, DVec3::ZERO).unwrap();
    let pyramid = edit::deform(&mesh, &whole, &Deformation::Taper { span, factor: 0.0 });
    close(volume(&pyramid), 1.0 / 3.0);
}

#[test]
fn a_lattice_moved_as_a_whole_or_linearly_is_an_affine_map() {
    let mesh = torus();
    let whole = all_vertices(&mesh);
    let [low, high] = edit::vertex_bounds(&mesh, &whole);
    let mut lattice = edit::Lattice::new(low, high, [3, 4, 2]).unwrap();
    for x in 0..3 {
        for y in 0..4 {
            for z in 0..2 {
                // Linear precision: points moved in proportion to their place scale the box.
                let way = (high - low) * DVec3::new(f64::from(x) / 2.0, f64::from(y) / 3.0, f64::from(z));
                lattice.move_point([x, y, z], way).unwrap();
            }
        }
    }
    close(volume(&edit::deform(&mesh, &whole, &Deformation::Lattice(lattice.clone()))), 8.0 * volume(&mesh));
    assert!(lattice.move_point([3, 0, 0], DVec3::X).is_err());
    assert!(edit::Lattice::new(low, high, [1, 2, 2]).is_err());
}

#[test]
fn copies_multiply_and_mirrors_double() {
    let mesh = cube(1.0);
    let row = edit::array(&mesh, 5, DVec3::X * 2.0).unwrap();
    assert_closed(&row, 5, 0);
    close(volume(&row), 5.0);
    let mut away = mesh.clone();
    away.positions.iter_mut().for_each(|p| p.x += 4.0);
    let ring = edit::radial_array(&away, 6, DVec3::Y, DVec3::ZERO, 2.0 * PI).unwrap();
    assert_closed(&ring, 6, 0);
    close(volume(&ring), 6.0);
    assert!(measure::surface_centroid(&ring.triangulate()).unwrap().length() < 1e-5);
    assert!(edit::array(&mesh, u32::MAX, DVec3::X).is_err());
    // Mirrored at its side: twice as long, joined, no wall inside.
    for mesh in [cube(1.0), quad_cube(1.0)] {
        let plane = Plane::through(DVec3::X * -0.5, DVec3::X).unwrap();
        let double = edit::symmetrize(&mesh, &edit::Symmetry { plane, tolerance: 0.0 }).unwrap();
        assert_closed(&double, 1, 0);
        close(volume(&double), 2.0);
        assert_eq!(double.positions.len(), 12);
        // Through the middle at a slant: twice the upper half.
        let plane = Plane::through(DVec3::ZERO, DVec3::new(1.0, 0.4, 0.2)).unwrap();
        let same = edit::symmetrize(&mesh, &edit::Symmetry { plane, tolerance: 0.0 }).unwrap();
        assert_closed(&same, 1, 0);
        close(volume(&same), 1.0);
    }
    let plane = Plane::through(DVec3::ZERO, DVec3::X).unwrap();
    let torus = edit::symmetrize(&torus(), &edit::Symmetry { plane, tolerance: 0.0 }).unwrap();
    assert_closed(&torus, 1, 1);
}

#[test]
fn creases_and_slots_follow() {
    let mut mesh = quad_cube(1.0);
    mesh.creases =
        Selection::All.edges(&mesh).into_iter().map(|vertices| Crease { vertices, sharpness: 2.0 }).collect();
    mesh.slots = (0..6).collect();
    let split = edit::split_edges(&mesh, &Selection::All.edges(&mesh), 1).unwrap();
    assert_eq!(split.creases.len(), 24);
    let top = select(&mesh, "normal(0,1,0, 5deg)");
    let tower = edit::extrude(&mesh, &top, &Extrusion::along_normals(1.0)).unwrap();
    // Twelve as before, and four more where the top was.
    assert_eq!(tower.creases.len(), 16);
    let slot = mesh.slots[top.iter().position(|&flag| flag).unwrap()];
    assert_eq!(tower.slots.iter().filter(|&&other| other == slot).count(), 5);
    let plane = Plane::through(DVec3::ZERO, DVec3::Y).unwrap();
    let cut =
        edit::cut(&mesh, &all(&mesh), &Cut { plane, keep: Side::Above, cap: true, cap_slot: None }).unwrap();
    // Four edges of the top and the upper halves of four others.
    assert_eq!(cut.creases.len(), 8);
}

#[test]
fn no_face_is_smeared_across_a_seam() {
    let mesh = PolygonMesh::from(&generate::sphere(1.0, 24, 12));
    for projection in [edit::Projection::Cylinder, edit::Projection::Sphere] {
        let made = edit::unwrap(&mesh, &all(&mesh), projection, DVec3::Y).unwrap();
        let uvs = &made.uv_sets[0];
        for face in 0..made.face_count() {
            let us = made.face(face).map(|corner| uvs.values[uvs.corners[corner] as usize].x);
            let (low, high) = us.fold((f32::MAX, f32::MIN), |(low, high), u| (low.min(u), high.max(u)));
            // One segment of twenty-four wide.
            assert!(high - low < 1.5 / 24.0, "{projection:?}: {low} to {high}");
        }
    }
    // A box keeps the density of the texture: areas go with the square of the scale.
    let cuboid = cube(2.0);
    let made = edit::unwrap(&cuboid, &all(&cuboid), edit::Projection::Box, DVec3::Y).unwrap();
    let triangles = made.triangulate();
    for t in 0..triangles.triangles.len() {
        let [a, b, c] = triangles.corner_uvs(t, 0).unwrap();
        // Half a side of the unit square each, and not mirrored.
        close(f64::from((b - a).perp_dot(c - a)), 1.0);
    }
}

#[test]
fn crease_normals_of_polygons_agree_with_those_of_triangles() {
    let mesh = quad_cube(1.0);
    let hard = edit::creased_normals(&mesh, 0.5);
    assert_eq!(hard.values.len(), 6);
    let soft = edit::smooth_normals(&mesh);
    assert_eq!(soft.values.len(), 8);
    for (&vertex, &number) in mesh.corners.iter().zip(&soft.corners) {
        let truth = mesh.positions[vertex as usize].normalize();
        assert!((soft.values[number as usize] - truth).length() < 1e-6);
    }
}

#[test]
fn displacing_by_a_formula_moves_so_far() {
    let mesh = PolygonMesh::from(&generate::sphere(1.0, 32, 16));
    let field = edit::Field::parse("if(y > 0, 0.5, 0)").unwrap();
    let made = edit::displace(&mesh, &all_vertices(&mesh), &field, None);
    for (before, after) in mesh.positions.iter().zip(&made.positions) {
        let truth = if before.y > 0.0 { 0.5 } else { 0.0 };
        // Normals of a sphere of facets are not quite those of the sphere.
        assert!((before.distance(*after) - truth).abs() < 1e-6);
        assert!((after.length() - before.length() - truth).abs() < 0.01);
    }
    let along = edit::displace(&mesh, &all_vertices(&mesh), &field, Some(DVec3::X * 7.0));
    assert!(mesh.positions.iter().zip(&along.positions).all(|(a, b)| a.y == b.y && a.z == b.z));
}
