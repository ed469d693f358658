//! Shapes and how they are placed.

use crate::text::{files, honoured, load, load_files, only, sound, warnings};
use flate2::Compression;
use flate2::write::ZlibEncoder;
use glam::{Vec2, Vec3};
use luch_mesh::TriangleMesh;
use luch_scene::{Instance, Shape};
use std::io::Write;

/// Of an only mesh: the mesh and its instance.
fn mesh(shape: &str) -> (TriangleMesh, Instance) {
    let loaded = honoured(shape);
    let (instance, shape) = only(&loaded);
    let Shape::Mesh(mesh) = shape else { panic!("is a mesh") };
    (mesh.clone(), instance.clone())
}

/// The normal of a triangle in the world.
fn world_normal(mesh: &TriangleMesh, instance: &Instance, t: usize) -> Vec3 {
    let normal = mesh.area_normal(t);
    // luch keeps the outside outside under a mirroring: the inverse transpose.
    (glam::Mat3::from(instance.placement.matrix3).inverse().transpose() * normal).normalize()
}

fn obj(inside: &str) -> String {
    format!(r#"<shape type="obj"><string name="filename" value="t.obj"/>{inside}</shape>"#)
}

const MIRROR: &str = r#"<transform name="to_world"><scale x="-1"/></transform>"#;
const FLIP: &str = r#"<boolean name="flip_normals" value="true"/>"#;
const FLAT: &str = r#"<boolean name="face_normals" value="true"/>"#;

#[test]
fn a_mesh_faces_where_mitsuba_has_it() {
    // The triangle is seen from +Z. Mirrored along x, Mitsuba's winding turns its back.
    for (inside, z) in [
        (String::new(), 1.0),
        (FLAT.to_owned(), 1.0),
        (FLIP.to_owned(), -1.0),
        (format!("{FLIP}{FLAT}"), -1.0),
        (format!("{MIRROR}{FLAT}"), -1.0),
        (MIRROR.to_owned(), -1.0),
        (format!("{MIRROR}{FLIP}"), 1.0),
    ] {
        let (mesh, instance) = mesh(&obj(&inside));
        assert!(world_normal(&mesh, &instance, 0).abs_diff_eq(Vec3::Z * z, 1e-6), "{inside}");
        let has_normals = !mesh.normals.is_empty();
        assert_eq!(has_normals, !inside.contains("face_normals"), "{inside}");
        if let Some([a, ..]) = mesh.corner_normals(0) {
            assert!(a.dot(mesh.area_normal(0)) > 0.0, "{inside}");
        }
    }
    // Simple forms keep their outside outside.
    let (square, instance) = mesh(&format!(r#"<shape type="rectangle">{MIRROR}</shape>"#));
    assert!(world_normal(&square, &instance, 0).abs_diff_eq(Vec3::Z, 1e-6));
    let (square, instance) = mesh(&format!(r#"<shape type="rectangle">{FLIP}</shape>"#));
    assert!(world_normal(&square, &instance, 0).abs_diff_eq(Vec3::NEG_Z, 1e-6));
}

#[test]
fn vertex_normals_decide_which_side_is_the_front() {
    let mut all = files(
        r#"<scene version="3.0.0"><shape type="obj"><string name="filename" value="n.obj"/></shape></scene>"#,
    );
    all.push(("n.obj".into(), b"v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 -1\nf 1//1 2//1 3//1\n".to_vec()));
    let loaded = load_files(all, &[]).unwrap();
    let Shape::Mesh(mesh) = &*loaded.scene.shapes[0] else { panic!("is a mesh") };
    assert!(mesh.area_normal(0).z < 0.0);
    assert_eq!(mesh.corner_normals(0).unwrap()[0], Vec3::NEG_Z);
}

#[test]
fn v_of_an_obj_file_runs_up_unless_it_says_otherwise() {
    let (plain, _) = mesh(&obj(""));
    assert_eq!(plain.corner_uvs(0, 0).unwrap(), [Vec2::ZERO, Vec2::X, Vec2::Y]);
    let (down, _) = mesh(&obj(r#"<boolean name="flip_tex_coords" value="false"/>"#));
    assert_eq!(down.corner_uvs(0, 0).unwrap(), [Vec2::Y, Vec2::ONE, Vec2::ZERO]);
}

#[test]
fn one_file_is_one_mesh_however_often_it_is_placed() {
    let two = format!("{}{}", obj(""), obj(r#"<transform name="to_world"><translate x="3"/></transform>"#));
    let loaded = honoured(&two);
    assert_eq!((loaded.scene.shapes.len(), loaded.scene.instances.len()), (1, 2));
    assert_eq!(loaded.scene.instances[1].placement.translation, glam::Vec3A::X * 3.0);
}

#[test]
fn spheres_discs_and_tubes() {
    let loaded = honoured(
        r#"<shape type="sphere"><point name="center" x="1" y="2" z="3"/><float name="radius" value="0.5"/></shape>"#,
    );
    let (instance, shape) = only(&loaded);
    assert_eq!(*shape, Shape::Sphere { radius: 1.0 });
    // Its pole is Mitsuba's +Z.
    assert!(instance.placement.transform_point3(Vec3::Y).abs_diff_eq(Vec3::new(1.0, 2.0, 3.5), 1e-6));
    // Mitsuba's u is 0 at +X and grows toward +Y; ours is 0 at −Z and grows toward −X.
    assert!(instance.placement.transform_vector3(Vec3::NEG_Z).abs_diff_eq(Vec3::X * 0.5, 1e-6));
    assert!(instance.placement.transform_vector3(Vec3::NEG_X).abs_diff_eq(Vec3::Y * 0.5, 1e-6));
    let (inward, instance) = mesh(&format!(r#"<shape type="sphere">{FLIP}</shape>"#));
    let [a, ..] = inward.corners(0);
    assert!(world_normal(&inward, &instance, 0).dot(instance.placement.transform_vector3(a)) < 0.0);

    for (inside, z) in [("", 1.0), (FLIP, -1.0)] {
        let loaded = honoured(&format!(r#"<shape type="disk">{inside}</shape>"#));
        let (instance, shape) = only(&loaded);
        assert_eq!(*shape, Shape::Disc { radius: 1.0 });
        assert!(instance.placement.transform_vector3(Vec3::Y).abs_diff_eq(Vec3::Z * z, 1e-6));
    }

    let (tube, instance) = mesh(
        r#"<shape type="cylinder"><point name="p0" x="1" y="0" z="0"/><point name="p1" x="1" y="4" z="0"/><float name="radius" value="0.5"/></shape>"#,
    );
    for position in &tube.positions {
        let place = instance.placement.transform_point3(*position);
        assert!((Vec2::new(place.x - 1.0, place.z).length() - 0.5).abs() < 1e-5);
        assert!(place.y.abs() < 1e-5 || (place.y - 4.0).abs() < 1e-5);
    }
}

#[test]
fn a_stretched_lamp_is_a_mesh() {
    let emitter = r#"<emitter type="area"/>"#;
    let stretch = r#"<transform name="to_world"><scale x="2"/></transform>"#;
    for kind in ["sphere", "disk"] {
        let loaded = sound(&format!(r#"<shape type="{kind}">{emitter}{stretch}</shape>"#));
        assert!(matches!(only(&loaded).1, Shape::Mesh(_)), "{kind}");
    }
}

#[test]
fn groups_are_placed_by_instances() {
    let loaded = honoured(
        r#"<shape type="shapegroup" id="g"><shape type="rectangle"><transform name="to_world"><translate z="1"/></transform></shape><shape type="sphere"/></shape>
        <shape type="instance"><ref id="g"/><transform name="to_world"><translate x="5"/></transform></shape>
        <shape type="instance"><ref id="g"/><transform name="to_world"><scale value="2"/></transform></shape>"#,
    );
    let places: Vec<Vec3> = loaded.scene.instances.iter().map(|i| i.placement.translation.into()).collect();
    assert_eq!(places, [Vec3::new(5.0, 0.0, 1.0), Vec3::X * 5.0, Vec3::Z * 2.0, Vec3::ZERO]);
}

#[test]
fn groups_that_hold_themselves_are_refused() {
    let error =
        load(r#"<shape type="merge" id="m"><shape type="merge" id="n"><ref id="m"/></shape></shape>"#);
    assert!(error.unwrap_err().to_string().contains("without end"));
}

/// Two meshes in a file: a triangle at z = 0, and one at z = 1 with uvs in double precision.
fn serialized(version: u16) -> Vec<u8> {
    let mut file = Vec::new();
    let mut starts = Vec::new();
    for place in 0..2_u32 {
        starts.push(file.len());
        file.extend([0x1c, 0x04]);
        file.extend(version.to_le_bytes());
        let is_double = place == 1;
        let flags: u32 = if is_double { 0x2002 } else { 0x1000 };
        let mut data = flags.to_le_bytes().to_vec();
        if version == 4 {
            data.extend(b"name\0");
        }
        data.extend(3_u64.to_le_bytes());
        data.extend(1_u64.to_le_bytes());
        let z = f64::from(place);
        let mut numbers = vec![0.0, 0.0, z, 1.0, 0.0, z, 0.0, 1.0, z];
        if is_double {
            numbers.extend([0.0, 0.25, 1.0, 0.25, 0.0, 1.0]);
        }
        for number in numbers {
            match is_double {
                true => data.extend(number.to_le_bytes()),
                false => data.extend((number as f32).to_le_bytes()),
            }
        }
        data.extend([0_u32, 1, 2].map(u32::to_le_bytes).concat());
        let mut encoder = ZlibEncoder::new(Vec::new(), Compression::default());
        encoder.write_all(&data).unwrap();
        file.extend(encoder.finish().unwrap());
    }
    for start in starts {
        match version {
            3 => file.extend((start as u32).to_le_bytes()),
            _ => file.extend((start as u64).to_le_bytes()),
        }
    }
    file.extend(2_u32.to_le_bytes());
    file
}

fn load_serialized(bytes: Vec<u8>, index: u32) -> Result<luch_formats::Loaded, luch_formats::LoadError> {
    let mut all = files(&format!(
        r#"<scene version="3.0.0"><shape type="serialized"><string name="filename" value="m.serialized"/><integer name="shape_index" value="{index}"/></shape></scene>"#
    ));
    all.push(("m.serialized".into(), bytes));
    load_files(all, &[])
}

#[test]
fn serialized_meshes_of_both_versions() {
    for version in [3, 4] {
        for index in [0, 1] {
            let loaded = load_serialized(serialized(version), index).unwrap();
            let Shape::Mesh(mesh) = &*loaded.scene.shapes[0] else { panic!("is a mesh") };
            assert_eq!(mesh.positions[1], Vec3::new(1.0, 0.0, index as f32));
            if index == 1 {
                assert_eq!(mesh.corner_uvs(0, 0).unwrap()[0], Vec2::new(0.0, 0.75));
            }
        }
    }
    let error = load_serialized(serialized(4), 2).unwrap_err().to_string();
    assert!(error.contains("`shape_index` 2 does not exist"), "{error}");
}

#[test]
fn damaged_serialized_meshes_are_refused() {
    let good = serialized(4);
    for length in 0..good.len() {
        assert!(load_serialized(good[..length].to_vec(), 0).is_err(), "cut after {length} bytes");
    }
    for at in 0..good.len() {
        for change in [1_u8, 0x80, 0xff] {
            let mut bad = good.clone();
            bad[at] ^= change;
            if let Ok(loaded) = load_serialized(bad, 1) {
                assert!(loaded.scene.problems().is_empty());
            }
        }
    }
    // A body that says it has more than deflate can make of its bytes.
    let mut data = 0x1000_u32.to_le_bytes().to_vec();
    data.extend(b"\0");
    data.extend(0xffff_ffff_u64.to_le_bytes());
    data.extend(1_u64.to_le_bytes());
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::default());
    encoder.write_all(&data).unwrap();
    let mut file = vec![0x1c, 0x04, 4, 0];
    file.extend(encoder.finish().unwrap());
    file.extend(0_u64.to_le_bytes());
    file.extend(1_u32.to_le_bytes());
    let error = load_serialized(file, 0).unwrap_err().to_string();
    assert!(error.contains("4294967295 vertices and 1 triangles, for which it is too short"), "{error}");
}

#[test]
fn shapes_that_are_not_known_are_named() {
    let loaded =
        sound(r#"<shape type="hair"><string name="filename" value="x"/></shape><shape type="cube"/>"#);
    assert_eq!(warnings(&loaded), "shape `hair` is not supported: it is left out\n");
    let error = load(r#"<shape type="cube"><transform name="to_world"><scale x="0"/></transform></shape>"#);
    assert!(error.unwrap_err().to_string().contains("cannot be inverted"));
    let error = load(r#"<shape type="obj"/>"#).unwrap_err().to_string();
    assert!(error.contains("lacks its `filename`"), "{error}");
}
