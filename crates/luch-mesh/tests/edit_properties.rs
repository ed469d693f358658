//! Editing under random planes, widths, ways and selections.

use glam::{DVec3, Vec3};
use luch_mesh::edit::{self, Cut, Extrusion, Grouping, Inset, Plane, Selection, Side};
use luch_mesh::{PolygonMesh, generate, measure};
use proptest::prelude::*;

fn volume(mesh: &PolygonMesh) -> f64 {
    measure::volume(&mesh.triangulate())
}

/// Closed bodies of several kinds.
fn body(kind: usize) -> PolygonMesh {
    match kind % 6 {
        0 => PolygonMesh::from(&generate::icosphere(1.0, 2)),
        1 => PolygonMesh::from(&generate::torus(1.0, 0.35, 12, 7)),
        2 => PolygonMesh::from(&generate::cuboid(Vec3::new(1.0, 2.0, 1.5), [2, 3, 1])),
        3 => PolygonMesh::from(&generate::cylinder(0.8, 2.0, 9, 2, true)),
        // Faces with more than three corners, and with holes.
        4 => {
            let mesh = body(2);
            edit::dissolve_flat(&mesh, &vec![true; mesh.face_count()], 1e-3)
        }
        _ => {
            let mesh = body(4);
            let all = vec![true; mesh.face_count()];
            let inset = Inset { width: 0.2, depth: 0.0, grouping: Grouping::Individual };
            let inset = edit::inset(&mesh, &all, &inset).expect("small");
            let raised = edit::extrude(&inset, &all, &Extrusion::along_normals(0.1)).expect("small");
            edit::dissolve_flat(&raised, &vec![true; raised.face_count()], 1e-3)
        }
    }
}

fn is_closed(mesh: &PolygonMesh) -> bool {
    let triangles = mesh.triangulate();
    triangles.validate().is_empty() && measure::closedness(&triangles).is_closed()
}

/// No border and no opposed winding; a part of a cut may touch itself along an edge in the plane.
fn has_no_gap(mesh: &PolygonMesh) -> bool {
    let triangles = mesh.triangulate();
    let report = measure::closedness(&triangles);
    triangles.validate().is_empty() && report.boundary.is_none() && report.inconsistent.is_none()
}

/// Every half-edge has its counterpart. Faces that move by their normals may come to cross themselves, and have no triangles then.
fn fits_together(mesh: &PolygonMesh) -> bool {
    luch_mesh::polygon_mesh::HalfEdges::new(mesh).opposites().iter().all(Option::is_some)
}

