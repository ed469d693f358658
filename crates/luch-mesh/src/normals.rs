//! Normals: flat, smooth, or smooth up to a crease angle.
//!
//! A hard edge gives one position two normals in the normal list; it never splits the position.
//! Weights: by area (the cross product as it is) or by the angle at the corner, which does not depend on how a facet
//! is cut into triangles (Thürmer and Wüthrich, "Computing Vertex Normals from Polygonal Facets", 1998).

use glam::{DVec3, Vec3};

use crate::edges::{Edges, corner_at};
use crate::{Attribute, TriangleMesh};

/// How much each triangle counts in the normal of its corner.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Weight {
    /// By its area: large facets win.
    Area,
    /// By its angle at the corner: the cut of facets into triangles does not matter.
    #[default]
    Angle,
}

/// One normal per triangle. A triangle without area gets +Z.
pub fn flat(mesh: &TriangleMesh) -> Attribute<Vec3> {
    let count = mesh.triangles.len();
    let values = (0..count).map(|t| facet_normal(mesh.corners(t)).map_or(Vec3::Z, DVec3::as_vec3)).collect();
    Attribute::indexed(values, (0..count as u32).map(|t| [t; 3]).collect())
}

/// One normal per position, the weighted mean of its triangles. Positions without any area about them get +Z.
pub fn smooth(mesh: &TriangleMesh, weight: Weight) -> Attribute<Vec3> {
    let mut sums = vec![DVec3::ZERO; mesh.positions.len()];
    for (t, corners) in mesh.triangles.iter().enumerate() {
        let parts = corner_parts(mesh.corners(t), weight);
        for (&corner, part) in corners.iter().zip(parts) {
            sums[corner as usize] += part;
        }
    }
    Attribute::per_position(sums.into_iter().map(unit_or_z).collect())
}

/// Normals that are smooth over edges bent by less than `angle` (radians) and hard over the others.
///
/// Triangles about a position share a normal if they are joined by smooth edges. Border edges and edges of more than
/// two triangles are hard; triangles without area pass smoothness on.
pub fn creased(mesh: &TriangleMesh, angle: f32, weight: Weight) -> Attribute<Vec3> {
    let least_cosine = f64::from(libm::cosf(angle.clamp(0.0, std::f32::consts::PI)));
    let facets: Vec<_> = (0..mesh.triangles.len()).map(|t| facet_normal(mesh.corners(t))).collect();
    joined_over(mesh, weight, |one, other| match (facets[one], facets[other]) {
        (Some(a), Some(b)) => a.dot(b) >= least_cosine - 1e-9,
        _ => true,
    })
}

/// Normals shared by the corners of a position that are joined by edges for which `is_smooth(triangle, triangle)` holds.
fn joined_over(
    mesh: &TriangleMesh,
    weight: Weight,
    is_smooth: impl Fn(usize, usize) -> bool,
) -> Attribute<Vec3> {
    let triangles = &mesh.triangles;
    let mut fans = crate::sets::DisjointSets::new(triangles.len() * 3);
    for edge in Edges::new(triangles, mesh.positions.len()).iter(triangles) {
        let &[one, other] = edge.half_edges else { continue };
        if is_smooth(one as usize / 3, other as usize / 3) {
            for vertex in edge.vertices {
                fans.join(corner_at(triangles, one, vertex), corner_at(triangles, other, vertex));
            }
        }
    }
    // Number the fans by their first corner and sum up.
    const UNSEEN: u32 = u32::MAX;
    let mut number_of = vec![UNSEEN; triangles.len() * 3];
    let mut sums: Vec<DVec3> = Vec::new();
    let mut indices = Vec::with_capacity(triangles.len());
    for t in 0..triangles.len() {
        let parts = corner_parts(mesh.corners(t), weight);
        indices.push(std::array::from_fn(|corner| {
            let fan = fans.root((t * 3 + corner) as u32) as usize;
            if number_of[fan] == UNSEEN {
                number_of[fan] = sums.len() as u32;
                sums.push(DVec3::ZERO);
            }
            sums[number_of[fan] as usize] += parts[corner];
            number_of[fan]
        }));
    }
    Attribute::indexed(sums.into_iter().map(unit_or_z).collect(), indices)
}

pub(crate) fn unit_or_z(sum: DVec3) -> Vec3 {
    sum.try_normalize().map_or(Vec3::Z, DVec3::as_vec3)
}

/// Unit normal of a triangle, if it has area.
fn facet_normal(corners: [Vec3; 3]) -> Option<DVec3> {
    let [a, b, c] = corners.map(|v| v.as_dvec3());
    (b - a).cross(c - a).try_normalize()
}

/// What a triangle adds to the normals of its three corners.
fn corner_parts(corners: [Vec3; 3], weight: Weight) -> [DVec3; 3] {
    let points = corners.map(|v| v.as_dvec3());
    let [a, b, c] = points;
    let area_normal = (b - a).cross(c - a);
    match weight {
        Weight::Area => [area_normal; 3],
        Weight::Angle => {
            let unit = area_normal.try_normalize().unwrap_or(DVec3::ZERO);
            std::array::from_fn(|k| unit * corner_angle(points[(k + 2) % 3], points[k], points[(k + 1) % 3]))
        }
    }
}

