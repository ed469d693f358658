//! Edge collapses in passes: each sorts all edges by error and takes those that do not get in each other's way.

use glam::DVec3;
use rayon::prelude::*;

use super::quadric::Quadric;
use super::wedges::Wedges;
use super::{Settings, Simplified};
use crate::edges::{Edges, corner_at, half_edge_ends};
use crate::sets::DisjointSets;
use crate::{Attribute, TriangleMesh};

/// How much the planes that stand on borders and seams count against the surface.
const BORDER_WEIGHT: f64 = 10.0;
const SEAM_WEIGHT: f64 = 1.0;
/// Each pass takes a sixteenth of what is wanted or all that is allowed; so many are never needed but on hostile meshes.
const MOST_PASSES: usize = 256;
/// A triangle may turn by this cosine at most.
const LEAST_COSINE: f64 = 0.25;

pub(super) fn run(mesh: &TriangleMesh, wedges: Wedges, settings: &Settings) -> Simplified {
    let mut collapser = Collapser::new(mesh, &wedges, settings.keeps_borders);
    let most_error = if settings.error >= 0.0 { settings.error / collapser.scale } else { 0.0 };
    let most_error = most_error * most_error;
    let mut worst = 0.0f64;
    for _ in 0..MOST_PASSES {
        if collapser.triangles.len() <= settings.triangles {
            break;
        }
        let wanted = collapser.triangles.len() - settings.triangles;
        match collapser.pass(wanted, most_error) {
            Some(error) => worst = worst.max(error),
            None => break,
        }
    }
    Simplified { mesh: collapser.rebuilt(mesh, &wedges), error: worst.sqrt() * collapser.scale }
}

struct Collapser {
    /// Relative to the middle of the bounds, in units of `scale`.
    places: Vec<DVec3>,
    scale: f64,
    /// Positions of corners.
    triangles: Vec<[u32; 3]>,
    /// Wedges of corners.
    wedges: Vec<[u32; 3]>,
    quadrics: Vec<Quadric>,
    is_locked: Vec<bool>,
}

/// Triangles about each vertex.
struct Fans {
    starts: Vec<u32>,
    /// Corners `3 t + k`.
    corners: Vec<u32>,
}

impl Fans {
    fn of(triangles: &[[u32; 3]], count: usize) -> Self {
        let mut starts = vec![0u32; count + 1];
        let flat = triangles.as_flattened();
        flat.iter().for_each(|&v| starts[v as usize + 1] += 1);
        (0..count).for_each(|v| starts[v + 1] += starts[v]);
        let mut next = starts.clone();
        let mut corners = vec![0; flat.len()];
        for (corner, &v) in flat.iter().enumerate() {
            corners[next[v as usize] as usize] = corner as u32;
            next[v as usize] += 1;
        }
        Self { starts, corners }
    }

    fn at(&self, vertex: u32) -> &[u32] {
        &self.corners[self.starts[vertex as usize] as usize..self.starts[vertex as usize + 1] as usize]
    }
}

impl Collapser {
    fn new(mesh: &TriangleMesh, wedges: &Wedges, keeps_borders: bool) -> Self {
        let bounds = mesh.bounds();
        let (low, high) = (bounds.min.as_dvec3(), bounds.max.as_dvec3());
        let scale = (high - low).max_element();
        let scale = if scale > 0.0 && scale.is_finite() { scale } else { 1.0 };
        let middle = (low + high) * 0.5;
        let mut collapser = Self {
            places: mesh.positions.iter().map(|p| (p.as_dvec3() - middle) / scale).collect(),
            scale,
            triangles: mesh.triangles.clone(),
            wedges: wedges.triangles.clone(),
            quadrics: vec![Quadric::default(); mesh.positions.len()],
            is_locked: vec![false; mesh.positions.len()],
        };
        collapser.add_surface();
        collapser.add_curves(keeps_borders);
        collapser
    }

    fn add_surface(&mut self) {
        for triangle in &self.triangles {
            let [a, b, c] = triangle.map(|v| self.places[v as usize]);
            let normal = (b - a).cross(c - a);
            let length = normal.length();
            if length > 0.0 {
                let quadric = Quadric::of_plane(normal / length, a, length);
                triangle.iter().for_each(|&v| self.quadrics[v as usize] += quadric);
            }
        }
    }

