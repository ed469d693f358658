//! What a file uses beyond the core format: what is read, what is named in a warning, what ends the import.

use super::json::{Json, short};
use super::notices::Notices;
use crate::Problem;
use serde_json::Value;

/// Extensions that are honoured.
const READ: [&str; 10] = [
    "EXT_mesh_gpu_instancing",
    "KHR_lights_punctual",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_specular",
    "KHR_materials_transmission",
    "KHR_materials_unlit",
    "KHR_materials_volume",
    "KHR_mesh_quantization",
    "KHR_texture_transform",
];

/// Extensions that hide geometry in a form that is not decoded.
const COMPRESSION: [&str; 3] =
    ["EXT_meshopt_compression", "KHR_draco_mesh_compression", "KHR_meshopt_compression"];

/// Extensions whose absence changes the look, not the form: a file may require them and is read all the same.
const LOOK: [&str; 6] = [
    "EXT_texture_webp",
    "KHR_animation_pointer",
    "KHR_texture_basisu",
    "KHR_xmp_json_ld",
    "MSFT_texture_dds",
    "EXT_texture_avif",
];

/// Extensions that say nothing about the picture.
const SILENT: [&str; 2] = ["KHR_xmp", "KHR_xmp_json_ld"];

fn is_look(name: &str) -> bool {
    LOOK.contains(&name) || name.starts_with("KHR_materials_")
}

/// Refuses a file that requires what cannot be done without.
pub(super) fn check_required(root: &Json) -> Result<(), Problem> {
    for entry in root.list("extensionsRequired")?.iter() {
        let name = entry.text()?;
        if COMPRESSION.contains(&name) {
            let message = format!(
                "the file requires \"{name}\": its geometry is compressed in a way that is not decoded"
            );
            return Err(entry.problem(message).help("save the file without mesh compression"));
        }
        if !READ.contains(&name) && !is_look(name) {
            let message = format!("the file requires the extension \"{}\", which is not known", short(name));
            return Err(entry.problem(message).help(format!("known are {}", READ.join(", "))));
        }
    }
    Ok(())
}

/// Names everything that is in the file but not honoured.
pub(super) fn name_ignored(root: &Json, value: &Value, notices: &mut Notices) -> Result<(), Problem> {
    let animations = root.list("animations")?;
    if !animations.is_empty() {
        let message = format!("{} animations are not played; the file's own pose is shown", animations.len());
        notices.add(animations.path(), message);
    }
    walk(value, &mut String::new(), notices);
    Ok(())
}

/// Finds every "extensions" object. The parser limits the depth of documents to 128.
fn walk(value: &Value, path: &mut String, notices: &mut Notices) {
    let length = path.len();
    match value {
        Value::Array(items) => {
            for (place, item) in
                items.iter().enumerate().filter(|(_, item)| item.is_array() || item.is_object())
            {
                path.push_str(&format!("/{place}"));
                walk(item, path, notices);
                path.truncate(length);
            }
        }
        Value::Object(object) => {
            for (key, item) in object.iter().filter(|(key, _)| *key != "extras") {
                path.push('/');
                path.push_str(&key.replace('~', "~0").replace('/', "~1"));
                if key == "extensions" {
                    name_extensions(item, path, notices);
                }
                walk(item, path, notices);
                path.truncate(length);
            }
        }
        _ => {}
    }
}

fn name_extensions(extensions: &Value, path: &str, notices: &mut Notices) {
    for name in extensions.as_object().into_iter().flat_map(|object| object.keys()) {
        if !READ.contains(&name.as_str()) && !SILENT.contains(&name.as_str()) {
            notices.add(
                &format!("{path}/{}", short(name)),
                format!("the extension \"{}\" is not honoured", short(name)),
            );
        }
    }
}
