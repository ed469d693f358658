//! Normals of polygons, smooth up to a crease angle.

use glam::{DVec3, Vec3};

use crate::PolygonMesh;
use crate::normals::{corner_angle, unit_or_z};
use crate::polygon_mesh::{CornerAttribute, HalfEdges};
use crate::sets::DisjointSets;

/// Normals that are smooth over edges bent by less than `angle` (radians), weighted by the angles at the corners; see
/// [`crate::normals::creased`], which does it for triangles.
pub(super) fn creased(mesh: &PolygonMesh, angle: f64) -> CornerAttribute<Vec3> {
    let least_cosine = libm::cos(angle.clamp(0.0, std::f64::consts::PI)) - 1e-9;
    let half_edges = HalfEdges::new(mesh);
    let place = |corner: usize| mesh.positions[mesh.corners[corner] as usize].as_dvec3();
    let mut facets = Vec::with_capacity(mesh.face_count());
    for face in 0..mesh.face_count() {
        let corners = mesh.borders(face)[0].clone();
        let origin = corners.clone().next().map_or(DVec3::ZERO, place);
        let spokes = corners.map(|corner| {
            let next = half_edges.next(corner as u32) as usize;
            (place(corner) - origin).cross(place(next) - origin)
        });
        facets.push(spokes.sum::<DVec3>().try_normalize());
    }
    let mut fans = DisjointSets::new(mesh.corners.len());
    for (corner, opposite) in (0..).zip(half_edges.opposites()) {
        let Some(opposite) = opposite.filter(|opposite| *opposite > corner) else { continue };
        let [one, other] = [corner, opposite].map(|corner| facets[half_edges.face(corner) as usize]);
        let is_smooth = one.zip(other).is_none_or(|(one, other)| one.dot(other) >= least_cosine);
        if is_smooth {
            fans.join(corner, half_edges.next(opposite));
            fans.join(opposite, half_edges.next(corner));
        }
    }
    // Number the fans by their first corner and sum up.
    let mut sums = vec![DVec3::ZERO; mesh.corners.len()];
    let mut before = vec![0; mesh.corners.len()];
    (0..mesh.corners.len() as u32).for_each(|corner| before[half_edges.next(corner) as usize] = corner);
    for corner in 0..mesh.corners.len() {
        let facet = facets[half_edges.face(corner as u32) as usize].unwrap_or(DVec3::ZERO);
        let [previous, next] = [before[corner], half_edges.next(corner as u32)].map(|c| place(c as usize));
        let root = fans.root(corner as u32) as usize;
        sums[root] += facet * corner_angle(previous, place(corner), next);
    }
    let mut normals = CornerAttribute { values: Vec::new(), corners: Vec::with_capacity(sums.len()) };
    let mut numbers = vec![0; sums.len()];
    for corner in 0..sums.len() {
        let root = fans.root(corner as u32) as usize;
        // The root is the lowest of its set, so it comes first.
        if root == corner {
            numbers[root] = normals.values.len() as u32;
            normals.values.push(unit_or_z(sums[root]));
        }
        normals.corners.push(numbers[root]);
    }
    normals
}
