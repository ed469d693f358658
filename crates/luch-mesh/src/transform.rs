//! Place, mirror and join meshes.

use glam::{Affine3A, Mat3, Vec2, Vec3, Vec4};

use crate::{Attribute, TriangleMesh};

impl TriangleMesh {
    /// Places the mesh by an affine map.
    ///
    /// Normals go by the inverse transpose, tangents as directions. A mirroring map would turn the surface inside out:
    /// the winding is reversed, and with it the sign of the bitangents, so that what was outside stays outside.
    pub fn transform(&mut self, map: &Affine3A) {
        let linear = Mat3::from(map.matrix3);
        let normal_map = normal_matrix(linear);
        for position in &mut self.positions {
            *position = map.transform_point3(*position);
        }
        for normal in &mut self.normals.values {
            *normal = (normal_map * *normal).try_normalize().unwrap_or(Vec3::Z);
        }
        let mirrored = linear.determinant() < 0.0;
        let handedness = if mirrored { -1.0 } else { 1.0 };
        for tangent in &mut self.tangents.values {
            let along = (linear * tangent.truncate()).try_normalize().unwrap_or(Vec3::X);
            *tangent = along.extend(tangent.w * handedness);
        }
        if mirrored {
            self.reverse_corners();
        }
    }

    /// Turns the surface inside out: reverses the winding and the normals.
    pub fn flip(&mut self) {
        self.reverse_corners();
        for normal in &mut self.normals.values {
            *normal = -*normal;
        }
        for tangent in &mut self.tangents.values {
            tangent.w = -tangent.w;
        }
    }

    fn reverse_corners(&mut self) {
        let lists = [
            Some(&mut self.triangles),
            Some(&mut self.normals.triangles),
            Some(&mut self.tangents.triangles),
            Some(&mut self.colors.triangles),
        ];
        let uvs = self.uv_sets.iter_mut().map(|uvs| Some(&mut uvs.triangles));
        for corners in lists.into_iter().chain(uvs).flatten().flatten() {
            corners.swap(1, 2);
        }
    }

    /// Adds all triangles of `other`, whose material slots are shifted up by `slot_offset`.
    ///
    /// What only one of the two meshes has is filled in for the other: flat normals, uv zero, white. Tangents are
    /// kept only if both have them, since they can be derived.
    pub fn append(&mut self, other: &TriangleMesh, slot_offset: u16) {
        if !self.normals.is_empty() || !other.normals.is_empty() {
            let mine = present_or(&self.normals, || crate::normals::flat(self));
            let theirs = present_or(&other.normals, || crate::normals::flat(other));
            self.normals = joined(self, &mine, other, &theirs);
        }
        for set in 0..self.uv_sets.len().max(other.uv_sets.len()) {
            let constant = |mesh: &TriangleMesh| one_value(mesh, Vec2::ZERO);
            let mine = self.uv_sets.get(set).filter(|a| !a.is_empty()).cloned();
            let theirs = other.uv_sets.get(set).filter(|a| !a.is_empty()).cloned();
            let mine = mine.unwrap_or_else(|| constant(self));
            let theirs = theirs.unwrap_or_else(|| constant(other));
            let uvs = joined(self, &mine, other, &theirs);
            match self.uv_sets.get_mut(set) {
                Some(place) => *place = uvs,
                None => self.uv_sets.push(uvs),
            }
        }
        if !self.colors.is_empty() || !other.colors.is_empty() {
            let mine = present_or(&self.colors, || one_value(self, Vec4::ONE));
            let theirs = present_or(&other.colors, || one_value(other, Vec4::ONE));
            self.colors = joined(self, &mine, other, &theirs);
        }
        let both_tangents = !self.tangents.is_empty() && !other.tangents.is_empty();
        self.tangents = if both_tangents {
            joined(self, &self.tangents, other, &other.tangents)
        } else {
            Attribute::default()
        };
        if !self.slots.is_empty() || !other.slots.is_empty() || slot_offset > 0 {
            self.slots.resize(self.triangles.len(), 0);
            self.slots.extend((0..other.triangles.len()).map(|t| other.slot(t).saturating_add(slot_offset)));
        }
        let shift = self.positions.len() as u32;
        self.positions.extend_from_slice(&other.positions);
        self.triangles.extend(other.triangles.iter().map(|corners| corners.map(|i| i + shift)));
    }
}

