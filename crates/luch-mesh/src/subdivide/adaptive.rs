//! Subdivision of only those faces that want it, without cracks.
//!
//! Each level takes the faces that are not yet fine enough, with one ring of neighbours that makes their masks whole, and
//! divides these alone. The others are done: their corners move to the limit surface. Limits of a vertex are the same from every
//! level, so faces of different levels meet in the same places; where one side has more vertices along an edge, the other
//! takes them over as a fan around its middle.

use std::collections::HashMap;
use std::ops::{Add, Mul, Range};

use glam::{Vec2, Vec3, Vec4};

use super::{Scheme, Settings, SubdivideError, subdivide, triangulated};
use crate::PolygonMesh;
use crate::polygon_mesh::CornerAttribute;
use crate::repair::{remove_unused, sound, with_faces};

/// The most levels that are gone down.
pub const MOST_ADAPTIVE_LEVELS: u32 = 16;

/// The most faces that are made, before neighbours are joined.
pub const MOST_ADAPTIVE_FACES: u64 = 1 << 23;

/// Divides a mesh by Catmull–Clark or Loop until `is_fine` says so of each face, given its corners on the limit surface, at
/// most [`MOST_ADAPTIVE_LEVELS`] times. `settings` chooses scheme, borders and uvs; its levels and flags are not looked at. The
/// result lies on the limit surface and has its normals; creases are spent. It is a function of its arguments alone.
///
/// Midpoint and √3 have no such form; for them Catmull–Clark is taken.
///
/// # Errors
/// [`SubdivideError::TooFine`] if there would be more than [`MOST_ADAPTIVE_FACES`].
pub fn subdivide_adaptively(
    mesh: &PolygonMesh,
    settings: &Settings,
    is_fine: &dyn Fn(&[Vec3]) -> bool,
) -> Result<PolygonMesh, SubdivideError> {
    let is_loop = settings.scheme == Scheme::Loop;
    let mut cage = sound(mesh).mesh;
    if is_loop && (0..cage.face_count()).any(|face| cage.face(face).len() != 3) {
        cage = triangulated(&cage);
    }
    let scheme = if is_loop { Scheme::Loop } else { Scheme::CatmullClark };
    let step = Settings { scheme, levels: 1, limit: false, normals: false, ..*settings };
    let limit = Settings { levels: 0, limit: true, ..step };
    let mut result = Pieces::default();
    let mut level = Level::of_cage(cage, &mut result);
    for depth in 0..=MOST_ADAPTIVE_LEVELS {
        let surface = subdivide(&level.mesh, &limit)?;
        let is_blunting = blunting(&level.mesh);
        let wants_more: Vec<bool> = (0..surface.face_count())
            .map(|face| {
                let corners: Vec<Vec3> =
                    surface.face(face).map(|c| surface.positions[surface.corners[c] as usize]).collect();
                let blunts = surface.face(face).any(|c| is_blunting[surface.corners[c] as usize]);
                level.is_own[face] && depth < MOST_ADAPTIVE_LEVELS && (blunts || !is_fine(&corners))
            })
            .collect();
        result.take(&surface, &level, &wants_more)?;
        if !wants_more.contains(&true) {
            break;
        }
        level = level.refined(&wants_more, &step, &mut result)?;
    }
    Ok(result.into_mesh())
}

/// Whether a vertex is at an edge, or is one, that is sharp for some levels more: the limit is then known only below them.
fn blunting(mesh: &PolygonMesh) -> Vec<bool> {
    let mut is_blunting = vec![false; mesh.positions.len()];
    let goes_blunt = |sharpness: f32| sharpness > 0.0 && sharpness < MOST_ADAPTIVE_LEVELS as f32;
    for crease in mesh.creases.iter().filter(|crease| goes_blunt(crease.sharpness)) {
        crease.vertices.into_iter().for_each(|vertex| is_blunting[vertex as usize] = true);
    }
    for sharp in mesh.sharp_vertices.iter().filter(|sharp| goes_blunt(sharp.sharpness)) {
        is_blunting[sharp.vertex as usize] = true;
    }
    is_blunting
}

