//! A triangle becomes four.
//!
//! Vertices: those of before, then one on each edge. Faces `4 f + k`: corner `k`, the middle of its edge, the middle of the edge
//! before; face `4 f + 3`: the middles of all edges. Edges: two halves of each edge, then for each corner `c` the one that
//! cuts it off.

use super::{Sides, Topology, groups, list};

/// The corner after and before one of a triangle.
fn after(corner: u32) -> u32 {
    if corner % 3 == 2 { corner - 2 } else { corner + 1 }
}

fn before(corner: u32) -> u32 {
    if corner.is_multiple_of(3) { corner + 2 } else { corner - 1 }
}

/// The first half-edge of the child triangle at a corner.
fn child_at(corner: u32) -> u32 {
    3 * (4 * (corner / 3) + corner % 3)
}

/// The first half-edge of the child triangle in the middle of the face of a corner.
fn middle_of(corner: u32) -> u32 {
    3 * (4 * (corner / 3) + 3)
}

impl Topology {
    /// The corners of the triangles, three by three. All faces must be triangles.
    pub(in super::super) fn triangle_corners(&self) -> Vec<u32> {
        list(self.corners.len() * 4, |child| {
            let (face, part, place) = (child / 12, child / 3 % 4, child % 3);
            let corner = 3 * face + part;
            let middle = |half: u32| self.vertex_count + self.corner_edges[half as usize];
            match (part, place) {
                (3, place) => middle(3 * face + place),
                (_, 0) => self.corners[corner as usize],
                (_, 1) => middle(corner),
                _ => middle(before(corner)),
            }
        })
    }

    /// The next level. All faces must be triangles.
    pub(in super::super) fn refined_to_triangles(&self) -> Self {
        let (vertices, edges) = (self.vertex_count, self.edge_ends.len() as u32);
        let halves = self.corners.len() as u32;
        let corner_edges = list(self.corners.len() * 4, |child| {
            let (face, part, place) = (child / 12, child / 3 % 4, child % 3);
            let corner = 3 * face + part;
            let half_of =
                |half: u32| self.half_at(self.corner_edges[half as usize], self.corners[corner as usize]);
            match (part, place) {
                (3, place) => 2 * edges + 3 * face + (place + 1) % 3,
                (_, 0) => half_of(corner),
                (_, 1) => 2 * edges + corner,
                _ => half_of(before(corner)),
            }
        });
        let edge_ends = list((2 * edges + halves) as usize, |child| {
            if child < 2 * edges {
                return [self.edge_ends[child as usize / 2][child as usize % 2], vertices + child / 2];
            }
            let corner = child - 2 * edges;
            [corner, before(corner)].map(|half| vertices + self.corner_edges[half as usize])
        });
        let edge_half_starts = list((2 * edges + halves) as usize + 1, |child| {
            if child >= 2 * edges {
                return 2 * halves + 2 * (child - 2 * edges);
            }
            let start = self.edge_half_starts[child as usize / 2];
            let count = self.edge_half_starts[child as usize / 2 + 1] - start;
            2 * start + child % 2 * count
        });
        let edge_halves = groups(&edge_half_starts, |child, own| {
            if child < 2 * edges {
                let end = self.edge_ends[child as usize / 2][child as usize % 2];
                for (place, &half) in own.iter_mut().zip(self.halves_of(child / 2)) {
                    let starts_here = self.corners[half as usize] == end;
                    *place = if starts_here { child_at(half) } else { child_at(after(half)) + 2 };
                }
            } else {
                let corner = child - 2 * edges;
                own.copy_from_slice(&[child_at(corner) + 1, middle_of(corner) + before(corner) % 3]);
            }
        });
        let starts_by = |of_vertex: &[u32], per_edge: u32, per_half: u32| {
            let at_edges = of_vertex[vertices as usize];
            list((vertices + edges) as usize + 1, |vertex| {
                let Some(edge) = vertex.checked_sub(vertices) else { return of_vertex[vertex as usize] };
                at_edges + per_edge * edge + per_half * self.edge_half_starts[edge as usize]
            })
        };
        let vertex_edge_starts = starts_by(&self.vertex_edge_starts, 2, 2);
        let vertex_edges = groups(&vertex_edge_starts, |vertex, own| {
            if vertex < vertices {
                for (place, &edge) in own.iter_mut().zip(self.edges_at(vertex)) {
                    *place = self.half_at(edge, vertex);
                }
                return;
            }
            let edge = vertex - vertices;
            own[..2].copy_from_slice(&[2 * edge, 2 * edge + 1]);
            for (places, &half) in own[2..].chunks_exact_mut(2).zip(self.halves_of(edge)) {
                places.copy_from_slice(&[2 * edges + half, 2 * edges + after(half)]);
            }
        });
        let vertex_corner_starts = starts_by(&self.vertex_corner_starts, 0, 3);
        let vertex_corners = groups(&vertex_corner_starts, |vertex, own| {
            if vertex < vertices {
                for (place, &corner) in own.iter_mut().zip(self.corners_at(vertex)) {
                    *place = child_at(corner);
                }
                return;
            }
            for (places, &half) in own.chunks_exact_mut(3).zip(self.halves_of(vertex - vertices)) {
                let middle = middle_of(half) + half % 3;
                places.copy_from_slice(&[child_at(half) + 1, child_at(after(half)) + 2, middle]);
            }
        });
        let [edge_sharpness, vertex_sharpness] = self.sharpness_of_children(halves as usize, edges as usize);
        Self {
            vertex_count: vertices + edges,
            sides: Sides::All(3),
            corners: self.triangle_corners(),
            corner_edges,
            edge_ends,
            edge_half_starts,
            edge_halves,
            vertex_edge_starts,
            vertex_edges,
            vertex_corner_starts,
            vertex_corners,
            edge_sharpness,
            vertex_sharpness,
        }
    }
}
