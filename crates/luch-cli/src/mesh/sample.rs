//! `luch mesh sample`: points on a surface.

use super::input;
use crate::args::SampleArgs;
use crate::failure::{Failure, Outcome};
use crate::terminal::say;
use luch::formats::write_atomically;
use luch::mesh::scatter::{self, Scattered};
use std::fmt::Write;
use std::path::Path;

pub(super) fn run(args: &SampleArgs) -> Result<Outcome, Failure> {
    let mesh = input::read(args.input.as_deref())?.mesh.triangulate();
    let count = args.count as usize;
    let points = match args.blue_noise {
        true => scatter::even(&mesh, count, args.seed),
        false => scatter::uniform(&mesh, count, args.seed),
    };
    if points.is_empty() {
        return Err(Failure::new("the mesh has no area to put points on"));
    }
    match &args.output {
        None => say(lines(&points).trim_end()),
        Some(path) => write_atomically(path, &encoded(path, &points)?)?,
    }
    Ok(Outcome::Done)
}

/// `x,y,z,nx,ny,nz` for each point.
fn lines(points: &[Scattered]) -> String {
    points.iter().fold(String::new(), |mut text, point| {
        let ([x, y, z], [a, b, c]) = (point.position.to_array(), point.normal.to_array());
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{x},{y},{z},{a},{b},{c}");
        text
    })
}

fn encoded(path: &Path, points: &[Scattered]) -> Result<Vec<u8>, Failure> {
    match path.extension().and_then(|extension| extension.to_str()) {
        Some("csv") => Ok(format!("x,y,z,nx,ny,nz\n{}", lines(points)).into_bytes()),
        Some("ply") => {
            let mut bytes =
                format!("ply\nformat binary_little_endian 1.0\nelement vertex {}\n", points.len());
            for name in ["x", "y", "z", "nx", "ny", "nz"] {
                let _ = writeln!(bytes, "property float {name}");
            }
            bytes.push_str("end_header\n");
            let mut bytes = bytes.into_bytes();
            for point in points {
                let numbers = point.position.to_array().into_iter().chain(point.normal.to_array());
                bytes.extend(numbers.flat_map(f32::to_le_bytes));
            }
            Ok(bytes)
        }
        _ => Err(Failure::usage(format!("{}: points are written as .ply or .csv", path.display()))),
    }
}
