//! A shell with a thickness.

use super::builder::{Builder, NewCorner, Origin, Shade, Uv};
use super::error::check_size;
use super::fans::Fans;
use super::geometry::corner_place;
use super::raise::Region;
use super::{EditError, Grouping, prepared};
use crate::PolygonMesh;
use crate::polygon_mesh::HalfEdges;

/// Gives a surface a thickness in metres: an inner copy turned round, and walls along the borders.
///
/// `offset` says where the surface stands in the wall: 0 on its outside, 1 on its inside. An open surface becomes a closed body; a
/// closed one becomes hollow. Where more than two faces meet at an edge, each sheet becomes a body of its own.
pub fn solidify(mesh: &PolygonMesh, thickness: f64, offset: f64) -> Result<PolygonMesh, EditError> {
    let mesh = &*prepared(mesh);
    let half_edges = HalfEdges::new(mesh);
    let opposites = half_edges.opposites();
    let region = Region::new(mesh, &vec![true; mesh.face_count()], Grouping::Region);
    let borders: Vec<u32> =
        (0..mesh.corners.len() as u32).filter(|&corner| opposites[corner as usize].is_none()).collect();
    check_size(
        mesh.face_count() as u64 * 2 + borders.len() as u64,
        mesh.corners.len() as u64 * 2 + borders.len() as u64 * 4,
    )?;
    let mut builder = Builder::new(mesh);
    let mut fans = Fans::new(&half_edges, &opposites, |_, _| true);
    // Two vertices for each fan: the first fan at a vertex keeps it.
    let mut is_kept = vec![false; mesh.positions.len()];
    let mut sheets: Vec<Option<[u32; 2]>> = vec![None; mesh.corners.len()];
    let mut vertices: Vec<[u32; 2]> = Vec::with_capacity(mesh.corners.len());
    for corner in 0..mesh.corners.len() as u32 {
        let vertex = mesh.corners[corner as usize];
        let pair = *sheets[fans.of(corner) as usize].get_or_insert_with(|| {
            let place = corner_place(mesh, corner as usize);
            let outward = region.outward(corner) * thickness;
            let outward = if outward.is_finite() { outward } else { glam::DVec3::ZERO };
            let outer = if std::mem::replace(&mut is_kept[vertex as usize], true) {
                builder.copy_vertex(vertex)
            } else {
                vertex
            };
            builder.move_vertex(outer, place + outward * offset);
            [outer, builder.vertex(place + outward * (offset - 1.0), Origin::Of(vertex))]
        });
        vertices.push(pair);
    }
    (0..mesh.face_count())
        .for_each(|face| builder.copy_face_with(face, |corner| vertices[corner as usize][0]));
    for face in 0..mesh.face_count() {
        builder.turn_face_with(face, |corner| vertices[corner as usize][1]);
    }
    for from in borders {
        let to = half_edges.next(from);
        let [start, end] = [from, to].map(|corner| vertices[corner as usize]);
        let length = corner_place(mesh, to as usize).distance(corner_place(mesh, from as usize));
        let ratio = if length > 0.0 { (thickness.abs() / length).min(1e6) } else { 0.0 };
        let unfolded = |vertex, corner| NewCorner {
            uv: Uv::Unfolded { from, to, ratio },
            ..NewCorner::like(vertex, corner)
        };
        let wall = vec![
            NewCorner::like(end[0], to),
            NewCorner::like(start[0], from),
            unfolded(start[1], from),
            unfolded(end[1], to),
        ];
        builder.face(half_edges.face(from) as usize, &[wall], Shade::Flat, None);
    }
    Ok(builder.finish())
}