fn direction() -> impl Strategy<Value = DVec3> {
    let part = || prop_oneof![Just(0.0), Just(1.0), Just(-1.0), -1.0..1.0f64];
    (part(), part(), part())
        .prop_map(|(x, y, z)| DVec3::new(x, y, z))
        .prop_filter("no direction", |v| v.length() > 0.01)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 80, failure_persistence: None, ..ProptestConfig::default() })]

    /// Both parts of a cut are closed and add up to the whole, also for planes through vertices, edges and faces.
    #[test]
    fn parts_of_a_cut_add_up(kind in 0..6usize, normal in direction(), at in prop_oneof![Just(None), any::<prop::sample::Index>().prop_map(Some)], shift in -0.8..0.8f64) {
        let mesh = body(kind);
        let all = vec![true; mesh.face_count()];
        let point = at.map_or(normal * shift, |at| at.get(&mesh.positions).as_dvec3());
        let plane = Plane::through(point, normal).expect("a direction");
        let part = |keep| edit::cut(&mesh, &all, &Cut { plane, keep, cap: true, cap_slot: None }).expect("small");
        let (below, above) = (part(Side::Below), part(Side::Above));
        for part in [&below, &above] {
            prop_assert!(has_no_gap(part), "{}", measure::closedness(&part.triangulate()));
        }
        let whole = volume(&mesh);
        prop_assert!((volume(&below) + volume(&above) - whole).abs() < 1e-5 * whole);
        // Nothing lies on the wrong side, by more than what counts as on the plane.
        prop_assert!(above.positions.iter().all(|p| plane.height(p.as_dvec3()) > -1e-5));
        prop_assert!(below.positions.iter().all(|p| plane.height(p.as_dvec3()) < 1e-5));
    }

    /// Whatever region is raised or inset, the body stays closed; along a vector the volume grows by area times height.
    #[test]
    fn raised_regions_stay_closed(kind in 0..6usize, flags in prop::collection::vec(any::<bool>(), 64), way in direction(), width in 0.0..0.3f64) {
        let mesh = body(kind);
        let faces: Vec<bool> = (0..mesh.face_count()).map(|face| flags[face % flags.len()]).collect();
        let raised = edit::extrude(&mesh, &faces, &Extrusion::by(way)).expect("small");
        prop_assert!(is_closed(&raised));
        // The prism over each face: its area vector along the way.
        let triangles = edit::delete_faces(&mesh, &faces.iter().map(|flag| !flag).collect::<Vec<_>>()).triangulate();
        let flux: f64 = (0..triangles.triangles.len()).map(|t| triangles.area_normal(t).as_dvec3().dot(way) / 2.0).sum();
        prop_assert!((volume(&raised) - volume(&mesh) - flux).abs() < 1e-4);
        for grouping in [Grouping::Region, Grouping::Individual] {
            let inset = edit::inset(&mesh, &faces, &Inset { width, depth: 0.1, grouping }).expect("small");
            prop_assert!(fits_together(&inset));
            let extrusion = Extrusion { grouping, ..Extrusion::along_normals(0.1) };
            prop_assert!(fits_together(&edit::extrude(&mesh, &faces, &extrusion).expect("small")));
        }
    }

    /// Any edges of any body can be cut off; so can any vertices.
    #[test]
    fn bevels_stay_closed(kind in 0..6usize, flags in prop::collection::vec(any::<bool>(), 64), width in 0.001..1.0f64) {
        let mesh = body(kind);
        let edges = Selection::All.edges(&mesh).into_iter().enumerate();
        let edges: Vec<[u32; 2]> = edges.filter(|(number, _)| flags[number % flags.len()]).map(|(_, edge)| edge).collect();
        let beveled = edit::bevel_edges(&mesh, &edges, width).expect("manifold");
        prop_assert!(is_closed(&beveled.mesh), "{}", measure::closedness(&beveled.mesh.triangulate()));
        let vertices: Vec<bool> = (0..mesh.positions.len()).map(|vertex| flags[vertex % flags.len()]).collect();
        let cut = edit::bevel_vertices(&mesh, &vertices, width).expect("manifold");
        prop_assert!(is_closed(&cut.mesh));
        prop_assert!(volume(&cut.mesh) < volume(&mesh) + 1e-6);
    }

    /// Splitting, then dissolving what is flat, keeps form and closedness.
    #[test]
    fn splits_and_dissolves_keep_the_form(kind in 0..6usize, flags in prop::collection::vec(any::<bool>(), 64)) {
        let mesh = body(kind);
        let faces: Vec<bool> = (0..mesh.face_count()).map(|face| flags[face % flags.len()]).collect();
        let whole = volume(&mesh);
        let quads = edit::split_quads(&mesh, &faces).expect("small");
        let poked = edit::poke(&quads, &vec![true; quads.face_count()], 0.0).expect("small");
        let back = edit::dissolve_flat(&poked, &vec![true; poked.face_count()], 1e-3);
        for made in [&quads, &poked, &back] {
            prop_assert!(is_closed(made));
            prop_assert!((volume(made) - whole).abs() < 1e-4, "{} is not {whole}", volume(made));
        }
        prop_assert!(back.face_count() <= mesh.face_count());
    }

    /// Doubling at any plane gives a symmetric closed body of twice the upper part.
    #[test]
    fn symmetry_doubles_the_upper_part(kind in 0..6usize, normal in direction(), shift in -0.4..0.4f64) {
        let mesh = body(kind);
        let all = vec![true; mesh.face_count()];
        let plane = Plane::through(normal * shift, normal).expect("a direction");
        let upper = edit::cut(&mesh, &all, &Cut { plane, keep: Side::Above, cap: true, cap_slot: None }).expect("small");
        let double = edit::symmetrize(&mesh, &edit::Symmetry { plane, tolerance: 0.0 }).expect("small");
        prop_assert!(has_no_gap(&double), "{}", measure::closedness(&double.triangulate()));
        prop_assert!((volume(&double) - 2.0 * volume(&upper)).abs() < 1e-4);
    }

    /// No rule breaks the reader, and what it reads works on any mesh.
    #[test]
    fn any_text_is_a_rule_or_an_error(text in "(not |all|and |or |\\(|\\)|faces\\(0-3|border|grow\\(|, 2\\)|box\\(0,0,0,1,1,1\\)| |-|é){0,12}") {
        if let Ok(rule) = Selection::parse(&text) {
            prop_assert_eq!(rule.faces(&body(2)).len(), body(2).face_count());
        }
    }
}
