//! Building a changed mesh from an old one: corner values are mixed from those of old corners, creases follow.

mod lane;

use std::collections::BTreeMap;

use glam::{Vec2, Vec3, Vec4};

use super::geometry::{area_vector_of, unit_normal};
use crate::PolygonMesh;
use crate::polygon_mesh::{Crease, Hole, SharpVertex};
use lane::Lane;

/// Where a vertex comes from; creases follow it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Origin {
    /// From nowhere in particular.
    New,
    /// From a vertex of the source, or a copy of it.
    Of(u32),
    /// From the inside of an edge of the source.
    Between(u32, u32),
}

/// Values of a new corner, from corners of the source.
#[derive(Clone, Debug)]
pub(super) enum Mix {
    /// Those of one corner.
    One(u32),
    /// A sum of corners with weights that add up to one.
    Many(Vec<(u32, f64)>),
}

/// Texture coordinates of a new corner.
#[derive(Clone, Copy, Debug)]
pub(super) enum Uv {
    /// Mixed as everything else.
    Mixed,
    /// Given, in all sets.
    At(Vec2),
    /// Mixed, then moved to the right of the way between two corners, by the ratio to that way's length.
    Unfolded { from: u32, to: u32, ratio: f64 },
}

/// A corner to be made.
#[derive(Clone, Debug)]
pub(super) struct NewCorner {
    pub(super) vertex: u32,
    pub(super) mix: Mix,
    pub(super) uv: Uv,
}

impl NewCorner {
    /// A vertex with the values of a corner of the source.
    pub(super) fn like(vertex: u32, corner: u32) -> Self {
        Self { vertex, mix: Mix::One(corner), uv: Uv::Mixed }
    }

    /// A vertex with mixed values.
    pub(super) fn mixed(vertex: u32, mix: Vec<(u32, f64)>) -> Self {
        Self { vertex, mix: Mix::Many(mix), uv: Uv::Mixed }
    }
}

/// Where the normals of a new face come from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Shade {
    /// Mixed as everything else.
    Mixed,
    /// The normal of the face.
    Flat,
}

/// A mesh in the making.
pub(super) struct Builder<'a> {
    source: &'a PolygonMesh,
    mesh: PolygonMesh,
    normals: Lane<'a, Vec3>,
    uv_sets: Vec<Lane<'a, Vec2>>,
    colors: Lane<'a, Vec4>,
    origins: Vec<Origin>,
    /// Faces that get their own normal, and whether they belong to the smoothing groups.
    flat_faces: Vec<u32>,
}

impl<'a> Builder<'a> {
    /// Begins with all positions of a prepared mesh and none of its faces.
    pub(super) fn new(source: &'a PolygonMesh) -> Self {
        let mesh = PolygonMesh {
            positions: source.positions.clone(),
            corners: Vec::with_capacity(source.corners.len()),
            face_ends: Vec::with_capacity(source.face_count()),
            ..Default::default()
        };
        Self {
            source,
            mesh,
            normals: Lane::new(&source.normals),
            uv_sets: source.uv_sets.iter().map(Lane::new).collect(),
            colors: Lane::new(&source.colors),
            origins: (0..source.positions.len() as u32).map(Origin::Of).collect(),
            flat_faces: Vec::new(),
        }
    }

    /// Adds a vertex.
    pub(super) fn vertex(&mut self, position: glam::DVec3, origin: Origin) -> u32 {
        self.mesh.positions.push(super::geometry::to_position(position));
        self.origins.push(origin);
        self.mesh.positions.len() as u32 - 1
    }

    /// Adds a vertex at the place of another of the source.
    pub(super) fn copy_vertex(&mut self, vertex: u32) -> u32 {
        self.mesh.positions.push(self.source.positions[vertex as usize]);
        self.origins.push(Origin::Of(vertex));
        self.mesh.positions.len() as u32 - 1
    }

    /// Moves a vertex.
    pub(super) fn move_vertex(&mut self, vertex: u32, position: glam::DVec3) {
        self.mesh.positions[vertex as usize] = super::geometry::to_position(position);
    }

    /// Adds a face of corners like old ones whose normals stand so much later in the list.
    pub(super) fn face_with_shifted_normals(&mut self, like: usize, borders: &[Vec<NewCorner>], shift: u32) {
        let start = self.normals.out.corners.len();
        self.face(like, borders, Shade::Mixed, None);
        self.normals.out.corners[start..].iter_mut().for_each(|number| *number += shift);
    }

    /// The place of a vertex, old or new.
    pub(super) fn place(&self, vertex: u32) -> glam::DVec3 {
        self.mesh.positions[vertex as usize].as_dvec3()
    }

    /// Adds a face of the source as it is.
    pub(super) fn copy_face(&mut self, face: usize) {
        self.copy_face_with(face, |corner| self_vertex(self.source, corner));
    }

