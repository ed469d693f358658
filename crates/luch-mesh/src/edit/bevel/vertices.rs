//! Corners cut off.

use super::{Beveled, Surroundings};
use crate::PolygonMesh;
use crate::edit::builder::{Builder, NewCorner, Origin, Shade};
use crate::edit::error::check_size;
use crate::edit::{EditError, prepared};

/// Cuts off the marked vertices: a new vertex on each edge, `width` metres away, and a face between them.
///
/// The width is held below half of the shortest edge between two marked vertices, and below the shortest edge at one. At a border the
/// new face closes along it. A closed mesh stays closed.
///
/// # Errors
/// [`EditError::NotManifold`] if at a marked vertex there is an edge that has three faces, or two of the same direction.
pub fn bevel_vertices(mesh: &PolygonMesh, vertices: &[bool], width: f64) -> Result<Beveled, EditError> {
    let mesh = &*prepared(mesh);
    let around = Surroundings::new(mesh);
    let is_marked = |vertex: u32| vertices.get(vertex as usize).copied().unwrap_or(false);
    check_size(mesh.face_count() as u64 + mesh.positions.len() as u64, mesh.corners.len() as u64 * 3)?;
    let mut width = width;
    for edge in around.half_edges.edges() {
        let marked = edge.vertices.iter().filter(|vertex| is_marked(**vertex)).count();
        if marked == 0 {
            continue;
        }
        if edge.half_edges.len() > 1 && around.opposites[edge.half_edges[0] as usize].is_none() {
            return Err(EditError::NotManifold { vertices: edge.vertices });
        }
        let [one, other] = edge.vertices.map(|vertex| mesh.positions[vertex as usize].as_dvec3());
        width = width.min(one.distance(other) / marked as f64 * 0.99);
    }
    let mut builder = Builder::new(mesh);
    // For each corner the points on its incoming and its outgoing edge.
    let mut points: Vec<Option<[u32; 2]>> = vec![None; mesh.corners.len()];
    let mut faces: Vec<Vec<NewCorner>> = Vec::new();
    let mut likes: Vec<u32> = Vec::new();
    for start in 0..mesh.corners.len() as u32 {
        if !is_marked(around.vertex(start)) || points[start as usize].is_some() {
            continue;
        }
        let fan = around.around(start);
        let place = around.place(start);
        let mut point = |direction: glam::DVec3, end: u32| {
            builder.vertex(place + direction * width, Origin::Between(around.vertex(start), end))
        };
        let mut outgoing: Vec<u32> =
            fan.corners.iter().map(|&c| point(around.outgoing(c), around.vertex(around.next(c)))).collect();
        let last = fan.corners[fan.corners.len() - 1];
        let end = if fan.is_closed {
            outgoing[0]
        } else {
            point(around.incoming(last), around.vertex(around.previous[last as usize]))
        };
        outgoing.push(end);
        let mut ring = Vec::with_capacity(outgoing.len());
        for (&corner, pair) in fan.corners.iter().zip(outgoing.windows(2)) {
            points[corner as usize] = Some([pair[1], pair[0]]);
            ring.push(around.near(corner, pair[0], around.outgoing(corner) * width));
        }
        if !fan.is_closed {
            ring.push(around.near(last, end, around.incoming(last) * width));
        }
        faces.push(ring);
        likes.push(around.half_edges.face(start));
    }
    for face in 0..mesh.face_count() {
        let borders = mesh.borders(face).into_iter().map(|border| {
            let corners = border.flat_map(|corner| {
                let corner = corner as u32;
                let near = |vertex, way| around.near(corner, vertex, way);
                match points[corner as usize] {
                    None => vec![NewCorner::like(around.vertex(corner), corner)],
                    Some([before, after]) => vec![
                        near(before, around.incoming(corner) * width),
                        near(after, around.outgoing(corner) * width),
                    ],
                }
            });
            corners.collect()
        });
        builder.face(face, &borders.collect::<Vec<Vec<_>>>(), Shade::Mixed, None);
    }
    for (ring, like) in faces.into_iter().zip(likes) {
        builder.face(like as usize, &[ring], Shade::Flat, None);
    }
    Ok(Beveled { mesh: builder.finish(), width })
}
