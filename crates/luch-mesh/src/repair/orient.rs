//! Winding: neighbours agree, bodies face outward, cavities inward.

use glam::DVec3;

use super::{Repaired, faces, sound};
use crate::PolygonMesh;
use crate::polygon_mesh::HalfEdges;

/// Up to so many closed pieces it is found out which lie inside others.
const MOST_NESTED: usize = 256;

/// Turns faces so that neighbours run along their edge in opposite directions, over edges of two faces. Of each piece
/// the winding with more area wins; closed pieces face outward, or inward if they lie within an odd number of others.
/// One-sided pieces (Möbius strips) stay with a seam. The count is that of turned faces.
pub fn orient(mesh: &PolygonMesh) -> Repaired {
    let mut mesh = sound(mesh).mesh;
    let half_edges = HalfEdges::new(&mesh);
    let face_count = mesh.face_count();
    // Neighbours over edges of two faces, and whether they agree.
    let mut starts = vec![0u32; face_count + 1];
    let mut links = Vec::new();
    let mut is_closed_face = vec![true; face_count];
    for edge in half_edges.edges() {
        if let &[one, other] = edge.half_edges {
            let agrees = half_edges.ends(one)[0] != half_edges.ends(other)[0];
            let [a, b] = [one, other].map(|half| half_edges.face(half));
            links.extend([(a, b, agrees), (b, a, agrees)]);
        } else {
            edge.half_edges.iter().for_each(|&h| is_closed_face[half_edges.face(h) as usize] = false);
        }
    }
    links.sort_unstable();
    links.iter().for_each(|link| starts[link.0 as usize + 1] += 1);
    (0..face_count).for_each(|face| starts[face + 1] += starts[face]);
    let mut is_flipped = vec![false; face_count];
    let mut seen = vec![false; face_count];
    let mut pieces: Vec<Piece> = Vec::new();
    for first in 0..face_count as u32 {
        if std::mem::replace(&mut seen[first as usize], true) {
            continue;
        }
        let mut piece = Piece { faces: vec![first], is_closed: true };
        let mut next = 0;
        while let Some(&face) = piece.faces.get(next) {
            next += 1;
            piece.is_closed &= is_closed_face[face as usize];
            let range = starts[face as usize] as usize..starts[face as usize + 1] as usize;
            for &(_, other, agrees) in &links[range] {
                let wanted = is_flipped[face as usize] == agrees;
                if !std::mem::replace(&mut seen[other as usize], true) {
                    is_flipped[other as usize] = wanted;
                    piece.faces.push(other);
                } else if is_flipped[other as usize] != wanted {
                    piece.is_closed = false;
                }
            }
        }
        pieces.push(piece);
    }
    let depths = depths(&mesh, &pieces);
    for (piece, depth) in pieces.iter().zip(depths) {
        let turns_all = match depth {
            Some(depth) => (piece.volume(&mesh, &is_flipped) < 0.0) == (depth % 2 == 0),
            None => piece.flipped_area(&mesh, &is_flipped) > 0.0,
        };
        if turns_all {
            piece.faces.iter().for_each(|&face| is_flipped[face as usize] ^= true);
        }
    }
    faces::flip_faces(&mut mesh, &is_flipped);
    Repaired { mesh, count: is_flipped.iter().filter(|flipped| **flipped).count() }
}

/// Faces joined over edges.
struct Piece {
    faces: Vec<u32>,
    is_closed: bool,
}

impl Piece {
    fn volume(&self, mesh: &PolygonMesh, is_flipped: &[bool]) -> f64 {
        let origin = self.point(mesh);
        let part = |&face: &u32| {
            let sign = if is_flipped[face as usize] { -1.0 } else { 1.0 };
            let first = mesh.positions[mesh.corners[mesh.face(face as usize).start] as usize].as_dvec3();
            sign * (first - origin).dot(faces::doubled_area_normal(mesh, face as usize))
        };
        self.faces.iter().map(part).sum()
    }

    /// Area that would be turned minus area that would stay.
    fn flipped_area(&self, mesh: &PolygonMesh, is_flipped: &[bool]) -> f64 {
        let part = |&face: &u32| {
            let area = faces::doubled_area_normal(mesh, face as usize).length();
            if is_flipped[face as usize] { area } else { -area }
        };
        self.faces.iter().map(part).sum()
    }

    fn point(&self, mesh: &PolygonMesh) -> DVec3 {
        mesh.positions[mesh.corners[mesh.face(self.faces[0] as usize).start] as usize].as_dvec3()
    }
}

/// For each closed piece how many other closed pieces contain it.
fn depths(mesh: &PolygonMesh, pieces: &[Piece]) -> Vec<Option<usize>> {
    let closed: Vec<usize> = (0..pieces.len()).filter(|&piece| pieces[piece].is_closed).collect();
    let mut depths: Vec<Option<usize>> = pieces.iter().map(|piece| piece.is_closed.then_some(0)).collect();
    if closed.len() < 2 || closed.len() > MOST_NESTED {
        return depths;
    }
    for &piece in &closed {
        let point = pieces[piece].point(mesh);
        let others = closed.iter().filter(|other| **other != piece);
        depths[piece] = Some(others.filter(|&&other| contains(mesh, &pieces[other], point)).count());
    }
    depths
}

/// By the parity of crossings of a ray, the majority of three: a ray may meet an edge.
fn contains(mesh: &PolygonMesh, piece: &Piece, point: DVec3) -> bool {
    let directions = [[0.8017, 0.2673, 0.5345], [-0.3714, 0.5571, 0.7428], [0.1374, -0.8242, 0.5494]];
    let votes = directions.into_iter().filter(|direction| {
        let direction = DVec3::from(*direction);
        piece.faces.iter().map(|&face| crossings(mesh, face, point, direction)).sum::<usize>() % 2 == 1
    });
    votes.count() > 1
}

fn crossings(mesh: &PolygonMesh, face: u32, point: DVec3, direction: DVec3) -> usize {
    let corners = &mesh.corners[mesh.face(face as usize)];
    let place = |vertex: u32| mesh.positions[vertex as usize].as_dvec3() - point;
    let a = place(corners[0]);
    let crosses = |pair: &&[u32]| {
        let (b, c) = (place(pair[0]), place(pair[1]));
        let volumes = [a.cross(b), b.cross(c), c.cross(a)].map(|n| n.dot(direction));
        let same = volumes.iter().all(|v| *v > 0.0) || volumes.iter().all(|v| *v < 0.0);
        let normal = (b - a).cross(c - a);
        same && a.dot(normal) * direction.dot(normal) > 0.0
    };
    corners[1..].windows(2).filter(crosses).count()
}
