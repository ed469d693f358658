//! Who is whose neighbour across the edges of polygons; made on request, never stored in the mesh.

use super::PolygonMesh;
use crate::edges::{Edge, Edges};

/// The half-edges of a polygon mesh: one for each corner, from it to the next corner of the same border.
#[derive(Clone, Debug)]
pub struct HalfEdges {
    ends: Vec<[u32; 2]>,
    next: Vec<u32>,
    faces: Vec<u32>,
    edges: Edges,
}

impl HalfEdges {
    /// Sorts the half-edges of a mesh. Corners that belong to no face, and those whose position does not exist, lead
    /// from vertex 0 to itself and so have no edge.
    pub fn new(mesh: &PolygonMesh) -> Self {
        let count = mesh.corners.len();
        let (mut ends, mut next, mut faces) =
            (vec![[0; 2]; count], (0..count as u32).collect::<Vec<_>>(), vec![0; count]);
        let exists = |vertex: u32| (vertex as usize) < mesh.positions.len();
        for face in 0..mesh.face_count() {
            for border in mesh.borders(face) {
                for corner in border.clone() {
                    let following = if corner + 1 == border.end { border.start } else { corner + 1 };
                    let [from, to] = [mesh.corners[corner], mesh.corners[following]];
                    next[corner] = following as u32;
                    faces[corner] = face as u32;
                    if exists(from) && exists(to) {
                        ends[corner] = [from, to];
                    }
                }
            }
        }
        let edges = Edges::from_ends(count, mesh.positions.len(), |half_edge| ends[half_edge as usize]);
        Self { ends, next, faces, edges }
    }

    /// Start and end vertex of the half-edge that begins at a corner.
    pub fn ends(&self, corner: u32) -> [u32; 2] {
        self.ends[corner as usize]
    }

    /// The next corner of the same border.
    pub fn next(&self, corner: u32) -> u32 {
        self.next[corner as usize]
    }

    /// The face of a corner.
    pub fn face(&self, corner: u32) -> u32 {
        self.faces[corner as usize]
    }

    /// How many edges there are.
    pub fn edge_count(&self) -> usize {
        self.edges.len()
    }

    /// The edges with their half-edges, rising by lower end, then higher end.
    pub fn edges(&self) -> impl Iterator<Item = Edge<'_>> {
        self.edges.iter_ends(|half_edge| self.ends[half_edge as usize])
    }

    /// For each corner the one half-edge that runs the other way along its edge; `None` at borders, and where more
    /// than two faces meet or two run the same way.
    pub fn opposites(&self) -> Vec<Option<u32>> {
        let mut opposites = vec![None; self.ends.len()];
        for edge in self.edges() {
            if let &[one, other] = edge.half_edges
                && self.ends(one)[0] != self.ends(other)[0]
            {
                opposites[one as usize] = Some(other);
                opposites[other as usize] = Some(one);
            }
        }
        opposites
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    #[test]
    fn two_squares_share_an_edge() {
        let mut mesh = PolygonMesh { positions: vec![Vec3::ZERO; 6], ..Default::default() };
        mesh.add_face(&[0, 1, 4, 3]);
        mesh.add_face(&[1, 2, 5, 4]);
        let half_edges = HalfEdges::new(&mesh);
        assert_eq!(half_edges.edge_count(), 7);
        let opposites = half_edges.opposites();
        assert_eq!(opposites.iter().flatten().count(), 2);
        assert_eq!((opposites[1], opposites[7]), (Some(7), Some(1)));
        assert_eq!((half_edges.next(3), half_edges.face(7)), (0, 1));
    }

    #[test]
    fn corners_without_positions_have_no_edges() {
        let mut mesh = PolygonMesh::default();
        mesh.add_face(&[0, 1, 2]);
        assert_eq!(HalfEdges::new(&mesh).edge_count(), 0);
    }

    #[test]
    fn holes_have_half_edges_of_their_own() {
        let mut mesh = PolygonMesh { positions: vec![Vec3::ZERO; 8], ..Default::default() };
        mesh.add_face_with_holes(&[0, 1, 2, 3], &[&[4, 5, 6, 7]]);
        let half_edges = HalfEdges::new(&mesh);
        assert_eq!(half_edges.next(3), 0);
        assert_eq!(half_edges.next(7), 4);
        assert_eq!(half_edges.edge_count(), 8);
    }
}
