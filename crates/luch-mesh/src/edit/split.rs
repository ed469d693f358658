//! Finer faces of the same form: vertices on edges, fans around middles, quads.

use glam::DVec3;

use super::builder::{Builder, NewCorner, Origin, Shade};
use super::error::check_size;
use super::geometry::{center, place, unit_normal};
use super::{EditError, prepared};
use crate::PolygonMesh;
use crate::polygon_mesh::HalfEdges;

/// New vertices on edges, found by the edge's ends.
struct Cuts {
    /// Lower end first, rising, each with its first new vertex.
    edges: Vec<([u32; 2], u32)>,
    count: u32,
}

impl Cuts {
    fn new(
        mesh: &PolygonMesh,
        edges: impl Iterator<Item = [u32; 2]>,
        count: u32,
        builder: &mut Builder,
    ) -> Self {
        let cut = |edge: [u32; 2]| {
            let [low, high] = edge.map(|vertex| place(mesh, vertex));
            let made = (1..=count).map(|step| {
                let share = f64::from(step) / f64::from(count + 1);
                builder.vertex(low.lerp(high, share), Origin::Between(edge[0], edge[1]))
            });
            (edge, made.min().unwrap_or(0))
        };
        Self { edges: edges.map(cut).collect(), count }
    }

    /// The new corners between two corners, in the order from the first.
    fn between(&self, mesh: &PolygonMesh, corner: u32, next: u32) -> Vec<NewCorner> {
        let [from, to] = [corner, next].map(|corner| mesh.corners[corner as usize]);
        let edge = [from.min(to), from.max(to)];
        let Ok(found) = self.edges.binary_search_by_key(&edge, |(edge, _)| *edge) else { return Vec::new() };
        let first = self.edges[found].1;
        // Shares count from the lower end, so that both faces mix alike.
        let [low, high] = if from < to { [corner, next] } else { [next, corner] };
        let made = (1..=self.count).map(|step| {
            let share = f64::from(step) / f64::from(self.count + 1);
            NewCorner::mixed(first + step - 1, vec![(low, 1.0 - share), (high, share)])
        });
        if from < to { made.collect() } else { made.rev().collect() }
    }

    /// A border with the new corners in it.
    fn border(&self, mesh: &PolygonMesh, border: std::ops::Range<usize>) -> Vec<NewCorner> {
        let mut corners = Vec::with_capacity(border.len() * 2);
        for corner in border.clone() {
            let next = if corner + 1 == border.end { border.start } else { corner + 1 };
            corners.push(NewCorner::like(mesh.corners[corner], corner as u32));
            corners.extend(self.between(mesh, corner as u32, next as u32));
        }
        corners
    }
}

/// Puts `count` vertices on each of the given edges, evenly spaced. The form stays, and a closed mesh stays closed.
///
/// Triangles made of it may not be: two faces with the same straight corners between them may both be cut there.
/// `edges` are rising, lower end first; those that no face has are left out.
pub fn split_edges(mesh: &PolygonMesh, edges: &[[u32; 2]], count: u32) -> Result<PolygonMesh, EditError> {
    let mesh = &*prepared(mesh);
    let half_edges = HalfEdges::new(mesh);
    let wanted = |edge: &crate::edges::Edge| edges.binary_search(&edge.vertices).is_ok();
    let cut: Vec<[u32; 2]> = half_edges.edges().filter(wanted).map(|edge| edge.vertices).collect();
    let more: u64 = half_edges.edges().filter(wanted).map(|edge| edge.half_edges.len() as u64).sum();
    check_size(mesh.face_count() as u64, mesh.corners.len() as u64 + more * u64::from(count))?;
    let mut builder = Builder::new(mesh);
    let cuts = Cuts::new(mesh, cut.into_iter(), count, &mut builder);
    for face in 0..mesh.face_count() {
        let borders = mesh.borders(face).into_iter().map(|border| cuts.border(mesh, border));
        builder.face(face, &borders.collect::<Vec<_>>(), Shade::Mixed, None);
    }
    Ok(builder.finish())
}

