//! Times Loop subdivision of a mesh file: `divide FILE LEVELS THREADS REPEATS`.
//!
//! Prints milliseconds of each repeat, then vertices and triangles, separated by tabs: first a line of ours, then one of the Rust port of
//! OpenSubdiv (places alone, as there). `bench/peers/subdivision.py` runs it beside other programs.

use std::error::Error;
use std::path::Path;
use std::time::Instant;

use luch_mesh::codec::{self, Format};
use luch_mesh::subdivide::{Scheme, Settings, subdivide};
use luch_mesh::{PolygonMesh, TriangleMesh};
use opensubdiv_rs::far::{PrimvarRefiner, TopologyDescriptor, TopologyRefinerFactory, UniformOptions};
use opensubdiv_rs::sdc::{Options, SchemeType, VtxBoundaryInterpolation};

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [file, levels, threads, repeats] = arguments.as_slice() else {
        return Err("usage: divide FILE LEVELS THREADS REPEATS".into());
    };
    let (levels, repeats): (u32, usize) = (levels.parse()?, repeats.parse()?);
    let extension = Path::new(file).extension().and_then(|e| e.to_str()).unwrap_or("");
    let format = Format::from_extension(extension).ok_or("neither OBJ, PLY, STL, OFF nor 3MF")?;
    let decoded = codec::decode(&std::fs::read(file)?, format)?.mesh;
    let mesh = PolygonMesh::from(&TriangleMesh::new(decoded.positions, decoded.triangles));
    let settings = Settings { scheme: Scheme::Loop, levels, ..Settings::default() };
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.parse()?).build()?;
    report(repeats, || {
        let fine = pool.install(|| subdivide(&mesh, &settings))?;
        Ok([fine.positions.len(), fine.face_count()])
    })?;
    report(repeats, || opensubdiv(&mesh, levels as usize))
}

/// Times `work`, which tells how many vertices and triangles it made.
fn report(
    repeats: usize,
    work: impl Fn() -> Result<[usize; 2], Box<dyn Error>>,
) -> Result<(), Box<dyn Error>> {
    let mut line = Vec::new();
    let mut counts = [0; 2];
    for _ in 0..repeats {
        let start = Instant::now();
        counts = work()?;
        line.push(format!("{:.3}", start.elapsed().as_secs_f64() * 1e3));
    }
    line.extend(counts.map(|n| n.to_string()));
    Ok(std::io::Write::write_all(&mut std::io::stdout(), (line.join("\t") + "\n").as_bytes())?)
}

fn opensubdiv(mesh: &PolygonMesh, levels: usize) -> Result<[usize; 2], Box<dyn Error>> {
    let sides: Vec<usize> = (0..mesh.face_count()).map(|face| mesh.face(face).len()).collect();
    let descriptor = TopologyDescriptor::new(mesh.positions.len(), &sides, &mesh.corners);
    let options = Options::new().with_vtx_boundary_interpolation(VtxBoundaryInterpolation::EdgeOnly);
    let mut refiner = TopologyRefinerFactory::create(descriptor, SchemeType::Loop, options)
        .map_err(|e| format!("{e:?}"))?;
    refiner.refine_uniform(UniformOptions::new(levels));
    let primvars = PrimvarRefiner::new(&refiner);
    let mut places: Vec<[f32; 3]> = mesh.positions.iter().map(|p| p.to_array()).collect();
    for level in 1..=levels {
        let mut next = vec![[0.0; 3]; refiner.level(level).num_vertices()];
        primvars.interpolate(level, &places, &mut next);
        places = next;
    }
    Ok([places.len(), refiner.level(levels).num_faces()])
}