/// The inverse transpose up to a positive factor, from cofactors: defined for flattening maps too.
fn normal_matrix(linear: Mat3) -> Mat3 {
    let (x, y, z) = (linear.x_axis, linear.y_axis, linear.z_axis);
    let cofactors = Mat3::from_cols(y.cross(z), z.cross(x), x.cross(y));
    if linear.determinant() < 0.0 { -1.0 * cofactors } else { cofactors }
}

fn present_or<T: Copy>(attribute: &Attribute<T>, otherwise: impl FnOnce() -> Attribute<T>) -> Attribute<T> {
    if attribute.is_empty() { otherwise() } else { attribute.clone() }
}

fn one_value<T: Copy>(mesh: &TriangleMesh, value: T) -> Attribute<T> {
    Attribute::indexed(vec![value], vec![[0; 3]; mesh.triangles.len()])
}

fn joined<T: Copy>(
    mesh: &TriangleMesh,
    mine: &Attribute<T>,
    other: &TriangleMesh,
    theirs: &Attribute<T>,
) -> Attribute<T> {
    let values = [mine.values.as_slice(), theirs.values.as_slice()].concat();
    let both_parallel = mine.triangles.is_empty()
        && theirs.triangles.is_empty()
        && mine.values.len() == mesh.positions.len()
        && theirs.values.len() == other.positions.len();
    if both_parallel {
        return Attribute::per_position(values);
    }
    let shift = mine.values.len() as u32;
    let mut triangles = mine.corner_indices(&mesh.triangles).to_vec();
    triangles
        .extend(theirs.corner_indices(&other.triangles).iter().map(|corners| corners.map(|i| i + shift)));
    Attribute::indexed(values, triangles)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{generate, measure};
    use glam::Quat;

    #[test]
    fn mirroring_keeps_the_outside_outside() {
        let mut mesh = generate::sphere(1.0, 16, 8);
        let before = measure::volume(&mesh);
        mesh.transform(&Affine3A::from_scale(Vec3::new(-2.0, 1.0, 1.0)));
        assert!((measure::volume(&mesh) - 2.0 * before).abs() < 1e-5);
        for t in 0..mesh.triangles.len() {
            let facet = mesh.area_normal(t);
            assert!(mesh.corner_normals(t).unwrap().iter().all(|n| n.dot(facet) > 0.0));
        }
    }

    #[test]
    fn normals_stay_at_right_angles_under_a_shear() {
        let mut mesh = generate::cylinder(1.0, 2.0, 24, 1, true);
        let shear = Affine3A::from_mat3(Mat3::from_cols(Vec3::X, Vec3::new(0.7, 1.0, 0.2), Vec3::Z));
        mesh.transform(&shear);
        for t in 0..mesh.triangles.len() {
            // The caps are flat: their stored normals must be those of the facets.
            let [n, ..] = mesh.corner_normals(t).unwrap();
            let facet = mesh.area_normal(t).normalize();
            assert!(n.dot(facet) > 0.95, "triangle {t}: {n} against {facet}");
        }
    }

    #[test]
    fn flattening_keeps_the_normal_of_the_plane() {
        let mut mesh = generate::plane(Vec2::ONE, [1, 1]);
        mesh.transform(&Affine3A::from_scale(Vec3::new(1.0, 0.0, 1.0)));
        assert_eq!(mesh.normals.values[0], Vec3::Y);
    }

    #[test]
    fn joining_adds_up_and_fills_in() {
        let mut mesh = generate::cuboid(Vec3::ONE, [1, 1, 1]);
        let mut other = generate::sphere(1.0, 8, 4);
        other.normals = Attribute::default();
        other.uv_sets.clear();
        other.transform(&Affine3A::from_rotation_translation(Quat::IDENTITY, Vec3::X * 5.0));
        let (area, volume) = (measure::area(&mesh), measure::volume(&mesh));
        mesh.append(&other, 1);
        assert_eq!(mesh.validate(), []);
        assert!((measure::area(&mesh) - area - measure::area(&other)).abs() < 1e-9);
        assert!((measure::volume(&mesh) - volume - measure::volume(&other)).abs() < 1e-9);
        assert_eq!((mesh.slot(0), mesh.slot(12)), (0, 1));
        assert_eq!(measure::closedness(&mesh).components, 2);
    }
}
