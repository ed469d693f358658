//! Mesh files: read for their mesh alone, or shown as a scene of clay.

use crate::{Files, LoadError, Loaded, Place, Problem, Warning};
use glam::Affine3A;
use luch_image::Rgb;
use luch_mesh::codec::{self, DecodeError, Format};
use luch_mesh::normals::{self, Weight};
use luch_mesh::{TriangleMesh, measure};
use luch_scene::{ColorValue, Material, Scene, Shape, Surface};
use std::path::Path;

/// Edges bent by less are smooth in meshes without normals: 30°.
pub(crate) const CREASE_ANGLE: f32 = std::f32::consts::FRAC_PI_6;

/// Coordinates farther out leave no room for squares and products.
const FARTHEST: f32 = 1e18;

/// The colour of what has none.
const CLAY: Rgb = Rgb::new(0.72, 0.70, 0.67);

/// A neutral, slightly warm gray.
pub(crate) fn clay() -> Material {
    Material { name: "clay".into(), ..Material::diffuse(CLAY) }
}

/// White, to be coloured by the vertices.
pub(crate) fn vertex_colored() -> Material {
    let color = ColorValue { vertex_color: true, ..ColorValue::constant(Rgb::WHITE) };
    Material { name: "vertex colours".into(), ..Material::new(Surface::Diffuse { color }) }
}

/// Reads a mesh file as a scene: the mesh in its own colours, or in clay.
pub(crate) fn load(path: &Path, files: &Files, format: Format) -> Result<Loaded, LoadError> {
    let mut loaded = Loaded::default();
    let bytes = files.read(path)?;
    let mesh = decode(path, &bytes, format, &mut loaded.warnings)?;
    drop(bytes);
    let (mesh, notes) = with_normals(mesh);
    loaded.notes.extend(notes);
    let material = if mesh.colors.is_empty() {
        loaded.notes.push("no material is given: the mesh is of light gray clay".to_owned());
        clay()
    } else {
        vertex_colored()
    };
    let scene: &mut Scene = &mut loaded.scene;
    let material = scene.add_material(material);
    let shape = scene.add_shape(Shape::Mesh(mesh));
    scene.add_instance(shape, material, Affine3A::IDENTITY);
    Ok(loaded)
}

/// Reads a mesh of any format; one without normals gets them by the crease angle.
pub(crate) fn read(
    path: &Path,
    files: &Files,
    warnings: &mut Vec<Warning>,
) -> Result<TriangleMesh, LoadError> {
    let bytes = files.read(path)?;
    let by_name = path.extension().and_then(|e| e.to_str()).and_then(Format::from_extension);
    let unknown = || {
        Problem::new(path, "is no mesh file")
            .help("accepted are .obj, .ply, .stl, .off, .3mf; whole scenes are imported")
    };
    let format = by_name.or_else(|| Format::from_magic(&bytes)).ok_or_else(unknown)?;
    let mesh = decode(path, &bytes, format, warnings)?;
    drop(bytes);
    Ok(with_normals(mesh).0)
}

/// The mesh in some bytes, checked.
pub(crate) fn decode(
    path: &Path,
    bytes: &[u8],
    format: Format,
    warnings: &mut Vec<Warning>,
) -> Result<TriangleMesh, LoadError> {
    let decoded = codec::decode(bytes, format).map_err(|error| problem(path, bytes, &error))?;
    warnings.extend(decoded.warnings.iter().map(|warning| told(path, bytes, warning)));
    checked(path, decoded.mesh)
}

/// The mesh if it has faces and its numbers are sound.
pub(crate) fn checked(path: &Path, mesh: TriangleMesh) -> Result<TriangleMesh, LoadError> {
    if mesh.triangles.is_empty() {
        return Err(Problem::new(path, "holds no faces: there is nothing to show").into());
    }
    let problems: Vec<Problem> =
        mesh.validate().iter().map(|problem| Problem::new(path, format!("{problem}"))).collect();
    if !problems.is_empty() {
        return Err(LoadError { problems });
    }
    let bounds = measure::bounds(&mesh);
    let farthest = bounds.min.abs().max(bounds.max.abs()).max_element();
    if farthest > FARTHEST {
        let message = format!("reaches {farthest:e} from the origin, at most {FARTHEST:e} is accepted");
        return Err(Problem::new(path, message).into());
    }
    Ok(mesh)
}

/// The mesh with normals, and a note if they were made.
pub(crate) fn with_normals(mut mesh: TriangleMesh) -> (TriangleMesh, Option<String>) {
    if !mesh.normals.is_empty() {
        return (mesh, None);
    }
    mesh.normals = normals::creased(&mesh, CREASE_ANGLE, Weight::Angle);
    (mesh, Some("no normals are given: edges bent by less than 30° are smooth".to_owned()))
}

/// A reader's error as a problem of the file.
pub(crate) fn problem(path: &Path, bytes: &[u8], error: &DecodeError) -> Problem {
    let place = match error.place {
        codec::Place::Text { line, column } => text_place(bytes, line, column),
        codec::Place::Byte { offset } => Place::Byte(offset),
    };
    Problem::new(path, format!("found {}, expected {}", error.found, error.expected)).at(place)
}

/// A reader's warning as one of the file.
pub(crate) fn told(path: &Path, bytes: &[u8], warning: &codec::Warning) -> Warning {
    let told = Warning::new(path, warning.message.clone());
    match warning.line {
        Some(line) => told.at(text_place(bytes, line, 1)),
        None => told,
    }
}

/// A place in a text whose columns are counted in bytes.
fn text_place(bytes: &[u8], line: u64, column: u64) -> Place {
    let content = bytes.split(|&b| b == b'\n').nth(line.saturating_sub(1) as usize).unwrap_or(b"");
    // Long lines are not kept: the mark lies within what is shown.
    let content = &content[..content.len().min(4096)];
    let before = content.len().min(column.saturating_sub(1) as usize);
    let marked = content[before..].split(u8::is_ascii_whitespace).next().unwrap_or(b"");
    Place::Text {
        line: line as usize,
        column: String::from_utf8_lossy(&content[..before]).chars().count() + 1,
        source: String::from_utf8_lossy(content).trim_end().to_owned(),
        length: String::from_utf8_lossy(marked).chars().count().max(1),
    }
}
