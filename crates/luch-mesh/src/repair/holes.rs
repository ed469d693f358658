//! Filling holes: each border loop gets faces.
//!
//! Small loops get the triangles of least area (Barequet and Sharir 1995, "Filling gaps in the boundary of a polyhedron"; Liepa
//! 2003, "Filling holes in meshes"), by dynamic programming over where the triangle on each chord has its tip. Chords that are
//! edges already are not used, lest an edge get three faces. Long loops become one polygon.

use std::collections::HashSet;

use glam::DVec3;

use super::{Repaired, faces, sound};
use crate::PolygonMesh;
use crate::polygon_mesh::{CornerAttribute, HalfEdges};

/// How holes are filled.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Filling {
    /// By the triangles of least area if the loop has no more than [`MOST_CORNERS`] corners, else by a polygon.
    #[default]
    LeastArea,
    /// By one polygon.
    Polygon,
    /// By a fan of triangles about a new vertex in the middle.
    Fan,
}

/// The most corners of a loop that is filled by least area; the time is cubic.
pub const MOST_CORNERS: usize = 160;
/// The most triangles to be looked at in all loops together.
const MOST_WORK: usize = 1 << 28;

/// Fills the holes whose border has at most `most_edges` edges. Borders must be consistently wound: see [`super::orient`].
/// New faces have the uvs and colours of the border, flat normals, and the material of a neighbour. The count is that
/// of filled holes.
pub fn fill_holes(mesh: &PolygonMesh, filling: Filling, most_edges: usize) -> Repaired {
    let mut mesh = sound(mesh).mesh;
    let half_edges = HalfEdges::new(&mesh);
    let loops = border_loops(&mesh, &half_edges);
    let mut edges: HashSet<[u32; 2]> = half_edges.edges().map(|edge| edge.vertices).collect();
    faces::detach(&mut mesh);
    let mut work = 0;
    let mut count = 0;
    for halves in loops {
        if halves.len() < 3 || halves.len() > most_edges {
            continue;
        }
        count += 1;
        let cost = halves.len().saturating_pow(3) / 6;
        let triangles =
            if filling == Filling::LeastArea && halves.len() <= MOST_CORNERS && work + cost <= MOST_WORK {
                work += cost;
                let vertices: Vec<u32> = halves.iter().map(|&half| mesh.corners[half as usize]).collect();
                least_area(&mesh, &vertices, &edges)
            } else {
                None
            };
        match triangles {
            Some(triangles) => {
                for triangle in triangles {
                    let [a, b, c] = triangle.map(|i| mesh.corners[halves[i] as usize]);
                    edges.extend([[a, b], [b, c], [c, a]].map(|[p, q]| [p.min(q), p.max(q)]));
                    add_face(&mut mesh, &half_edges, &triangle.map(|i| halves[i]));
                }
            }
            None if filling == Filling::Fan && halves.len() > 3 => add_fan(&mut mesh, &half_edges, &halves),
            None => add_face(&mut mesh, &half_edges, &halves),
        }
    }
    Repaired { mesh, count }
}

/// The corners at the starts of border half-edges, loop by loop, in the order of a face that would fill it.
fn border_loops(mesh: &PolygonMesh, half_edges: &HalfEdges) -> Vec<Vec<u32>> {
    let opposites = half_edges.opposites();
    let mut is_border = vec![false; mesh.corners.len()];
    for edge in half_edges.edges() {
        if let &[half] = edge.half_edges {
            is_border[half as usize] = true;
        }
    }
    let mut is_done = vec![false; mesh.corners.len()];
    let mut loops = Vec::new();
    for first in 0..mesh.corners.len() as u32 {
        if !is_border[first as usize] || is_done[first as usize] {
            continue;
        }
        let mut halves = Vec::new();
        let mut half = first;
        let is_closed = loop {
            if std::mem::replace(&mut is_done[half as usize], true) {
                break half == first;
            }
            halves.push(half);
            // Around the end of this half-edge to the next border.
            let mut next = half_edges.next(half);
            let mut turns = 0;
            while let Some(opposite) = opposites[next as usize] {
                next = half_edges.next(opposite);
                turns += 1;
                if turns > mesh.corners.len() {
                    break;
                }
            }
            if !is_border[next as usize] {
                break false;
            }
            half = next;
        };
        let mut vertices: Vec<u32> = halves.iter().map(|&half| mesh.corners[half as usize]).collect();
        vertices.sort_unstable();
        // A loop through a vertex twice is no simple border.
        if is_closed && vertices.windows(2).all(|pair| pair[0] != pair[1]) {
            halves.reverse();
            loops.push(halves);
        }
    }
    loops
}

