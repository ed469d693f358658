//! The neighbourhood of a vertex where one sharp edge ends, subdivided on its own.

use glam::DVec3;

use super::limit::opposite;
use super::masks::{Rule, loop_beta};
use super::topology::Topology;

/// A vertex and what is about it, counter-clockwise: ends of edges, and for quads the corners across faces.
pub(super) struct Ring {
    pub(super) vertex: DVec3,
    edges: Vec<DVec3>,
    faces: Vec<DVec3>,
    /// The edge that is sharp.
    sharp: usize,
}

impl Ring {
    /// The direction that the ring faces.
    pub(super) fn normal(&self) -> DVec3 {
        let count = self.edges.len();
        let spoke = |i: usize| self.edges[i % count] - self.vertex;
        (0..count).map(|i| spoke(i).cross(spoke(i + 1))).sum()
    }

    fn refine_quads(&mut self) {
        let count = self.edges.len();
        let edge = |i: usize| self.edges[i % count];
        let face_points: Vec<DVec3> =
            (0..count).map(|i| (self.vertex + edge(i) + edge(i + 1) + self.faces[i]) * 0.25).collect();
        let edge_point = |i: usize| {
            if i == self.sharp {
                return (self.vertex + self.edges[i]) * 0.5;
            }
            (self.vertex + self.edges[i] + face_points[(i + count - 1) % count] + face_points[i]) * 0.25
        };
        let edges: Vec<DVec3> = (0..count).map(edge_point).collect();
        let scale = 1.0 / (count * count) as f64;
        let around = self.edges.iter().chain(&face_points).sum::<DVec3>();
        self.vertex = self.vertex * (1.0 - 2.0 / count as f64) + around * scale;
        (self.edges, self.faces) = (edges, face_points);
    }

    fn refine_triangles(&mut self) {
        let count = self.edges.len();
        let edge_point = |i: usize| {
            let [before, after] = [self.edges[(i + count - 1) % count], self.edges[(i + 1) % count]];
            if i == self.sharp {
                return (self.vertex + self.edges[i]) * 0.5;
            }
            (self.vertex + self.edges[i]) * 0.375 + (before + after) * 0.125
        };
        let edges: Vec<DVec3> = (0..count).map(edge_point).collect();
        let beta = loop_beta(count as f64);
        self.vertex = self.vertex * (1.0 - beta * count as f64) + self.edges.iter().sum::<DVec3>() * beta;
        self.edges = edges;
    }
}

/// The ring of a dart after so many levels; `None` if the vertex is none, or faces do not close around it.
pub(super) fn dart_ring(
    topology: &Topology,
    places: &[DVec3],
    rule: Rule,
    vertex: u32,
    levels: usize,
) -> Option<Ring> {
    let is_sharp = |edge: u32| topology.edge_sharpness[edge as usize] > 0.0;
    if !topology.edges_at(vertex).iter().any(|&edge| is_sharp(edge)) {
        return None;
    }
    let corners = topology.corners_at(vertex);
    let mut ring = Ring { vertex: places[vertex as usize], edges: Vec::new(), faces: Vec::new(), sharp: 0 };
    let mut corner = *corners.first()?;
    for i in 0..corners.len() {
        if i > 0 && corner == corners[0] {
            return None;
        }
        if is_sharp(topology.corner_edges[corner as usize]) {
            ring.sharp = i;
        }
        ring.edges.push(places[topology.corners[topology.next(corner) as usize] as usize]);
        ring.faces.push(places[opposite(topology, corner) as usize]);
        corner = topology.next_around(corner)?;
    }
    if corner != corners[0] {
        return None;
    }
    for _ in 0..levels {
        match rule {
            Rule::CatmullClark => ring.refine_quads(),
            _ => ring.refine_triangles(),
        }
    }
    Some(ring)
}