/// What is looked at on one level: faces that may go on, and a ring around them.
struct Level {
    mesh: PolygonMesh,
    /// Whether a face is part of the surface here; the ring is not.
    is_own: Vec<bool>,
    /// For each vertex its number in the result.
    numbers: Vec<u32>,
}

impl Level {
    fn of_cage(mesh: PolygonMesh, result: &mut Pieces) -> Self {
        let numbers = (0..mesh.positions.len()).map(|_| result.new_vertex()).collect();
        Self { is_own: vec![true; mesh.face_count()], numbers, mesh }
    }

    /// The faces that want more, divided.
    fn refined(
        &self,
        wants_more: &[bool],
        step: &Settings,
        result: &mut Pieces,
    ) -> Result<Self, SubdivideError> {
        let mesh = &self.mesh;
        let mut is_near = vec![false; mesh.positions.len()];
        for face in (0..mesh.face_count()).filter(|&face| wants_more[face]) {
            mesh.corners[mesh.face(face)].iter().for_each(|&vertex| is_near[vertex as usize] = true);
        }
        let kept: Vec<u32> = (0..mesh.face_count() as u32)
            .filter(|&face| mesh.corners[mesh.face(face as usize)].iter().any(|&v| is_near[v as usize]))
            .collect();
        let part = with_faces(mesh, &kept);
        let mut vertices = part.corners.clone();
        vertices.sort_unstable();
        vertices.dedup();
        // What is left keeps its order.
        let part = remove_unused(&part).mesh;
        let finer = subdivide(&part, step)?;
        let mut numbers: Vec<u32> = vertices.iter().map(|&vertex| self.numbers[vertex as usize]).collect();
        numbers.resize(finer.positions.len(), u32::MAX);
        let mut is_own = Vec::with_capacity(finer.face_count());
        for (face, &from) in kept.iter().enumerate() {
            let corners = part.face(face);
            let count = corners.len();
            let children = is_own.len();
            let wants = wants_more[from as usize];
            let is_loop = step.scheme == Scheme::Loop;
            is_own.resize(children + if is_loop { 4 } else { count }, wants);
            if !wants {
                continue;
            }
            for place in 0..count {
                // The second corner of child `place` is the middle of the edge that begins there, in both schemes.
                let child = finer.face(children + place).start;
                let ends = [corners.start + place, corners.start + (place + 1) % count]
                    .map(|corner| numbers[part.corners[corner] as usize]);
                let middle = finer.corners[child + 1] as usize;
                numbers[middle] = result.middle_of(ends);
                if !is_loop && place == 0 {
                    numbers[finer.corners[child + 2] as usize] = result.new_vertex();
                }
            }
        }
        Ok(Self { mesh: finer, is_own, numbers })
    }
}

/// What is finished.
#[derive(Default)]
struct Pieces {
    /// By number of the vertex; those that no finished face has yet are zero.
    positions: Vec<Vec3>,
    /// The vertex on an edge that was divided, by its ends, the lower first.
    middles: HashMap<[u32; 2], u32>,
    /// Faces one after another, before they take over vertices of their neighbours.
    corners: Vec<Corner>,
    uvs: Vec<Vec<Vec2>>,
    colors: Vec<Vec4>,
    face_ends: Vec<u32>,
    slots: Vec<u16>,
    smoothing_groups: Vec<u32>,
}

#[derive(Clone, Copy)]
struct Corner {
    vertex: u32,
    normal: Vec3,
}

impl Pieces {
    fn new_vertex(&mut self) -> u32 {
        self.positions.push(Vec3::ZERO);
        self.positions.len() as u32 - 1
    }

    /// The vertex in the middle of an edge.
    fn middle_of(&mut self, ends: [u32; 2]) -> u32 {
        let [a, b] = ends;
        let key = [a.min(b), a.max(b)];
        if let Some(&middle) = self.middles.get(&key) {
            return middle;
        }
        let middle = self.new_vertex();
        self.middles.insert(key, middle);
        middle
    }