/// The angle at `corner`, in radians; zero if a neighbour coincides with it.
pub(crate) fn corner_angle(previous: DVec3, corner: DVec3, next: DVec3) -> f64 {
    let (one, other) = (previous - corner, next - corner);
    libm::atan2(one.cross(other).length(), one.dot(other))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Barycentric, generate, measure};

    #[test]
    fn a_cube_is_hard_by_crease_and_keeps_its_eight_positions() {
        let mesh = generate::cuboid(Vec3::ONE, [3, 3, 3]);
        let normals = creased(&mesh, 0.5, Weight::Angle);
        for t in 0..mesh.triangles.len() {
            let facet = mesh.area_normal(t).normalize();
            let corners = normals.corners(t, mesh.triangles[t]).unwrap();
            assert!(corners.iter().all(|n| (*n - facet).length() < 1e-6));
        }
        // Sixteen places on each of six faces.
        assert_eq!(normals.values.len(), 96);
        assert!(measure::closedness(&mesh).is_closed());
    }

    #[test]
    fn a_wide_crease_angle_is_the_same_as_smooth() {
        let mesh = generate::icosphere(1.0, 2);
        let wide = creased(&mesh, std::f32::consts::PI, Weight::Area);
        let all = smooth(&mesh, Weight::Area);
        assert_eq!(wide.values.len(), all.values.len());
        for t in 0..mesh.triangles.len() {
            let pairs = wide.corners(t, mesh.triangles[t]).unwrap();
            for (a, b) in pairs.iter().zip(all.corners(t, mesh.triangles[t]).unwrap()) {
                assert!((*a - b).length() < 1e-6);
            }
        }
    }

    #[test]
    fn a_cylinder_is_smooth_at_the_side_and_sharp_at_the_rim() {
        let mesh = generate::cylinder(1.0, 2.0, 32, 1, true);
        let normals = creased(&mesh, 0.5, Weight::Angle);
        for t in 0..mesh.triangles.len() {
            let facet = mesh.area_normal(t).normalize();
            for (corner, n) in mesh.corners(t).iter().zip(normals.corners(t, mesh.triangles[t]).unwrap()) {
                let truth = if facet.y.abs() > 0.5 { facet } else { Vec3::new(corner.x, 0.0, corner.z) };
                assert!((n - truth).length() < 1e-5, "{n} is not {truth}");
            }
        }
    }

    #[test]
    fn angle_weights_do_not_see_how_a_face_is_cut() {
        // At four of the eight corners a face of a cube counts twice by number of triangles; by angle it never does.
        let mesh = generate::cuboid(Vec3::splat(2.0), [1, 1, 1]);
        for (p, n) in mesh.positions.iter().zip(smooth(&mesh, Weight::Angle).values) {
            assert!((p.normalize() - n).length() < 1e-6);
        }
    }

    #[test]
    fn triangles_without_area_do_no_harm() {
        let positions = vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::X * 2.0, Vec3::X * 3.0];
        let mesh = TriangleMesh::new(positions, vec![[0, 1, 2], [0, 1, 3], [1, 3, 4], [0, 0, 0]]);
        for weight in [Weight::Area, Weight::Angle] {
            for normals in [flat(&mesh), smooth(&mesh, weight), creased(&mesh, 1.0, weight)] {
                assert!(normals.values.iter().all(|n| (n.length() - 1.0).abs() < 1e-6));
                assert_eq!(normals.corners(0, mesh.triangles[0]).unwrap(), [Vec3::Z; 3]);
            }
        }
    }

    /// Root mean square angle between interpolated and true normals at the centres of a sphere's triangles.
    fn normal_error(mesh: &TriangleMesh, normals: &Attribute<Vec3>) -> f64 {
        let centre = Barycentric { weights: [1.0 / 3.0; 3] };
        let errors = (0..mesh.triangles.len()).map(|t| {
            let truth = centre.interpolate(mesh.corners(t)).as_dvec3().normalize();
            let normal = centre.interpolate(normals.corners(t, mesh.triangles[t]).unwrap());
            truth.cross(normal.as_dvec3().normalize()).length_squared()
        });
        (errors.sum::<f64>() / mesh.triangles.len() as f64).sqrt()
    }

    #[test]
    fn interpolated_normals_of_a_sphere_improve_with_resolution() {
        for weight in [Weight::Area, Weight::Angle] {
            let error = |rings| {
                let mesh = generate::sphere(1.0, 2 * rings, rings);
                normal_error(&mesh, &smooth(&mesh, weight))
            };
            let errors = [error(8), error(16), error(32), error(64)];
            // At least as fast as the edge length.
            assert!(errors.windows(2).all(|pair| pair[1] < 0.55 * pair[0]), "{weight:?}: {errors:?}");
        }
    }
}