/// Puts a vertex in the middle of each marked face, raised by `height` metres, and makes triangles from it to the edges.
///
/// Faces with holes are left alone.
pub fn poke(mesh: &PolygonMesh, faces: &[bool], height: f64) -> Result<PolygonMesh, EditError> {
    let mesh = &*prepared(mesh);
    check_size((mesh.face_count() + mesh.corners.len()) as u64, mesh.corners.len() as u64 * 3)?;
    let mut builder = Builder::new(mesh);
    for face in 0..mesh.face_count() {
        let borders = mesh.borders(face);
        let [outer] = borders.as_slice() else {
            builder.copy_face(face);
            continue;
        };
        if !faces.get(face).copied().unwrap_or(false) || outer.is_empty() {
            builder.copy_face(face);
            continue;
        }
        let middle = middle_corner(mesh, face, height, &mut builder);
        let shade = if height == 0.0 { Shade::Mixed } else { Shade::Flat };
        for corner in outer.clone() {
            let next = if corner + 1 == outer.end { outer.start } else { corner + 1 };
            let here = |corner: usize| NewCorner::like(mesh.corners[corner], corner as u32);
            builder.face(face, &[vec![here(corner), here(next), middle.clone()]], shade, None);
        }
    }
    Ok(builder.finish())
}

fn middle_corner(mesh: &PolygonMesh, face: usize, height: f64, builder: &mut Builder) -> NewCorner {
    let corners = mesh.face(face);
    let rise = if height == 0.0 { DVec3::ZERO } else { unit_normal(mesh, face) * height };
    let vertex = builder.vertex(center(mesh, face) + rise, Origin::New);
    let share = 1.0 / corners.len() as f64;
    NewCorner::mixed(vertex, corners.map(|corner| (corner as u32, share)).collect())
}

/// Cuts each marked face into quads, one at each corner, from its middle to the middles of its edges; neighbours get the
/// vertices on the edges. The form stays, a closed mesh stays closed. Faces with holes only get vertices on their edges.
pub fn split_quads(mesh: &PolygonMesh, faces: &[bool]) -> Result<PolygonMesh, EditError> {
    let mesh = &*prepared(mesh);
    check_size((mesh.face_count() + mesh.corners.len()) as u64, mesh.corners.len() as u64 * 4)?;
    let is_marked = |face: usize| faces.get(face).copied().unwrap_or(false);
    let half_edges = HalfEdges::new(mesh);
    let touched = half_edges
        .edges()
        .filter(|edge| {
            edge.half_edges.iter().any(|&half_edge| is_marked(half_edges.face(half_edge) as usize))
        })
        .map(|edge| edge.vertices);
    let touched: Vec<[u32; 2]> = touched.collect();
    let mut builder = Builder::new(mesh);
    let cuts = Cuts::new(mesh, touched.into_iter(), 1, &mut builder);
    for face in 0..mesh.face_count() {
        let borders: Vec<Vec<NewCorner>> =
            mesh.borders(face).into_iter().map(|border| cuts.border(mesh, border)).collect();
        // Corners and middles take turns, if every edge was cut.
        let count = mesh.face(face).len();
        if !is_marked(face) || borders.len() > 1 || borders[0].len() != 2 * count || count == 0 {
            builder.face(face, &borders, Shade::Mixed, None);
            continue;
        }
        let middle = middle_corner(mesh, face, 0.0, &mut builder);
        let ring = &borders[0];
        for corner in (0..ring.len()).step_by(2) {
            let before = &ring[(corner + ring.len() - 1) % ring.len()];
            let quad = vec![ring[corner].clone(), ring[corner + 1].clone(), middle.clone(), before.clone()];
            builder.face(face, &[quad], Shade::Mixed, None);
        }
    }
    Ok(builder.finish())
}
