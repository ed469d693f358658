//! Edges drawn together to a point.

use glam::DVec3;

use super::builder::{Builder, NewCorner, Shade};
use super::{prepared, refresh_normals};
use crate::PolygonMesh;
use crate::sets::DisjointSets;

/// Draws each of the given edges together to its middle; edges that touch go together to the mean of their ends.
///
/// Faces that have fewer than three corners left go. `edges` name vertices; those that do not exist are left out.
pub fn collapse_edges(mesh: &PolygonMesh, edges: &[[u32; 2]]) -> PolygonMesh {
    let mesh = &*prepared(mesh);
    let count = mesh.positions.len();
    let mut sets = DisjointSets::new(count);
    for &[one, other] in edges.iter().filter(|edge| edge.iter().all(|&end| (end as usize) < count)) {
        sets.join(one, other);
    }
    let roots: Vec<u32> = (0..count as u32).map(|vertex| sets.root(vertex)).collect();
    let mut sums = vec![(DVec3::ZERO, 0u32); count];
    for (position, &root) in mesh.positions.iter().zip(&roots) {
        let (sum, number) = &mut sums[root as usize];
        *sum += position.as_dvec3();
        *number += 1;
    }
    let mut builder = Builder::new(mesh);
    for (root, &(sum, number)) in sums.iter().enumerate().filter(|(_, (_, number))| *number > 1) {
        let middle = sum / f64::from(number);
        if middle.is_finite() {
            builder.move_vertex(root as u32, middle);
        }
    }
    for face in 0..mesh.face_count() {
        let borders = mesh.borders(face).into_iter().map(|border| {
            let mut corners: Vec<NewCorner> = Vec::with_capacity(border.len());
            for corner in border {
                let vertex = roots[mesh.corners[corner] as usize];
                if corners.last().is_none_or(|last| last.vertex != vertex) {
                    corners.push(NewCorner::like(vertex, corner as u32));
                }
            }
            while corners.len() > 1 && corners[0].vertex == corners[corners.len() - 1].vertex {
                corners.pop();
            }
            corners
        });
        let mut borders: Vec<Vec<NewCorner>> = borders.collect();
        let mut is_first = true;
        borders.retain(|border| std::mem::take(&mut is_first) || border.len() > 2);
        builder.face(face, &borders, Shade::Mixed, None);
    }
    let mut collapsed = builder.finish();
    let is_moved: Vec<bool> = (0..count).map(|vertex| sums[roots[vertex] as usize].1 > 1).collect();
    if is_moved.iter().any(|&moved| moved) {
        refresh_normals(&mut collapsed, |_| false);
    }
    collapsed
}
