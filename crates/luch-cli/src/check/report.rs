//! What was found, as lines and as JSON.

use super::meshes::MeshReport;
use crate::terminal;
use luch::image::Bitmap;
use luch::scene::{NamedCamera, Projection};
use serde::Serialize;

/// Everything that was found.
#[derive(Debug, Serialize)]
pub(crate) struct Report {
    pub(crate) file: String,
    pub(crate) counts: Counts,
    /// Least and greatest corner, metres.
    pub(crate) bounds: Option<[[f32; 3]; 2]>,
    pub(crate) memory: Memory,
    pub(crate) picture: [u32; 2],
    pub(crate) samples: Option<u64>,
    pub(crate) cameras: Vec<CameraReport>,
    pub(crate) textures: Vec<TextureReport>,
    pub(crate) meshes: Vec<MeshReport>,
    /// What the file holds that is not honoured, or lacks.
    pub(crate) warnings: Vec<String>,
    /// What was chosen for it.
    pub(crate) notes: Vec<String>,
    /// What is odd, though it can be rendered.
    pub(crate) advice: Vec<String>,
}

/// How many of each there are.
#[derive(Debug, Serialize)]
pub(crate) struct Counts {
    pub(crate) shapes: usize,
    pub(crate) triangles: u64,
    pub(crate) instances: usize,
    /// Every instance's triangles counted.
    pub(crate) triangles_seen: u64,
    pub(crate) materials: usize,
    pub(crate) textures: usize,
    pub(crate) images: usize,
    pub(crate) lights: usize,
    pub(crate) shining_objects: usize,
    pub(crate) has_environment: bool,
    pub(crate) cameras: usize,
}

/// Estimated bytes while rendering.
#[derive(Debug, Serialize)]
pub(crate) struct Memory {
    pub(crate) meshes: u64,
    pub(crate) trees: u64,
    pub(crate) images: u64,
    pub(crate) film: u64,
}

/// A camera in people's units.
#[derive(Debug, Serialize)]
pub(crate) struct CameraReport {
    pub(crate) name: String,
    pub(crate) position: [f32; 3],
    /// Vertical field of view in degrees; `None` for parallel rays.
    pub(crate) field_of_view: Option<f32>,
}

impl CameraReport {
    pub(crate) fn of(named: &NamedCamera) -> Self {
        let field_of_view = match named.camera.projection {
            Projection::Perspective { field_of_view_y } => Some(field_of_view_y.to_degrees()),
            Projection::Orthographic { .. } => None,
        };
        Self { name: named.name.clone(), position: named.camera.position.to_array(), field_of_view }
    }
}

/// A picture that is used as texture or surroundings.
#[derive(Debug, Serialize)]
pub(crate) struct TextureReport {
    pub(crate) width: u32,
    pub(crate) height: u32,
    pub(crate) bytes: u64,
}

impl TextureReport {
    pub(crate) fn of(image: &Bitmap) -> Self {
        Self { width: image.width, height: image.height, bytes: image.memory_bytes() as u64 }
    }
}

impl Report {
    /// For people.
    pub(crate) fn lines(&self) -> Vec<String> {
        let Counts { shapes, triangles, instances, triangles_seen, .. } = self.counts;
        let Counts { materials, textures, images, lights, shining_objects, has_environment, cameras, .. } =
            self.counts;
        let surroundings = if has_environment { "yes" } else { "none" };
        let mut lines = vec![
            self.file.clone(),
            format!("  shapes       {shapes}, {triangles} triangles"),
            format!("  objects      {instances}, {triangles_seen} triangles with every object's counted"),
            format!("  materials    {materials}"),
            format!("  textures     {textures}, of {images} pictures"),
            format!(
                "  lights       {lights}, and {shining_objects} shining objects; surroundings: {surroundings}"
            ),
            format!("  cameras      {cameras}"),
        ];
        for CameraReport { name, position: [x, y, z], field_of_view } in &self.cameras {
            let lens = field_of_view
                .map_or("parallel rays".to_owned(), |angle| format!("field of view {angle:.1}°"));
            let name = if name.is_empty() { "without a name" } else { &format!("\"{name}\"") };
            lines.push(format!("    {name} at ({x}, {y}, {z}), {lens}"));
        }
        for TextureReport { width, height, bytes } in &self.textures {
            lines.push(format!("    picture {width}×{height}, {}", terminal::bytes(*bytes)));
        }
        if let Some([[a, b, c], [x, y, z]]) = self.bounds {
            let metres = |values: [f32; 3]| values.map(|v| terminal::short(f64::from(v)));
            let [least, most] = [[a, b, c], [x, y, z]].map(|corner| metres(corner).join(", "));
            lines.push(format!("  bounds       ({least}) to ({most})"));
            lines.push(format!("  size         {} m", metres([x - a, y - b, z - c]).join(" × ")));
        }
        let [width, height] = self.picture;
        let samples = self.samples.map_or(String::new(), |samples| format!(", {samples} samples per pixel"));
        lines.push(format!("  picture      {width}×{height}{samples}"));
        let Memory { meshes, trees, images, film } = self.memory;
        lines.push(format!(
            "  memory       about {}: meshes {}, trees {}, pictures {}, film {}",
            terminal::bytes(meshes + trees + images + film),
            terminal::bytes(meshes),
            terminal::bytes(trees),
            terminal::bytes(images),
            terminal::bytes(film),
        ));
        if !self.meshes.is_empty() {
            lines.push("  meshes".to_owned());
            lines.extend(self.meshes.iter().map(|mesh| format!("    {}", mesh.line())));
        }
        let told = [("warning", &self.warnings), ("note", &self.notes), ("advice", &self.advice)];
        for (kind, texts) in told {
            lines.extend(texts.iter().map(|text| format!("{kind}: {text}")));
        }
        lines
    }
}
