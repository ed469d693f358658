//! Making a mesh safe to work on: every index in range, every attribute with corner indices of its own, holes running
//! against their outer border.

use std::borrow::Cow;
use std::ops::Range;

use super::geometry::area_vector;
use crate::PolygonMesh;
use crate::polygon_mesh::{CornerAttribute, Hole};

/// The mesh with nothing in it that an operation could stumble over; the same mesh if there was nothing.
///
/// The number of faces and positions stays. Faces that name positions that do not exist, or have fewer than three
/// different corners, become faces without corners. Attributes that do not fit are left out, others get corner indices;
/// lists of slots and groups get one entry for each face. Holes run against their outer border.
pub fn prepared(mesh: &PolygonMesh) -> Cow<'_, PolygonMesh> {
    let mut mesh =
        if borders_are_sound(mesh) { Cow::Borrowed(mesh) } else { Cow::Owned(with_sound_borders(mesh)) };
    if !is_indexed(&mesh, &mesh.normals)
        || !is_indexed(&mesh, &mesh.colors)
        || !mesh.uv_sets.iter().all(|uvs| is_indexed(&mesh, uvs))
    {
        let owned = mesh.to_mut();
        let (corners, positions) = (std::mem::take(&mut owned.corners), owned.positions.len());
        index(&mut owned.normals, &corners, positions);
        index(&mut owned.colors, &corners, positions);
        owned.uv_sets.iter_mut().for_each(|uvs| index(uvs, &corners, positions));
        owned.corners = corners;
    }
    let faces = mesh.face_count();
    if !mesh.slots.is_empty() && mesh.slots.len() != faces {
        mesh.to_mut().slots.resize(faces, 0);
    }
    if !mesh.smoothing_groups.is_empty() && mesh.smoothing_groups.len() != faces {
        mesh.to_mut().smoothing_groups.resize(faces, 0);
    }
    let exists = |vertex: u32| (vertex as usize) < mesh.positions.len();
    if !mesh.creases.iter().flat_map(|crease| crease.vertices).all(exists)
        || !mesh.sharp_vertices.iter().all(|sharp| exists(sharp.vertex))
    {
        let owned = mesh.to_mut();
        let count = owned.positions.len() as u32;
        owned.creases.retain(|crease| crease.vertices.iter().all(|&vertex| vertex < count));
        owned.sharp_vertices.retain(|sharp| sharp.vertex < count);
    }
    mesh
}

fn is_indexed<T>(mesh: &PolygonMesh, attribute: &CornerAttribute<T>) -> bool {
    let (corners, values) = (&attribute.corners, &attribute.values);
    (values.is_empty() && corners.is_empty())
        || (corners.len() == mesh.corners.len() && corners.iter().all(|&i| (i as usize) < values.len()))
}

fn index<T>(attribute: &mut CornerAttribute<T>, corners: &[u32], positions: usize) {
    let count = attribute.values.len();
    if attribute.corners.is_empty() && count >= positions {
        attribute.corners = corners.to_vec();
    }
    if attribute.corners.len() != corners.len() || attribute.corners.iter().any(|&i| i as usize >= count) {
        *attribute = CornerAttribute::default();
    }
    if attribute.corners.is_empty() {
        attribute.values.clear();
    }
}

fn borders_are_sound(mesh: &PolygonMesh) -> bool {
    let ends = mesh.face_ends.windows(2).all(|pair| pair[0] <= pair[1])
        && mesh.face_ends.last().map_or(0, |end| *end as usize) == mesh.corners.len();
    ends && mesh.holes.windows(2).all(|pair| (pair[0].face, pair[0].start) < (pair[1].face, pair[1].start))
        && mesh.holes.last().is_none_or(|hole| (hole.face as usize) < mesh.face_count())
        && (0..mesh.face_count()).all(|face| {
            let whole = mesh.face(face);
            let is_sound = |border: Range<usize>| {
                let corners = &mesh.corners[border];
                let next = corners.iter().cycle().skip(1);
                corners.len() > 2
                    && corners.iter().all(|&vertex| (vertex as usize) < mesh.positions.len())
                    && corners.iter().zip(next).all(|(one, other)| one != other)
            };
            if whole.is_empty() {
                return true;
            }
            if mesh.holes.is_empty() {
                return is_sound(whole);
            }
            let borders = mesh.borders(face);
            let outward = area_vector(mesh, borders[0].clone());
            borders.iter().cloned().all(is_sound)
                && borders[1..].iter().all(|hole| area_vector(mesh, hole.clone()).dot(outward) <= 0.0)
        })
}

fn with_sound_borders(mesh: &PolygonMesh) -> PolygonMesh {
    // The corners that stay, in their new order.
    let mut kept: Vec<u32> = Vec::with_capacity(mesh.corners.len());
    let mut face_ends = Vec::with_capacity(mesh.face_count());
    let mut holes = Vec::new();
    let mut sorted = mesh.clone();
    sorted.holes.sort_by_key(|hole| (hole.face, hole.start));
    for face in 0..mesh.face_count() {
        let borders = sorted.borders(face);
        let distinct: Vec<Vec<u32>> = borders.into_iter().map(|border| distinct(mesh, border)).collect();
        let is_in_range =
            distinct.iter().flatten().all(|&c| (mesh.corners[c as usize] as usize) < mesh.positions.len());
        if is_in_range && distinct[0].len() > 2 {
            let outward = area_of(mesh, &distinct[0]);
            kept.extend(&distinct[0]);
            for mut hole in distinct.into_iter().skip(1).filter(|hole| hole.len() > 2) {
                if area_of(mesh, &hole).dot(outward) > 0.0 {
                    hole.reverse();
                }
                holes.push(Hole { face: face as u32, start: kept.len() as u32 });
                kept.extend(hole);
            }
        }
        face_ends.push(kept.len() as u32);
    }
    fn pick<T: Copy>(attribute: &CornerAttribute<T>, kept: &[u32]) -> CornerAttribute<T> {
        let corners = kept.iter().map_while(|&corner| attribute.corners.get(corner as usize).copied());
        CornerAttribute { values: attribute.values.clone(), corners: corners.collect() }
    }
    PolygonMesh {
        positions: mesh.positions.clone(),
        corners: kept.iter().map(|&corner| mesh.corners[corner as usize]).collect(),
        face_ends,
        holes,
        normals: pick(&mesh.normals, &kept),
        uv_sets: mesh.uv_sets.iter().map(|uvs| pick(uvs, &kept)).collect(),
        colors: pick(&mesh.colors, &kept),
        slots: mesh.slots.clone(),
        smoothing_groups: mesh.smoothing_groups.clone(),
        creases: mesh.creases.clone(),
        sharp_vertices: mesh.sharp_vertices.clone(),
    }
}

/// The corners of a border without those that repeat the vertex before them.
fn distinct(mesh: &PolygonMesh, border: Range<usize>) -> Vec<u32> {
    let vertex = |corner: &u32| mesh.corners[*corner as usize];
    let mut corners: Vec<u32> = border.map(|corner| corner as u32).collect();
    corners.dedup_by_key(|corner| vertex(corner));
    while corners.len() > 1 && vertex(&corners[0]) == vertex(&corners[corners.len() - 1]) {
        corners.pop();
    }
    corners
}

fn area_of(mesh: &PolygonMesh, corners: &[u32]) -> glam::DVec3 {
    let place = |corner: u32| mesh.positions[mesh.corners[corner as usize] as usize].as_dvec3();
    super::geometry::area_vector_of(corners.iter().map(|&corner| place(corner)))
}
