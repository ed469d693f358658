//! Welding: positions that coincide become one, so that the surface closes. Attributes keep their own index sets.

use std::collections::HashMap;

use glam::{Vec2, Vec3, Vec4};

use crate::{Attribute, TriangleMesh};

/// A welded mesh and how many positions went.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Welded {
    /// The mesh. Positions keep their order, the first of those that coincide stays.
    pub mesh: TriangleMesh,
    /// Positions that were merged into another.
    pub merged: usize,
}

/// Merges positions that are equal (0 and −0 are). Hard edges and seams stay as they are: normals, uvs, tangents and
/// colours that ran parallel to the positions get index sets of their own, and equal values are shared.
pub fn weld_exact(mesh: &TriangleMesh) -> Welded {
    let (mut positions, mut keys) = (Vec::new(), Vec::new());
    let mut numbers = Numbers::new(mesh.positions.len());
    let targets = mesh.positions.iter().map(|&position| {
        let number = numbers.of(exact_key(position), &mut keys);
        if number as usize == positions.len() {
            positions.push(position);
        }
        number
    });
    let targets: Vec<u32> = targets.collect();
    rebuilt(mesh, positions, &targets)
}

/// Merges each position into the first one kept before it that is no farther than `tolerance`.
///
/// The result depends on the order of the positions but on nothing else. Kept positions are farther apart than
/// `tolerance`; a chain of close ones is not pulled together. Triangles that collapse are kept with repeated corners:
/// see [`crate::clean::remove_degenerate`]. A tolerance of zero or less, or not a number, welds exactly.
pub fn weld_within(mesh: &TriangleMesh, tolerance: f32) -> Welded {
    if !(tolerance > 0.0 && tolerance.is_finite()) {
        return weld_exact(mesh);
    }
    const NONE: u32 = u32::MAX;
    let size = f64::from(tolerance);
    let cell_of = |position: Vec3| (position.as_dvec3() / size).floor();
    // Grid cell → its latest kept position; each kept position knows the one before it in the cell.
    let mut cells: HashMap<[u64; 3], u32> = HashMap::new();
    let mut previous: Vec<u32> = Vec::new();
    let mut positions: Vec<Vec3> = Vec::new();
    let mut targets = Vec::with_capacity(mesh.positions.len());
    for &position in &mesh.positions {
        let cell = cell_of(position);
        let mut nearest = NONE;
        for step in 0..27 {
            let offset = glam::DVec3::new(
                f64::from(step % 3 - 1),
                f64::from(step / 3 % 3 - 1),
                f64::from(step / 9 - 1),
            );
            let mut candidate = cells.get(&bits(cell + offset)).copied().unwrap_or(NONE);
            while candidate != NONE {
                let distance = positions[candidate as usize].as_dvec3().distance_squared(position.as_dvec3());
                if distance <= size * size {
                    nearest = nearest.min(candidate);
                }
                candidate = previous[candidate as usize];
            }
        }
        if nearest == NONE {
            nearest = positions.len() as u32;
            positions.push(position);
            previous.push(cells.insert(bits(cell), nearest).unwrap_or(NONE));
        }
        targets.push(nearest);
    }
    rebuilt(mesh, positions, &targets)
}

/// Numbers keys in the order in which they first come.
///
/// A table with open addressing, faster by far than a map that withstands chosen keys; where a run of taken slots is suspiciously long,
/// such a map takes over.
struct Numbers {
    /// Numbers of keys, or [`Numbers::FREE`]; their count is a power of two.
    slots: Vec<u32>,
    map: Option<HashMap<[u32; 3], u32>>,
}

impl Numbers {
    const FREE: u32 = u32::MAX;
    /// By chance a run at half load is this long once in far more tables than there are.
    const LONGEST_RUN: usize = 256;

    /// For so many keys at most.
    fn new(count: usize) -> Self {
        Self { slots: vec![Self::FREE; (count * 2).next_power_of_two()], map: None }
    }

    /// The number of a key; a new one joins the list.
    #[inline]
    fn of(&mut self, key: [u32; 3], keys: &mut Vec<[u32; 3]>) -> u32 {
        if self.map.is_none() {
            let mask = self.slots.len() - 1;
            let first = hash(key) as usize;
            for slot in (first..first + Self::LONGEST_RUN).map(|slot| slot & mask) {
                let number = self.slots[slot];
                if number == Self::FREE {
                    self.slots[slot] = keys.len() as u32;
                    keys.push(key);
                    return keys.len() as u32 - 1;
                }
                if keys[number as usize] == key {
                    return number;
                }
            }
        }
        let map = self.map.get_or_insert_with(|| keys.iter().zip(0..).map(|(&key, n)| (key, n)).collect());
        *map.entry(key).or_insert_with(|| {
            keys.push(key);
            keys.len() as u32 - 1
        })
    }
}

/// Mixes three numbers by odd factors, the upper bits into the lower after each.
#[inline]
fn hash(key: [u32; 3]) -> u32 {
    let mut mixed = 0u64;
    for part in key {
        mixed = (mixed ^ u64::from(part)).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        mixed ^= mixed >> 32;
    }
    mixed as u32
}

/// Gives equal values of an attribute one number, and an index set of its own if that shortens the list.
pub fn share_values<T: Copy, K: std::hash::Hash + Eq>(
    attribute: &Attribute<T>,
    position_triangles: &[[u32; 3]],
    key: impl Fn(T) -> K,
) -> Attribute<T> {
    let mut numbers = HashMap::with_capacity(attribute.values.len());
    let mut values = Vec::new();
    let targets = attribute.values.iter().map(|&value| {
        *numbers.entry(key(value)).or_insert_with(|| {
            values.push(value);
            values.len() as u32 - 1
        })
    });
    let targets: Vec<u32> = targets.collect();
    if values.len() == attribute.values.len() {
        return attribute.clone();
    }
    let corners = attribute.corner_indices(position_triangles);
    Attribute::indexed(values, corners.iter().map(|t| t.map(|i| targets[i as usize])).collect())
}

