//! Grids of samples from files: scans, simulations.

use super::told;
use crate::PolygonMesh;
use crate::implicit::{Grid, marching_cubes};
use crate::workshop::{Action, Arguments, Kind, Parameter, Verb, WorkshopError};

/// The surface at a level of a raw file.
pub(super) const VOXELS: Verb = Verb {
    name: "voxels",
    summary: "The surface at a level of samples from a raw file, x running fastest, then y, then z",
    parameters: &[
        Parameter::required("file", Kind::File, "bytes without a header, little-endian"),
        Parameter::required("counts", Kind::Numbers, "samples along x, y and z"),
        Parameter::new("type", Kind::Choice(&["u8", "i16", "u16", "f32", "f64"]), "u8", "what a sample is"),
        Parameter::new("level", Kind::NUMBER, "127.5", "the value at the surface"),
        Parameter::new("spacing", Kind::Size, "1", "distance of samples along x, y and z, in metres"),
        Parameter::new("inside", Kind::Choice(&["above", "below"]), "above", "which samples lie inside"),
        Parameter::new("open", Kind::Flag, "false", "leave the surface open at the border of the grid"),
    ],
    example: "scan.raw --counts 64,64,32 --type u16 --level 300 --spacing 0.5,0.5,1",
    action: Action::Make { closed: true, run: voxels },
};

fn voxels(arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    let bytes = arguments.file("file").unwrap_or_default();
    let whole =
        |count: f64| ((2.0..=65536.0).contains(&count) && count == count.trunc()).then_some(count as usize);
    let counts = match *arguments.numbers("counts") {
        [x, y, z] => [whole(x), whole(y), whole(z)],
        _ => [None; 3],
    };
    let [Some(x), Some(y), Some(z)] = counts else {
        return Err(WorkshopError::of("counts", "takes three whole numbers from 2 to 65536"));
    };
    let values = samples(bytes, arguments.choice("type"));
    let mut grid = Grid::new([x, y, z], values).map_err(told)?;
    grid.spacing = arguments.vector("spacing");
    let mut level = arguments.length("level");
    if arguments.choice("inside") == "above" {
        // Fields are negative inside.
        grid.samples_mut().iter_mut().for_each(|value| *value = -*value);
        level = -level;
    }
    if !arguments.flag("open") {
        grid = grid.closed().map_err(told)?;
    }
    let mesh = marching_cubes(&grid, level).map_err(told)?;
    if mesh.triangles.is_empty() {
        return Err(WorkshopError::of("level", "is reached by no sample or passed by all"));
    }
    Ok(PolygonMesh::from(&mesh))
}

/// Numbers of some type; a last one that is cut off is left out.
fn samples(bytes: &[u8], kind: &str) -> Vec<f32> {
    match kind {
        "u8" => bytes.iter().map(|&b| f32::from(b)).collect(),
        "i16" => bytes.as_chunks().0.iter().map(|&b| f32::from(i16::from_le_bytes(b))).collect(),
        "u16" => bytes.as_chunks().0.iter().map(|&b| f32::from(u16::from_le_bytes(b))).collect(),
        "f32" => bytes.as_chunks().0.iter().map(|&b| f32::from_le_bytes(b)).collect(),
        _ => bytes.as_chunks().0.iter().map(|&b| f64::from_le_bytes(b) as f32).collect(),
    }
}

#[cfg(test)]
mod tests {
    use crate::PolygonMesh;
    use crate::measure;
    use crate::workshop::{Files, Pipeline};

    /// A ball of bytes: 200 inside, 50 outside.
    struct Scan;

    impl Files for Scan {
        fn bytes(&mut self, _: &str) -> Result<Vec<u8>, String> {
            let inside = |x: i32, y: i32, z: i32| (x - 8).pow(2) + (y - 8).pow(2) + (z - 4).pow(2) < 36;
            let cells = (0..8).flat_map(|z| (0..16).flat_map(move |y| (0..16).map(move |x| (x, y, z))));
            Ok(cells.map(|(x, y, z)| if inside(x, y, z) { 200 } else { 50 }).collect())
        }

        fn mesh(&mut self, name: &str) -> Result<PolygonMesh, String> {
            Err(format!("no mesh {name}"))
        }
    }

    #[test]
    fn a_scan_becomes_a_body_cut_off_where_it_ends() {
        let run = |line: &str| Pipeline::parse(line).and_then(|pipeline| pipeline.run(&mut Scan));
        let mesh = run("voxels a.raw --counts 16,16,8").unwrap().triangulate();
        assert_eq!(measure::closedness(&mesh).to_string(), "closed (1 piece, genus 0)");
        assert!(measure::volume(&mesh) > 0.0);
        let open = run("voxels a.raw --counts 16,16,8 --open").unwrap().triangulate();
        assert!(measure::closedness(&open).boundary.is_some());
        assert!(run("voxels a.raw --counts 16,16,9").unwrap_err().to_string().contains("do not fill"));
        assert!(run("voxels a.raw --counts 16,16").unwrap_err().to_string().contains("three whole numbers"));
        assert!(run("voxels a.raw --counts 16,16,8 --level 300").is_err());
    }
}
