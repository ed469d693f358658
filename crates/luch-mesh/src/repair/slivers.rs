//! Triangles that are hardly there: needles, whose one side is short, and caps, whose one corner lies nearly on the opposite side.
//!
//! A needle's short side is drawn together; a cap's long side is turned to the other diagonal, so that its corner becomes one of the
//! neighbour. Both change the surface by less than the height that is asked for, and neither opens or pinches it.

use glam::{DVec3, Vec2, Vec3, Vec4};
use std::ops::{Add, Mul};

use crate::{Attribute, TriangleMesh, clean};

/// A triangle that is gone.
const GONE: [u32; 3] = [u32::MAX; 3];

/// Rounds: what is drawn together may leave another sliver behind.
const ROUNDS: u32 = 16;

/// A mesh with fewer slivers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Dropped {
    /// The mesh.
    pub mesh: TriangleMesh,
    /// Sides drawn together and turned.
    pub changes: usize,
    /// Slivers that could not be taken away: at borders, and where the surface would fold or pinch.
    pub left: usize,
}

/// Takes away triangles whose least height is below `height` (metres). Attributes stay; tangents are left out, as they can be derived.
/// Where equal positions have numbers of their own nothing is joined: weld first. A mesh that is not valid is given back.
pub fn drop_slivers(mesh: &TriangleMesh, height: f64) -> Dropped {
    let is_usable = height > 0.0 && mesh.validate().is_empty();
    if !is_usable
        || (0..mesh.triangles.len()).all(|t| least_height(mesh.corners(t).map(Vec3::as_dvec3)) >= height)
    {
        return Dropped { mesh: mesh.clone(), ..Dropped::default() };
    }
    let mut surface = Surface::new(mesh, height);
    let mut changes = 0;
    for _ in 0..ROUNDS {
        let before = changes;
        for triangle in 0..surface.triangles.len() as u32 {
            changes += usize::from(surface.is_sliver(triangle) && surface.take_away(triangle));
        }
        if changes == before {
            break;
        }
    }
    let left = (0..surface.triangles.len() as u32).filter(|&t| surface.is_sliver(t)).count();
    Dropped { mesh: surface.into_mesh(), changes, left }
}

/// Twice the area over the longest side; zero for a point.
fn least_height([a, b, c]: [DVec3; 3]) -> f64 {
    let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
    if longest > 0.0 { (b - a).cross(c - a).length() / longest } else { 0.0 }
}

/// Values at corners, each corner with a number of its own.
struct Lane<T> {
    values: Vec<T>,
    triangles: Vec<[u32; 3]>,
}

impl<T: Copy + Add<Output = T> + Mul<f32, Output = T>> Lane<T> {
    fn new(attribute: &Attribute<T>, triangles: &[[u32; 3]]) -> Self {
        let own = if attribute.triangles.is_empty() { triangles } else { &attribute.triangles };
        let triangles = if attribute.values.is_empty() { Vec::new() } else { own.to_vec() };
        Self { values: attribute.values.clone(), triangles }
    }

    /// The corner of the cap as one of the neighbour: its own value if both are one surface, else what the neighbour has at this
    /// part of the side.
    fn turn(&mut self, turn: &Turn) {
        if self.triangles.is_empty() {
            return;
        }
        let Turn { cap, neighbour, apex, side, part } = *turn;
        let own = self.triangles[cap as usize];
        let other = self.triangles[neighbour as usize];
        let (own_a, own_b, own_c) = (own[(apex + 1) % 3], own[(apex + 2) % 3], own[apex]);
        // The neighbour runs along the side from b to a.
        let (b, a, d) = (other[side], other[(side + 1) % 3], other[(side + 2) % 3]);
        let c = if (own_a, own_b) == (a, b) {
            own_c
        } else {
            let value = self.values[a as usize] * (1.0 - part) + self.values[b as usize] * part;
            self.values.push(value);
            self.values.len() as u32 - 1
        };
        self.triangles[cap as usize] = [a, d, c];
        self.triangles[neighbour as usize] = [d, b, c];
    }