fn rebuilt(mesh: &TriangleMesh, positions: Vec<Vec3>, targets: &[u32]) -> Welded {
    let merged = mesh.positions.len() - positions.len();
    if merged == 0 {
        return Welded { mesh: mesh.clone(), merged };
    }
    fn own<T: Copy, K: std::hash::Hash + Eq>(
        mesh: &TriangleMesh,
        attribute: &Attribute<T>,
        key: impl Fn(T) -> K,
    ) -> Attribute<T> {
        let shared = share_values(attribute, &mesh.triangles, key);
        if shared.is_empty() || !shared.triangles.is_empty() {
            return shared;
        }
        // Parallel lists no longer fit the positions.
        Attribute::indexed(shared.values, mesh.triangles.clone())
    }
    let mesh = TriangleMesh {
        positions,
        triangles: mesh.triangles.iter().map(|t| t.map(|i| targets[i as usize])).collect(),
        normals: own(mesh, &mesh.normals, exact_key),
        uv_sets: mesh
            .uv_sets
            .iter()
            .map(|uvs| own(mesh, uvs, |v: Vec2| v.to_array().map(f32::to_bits)))
            .collect(),
        tangents: own(mesh, &mesh.tangents, |v: Vec4| v.to_array().map(f32::to_bits)),
        colors: own(mesh, &mesh.colors, |v: Vec4| v.to_array().map(f32::to_bits)),
        slots: mesh.slots.clone(),
    };
    Welded { mesh, merged }
}

/// Adding zero makes −0 and 0 the same.
fn exact_key(vector: Vec3) -> [u32; 3] {
    (vector + Vec3::ZERO).to_array().map(f32::to_bits)
}

fn bits(cell: glam::DVec3) -> [u64; 3] {
    (cell + glam::DVec3::ZERO).to_array().map(f64::to_bits)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{generate, measure, unify};
    use proptest::prelude::*;

    #[test]
    fn welding_undoes_splitting_and_keeps_hard_edges() {
        for generator in generate::Generator::examples() {
            let mesh = generator.mesh();
            let split = unify::split_positions(&mesh);
            let welded = weld_exact(&split);
            // The teapot has one place twice, where the handle touches the body.
            let touching = usize::from(matches!(generator, generate::Generator::Teapot { .. }));
            assert_eq!(welded.mesh.positions.len() + touching, mesh.positions.len(), "{generator:?}");
            assert_eq!(welded.merged, split.positions.len() + touching - mesh.positions.len());
            assert_eq!(welded.mesh.validate(), []);
            if touching > 0 {
                continue;
            }
            assert_eq!(measure::closedness(&welded.mesh), measure::closedness(&mesh));
            for t in 0..mesh.triangles.len() {
                assert_eq!(welded.mesh.corners(t), mesh.corners(t));
                assert_eq!(welded.mesh.corner_normals(t), mesh.corner_normals(t));
                assert_eq!(welded.mesh.corner_uvs(t, 0), mesh.corner_uvs(t, 0));
            }
        }
    }

    proptest! {
        #[test]
        fn kept_positions_are_apart_and_none_moves_far(
            points in prop::collection::vec(prop::array::uniform3(-2.0f32..2.0), 1..80),
            tolerance in 0.01f32..2.0,
        ) {
            let points: Vec<Vec3> = points.into_iter().map(Vec3::from).collect();
            let triangles = (0..points.len() as u32).map(|i| [i, i, i]).collect();
            let welded = weld_within(&TriangleMesh::new(points.clone(), triangles), tolerance).mesh;
            let far = |a: Vec3, b: Vec3| a.as_dvec3().distance(b.as_dvec3()) > f64::from(tolerance);
            for (i, a) in welded.positions.iter().enumerate() {
                prop_assert!(welded.positions[..i].iter().all(|b| far(*a, *b)));
            }
            for (t, point) in points.iter().enumerate() {
                // Brute force: the first kept position within reach.
                let target = welded.positions.iter().position(|kept| !far(*kept, *point)).unwrap();
                prop_assert_eq!(welded.triangles[t][0] as usize, target);
            }
        }
    }

    #[test]
    fn chosen_keys_do_no_harm() {
        // All of these fall upon few slots of a table.
        let bad: Vec<[u32; 3]> =
            (0..u32::MAX).map(|n| [n, 0, 0]).filter(|&key| hash(key) & 0x3fff < 8).take(5000).collect();
        let (mut numbers, mut keys) = (Numbers::new(bad.len()), Vec::new());
        for round in 0..2 {
            for (n, &key) in bad.iter().enumerate() {
                assert_eq!(numbers.of(key, &mut keys) as usize, n, "round {round}");
            }
        }
        assert!(numbers.map.is_some() && keys == bad);
    }

    #[test]
    fn huge_and_tiny_positions_do_no_harm() {
        let points = vec![Vec3::splat(3e38), Vec3::splat(-3e38), Vec3::splat(1e-40), Vec3::ZERO];
        let mesh = TriangleMesh::new(points, vec![[0, 1, 2], [0, 1, 3]]);
        assert_eq!(weld_within(&mesh, 1e-30).merged, 1);
        assert_eq!(weld_within(&mesh, f32::NAN).merged, 0);
    }
}
