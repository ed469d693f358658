//! Times marching cubes on raw samples: `march FILE COUNT LEVEL THREADS REPEATS`.
//!
//! The file holds COUNT³ single-precision numbers, little-endian, x running fastest. Prints milliseconds of each repeat, then vertices and
//! triangles, separated by tabs. `bench/peers/surfaces.py` runs it beside other programs.

use std::error::Error;
use std::time::Instant;

use luch_mesh::implicit::{Grid, marching_cubes};

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [file, count, level, threads, repeats] = arguments.as_slice() else {
        return Err("usage: march FILE COUNT LEVEL THREADS REPEATS".into());
    };
    let (count, level): (usize, f32) = (count.parse()?, level.parse()?);
    let bytes = std::fs::read(file)?;
    let samples = bytes.as_chunks().0.iter().map(|&sample| f32::from_le_bytes(sample)).collect();
    let grid = Grid::new([count; 3], samples)?;
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.parse()?).build()?;
    let mut line = Vec::new();
    let mut size = [0; 2];
    for _ in 0..repeats.parse::<usize>()? {
        let start = Instant::now();
        let mesh = pool.install(|| marching_cubes(&grid, level))?;
        line.push(format!("{:.3}", start.elapsed().as_secs_f64() * 1e3));
        size = [mesh.positions.len(), mesh.triangles.len()];
    }
    line.extend(size.map(|n| n.to_string()));
    #[allow(clippy::print_stdout)]
    {
        println!("{}", line.join("\t"));
    }
    Ok(())
}
