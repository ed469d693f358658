//! Taking apart: deleting, detaching, copying, tearing along edges, components; turning round and marking faces.

use glam::DVec3;

use super::builder::{Builder, Origin};
use super::error::check_size;
use super::fans::Fans;
use super::{EditError, prepared};
use crate::PolygonMesh;
use crate::polygon_mesh::HalfEdges;
use crate::sets::DisjointSets;

fn is_marked(faces: &[bool], face: usize) -> bool {
    faces.get(face).copied().unwrap_or(false)
}

/// The mesh without the marked faces, and without the vertices and values that only they used.
pub fn delete_faces(mesh: &PolygonMesh, faces: &[bool]) -> PolygonMesh {
    let mesh = &*prepared(mesh);
    let mut builder = Builder::new(mesh);
    (0..mesh.face_count()).filter(|&face| !is_marked(faces, face)).for_each(|face| builder.copy_face(face));
    builder.finish()
}

/// Makes the marked faces a piece of their own: along their border vertices are doubled.
pub fn detach(mesh: &PolygonMesh, faces: &[bool]) -> PolygonMesh {
    let mesh = &*prepared(mesh);
    let mut stays = vec![false; mesh.positions.len()];
    for face in (0..mesh.face_count()).filter(|&face| !is_marked(faces, face)) {
        mesh.corners[mesh.face(face)].iter().for_each(|&vertex| stays[vertex as usize] = true);
    }
    let mut builder = Builder::new(mesh);
    let mut copies = vec![None; mesh.positions.len()];
    for face in 0..mesh.face_count() {
        if !is_marked(faces, face) {
            builder.copy_face(face);
            continue;
        }
        for &vertex in mesh.corners[mesh.face(face)].iter().filter(|vertex| stays[**vertex as usize]) {
            copies[vertex as usize].get_or_insert_with(|| builder.copy_vertex(vertex));
        }
        builder.copy_face_with(face, |corner| {
            let vertex = mesh.corners[corner as usize];
            copies[vertex as usize].unwrap_or(vertex)
        });
    }
    builder.finish()
}

/// Adds a copy of the marked faces, moved by a vector.
pub fn duplicate(mesh: &PolygonMesh, faces: &[bool], way: DVec3) -> Result<PolygonMesh, EditError> {
    let mesh = &*prepared(mesh);
    check_size(mesh.face_count() as u64 * 2, mesh.corners.len() as u64 * 2)?;
    let mut builder = Builder::new(mesh);
    (0..mesh.face_count()).for_each(|face| builder.copy_face(face));
    let mut copies = vec![None; mesh.positions.len()];
    for face in (0..mesh.face_count()).filter(|&face| is_marked(faces, face)) {
        for &vertex in &mesh.corners[mesh.face(face)] {
            copies[vertex as usize].get_or_insert_with(|| {
                let place = mesh.positions[vertex as usize].as_dvec3() + way;
                builder.vertex(place, Origin::Of(vertex))
            });
        }
        builder.copy_face_with(face, |corner| {
            let vertex = mesh.corners[corner as usize];
            copies[vertex as usize].unwrap_or(vertex)
        });
    }
    Ok(builder.finish())
}

/// Tears the surface along edges: faces on both sides get vertices of their own wherever the tear parts them.
///
/// `edges` are rising, lower end first. A single edge inside a surface parts nothing: its ends hold both sides together.
pub fn rip(mesh: &PolygonMesh, edges: &[[u32; 2]]) -> PolygonMesh {
    let mesh = &*prepared(mesh);
    let half_edges = HalfEdges::new(mesh);
    let opposites = half_edges.opposites();
    let mut fans = Fans::new(&half_edges, &opposites, |one, _| {
        let [from, to] = half_edges.ends(one);
        edges.binary_search(&[from.min(to), from.max(to)]).is_err()
    });
    let mut is_at_tear = vec![false; mesh.positions.len()];
    for &end in edges.iter().flatten().filter(|end| (**end as usize) < mesh.positions.len()) {
        is_at_tear[end as usize] = true;
    }
    let mut builder = Builder::new(mesh);
    // The first fan at a vertex keeps it.
    let mut owner: Vec<Option<u32>> = vec![None; mesh.positions.len()];
    let mut copies: Vec<Option<u32>> = vec![None; mesh.corners.len()];
    for corner in 0..mesh.corners.len() as u32 {
        let vertex = mesh.corners[corner as usize];
        let fan = fans.of(corner);
        if is_at_tear[vertex as usize] && *owner[vertex as usize].get_or_insert(fan) != fan {
            let copy = copies[fan as usize].unwrap_or_else(|| builder.copy_vertex(vertex));
            (copies[fan as usize], copies[corner as usize]) = (Some(copy), Some(copy));
        }
    }
    for face in 0..mesh.face_count() {
        builder
            .copy_face_with(face, |corner| copies[corner as usize].unwrap_or(mesh.corners[corner as usize]));
    }
    builder.finish()
}

