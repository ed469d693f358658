//! Polygon meshes through every format and back.

use std::collections::BTreeSet;

use glam::{Vec2, Vec3, Vec4};
use luch_mesh::codec::{self, EncodeError, EncodeOptions, Form, Format, gltf, obj, three_mf};
use luch_mesh::measure::EdgeFault;
use luch_mesh::polygon_mesh::{CornerAttribute, Crease, SharpVertex};
use luch_mesh::{Generator, PolygonMesh, TriangleMesh, measure};
use proptest::prelude::*;

fn text() -> EncodeOptions {
    EncodeOptions { form: Form::Text, ..Default::default() }
}

/// A cube of quads with a hole through its top face's polygon, two uv sets, colours of corners, slots out of order, groups,
/// creases: everything a polygon mesh can have.
fn rich() -> PolygonMesh {
    let corner =
        |i: u32| Vec3::new((i & 1) as f32, (i >> 1 & 1) as f32, (i >> 2) as f32) * 3.0 + Vec3::splat(0.1);
    let mut mesh = PolygonMesh { positions: (0..8).map(corner).collect(), ..Default::default() };
    mesh.positions.extend([Vec3::new(1.0, 1.0, 3.1), Vec3::new(2.0, 1.0, 3.1), Vec3::new(1.5, 2.0, 3.1)]);
    mesh.add_face_with_holes(&[4, 5, 7, 6], &[&[8, 10, 9]]);
    for face in [[0, 2, 3, 1], [0, 1, 5, 4], [1, 3, 7, 5], [3, 2, 6, 7], [2, 0, 4, 6]] {
        mesh.add_face(&face);
    }
    let count = mesh.corners.len() as u32;
    mesh.uv_sets = vec![
        CornerAttribute::indexed(
            vec![Vec2::ZERO, Vec2::X, Vec2::new(1.0 / 3.0, 1e-9)],
            (0..count).map(|c| c % 3).collect(),
        ),
        CornerAttribute::indexed(vec![Vec2::ONE, Vec2::NEG_Y], (0..count).map(|c| c % 2).collect()),
        CornerAttribute::per_position((0..11).map(|i| Vec2::new(i as f32 / 7.0, 0.5)).collect()),
    ];
    mesh.colors = CornerAttribute::indexed(
        vec![Vec4::ONE, Vec4::new(0.1, 0.2, 0.7, 0.5)],
        (0..count).map(|c| c / 5 % 2).collect(),
    );
    mesh.normals = CornerAttribute::indexed(
        vec![Vec3::new(1.0, 2.0, 3.0).normalize(), Vec3::Z],
        (0..count).map(|c| u32::from(c < 7)).collect(),
    );
    mesh.slots = vec![3, 0, 0, 7, 3, 1];
    mesh.smoothing_groups = vec![0, 1, 1, 32, 0, 7];
    mesh.creases = vec![
        Crease { vertices: [0, 1], sharpness: 2.5 },
        Crease { vertices: [7, 3], sharpness: f32::INFINITY },
    ];
    mesh.sharp_vertices = vec![SharpVertex { vertex: 6, sharpness: 0.1 }];
    mesh
}

#[test]
fn obj_keeps_everything() {
    let mesh = rich();
    let bytes = codec::encode_polygons(&mesh, Format::Obj, &Default::default()).unwrap();
    let again = codec::decode_polygons(&bytes, Format::Obj).unwrap();
    assert_eq!(again.warnings, []);
    assert_eq!(again.mesh, mesh);
    // Without normals the smoothing groups stay what they are.
    let flat = PolygonMesh { normals: Default::default(), ..mesh };
    let bytes = codec::encode_polygons(&flat, Format::Obj, &Default::default()).unwrap();
    assert_eq!(codec::decode_polygons(&bytes, Format::Obj).unwrap().mesh, flat);
}

#[test]
fn names_of_slots_stay_with_their_slots() {
    let names = ["a", "a", "", "brass plate", "x\ny"].map(str::to_owned).to_vec();
    let options = EncodeOptions { materials: names, library: Some("m.mtl".to_owned()), ..Default::default() };
    let again =
        codec::decode_polygons(&codec::encode_polygons(&rich(), Format::Obj, &options).unwrap(), Format::Obj)
            .unwrap();
    assert_eq!(again.mesh.slots, rich().slots);
    assert_eq!(again.materials[3], "brass plate");
    assert_eq!(again.materials.iter().collect::<BTreeSet<_>>().len(), again.materials.len());
    assert_eq!(again.libraries, ["m.mtl"]);
}