    /// Takes over the faces of a level that want no more.
    fn take(
        &mut self,
        surface: &PolygonMesh,
        level: &Level,
        wants_more: &[bool],
    ) -> Result<(), SubdivideError> {
        self.uvs.resize_with(surface.uv_sets.len(), Vec::new);
        for face in (0..surface.face_count()).filter(|&face| level.is_own[face] && !wants_more[face]) {
            for corner in surface.face(face) {
                let vertex = surface.corners[corner];
                let number = level.numbers[vertex as usize];
                self.positions[number as usize] = surface.positions[vertex as usize];
                let normal = value_at(&surface.normals, surface, corner).unwrap_or(Vec3::Z);
                self.corners.push(Corner { vertex: number, normal });
                for (all, set) in self.uvs.iter_mut().zip(&surface.uv_sets) {
                    all.push(value_at(set, surface, corner).unwrap_or(Vec2::ZERO));
                }
                self.colors.extend(value_at(&surface.colors, surface, corner));
            }
            self.face_ends.push(self.corners.len() as u32);
            self.slots.extend(surface.slots.get(face));
            self.smoothing_groups.extend(surface.smoothing_groups.get(face));
        }
        // Every face that wants more becomes at least three.
        let waiting = wants_more.iter().filter(|wants| **wants).count() as u64;
        if self.face_ends.len() as u64 + 3 * waiting > MOST_ADAPTIVE_FACES {
            return Err(SubdivideError::TooFine);
        }
        Ok(())
    }

    fn into_mesh(self) -> PolygonMesh {
        let mut output = Stitched {
            mesh: PolygonMesh { positions: self.positions.clone(), ..Default::default() },
            normals: Shared::default(),
            uvs: vec![Shared::default(); self.uvs.len()],
            colors: Shared::default(),
        };
        let mut start = 0;
        let mut rim = Vec::new();
        for (face, &end) in self.face_ends.iter().enumerate() {
            let corners = start as usize..end as usize;
            start = end;
            rim.clear();
            for corner in corners.clone() {
                let next = if corner + 1 == corners.end { corners.start } else { corner + 1 };
                let [a, b] = [corner, next].map(|corner| self.corners[corner].vertex);
                let from = Place { vertex: a, corners: [corner, next], part: 0.0 };
                self.walk([a, b], from, 1.0, &mut rim);
            }
            let count = output.mesh.face_ends.len();
            if rim.len() == corners.len() {
                output.add_face(&self, &rim, None);
            } else {
                let vertex = output.add_middle(&self, corners.clone());
                for (k, place) in rim.iter().enumerate() {
                    let next = rim[(k + 1) % rim.len()];
                    output.add_face(&self, &[*place, next], Some((vertex, corners.clone())));
                }
            }
            let made = output.mesh.face_ends.len() - count;
            output.mesh.slots.extend(self.slots.get(face).into_iter().flat_map(|&slot| vec![slot; made]));
            let group = self.smoothing_groups.get(face).into_iter();
            output.mesh.smoothing_groups.extend(group.flat_map(|&group| vec![group; made]));
        }
        output.into_mesh()
    }

    /// The vertices along an edge from its first end on, without the last.
    fn walk(&self, [a, b]: [u32; 2], from: Place, until: f32, rim: &mut Vec<Place>) {
        let Some(&middle) = self.middles.get(&[a.min(b), a.max(b)]) else {
            rim.push(from);
            return;
        };
        let half = Place { vertex: middle, part: (from.part + until) / 2.0, ..from };
        self.walk([a, middle], from, half.part, rim);
        self.walk([middle, b], half, until, rim);
    }
}

/// A vertex on the rim of a face: so far along the edge between two of its corners.
#[derive(Clone, Copy)]
struct Place {
    vertex: u32,
    corners: [usize; 2],
    part: f32,
}

impl Place {
    fn blend<T: Copy + Add<Output = T> + Mul<f32, Output = T>>(&self, value: impl Fn(usize) -> T) -> T {
        let [a, b] = self.corners;
        if self.part == 0.0 { value(a) } else { value(a) * (1.0 - self.part) + value(b) * self.part }
    }
}

/// Values of corners; a vertex that comes with the value it had first shares it.
#[derive(Clone)]
struct Shared<T> {
    attribute: CornerAttribute<T>,
    first_of: Vec<u32>,
}

