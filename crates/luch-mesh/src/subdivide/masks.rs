//! Where the vertices of the next level lie: weighted sums of those of this one.
//!
//! Catmull and Clark 1978; Loop 1987; sharp edges and vertices after DeRose, Kass and Truong 1998, a fraction of a
//! sharpness blends the rule before and the rule after it. The weights of every sum add up to one on any mesh.

use std::ops::{Add, Mul};

use glam::{DVec2, DVec3, DVec4};

use super::topology::{Topology, less_sharp, list};

/// What can be weighted and added: positions, uvs, colours.
pub(super) trait Blend:
    Copy + Send + Sync + Default + Add<Output = Self> + Mul<f64, Output = Self>
{
}

impl Blend for DVec2 {}
impl Blend for DVec3 {}
impl Blend for DVec4 {}

/// Which sums are taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Rule {
    /// Middles, and vertices stay.
    Linear,
    /// For quads around vertices.
    CatmullClark,
    /// For triangles.
    Loop,
}

/// What a vertex is by its sharp edges.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Feature {
    /// Fewer than two sharp edges.
    Smooth,
    /// On a curve; the two neighbours on it.
    Crease([u32; 2]),
    /// Where curves meet or end in a point.
    Corner,
}

/// The feature of a vertex, with a sharpness for edges and vertices as `remaining` makes it of the present one.
pub(super) fn feature(topology: &Topology, vertex: u32, remaining: impl Fn(f32) -> f32) -> Feature {
    if remaining(topology.vertex_sharpness[vertex as usize]) > 0.0 {
        return Feature::Corner;
    }
    let mut neighbours = [0; 2];
    let mut count = 0;
    for &edge in topology.edges_at(vertex) {
        if remaining(topology.edge_sharpness[edge as usize]) > 0.0 {
            if let Some(place) = neighbours.get_mut(count) {
                *place = topology.across(edge, vertex);
            }
            count += 1;
        }
    }
    match count {
        0 | 1 => Feature::Smooth,
        2 => Feature::Crease(neighbours),
        _ => Feature::Corner,
    }
}

/// The weight of each neighbour in Loop's rule for a vertex with so many.
pub(super) fn loop_beta(valence: f64) -> f64 {
    let sharp = 0.375 + 0.25 * libm::cos(std::f64::consts::TAU / valence);
    (0.625 - sharp * sharp) / valence
}

fn sum<V: Blend>(values: impl Iterator<Item = V>) -> V {
    values.fold(V::default(), |sum, value| sum + value)
}

/// The middles of all faces.
pub(super) fn face_points<V: Blend>(topology: &Topology, values: &[V]) -> Vec<V> {
    list(topology.face_count(), |face| {
        let corners = topology.face_start(face) as usize..topology.face_start(face + 1) as usize;
        let scale = 1.0 / corners.len() as f64;
        sum(topology.corners[corners].iter().map(|&v| values[v as usize])) * scale
    })
}

/// The values of the next level: of vertices, edges and, for quads, faces. `faces` are the middles of the faces, empty
/// if none are wanted.
pub(super) fn refined<V: Blend>(topology: &Topology, values: &[V], rule: Rule, faces: &[V]) -> Vec<V> {
    let vertices = list(topology.vertex_count as usize, |vertex| match rule {
        Rule::Linear => values[vertex as usize],
        _ => vertex_point(topology, values, rule, faces, vertex),
    });
    let edges = list(topology.edge_ends.len(), |edge| edge_point(topology, values, rule, faces, edge));
    let mut all = vertices;
    all.reserve_exact(edges.len() + faces.len());
    all.extend_from_slice(&edges);
    all.extend_from_slice(faces);
    all
}

fn edge_point<V: Blend>(topology: &Topology, values: &[V], rule: Rule, faces: &[V], edge: u32) -> V {
    let [a, b] = topology.edge_ends[edge as usize].map(|v| values[v as usize]);
    let middle = (a + b) * 0.5;
    let sharpness = f64::from(topology.edge_sharpness[edge as usize]).min(1.0);
    if rule == Rule::Linear || sharpness >= 1.0 {
        return middle;
    }
    let &[one, other] = topology.halves_of(edge) else { return middle };
    let smooth = if rule == Rule::CatmullClark {
        let face_points = [one, other].map(|half| faces[topology.face_of(half) as usize]);
        (a + b + face_points[0] + face_points[1]) * 0.25
    } else {
        let opposite =
            [one, other].map(|half| values[topology.corners[topology.previous(half) as usize] as usize]);
        (a + b) * 0.375 + (opposite[0] + opposite[1]) * 0.125
    };
    smooth * (1.0 - sharpness) + middle * sharpness
}

fn vertex_point<V: Blend>(topology: &Topology, values: &[V], rule: Rule, faces: &[V], vertex: u32) -> V {
    let before = feature(topology, vertex, |sharpness| sharpness);
    let place = |feature| place(topology, values, rule, faces, vertex, feature);
    if before == Feature::Smooth {
        return place(before);
    }
    let after = feature(topology, vertex, less_sharp);
    if before == after {
        return place(before);
    }
    // The mean of what ends in this level.
    let mut ending = 0.0;
    let mut count = 0.0f64;
    let edges = topology.edges_at(vertex).iter().map(|&edge| topology.edge_sharpness[edge as usize]);
    for sharpness in edges.chain([topology.vertex_sharpness[vertex as usize]]) {
        if sharpness > 0.0 && less_sharp(sharpness) == 0.0 {
            ending += f64::from(sharpness);
            count += 1.0;
        }
    }
    let weight = (ending / count.max(1.0)).min(1.0);
    place(before) * weight + place(after) * (1.0 - weight)
}

fn place<V: Blend>(
    topology: &Topology,
    values: &[V],
    rule: Rule,
    faces: &[V],
    vertex: u32,
    feature: Feature,
) -> V {
    let own = values[vertex as usize];
    let edges = topology.edges_at(vertex);
    match feature {
        Feature::Corner => own,
        Feature::Crease([a, b]) => own * 0.75 + (values[a as usize] + values[b as usize]) * 0.125,
        Feature::Smooth if edges.is_empty() => own,
        Feature::Smooth => {
            let valence = edges.len() as f64;
            let neighbours = sum(edges.iter().map(|&edge| values[topology.across(edge, vertex) as usize]));
            if rule == Rule::Loop {
                let beta = loop_beta(valence);
                return own * (1.0 - valence * beta) + neighbours * beta;
            }
            let corners = topology.corners_at(vertex);
            let middles = sum(corners.iter().map(|&corner| faces[topology.face_of(corner) as usize]));
            let scale = 1.0 / (valence * valence);
            // (n − 2) / n where faces and edges are as many.
            let rest = 1.0 - (valence + corners.len() as f64) * scale;
            own * rest + (neighbours + middles) * scale
        }
    }
}
