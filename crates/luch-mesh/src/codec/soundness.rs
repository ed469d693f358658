//! What a polygon mesh must promise before it is written.

use super::error::EncodeError;
use crate::PolygonMesh;
use crate::polygon_mesh::CornerAttribute;

/// An error if any index leads nowhere or lists that belong together differ in length.
pub(super) fn check(mesh: &PolygonMesh) -> Result<(), EncodeError> {
    let broken = |what: String| Err(EncodeError::Broken(what));
    let (corners, faces) = (mesh.corners.len(), mesh.face_count());
    if corners > u32::MAX as usize || mesh.positions.len() > u32::MAX as usize {
        return broken("it has more corners or positions than 32 bits can number".into());
    }
    if !mesh.face_ends.is_sorted() || mesh.face_ends.last().map_or(0, |end| *end as usize) != corners {
        return broken("the ends of its faces do not divide its corners".into());
    }
    indices("positions", &mesh.corners, mesh.positions.len())?;
    attribute(mesh, "normals", &mesh.normals)?;
    for uvs in &mesh.uv_sets {
        attribute(mesh, "uvs", uvs)?;
    }
    attribute(mesh, "colors", &mesh.colors)?;
    for (name, length) in
        [("material slots", mesh.slots.len()), ("smoothing groups", mesh.smoothing_groups.len())]
    {
        if length != 0 && length != faces {
            return broken(format!("{length} {name} for {faces} faces"));
        }
    }
    let is_in_face = |hole: &crate::polygon_mesh::Hole| {
        (hole.face as usize) < faces && mesh.face(hole.face as usize).contains(&(hole.start as usize))
    };
    let is_ordered = mesh.holes.is_sorted_by(|one, other| one.start < other.start);
    if !is_ordered || !mesh.holes.iter().all(is_in_face) {
        return broken("a hole begins outside its face".into());
    }
    let sharp = mesh
        .creases
        .iter()
        .flat_map(|crease| crease.vertices)
        .chain(mesh.sharp_vertices.iter().map(|s| s.vertex));
    indices("positions", &sharp.collect::<Vec<_>>(), mesh.positions.len())
}

fn attribute<T>(mesh: &PolygonMesh, name: &str, values: &CornerAttribute<T>) -> Result<(), EncodeError> {
    let (found, expected) = match (values.corners.len(), values.values.len()) {
        (0, 0) => (0, 0),
        (0, count) => (count, mesh.positions.len()),
        (count, _) => (count, mesh.corners.len()),
    };
    if found != expected {
        return Err(EncodeError::Broken(format!("{name}: {found} entries where {expected} are needed")));
    }
    indices(name, &values.corners, values.values.len())
}

fn indices(name: &str, indices: &[u32], available: usize) -> Result<(), EncodeError> {
    match indices.iter().find(|&&index| index as usize >= available) {
        Some(index) => {
            Err(EncodeError::Broken(format!("a corner uses {name} number {index} of {available}")))
        }
        None => Ok(()),
    }
}