    /// Planes on borders and seams; vertices where the surface is no manifold stay.
    fn add_curves(&mut self, keeps_borders: bool) {
        let triangles = &self.triangles;
        let mut fans = DisjointSets::new(triangles.len() * 3);
        for edge in Edges::new(triangles, self.places.len()).iter(triangles) {
            let first = edge.half_edges[0];
            let weight = match *edge.half_edges {
                [_] => {
                    edge.vertices.iter().for_each(|&v| self.is_locked[v as usize] |= keeps_borders);
                    BORDER_WEIGHT
                }
                [one, other] if half_edge_ends(triangles, one)[0] != half_edge_ends(triangles, other)[0] => {
                    let corners =
                        edge.vertices.map(|v| [one, other].map(|half| corner_at(triangles, half, v)));
                    corners.iter().for_each(|[a, b]| fans.join(*a, *b));
                    let wedge = |corner: u32| self.wedges[corner as usize / 3][corner as usize % 3];
                    if corners.iter().all(|[a, b]| wedge(*a) == wedge(*b)) {
                        continue;
                    }
                    SEAM_WEIGHT
                }
                _ => {
                    edge.vertices.iter().for_each(|&v| self.is_locked[v as usize] = true);
                    continue;
                }
            };
            // Upright on the triangle, along the edge.
            let [a, b] = half_edge_ends(triangles, first).map(|v| self.places[v as usize]);
            let [p, q, r] = triangles[first as usize / 3].map(|v| self.places[v as usize]);
            let Some(normal) = (b - a).cross((q - p).cross(r - p)).try_normalize() else { continue };
            let quadric = Quadric::of_plane(normal, a, (b - a).length_squared() * weight);
            edge.vertices.iter().for_each(|&v| self.quadrics[v as usize] += quadric);
        }
        let mut fan_of = vec![u32::MAX; self.places.len()];
        for corner in 0..triangles.len() as u32 * 3 {
            let fan = fans.root(corner);
            let vertex = triangles[corner as usize / 3][corner as usize % 3] as usize;
            self.is_locked[vertex] |= fan_of[vertex] != u32::MAX && fan_of[vertex] != fan;
            fan_of[vertex] = fan;
        }
    }

    /// Does the cheapest collapses, about half of what is wanted at most, and tells the largest error; `None` if there was
    /// nothing to do.
    fn pass(&mut self, wanted: usize, most_error: f64) -> Option<f64> {
        let fans = Fans::of(&self.triangles, self.places.len());
        let is_border = self.border_vertices(&fans);
        let candidates = self.candidates(&fans, &is_border, most_error);
        // Only the better part: what is dear now may be avoided later.
        let goal = candidates.get(wanted / 2).map_or(f64::INFINITY, |c| f64::from(error_of(*c)) * 1.5);
        let mut state = Pass {
            target: (0..self.places.len() as u32).collect(),
            no_source: vec![false; self.places.len()],
            no_target: vec![false; self.places.len()],
            wedge_target: Vec::new(),
        };
        let mut removed = 0;
        let mut worst = None;
        for candidate in candidates {
            let error = f64::from(error_of(candidate));
            // Where little of the better part is allowed, the rest has its turn.
            if removed >= wanted || error > goal && removed >= wanted / 16 && worst.is_some() {
                break;
            }
            let half = candidate as u32 >> 1;
            let [a, b] = half_edge_ends(&self.triangles, half);
            let [from, to] = if candidate & 1 == 0 { [a, b] } else { [b, a] };
            if state.no_source[from as usize] || state.no_target[to as usize] {
                continue;
            }
            let Some(gone) = self.collapse(&fans, &mut state, from, to, is_border[from as usize]) else {
                continue;
            };
            removed += gone;
            worst = Some(worst.map_or(error, |w: f64| w.max(error)));
        }
        if worst.is_some() {
            self.apply(&state);
        }
        worst
    }

    fn border_vertices(&self, fans: &Fans) -> Vec<bool> {
        let triangles = &self.triangles;
        (0..self.places.len() as u32)
            .into_par_iter()
            .with_min_len(1 << 12)
            .map(|vertex| {
                // In a closed fan every neighbour that a half-edge leads to is also one that another comes from.
                let corners = fans.at(vertex);
                let ends = |corner: u32, step: usize| {
                    triangles[corner as usize / 3][(corner as usize % 3 + step) % 3]
                };
                corners.iter().any(|&c| !corners.iter().any(|&other| ends(other, 2) == ends(c, 1)))
                    || corners.iter().any(|&c| !corners.iter().any(|&other| ends(other, 1) == ends(c, 2)))
            })
            .collect()
    }