/// For each face the number of its piece, `None` for faces without corners. Pieces hang together by edges.
pub(super) fn component_of_faces(mesh: &PolygonMesh, half_edges: &HalfEdges) -> Vec<Option<u32>> {
    let mut sets = DisjointSets::new(mesh.face_count());
    for edge in half_edges.edges() {
        for &half_edge in &edge.half_edges[1..] {
            sets.join(half_edges.face(edge.half_edges[0]), half_edges.face(half_edge));
        }
    }
    let mut number_of = vec![None; mesh.face_count()];
    let mut count = 0;
    let numbers = (0..mesh.face_count()).map(|face| {
        if mesh.face(face).is_empty() {
            return None;
        }
        // The root is the first face of its piece.
        let number = &mut number_of[sets.root(face as u32) as usize];
        if number.is_none() {
            *number = Some(count);
            count += 1;
        }
        *number
    });
    numbers.collect()
}

/// The pieces that hang together by edges, in the order of their first faces.
pub fn components(mesh: &PolygonMesh) -> Vec<PolygonMesh> {
    let mesh = &*prepared(mesh);
    let numbers = component_of_faces(mesh, &HalfEdges::new(mesh));
    let count = numbers.iter().flatten().max().map_or(0, |most| *most as usize + 1);
    let mut parts: Vec<PartialPiece> = (0..count).map(|_| PartialPiece::default()).collect();
    for (face, number) in numbers.iter().enumerate() {
        if let Some(number) = number {
            parts[*number as usize].faces.push(face as u32);
        }
    }
    parts.into_iter().map(|part| part.build(mesh)).collect()
}

/// The piece of this number, in the order of their first faces.
pub fn component(mesh: &PolygonMesh, index: usize) -> Result<PolygonMesh, EditError> {
    let mesh = &*prepared(mesh);
    let numbers = component_of_faces(mesh, &HalfEdges::new(mesh));
    let count = numbers.iter().flatten().max().map_or(0, |most| *most as usize + 1);
    if index >= count {
        return Err(EditError::NoComponent { index, count });
    }
    let faces = (0..mesh.face_count() as u32).filter(|&face| numbers[face as usize] == Some(index as u32));
    Ok(PartialPiece { faces: faces.collect() }.build(mesh))
}

#[derive(Default)]
struct PartialPiece {
    faces: Vec<u32>,
}

