//! What several files name is read and held once, by whatever spelling of its path.

use luch_formats::{Files, Loaded, load, load_with};
use luch_image::codec::{Metadata, encode_png8};
use luch_image::{Image, Pixels};
use luch_scene::Texture;
use std::path::{Path, PathBuf};

const MAIN: &str = r#"luch 1
include "parts/materials.kdl"
include "./parts/../parts/more.kdl"
material "here" { diffuse image="wood.png" }
material "there" { diffuse image="parts/../wood.png"; normal-map image="./wood.png" }
object material="here" { sphere }
object material="there" { sphere }
object material="included" { sphere }
object material="included too" { sphere }
import "parts/model.obj"
import "parts/model.gltf"
import "parts/model.xml"
import "parts/other.kdl"
import "another.kdl"
environment 1
"#;
const OTHER: &str = r#"luch 1
import "MODEL" { translate 1 0 0 }
material "m" { diffuse image="PICTURE" }
object material="m" { disc }
"#;
const OBJ: &str = "mtllib model.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl a\nf 1/1 2/2 3/3\nusemtl b\nf 1/1 2/2 3/3\n";
const XML: &str = r#"<scene version="3.0.0"><shape type="sphere"><bsdf type="diffuse">
<texture type="bitmap" name="reflectance"><string name="filename" value="../wood.png"/></texture>
</bsdf></shape></scene>"#;

fn gltf() -> String {
    // One triangle: three positions and three uvs of zero bytes would have no area, so the positions are written out.
    let floats = [0.0_f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0];
    let bytes: String = floats.iter().flat_map(|f| f.to_le_bytes()).map(|b| format!("%{b:02x}")).collect();
    format!(
        r#"{{ "asset": {{ "version": "2.0" }}, "scene": 0, "scenes": [{{ "nodes": [0] }}], "nodes": [{{ "mesh": 0 }}],
        "meshes": [{{ "primitives": [{{ "attributes": {{ "POSITION": 0, "TEXCOORD_0": 1 }}, "material": 0 }}] }}],
        "materials": [{{ "pbrMetallicRoughness": {{ "baseColorTexture": {{ "index": 0 }},
            "metallicRoughnessTexture": {{ "index": 1 }} }} }}],
        "textures": [{{ "source": 0 }}, {{ "source": 1 }}],
        "images": [{{ "uri": "../wood.png" }}, {{ "uri": "../parts/../wood.png" }}],
        "accessors": [{{ "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0] }},
            {{ "bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC2" }}],
        "bufferViews": [{{ "buffer": 0, "byteLength": 36 }}, {{ "buffer": 0, "byteOffset": 36, "byteLength": 24 }}],
        "buffers": [{{ "byteLength": 60, "uri": "data:application/octet-stream,{bytes}" }}] }}"#
    )
}

fn files() -> Vec<(PathBuf, Vec<u8>)> {
    let png = encode_png8(&Image::filled(4, 2, [200, 150, 90]), &Metadata::new()).unwrap();
    let other = |model: &str, picture: &str| OTHER.replace("MODEL", model).replace("PICTURE", picture);
    vec![
        ("main.kdl".into(), MAIN.into()),
        ("wood.png".into(), png),
        (
            "parts/materials.kdl".into(),
            "material \"included\" { diffuse 0.5 image=\"../wood.png\" { scale 2 } }".into(),
        ),
        (
            "parts/more.kdl".into(),
            "texture \"w\" { image \"..\\\\wood.png\" wrap=\"clamp\" }\nmaterial \"included too\" { diffuse texture=\"w\" }".into(),
        ),
        ("parts/model.obj".into(), OBJ.into()),
        (
            "parts/model.mtl".into(),
            "newmtl a\nmap_Kd ../wood.png\nnewmtl b\nmap_Kd ..\\parts\\..\\wood.png\nmap_d ../wood.png\n".into(),
        ),
        ("parts/model.gltf".into(), gltf().into()),
        ("parts/model.xml".into(), XML.into()),
        ("parts/other.kdl".into(), other("model.obj", "../wood.png").into()),
        ("another.kdl".into(), other("parts/model.obj", "wood.png").into()),
    ]
}

fn expect_once(loaded: &Loaded) {
    let scene = &loaded.scene;
    assert_eq!(loaded.warnings, []);
    assert_eq!(scene.images.len(), 1, "one picture for all");
    let pictures = scene.textures.iter().filter(|texture| matches!(texture, Texture::Image { .. })).count();
    assert!(pictures >= 8, "every importer made textures of it: {pictures}");
    let Pixels::U8(pixels) = &scene.images[0].pixels else { panic!("eight bits stay eight bits") };
    assert_eq!((pixels.len(), scene.images[0].memory_bytes()), (8, 32));
    // Three files import the model: they share its mesh.
    let meshes = scene.instances.iter().filter(|instance| instance.materials.len() == 2);
    let shapes: Vec<usize> = meshes.map(|instance| instance.shape.index()).collect();
    assert_eq!(shapes, [shapes[0]; 3]);
}

#[test]
fn pictures_are_held_once_from_memory() {
    expect_once(&load_with(Path::new("main.kdl"), &Files::memory(files())).unwrap());
}

#[test]
fn pictures_are_held_once_from_the_disk() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir(folder.path().join("parts")).unwrap();
    for (path, bytes) in files() {
        std::fs::write(folder.path().join(path), bytes).unwrap();
    }
    expect_once(&load(&folder.path().join("main.kdl")).unwrap());
    // A file is what it is by whatever name.
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink("wood.png", folder.path().join("alias.png")).unwrap();
        let main = MAIN.replace("parts/../wood.png", "alias.png");
        std::fs::write(folder.path().join("main.kdl"), main).unwrap();
        expect_once(&load(&folder.path().join("main.kdl")).unwrap());
    }
}

#[test]
fn a_missing_picture_is_told_once_by_all_scenes_of_kdl() {
    let scene = |rest: &str| {
        format!(
            "luch 1\nmaterial \"m\" {{ diffuse image=\"none.png\" }}\nobject material=\"m\" {{ sphere }}\n{rest}"
        )
    };
    let files = Files::memory([
        ("main.kdl".into(), scene("import \"b.kdl\"\nimport \"c.kdl\"").into()),
        ("b.kdl".into(), scene("").into()),
        ("c.kdl".into(), scene("").into()),
    ]);
    let loaded = load_with(Path::new("main.kdl"), &files).unwrap();
    assert_eq!(loaded.warnings.len(), 1, "{:?}", loaded.warnings);
}
