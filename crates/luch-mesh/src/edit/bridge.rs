//! A tube between two loops.

use std::collections::BTreeMap;

use super::builder::{Builder, NewCorner, Shade};
use super::geometry::corner_place;
use super::{EditError, prepared};
use crate::PolygonMesh;
use crate::polygon_mesh::HalfEdges;

/// Joins two loops by a tube.
///
/// A loop is where the marked faces border on others: they are taken away, and the tube stands in the hole. Unmarked faces keep
/// theirs. Loops that are borders of the mesh already are named by `edges` instead, rising, lower end first; a side may use
/// both. Loops of different length are joined with triangles where needed. A closed mesh stays closed.
///
/// # Errors
/// [`EditError::NoLoops`] unless each side has exactly one loop, and no vertex twice.
pub fn bridge(
    mesh: &PolygonMesh,
    faces: [&[bool]; 2],
    edges: [&[[u32; 2]]; 2],
) -> Result<PolygonMesh, EditError> {
    let mesh = &*prepared(mesh);
    let half_edges = HalfEdges::new(mesh);
    let opposites = half_edges.opposites();
    let is_in = |side: usize, face: u32| faces[side].get(face as usize).copied().unwrap_or(false);
    let goes = |face: u32| is_in(0, face) || is_in(1, face);
    let sides = [0, 1].map(|side| {
        let borders = (0..mesh.corners.len() as u32).filter(|&corner| {
            let [from, to] = half_edges.ends(corner);
            !goes(half_edges.face(corner))
                && match opposites[corner as usize] {
                    Some(other) => is_in(side, half_edges.face(other)),
                    None => edges[side].binary_search(&[from.min(to), from.max(to)]).is_ok(),
                }
        });
        loops(&half_edges, borders)
    });
    let counts = [0, 1].map(|side: usize| sides[side].as_ref().map_or(0, Vec::len));
    let [Some(first), Some(second)] = sides else {
        return Err(EditError::NoLoops { first: counts[0], second: counts[1] });
    };
    let ([first], [second]) = (first.as_slice(), second.as_slice()) else {
        return Err(EditError::NoLoops { first: counts[0], second: counts[1] });
    };
    let mut builder = Builder::new(mesh);
    (0..mesh.face_count()).filter(|&face| !goes(face as u32)).for_each(|face| builder.copy_face(face));
    for corners in tube(mesh, first, second) {
        let face = half_edges.face(corners[0]) as usize;
        let corners =
            corners.iter().map(|&corner| NewCorner::like(mesh.corners[corner as usize], corner)).collect();
        builder.face(face, &[corners], Shade::Flat, None);
    }
    Ok(builder.finish())
}

/// Closed ways against the given half-edges, as corners; `None` if they part or do not close.
fn loops(half_edges: &HalfEdges, borders: impl Iterator<Item = u32>) -> Option<Vec<Vec<u32>>> {
    // By the vertex where the way begins, which is the end of the half-edge.
    let mut by_start: BTreeMap<u32, u32> = BTreeMap::new();
    for half_edge in borders {
        if by_start.insert(half_edges.ends(half_edge)[1], half_edge).is_some() {
            return None;
        }
    }
    let mut loops = Vec::new();
    while let Some((&start, _)) = by_start.first_key_value() {
        let (mut way, mut at) = (Vec::new(), start);
        while let Some(half_edge) = by_start.remove(&at) {
            way.push(half_edges.next(half_edge));
            at = half_edges.ends(half_edge)[0];
        }
        if at != start {
            return None;
        }
        loops.push(way);
    }
    Some(loops)
}

/// Quads, and triangles where one loop has more corners, between two loops that run against each other.
fn tube(mesh: &PolygonMesh, first: &[u32], second: &[u32]) -> Vec<Vec<u32>> {
    let place = |corner: u32| corner_place(mesh, corner as usize);
    // Both the same way round.
    let mut second: Vec<u32> = second.iter().rev().copied().collect();
    let (n, m) = (first.len(), second.len());
    // The start that makes the tube shortest, by up to 64 corners.
    let step = n.div_ceil(64).max(1);
    let length = |offset: usize| -> f64 {
        (0..n).step_by(step).map(|i| place(first[i]).distance(place(second[(offset + i * m / n) % m]))).sum()
    };
    let lengths: Vec<f64> = (0..m).map(length).collect();
    let best = (0..m).min_by(|&one, &other| lengths[one].total_cmp(&lengths[other])).unwrap_or(0);
    second.rotate_left(best);
    let (mut i, mut j) = (0, 0);
    let mut faces = Vec::with_capacity(n.max(m));
    while i < n || j < m {
        let (near, far) = (first[i % n], second[j % m]);
        let (next_near, next_far) = (first[(i + 1) % n], second[(j + 1) % m]);
        // Whichever loop is behind goes on; both at once make a quad.
        let (a, b) = ((i + 1) * m, (j + 1) * n);
        if i < n && j < m && a.abs_diff(b) * 2 <= n.max(m) {
            faces.push(vec![near, next_near, next_far, far]);
            (i, j) = (i + 1, j + 1);
        } else if j >= m || (i < n && a < b) {
            faces.push(vec![near, next_near, far]);
            i += 1;
        } else {
            faces.push(vec![near, next_far, far]);
            j += 1;
        }
    }
    faces
}
