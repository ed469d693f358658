//! Scenes as texts in memory.

use luch_formats::{Files, LoadError, Loaded, load_with_parameters};
use luch_image::codec::{Metadata, encode_png8};
use luch_image::{Image, Rgb};
use luch_scene::{Instance, Material, Shape, Surface};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// A triangle with uvs and no normals, in the plane z = 0, facing +Z.
pub(crate) const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n";

/// The files that scenes may name.
pub(crate) fn files(scene: &str) -> Vec<(PathBuf, Vec<u8>)> {
    let picture = encode_png8(&Image::filled(2, 2, [188, 188, 188]), &Metadata::new()).unwrap();
    vec![("s.xml".into(), scene.into()), ("t.obj".into(), TRIANGLE.into()), ("p.png".into(), picture)]
}

/// Loads a scene with whatever is needed around `inside`.
pub(crate) fn load(inside: &str) -> Result<Loaded, LoadError> {
    load_text(&format!("<scene version=\"3.0.0\">\n{inside}\n</scene>"))
}

/// Loads a whole document.
pub(crate) fn load_text(text: &str) -> Result<Loaded, LoadError> {
    load_files(files(text), &[])
}

/// Loads `s.xml` among files, with parameters.
pub(crate) fn load_files(
    files: Vec<(PathBuf, Vec<u8>)>,
    parameters: &[(&str, &str)],
) -> Result<Loaded, LoadError> {
    let parameters: BTreeMap<String, String> =
        parameters.iter().map(|(name, value)| ((*name).to_owned(), (*value).to_owned())).collect();
    load_with_parameters(Path::new("s.xml"), &Files::memory(files), &parameters)
}

/// Loads a scene that must load.
pub(crate) fn sound(inside: &str) -> Loaded {
    let loaded = load(inside).unwrap_or_else(|error| panic!("{inside}\n{error}"));
    assert_eq!(loaded.scene.problems(), [] as [String; 0]);
    loaded
}

/// Loads a scene of which everything is honoured.
pub(crate) fn honoured(inside: &str) -> Loaded {
    let loaded = sound(inside);
    assert_eq!(loaded.warnings, []);
    loaded
}

/// The messages of all warnings, one a line.
pub(crate) fn warnings(loaded: &Loaded) -> String {
    loaded.warnings.iter().map(|warning| format!("{}\n", warning.message)).collect()
}

/// The only instance of a scene, with its shape.
pub(crate) fn only(loaded: &Loaded) -> (&Instance, &Shape) {
    let [instance] = &loaded.scene.instances[..] else { panic!("has one instance") };
    (instance, &loaded.scene.shapes[instance.shape.index()])
}

/// The material that a `rectangle` gets from a bsdf, and the scene around it.
pub(crate) fn material(bsdf: &str) -> (Material, Loaded) {
    let loaded = sound(&format!("<shape type=\"rectangle\">{bsdf}</shape>"));
    let id = only(&loaded).0.materials[0];
    (loaded.scene.materials[id.index()].clone(), loaded)
}

/// The surface of a bsdf that is honoured wholly.
pub(crate) fn surface(bsdf: &str) -> Surface {
    let (material, loaded) = material(bsdf);
    assert_eq!(loaded.warnings, [], "{bsdf}");
    material.surface
}

pub(crate) fn near(color: Rgb, [r, g, b]: [f32; 3]) {
    let off = (color - Rgb::new(r, g, b)).map(f32::abs).max_channel();
    assert!(off < 1e-5, "{color:?}");
}