#[test]
fn other_programs_see_triangles_where_a_face_has_holes() {
    let bytes = codec::encode_polygons(&rich(), Format::Obj, &Default::default()).unwrap();
    let plain: Vec<u8> =
        bytes.split_inclusive(|b| *b == b'\n').filter(|line| line[0] != b'#').flatten().copied().collect();
    let seen = obj::decode(&plain).unwrap().mesh.triangulate();
    assert_eq!(measure::area(&seen), measure::area(&rich().triangulate()));
}

/// What a triangle looks like, wherever its corners begin; −0 is 0, as welding has it.
fn looks(mesh: &TriangleMesh, triangle: usize) -> [[u32; 3]; 3] {
    let mut corners = mesh.corners(triangle).map(|p| (p + Vec3::ZERO).to_array().map(f32::to_bits));
    let first = (0..3).min_by_key(|&k| corners[k]).unwrap();
    corners.rotate_left(first);
    corners
}

/// Indices of values that are those of the positions are not written down twice.
fn shared(mut mesh: PolygonMesh) -> PolygonMesh {
    for uvs in &mut mesh.uv_sets {
        if uvs.corners == mesh.corners {
            uvs.corners.clear();
        }
    }
    if mesh.normals.corners == mesh.corners {
        mesh.normals.corners.clear();
    }
    mesh
}

#[test]
fn every_generator_through_every_format() {
    for generator in Generator::examples() {
        let mesh = PolygonMesh::from(&generator.mesh());
        let before = mesh.triangulate();
        for format in Format::ALL.into_iter().filter(|format| format.can_be_read()) {
            for options in [EncodeOptions::default(), text()] {
                let bytes = codec::encode_polygons(&mesh, format, &options).unwrap();
                assert_eq!(Format::from_magic(&bytes), Some(format), "{generator:?}");
                let again = codec::decode_polygons(&bytes, format).unwrap();
                assert_eq!(again.warnings, [], "{generator:?} {format:?}");
                let after = again.mesh.triangulate();
                assert_eq!(after.triangles.len(), before.triangles.len(), "{generator:?} {format:?}");
                for t in 0..before.triangles.len() {
                    assert_eq!(looks(&after, t), looks(&before, t), "{generator:?} {format:?}");
                    if matches!(format, Format::Obj | Format::Ply | Format::Off) {
                        assert_eq!(after.corner_normals(t), before.corner_normals(t));
                        assert_eq!(after.corner_uvs(t, 0), before.corner_uvs(t, 0));
                    }
                }
                // Places that are one in an STL file are two in the teapot, where its handle touches the body.
                let touches = format == Format::Stl && matches!(generator, Generator::Teapot { .. });
                if matches!(format, Format::Obj | Format::Stl | Format::ThreeMf) && !touches {
                    // Positions are shared as before.
                    let [after, before] = [&after, &before].map(|mesh| {
                        // Positions are numbered anew, so the first of the faulty edges is another.
                        let report = measure::closedness(mesh);
                        let count = |fault: Option<EdgeFault>| fault.map_or(0, |fault| fault.count);
                        let faults = [report.boundary, report.non_manifold, report.inconsistent].map(count);
                        (faults, report.components, report.euler_characteristic, report.genus)
                    });
                    assert_eq!(after, before, "{generator:?} {format:?}");
                }
                if format == Format::Obj {
                    assert_eq!(shared(again.mesh), shared(mesh.clone()), "{generator:?}");
                }
            }
        }
    }
}

#[test]
fn faces_keep_their_corners_and_colours_in_ply_and_off() {
    let mesh = PolygonMesh { holes: Vec::new(), ..rich() };
    let value = |mesh: &PolygonMesh, corner: usize| {
        let index = mesh.colors.corners.get(corner).unwrap_or(&mesh.corners[corner]);
        (mesh.positions[mesh.corners[corner] as usize], mesh.colors.values[*index as usize])
    };
    for (format, options) in
        [(Format::Ply, EncodeOptions::default()), (Format::Ply, text()), (Format::Off, text())]
    {
        let bytes = codec::encode_polygons(&mesh, format, &options).unwrap();
        let again = codec::decode_polygons(&bytes, format).unwrap().mesh;
        assert_eq!(again.face_ends, mesh.face_ends);
        assert!((0..mesh.corners.len()).all(|corner| value(&mesh, corner) == value(&again, corner)));
        if format == Format::Ply {
            assert_eq!(again.slots, mesh.slots);
        }
    }
}

