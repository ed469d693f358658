//! Real files of other projects: what is valid loads as it should, what is broken is refused with place and reason.
//!
//! The files are looked for in the folder of the environment variable `LUCH_TEST_DATA`, or else beside the workspace.

use std::path::{Path, PathBuf};

use luch_mesh::codec::{self, Format, mtl, obj};
use luch_mesh::{measure, weld};

/// What a file must give: triangles, positions after welding, then either closed with so many pieces and handles, or so
/// many border edges.
enum Expected {
    Closed {
        triangles: usize,
        positions: usize,
        pieces: usize,
        genus: u64,
    },
    Open {
        triangles: usize,
        border: usize,
    },
    /// Loads, but without triangles; a warning holds this text.
    Empty(&'static str),
    /// The error's text.
    Error(&'static str),
}
use Expected::{Closed, Empty, Error, Open};

fn solid(triangles: usize, positions: usize, pieces: usize, genus: u64) -> Expected {
    Closed { triangles, positions, pieces, genus }
}

fn sheet(triangles: usize, border: usize) -> Expected {
    Open { triangles, border }
}

fn table() -> Vec<(&'static str, Expected)> {
    vec![
        // Text and binary, odd line ends, quads.
        ("assimp-ply-stl/PLY/cube.ply", solid(12, 8, 1, 0)),
        ("assimp-ply-stl/PLY/cube_binary.ply", solid(12, 8, 1, 0)),
        ("assimp-ply-stl/PLY/cube_binary_header_with_RN_newline.ply", solid(12, 8, 1, 0)),
        ("assimp-ply-stl/PLY/cube_binary_starts_with_nl.ply", solid(12, 8, 1, 0)),
        ("assimp-ply-stl/PLY/cube_uv.ply", solid(12, 8, 1, 0)),
        ("assimp-ply-stl/PLY/float-color.ply", sheet(1, 3)),
        (
            "assimp-ply-stl/PLY/issue623.ply",
            Error("line 15, column 1: found “7.941797”, expected a whole number"),
        ),
        (
            "assimp-ply-stl/PLY/payload_JVN42386607",
            Error("line 2, column 13: found nothing, expected version 1.0"),
        ),
        ("assimp-ply-stl/PLY/points.ply", Empty("cloud of 4 points")),
        (
            "assimp-ply-stl/invalid/empty.ply",
            Error("line 1, column 1: found the end of the file, expected a header"),
        ),
        (
            "assimp-ply-stl/invalid/crash-30d6d0f7c529b3b66b4131700b7a4580cd7082df.ply",
            Error("line 7, column 1: found “property \\0"),
        ),
        ("tinyply/icosahedron.ply", solid(20, 12, 1, 0)),
        ("tinyply/icosahedron_ascii.ply", solid(20, 12, 1, 0)),
        ("tinyply/sofa_ascii.ply", sheet(24104, 48)),
        ("testball/Mesh000.ply", solid(13312, 6594, 1, 0)),
        ("testball/Mesh002.ply", solid(49920, 24960, 1, 1)),
        ("trimesh/models/fixed_top.ply", solid(4772, 2374, 1, 7)),
        ("trimesh/models/fuze.ply", solid(1000, 502, 1, 0)),
        // More numbers in a line than the header says.
        ("trimesh/models/fuze_ascii.ply", solid(1000, 502, 1, 0)),
        ("trimesh/models/mirror.ply", solid(286, 143, 1, 1)),
        ("trimesh/models/cube_blender_uv_meshlab.ply", solid(12, 8, 1, 0)),
        ("trimesh/models/metadata.ply", sheet(2, 4)),
        ("trimesh/models/emptyIO/ply_empty_header.ply", Empty("neither vertices nor faces")),
        ("trimesh/models/points_ascii_with_lists.ply", Empty("cloud of 5 points")),
        ("trimesh/models/points_emptyface.ply", Empty("cloud of 1024 points")),
        // Text and binary, solids in one file, wrong normals.
        ("assimp-ply-stl/STL/triangle_with_two_solids.stl", sheet(2, 6)),
        ("assimp-ply-stl/STL/triangle_with_empty_solid.stl", sheet(1, 3)),
        ("assimp-ply-stl/STL/formatDetection", sheet(1, 3)),
        ("assimp-ply-stl/STL/sphereWithHole.stl", sheet(285, 9)),
        ("assimp-ply-stl/STL/Spider_ascii.stl", sheet(1312, 72)),
        ("assimp-ply-stl/STL/Spider_binary.stl", sheet(1312, 72)),
        ("assimp-ply-stl/STL/Wuson.stl", sheet(3732, 412)),
        ("trimesh/models/20mm-xyz-cube.stl", solid(260, 132, 1, 0)),
        ("trimesh/models/round.stl", solid(1120, 560, 1, 1)),
        ("trimesh/models/soup.stl", sheet(100, 300)),
        // The lecture's example of an open mesh.
        ("trimesh/models/teapot.stl", sheet(894, 64)),
        ("trimesh/models/two_objects_mixed_case_names.stl", solid(24, 16, 2, 0)),
        ("trimesh/models/octagonal_pocket.stl", sheet(3262, 54)),
        ("trimesh/models/octagonal_pocket.ply", sheet(3262, 54)),
        ("trimesh/models/emptyIO/stl_empty_ascii.stl", Empty("no triangles")),
        ("trimesh/models/emptyIO/stl_empty_bin.stl", Empty("no triangles")),
        // OBJ: quads, negative indices, concave faces, holes by bridges, NaN.
        ("spot/spot.obj", solid(5856, 2930, 1, 0)),
        ("tinyobjloader/models/cube.obj", solid(12, 8, 1, 0)),
        ("tinyobjloader/models/cube-vertexcol.obj", solid(12, 8, 1, 0)),
        ("tinyobjloader/models/cube-vertex-w-component.obj", solid(12, 8, 1, 0)),
        ("tinyobjloader/models/catmark_torus_creases0.obj", solid(64, 32, 1, 1)),
        ("tinyobjloader/models/issue-295-trianguation-failure.obj", solid(28, 16, 1, 0)),
        ("tinyobjloader/models/test-nan.obj", sheet(34, 10)),
        ("tinyobjloader/models/invalid-face-definition.obj", Empty("fewer than three corners")),
        (
            "tinyobjloader/models/invalid-relative-texture-index.obj",
            Error(
                "line 2, column 13: found “1/-2”, expected a reference to one of the 1 texture coordinates",
            ),
        ),
        (
            "tinyobjloader/models/invalid-relative-vertex-index.obj",
            Error("line 1, column 3: found “-4”, expected a reference to one of the 0 vertices"),
        ),
        (
            "tinyobjloader/models/issue-140-zero-face-idx.obj",
            Error("line 16, column 3: found “0/0/0”, expected numbers from 1"),
        ),
        ("tinyobjloader/models/line-prim.obj", Empty("lines (“l”) are skipped")),
        ("tinyobjloader/models/points-prim.obj", Empty("points (“p”) are skipped")),
        ("tinyobjloader/models/smoothing-group-two-squares.obj", sheet(3, 5)),
        ("trimesh/models/negative_indices.obj", solid(12, 8, 1, 0)),
        ("trimesh/models/nancolor.obj", solid(12, 8, 1, 0)),
        ("trimesh/models/jacked.obj", solid(12, 8, 1, 0)),
        ("trimesh/models/rabbit.obj", solid(1252, 644, 9, 0)),
        ("trimesh/models/groups.obj", solid(2308, 1156, 1, 0)),
        ("trimesh/models/wallhole.obj", solid(66, 35, 1, 0)),
        ("trimesh/models/tube.obj", solid(120, 60, 1, 1)),
        ("trimesh/models/polygonfaces.obj", sheet(3, 5)),
        ("trimesh/models/notenoughindices.obj", sheet(1, 3)),
        ("trimesh/models/face_in_group_name.obj", Empty("no faces")),
        ("trimesh/models/face_in_group_name_mid_file.obj", sheet(2, 6)),
        ("trimesh/models/empty.obj", Empty("no faces")),
    ]
}

/// The folder of meshes; says so if there is none.
fn folder() -> Option<PathBuf> {
    let beside = || Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data");
    let folder = std::env::var_os("LUCH_TEST_DATA").map_or_else(beside, PathBuf::from).join("mesh");
    if !folder.is_dir() {
        report("skipped: no test data");
        return None;
    }
    Some(folder)
}

#[allow(clippy::print_stdout, reason = "a skipped test must say so")]
fn report(line: &str) {
    println!("{line}");
}

fn format_of(path: &Path, bytes: &[u8]) -> Format {
    let extension = path.extension().and_then(|e| e.to_str()).unwrap_or("");
    Format::from_extension(extension).or_else(|| Format::from_magic(bytes)).unwrap()
}

#[test]
fn files_give_what_the_table_says() {
    let Some(folder) = folder() else { return };
    for (name, expected) in table() {
        let path = folder.join(name);
        let bytes = std::fs::read(&path).unwrap();
        let result = codec::decode(&bytes, format_of(&path, &bytes));
        let decoded = match (result, &expected) {
            (Err(error), Error(text)) => {
                assert!(error.to_string().starts_with(text), "{name}: {error}");
                continue;
            }
            (Err(error), _) => panic!("{name}: {error}"),
            (Ok(_), Error(text)) => panic!("{name} loaded, but should say: {text}"),
            (Ok(decoded), _) => decoded,
        };
        let mesh = weld::weld_exact(&decoded.mesh).mesh;
        let surface = measure::closedness(&mesh);
        match expected {
            Closed { triangles, positions, pieces, genus } => {
                assert_eq!(mesh.triangles.len(), triangles, "{name}");
                assert_eq!(mesh.positions.len(), positions, "{name}");
                assert_eq!(surface.components, pieces, "{name}");
                assert_eq!(surface.genus, Some(genus), "{name}: {surface}");
                assert!(measure::volume(&mesh) > 0.0, "{name}");
            }
            Open { triangles, border } => {
                assert_eq!(mesh.triangles.len(), triangles, "{name}");
                assert_eq!(surface.boundary.map(|fault| fault.count), Some(border), "{name}: {surface}");
            }
            Empty(text) => {
                assert!(mesh.triangles.is_empty(), "{name}");
                assert!(
                    decoded.warnings.iter().any(|w| w.message.contains(text)),
                    "{name}: {:?}",
                    decoded.warnings
                );
            }
            Error(_) => {}
        }
    }
}

fn walk(folder: &Path, visit: &mut impl FnMut(&Path)) {
    let mut entries: Vec<PathBuf> =
        std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    entries.sort();
    for path in entries {
        if path.is_dir() { walk(&path, visit) } else { visit(&path) }
    }
}

#[test]
fn every_file_loads_or_is_known_to_be_broken() {
    let Some(folder) = folder() else { return };
    let broken: Vec<PathBuf> = table()
        .into_iter()
        .filter(|(_, e)| matches!(e, Error(_)))
        .map(|(name, _)| folder.join(name))
        .collect();
    let mut count = 0;
    walk(&folder, &mut |path| {
        let bytes = std::fs::read(path).unwrap();
        let extension = path.extension().and_then(|e| e.to_str()).unwrap_or("").to_ascii_lowercase();
        if extension == "mtl" {
            let file = mtl::decode(&bytes).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
            assert!(!file.materials.is_empty(), "{}", path.display());
            count += 1;
        } else if Format::from_extension(&extension).is_some() {
            let result = codec::decode(&bytes, format_of(path, &bytes));
            assert_eq!(result.is_err(), broken.iter().any(|b| b == path), "{}: {result:?}", path.display());
            if let Ok(decoded) = result {
                assert_eq!(decoded.mesh.validate(), [], "{}", path.display());
            }
            count += 1;
        }
    });
    assert!(count >= 150, "only {count} files");
}

#[test]
fn two_copies_of_a_model_are_the_same() {
    let Some(folder) = folder() else { return };
    let load = |name: &str| {
        let bytes = std::fs::read(folder.join(name)).unwrap();
        weld::weld_exact(&codec::decode(&bytes, format_of(Path::new(name), &bytes)).unwrap().mesh).mesh
    };
    for (one, other, digits) in [
        ("assimp-ply-stl/STL/Spider_ascii.stl", "assimp-ply-stl/STL/Spider_binary.stl", 1e-6),
        ("tinyply/icosahedron.ply", "tinyply/icosahedron_ascii.ply", 1e-6),
        ("trimesh/models/octagonal_pocket.stl", "trimesh/models/octagonal_pocket.ply", 1e-6),
        ("trimesh/models/fuze.obj", "trimesh/models/fuze.ply", 1e-5),
    ] {
        let (one, other) = (load(one), load(other));
        assert!((measure::area(&one) / measure::area(&other) - 1.0).abs() < digits);
        assert!((measure::volume(&one) / measure::volume(&other) - 1.0).abs() < digits);
    }
}

#[test]
fn names_in_obj_files() {
    let Some(folder) = folder() else { return };
    let models = folder.join("tinyobjloader/models");
    let load = |name: &str| obj::decode(&std::fs::read(models.join(name)).unwrap()).unwrap();
    let cornell = load("cornell_box.obj");
    assert_eq!(cornell.libraries, ["cornell_box.mtl"]);
    assert_eq!(cornell.materials, ["white", "light", "blue", "green", "red"]);
    assert_eq!(cornell.objects.len(), 8);
    assert_eq!(cornell.objects[0].name, "floor");
    let spaces = load("mtl filename with whitespace issue46.obj");
    let names = [
        "invalid-file-without-spaces.mtl",
        "invalid file with spaces.mtl",
        "mtl filename with whitespace issue46.mtl",
    ];
    assert_eq!(spaces.libraries, names);
    assert_eq!(load("mtllib-multiple-files-issue-112.obj").libraries.len(), 3);
    assert_eq!(load("issue-246-usemtl-whitespace.obj").materials, ["1"]);
    let switched = load("issue-235-usemtl-then-o.obj");
    assert_eq!(
        (switched.materials, switched.mesh.slots),
        (vec!["None".to_owned(), "None1".to_owned()], vec![0, 1])
    );
}

#[test]
fn materials_with_every_option() {
    let Some(folder) = folder() else { return };
    let models = folder.join("tinyobjloader/models");
    let load = |name: &str| mtl::decode(&std::fs::read(models.join(name)).unwrap()).unwrap().materials;
    let options = load("texture-options-issue-85.mtl");
    let maps = &options[0];
    assert!(maps.ambient_map.as_ref().unwrap().clamp);
    assert_eq!(maps.diffuse_map.as_ref().unwrap().offset.x, 0.1);
    assert_eq!(maps.specular_map.as_ref().unwrap().scale.y, 0.2);
    assert_eq!(maps.shininess_map.as_ref().unwrap().turbulence.z, 0.3);
    assert_eq!(maps.bump_map.as_ref().unwrap().bump_multiplier, 3.0);
    let bump = options[1].bump_map.as_ref().unwrap();
    assert_eq!((bump.file.as_str(), bump.bump_multiplier), ("bumpmap2.jpg", 1.5));
    assert_eq!(options[2].displacement_map.as_ref().unwrap().kind.as_deref(), Some("cube_back"));
    let spaces = load("texture-filename-with-whitespace.mtl");
    assert_eq!(spaces[0].diffuse_map.as_ref().unwrap().file, "texture 01.png");
    assert_eq!(spaces[1].bump_map.as_ref().unwrap().file, "bump 01.png");
    let pbr = &load("pbr-mat-ext.mtl")[0];
    assert_eq!((pbr.roughness, pbr.metallic, pbr.sheen), (Some(0.2), Some(0.3), Some(0.4)));
    assert_eq!(pbr.normal_map.as_ref().unwrap().file, "normalmap.tex");
    // d wins over Tr, whichever comes first.
    assert!(load("tr-and-d-issue-43.mtl").iter().all(|m| m.opacity == Some(0.75)));
    assert_eq!(load("issue-356-leading-spaces-newmtl.mtl")[0].name, "aaa");
}
