//! Booleans, decimation, repair and subdivision of real files of other projects.
//!
//! The files are looked for in the folder of the environment variable `LUCH_TEST_DATA`, or else beside the workspace.

use std::path::{Path, PathBuf};

use glam::{EulerRot, Quat, Vec3};
use luch_mesh::boolean::{Operation, boolean, convex_hull};
use luch_mesh::codec::{self, Format};
use luch_mesh::{PolygonMesh, TriangleMesh, measure, repair, simplify, subdivide, weld};

fn folder() -> Option<PathBuf> {
    let folder = match std::env::var_os("LUCH_TEST_DATA") {
        Some(folder) => PathBuf::from(folder),
        None => Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data"),
    };
    let folder = folder.join("mesh");
    if !folder.is_dir() {
        #[expect(clippy::print_stdout, reason = "says why nothing is tested")]
        {
            println!("skipped: no test data");
        }
        return None;
    }
    Some(folder)
}

/// Closed bodies, from twenty triangles to fifty thousand, with up to seven handles and nine pieces.
const BODIES: [&str; 8] = [
    "tinyply/icosahedron.ply",
    "testball/Mesh000.ply",
    "trimesh/models/fixed_top.ply",
    "trimesh/models/fuze.ply",
    "trimesh/models/mirror.ply",
    "trimesh/models/20mm-xyz-cube.stl",
    "trimesh/models/round.stl",
    "spot/spot.obj",
];

fn bodies() -> Vec<(&'static str, TriangleMesh)> {
    let Some(folder) = folder() else { return Vec::new() };
    let read = |name: &'static str| {
        let bytes = std::fs::read(folder.join(name)).expect("a file");
        let extension = Path::new(name).extension().and_then(|e| e.to_str()).unwrap_or("");
        let format = Format::from_extension(extension).expect("a known format");
        let mesh = codec::decode(&bytes, format).expect("a mesh").mesh;
        (name, weld::weld_exact(&mesh).mesh)
    };
    BODIES.into_iter().map(read).collect()
}

/// V(A ∪ B) + V(A ∩ B) = V(A) + V(B) for a body and a turned copy of itself.
#[test]
fn volumes_of_real_bodies_add_up() {
    for (name, mesh) in bodies() {
        let bounds = mesh.bounds();
        let size = (bounds.max - bounds.min).max_element();
        let middle = (bounds.min + bounds.max) / 2.0;
        let turn = Quat::from_euler(EulerRot::XYZ, 0.4, 0.9, 0.3);
        let mut other = mesh.clone();
        other.normals = Default::default();
        for position in &mut other.positions {
            *position = turn * (*position - middle) + middle + Vec3::new(0.13, 0.07, -0.11) * size;
        }
        let volume = |operation| {
            let result = boolean(&mesh, &other, operation).unwrap_or_else(|error| panic!("{name}: {error}"));
            assert_eq!(result.validate(), [], "{name} {operation:?}");
            let report = measure::closedness(&result);
            assert!(
                report.boundary.is_none() && report.inconsistent.is_none(),
                "{name} {operation:?}: {report}"
            );
            measure::volume(&result)
        };
        let (union, common) = (volume(Operation::Union), volume(Operation::Intersection));
        let rest = volume(Operation::Difference);
        let own = measure::volume(&mesh);
        // Single precision: area times size times 2⁻²³, with room for the extent away from the origin.
        let extent = f64::from(bounds.min.abs().max(bounds.max.abs()).max_element() + size);
        let most = measure::area(&mesh) * extent * 1e-6;
        assert!(
            (union + common - own - measure::volume(&other)).abs() < most,
            "{name}: {union} + {common} of {own}"
        );
        assert!((own - common - rest).abs() < most, "{name}: {own} - {common} is not {rest}");
        assert!(common > -most && union > own - most, "{name}");
    }
}

#[test]
fn real_bodies_are_decimated_without_losing_topology() {
    for (name, mesh) in bodies() {
        let before = measure::closedness(&mesh);
        let goal = mesh.triangles.len() / 5;
        let settings = simplify::Settings { triangles: goal, ..simplify::Settings::default() };
        let simple = simplify::simplify(&mesh, &settings);
        assert_eq!(simple.mesh.validate(), [], "{name}");
        let after = measure::closedness(&simple.mesh);
        assert!(after.is_closed(), "{name}: {after}");
        assert_eq!(
            (after.genus, after.components, after.pinched),
            (before.genus, before.components, before.pinched),
            "{name}"
        );
        // Small coarse bodies have nothing to spare.
        if mesh.triangles.len() > 4000 {
            let ratio = measure::volume(&simple.mesh) / measure::volume(&mesh);
            assert!((0.97..1.03).contains(&ratio), "{name}: {ratio}");
            let left = simple.mesh.triangles.len();
            assert!(left < mesh.triangles.len() / 3, "{name}: {left} of {}", mesh.triangles.len());
        }
    }
}

#[test]
fn real_bodies_need_no_repair_and_have_hulls_around_them() {
    for (name, mesh) in bodies() {
        let outcome = repair::repair(&PolygonMesh::from(&mesh), 0.0);
        assert_eq!(
            outcome.report.filled_holes + outcome.report.turned_faces,
            0,
            "{name}: {}",
            outcome.report
        );
        let hull = convex_hull(&mesh.positions).expect("a body");
        assert!(measure::closedness(&hull).is_closed(), "{name}");
        let ratio = measure::volume(&hull) / measure::volume(&mesh);
        assert!(ratio > 1.0 - 1e-6, "{name}: {ratio}");
    }
}

#[test]
fn real_bodies_are_subdivided() {
    for (name, mesh) in bodies().into_iter().filter(|(_, mesh)| mesh.triangles.len() < 6000) {
        for scheme in [subdivide::Scheme::CatmullClark, subdivide::Scheme::Loop] {
            let settings = subdivide::Settings { scheme, levels: 2, limit: true, ..Default::default() };
            let fine = subdivide::subdivide(&PolygonMesh::from(&mesh), &settings)
                .expect("small enough")
                .triangulate();
            let (before, after) = (measure::closedness(&mesh), measure::closedness(&fine));
            assert!(after.is_closed() && after.genus == before.genus, "{name}: {after}");
        }
    }
}
