//! Extrusion and inset.

use glam::DVec3;

use super::builder::{Builder, NewCorner, Origin, Shade, Uv};
use super::error::check_size;
use super::fans::Fans;
use super::geometry::corner_place;
use super::raise::{Carry, Region};
use super::{EditError, prepared};
use crate::PolygonMesh;
use crate::polygon_mesh::HalfEdges;

/// Whether faces side by side move together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Grouping {
    /// They stay joined; walls stand at the border of the region.
    Region,
    /// Each goes alone and gets walls all round.
    Individual,
}

/// How faces are extruded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extrusion {
    /// How far along the normals, in metres; negative sinks in.
    pub distance: f64,
    /// The way to go instead of the normals, in metres.
    pub way: Option<DVec3>,
    /// Whether faces move together.
    pub grouping: Grouping,
    /// Leaves the faces behind too, turned round: an open sheet becomes a closed body.
    pub base: bool,
}

impl Extrusion {
    /// A region that moves along its normals.
    pub fn along_normals(distance: f64) -> Self {
        Self { distance, way: None, grouping: Grouping::Region, base: false }
    }

    /// A region that moves by a vector.
    pub fn by(way: DVec3) -> Self {
        Self { distance: 0.0, way: Some(way), grouping: Grouping::Region, base: false }
    }
}

/// Moves the marked faces and joins them to where they were by walls.
///
/// Along normals, vertices go so far that flat faces at them end up at the distance. The marked faces keep their numbers,
/// walls come last: one for each border edge, with uvs that unfold from the edge, flat normals and no smoothing group. A closed mesh
/// stays closed.
pub fn extrude(mesh: &PolygonMesh, faces: &[bool], extrusion: &Extrusion) -> Result<PolygonMesh, EditError> {
    let mesh = &*prepared(mesh);
    let region = Region::new(mesh, faces, extrusion.grouping);
    let way = |outward: DVec3| extrusion.way.unwrap_or(outward * extrusion.distance);
    let ways: Vec<DVec3> = region.fans.iter().map(|fan| way(fan.outward)).collect();
    region.lift(&ways, Carry::Along, extrusion.base)
}

/// How faces are inset.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inset {
    /// How far the border moves inward, in metres.
    pub width: f64,
    /// How far the faces rise, in metres; negative sinks them in.
    pub depth: f64,
    /// Whether faces move together.
    pub grouping: Grouping,
}

/// Shrinks the marked faces and closes the gap with a ring of faces.
///
/// The width is even all round, and is held a little below that at which an edge of the shrunken faces would turn round.
/// Values in the ring and in the shrunken faces are those of the place. A closed mesh stays closed.
pub fn inset(mesh: &PolygonMesh, faces: &[bool], inset: &Inset) -> Result<PolygonMesh, EditError> {
    let mesh = &*prepared(mesh);
    let region = Region::new(mesh, faces, inset.grouping);
    let widest = region.widest_inset();
    let ways = region.fans.iter().zip(region.face_of_fans()).map(|(fan, face)| {
        // A hundredth short of the end, so that no edge loses all its length.
        fan.inward * inset.width.min(widest[face as usize] * 0.99) + fan.outward * inset.depth
    });
    let ways: Vec<DVec3> = ways.collect();
    region.lift(&ways, Carry::Within { flat: inset.depth == 0.0 }, false)
}

/// Raises a wall from each of the given edges that is a border: one quad beside the only face there.
///
/// Other edges are left alone. `edges` are rising, lower end first.
pub fn extrude_borders(mesh: &PolygonMesh, edges: &[[u32; 2]], way: DVec3) -> Result<PolygonMesh, EditError> {
    let mesh = &*prepared(mesh);
    let half_edges = HalfEdges::new(mesh);
    let opposites = half_edges.opposites();
    let borders = half_edges.edges().filter(|edge| edge.half_edges.len() == 1);
    let borders = borders.filter(|edge| edges.binary_search(&edge.vertices).is_ok());
    let borders: Vec<u32> = borders.map(|edge| edge.half_edges[0]).collect();
    check_size(
        (mesh.face_count() + borders.len()) as u64,
        mesh.corners.len() as u64 + borders.len() as u64 * 4,
    )?;
    let mut fans = Fans::new(&half_edges, &opposites, |_, _| true);
    let mut builder = Builder::new(mesh);
    (0..mesh.face_count()).for_each(|face| builder.copy_face(face));
    // One new vertex for each fan at the border.
    let mut raised: Vec<Option<u32>> = vec![None; mesh.corners.len()];
    for &from in &borders {
        let to = half_edges.next(from);
        let [start, end] = [from, to].map(|corner| {
            *raised[fans.of(corner) as usize].get_or_insert_with(|| {
                builder.vertex(
                    corner_place(mesh, corner as usize) + way,
                    Origin::Of(mesh.corners[corner as usize]),
                )
            })
        });
        let length = corner_place(mesh, to as usize).distance(corner_place(mesh, from as usize));
        let ratio = if length > 0.0 { (way.length() / length).min(1e6) } else { 0.0 };
        let unfolded = |vertex, corner| NewCorner {
            uv: Uv::Unfolded { from, to, ratio },
            ..NewCorner::like(vertex, corner)
        };
        let here = |corner: u32| NewCorner::like(mesh.corners[corner as usize], corner);
        let wall = vec![here(to), here(from), unfolded(start, from), unfolded(end, to)];
        builder.face(half_edges.face(from) as usize, &[wall], Shade::Flat, None);
    }
    Ok(builder.finish())
}