impl<T> Default for Shared<T> {
    fn default() -> Self {
        Self { attribute: CornerAttribute::default(), first_of: Vec::new() }
    }
}

impl<T: Copy + PartialEq> Shared<T> {
    fn push(&mut self, vertex: u32, value: T) {
        let vertex = vertex as usize;
        if self.first_of.len() <= vertex {
            self.first_of.resize(vertex + 1, u32::MAX);
        }
        let values = &mut self.attribute.values;
        let first = self.first_of[vertex];
        let place = if values.get(first as usize) == Some(&value) {
            first
        } else {
            values.push(value);
            values.len() as u32 - 1
        };
        if first == u32::MAX {
            self.first_of[vertex] = place;
        }
        self.attribute.corners.push(place);
    }
}

struct Stitched {
    mesh: PolygonMesh,
    normals: Shared<Vec3>,
    uvs: Vec<Shared<Vec2>>,
    colors: Shared<Vec4>,
}

impl Stitched {
    /// A vertex amid the corners of a face, raised half-way to their tangent planes: where a ball would be.
    fn add_middle(&mut self, pieces: &Pieces, corners: Range<usize>) -> u32 {
        let place = |corner: usize| pieces.positions[pieces.corners[corner].vertex as usize];
        let middle = mean(corners.clone(), place);
        let to_plane = |corner: usize| {
            let normal = pieces.corners[corner].normal;
            normal * normal.dot(place(corner) - middle)
        };
        self.mesh.positions.push(middle + mean(corners, to_plane) * 0.5);
        self.mesh.positions.len() as u32 - 1
    }

    /// A face of some places and perhaps the middle of some corners.
    fn add_face(&mut self, pieces: &Pieces, places: &[Place], middle: Option<(u32, Range<usize>)>) {
        let normal = |corner: usize| pieces.corners[corner].normal;
        for place in places {
            self.mesh.corners.push(place.vertex);
            let own = place.blend(normal);
            self.normals.push(place.vertex, own.try_normalize().unwrap_or(own));
            for (shared, uvs) in self.uvs.iter_mut().zip(&pieces.uvs) {
                shared.push(place.vertex, place.blend(|corner| uvs[corner]));
            }
            if !pieces.colors.is_empty() {
                self.colors.push(place.vertex, place.blend(|corner| pieces.colors[corner]));
            }
        }
        if let Some((vertex, corners)) = middle {
            self.mesh.corners.push(vertex);
            self.normals.push(vertex, mean(corners.clone(), normal).try_normalize().unwrap_or(Vec3::Z));
            for (shared, uvs) in self.uvs.iter_mut().zip(&pieces.uvs) {
                shared.push(vertex, mean(corners.clone(), |corner| uvs[corner]));
            }
            if !pieces.colors.is_empty() {
                self.colors.push(vertex, mean(corners, |corner| pieces.colors[corner]));
            }
        }
        self.mesh.face_ends.push(self.mesh.corners.len() as u32);
    }

    fn into_mesh(self) -> PolygonMesh {
        let mut mesh = self.mesh;
        mesh.normals = self.normals.attribute;
        mesh.uv_sets = self.uvs.into_iter().map(|uvs| uvs.attribute).collect();
        mesh.colors = self.colors.attribute;
        // Vertices of masks that no face has.
        remove_unused(&mesh).mesh
    }
}

fn mean<T: Copy + Add<Output = T> + Mul<f32, Output = T>>(
    corners: Range<usize>,
    value: impl Fn(usize) -> T,
) -> T {
    let share = 1.0 / corners.len() as f32;
    let first = value(corners.start) * share;
    (corners.start + 1..corners.end).fold(first, |sum, corner| sum + value(corner) * share)
}

fn value_at<T: Copy>(attribute: &CornerAttribute<T>, mesh: &PolygonMesh, corner: usize) -> Option<T> {
    let place =
        attribute.corners.get(corner).or(mesh.corners.get(corner).filter(|_| attribute.corners.is_empty()));
    attribute.values.get(*place? as usize).copied()
}