#[test]
fn a_face_of_a_thousand_corners() {
    let mut disc = PolygonMesh::default();
    let angle = |i: u32| f64::from(i) * std::f64::consts::TAU / 1000.0;
    disc.positions =
        (0..1000).map(|i| Vec3::new(libm::cos(angle(i)) as f32, 0.0, -libm::sin(angle(i)) as f32)).collect();
    disc.add_face(&(0..1000).collect::<Vec<_>>());
    for format in [Format::Obj, Format::Ply, Format::Off] {
        let bytes = codec::encode_polygons(&disc, format, &Default::default()).unwrap();
        assert_eq!(codec::decode_polygons(&bytes, format).unwrap().mesh, disc, "{format:?}");
    }
}

#[test]
fn slots_and_units_of_3mf() {
    let mut mesh = Generator::Cuboid { size: Vec3::ONE, divisions: [1, 1, 1] }.mesh();
    mesh.slots = (0..12).map(|t| t % 3).collect();
    let materials = vec!["red & <green>".to_owned(), "\"two\"".to_owned()];
    let options = three_mf::EncodeOptions { materials, unit: three_mf::LengthUnit::Millimeter };
    let file = three_mf::decode(&three_mf::encode(&mesh, &options).unwrap()).unwrap();
    assert_eq!(file.mesh.slots, mesh.slots);
    assert_eq!(file.materials, ["red & <green>", "\"two\"", "slot2"]);
    let volume = measure::volume(&file.mesh.triangulate());
    assert!((volume - 1e-9).abs() < 1e-15, "{volume}");
}

#[test]
fn glb_is_laid_out_as_the_standard_wants() {
    let mut mesh =
        Generator::Cylinder { radius: 1.0, height: 2.0, segments: 12, stacks: 1, capped: true }.mesh();
    mesh.slots = (0..mesh.triangles.len()).map(|t| u16::from(t % 2 == 0)).collect();
    let bytes =
        gltf::encode_binary(&mesh, &gltf::EncodeOptions { materials: vec!["a\"b".to_owned()] }).unwrap();
    let number = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap()) as usize;
    assert_eq!((&bytes[..4], number(4), number(8)), (&b"glTF"[..], 2, bytes.len()));
    let json_length = number(12);
    assert!(json_length.is_multiple_of(4) && number(20 + json_length).is_multiple_of(4));
    assert_eq!(number(20 + json_length) + 28 + json_length, bytes.len());
    let json = std::str::from_utf8(&bytes[20..20 + json_length]).unwrap();
    assert_eq!(json.matches("\"indices\"").count(), 2);
    assert!(
        json.contains(r#""name":"a\"b""#) && json.contains(r#""min":[-1e0,-1e0,-1e0],"max":[1e0,1e0,1e0]"#),
        "{json}"
    );
    // Rims: 12 vertices of the side have a seam more, each disc has 12 and a middle.
    assert!(json.contains("\"count\":52,") || json.contains("\"count\":50,"), "{json}");
    assert!(
        gltf::encode_text(&TriangleMesh::default(), &Default::default()).unwrap().contains("\"scenes\":[{}]")
    );
}

#[test]
fn broken_meshes_are_refused() {
    let broken = [
        PolygonMesh { corners: vec![0, 1, 2], face_ends: vec![3], ..Default::default() },
        PolygonMesh { face_ends: vec![3], ..rich() },
        PolygonMesh { slots: vec![1], ..rich() },
        PolygonMesh { normals: CornerAttribute::per_position(vec![Vec3::Z]), ..rich() },
        PolygonMesh { creases: vec![Crease { vertices: [0, 99], sharpness: 1.0 }], ..rich() },
    ];
    for mesh in broken {
        for format in Format::ALL {
            let result = codec::encode_polygons(&mesh, format, &Default::default());
            assert!(matches!(result, Err(EncodeError::Broken(_))), "{format:?}");
        }
    }
    assert!(codec::decode_polygons(b"glTF", Format::Glb).unwrap_err().to_string().contains("read as scenes"));
}

