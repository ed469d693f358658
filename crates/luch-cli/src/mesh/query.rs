//! `luch mesh query`: where points are relative to a mesh.

use super::input;
use crate::args::QueryArgs;
use crate::failure::{Failure, Outcome};
use crate::terminal::say;
use glam::Vec3;
use luch::mesh::query::Surface;
use serde_json::json;
use std::io::{BufRead, IsTerminal};

pub(super) fn run(args: &QueryArgs) -> Result<Outcome, Failure> {
    let mesh = input::read(Some(&args.input))?.mesh.triangulate();
    let surface = Surface::new(&mesh);
    let points = points(args)?;
    let distances = surface.signed_distance_of_all(&points);
    for ((point, nearest), distance) in points.iter().zip(surface.nearest_of_all(&points)).zip(distances) {
        let (Some(nearest), Some(distance)) = (nearest, distance) else {
            return Err(Failure::new("the mesh has no triangles, or the point is not finite"));
        };
        let at = nearest.point.to_array();
        if args.json {
            let answer = json!({
                "point": point.to_array(), "distance": distance, "inside": distance < 0.0,
                "nearest": at, "triangle": nearest.triangle, "weights": nearest.weights,
            });
            say(&answer.to_string());
        } else {
            let side = if distance < 0.0 { "inside" } else { "outside" };
            let ([x, y, z], [a, b, c]) = (point.to_array(), at);
            say(&format!(
                "{x} {y} {z}: {side}, distance {distance}, nearest {a} {b} {c} on triangle {}",
                nearest.triangle
            ));
        }
    }
    Ok(Outcome::Done)
}

/// The points of the command line, or of standard input.
fn points(args: &QueryArgs) -> Result<Vec<Vec3>, Failure> {
    if !args.point.is_empty() {
        return args.point.iter().map(|text| point(text).map_err(Failure::usage)).collect();
    }
    let input = std::io::stdin().lock();
    if input.is_terminal() {
        return Err(Failure::usage(
            "no points: give --point X,Y,Z, or lines of three numbers on standard input",
        ));
    }
    let mut points = Vec::new();
    for (number, line) in input.lines().enumerate() {
        let line = line.map_err(|error| Failure::new(format!("standard input: {error}")))?;
        if !line.trim().is_empty() {
            let wrong = |message| Failure::new(format!("standard input, line {}: {message}", number + 1));
            points.push(point(&line).map_err(wrong)?);
        }
    }
    Ok(points)
}

/// `1,2,3` or `1 2 3`.
fn point(text: &str) -> Result<Vec3, String> {
    let numbers: Option<Vec<f32>> =
        text.split([',', ' ', '\t']).filter(|part| !part.is_empty()).map(|part| part.parse().ok()).collect();
    match numbers.as_deref() {
        Some(&[x, y, z]) if Vec3::new(x, y, z).is_finite() => Ok(Vec3::new(x, y, z)),
        _ => Err(format!("“{text}” is no point; write three numbers such as 1,2,3")),
    }
}