    /// Collapses that are allowed by what their vertices are, cheapest first: error as a number in the upper half, half-edge and
    /// direction in the lower.
    fn candidates(&self, fans: &Fans, is_border: &[bool], most_error: f64) -> Vec<u64> {
        let candidate = |half: u32| -> Option<u64> {
            let [a, b] = half_edge_ends(&self.triangles, half);
            let on_border = is_border[a as usize] && is_border[b as usize];
            let is_border_edge = on_border && !self.has_half_edge(fans, b, a);
            if a > b && !is_border_edge {
                return None;
            }
            let allowed =
                |from: u32| !self.is_locked[from as usize] && (!is_border[from as usize] || is_border_edge);
            let sum = self.quadrics[a as usize] + self.quadrics[b as usize];
            let error = |from: u32, to: u32| {
                if allowed(from) { sum.error(self.places[to as usize]) } else { f64::INFINITY }
            };
            let (forward, backward) = (error(a, b), error(b, a));
            let best = forward.min(backward);
            if !(best <= most_error && best.is_finite()) {
                return None;
            }
            let direction = u64::from(backward < forward);
            // Bits of numbers that are not negative are in their order.
            Some(u64::from((best as f32).to_bits()) << 32 | u64::from(half) << 1 | direction)
        };
        let halves = (self.triangles.len() * 3) as u32;
        let mut candidates: Vec<u64> =
            (0..halves).into_par_iter().with_min_len(1 << 12).filter_map(candidate).collect();
        candidates.par_sort_unstable();
        candidates
    }

    fn has_half_edge(&self, fans: &Fans, from: u32, to: u32) -> bool {
        fans.at(from).iter().any(|&c| self.triangles[c as usize / 3][(c as usize % 3 + 1) % 3] == to)
    }

    /// Moves a vertex onto another if nothing speaks against it, and tells how many triangles go.
    fn collapse(
        &mut self,
        fans: &Fans,
        state: &mut Pass,
        from: u32,
        to: u32,
        is_border: bool,
    ) -> Option<usize> {
        let around = fans.at(from);
        // No triangle about the source has changed in this pass, though other vertices of it may have moved onto others.
        let mut links: Vec<[u32; 2]> = Vec::with_capacity(2);
        let mut tips: Vec<u32> = Vec::with_capacity(2);
        for &corner in around {
            let (triangle, k) = (corner as usize / 3, corner as usize % 3);
            let vertices = self.triangles[triangle];
            if let Some(other) = (1..3).map(|step| (k + step) % 3).find(|&other| vertices[other] == to) {
                let wedges = self.wedges[triangle];
                links.push([wedges[k], wedges[other]]);
                tips.push(vertices[3 - k - other]);
            }
        }
        let expected = if is_border { 1 } else { 2 };
        if links.len() != expected {
            return None;
        }
        // Every wedge of the source must know its place at the target.
        let wedge_of = |wedge: u32| {
            let mut found = links.iter().filter(|link| link[0] == wedge).map(|link| link[1]);
            let first = found.next()?;
            found.all(|other| other == first).then_some(first)
        };
        for &corner in around {
            wedge_of(self.wedges[corner as usize / 3][corner as usize % 3])?;
        }
        if !self.keeps_topology(fans, state, from, to, &tips) || self.turns_over(around, from, to) {
            return None;
        }
        for &corner in around {
            let wedge = self.wedges[corner as usize / 3][corner as usize % 3];
            if let Some(place) = wedge_of(wedge) {
                state.wedge_target.push([wedge, place]);
            }
            self.triangles[corner as usize / 3].iter().for_each(|&v| state.no_source[v as usize] = true);
        }
        state.target[from as usize] = to;
        state.no_target[from as usize] = true;
        state.no_target[to as usize] = true;
        let moved = self.quadrics[from as usize];
        self.quadrics[to as usize] += moved;
        Some(links.len())
    }

