//! Triangles that can be split, collapsed and flipped one by one.

use std::collections::HashSet;

use glam::DVec3;

use crate::TriangleMesh;
use crate::edges::{Edges, half_edge_ends};

/// A triangle that is gone.
const GONE: [u32; 3] = [u32::MAX; 3];

/// A surface under work. Features are edges that stay where they are: borders, sharp edges, edges of more than two triangles.
pub(super) struct Surface {
    pub(super) places: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
    /// The triangles about each vertex, rising.
    at: Vec<Vec<u32>>,
    features: HashSet<[u32; 2]>,
    /// How many features end at each vertex.
    feature_count: Vec<u32>,
}

fn key(a: u32, b: u32) -> [u32; 2] {
    [a.min(b), a.max(b)]
}

impl Surface {
    /// Edges bent by more than `angle` (radians) are features. The mesh must be valid and without collapsed triangles.
    pub(super) fn new(mesh: &TriangleMesh, angle: f64) -> Self {
        let mut surface = Self {
            places: mesh.positions.iter().map(|p| p.as_dvec3()).collect(),
            triangles: mesh.triangles.clone(),
            at: vec![Vec::new(); mesh.positions.len()],
            features: HashSet::new(),
            feature_count: vec![0; mesh.positions.len()],
        };
        for (number, triangle) in mesh.triangles.iter().enumerate() {
            triangle.iter().for_each(|&v| surface.at[v as usize].push(number as u32));
        }
        let least_cosine = libm::cos(angle.clamp(0.0, std::f64::consts::PI));
        for edge in Edges::new(&mesh.triangles, mesh.positions.len()).iter(&mesh.triangles) {
            let is_smooth = match *edge.half_edges {
                [one, other] => {
                    let agrees =
                        half_edge_ends(&mesh.triangles, one)[0] != half_edge_ends(&mesh.triangles, other)[0];
                    let [a, b] = [one, other].map(|half| surface.normal(half / 3));
                    agrees && a.dot(b) >= least_cosine * a.length() * b.length()
                }
                _ => false,
            };
            if !is_smooth {
                surface.add_feature(edge.vertices);
            }
        }
        surface
    }

    fn add_feature(&mut self, edge: [u32; 2]) {
        if self.features.insert(key(edge[0], edge[1])) {
            edge.iter().for_each(|&v| self.feature_count[v as usize] += 1);
        }
    }

    fn remove_feature(&mut self, edge: [u32; 2]) {
        if self.features.remove(&key(edge[0], edge[1])) {
            edge.iter().for_each(|&v| self.feature_count[v as usize] -= 1);
        }
    }

    pub(super) fn triangle_count(&self) -> usize {
        self.triangles.iter().filter(|t| **t != GONE).count()
    }

    /// Twice the area times the normal of a triangle.
    fn normal(&self, triangle: u32) -> DVec3 {
        let [a, b, c] = self.triangles[triangle as usize].map(|v| self.places[v as usize]);
        (b - a).cross(c - a)
    }

    pub(super) fn length_squared(&self, [a, b]: [u32; 2]) -> f64 {
        self.places[a as usize].distance_squared(self.places[b as usize])
    }

    /// All edges, rising.
    pub(super) fn edges(&self) -> Vec<[u32; 2]> {
        let triangles = self.triangles.iter().filter(|t| **t != GONE);
        let mut edges: Vec<[u32; 2]> =
            triangles.flat_map(|&[a, b, c]| [key(a, b), key(b, c), key(c, a)]).collect();
        edges.sort_unstable();
        edges.dedup();
        edges
    }

    /// Triangles on an edge.
    fn on_edge(&self, [a, b]: [u32; 2]) -> Vec<u32> {
        let around = self.at[a as usize].iter().copied();
        around.filter(|&t| self.triangles[t as usize].contains(&b)).collect()
    }

    fn tip(&self, triangle: u32, [a, b]: [u32; 2]) -> u32 {
        self.triangles[triangle as usize].into_iter().find(|v| *v != a && *v != b).unwrap_or(a)
    }

    pub(super) fn is_on_feature(&self, vertex: u32) -> bool {
        self.feature_count[vertex as usize] > 0
    }

    /// The vertices next to one.
    pub(super) fn neighbours(&self, vertex: u32) -> Vec<u32> {
        let around = self.at[vertex as usize].iter().flat_map(|&t| self.triangles[t as usize]);
        let mut neighbours: Vec<u32> = around.filter(|v| *v != vertex).collect();
        neighbours.sort_unstable();
        neighbours.dedup();
        neighbours
    }

    /// The sum of the normals about a vertex.
    pub(super) fn normal_at(&self, vertex: u32) -> DVec3 {
        self.at[vertex as usize].iter().map(|&t| self.normal(t)).sum()
    }

    /// Cuts an edge in its middle.
    pub(super) fn split(&mut self, edge: [u32; 2]) {
        let [a, b] = edge;
        let middle = self.places.len() as u32;
        self.places.push((self.places[a as usize] + self.places[b as usize]) * 0.5);
        self.at.push(Vec::new());
        self.feature_count.push(0);
        for triangle in self.on_edge(edge) {
            let other = self.triangles.len() as u32;
            let corners = self.triangles[triangle as usize];
            let tip = self.tip(triangle, edge);
            self.triangles[triangle as usize] = corners.map(|v| if v == b { middle } else { v });
            self.triangles.push(corners.map(|v| if v == a { middle } else { v }));
            self.at[b as usize].retain(|t| *t != triangle);
            self.at[b as usize].push(other);
            self.at[tip as usize].push(other);
            self.at[middle as usize].extend([triangle, other]);
        }
        if self.features.contains(&key(a, b)) {
            self.remove_feature(edge);
            self.add_feature([a, middle]);
            self.add_feature([middle, b]);
        }
    }

