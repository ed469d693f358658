//! Values at corners on their way down: each list of values with the connectivity of its own that its seams give it.

use super::masks::{Blend, Rule, face_points, refined};
use super::topology::Topology;
use super::{Feature, UvRule, feature};
use crate::PolygonMesh;
use crate::polygon_mesh::CornerAttribute;

/// Values and, if they do not run parallel to the positions, their own topology.
pub(super) struct Channel<V> {
    rule: Rule,
    pub(super) values: Vec<V>,
    pub(super) own: Option<Topology>,
    /// The corners, if the last level left the rest of the topology out.
    corners: Option<Vec<u32>>,
}

/// The values of the next level.
pub(super) fn refined_values<V: Blend>(
    topology: &Topology,
    values: &[V],
    rule: Rule,
    to_triangles: bool,
) -> Vec<V> {
    let faces = if to_triangles { Vec::new() } else { face_points(topology, values) };
    refined(topology, values, rule, &faces)
}

pub(super) fn refined_topology(topology: &Topology, to_triangles: bool) -> Topology {
    if to_triangles { topology.refined_to_triangles() } else { topology.refined_to_quads() }
}

pub(super) fn refined_corners(topology: &Topology, to_triangles: bool) -> Vec<u32> {
    if to_triangles { topology.triangle_corners() } else { topology.quad_corners() }
}

impl<V: Blend> Channel<V> {
    /// `positions` is the topology of the mesh, with its sharpness.
    pub(super) fn new<T: Copy>(
        mesh: &PolygonMesh,
        positions: &Topology,
        attribute: &CornerAttribute<T>,
        widen: impl Fn(T) -> V,
        rule: Rule,
        uv_rule: UvRule,
    ) -> Self {
        let parallel = attribute.corners.is_empty();
        if parallel && (rule == Rule::Linear || attribute.is_empty()) {
            let values = attribute.values.iter().copied().map(widen).collect();
            return Self { rule, values, own: None, corners: None };
        }
        // A value at two positions is two: only what shares both is connected.
        let value_of = if parallel { &mesh.corners } else { &attribute.corners };
        let pair = |corner: usize| [mesh.corners[corner], value_of[corner]];
        let mut pairs: Vec<[u32; 2]> = (0..mesh.corners.len()).map(pair).collect();
        pairs.sort_unstable();
        pairs.dedup();
        let corners =
            (0..mesh.corners.len()).map(|c| pairs.partition_point(|p| *p < pair(c)) as u32).collect();
        let mut own = Topology::new(&mesh.face_ends, corners, pairs.len() as u32);
        if rule != Rule::Linear {
            fix(&mut own, uv_rule);
            inherit_sharpness(&mut own, positions, &pairs);
        }
        let values = pairs.iter().map(|[_, value]| widen(attribute.values[*value as usize])).collect();
        Self { rule, values, own: Some(own), corners: None }
    }

    pub(super) fn refine(&mut self, positions: &Topology, to_triangles: bool, needs_neighbours: bool) {
        let topology = self.own.as_ref().unwrap_or(positions);
        self.values = refined_values(topology, &self.values, self.rule, to_triangles);
        let Some(own) = &mut self.own else { return };
        if needs_neighbours {
            *own = refined_topology(own, to_triangles);
        } else {
            self.corners = Some(refined_corners(own, to_triangles));
        }
    }

    pub(super) fn into_attribute<T: Copy>(self, narrow: impl Fn(V) -> T) -> CornerAttribute<T> {
        let values = self.values.into_iter().map(narrow).collect();
        match (self.corners, self.own) {
            (Some(corners), _) => CornerAttribute::indexed(values, corners),
            (None, Some(own)) => CornerAttribute::indexed(values, own.corners),
            (None, None) => CornerAttribute::per_position(values),
        }
    }
}

/// Vertices that the rule for uvs keeps in place.
fn fix(own: &mut Topology, uv_rule: UvRule) {
    for vertex in 0..own.vertex_count {
        let is_fixed = match uv_rule {
            UvRule::Linear | UvRule::SeamsFixed => feature(own, vertex, |s| s) != Feature::Smooth,
            UvRule::CornersFixed => own.corners_at(vertex).len() == 1,
            UvRule::Smooth => false,
        };
        if is_fixed {
            own.vertex_sharpness[vertex as usize] = f32::INFINITY;
        }
    }
}

/// Creases of the surface are creases of its uvs.
fn inherit_sharpness(own: &mut Topology, positions: &Topology, pairs: &[[u32; 2]]) {
    for half in 0..own.corners.len() {
        let sharpness = positions.edge_sharpness[positions.corner_edges[half] as usize];
        let edge = own.corner_edges[half] as usize;
        own.edge_sharpness[edge] = own.edge_sharpness[edge].max(sharpness);
    }
    for (vertex, [position, _]) in pairs.iter().enumerate() {
        let sharpness = positions.vertex_sharpness[*position as usize];
        own.vertex_sharpness[vertex] = own.vertex_sharpness[vertex].max(sharpness);
    }
}