    fn into_attribute(self, is_kept: &[bool]) -> Attribute<T> {
        let kept = self.triangles.into_iter().zip(is_kept).filter(|(_, kept)| **kept);
        let triangles: Vec<[u32; 3]> = kept.map(|(triangle, _)| triangle).collect();
        if triangles.is_empty() { Attribute::default() } else { Attribute::indexed(self.values, triangles) }
    }
}

/// A long side that is turned.
#[derive(Clone, Copy)]
struct Turn {
    cap: u32,
    neighbour: u32,
    /// The corner of the cap across from its long side.
    apex: usize,
    /// The corner of the neighbour at which it runs along the side.
    side: usize,
    /// Where along the side, from the corner after the apex, the apex lies.
    part: f32,
}

struct Surface {
    height: f64,
    places: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
    /// The triangles about each vertex.
    at: Vec<Vec<u32>>,
    positions: Vec<Vec3>,
    slots: Vec<u16>,
    normals: Lane<Vec3>,
    uvs: Vec<Lane<Vec2>>,
    colors: Lane<Vec4>,
}

impl Surface {
    fn new(mesh: &TriangleMesh, height: f64) -> Self {
        let mut at = vec![Vec::new(); mesh.positions.len()];
        for (number, triangle) in mesh.triangles.iter().enumerate() {
            triangle.iter().for_each(|&v| at[v as usize].push(number as u32));
        }
        Self {
            height,
            places: mesh.positions.iter().map(|p| p.as_dvec3()).collect(),
            triangles: mesh.triangles.clone(),
            at,
            positions: mesh.positions.clone(),
            slots: mesh.slots.clone(),
            normals: Lane::new(&mesh.normals, &mesh.triangles),
            uvs: mesh.uv_sets.iter().map(|uvs| Lane::new(uvs, &mesh.triangles)).collect(),
            colors: Lane::new(&mesh.colors, &mesh.triangles),
        }
    }

    fn corners(&self, triangle: u32) -> [DVec3; 3] {
        self.triangles[triangle as usize].map(|v| self.places[v as usize])
    }

    fn is_sliver(&self, triangle: u32) -> bool {
        self.triangles[triangle as usize] != GONE && least_height(self.corners(triangle)) < self.height
    }

    fn on_edge(&self, a: u32, b: u32) -> Vec<u32> {
        let has_b = |t: &&u32| self.triangles[**t as usize].contains(&b);
        self.at[a as usize].iter().filter(has_b).copied().collect()
    }

    fn neighbours(&self, vertex: u32) -> Vec<u32> {
        let corners = self.at[vertex as usize].iter().flat_map(|&t| self.triangles[t as usize]);
        let mut all: Vec<u32> = corners.filter(|&v| v != vertex).collect();
        all.sort_unstable();
        all.dedup();
        all
    }

    /// Whether the triangles about a vertex do not close around it.
    fn is_at_border(&self, vertex: u32) -> bool {
        self.neighbours(vertex).len() != self.at[vertex as usize].len()
    }

    fn take_away(&mut self, triangle: u32) -> bool {
        let corners = self.corners(triangle);
        let length = |k: usize| corners[(k + 1) % 3].distance_squared(corners[(k + 2) % 3]);
        let by_length = |k: &usize, l: &usize| length(*k).total_cmp(&length(*l));
        // Corners, named by the side across from them.
        let (Some(short), Some(apex)) = ((0..3).min_by(by_length), (0..3).max_by(by_length)) else {
            return false;
        };
        let vertices = self.triangles[triangle as usize];
        let [a, b] = [vertices[(short + 1) % 3], vertices[(short + 2) % 3]];
        // Up to twice the height, so that no triangle is both too short to turn and too long to draw together.
        let is_needle = length(short).sqrt() < 2.0 * self.height;
        is_needle && (self.collapse(a, b) || self.collapse(b, a)) || self.turn(triangle, apex)
    }

