//! Meshes of any format, in and out.

use glam::Vec3;
use luch_formats::{Files, SaveError, decode_mesh, read_mesh, save_mesh, write_mesh};
use luch_mesh::codec::{EncodeOptions, Format};
use luch_mesh::{PolygonMesh, generate, measure};
use std::path::Path;

#[test]
fn every_format_is_written_and_read() {
    let folder = tempfile::tempdir().unwrap();
    let mut mesh = PolygonMesh::from(&generate::torus(2.0, 0.5, 24, 12));
    mesh.slots = (0..mesh.face_count()).map(|face| (face / 100) as u16).collect();
    let before = measure::area(&mesh.triangulate());
    for format in Format::ALL {
        let path = folder.path().join("torus").with_extension(format.extension());
        let options =
            EncodeOptions { materials: vec!["clay".to_owned(), "brass".to_owned()], ..Default::default() };
        write_mesh(&path, &mesh, &options).unwrap();
        let file = read_mesh(&path, &Files::disk()).unwrap();
        assert_eq!(file.warnings, [], "{format:?}");
        assert_eq!(measure::area(&file.mesh.triangulate()), before, "{format:?}");
        if !matches!(format, Format::Stl | Format::Off) {
            assert_eq!(file.mesh.slots.iter().max(), mesh.slots.iter().max(), "{format:?}");
        }
        if matches!(format, Format::Obj | Format::ThreeMf | Format::Glb | Format::Gltf) {
            assert_eq!(file.materials[..2], options.materials, "{format:?}");
        }
        save_mesh(&path, &mesh.triangulate()).unwrap();
        assert_eq!(read_mesh(&path, &Files::disk()).unwrap().mesh.face_count(), mesh.face_count());
    }
}

#[test]
fn scenes_are_joined_with_their_placements_and_materials() {
    let scene = r#"
luch 1
camera { from 0 1 4; to 0 1 0 }
material "clay" { diffuse 0.8 }
material "red" { diffuse 0.8 0.1 0.1 }
object material="red" { mesh { file "cube.obj" }; translate 5 0 0 }
object material="clay" { mesh { file "cube.obj" }; scale 2 }
object material="clay" { sphere radius=1 }
"#;
    let cube = generate::cuboid(Vec3::ONE, [1, 1, 1]);
    let cube = luch_mesh::codec::obj::encode(&cube, &Default::default());
    let files = Files::memory([("a.kdl".into(), scene.into()), ("cube.obj".into(), cube.into())]);
    let file = read_mesh(Path::new("a.kdl"), &files).unwrap();
    assert_eq!(file.materials, ["red", "clay"]);
    let triangles = file.mesh.triangulate();
    assert!((measure::volume(&triangles) - 9.0).abs() < 1e-5);
    assert_eq!(triangles.bounds().max.x, 5.5);
    assert!(
        file.warnings.iter().any(|warning| warning.message.contains("1 exact spheres")),
        "{:?}",
        file.warnings
    );
}

#[test]
fn errors_help() {
    let mesh = PolygonMesh::default();
    let error = write_mesh(Path::new("a.sttl"), &mesh, &Default::default()).unwrap_err();
    assert!(error.to_string().contains("; did you mean .stl?; accepted are .obj, .ply"), "{error}");
    let broken = PolygonMesh { face_ends: vec![3], ..Default::default() };
    let error = write_mesh(Path::new("a.stl"), &broken, &Default::default()).unwrap_err();
    assert!(matches!(error, SaveError::Mesh { .. }));
    let files =
        Files::memory([("a.blend".into(), b"BLENDER".to_vec()), ("b".into(), b"OFF\n0 0 0\n".to_vec())]);
    let error = read_mesh(Path::new("a.blend"), &files).unwrap_err().to_string();
    assert!(error.contains("a.blend: is of no mesh format that is known here (.blend)"), "{error}");
    assert!(read_mesh(Path::new("c.obj"), &files).unwrap_err().to_string().contains("no such file"));
    assert_eq!(read_mesh(Path::new("b"), &files).unwrap().mesh, PolygonMesh::default());
    let error = decode_mesh(Path::new("-"), b"v 0 0 0\nv 1 0\n").unwrap_err().to_string();
    assert!(error.starts_with("-:2:"), "{error}");
}
