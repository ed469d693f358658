//! A face of n corners becomes n quads around its middle.
//!
//! Vertices: those of before, then one on each edge, then one in each face. Face `c` (for corner `c`): the vertex of the
//! corner, the middle of its edge, the middle of its face, the middle of the edge before. Edges: two halves of each
//! edge, then for each corner `c` the one from the middle of its edge to the middle of its face.

use super::{Sides, Topology, groups, list};

impl Topology {
    /// The corners of the quads, four by four.
    pub(in super::super) fn quad_corners(&self) -> Vec<u32> {
        let vertices = self.vertex_count;
        let edges = self.edge_ends.len() as u32;
        list(self.corners.len() * 4, |child| {
            let corner = child / 4;
            match child % 4 {
                0 => self.corners[corner as usize],
                1 => vertices + self.corner_edges[corner as usize],
                2 => vertices + edges + self.face_of(corner),
                _ => vertices + self.corner_edges[self.previous(corner) as usize],
            }
        })
    }

    /// The next level.
    pub(in super::super) fn refined_to_quads(&self) -> Self {
        let (vertices, edges) = (self.vertex_count, self.edge_ends.len() as u32);
        let (halves, faces) = (self.corners.len() as u32, self.face_count() as u32);
        let corner_edges = list(self.corners.len() * 4, |child| {
            let corner = child / 4;
            let vertex = self.corners[corner as usize];
            match child % 4 {
                0 => self.half_at(self.corner_edges[corner as usize], vertex),
                1 => 2 * edges + corner,
                2 => 2 * edges + self.previous(corner),
                _ => self.half_at(self.corner_edges[self.previous(corner) as usize], vertex),
            }
        });
        let edge_ends = list((2 * edges + halves) as usize, |child| {
            if child < 2 * edges {
                [self.edge_ends[child as usize / 2][child as usize % 2], vertices + child / 2]
            } else {
                let corner = child - 2 * edges;
                [vertices + self.corner_edges[corner as usize], vertices + edges + self.face_of(corner)]
            }
        });
        // Half-edges of edges.
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
                    *place = if starts_here { 4 * half } else { 4 * self.next(half) + 3 };
                }
            } else {
                let corner = child - 2 * edges;
                own.copy_from_slice(&[4 * corner + 1, 4 * self.next(corner) + 2]);
            }
        });
        // Edges and corners at vertices.
        let starts_by = |of_vertex: &[u32], per_edge: u32, per_half: u32| {
            let at_edges = of_vertex[vertices as usize];
            let at_faces = at_edges + per_edge * edges + per_half * halves;
            list((vertices + edges + faces) as usize + 1, |vertex| {
                if vertex < vertices {
                    return of_vertex[vertex as usize];
                }
                let edge = vertex - vertices;
                if edge < edges {
                    at_edges + per_edge * edge + per_half * self.edge_half_starts[edge as usize]
                } else {
                    at_faces + self.face_start(edge - edges)
                }
            })
        };
        let vertex_edge_starts = starts_by(&self.vertex_edge_starts, 2, 1);
        let vertex_edges = groups(&vertex_edge_starts, |vertex, own| {
            if vertex < vertices {
                for (place, &edge) in own.iter_mut().zip(self.edges_at(vertex)) {
                    *place = self.half_at(edge, vertex);
                }
            } else if vertex < vertices + edges {
                let edge = vertex - vertices;
                own[..2].copy_from_slice(&[2 * edge, 2 * edge + 1]);
                for (place, half) in own[2..].iter_mut().zip(self.halves_of(edge)) {
                    *place = 2 * edges + half;
                }
            } else {
                let start = self.face_start(vertex - vertices - edges);
                own.iter_mut().zip(start..).for_each(|(place, corner)| *place = 2 * edges + corner);
            }
        });
        let vertex_corner_starts = starts_by(&self.vertex_corner_starts, 0, 2);
        let vertex_corners = groups(&vertex_corner_starts, |vertex, own| {
            if vertex < vertices {
                for (place, &corner) in own.iter_mut().zip(self.corners_at(vertex)) {
                    *place = 4 * corner;
                }
            } else if vertex < vertices + edges {
                for (places, &half) in own.chunks_exact_mut(2).zip(self.halves_of(vertex - vertices)) {
                    places.copy_from_slice(&[4 * half + 1, 4 * self.next(half) + 3]);
                }
            } else {
                let start = self.face_start(vertex - vertices - edges);
                own.iter_mut().zip(start..).for_each(|(place, corner)| *place = 4 * corner + 2);
            }
        });
        let [edge_sharpness, vertex_sharpness] =
            self.sharpness_of_children(halves as usize, (edges + faces) as usize);
        Self {
            vertex_count: vertices + edges + faces,
            sides: Sides::All(4),
            corners: self.quad_corners(),
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
