//! The writer: positions, uvs and normals with their own index sets, just as the mesh has them.

use std::fmt::Write;

use glam::Vec4;

use crate::TriangleMesh;

/// What an OBJ file says besides the mesh.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct EncodeOptions {
    /// The name of the material file; none means no `mtllib` line.
    pub library: Option<String>,
    /// The name of each material slot. Slots beyond are called `slot` and their number.
    pub materials: Vec<String>,
}

/// Writes a mesh. Numbers are the shortest that read back as the same `f32`.
///
/// Lost: tangents, uv sets but the first, colours that are not one per position.
pub fn encode(mesh: &TriangleMesh, options: &EncodeOptions) -> String {
    let mut text = String::new();
    // Writing to a string cannot fail.
    let _ = write_all(&mut text, mesh, options);
    text
}

fn write_all(text: &mut String, mesh: &TriangleMesh, options: &EncodeOptions) -> std::fmt::Result {
    if let Some(library) = &options.library {
        writeln!(text, "mtllib {library}")?;
    }
    let colors: &[Vec4] = if mesh.colors.triangles.is_empty() { &mesh.colors.values } else { &[] };
    for (i, p) in mesh.positions.iter().enumerate() {
        write!(text, "v {} {} {}", p.x, p.y, p.z)?;
        if let Some(c) = colors.get(i) {
            write!(text, " {} {} {} {}", c.x, c.y, c.z, c.w)?;
        }
        text.push('\n');
    }
    let uvs = mesh.uv_sets.first().filter(|uvs| !uvs.is_empty());
    for uv in uvs.iter().flat_map(|uvs| &uvs.values) {
        writeln!(text, "vt {} {}", uv.x, uv.y)?;
    }
    for n in &mesh.normals.values {
        writeln!(text, "vn {} {} {}", n.x, n.y, n.z)?;
    }
    let uv_corners = uvs.map(|uvs| uvs.corner_indices(&mesh.triangles));
    let normal_corners = (!mesh.normals.is_empty()).then(|| mesh.normals.corner_indices(&mesh.triangles));
    let mut slot = None;
    for (t, corners) in mesh.triangles.iter().enumerate() {
        if slot != Some(mesh.slot(t)) && (!mesh.slots.is_empty() || !options.materials.is_empty()) {
            let number = mesh.slot(t);
            match options.materials.get(usize::from(number)) {
                Some(name) => writeln!(text, "usemtl {name}")?,
                None => writeln!(text, "usemtl slot{number}")?,
            }
            slot = Some(number);
        }
        text.push('f');
        for k in 0..3 {
            write!(text, " {}", u64::from(corners[k]) + 1)?;
            let uv = uv_corners.map(|list| u64::from(list[t][k]) + 1);
            let normal = normal_corners.map(|list| u64::from(list[t][k]) + 1);
            match (uv, normal) {
                (Some(uv), Some(normal)) => write!(text, "/{uv}/{normal}")?,
                (Some(uv), None) => write!(text, "/{uv}")?,
                (None, Some(normal)) => write!(text, "//{normal}")?,
                (None, None) => {}
            }
        }
        text.push('\n');
    }
    Ok(())
}
