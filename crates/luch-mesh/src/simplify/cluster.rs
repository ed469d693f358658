//! Clustering (Rossignac and Borrel 1993): all vertices in one cell of a grid become one.

use std::collections::HashMap;

use glam::DVec3;

use super::Simplified;
use crate::{TriangleMesh, clean, weld};

/// The most cells along the longest side.
pub const MOST_CELLS: u32 = 1 << 20;

/// Merges the vertices of each cell of a grid with `cells` cells along the longest side of the bounds into the one nearest to
/// their mean; triangles that collapse or double go. Topology is not kept. The error is the diagonal of a cell.
pub fn cluster(mesh: &TriangleMesh, cells: u32) -> Simplified {
    let bounds = mesh.bounds();
    let (low, high) = (bounds.min.as_dvec3(), bounds.max.as_dvec3());
    let side = (high - low).max_element() / f64::from(cells.clamp(1, MOST_CELLS));
    let has_size = side > 0.0 && side.is_finite();
    if !has_size || !mesh.validate().is_empty() {
        return Simplified { mesh: mesh.clone(), error: 0.0 };
    }
    let mesh = weld::weld_exact(mesh).mesh;
    let mut numbers: HashMap<[u32; 3], u32> = HashMap::new();
    let mut sums: Vec<(DVec3, f64)> = Vec::new();
    let mut cluster_of = Vec::with_capacity(mesh.positions.len());
    for position in &mesh.positions {
        let place = position.as_dvec3();
        let cell = ((place - low) / side).floor().to_array().map(|x| x as u32);
        let number = *numbers.entry(cell).or_insert(sums.len() as u32);
        if number as usize == sums.len() {
            sums.push((DVec3::ZERO, 0.0));
        }
        sums[number as usize].0 += place;
        sums[number as usize].1 += 1.0;
        cluster_of.push(number);
    }
    let mut nearest = vec![(f64::INFINITY, 0); sums.len()];
    for (vertex, &number) in cluster_of.iter().enumerate() {
        let (sum, count) = sums[number as usize];
        let distance = (sum / count).distance_squared(mesh.positions[vertex].as_dvec3());
        if distance < nearest[number as usize].0 {
            nearest[number as usize] = (distance, vertex as u32);
        }
    }
    let mut detached = mesh.clone();
    detach(&mut detached);
    for triangle in &mut detached.triangles {
        *triangle = triangle.map(|v| nearest[cluster_of[v as usize] as usize].1);
    }
    let merged = clean::remove_collapsed(&detached).mesh;
    let kept = clean::remove_unused_positions(&without_doubles(&merged)).mesh;
    Simplified { mesh: kept, error: side * 3f64.sqrt() }
}

/// Corners keep their own values, whatever position they move to.
fn detach(mesh: &mut TriangleMesh) {
    fn own<T>(attribute: &mut crate::Attribute<T>, triangles: &[[u32; 3]]) {
        if !attribute.values.is_empty() && attribute.triangles.is_empty() {
            attribute.triangles = triangles.to_vec();
        }
    }
    own(&mut mesh.normals, &mesh.triangles);
    own(&mut mesh.tangents, &mesh.triangles);
    own(&mut mesh.colors, &mesh.triangles);
    mesh.uv_sets.iter_mut().for_each(|uvs| own(uvs, &mesh.triangles));
}

/// Without the later ones of triangles with the same corners and winding.
fn without_doubles(mesh: &TriangleMesh) -> TriangleMesh {
    let key = |triangle: &[u32; 3]| {
        let mut corners = *triangle;
        let least = (0..3).min_by_key(|&k| corners[k]).unwrap_or(0);
        corners.rotate_left(least);
        corners
    };
    let mut keys: Vec<([u32; 3], u32)> =
        mesh.triangles.iter().enumerate().map(|(t, triangle)| (key(triangle), t as u32)).collect();
    keys.sort_unstable();
    let mut marked = mesh.clone();
    for pair in keys.windows(2) {
        if pair[0].0 == pair[1].0 {
            marked.triangles[pair[1].1 as usize] = [0; 3];
        }
    }
    clean::remove_collapsed(&marked).mesh
}
