//! One index for everything, for the formats that have no other: vertices split only where attributes differ.

use std::collections::HashMap;

use glam::{Vec2, Vec3, Vec4};

use crate::PolygonMesh;
use crate::polygon_mesh::CornerAttribute;

/// A mesh whose attributes run parallel to its positions.
pub(super) struct Split {
    /// For each corner its vertex.
    pub(super) corners: Vec<u32>,
    /// For each vertex the place of its position in the mesh.
    pub(super) positions: Vec<u32>,
    /// For each vertex a corner that it was made of; `None` for positions that no face uses.
    origins: Vec<Option<u32>>,
}

/// Vertices with more companions than this are found through a table: no mesh may take quadratic time.
const LONGEST_CHAIN: u32 = 8;

impl Split {
    /// Splits what must be split. Positions keep their order, those added stand at the end. The mesh must be sound.
    ///
    /// Corners of one position share a vertex if their normals, colours and the uvs of the first `uv_sets` sets are equal
    /// bit for bit.
    pub(super) fn new(mesh: &PolygonMesh, uv_sets: usize) -> Self {
        let uvs = &mesh.uv_sets[..uv_sets.min(mesh.uv_sets.len())];
        let is_unified = mesh.normals.corners.is_empty()
            && mesh.colors.corners.is_empty()
            && uvs.iter().all(|uvs| uvs.corners.is_empty());
        let mut split = Self {
            corners: mesh.corners.clone(),
            positions: (0..mesh.positions.len() as u32).collect(),
            origins: vec![None; mesh.positions.len()],
        };
        if is_unified {
            for (corner, &position) in mesh.corners.iter().enumerate() {
                split.origins[position as usize] = Some(corner as u32);
            }
            return split;
        }
        const NONE: u32 = u32::MAX;
        let mut next: Vec<u32> = vec![NONE; mesh.positions.len()];
        let mut crowded: HashMap<Vec<u32>, u32> = HashMap::new();
        for corner in 0..mesh.corners.len() as u32 {
            let position = mesh.corners[corner as usize];
            let mut vertex = position;
            let mut length = 0;
            let found = loop {
                match split.origins[vertex as usize] {
                    // The first corner at a position takes its number.
                    None => {
                        split.origins[vertex as usize] = Some(corner);
                        break vertex;
                    }
                    Some(origin) if is_same(mesh, uvs, origin, corner) => break vertex,
                    Some(_) => {}
                }
                length += 1;
                if next[vertex as usize] == NONE || length == LONGEST_CHAIN {
                    let fresh = split.positions.len() as u32;
                    let is_crowded = length == LONGEST_CHAIN;
                    if is_crowded {
                        let number = *crowded.entry(key(mesh, uvs, corner)).or_insert(fresh);
                        if number != fresh {
                            break number;
                        }
                    } else {
                        next[vertex as usize] = fresh;
                    }
                    split.positions.push(position);
                    split.origins.push(Some(corner));
                    next.push(NONE);
                    break fresh;
                }
                vertex = next[vertex as usize];
            };
            split.corners[corner as usize] = found;
        }
        split
    }

    /// How many vertices there are.
    pub(super) fn len(&self) -> usize {
        self.positions.len()
    }

    /// The value of an attribute at a vertex; `fallback` where no face says.
    pub(super) fn value<T: Copy>(&self, attribute: &CornerAttribute<T>, vertex: usize, fallback: T) -> T {
        let index = if attribute.corners.is_empty() {
            Some(self.positions[vertex])
        } else {
            self.origins[vertex].map(|corner| attribute.corners[corner as usize])
        };
        index.map_or(fallback, |index| attribute.values[index as usize])
    }
}

fn at<T: Copy>(mesh: &PolygonMesh, attribute: &CornerAttribute<T>, corner: u32) -> Option<T> {
    if attribute.is_empty() {
        return None;
    }
    let indices = if attribute.corners.is_empty() { &mesh.corners } else { &attribute.corners };
    Some(attribute.values[indices[corner as usize] as usize])
}

/// Compares by number first: most corners share theirs.
fn is_same(mesh: &PolygonMesh, uvs: &[CornerAttribute<Vec2>], one: u32, other: u32) -> bool {
    fn agree<T: Copy, const N: usize>(
        attribute: &CornerAttribute<T>,
        one: u32,
        other: u32,
        bits: fn(T) -> [u32; N],
    ) -> bool {
        // Values that run parallel to the positions agree, since the position does.
        let indices = &attribute.corners;
        indices.is_empty() || indices[one as usize] == indices[other as usize] || {
            let value = |corner: u32| bits(attribute.values[indices[corner as usize] as usize]);
            value(one) == value(other)
        }
    }
    agree(&mesh.normals, one, other, |n: Vec3| n.to_array().map(f32::to_bits))
        && agree(&mesh.colors, one, other, |c: Vec4| c.to_array().map(f32::to_bits))
        && uvs.iter().all(|uvs| agree(uvs, one, other, |uv: Vec2| uv.to_array().map(f32::to_bits)))
}

/// Position and attributes as bits.
fn key(mesh: &PolygonMesh, uvs: &[CornerAttribute<Vec2>], corner: u32) -> Vec<u32> {
    let mut key = vec![mesh.corners[corner as usize]];
    let mut add = |numbers: &[f32]| key.extend(numbers.iter().map(|number| number.to_bits()));
    add(&at(mesh, &mesh.normals, corner).unwrap_or_default().to_array());
    add(&at(mesh, &mesh.colors, corner).unwrap_or_default().to_array());
    for uvs in uvs {
        add(&at(mesh, uvs, corner).unwrap_or_default().to_array());
    }
    key
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn many_values_at_one_position_are_all_kept() {
        // A fan of a thousand triangles around one position, each with one of a hundred normals of its own.
        let count = 1000u32;
        let mut mesh = PolygonMesh { positions: vec![Vec3::ZERO; count as usize + 2], ..Default::default() };
        (0..count).for_each(|i| {
            mesh.add_face(&[0, i + 1, i + 2]);
        });
        let values: Vec<Vec3> = (0..100).map(|i| Vec3::new(i as f32, 0.0, 0.0)).collect();
        mesh.normals =
            CornerAttribute::indexed(values, (0..3 * count).map(|corner| corner / 3 % 100).collect());
        let split = Split::new(&mesh, 0);
        for corner in 0..mesh.corners.len() {
            let vertex = split.corners[corner] as usize;
            assert_eq!(split.positions[vertex], mesh.corners[corner]);
            let expected = mesh.normals.values[mesh.normals.corners[corner] as usize];
            assert_eq!(split.value(&mesh.normals, vertex, Vec3::ZERO), expected);
        }
        let at_center = split.positions.iter().filter(|&&position| position == 0).count();
        assert_eq!(at_center, 100);
    }
}
