//! Wavefront OBJ with its MTL files as a scene: one mesh, one material for each slot.
//!
//! What becomes of each MTL keyword is written in `docs/importers.md`.

mod material;

use crate::images::{Images, Pictures};
use crate::{Files, LoadError, Loaded, Problem, Warning, bare_mesh};
use glam::Affine3A;
use luch_mesh::codec::mtl::{self, MtlMaterial};
use luch_mesh::codec::obj;
use luch_scene::{Id, Instance, Material, Scene, Shape};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Most material files that one OBJ file may name.
const MOST_LIBRARIES: usize = 256;

/// A material and the file it is from.
struct Found {
    file: PathBuf,
    material: MtlMaterial,
}

/// Reads an OBJ file and the material files it names.
pub(crate) fn load(path: &Path, files: &Files, pictures: Pictures) -> Result<Loaded, LoadError> {
    let bytes = files.read(path)?;
    let file = obj::decode(&bytes).map_err(|error| bare_mesh::problem(path, &bytes, &error))?;
    let mut warnings: Vec<Warning> =
        file.warnings.iter().map(|warning| bare_mesh::told(path, &bytes, warning)).collect();
    // What is not needed any more goes before normals are made, so that it is never beside them in memory.
    let obj::ObjFile { mesh: polygons, materials: names, libraries, .. } = file;
    let triangulation = polygons.triangulation();
    drop((bytes, polygons));
    if triangulation.dropped_faces > 0 {
        let message = format!("{} faces without area are left out", triangulation.dropped_faces);
        warnings.push(Warning::new(path, message));
    }
    if triangulation.fanned_faces > 0 {
        let message = format!("{} concave faces are too large to be cut well", triangulation.fanned_faces);
        warnings.push(Warning::new(path, message));
    }
    let mesh = bare_mesh::checked(path, triangulation.mesh)?;
    let (mesh, note) = bare_mesh::with_normals(mesh);
    let library = library(path, files, &libraries, &mut warnings)?;

    let mut notes: Vec<String> = note.into_iter().collect();
    let mut conversion = material::Conversion::new(Images::new(files, pictures), files);
    let mut scene = Scene::default();
    let mut fallback = None;
    let has_colors = !mesh.colors.is_empty();
    let mut materials: Vec<Id<Material>> = Vec::new();
    let names: &[String] = if names.is_empty() { &[String::new()] } else { &names };
    for name in names {
        let id = match library.get(name.as_str()) {
            Some(found) => conversion.convert(&found.file, &found.material, &mut scene, &mut warnings),
            None => {
                if !name.is_empty() {
                    let message = format!("material \"{name}\" is in none of the material files");
                    warnings.push(Warning::new(path, message).help("light gray clay takes its place"));
                } else if !has_colors {
                    notes.push("faces without a material are of light gray clay".to_owned());
                }
                let neutral = || if has_colors { bare_mesh::vertex_colored() } else { bare_mesh::clay() };
                *fallback.get_or_insert_with(|| scene.add_material(neutral()))
            }
        };
        materials.push(id);
    }
    let shape = scene.add_shape(Shape::Mesh(mesh));
    let placement = Affine3A::IDENTITY;
    scene.instances.push(Instance { name: String::new(), shape, materials, placement });
    Ok(Loaded { scene, warnings, notes, ..Loaded::default() })
}

/// The materials of all files, by name; the first of a name counts.
fn library(
    path: &Path,
    files: &Files,
    names: &[String],
    warnings: &mut Vec<Warning>,
) -> Result<BTreeMap<String, Found>, LoadError> {
    if names.len() > MOST_LIBRARIES {
        let message = format!("names {} material files, at most {MOST_LIBRARIES} are read", names.len());
        return Err(Problem::new(path, message).into());
    }
    let mut library = BTreeMap::new();
    for name in names {
        let file = beside_or_near(files, path, name);
        let bytes = match files.read(&file) {
            Ok(bytes) => bytes,
            Err(problem) => {
                warnings.push(problem.help("its materials are replaced by light gray clay"));
                continue;
            }
        };
        let content = mtl::decode(&bytes).map_err(|error| bare_mesh::problem(&file, &bytes, &error))?;
        warnings.extend(content.warnings.iter().map(|warning| bare_mesh::told(&file, &bytes, warning)));
        for material in content.materials {
            let name = material.name.clone();
            library.entry(name).or_insert(Found { file: file.clone(), material });
        }
    }
    Ok(library)
}

/// The file that `reference` in `file` means. Paths of another machine are tried by their last part.
fn beside_or_near(files: &Files, file: &Path, reference: &str) -> PathBuf {
    let meant = Files::beside(file, reference);
    if !files.has(&meant) {
        let last = reference.rsplit(['/', '\\']).next().unwrap_or(reference);
        let near = Files::beside(file, last);
        if files.has(&near) {
            return near;
        }
    }
    meant
}
