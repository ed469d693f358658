//! What every codec promises: what is written reads back, and no file whatever does harm.

use glam::{Vec2, Vec3, Vec4};
use luch_mesh::codec::{self, DecodeError, Format, mtl, obj, ply, stl};
use luch_mesh::{Attribute, Generator, PolygonMesh, TriangleMesh};
use proptest::prelude::*;

/// A mesh with everything a file can hold, seams and hard edges included.
fn rich_mesh(generator: Generator) -> TriangleMesh {
    let mut mesh = generator.mesh();
    // Numbers that need all their digits.
    mesh.positions.iter_mut().for_each(|p| *p = *p * 0.1 + Vec3::new(1e-7, 1.0 / 3.0, -1e6));
    let color = |i: usize| Vec4::new(i as f32 / 7.0, 0.1, 1.5, 0.5);
    mesh.colors = Attribute::per_position((0..mesh.positions.len()).map(color).collect());
    mesh.slots = (0..mesh.triangles.len()).map(|t| u16::from(t > 2) * 2).collect();
    mesh
}

/// Corner by corner, since a format may split positions.
fn assert_same(one: &TriangleMesh, other: &TriangleMesh, with_attributes: bool) {
    assert_eq!(one.triangles.len(), other.triangles.len());
    for t in 0..one.triangles.len() {
        assert_eq!(one.corners(t), other.corners(t));
        if with_attributes {
            assert_eq!(one.corner_uvs(t, 0), other.corner_uvs(t, 0));
            let colors = |m: &TriangleMesh| m.colors.corners(t, m.triangles[t]);
            assert_eq!(colors(one), colors(other));
            assert_eq!(one.corner_normals(t), other.corner_normals(t));
        }
    }
}

#[test]
fn obj_comes_back() {
    for generator in Generator::examples() {
        let mesh = rich_mesh(generator);
        let materials = ["first", "second", "a name with spaces"].map(str::to_owned).to_vec();
        let options = obj::EncodeOptions { library: Some("some file.mtl".to_owned()), materials };
        let text = obj::encode(&mesh, &options);
        let file = obj::decode(text.as_bytes()).unwrap();
        assert_eq!(file.warnings, [], "{generator:?}");
        assert_eq!(file.libraries, ["some file.mtl"]);
        assert_eq!(file.materials, ["first", "second", "a name with spaces"]);
        let again = file.mesh.triangulate();
        assert_same(&mesh, &again, true);
        assert_eq!(again.positions, mesh.positions);
        assert_eq!(again.slots, mesh.slots);
        assert_eq!(text, obj::encode(&mesh, &options));
    }
}

#[test]
fn ply_comes_back_in_every_encoding() {
    for generator in Generator::examples() {
        let mesh = rich_mesh(generator);
        let mut versions = Vec::new();
        for encoding in ply::Encoding::ALL {
            let bytes = ply::encode(&mesh, encoding);
            let decoded = codec::decode(&bytes, Format::Ply).unwrap();
            assert_eq!(decoded.warnings, [], "{generator:?}");
            assert_same(&mesh, &decoded.mesh, true);
            assert_eq!(decoded.mesh.slots, mesh.slots);
            assert_eq!(Format::from_magic(&bytes), Some(Format::Ply));
            versions.push(decoded.mesh);
        }
        assert!(versions.windows(2).all(|pair| pair[0] == pair[1]));
    }
}

#[test]
fn stl_comes_back_in_both_forms() {
    for generator in Generator::examples() {
        let mesh = rich_mesh(generator);
        for bytes in [stl::encode_ascii(&mesh).into_bytes(), stl::encode_binary(&mesh)] {
            let decoded = codec::decode(&bytes, Format::Stl).unwrap();
            // Far from the origin the smallest triangles may have collapsed; then they are named.
            if decoded.warnings.is_empty() {
                assert_same(&mesh, &decoded.mesh, false);
            }
            assert_eq!(Format::from_magic(&bytes), Some(Format::Stl));
        }
        let plain = generator.mesh();
        for bytes in [stl::encode_ascii(&plain).into_bytes(), stl::encode_binary(&plain)] {
            let decoded = stl::decode(&bytes).unwrap();
            assert_eq!(decoded.warnings, []);
            assert_same(&plain, &decoded.mesh, false);
            // Welded: as many positions as there are places.
            let places = luch_mesh::weld::weld_exact(&plain).mesh.positions.len();
            assert_eq!(decoded.mesh.positions.len(), places);
        }
    }
}

