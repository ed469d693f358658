//! Leaving out what contributes nothing: triangles without area, positions without triangles.

use crate::{Attribute, TriangleMesh};

/// A cleaned mesh and how much went.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Cleaned {
    /// The mesh.
    pub mesh: TriangleMesh,
    /// How many triangles or positions were left out.
    pub removed: usize,
}

/// Leaves out triangles with a repeated corner, and those whose area is zero or not a number.
///
/// A triangle without area may still be what joins its neighbours: a closed mesh may lose its closedness.
/// [`remove_collapsed`] never does that.
pub fn remove_degenerate(mesh: &TriangleMesh) -> Cleaned {
    retain(mesh, |mesh, t| {
        let [a, b, c] = mesh.corners(t).map(|p| p.as_dvec3());
        (b - a).cross(c - a).length_squared() > 0.0
    })
}

/// Leaves out triangles that use a position twice.
pub fn remove_collapsed(mesh: &TriangleMesh) -> Cleaned {
    retain(mesh, |mesh, t| {
        let [a, b, c] = mesh.triangles[t];
        a != b && b != c && c != a
    })
}

fn retain(mesh: &TriangleMesh, is_kept: impl Fn(&TriangleMesh, usize) -> bool) -> Cleaned {
    let kept: Vec<usize> = (0..mesh.triangles.len()).filter(|&t| is_kept(mesh, t)).collect();
    let pick = |list: &[[u32; 3]]| kept.iter().filter_map(|&t| list.get(t).copied()).collect::<Vec<_>>();
    fn own<T: Copy>(attribute: &Attribute<T>, pick: impl Fn(&[[u32; 3]]) -> Vec<[u32; 3]>) -> Attribute<T> {
        if attribute.triangles.is_empty() {
            return attribute.clone();
        }
        Attribute::indexed(attribute.values.clone(), pick(&attribute.triangles))
    }
    let cleaned = TriangleMesh {
        positions: mesh.positions.clone(),
        triangles: pick(&mesh.triangles),
        normals: own(&mesh.normals, pick),
        uv_sets: mesh.uv_sets.iter().map(|uvs| own(uvs, pick)).collect(),
        tangents: own(&mesh.tangents, pick),
        colors: own(&mesh.colors, pick),
        slots: kept.iter().filter_map(|&t| mesh.slots.get(t).copied()).collect(),
    };
    Cleaned { mesh: cleaned, removed: mesh.triangles.len() - kept.len() }
}

/// Leaves out positions that no triangle uses, and values of attributes alike.
pub fn remove_unused_positions(mesh: &TriangleMesh) -> Cleaned {
    let positions = Numbering::of_used(&mesh.triangles, mesh.positions.len());
    fn own<T: Copy>(attribute: &Attribute<T>, positions: &Numbering) -> Attribute<T> {
        if attribute.triangles.is_empty() {
            return Attribute::per_position(positions.pick(&attribute.values));
        }
        let numbering = Numbering::of_used(&attribute.triangles, attribute.values.len());
        Attribute::indexed(numbering.pick(&attribute.values), numbering.renumber(&attribute.triangles))
    }
    let cleaned = TriangleMesh {
        positions: positions.pick(&mesh.positions),
        triangles: positions.renumber(&mesh.triangles),
        normals: own(&mesh.normals, &positions),
        uv_sets: mesh.uv_sets.iter().map(|uvs| own(uvs, &positions)).collect(),
        tangents: own(&mesh.tangents, &positions),
        colors: own(&mesh.colors, &positions),
        slots: mesh.slots.clone(),
    };
    let removed = mesh.positions.len() - cleaned.positions.len();
    Cleaned { mesh: cleaned, removed }
}

/// New numbers for the values in use, in their old order.
struct Numbering {
    new_number: Vec<Option<u32>>,
}

impl Numbering {
    fn of_used(triangles: &[[u32; 3]], count: usize) -> Self {
        let mut new_number = vec![None; count];
        for &i in triangles.iter().flatten() {
            new_number[i as usize] = Some(0);
        }
        for (next, number) in new_number.iter_mut().flatten().enumerate() {
            *number = next as u32;
        }
        Self { new_number }
    }

    fn pick<T: Copy>(&self, values: &[T]) -> Vec<T> {
        values.iter().zip(&self.new_number).filter_map(|(value, number)| number.map(|_| *value)).collect()
    }

    fn renumber(&self, triangles: &[[u32; 3]]) -> Vec<[u32; 3]> {
        triangles.iter().map(|t| t.map(|i| self.new_number[i as usize].unwrap_or(0))).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{generate, measure};
    use glam::Vec3;

    #[test]
    fn slivers_go_and_the_rest_stays() {
        let mut mesh = generate::cuboid(Vec3::ONE, [1, 1, 1]);
        let clean = mesh.clone();
        mesh.positions.insert(0, Vec3::splat(9.0));
        mesh.triangles.iter_mut().flatten().for_each(|i| *i += 1);
        let midpoint = mesh.positions.len() as u32;
        mesh.positions.push((mesh.positions[1] + mesh.positions[2]) / 2.0);
        for (corners, removed_as_collapsed) in [([1, 1, 2], 1), ([1, 2, midpoint], 0)] {
            let mut with_sliver = mesh.clone();
            with_sliver.triangles.push(corners);
            with_sliver.normals.triangles.push([0; 3]);
            with_sliver.uv_sets[0].triangles.push([0; 3]);
            assert_eq!(remove_collapsed(&with_sliver).removed, removed_as_collapsed);
            let cleaned = remove_degenerate(&with_sliver);
            assert_eq!(cleaned.removed, 1);
            let cleaned = remove_unused_positions(&cleaned.mesh);
            assert_eq!(cleaned.removed, 2);
            assert_eq!(cleaned.mesh, clean);
        }
        assert!(measure::closedness(&clean).is_closed());
    }

    #[test]
    fn parallel_attributes_follow_the_positions() {
        let mut mesh = generate::sphere(1.0, 8, 4);
        mesh.triangles.truncate(5);
        mesh.uv_sets[0].triangles.truncate(5);
        let cleaned = remove_unused_positions(&mesh).mesh;
        assert_eq!(cleaned.validate(), []);
        assert_eq!(cleaned.normals.values, cleaned.positions);
        for t in 0..5 {
            assert_eq!(cleaned.corners(t), mesh.corners(t));
            assert_eq!(cleaned.corner_uvs(t, 0), mesh.corner_uvs(t, 0));
        }
    }
}
