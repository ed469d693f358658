//! Says what a mesh file holds: `cargo run --example inspect -- teapot.stl`.

use std::path::Path;

use luch_mesh::codec::{self, Format};
use luch_mesh::{measure, weld};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args().nth(1).ok_or("usage: inspect FILE")?;
    let bytes = std::fs::read(&path)?;
    let extension = Path::new(&path).extension().and_then(|e| e.to_str()).unwrap_or("");
    let format = Format::from_extension(extension)
        .or_else(|| Format::from_magic(&bytes))
        .ok_or("neither OBJ, PLY nor STL")?;
    let decoded = codec::decode(&bytes, format).map_err(|error| format!("{path}: {error}"))?;
    let mut report = String::new();
    for warning in &decoded.warnings {
        report += &format!("warning: {warning}\n");
    }
    // Files repeat positions at hard edges and seams: one place, one position.
    let welded = weld::weld_exact(&decoded.mesh);
    let mesh = &welded.mesh;
    report += &format!("triangles  {}\n", mesh.triangles.len());
    report += &format!("positions  {} ({} merged)\n", mesh.positions.len(), welded.merged);
    report += &format!("normals    {}\n", mesh.normals.values.len());
    report += &format!("uvs        {}\n", mesh.uv_sets.first().map_or(0, |uvs| uvs.values.len()));
    report += &format!("area       {:.6}\n", measure::area(mesh));
    report += &format!("volume     {:.6}\n", measure::volume(mesh));
    report += &format!("sharing    saves {:.1} times the memory\n", mesh.memory().saving());
    report += &format!("surface    {}\n", measure::closedness(mesh));
    std::io::Write::write_all(&mut std::io::stdout(), report.as_bytes())?;
    Ok(())
}