    /// Adds a face of the source with other vertices at its corners.
    pub(super) fn copy_face_with(&mut self, face: usize, vertex_of: impl Fn(u32) -> u32) {
        let corners = self.source.face(face);
        if corners.is_empty() {
            return;
        }
        let shift = |start: u32| start as usize - corners.start + self.mesh.corners.len();
        let first_hole = self.source.holes.partition_point(|hole| (hole.face as usize) < face);
        for hole in self.source.holes[first_hole..].iter().take_while(|hole| hole.face as usize == face) {
            let (face, start) = (self.mesh.face_ends.len() as u32, shift(hole.start) as u32);
            self.mesh.holes.push(Hole { face, start });
        }
        self.mesh.corners.extend(corners.clone().map(|corner| vertex_of(corner as u32)));
        self.normals.copy(corners.clone());
        self.colors.copy(corners.clone());
        self.uv_sets.iter_mut().for_each(|uvs| uvs.copy(corners.clone()));
        self.end_face(face, None, Shade::Mixed);
    }

    /// Adds a face of the source turned round, with other vertices at its corners.
    pub(super) fn turn_face_with(&mut self, face: usize, vertex_of: impl Fn(u32) -> u32) {
        let borders = self.source.borders(face);
        let turned = borders.into_iter().map(|border| {
            border.rev().map(|corner| NewCorner::like(vertex_of(corner as u32), corner as u32)).collect()
        });
        let turned: Vec<Vec<NewCorner>> = turned.collect();
        let start = self.normals.out.corners.len();
        self.face(face, &turned, Shade::Mixed, None);
        for corner in start..self.normals.out.corners.len() {
            let normal = -self.normals.out.values[self.normals.out.corners[corner] as usize];
            self.normals.out.corners[corner] = self.normals.number(normal);
        }
    }

    /// Adds a face with slot and group of a face of the source, unless another slot is given.
    ///
    /// One without area becomes triangles: as a whole it would be lost when triangles are made, and its neighbours
    /// would stand open.
    pub(super) fn face(&mut self, like: usize, borders: &[Vec<NewCorner>], shade: Shade, slot: Option<u16>) {
        match borders {
            [outer] if outer.len() > 3 && self.has_no_area(outer) => {
                for pair in outer[1..].windows(2) {
                    let triangle = vec![outer[0].clone(), pair[0].clone(), pair[1].clone()];
                    self.whole_face(like, &[triangle], shade, slot);
                }
            }
            [outer, ..] if outer.len() > 2 => self.whole_face(like, borders, shade, slot),
            _ => {}
        }
    }

    fn has_no_area(&self, border: &[NewCorner]) -> bool {
        let places = || border.iter().map(|corner| self.place(corner.vertex));
        let first = self.place(border[0].vertex);
        let size = places().map(|place| place.distance_squared(first)).fold(0.0, f64::max);
        // Single precision makes this much area of a line.
        area_vector_of(places()).length() <= 1e-6 * size
    }

    fn whole_face(&mut self, like: usize, borders: &[Vec<NewCorner>], shade: Shade, slot: Option<u16>) {
        for (number, border) in borders.iter().enumerate() {
            if number > 0 {
                let (face, start) = (self.mesh.face_ends.len() as u32, self.mesh.corners.len() as u32);
                self.mesh.holes.push(Hole { face, start });
            }
            for corner in border {
                self.mesh.corners.push(corner.vertex);
                self.normals.push(corner, shade == Shade::Flat);
                self.colors.push(corner, false);
                for uvs in &mut self.uv_sets {
                    uvs.push_uv(corner);
                }
            }
        }
        self.end_face(like, slot, shade);
    }

    fn end_face(&mut self, like: usize, slot: Option<u16>, shade: Shade) {
        let face = self.mesh.face_ends.len();
        self.mesh.face_ends.push(self.mesh.corners.len() as u32);
        if slot.is_some() && self.source.slots.is_empty() {
            self.mesh.slots.resize(face, 0);
        }
        if !self.source.slots.is_empty() || !self.mesh.slots.is_empty() || slot.is_some() {
            let inherited = self.source.slots.get(like).copied().unwrap_or(0);
            self.mesh.slots.push(slot.unwrap_or(inherited));
        }
        if !self.source.smoothing_groups.is_empty() {
            let group = if shade == Shade::Flat { 0 } else { self.source.smoothing_groups[like] };
            self.mesh.smoothing_groups.push(group);
        }
        if shade == Shade::Flat {
            self.flat_faces.push(face as u32);
        }
    }