impl PartialPiece {
    /// A mesh of these faces only; time goes with their number alone, so that a thousand pieces cost no more than one mesh.
    fn build(&self, mesh: &PolygonMesh) -> PolygonMesh {
        let mut used: Vec<u32> = self
            .faces
            .iter()
            .flat_map(|&face| mesh.corners[mesh.face(face as usize)].iter().copied())
            .collect();
        used.sort_unstable();
        used.dedup();
        let number = |vertex: u32| used.binary_search(&vertex).map_or(0, |found| found as u32);
        let mut part = PolygonMesh {
            positions: used.iter().map(|&vertex| mesh.positions[vertex as usize]).collect(),
            ..Default::default()
        };
        let mut corners: Vec<u32> = Vec::new();
        for &face in &self.faces {
            for (place, border) in mesh.borders(face as usize).into_iter().enumerate() {
                if place > 0 {
                    let (face, start) = (part.face_ends.len() as u32, corners.len() as u32);
                    part.holes.push(crate::polygon_mesh::Hole { face, start });
                }
                corners.extend(border.map(|corner| corner as u32));
            }
            part.face_ends.push(corners.len() as u32);
        }
        part.corners = corners.iter().map(|&corner| number(mesh.corners[corner as usize])).collect();
        part.normals = picked(&mesh.normals, &corners);
        part.colors = picked(&mesh.colors, &corners);
        part.uv_sets = mesh.uv_sets.iter().map(|uvs| picked(uvs, &corners)).collect();
        let of_faces = |face: &u32| *face as usize;
        if !mesh.slots.is_empty() {
            part.slots = self.faces.iter().map(|face| mesh.slots[of_faces(face)]).collect();
        }
        if !mesh.smoothing_groups.is_empty() {
            part.smoothing_groups =
                self.faces.iter().map(|face| mesh.smoothing_groups[of_faces(face)]).collect();
        }
        let is_used = |vertex: &u32| used.binary_search(vertex).is_ok();
        part.creases =
            mesh.creases.iter().filter(|crease| crease.vertices.iter().all(is_used)).copied().collect();
        part.creases.iter_mut().for_each(|crease| crease.vertices = crease.vertices.map(number));
        part.sharp_vertices =
            mesh.sharp_vertices.iter().filter(|sharp| is_used(&sharp.vertex)).copied().collect();
        part.sharp_vertices.iter_mut().for_each(|sharp| sharp.vertex = number(sharp.vertex));
        part
    }
}

fn picked<T: Copy>(
    attribute: &crate::polygon_mesh::CornerAttribute<T>,
    corners: &[u32],
) -> crate::polygon_mesh::CornerAttribute<T> {
    if attribute.is_empty() {
        return Default::default();
    }
    let numbers: Vec<u32> = corners.iter().map(|&corner| attribute.corners[corner as usize]).collect();
    let mut used = numbers.clone();
    used.sort_unstable();
    used.dedup();
    let values = used.iter().map(|&number| attribute.values[number as usize]).collect();
    let place = |number: &u32| used.binary_search(number).map_or(0, |found| found as u32);
    crate::polygon_mesh::CornerAttribute { values, corners: numbers.iter().map(place).collect() }
}

/// Turns the marked faces round, and their normals with them.
pub fn flip_faces(mesh: &PolygonMesh, faces: &[bool]) -> PolygonMesh {
    let mut turned = prepared(mesh).into_owned();
    // A copy that is turned whole; its corners replace those of the marked faces.
    let mut other = turned.clone();
    other.flip();
    let shift = turned.normals.values.len() as u32;
    let has_normals = !turned.normals.is_empty();
    turned.normals.values.extend(other.normals.values);
    for face in (0..turned.face_count()).filter(|&face| is_marked(faces, face)) {
        let range = turned.face(face);
        turned.corners[range.clone()].copy_from_slice(&other.corners[range.clone()]);
        if has_normals {
            let theirs = other.normals.corners[range.clone()].iter().map(|number| number + shift);
            turned.normals.corners.splice(range.clone(), theirs);
        }
        if !turned.colors.is_empty() {
            turned.colors.corners[range.clone()].copy_from_slice(&other.colors.corners[range.clone()]);
        }
        for (mine, theirs) in
            turned.uv_sets.iter_mut().zip(&other.uv_sets).filter(|(mine, _)| !mine.is_empty())
        {
            mine.corners[range.clone()].copy_from_slice(&theirs.corners[range.clone()]);
        }
    }
    let mut builder = Builder::new(&turned);
    (0..turned.face_count()).for_each(|face| builder.copy_face(face));
    builder.finish()
}

/// Gives the marked faces a material slot.
pub fn set_slot(mesh: &mut PolygonMesh, faces: &[bool], slot: u16) {
    let count = mesh.face_count();
    mesh.slots.resize(count, 0);
    for (_, place) in mesh.slots.iter_mut().enumerate().filter(|(face, _)| is_marked(faces, *face)) {
        *place = slot;
    }
}