    /// Moves one end of an edge onto the other, if the surface allows it and no edge becomes longer than the square root of `most`.
    pub(super) fn collapse(&mut self, from: u32, to: u32, most: f64) -> bool {
        let edge = [from, to];
        let along_feature = self.features.contains(&key(from, to)) && self.feature_count[from as usize] == 2;
        let removed = self.on_edge(edge);
        let tips: Vec<u32> = removed.iter().map(|&t| self.tip(t, edge)).collect();
        if self.is_on_feature(from) && !along_feature || removed.is_empty() || removed.len() > 2 {
            return false;
        }
        // The link condition, and no triangle that loses its last neighbours.
        let neighbours = self.neighbours(from);
        let others = self.neighbours(to);
        let shared = neighbours.iter().filter(|v| others.binary_search(v).is_ok()).count();
        if shared != removed.len()
            || tips.iter().any(|&tip| self.at[tip as usize].len() <= 3 && !self.is_on_feature(tip))
        {
            return false;
        }
        let goal = self.places[to as usize];
        if neighbours.iter().any(|&v| v != to && self.places[v as usize].distance_squared(goal) > most) {
            return false;
        }
        // A curve of features must go straight on, or the shape would change.
        if along_feature {
            let onward =
                neighbours.iter().copied().find(|&v| v != to && self.features.contains(&key(from, v)));
            let Some(onward) = onward else { return false };
            let (back, on) = (
                self.places[from as usize] - goal,
                self.places[onward as usize] - self.places[from as usize],
            );
            if back.cross(on).length() > 0.05 * back.length() * on.length()
                || self.features.contains(&key(to, onward))
            {
                return false;
            }
        }
        let kept: Vec<u32> =
            self.at[from as usize].iter().copied().filter(|t| !removed.contains(t)).collect();
        for &triangle in &kept {
            let before = self.normal(triangle);
            let [a, b, c] = self.triangles[triangle as usize]
                .map(|v| if v == from { goal } else { self.places[v as usize] });
            let after = (b - a).cross(c - a);
            if before.dot(after) <= 0.5 * before.length() * after.length() {
                return false;
            }
        }
        for &triangle in &removed {
            for v in std::mem::replace(&mut self.triangles[triangle as usize], GONE) {
                self.at[v as usize].retain(|t| *t != triangle);
            }
        }
        for triangle in kept {
            let corners = &mut self.triangles[triangle as usize];
            *corners = corners.map(|v| if v == from { to } else { v });
            self.at[to as usize].push(triangle);
        }
        self.at[from as usize].clear();
        for other in neighbours {
            if self.features.contains(&key(from, other)) {
                self.remove_feature([from, other]);
                if other != to {
                    self.add_feature([to, other]);
                }
            }
        }
        true
    }

    /// Turns the edge between two triangles if that evens out how many edges meet at the four vertices.
    pub(super) fn flip(&mut self, edge: [u32; 2]) -> bool {
        let triangles = self.on_edge(edge);
        let &[one, other] = triangles.as_slice() else { return false };
        if self.features.contains(&key(edge[0], edge[1])) {
            return false;
        }
        // One triangle runs along the edge from a to b.
        let [a, b] = edge;
        let runs_along = |t: u32| {
            let corners = self.triangles[t as usize];
            (0..3).any(|k| corners[k] == a && corners[(k + 1) % 3] == b)
        };
        let (left, right) = if runs_along(one) { (one, other) } else { (other, one) };
        let [c, d] = [left, right].map(|t| self.tip(t, edge));
        if !runs_along(left) || runs_along(right) || c == d || !self.on_edge([c, d]).is_empty() {
            return false;
        }
        let wanted = |v: u32| if self.is_on_feature(v) { 4.0 } else { 6.0 };
        let deviation = |change: f64| {
            let parts = [(a, -change), (b, -change), (c, change), (d, change)];
            let part = |&(v, change): &(u32, f64)| {
                let valence = self.at[v as usize].len() as f64 + f64::from(u8::from(self.is_on_feature(v)));
                let off = valence + change - wanted(v);
                off * off
            };
            parts.iter().map(part).sum::<f64>()
        };
        if deviation(1.0) >= deviation(0.0) {
            return false;
        }
        let place = |v: u32| self.places[v as usize];
        let new = [[a, d, c], [d, b, c]];
        let sum = self.normal(left) + self.normal(right);
        for [p, q, r] in new {
            let normal = (place(q) - place(p)).cross(place(r) - place(p));
            if normal.dot(sum) <= 0.7 * normal.length() * sum.length() {
                return false;
            }
        }
        [self.triangles[left as usize], self.triangles[right as usize]] = new;
        self.at[b as usize].retain(|t| *t != left);
        self.at[a as usize].retain(|t| *t != right);
        self.at[c as usize].push(right);
        self.at[d as usize].push(left);
        true
    }

    /// The triangles that are left.
    pub(super) fn into_mesh(self) -> TriangleMesh {
        let triangles = self.triangles.into_iter().filter(|t| *t != GONE).collect();
        let mesh = TriangleMesh::new(self.places.iter().map(|p| p.as_vec3()).collect(), triangles);
        crate::clean::remove_unused_positions(&mesh).mesh
    }
}