    /// The link condition: the only vertices next to both are the tips of the triangles on the edge.
    fn keeps_topology(&self, fans: &Fans, state: &Pass, from: u32, to: u32, tips: &[u32]) -> bool {
        let next_to_source =
            |vertex: u32| fans.at(from).iter().any(|&c| self.triangles[c as usize / 3].contains(&vertex));
        for &corner in fans.at(to) {
            let triangle = self.triangles[corner as usize / 3];
            if triangle.contains(&from) {
                continue;
            }
            let now = triangle.map(|v| state.target[v as usize]);
            for vertex in now {
                if vertex != to && vertex != from && !tips.contains(&vertex) && next_to_source(vertex) {
                    return false;
                }
            }
        }
        // The last triangle of a piece stays; and of a tetrahedron two faces on each other would be left.
        let others =
            || fans.at(to).iter().map(|&c| self.triangles[c as usize / 3]).filter(|t| !t.contains(&from));
        let closes_up = fans.at(from).len() == 3 && tips.len() == 2;
        let leaves_some = fans.at(from).len() > tips.len() || others().next().is_some();
        leaves_some && !(closes_up && others().any(|t| tips.iter().all(|tip| t.contains(tip))))
    }

    fn turns_over(&self, around: &[u32], from: u32, to: u32) -> bool {
        let goal = self.places[to as usize];
        let own = self.places[from as usize];
        around.iter().any(|&corner| {
            let (vertices, k) = (self.triangles[corner as usize / 3], corner as usize % 3);
            let (b, c) = (vertices[(k + 1) % 3], vertices[(k + 2) % 3]);
            if b == to || c == to {
                return false;
            }
            let (b, c) = (self.places[b as usize], self.places[c as usize]);
            let before = (b - own).cross(c - own);
            let after = (b - goal).cross(c - goal);
            let product = (before.length_squared() * after.length_squared()).sqrt();
            // A triangle without area may become any, but not the other way round.
            before.dot(after) < LEAST_COSINE * product || after.length_squared() == 0.0
        })
    }

    /// Renames corners and drops triangles that collapsed.
    fn apply(&mut self, state: &Pass) {
        let mut pairs = state.wedge_target.clone();
        pairs.sort_unstable();
        pairs.dedup();
        let most = self.wedges.as_flattened().iter().max().map_or(0, |most| *most as usize + 1);
        let mut wedge_target: Vec<u32> = (0..most as u32).collect();
        pairs.iter().for_each(|&[from, to]| wedge_target[from as usize] = to);
        let mut kept = 0;
        for t in 0..self.triangles.len() {
            let [a, b, c] = self.triangles[t].map(|v| state.target[v as usize]);
            if a != b && b != c && c != a {
                self.triangles[kept] = [a, b, c];
                self.wedges[kept] = self.wedges[t].map(|w| wedge_target[w as usize]);
                kept += 1;
            }
        }
        self.triangles.truncate(kept);
        self.wedges.truncate(kept);
    }

    /// The mesh of what is left; attributes from a corner of each wedge.
    fn rebuilt(&self, mesh: &TriangleMesh, wedges: &Wedges) -> TriangleMesh {
        fn own<T: Copy>(attribute: &Attribute<T>, now: &[[u32; 3]], wedges: &Wedges) -> Attribute<T> {
            if attribute.triangles.is_empty() {
                return attribute.clone();
            }
            let value = |wedge: u32| {
                let corner = wedges.corners[wedge as usize] as usize;
                attribute.triangles[corner / 3][corner % 3]
            };
            Attribute::indexed(attribute.values.clone(), now.iter().map(|t| t.map(value)).collect())
        }
        let slot = |wedge: u32| mesh.slots[wedges.corners[wedge as usize] as usize / 3];
        TriangleMesh {
            positions: mesh.positions.clone(),
            triangles: self.triangles.clone(),
            normals: own(&mesh.normals, &self.wedges, wedges),
            uv_sets: mesh.uv_sets.iter().map(|uvs| own(uvs, &self.wedges, wedges)).collect(),
            tangents: own(&mesh.tangents, &self.wedges, wedges),
            colors: own(&mesh.colors, &self.wedges, wedges),
            slots: if mesh.slots.is_empty() {
                Vec::new()
            } else {
                self.wedges.iter().map(|t| slot(t[0])).collect()
            },
        }
    }
}

fn error_of(candidate: u64) -> f32 {
    f32::from_bits((candidate >> 32) as u32)
}

/// What has happened in a pass.
struct Pass {
    target: Vec<u32>,
    /// Vertices whose triangles have changed.
    no_source: Vec<bool>,
    /// Vertices that have moved or been moved onto.
    no_target: Vec<bool>,
    wedge_target: Vec<[u32; 2]>,
}