    /// Draws `from` onto `to` if the surface stays what it is.
    fn collapse(&mut self, from: u32, to: u32) -> bool {
        let removed = self.on_edge(from, to);
        let from_border = self.is_at_border(from);
        if removed.is_empty() || removed.len() > 2 || from_border && removed.len() != 1 {
            return false;
        }
        // The link condition, and no vertex that loses its last neighbours.
        let (own, others) = (self.neighbours(from), self.neighbours(to));
        let shared: Vec<u32> = own.iter().copied().filter(|v| others.binary_search(v).is_ok()).collect();
        let is_last = |&tip: &u32| self.at[tip as usize].len() <= 3 && !self.is_at_border(tip);
        if shared.len() != removed.len()
            || shared.iter().any(is_last)
            || self.at[to as usize].len() + own.len() > 4096
        {
            return false;
        }
        let goal = self.places[to as usize];
        let kept: Vec<u32> =
            self.at[from as usize].iter().copied().filter(|t| !removed.contains(t)).collect();
        if kept.is_empty() {
            return false;
        }
        for &triangle in &kept {
            let [a, b, c] = self.corners(triangle);
            let before = (b - a).cross(c - a);
            let moved = self.triangles[triangle as usize];
            let [a, b, c] = moved.map(|v| if v == from { goal } else { self.places[v as usize] });
            let after = (b - a).cross(c - a);
            // Slivers have no direction to speak of.
            if !self.is_sliver(triangle) && before.dot(after) <= 0.5 * before.length() * after.length() {
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
        true
    }

    /// Turns the long side of a cap to the other diagonal.
    fn turn(&mut self, cap: u32, apex: usize) -> bool {
        let corners = self.triangles[cap as usize];
        let (a, b, c) = (corners[(apex + 1) % 3], corners[(apex + 2) % 3], corners[apex]);
        let on_edge = self.on_edge(a, b);
        let [one, other] = on_edge.as_slice() else { return false };
        let neighbour = if *one == cap { *other } else { *one };
        let around = self.triangles[neighbour as usize];
        let Some(side) = (0..3).find(|&k| around[k] == b && around[(k + 1) % 3] == a) else { return false };
        let d = around[(side + 2) % 3];
        if d == c || !self.on_edge(c, d).is_empty() {
            return false;
        }
        let place = |v: u32| self.places[v as usize];
        let normal = |[p, q, r]: [u32; 3]| (place(q) - place(p)).cross(place(r) - place(p));
        let before = normal(around);
        let fits = |triangle: [u32; 3]| {
            let after = normal(triangle);
            // No fold, and no new sliver.
            after.dot(before) > 0.5 * after.length() * before.length()
                && least_height(triangle.map(place)) >= self.height
        };
        if !fits([a, d, c]) || !fits([d, b, c]) {
            return false;
        }
        let along = place(b) - place(a);
        let part = (place(c) - place(a)).dot(along) / along.length_squared();
        let turn = Turn { cap, neighbour, apex, side, part: part.clamp(0.0, 1.0) as f32 };
        self.normals.turn(&turn);
        self.uvs.iter_mut().for_each(|uvs| uvs.turn(&turn));
        self.colors.turn(&turn);
        if let Some(&slot) = self.slots.get(neighbour as usize) {
            self.slots[cap as usize] = slot;
        }
        self.triangles[cap as usize] = [a, d, c];
        self.triangles[neighbour as usize] = [d, b, c];
        self.at[b as usize].retain(|t| *t != cap);
        self.at[a as usize].retain(|t| *t != neighbour);
        self.at[c as usize].push(neighbour);
        self.at[d as usize].push(cap);
        true
    }

    fn into_mesh(self) -> TriangleMesh {
        let is_kept: Vec<bool> = self.triangles.iter().map(|triangle| *triangle != GONE).collect();
        let slots = self.slots.iter().zip(&is_kept).filter(|(_, kept)| **kept).map(|(slot, _)| *slot);
        let mesh = TriangleMesh {
            positions: self.positions,
            slots: slots.collect(),
            normals: self.normals.into_attribute(&is_kept),
            uv_sets: self.uvs.into_iter().map(|uvs| uvs.into_attribute(&is_kept)).collect(),
            colors: self.colors.into_attribute(&is_kept),
            triangles: self.triangles.into_iter().filter(|triangle| *triangle != GONE).collect(),
            ..TriangleMesh::default()
        };
        clean::remove_unused_positions(&mesh).mesh
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Generator, measure};
    use luch_sampling::hash;

    /// Points put into triangles very near to a side or a corner.
    fn poked(mesh: &TriangleMesh, height: f64) -> TriangleMesh {
        let mut poked = TriangleMesh::new(mesh.positions.clone(), mesh.triangles.clone());
        for t in (0..mesh.triangles.len()).step_by(7) {
            let [a, b, c] = mesh.triangles[t];
            let corners = mesh.corners(t).map(Vec3::as_dvec3);
            let near = 0.2 * height / least_height(corners);
            // A needle's point is near to a corner, a cap's to a side.
            let other = if hash::word(1, t as u64).is_multiple_of(2) { near } else { 0.4 };
            let place = corners[0] * (1.0 - near - other) + corners[1] * other + corners[2] * near;
            let new = poked.positions.len() as u32;
            poked.positions.push(place.as_vec3());
            poked.triangles[t] = [a, b, new];
            poked.triangles.extend([[b, c, new], [c, a, new]]);
        }
        poked
    }

    #[test]
    fn needles_and_caps_go() {
        for generator in [
            Generator::Icosphere { radius: 1.0, subdivisions: 3 },
            Generator::Torus { major_radius: 1.0, minor_radius: 0.4, segments: 48, sides: 24 },
        ] {
            let mesh = generator.mesh();
            let mesh = crate::weld::weld_exact(&TriangleMesh::new(mesh.positions, mesh.triangles)).mesh;
            let height = 1e-3;
            let bad = poked(&mesh, height);
            let slivers = |mesh: &TriangleMesh| {
                (0..mesh.triangles.len())
                    .filter(|&t| least_height(mesh.corners(t).map(Vec3::as_dvec3)) < height)
                    .count()
            };
            assert!(slivers(&bad) > mesh.triangles.len() / 10);
            let good = drop_slivers(&bad, height);
            assert_eq!((slivers(&good.mesh), good.left), (0, 0), "{generator:?}");
            assert_eq!(good.mesh.validate(), []);
            let (before, after) = (measure::closedness(&bad), measure::closedness(&good.mesh));
            assert!(after.is_closed(), "{after}");
            assert_eq!(before.euler_characteristic, after.euler_characteristic);
            let ratio = measure::volume(&good.mesh) / measure::volume(&mesh);
            assert!((ratio - 1.0).abs() < 2e-3, "{ratio}");
            // What is good already stays as it is.
            assert_eq!(drop_slivers(&mesh, height).mesh, mesh);
        }
    }

    #[test]
    fn uvs_and_colours_follow() {
        let mut sheet = crate::generate::plane(Vec2::splat(2.0), [6, 6]);
        // A point nearly on the side between two triangles, with uvs that are the place.
        sheet.normals = Attribute::default();
        let poked = poked(&sheet, 1e-3);
        let uvs = poked.positions.iter().map(|p| Vec2::new(p.x, p.z)).collect();
        let colors = poked.positions.iter().map(|p| p.extend(1.0)).collect();
        let bad = TriangleMesh {
            uv_sets: vec![Attribute::per_position(uvs)],
            colors: Attribute::per_position(colors),
            ..poked
        };
        let good = drop_slivers(&bad, 1e-3);
        assert!(good.changes > 5);
        assert!((measure::area(&good.mesh) - 4.0).abs() < 1e-2);
        for t in 0..good.mesh.triangles.len() {
            let uvs = good.mesh.corner_uvs(t, 0).unwrap();
            for (uv, place) in uvs.into_iter().zip(good.mesh.corners(t)) {
                assert!(uv.distance(Vec2::new(place.x, place.z)) < 2e-3, "{uv} {place}");
            }
        }
    }
}