#[test]
fn materials_come_back() {
    let texture = mtl::MtlTexture {
        scale: Vec3::new(2.0, 3.0, 1.0),
        offset: Vec3::new(0.25, 0.0, 0.0),
        turbulence: Vec3::X,
        clamp: true,
        blend_u: false,
        bump_multiplier: 0.5,
        base: 0.1,
        gain: 0.9,
        boost: Some(1.5),
        resolution: Some(512),
        channel: Some(mtl::Channel::Luminance),
        kind: Some("sphere".to_owned()),
        color_space: Some("linear".to_owned()),
        ..mtl::MtlTexture::new("some picture 01.png")
    };
    let material = mtl::MtlMaterial {
        name: "a name".to_owned(),
        diffuse: Some(Vec3::new(0.1, 0.2, 1.0 / 3.0)),
        emission: Some(Vec3::splat(20.0)),
        shininess: Some(250.0),
        opacity: Some(0.75),
        illumination_model: Some(7),
        roughness: Some(0.3),
        anisotropy_rotation: Some(0.125),
        diffuse_map: Some(texture.clone()),
        bump_map: Some(mtl::MtlTexture::new("b.png")),
        normal_map: Some(texture),
        ..Default::default()
    };
    let materials = vec![material, mtl::MtlMaterial { name: "empty".to_owned(), ..Default::default() }];
    let file = mtl::decode(mtl::encode(&materials).as_bytes()).unwrap();
    assert_eq!(file.warnings, []);
    assert_eq!(file.materials, materials);
}

/// Small files of every format, to be damaged.
fn samples() -> Vec<(Format, Vec<u8>)> {
    let mesh = rich_mesh(Generator::Cuboid { size: Vec3::ONE, divisions: [1, 1, 1] });
    let mut samples = vec![
        (Format::Obj, obj::encode(&mesh, &obj::EncodeOptions::default()).into_bytes()),
        (Format::Stl, stl::encode_ascii(&mesh).into_bytes()),
        (Format::Stl, stl::encode_binary(&mesh)),
    ];
    samples.extend(ply::Encoding::ALL.map(|encoding| (Format::Ply, ply::encode(&mesh, encoding))));
    let odd = "# all sorts\nmtllib a.mtl b c.mtl\no x\ns 1\nv 0 0 0\nv 1 0 0 1 0 0\nv 1 1 0\nv nan 0 1\nvt 0\nvt 1 1 0\n\
               vn 0 0 1\nf 1/1/1 2/2/1 3//1\ns off\nusemtl m\ng a b\nf -4 -3 -2 \\\n -1\nl 1 2\ncurv 0 1\nf 1 2\n";
    samples.push((Format::Obj, odd.into()));
    let strips = "ply\nformat ascii 1.0\nelement tristrips 1\nproperty list int int vertex_indices\nelement vertex 4\n\
                  property double x\nproperty double y\nproperty double z\nproperty uchar red\nproperty uchar green\n\
                  property uchar blue\nend_header\n5 0 1 2 -1 3\n0 0 0 255 0 0\n1 0 0 0 255 0\n0 1 0 0 0 255\n1 1 1 9 9 9\n";
    samples.push((Format::Ply, strips.into()));
    let polygons = PolygonMesh::from(&mesh);
    for format in [Format::Off, Format::ThreeMf] {
        samples.push((format, codec::encode_polygons(&polygons, format, &Default::default()).unwrap()));
    }
    let tags = "v 0 0 0\nv 3 0 0\nv 3 3 0\nv 0 3 0\nv 1 1 0\nv 2 1 0\nv 2 2 0\nt crease 2/1/0 0 1 2.5\n#luch slot 0 a\n\
                #luch uv 1 0 1\n#luch color 1 0 0 1\n#luch plain\ns 1\n#luch polygon 1 1 2 3 4 | 5 6 7\n\
                #luch uvs 1 1 1 1 1 1 1 1\n#luch colors 1 1 1\nf 1 2 5\nf 1 2 3\nt corner 1/1/0 3 inf\n";
    samples.push((Format::Obj, tags.into()));
    samples
}

