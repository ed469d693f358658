//! Times decimation of a mesh file: `decimate FILE TRIANGLES THREADS REPEATS [RESULT.ply]`.
//!
//! Prints milliseconds of each repeat, then vertices, triangles and the largest error of a collapse, separated by tabs; with a last word
//! the result is written. `bench/peers/decimation.py` runs it beside other programs.

use std::error::Error;
use std::path::Path;
use std::time::Instant;

use luch_mesh::PolygonMesh;
use luch_mesh::codec::{self, EncodeOptions, Format};
use luch_mesh::simplify::{Settings, simplify};

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [file, triangles, threads, repeats, results @ ..] = arguments.as_slice() else {
        return Err("usage: decimate FILE TRIANGLES THREADS REPEATS [RESULT.ply]".into());
    };
    let settings = Settings { triangles: triangles.parse()?, ..Settings::default() };
    let extension = Path::new(file).extension().and_then(|e| e.to_str()).unwrap_or("");
    let format = Format::from_extension(extension).ok_or("neither OBJ, PLY, STL, OFF nor 3MF")?;
    let mesh = codec::decode(&std::fs::read(file)?, format)?.mesh;
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.parse()?).build()?;
    let mut line = Vec::new();
    let mut result = None;
    for _ in 0..repeats.parse::<usize>()? {
        let start = Instant::now();
        let simple = pool.install(|| simplify(&mesh, &settings));
        line.push(format!("{:.3}", start.elapsed().as_secs_f64() * 1e3));
        result = Some(simple);
    }
    let simple = result.ok_or("no repeats")?;
    line.extend([simple.mesh.positions.len(), simple.mesh.triangles.len()].map(|n| n.to_string()));
    line.push(format!("{:e}", simple.error));
    if let [path] = results {
        std::fs::write(
            path,
            codec::encode_polygons(&PolygonMesh::from(&simple.mesh), Format::Ply, &EncodeOptions::default())?,
        )?;
    }
    std::io::Write::write_all(&mut std::io::stdout(), (line.join("\t") + "\n").as_bytes())?;
    Ok(())
}