/// Triangles between places of the loop; `None` if chords that exist leave none.
fn least_area(mesh: &PolygonMesh, vertices: &[u32], edges: &HashSet<[u32; 2]>) -> Option<Vec<[usize; 3]>> {
    let count = vertices.len();
    let place = |i: usize| mesh.positions[vertices[i] as usize].as_dvec3();
    let exists = |i: usize, k: usize| {
        let (a, b) = (vertices[i].min(vertices[k]), vertices[i].max(vertices[k]));
        edges.contains(&[a, b])
    };
    // The least area behind the chord from i to k, and the tip of its triangle.
    let mut area = vec![0.0f64; count * count];
    let mut tip = vec![0u32; count * count];
    for length in 2..count {
        for i in 0..count - length {
            let k = i + length;
            let is_border = i == 0 && k == count - 1;
            let mut best = (f64::INFINITY, 0);
            if is_border || !exists(i, k) {
                let (a, c) = (place(i), place(k));
                for m in i + 1..k {
                    let own = (place(m) - a).cross(c - a).length();
                    let total = area[i * count + m] + area[m * count + k] + own;
                    if total < best.0 {
                        best = (total, m as u32);
                    }
                }
            }
            (area[i * count + k], tip[i * count + k]) = best;
        }
    }
    if !area[count - 1].is_finite() {
        return None;
    }
    let mut triangles = Vec::with_capacity(count - 2);
    let mut open = vec![[0, count - 1]];
    while let Some([i, k]) = open.pop() {
        if k > i + 1 {
            let m = tip[i * count + k] as usize;
            triangles.push([i, m, k]);
            open.extend([[i, m], [m, k]]);
        }
    }
    Some(triangles)
}

/// Adds a face whose corners take over the values of these corners.
fn add_face(mesh: &mut PolygonMesh, half_edges: &HalfEdges, corners: &[u32]) {
    let vertices: Vec<u32> = corners.iter().map(|&corner| mesh.corners[corner as usize]).collect();
    let face = mesh.add_face(&vertices);
    fn extend<T: Copy>(attribute: &mut CornerAttribute<T>, corners: &[u32]) {
        if !attribute.corners.is_empty() {
            let values: Vec<u32> = corners.iter().map(|&corner| attribute.corners[corner as usize]).collect();
            attribute.corners.extend(values);
        }
    }
    extend(&mut mesh.colors, corners);
    mesh.uv_sets.iter_mut().for_each(|uvs| extend(uvs, corners));
    finish_face(mesh, half_edges, face, corners[0]);
}

/// Normal, material and group of a new face.
fn finish_face(mesh: &mut PolygonMesh, half_edges: &HalfEdges, face: usize, neighbour: u32) {
    if !mesh.normals.corners.is_empty() {
        let normal = crate::normals::unit_or_z(faces::doubled_area_normal(mesh, face));
        mesh.normals.values.push(normal);
        mesh.normals.corners.resize(mesh.corners.len(), mesh.normals.values.len() as u32 - 1);
    }
    if !mesh.slots.is_empty() {
        mesh.slots.push(mesh.slots[half_edges.face(neighbour) as usize]);
    }
    if !mesh.smoothing_groups.is_empty() {
        mesh.smoothing_groups.push(0);
    }
}

fn add_fan(mesh: &mut PolygonMesh, half_edges: &HalfEdges, halves: &[u32]) {
    let vertices: Vec<u32> = halves.iter().map(|&half| mesh.corners[half as usize]).collect();
    let scale = 1.0 / vertices.len() as f64;
    let middle: DVec3 = vertices.iter().map(|&v| mesh.positions[v as usize].as_dvec3() * scale).sum();
    mesh.positions.push(middle.as_vec3());
    let tip = mesh.positions.len() as u32 - 1;
    /// The mean of the border's values becomes the tip's.
    fn tip_value<T: Copy>(attribute: &mut CornerAttribute<T>, halves: &[u32], mean: impl Fn(Vec<T>) -> T) {
        if !attribute.corners.is_empty() {
            let value = |&half: &u32| attribute.values[attribute.corners[half as usize] as usize];
            attribute.values.push(mean(halves.iter().map(value).collect()));
        }
    }
    tip_value(&mut mesh.colors, halves, |all| all.iter().sum::<glam::Vec4>() * scale as f32);
    for uvs in &mut mesh.uv_sets {
        tip_value(uvs, halves, |all| all.iter().sum::<glam::Vec2>() * scale as f32);
    }
    for i in 0..halves.len() {
        let pair = [halves[i], halves[(i + 1) % halves.len()]];
        let face = mesh.add_face(&[vertices[i], vertices[(i + 1) % vertices.len()], tip]);
        fn extend<T: Copy>(attribute: &mut CornerAttribute<T>, pair: [u32; 2]) {
            if !attribute.corners.is_empty() {
                let [a, b] = pair.map(|half| attribute.corners[half as usize]);
                attribute.corners.extend([a, b, attribute.values.len() as u32 - 1]);
            }
        }
        extend(&mut mesh.colors, pair);
        mesh.uv_sets.iter_mut().for_each(|uvs| extend(uvs, pair));
        finish_face(mesh, half_edges, face, halves[i]);
    }
}