#[test]
fn off_in_its_variants() {
    let read =
        |text: &str| codec::decode_polygons(text.as_bytes(), Format::Off).map(|d| (d.mesh, d.warnings));
    let (mesh, warnings) =
        read("OFF # a comment\n4 2 5\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3 255 0 0\n").unwrap();
    assert_eq!((mesh.face_count(), warnings[0].message.as_str()), (2, "colours of faces are skipped"));
    let (mesh, _) = read("COFF 3 1 3\n0 0 0 255 0 0 255\n1 0 0 255 255 0\n0 1 0 0 0 1 255\n3 0 1 2").unwrap();
    assert_eq!(mesh.colors.values[..2], [Vec4::new(1.0, 0.0, 0.0, 1.0), Vec4::new(1.0, 1.0, 0.0, 1.0)]);
    let (mesh, _) = read("3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n").unwrap();
    assert_eq!(mesh.corners, [0, 1, 2]);
    let (mesh, _) = read("STCNOFF\n3 1 0\n0 0 0 0 0 2 .5 .5 .5 1. 0 1\n1 0 0 0 0 1 1.0 1.0 1.0 1.0 1 1\n0 1 0 0 0 1 0. 0. 0. 1. 0 0\n3 0 1 2\n").unwrap();
    assert_eq!((mesh.normals.values[0], mesh.uv_sets[0].values[1]), (Vec3::Z, Vec2::ONE));
    let wrong = [
        ("OFF BINARY\n", "line 1, column 5: found “BINARY”, expected the text form"),
        (
            "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n",
            "line 6, column 7: found “3”, expected the number of one of 3 vertices",
        ),
        ("OFF\n3000000 1 0\n", "line 2, column 1: found “3000000”, expected no more vertices"),
        ("4OFF\n", "line 1, column 1: found “4OFF”, expected the number of vertices"),
        ("nOFF\n", "line 1, column 1: found “nOFF”, expected OFF, perhaps with"),
    ];
    for (text, expected) in wrong {
        let error = read(text).unwrap_err().to_string();
        assert!(error.starts_with(expected), "{error}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn obj_keeps_polygons_of_any_size(
        points in prop::collection::vec(prop::array::uniform3(-1e6f32..1e6), 3..30),
        faces in prop::collection::vec(prop::collection::vec(any::<prop::sample::Index>(), 3..9), 0..30),
        seed in any::<u32>(),
    ) {
        let mut mesh = PolygonMesh { positions: points.into_iter().map(Vec3::from).collect(), ..Default::default() };
        for face in &faces {
            mesh.add_face(&face.iter().map(|i| i.index(mesh.positions.len()) as u32).collect::<Vec<_>>());
        }
        let word = |i: usize| seed.wrapping_mul(2_654_435_761).wrapping_add((i as u32).wrapping_mul(40_503)) >> 7;
        if !faces.is_empty() {
            mesh.slots = (0..faces.len()).map(|face| if face == 0 { 5 } else { (word(face) % 6) as u16 }).collect();
            mesh.smoothing_groups = (0..faces.len()).map(|face| 1 + word(face) % 3).collect();
            let uv = |i: usize| Vec2::new(word(i) as f32 / 1e3, -(i as f32));
            mesh.uv_sets = (0..2).map(|set| CornerAttribute::indexed(
                (0..5).map(uv).collect(),
                (0..mesh.corners.len()).map(|c| word(c + set) % 4).collect(),
            )).collect();
        }
        let bytes = codec::encode_polygons(&mesh, Format::Obj, &Default::default()).unwrap();
        prop_assert_eq!(codec::decode_polygons(&bytes, Format::Obj).unwrap().mesh, mesh);
    }

    #[test]
    fn packets_with_flipped_bytes_inside(flips in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..4)) {
        let mesh = Generator::Cuboid { size: Vec3::ONE, divisions: [1, 1, 1] }.mesh();
        let mut bytes = three_mf::encode(&mesh, &Default::default()).unwrap();
        for (place, value) in flips {
            let place = place.index(bytes.len());
            bytes[place] ^= value;
        }
        let _ = three_mf::decode(&bytes);
    }
}
