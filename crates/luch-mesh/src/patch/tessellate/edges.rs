//! Sides of pieces that are the same curve.

use std::collections::HashMap;

use glam::{DVec3, DVec4};

use super::super::bezier::curve_point;
use super::Output;

/// A side of a piece as a use of a shared edge.
#[derive(Clone, Copy, Debug)]
pub(super) struct EdgeUse {
    edge: usize,
    /// The side runs against the edge.
    reversed: bool,
}

struct Edge {
    /// In the direction in which the bits of its points come first in order.
    points: Vec<DVec4>,
    /// All points are one.
    is_point: bool,
    segments: u64,
    vertices: Vec<u32>,
}

#[derive(Default)]
pub(super) struct SharedEdges {
    list: Vec<Edge>,
    /// By the bits of the points; looked up only, never walked.
    by_points: HashMap<Vec<[u64; 4]>, usize>,
}

impl SharedEdges {
    pub(super) fn add(&mut self, points: Vec<DVec4>) -> EdgeUse {
        // Adding zero makes −0 and 0 one.
        let bits = |point: &DVec4| (*point + DVec4::ZERO).to_array().map(f64::to_bits);
        let forward: Vec<_> = points.iter().map(bits).collect();
        let backward: Vec<_> = points.iter().rev().map(bits).collect();
        let reversed = backward < forward;
        let key = if reversed { backward } else { forward };
        let list = &mut self.list;
        let edge = *self.by_points.entry(key).or_insert_with(|| {
            let points = if reversed { points.iter().rev().copied().collect() } else { points };
            let places: Vec<DVec3> = points.iter().map(|p: &DVec4| p.truncate() / p.w).collect();
            // Points may differ by the rounding of their products with weights.
            let size = places.iter().map(|place| place.abs().max_element()).fold(0.0, f64::max);
            let is_point = places.iter().all(|place| place.distance(places[0]) <= 1e-14 * size);
            list.push(Edge { points, is_point, segments: 1, vertices: Vec::new() });
            list.len() - 1
        });
        EdgeUse { edge, reversed }
    }

    /// The edge is to have at least so many segments.
    pub(super) fn want(&mut self, used: EdgeUse, segments: u64) {
        let edge = &mut self.list[used.edge];
        if !edge.is_point {
            edge.segments = edge.segments.max(segments);
        }
    }

    /// The segments of all edges.
    pub(super) fn segments(&self) -> u64 {
        self.list.iter().fold(0, |sum, edge| sum.saturating_add(edge.segments))
    }

    /// Puts the vertices of all edges in place.
    pub(super) fn place(&mut self, output: &mut Output) {
        for edge in &mut self.list {
            let count = edge.segments;
            let at = |k: u64| curve_point(&edge.points, k as f64 / count as f64);
            edge.vertices = (0..=count).map(|k| output.add_edge_vertex(at(k))).collect();
            if edge.is_point {
                edge.vertices[1] = edge.vertices[0];
            }
        }
    }

    /// Segments as far as they force vertices between the ends: 1 for a side that is a point.
    pub(super) fn inner_segments(&self, used: EdgeUse) -> u64 {
        self.list[used.edge].segments
    }

    /// In how many parts a side is cut beside so many cells. Where it is a point, twice as many: then each triangle that
    /// ends there has its own uv and normal in its middle.
    pub(super) fn stops(&self, used: EdgeUse, cells: u64) -> u64 {
        let edge = &self.list[used.edge];
        if edge.is_point { 2 * cells } else { edge.segments }
    }

    /// Vertex `k` along the side.
    pub(super) fn vertex(&self, used: EdgeUse, k: u64) -> u32 {
        let edge = &self.list[used.edge];
        if edge.is_point {
            return edge.vertices[0];
        }
        let k = k as usize;
        edge.vertices[if used.reversed { edge.segments as usize - k } else { k }]
    }

    /// The vertex where the side begins.
    pub(super) fn first(&self, used: EdgeUse) -> u32 {
        self.vertex(used, 0)
    }

    /// The vertex where the side ends.
    pub(super) fn last(&self, used: EdgeUse) -> u32 {
        let edge = &self.list[used.edge];
        self.vertex(used, edge.segments)
    }
}
