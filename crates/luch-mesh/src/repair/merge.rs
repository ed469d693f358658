//! Merging what is there twice: positions, faces.

use super::{Repaired, faces, sound};
use crate::polygon_mesh::Crease;
use crate::{PolygonMesh, TriangleMesh, weld};

/// Merges positions that are equal or no farther apart than `distance`, each into the first one kept; faces that become
/// less than a triangle go. The count is that of merged positions. Hard edges and seams stay.
pub fn merge(mesh: &PolygonMesh, distance: f32) -> Repaired {
    let mut mesh = sound(mesh).mesh;
    let points = (0..mesh.positions.len() as u32).map(|vertex| [vertex; 3]).collect();
    let welded = weld::weld_within(&TriangleMesh::new(mesh.positions.clone(), points), distance);
    if welded.merged == 0 {
        return Repaired { mesh, count: 0 };
    }
    faces::detach(&mut mesh);
    let target = |vertex: u32| welded.mesh.triangles[vertex as usize][0];
    mesh.positions = welded.mesh.positions;
    mesh.corners.iter_mut().for_each(|vertex| *vertex = target(*vertex));
    mesh.creases = mesh
        .creases
        .iter()
        .map(|crease| Crease { vertices: crease.vertices.map(target), ..*crease })
        .filter(|crease| crease.vertices[0] != crease.vertices[1])
        .collect();
    mesh.sharp_vertices.iter_mut().for_each(|sharp| sharp.vertex = target(sharp.vertex));
    Repaired { mesh: sound(&mesh).mesh, count: welded.merged }
}

/// Leaves out faces with the same corners as an earlier one, turned round or not.
pub fn remove_duplicate_faces(mesh: &PolygonMesh) -> Repaired {
    let mesh = sound(mesh).mesh;
    // From the lowest vertex toward its lower neighbour.
    let key = |face: u32| {
        let mut corners = mesh.corners[mesh.face(face as usize)].to_vec();
        let least = (0..corners.len()).min_by_key(|&i| corners[i]).unwrap_or(0);
        corners.rotate_left(least);
        if corners[1] > corners[corners.len() - 1] {
            corners[1..].reverse();
        }
        corners
    };
    let mut keys: Vec<(Vec<u32>, u32)> =
        (0..mesh.face_count() as u32).map(|face| (key(face), face)).collect();
    keys.sort_unstable();
    keys.dedup_by(|later, first| later.0 == first.0);
    let mut kept: Vec<u32> = keys.into_iter().map(|(_, face)| face).collect();
    kept.sort_unstable();
    let count = mesh.face_count() - kept.len();
    if count == 0 {
        return Repaired { mesh, count };
    }
    Repaired { mesh: faces::with_faces(&mesh, &kept), count }
}

/// Keeps the piece with the largest area. The count is that of the pieces left out.
pub fn keep_largest(mesh: &PolygonMesh) -> Repaired {
    let mesh = sound(mesh).mesh;
    let roots = faces::components(&mesh, &crate::polygon_mesh::HalfEdges::new(&mesh));
    let mut areas = vec![0.0; mesh.face_count()];
    for (face, &root) in roots.iter().enumerate() {
        areas[root as usize] += faces::doubled_area_normal(&mesh, face).length();
    }
    let pieces = roots.iter().enumerate().filter(|(face, root)| *face == **root as usize).count();
    let mut largest = 0;
    for (face, area) in areas.iter().enumerate() {
        if *area > areas[largest] {
            largest = face;
        }
    }
    let kept: Vec<u32> =
        (0..roots.len() as u32).filter(|&face| roots[face as usize] as usize == largest).collect();
    Repaired { mesh: faces::with_faces(&mesh, &kept), count: pieces.saturating_sub(1) }
}