    /// The mesh: without vertices and values that lost their last face, with the creases of the edges that are left.
    pub(super) fn finish(mut self) -> PolygonMesh {
        let mut mesh = std::mem::take(&mut self.mesh);
        if self.normals.is_present() {
            for &face in &self.flat_faces {
                let normal = unit_normal(&mesh, face as usize);
                let normal = if normal == glam::DVec3::ZERO { Vec3::Z } else { normal.as_vec3() };
                self.normals.out.values.push(normal);
                let number = self.normals.out.values.len() as u32 - 1;
                self.normals.out.corners[mesh.face(face as usize)].fill(number);
            }
        }
        mesh.normals = self.normals.finish();
        mesh.colors = self.colors.finish();
        mesh.uv_sets = self.uv_sets.into_iter().map(Lane::finish).collect();
        mesh.creases = creases(self.source, &mesh, &self.origins);
        mesh.sharp_vertices = sharp_vertices(self.source, &self.origins);
        drop_orphans(self.source, &mut mesh);
        mesh
    }
}

fn self_vertex(source: &PolygonMesh, corner: u32) -> u32 {
    source.corners[corner as usize]
}

/// The creases of the new edges: each lies on an edge of the source, whole or in part.
fn creases(source: &PolygonMesh, mesh: &PolygonMesh, origins: &[Origin]) -> Vec<Crease> {
    if source.creases.is_empty() {
        return Vec::new();
    }
    let mut sharpness: BTreeMap<[u32; 2], f32> = BTreeMap::new();
    for crease in &source.creases {
        let [one, other] = crease.vertices;
        let known = sharpness.entry([one.min(other), one.max(other)]).or_insert(crease.sharpness);
        *known = known.max(crease.sharpness);
    }
    let mut made: BTreeMap<[u32; 2], f32> = BTreeMap::new();
    for face in 0..mesh.face_count() {
        for border in mesh.borders(face) {
            for corner in border.clone() {
                let next = if corner + 1 == border.end { border.start } else { corner + 1 };
                let [from, to] = [mesh.corners[corner], mesh.corners[next]];
                let Some(edge) = edge_under(origins[from as usize], origins[to as usize]) else { continue };
                if let Some(&found) = sharpness.get(&edge) {
                    made.insert([from.min(to), from.max(to)], found);
                }
            }
        }
    }
    made.into_iter().map(|(vertices, sharpness)| Crease { vertices, sharpness }).collect()
}

/// The edge of the source that two vertices lie on.
fn edge_under(one: Origin, other: Origin) -> Option<[u32; 2]> {
    let edge = match (one, other) {
        (Origin::Of(a), Origin::Of(b)) if a != b => [a, b],
        (Origin::Between(a, b), Origin::Of(c)) | (Origin::Of(c), Origin::Between(a, b))
            if c == a || c == b =>
        {
            [a, b]
        }
        (Origin::Between(a, b), Origin::Between(c, d)) if [a, b] == [c, d] => [a, b],
        _ => return None,
    };
    Some([edge[0].min(edge[1]), edge[0].max(edge[1])])
}

fn sharp_vertices(source: &PolygonMesh, origins: &[Origin]) -> Vec<SharpVertex> {
    if source.sharp_vertices.is_empty() {
        return Vec::new();
    }
    let mut sharpness: BTreeMap<u32, f32> = BTreeMap::new();
    for sharp in &source.sharp_vertices {
        let known = sharpness.entry(sharp.vertex).or_insert(sharp.sharpness);
        *known = known.max(sharp.sharpness);
    }
    let found = origins.iter().enumerate().filter_map(|(vertex, origin)| match origin {
        Origin::Of(old) => {
            sharpness.get(old).map(|&sharpness| SharpVertex { vertex: vertex as u32, sharpness })
        }
        _ => None,
    });
    found.collect()
}

/// Leaves out the positions that no face uses, except those that the source did not use either.
fn drop_orphans(source: &PolygonMesh, mesh: &mut PolygonMesh) {
    let used = |mesh: &PolygonMesh, count: usize| {
        let mut used = vec![false; count];
        mesh.corners.iter().for_each(|&vertex| used[vertex as usize] = true);
        used
    };
    let used_before = used(source, source.positions.len());
    let mut keep = used(mesh, mesh.positions.len());
    for (keep, before) in keep.iter_mut().zip(&used_before) {
        *keep |= !before;
    }
    if keep.iter().all(|&keep| keep) {
        return;
    }
    let mut numbers = vec![0; keep.len()];
    let mut count = 0;
    for (number, keep) in numbers.iter_mut().zip(&keep) {
        *number = count;
        count += u32::from(*keep);
    }
    let mut flags = keep.iter();
    mesh.positions.retain(|_| flags.next().copied().unwrap_or(false));
    mesh.corners.iter_mut().for_each(|vertex| *vertex = numbers[*vertex as usize]);
    mesh.creases.retain(|crease| crease.vertices.iter().all(|&vertex| keep[vertex as usize]));
    for crease in &mut mesh.creases {
        crease.vertices = crease.vertices.map(|vertex| numbers[vertex as usize]);
    }
    mesh.sharp_vertices.retain(|sharp| keep[sharp.vertex as usize]);
    mesh.sharp_vertices.iter_mut().for_each(|sharp| sharp.vertex = numbers[sharp.vertex as usize]);
}
