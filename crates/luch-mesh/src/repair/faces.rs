//! Choosing, turning and joining faces, and renumbering what they use.

use glam::DVec3;

use crate::PolygonMesh;
use crate::polygon_mesh::{CornerAttribute, HalfEdges};
use crate::sets::DisjointSets;

/// The mesh with only these faces, in this order. Positions stay. For meshes without holes.
pub(crate) fn with_faces(mesh: &PolygonMesh, faces: &[u32]) -> PolygonMesh {
    let mut corners: Vec<u32> = Vec::with_capacity(mesh.corners.len());
    let mut face_ends = Vec::with_capacity(faces.len());
    for &face in faces {
        corners.extend(mesh.face(face as usize).map(|corner| corner as u32));
        face_ends.push(corners.len() as u32);
    }
    fn own<T: Copy>(attribute: &CornerAttribute<T>, corners: &[u32]) -> CornerAttribute<T> {
        if attribute.corners.is_empty() {
            return attribute.clone();
        }
        CornerAttribute::indexed(attribute.values.clone(), pick(&attribute.corners, corners))
    }
    PolygonMesh {
        positions: mesh.positions.clone(),
        normals: own(&mesh.normals, &corners),
        uv_sets: mesh.uv_sets.iter().map(|uvs| own(uvs, &corners)).collect(),
        colors: own(&mesh.colors, &corners),
        corners: pick(&mesh.corners, &corners),
        face_ends,
        holes: Vec::new(),
        slots: if mesh.slots.is_empty() { Vec::new() } else { pick(&mesh.slots, faces) },
        smoothing_groups: if mesh.smoothing_groups.is_empty() {
            Vec::new()
        } else {
            pick(&mesh.smoothing_groups, faces)
        },
        creases: mesh.creases.clone(),
        sharp_vertices: mesh.sharp_vertices.clone(),
    }
}

fn pick<T: Copy>(list: &[T], places: &[u32]) -> Vec<T> {
    places.iter().map(|&place| list[place as usize]).collect()
}

/// Gives attributes that run parallel to the positions indices of their own, so that positions can be renumbered.
pub(super) fn detach(mesh: &mut PolygonMesh) {
    fn own<T: Copy>(attribute: &mut CornerAttribute<T>, corners: &[u32]) {
        if !attribute.values.is_empty() && attribute.corners.is_empty() {
            attribute.corners = corners.to_vec();
        }
    }
    own(&mut mesh.normals, &mesh.corners);
    own(&mut mesh.colors, &mesh.corners);
    mesh.uv_sets.iter_mut().for_each(|uvs| own(uvs, &mesh.corners));
}

/// Turns single faces round, their normals too. For meshes without holes.
pub(super) fn flip_faces(mesh: &mut PolygonMesh, is_flipped: &[bool]) {
    if !is_flipped.contains(&true) {
        return;
    }
    detach(mesh);
    let mut negated: Vec<Option<u32>> = vec![None; mesh.normals.values.len()];
    for (face, _) in is_flipped.iter().enumerate().filter(|(_, flipped)| **flipped) {
        let corners = mesh.face(face);
        for corner in corners.clone() {
            if let Some(index) = mesh.normals.corners.get_mut(corner) {
                let values = &mut mesh.normals.values;
                *index = *negated[*index as usize].get_or_insert_with(|| {
                    values.push(-values[*index as usize]);
                    values.len() as u32 - 1
                });
            }
        }
        // The first corner stays first.
        let rest = corners.start + 1..corners.end;
        let lists = [&mut mesh.corners, &mut mesh.normals.corners, &mut mesh.colors.corners];
        for list in lists.into_iter().chain(mesh.uv_sets.iter_mut().map(|uvs| &mut uvs.corners)) {
            if let Some(part) = list.get_mut(rest.clone()) {
                part.reverse();
            }
        }
    }
}

/// For each face the lowest face that it is joined to over edges.
pub(super) fn components(mesh: &PolygonMesh, half_edges: &HalfEdges) -> Vec<u32> {
    let mut sets = DisjointSets::new(mesh.face_count());
    for edge in half_edges.edges() {
        for &half in &edge.half_edges[1..] {
            sets.join(half_edges.face(edge.half_edges[0]), half_edges.face(half));
        }
    }
    (0..mesh.face_count() as u32).map(|face| sets.root(face)).collect()
}

/// Twice the area times the normal of a face.
pub(super) fn doubled_area_normal(mesh: &PolygonMesh, face: usize) -> DVec3 {
    let corners = &mesh.corners[mesh.face(face)];
    let place = |vertex: u32| mesh.positions[vertex as usize].as_dvec3();
    let Some(&first) = corners.first() else { return DVec3::ZERO };
    let origin = place(first);
    corners.windows(2).map(|pair| (place(pair[0]) - origin).cross(place(pair[1]) - origin)).sum()
}

/// What leaving out unused values gives.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Repaired {
    /// The mesh.
    pub mesh: PolygonMesh,
    /// How many of what the function is about were put right.
    pub count: usize,
}

/// Leaves out positions that no face uses, with their creases, and values of attributes alike.
pub fn remove_unused(mesh: &PolygonMesh) -> Repaired {
    let mut mesh = super::sound(mesh).mesh;
    let before = mesh.positions.len();
    let numbers = numbering(&mesh.corners, before);
    mesh.positions = kept(&mesh.positions, &numbers);
    fn own<T: Copy>(attribute: &mut CornerAttribute<T>, numbers: &[Option<u32>]) {
        if attribute.corners.is_empty() {
            attribute.values = kept(&attribute.values, numbers);
            return;
        }
        let numbers = numbering(&attribute.corners, attribute.values.len());
        attribute.values = kept(&attribute.values, &numbers);
        attribute.corners.iter_mut().for_each(|index| *index = numbers[*index as usize].unwrap_or(0));
    }
    own(&mut mesh.normals, &numbers);
    own(&mut mesh.colors, &numbers);
    mesh.uv_sets.iter_mut().for_each(|uvs| own(uvs, &numbers));
    mesh.corners.iter_mut().for_each(|vertex| *vertex = numbers[*vertex as usize].unwrap_or(0));
    mesh.creases.retain_mut(|crease| match crease.vertices.map(|v| numbers[v as usize]) {
        [Some(a), Some(b)] => {
            crease.vertices = [a, b];
            true
        }
        _ => false,
    });
    mesh.sharp_vertices.retain_mut(|sharp| match numbers[sharp.vertex as usize] {
        Some(vertex) => {
            sharp.vertex = vertex;
            true
        }
        None => false,
    });
    let count = before - mesh.positions.len();
    Repaired { mesh, count }
}

/// New numbers for what is used, in the old order.
fn numbering(used: &[u32], count: usize) -> Vec<Option<u32>> {
    let mut numbers = vec![None; count];
    used.iter().for_each(|&index| numbers[index as usize] = Some(0));
    for (next, number) in numbers.iter_mut().flatten().enumerate() {
        *number = next as u32;
    }
    numbers
}

fn kept<T: Copy>(values: &[T], numbers: &[Option<u32>]) -> Vec<T> {
    values.iter().zip(numbers).filter(|(_, number)| number.is_some()).map(|(value, _)| *value).collect()
}
