//! One half mirrored into the other, joined at the plane.

use super::builder::{Builder, NewCorner, Origin};
use super::cut::{Cut, Plane, Side, cut};
use super::error::check_size;
use super::fans::Fans;
use super::geometry::corner_place;
use super::{EditError, prepared};
use crate::PolygonMesh;
use crate::polygon_mesh::HalfEdges;

/// How a mesh is made symmetric.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Symmetry {
    /// The mirror; what it points to is kept and mirrored.
    pub plane: Plane,
    /// How near to the plane vertices are moved onto it and joined, in metres.
    pub tolerance: f64,
}

/// Keeps what lies above the plane and adds its mirror image, joined where the surface meets the plane.
///
/// Faces that lie in the plane go, since they would divide the inside. The values of mirrored corners are those of their originals, normals mirrored.
pub fn symmetrize(mesh: &PolygonMesh, symmetry: &Symmetry) -> Result<PolygonMesh, EditError> {
    let plane = symmetry.plane;
    let all = vec![true; mesh.face_count()];
    let half = cut(mesh, &all, &Cut { plane, keep: Side::Above, cap: false, cap_slot: None })?;
    let half = &*prepared(&half);
    check_size(half.face_count() as u64 * 2, half.corners.len() as u64 * 2)?;
    // What the cut has put on the plane is off it by rounding.
    let largest = half.positions.iter().map(|p| p.as_dvec3().abs().max_element());
    let rounding = largest.filter(|size| size.is_finite()).fold(0.0, f64::max) * 2e-6;
    let tolerance = symmetry.tolerance.max(rounding);
    let is_near: Vec<bool> =
        half.positions.iter().map(|position| plane.height(position.as_dvec3()).abs() <= tolerance).collect();
    let lies_in_plane = |face: usize| half.corners[half.face(face)].iter().all(|&v| is_near[v as usize]);
    let kept: Vec<bool> =
        (0..half.face_count()).map(|face| !half.face(face).is_empty() && !lies_in_plane(face)).collect();
    let half_edges = HalfEdges::new(half);
    let opposites = half_edges.opposites();
    let is_kept = |half_edge: u32| kept[half_edges.face(half_edge) as usize];
    let mut fans = Fans::new(&half_edges, &opposites, |one, other| is_kept(one) && is_kept(other));
    // Fans that end at the plane are joined there; those that only touch it are not.
    let mut meets = vec![false; half.corners.len()];
    for corner in (0..half.corners.len() as u32).filter(|&corner| is_kept(corner)) {
        let [from, to] = half_edges.ends(corner);
        let is_border = opposites[corner as usize].is_none_or(|other| !is_kept(other));
        if is_border && is_near[from as usize] && is_near[to as usize] {
            meets[fans.of(corner) as usize] = true;
            meets[fans.of(half_edges.next(corner)) as usize] = true;
        }
    }
    let mut mirrored = half.clone();
    // The mirror image brings its own values: twice the lists, the second half mirrored.
    let shift = mirrored.normals.values.len() as u32;
    let images: Vec<_> = mirrored
        .normals
        .values
        .iter()
        .map(|normal| {
            (normal.as_dvec3() - plane.normal * (2.0 * plane.normal.dot(normal.as_dvec3()))).as_vec3()
        })
        .collect();
    mirrored.normals.values.extend(images);
    let mut builder = Builder::new(&mirrored);
    let mut image: Vec<Option<u32>> = vec![None; half.corners.len()];
    let mut image_of: Vec<u32> = half.corners.clone();
    for corner in (0..half.corners.len() as u32).filter(|&corner| is_kept(corner)) {
        let (fan, vertex) = (fans.of(corner) as usize, half.corners[corner as usize]);
        image_of[corner as usize] = *image[fan].get_or_insert_with(|| {
            let place = corner_place(half, corner as usize);
            let height = plane.height(place);
            if meets[fan] {
                builder.move_vertex(vertex, place - plane.normal * height);
                return vertex;
            }
            builder.vertex(place - plane.normal * (2.0 * height), Origin::Of(vertex))
        });
    }
    (0..half.face_count()).filter(|&face| kept[face]).for_each(|face| builder.copy_face(face));
    for face in (0..half.face_count()).filter(|&face| kept[face]) {
        let borders = half.borders(face).into_iter().map(|border| {
            border.rev().map(|corner| NewCorner::like(image_of[corner], corner as u32)).collect()
        });
        let borders: Vec<Vec<NewCorner>> = borders.collect();
        builder.face_with_shifted_normals(face, &borders, shift);
    }
    Ok(builder.finish())
}
