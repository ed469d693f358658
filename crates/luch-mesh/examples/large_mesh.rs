//! Writes a ball of about ten million triangles, or as many as are asked for:
//! `cargo run --release --example large_mesh -- ball.stl 10000000`.

use std::path::Path;
use std::time::Instant;

use luch_mesh::codec::{self, EncodeOptions, Format};
use luch_mesh::{PolygonMesh, generate};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut words = std::env::args().skip(1);
    let path = words.next().ok_or("usage: large_mesh FILE [TRIANGLES]")?;
    let triangles: f64 = words.next().map_or(Ok(1e7), |word| word.parse())?;
    let extension = Path::new(&path).extension().and_then(|e| e.to_str()).unwrap_or("");
    let format = Format::from_extension(extension).ok_or("name a .obj, .ply, .stl, .off, .3mf or .glb")?;
    let rings = (triangles / 2.0).sqrt() as u32;
    let mut mesh = generate::sphere(1.0, rings, rings);
    (mesh.normals, mesh.uv_sets) = Default::default();
    let start = Instant::now();
    let bytes = codec::encode_polygons(&PolygonMesh::from(&mesh), format, &EncodeOptions::default())?;
    let line = format!(
        "{} triangles, {} bytes, encoded in {:.3?}\n",
        mesh.triangles.len(),
        bytes.len(),
        start.elapsed()
    );
    std::fs::write(path, bytes)?;
    std::io::Write::write_all(&mut std::io::stdout(), line.as_bytes())?;
    Ok(())
}
