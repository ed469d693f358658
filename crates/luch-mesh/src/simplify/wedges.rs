//! Wedges: the corners of a position that share all attributes and the material. A position on a seam has several.

use crate::{Attribute, TriangleMesh};

/// For each corner its wedge; for each wedge a corner to take attributes from.
pub(super) struct Wedges {
    /// For each triangle the wedges of its corners. Empty if positions are wedges.
    pub(super) triangles: Vec<[u32; 3]>,
    /// For each wedge one corner of the mesh, `3 t + k`. Empty if positions are wedges.
    pub(super) corners: Vec<u32>,
}

impl Wedges {
    pub(super) fn of(mesh: &TriangleMesh) -> Self {
        let mut lists: Vec<&[[u32; 3]]> =
            vec![&mesh.normals.triangles, &mesh.tangents.triangles, &mesh.colors.triangles];
        lists.extend(mesh.uv_sets.iter().map(|uvs| uvs.triangles.as_slice()));
        lists.retain(|list| !list.is_empty());
        if lists.is_empty() && mesh.slots.is_empty() {
            return Self { triangles: Vec::new(), corners: Vec::new() };
        }
        // One list after another: wedges so far are split by the next.
        let mut wedges: Vec<u32> = mesh.triangles.as_flattened().to_vec();
        for list in lists {
            split(&mut wedges, |corner| list[corner / 3][corner % 3]);
        }
        if !mesh.slots.is_empty() {
            split(&mut wedges, |corner| u32::from(mesh.slots[corner / 3]));
        }
        let count = wedges.iter().max().map_or(0, |most| *most as usize + 1);
        let mut corners = vec![0; count];
        for (corner, &wedge) in wedges.iter().enumerate().rev() {
            corners[wedge as usize] = corner as u32;
        }
        let (triangles, _) = wedges.as_chunks::<3>();
        Self { triangles: triangles.to_vec(), corners }
    }

    /// A mesh of other triangles on the same positions; attributes from a corner of each wedge.
    pub(super) fn mesh(
        &self,
        mesh: &TriangleMesh,
        triangles: Vec<[u32; 3]>,
        wedges: &[[u32; 3]],
    ) -> TriangleMesh {
        let slot = |wedge: u32| mesh.slots[self.corners[wedge as usize] as usize / 3];
        let slots =
            if mesh.slots.is_empty() { Vec::new() } else { wedges.iter().map(|t| slot(t[0])).collect() };
        TriangleMesh {
            positions: mesh.positions.clone(),
            triangles,
            normals: self.own(&mesh.normals, wedges),
            uv_sets: mesh.uv_sets.iter().map(|uvs| self.own(uvs, wedges)).collect(),
            tangents: self.own(&mesh.tangents, wedges),
            colors: self.own(&mesh.colors, wedges),
            slots,
        }
    }

    fn own<T: Copy>(&self, attribute: &Attribute<T>, wedges: &[[u32; 3]]) -> Attribute<T> {
        if attribute.triangles.is_empty() {
            return attribute.clone();
        }
        let value = |wedge: u32| {
            let corner = self.corners[wedge as usize] as usize;
            attribute.triangles[corner / 3][corner % 3]
        };
        Attribute::indexed(attribute.values.clone(), wedges.iter().map(|t| t.map(value)).collect())
    }
}

/// Numbers pairs of a wedge and a value, rising.
fn split(wedges: &mut [u32], value: impl Fn(usize) -> u32) {
    let mut pairs: Vec<(u64, u32)> = wedges
        .iter()
        .enumerate()
        .map(|(corner, &wedge)| (u64::from(wedge) << 32 | u64::from(value(corner)), corner as u32))
        .collect();
    pairs.sort_unstable();
    let mut number = 0;
    for i in 0..pairs.len() {
        if i > 0 && pairs[i].0 != pairs[i - 1].0 {
            number += 1;
        }
        wedges[pairs[i].1 as usize] = number;
    }
}
