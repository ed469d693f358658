//! The writer.

use super::LengthUnit;
use super::packet::pack;
use crate::TriangleMesh;
use crate::codec::error::EncodeError;
use crate::codec::text::{put_f32, put_integer, write_rows};

/// What a 3MF file says besides the mesh.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct EncodeOptions {
    /// The name of each material slot. Slots beyond are called `slot` and their number.
    pub materials: Vec<String>,
    /// What the numbers of the mesh are taken for. They are written as they are.
    pub unit: LengthUnit,
}

const TYPES: &str = concat!(
    r#"<?xml version="1.0" encoding="UTF-8"?>"#,
    "\n",
    r#"<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">"#,
    r#"<Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/>"#,
    r#"<Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/></Types>"#
);
const RELATIONS: &str = concat!(
    r#"<?xml version="1.0" encoding="UTF-8"?>"#,
    "\n",
    r#"<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">"#,
    r#"<Relationship Id="rel0" Target="/3D/3dmodel.model" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/>"#,
    r#"</Relationships>"#
);

/// Writes a mesh as one object. Numbers are the shortest that read back as the same `f32`.
///
/// Lost: normals, uvs, tangents, colours, triangles with a repeated corner.
///
/// # Errors
/// If the mesh has [problems](TriangleMesh::validate) or the file would pass 4 GiB.
pub fn encode(mesh: &TriangleMesh, options: &EncodeOptions) -> Result<Vec<u8>, EncodeError> {
    if let Some(problem) = mesh.validate().first() {
        return Err(EncodeError::Broken(problem.to_string()));
    }
    let mut text = Vec::new();
    let head = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<model unit=\"{}\" xml:lang=\"en-US\" \
         xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\">\n<resources>\n",
        options.unit.name()
    );
    text.extend(head.bytes());
    let slot_count =
        options.materials.len().max(mesh.slots.iter().max().map_or(0, |most| usize::from(*most) + 1));
    if slot_count > 0 {
        text.extend(b"<basematerials id=\"2\">\n");
        for slot in 0..slot_count {
            let name =
                options.materials.get(slot).map_or_else(|| format!("slot{slot}"), |name| escaped(name));
            text.extend(format!("<base name=\"{name}\" displaycolor=\"#B8B3ABFF\"/>\n").bytes());
        }
        text.extend(b"</basematerials>\n");
    }
    let default = if slot_count > 0 { " pid=\"2\" pindex=\"0\"" } else { "" };
    text.extend(format!("<object id=\"1\" type=\"model\"{default}>\n<mesh>\n<vertices>\n").bytes());
    write_rows(&mut text, mesh.positions.len(), |vertex, text| {
        text.extend(b"<vertex");
        for (name, number) in ["x", "y", "z"].into_iter().zip(mesh.positions[vertex].to_array()) {
            text.push(b' ');
            text.extend_from_slice(name.as_bytes());
            text.extend_from_slice(b"=\"");
            put_f32(text, number);
            text.push(b'"');
        }
        text.extend(b"/>\n");
    });
    text.extend(b"</vertices>\n<triangles>\n");
    write_rows(&mut text, mesh.triangles.len(), |triangle, text| {
        let [a, b, c] = mesh.triangles[triangle];
        if a == b || b == c || c == a {
            // The format forbids repeated corners.
            return;
        }
        text.extend(b"<triangle");
        for (name, corner) in ["v1", "v2", "v3"].into_iter().zip(mesh.triangles[triangle]) {
            put_attribute(text, name, corner);
        }
        if mesh.slot(triangle) > 0 {
            put_attribute(text, "pid", 2);
            put_attribute(text, "p1", mesh.slot(triangle).into());
        }
        text.extend(b"/>\n");
    });
    text.extend(b"</triangles>\n</mesh>\n</object>\n</resources>\n<build>\n<item objectid=\"1\"/>\n</build>\n</model>\n");
    pack(&[
        ("[Content_Types].xml", TYPES.into()),
        ("_rels/.rels", RELATIONS.into()),
        ("3D/3dmodel.model", text),
    ])
}

fn put_attribute(text: &mut Vec<u8>, name: &str, number: u32) {
    text.push(b' ');
    text.extend_from_slice(name.as_bytes());
    text.extend_from_slice(b"=\"");
    put_integer(text, number.into());
    text.push(b'"');
}

/// Text as it can stand in an attribute; characters that XML forbids become spaces.
fn escaped(text: &str) -> String {
    let mut escaped = String::new();
    for character in text.chars() {
        match character {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '"' => escaped.push_str("&quot;"),
            '\u{0}'..='\u{1f}' | '\u{fffe}' | '\u{ffff}' => escaped.push(' '),
            _ => escaped.push(character),
        }
    }
    escaped
}
