//! One index for everything: what graphics hardware and some file formats want.

use std::collections::HashMap;

use crate::{Attribute, TriangleMesh};

/// Splits positions until every attribute runs parallel to them, the opposite of shared lists.
///
/// Corners that agree in all indices stay one. Positions keep their order; those that no triangle uses are kept. Two
/// corners with equal values but different indices are split: use [`crate::weld::share_values`] first if that matters.
pub fn split_positions(mesh: &TriangleMesh) -> TriangleMesh {
    let is_unified = mesh.normals.triangles.is_empty()
        && mesh.tangents.triangles.is_empty()
        && mesh.colors.triangles.is_empty()
        && mesh.uv_sets.iter().all(|uvs| uvs.triangles.is_empty());
    if is_unified {
        return mesh.clone();
    }
    // Which corners meet in one vertex: the first to use a position keeps its number, others are added at the end.
    let mut key_sets: Vec<&[[u32; 3]]> = Vec::new();
    let mut add = |triangles| {
        if !<[_]>::is_empty(triangles) && !key_sets.contains(&triangles) {
            key_sets.push(triangles);
        }
    };
    add(&mesh.normals.triangles);
    add(&mesh.tangents.triangles);
    add(&mesh.colors.triangles);
    mesh.uv_sets.iter().for_each(|uvs| add(&uvs.triangles));

    let mut first_key: Vec<Option<Vec<u32>>> = vec![None; mesh.positions.len()];
    let mut added: HashMap<(u32, Vec<u32>), u32> = HashMap::new();
    let mut unified = TriangleMesh { slots: mesh.slots.clone(), ..TriangleMesh::default() };
    // For each vertex the corner it was first seen at; unused positions have none.
    let mut origins: Vec<Option<(usize, usize)>> = vec![None; mesh.positions.len()];
    let mut sources: Vec<u32> = (0..mesh.positions.len() as u32).collect();
    for (t, corners) in mesh.triangles.iter().enumerate() {
        unified.triangles.push(std::array::from_fn(|k| {
            let position = corners[k];
            let key: Vec<u32> = key_sets.iter().map(|set| set[t][k]).collect();
            let first = &mut first_key[position as usize];
            if first.is_none() {
                *first = Some(key);
                origins[position as usize] = Some((t, k));
                return position;
            }
            if first.as_ref() == Some(&key) {
                return position;
            }
            *added.entry((position, key)).or_insert_with(|| {
                origins.push(Some((t, k)));
                sources.push(position);
                sources.len() as u32 - 1
            })
        }));
    }
    unified.positions = sources.iter().map(|&source| mesh.positions[source as usize]).collect();
    unified.normals = gather(mesh, &mesh.normals, &origins);
    unified.tangents = gather(mesh, &mesh.tangents, &origins);
    unified.colors = gather(mesh, &mesh.colors, &origins);
    unified.uv_sets = mesh.uv_sets.iter().map(|uvs| gather(mesh, uvs, &origins)).collect();
    unified
}

fn gather<T: Copy>(
    mesh: &TriangleMesh,
    attribute: &Attribute<T>,
    origins: &[Option<(usize, usize)>],
) -> Attribute<T> {
    let Some(&any) = attribute.values.first() else { return Attribute::default() };
    let indices = attribute.corner_indices(&mesh.triangles);
    let value = |origin: &Option<(usize, usize)>| {
        origin.map_or(any, |(t, k)| attribute.values[indices[t][k] as usize])
    };
    Attribute::per_position(origins.iter().map(value).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{generate, measure};
    use glam::Vec3;

    #[test]
    fn a_cube_gets_its_twenty_four_vertices() {
        let mesh = generate::cuboid(Vec3::ONE, [1, 1, 1]);
        let unified = split_positions(&mesh);
        assert_eq!(unified.positions.len(), 24);
        assert_eq!(unified.validate(), []);
        for t in 0..12 {
            assert_eq!(mesh.corners(t), unified.corners(t));
            assert_eq!(mesh.corner_normals(t), unified.corner_normals(t));
            assert_eq!(mesh.corner_uvs(t, 0), unified.corner_uvs(t, 0));
        }
        assert_eq!(split_positions(&unified), unified);
        assert!(!measure::closedness(&unified).is_closed());
    }
}