/// Whatever comes out must be sound and in proportion to what went in.
fn check(bytes: &[u8], format: Format) -> Result<(), DecodeError> {
    let decoded = codec::decode(bytes, format)?;
    let problems = decoded.mesh.validate();
    assert!(problems.is_empty(), "{problems:?}");
    // A byte of text can name at most one corner, and a corner at most one triangle; packed text is longer than it looks.
    if format != Format::ThreeMf {
        assert!(decoded.mesh.positions.len() + decoded.mesh.triangles.len() <= bytes.len());
    }
    let polygons = codec::decode_polygons(bytes, format)?.mesh;
    assert!(
        polygons.holes.iter().all(|hole| polygons.face(hole.face as usize).contains(&(hole.start as usize)))
    );
    codec::encode_polygons(&polygons, Format::Obj, &Default::default()).unwrap();
    assert!(decoded.warnings.len() <= 110);
    Ok(())
}

#[test]
fn samples_are_valid_to_begin_with() {
    for (format, bytes) in samples() {
        check(&bytes, format).unwrap();
    }
}

#[test]
fn files_cut_off_anywhere() {
    for (format, bytes) in samples() {
        for length in 0..bytes.len() {
            if let Err(error) = check(&bytes[..length], format) {
                assert!(!error.found.is_empty() && !error.expected.is_empty());
            }
        }
        // Binary data and headers must not pass for complete.
        if format == Format::Ply || !bytes.is_ascii() {
            for length in [1, 3, bytes.len() / 2, bytes.len() - 2] {
                assert!(check(&bytes[..length], format).is_err(), "{format:?} of {length} bytes");
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn files_with_flipped_bytes(which in 0usize..11, flips in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6)) {
        let (format, mut bytes) = samples().swap_remove(which);
        for (place, value) in flips {
            let place = place.index(bytes.len());
            bytes[place] = value;
        }
        let _ = check(&bytes, format);
    }

    #[test]
    fn files_put_together_from_words(
        format in prop::sample::select(&Format::ALL[..]),
        words in prop::collection::vec(prop::sample::select(WORDS), 0..120),
    ) {
        let text = words.concat();
        let _ = check(text.as_bytes(), format);
        let _ = mtl::decode(text.as_bytes());
        let headed = format!("ply\nformat ascii 1.0\n{text}");
        let _ = check(headed.as_bytes(), Format::Ply);
    }

    #[test]
    fn bytes_at_random(format in prop::sample::select(&Format::ALL[..]), bytes in prop::collection::vec(any::<u8>(), 0..400)) {
        let _ = check(&bytes, format);
        let _ = mtl::decode(&bytes);
        let _ = Format::from_magic(&bytes);
    }
}

const WORDS: &[&str] = &[
    "v ",
    "vt ",
    "vn ",
    "f ",
    "o ",
    "g ",
    "s ",
    "usemtl ",
    "mtllib ",
    "l ",
    "1 ",
    "2 ",
    "3 ",
    "-1 ",
    "0 ",
    "1/1 ",
    "1//1 ",
    "2/2/2 ",
    "-2/-1/-1 ",
    "0.5 ",
    "1e9 ",
    "nan ",
    "inf ",
    "99999999999999999999 ",
    "4294967295 ",
    "\n",
    "\n",
    "\n",
    "\\\n",
    "\r\n",
    "\t",
    "# ",
    "off ",
    "ply\n",
    "element vertex ",
    "element face ",
    "element tristrips ",
    "element other ",
    "property list uchar int vertex_indices\n",
    "property list int float texcoord\n",
    "property float ",
    "x\n",
    "y\n",
    "z\n",
    "nx\n",
    "red\n",
    "end_header\n",
    "solid ",
    "facet normal ",
    "outer loop\n",
    "vertex ",
    "endloop\n",
    "endfacet\n",
    "endsolid\n",
    "newmtl a\n",
    "Kd ",
    "map_Kd ",
    "-s ",
    "-o ",
    "-bm ",
    "-imfchan ",
    "a.png ",
    "bump ",
    "d ",
    "t crease 2/1/0 ",
    "t corner 1/1/0 ",
    "#luch slot ",
    "#luch uv 1 ",
    "#luch uvs 1 ",
    "#luch color ",
    "#luch colors ",
    "#luch polygon 1 ",
    "#luch plain\n",
    "| ",
    "OFF\n",
    "STCNOFF\n",
    "\u{fffd}",
    "\0",
];

#[test]
fn headers_that_claim_too_much_are_refused_at_once() {
    let claims = [
        "ply\nformat binary_little_endian 1.0\nelement vertex 999999999999\nproperty float x\nproperty float y\nproperty float z\nend_header\n",
        "ply\nformat ascii 1.0\nelement vertex 4000000000\nproperty float x\nproperty float y\nproperty float z\nend_header\n1 2 3\n",
        "ply\nformat ascii 1.0\nelement other 99999999999999999\nproperty list int int a\nend_header\n9",
        "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nelement face 1\nproperty list int int vertex_indices\nend_header\n0 0 0 2000000000 0",
    ];
    for claim in claims {
        let error = codec::decode(claim.as_bytes(), Format::Ply).unwrap_err();
        assert_eq!(error.kind, codec::ErrorKind::Truncated, "{error}");
    }
    let mut stl = vec![0; 84];
    stl[80..].copy_from_slice(&u32::MAX.to_le_bytes());
    assert_eq!(stl::decode(&stl).unwrap_err().kind, codec::ErrorKind::Truncated);
    // An element without properties may be as many as it likes.
    let nothing = "ply\nformat ascii 1.0\nelement face 999999999999999999\nend_header\n";
    assert!(codec::decode(nothing.as_bytes(), Format::Ply).unwrap().mesh.triangles.is_empty());
}

#[test]
fn colors_of_bytes_become_linear_light() {
    let text = "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n\
                property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\nend_header\n\
                0 0 0 255 188 0 51\n";
    let color = ply::decode(text.as_bytes()).unwrap().mesh.colors.values[0];
    // 188 is the byte next to half of the light: 0.5029 by the curve of IEC 61966-2-1.
    assert!((color - Vec4::new(1.0, 0.502_886_5, 0.0, 0.2)).abs().max_element() < 1e-5, "{color}");
    let strip = samples().swap_remove(7).1;
    let mesh = ply::decode(&strip).unwrap().mesh;
    assert_eq!((mesh.face_count(), mesh.positions.len()), (1, 4));
}

#[test]
fn extensions_and_first_bytes() {
    assert_eq!(Format::from_extension("PLY"), Some(Format::Ply));
    assert_eq!(Format::from_extension("3ds"), None);
    assert_eq!(Format::from_magic(b"# Blender\n\nv 0 0 0\n"), Some(Format::Obj));
    assert_eq!(Format::from_magic(b"\x89PNG"), None);
    assert_eq!(Format::from_magic(b""), None);
}

#[test]
fn uv_lists_of_faces_and_flat_uvs_agree() {
    let text = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
                element face 2\nproperty list uchar int vertex_index\nproperty list uchar float texcoord\nend_header\n\
                0 0 0\n1 0 0\n0 1 0\n3 0 1 2 6 0 0 1 0 0 1\n3 0 2 1 0\n";
    let mesh = codec::decode(text.as_bytes(), Format::Ply).unwrap().mesh;
    assert_eq!(mesh.corner_uvs(0, 0).unwrap(), [Vec2::ZERO, Vec2::X, Vec2::Y]);
    assert_eq!(mesh.corner_uvs(1, 0).unwrap(), [Vec2::ZERO; 3]);
}
