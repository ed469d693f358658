//! Faces cut by a plane.

use std::collections::HashMap;

use super::Plane;
use crate::PolygonMesh;
use crate::edit::builder::{Builder, NewCorner, Origin, Shade};
use crate::edit::geometry::{area_vector, center, corner_place, place, unit_normal};
use crate::edit::triangles::face_triangles;

/// Vertices nearer to the plane than this times the size of the mesh count as on it: positions in single precision are
/// no better than a sixth of it.
const SNAP: f64 = 1e-6;

/// A part of a face on one side of the plane.
pub(super) struct Fragment {
    pub(super) face: u32,
    pub(super) borders: Vec<Vec<NewCorner>>,
    pub(super) is_above: bool,
    /// Not to be cut at all.
    pub(super) is_whole: bool,
}

impl Fragment {
    pub(super) fn build(&self, builder: &mut Builder) {
        builder.face(self.face as usize, &self.borders, Shade::Mixed, None);
    }
}

/// All faces, those that cross the plane in parts.
pub(super) struct Fragments<'a> {
    mesh: &'a PolygonMesh,
    plane: &'a Plane,
    /// −1 below, 0 on the plane, 1 above; for each position.
    signs: Vec<i8>,
    is_marked: Vec<bool>,
    /// Where edges are cut: by their ends, lower first.
    crossings: HashMap<[u32; 2], u32>,
    /// For each face that crosses the plane the polygons to be cut; rising.
    crossing: Vec<(u32, Vec<u32>)>,
}

impl<'a> Fragments<'a> {
    /// Finds where edges are cut and adds the vertices there.
    pub(super) fn new(
        mesh: &'a PolygonMesh,
        faces: &[bool],
        plane: &'a Plane,
        builder: &mut Builder,
    ) -> Self {
        let largest = mesh.corners.iter().map(|&v| place(mesh, v).abs().max_element());
        let size = largest.filter(|size| size.is_finite()).fold(0.0, f64::max);
        let sign = |position: &glam::Vec3| {
            let height = plane.height(position.as_dvec3());
            if height > SNAP * size {
                1
            } else if height < -SNAP * size {
                -1
            } else {
                0
            }
        };
        let signs: Vec<i8> = mesh.positions.iter().map(sign).collect();
        let is_marked: Vec<bool> =
            (0..mesh.face_count()).map(|face| faces.get(face).copied().unwrap_or(false)).collect();
        let mut result =
            Self { mesh, plane, signs, is_marked, crossings: HashMap::new(), crossing: Vec::new() };
        result.find_crossing_faces();
        result.find_crossings(builder);
        result
    }

    /// True for a vertex of the source on the plane, and for every vertex that the cut has made.
    pub(super) fn is_on_plane(&self, vertex: u32) -> bool {
        self.signs.get(vertex as usize).is_none_or(|sign| *sign == 0)
    }

    fn sign(&self, corner: u32) -> i8 {
        self.signs[self.mesh.corners[corner as usize] as usize]
    }

    fn find_crossing_faces(&mut self) {
        let crosses = |face: usize| {
            let signs = || self.mesh.face(face).map(|corner| self.sign(corner as u32));
            self.is_marked[face] && signs().any(|sign| sign > 0) && signs().any(|sign| sign < 0)
        };
        let crossing: Vec<usize> = (0..self.mesh.face_count()).filter(|&face| crosses(face)).collect();
        let mut needs_triangles = vec![false; self.mesh.face_count()];
        for &face in &crossing {
            needs_triangles[face] = !self.is_easy(face);
        }
        let triangles = face_triangles(self.mesh, |face| needs_triangles[face]);
        let easy = crossing.into_iter().filter(|&face| !needs_triangles[face]);
        let easy = easy.map(|face| (face as u32, self.mesh.face(face).map(|corner| corner as u32).collect()));
        let mut polygons: Vec<(u32, Vec<u32>)> = easy.collect();
        polygons.extend(triangles.iter().map(|triangle| (triangle.face, triangle.corners.to_vec())));
        polygons.sort_by_key(|(face, _)| *face);
        self.crossing = polygons;
    }

    /// Whether the face is flat and one straight cut parts it: it crosses twice, and touches the plane nowhere else.
    fn is_easy(&self, face: usize) -> bool {
        let range = self.mesh.face(face);
        if range.len() == 3 {
            return true;
        }
        if self.mesh.holes.iter().any(|hole| hole.face as usize == face) {
            return false;
        }
        let signs: Vec<i8> = range.clone().map(|corner| self.sign(corner as u32)).collect();
        let at = |place: usize| signs[place % signs.len()];
        let clean = (0..signs.len()).all(|i| at(i + 1) != 0 || at(i) * at(i + 2) < 0);
        let changes = (0..signs.len()).filter(|&i| at(i) * at(i + 1) < 0 || at(i + 1) == 0).count();
        let (normal, middle) = (unit_normal(self.mesh, face), center(self.mesh, face));
        let size =
            range.clone().map(|corner| corner_place(self.mesh, corner).distance(middle)).fold(0.0, f64::max);
        let is_flat = range
            .into_iter()
            .all(|corner| (corner_place(self.mesh, corner) - middle).dot(normal).abs() <= SNAP * size);
        clean && changes == 2 && is_flat
    }

    fn find_crossings(&mut self, builder: &mut Builder) {
        let mut crossings = HashMap::new();
        for (_, corners) in &self.crossing {
            for (i, &corner) in corners.iter().enumerate() {
                let next = corners[(i + 1) % corners.len()];
                if self.sign(corner) * self.sign(next) < 0 {
                    let [from, to] = [corner, next].map(|corner| self.mesh.corners[corner as usize]);
                    let edge = [from.min(to), from.max(to)];
                    crossings.entry(edge).or_insert_with(|| {
                        let [low, high] = edge.map(|vertex| place(self.mesh, vertex));
                        builder.vertex(low.lerp(high, self.share(edge)), Origin::Between(edge[0], edge[1]))
                    });
                }
            }
        }
        self.crossings = crossings;
    }

    /// How far along an edge the plane lies.
    fn share(&self, edge: [u32; 2]) -> f64 {
        let [low, high] = edge.map(|vertex| self.plane.height(place(self.mesh, vertex)));
        let share = low / (low - high);
        if share.is_finite() { share.clamp(0.0, 1.0) } else { 0.5 }
    }

    /// The corner where the edge between two corners is cut, if it is.
    fn crossing_between(&self, corner: u32, next: u32) -> Option<NewCorner> {
        if self.sign(corner) * self.sign(next) >= 0 {
            return None;
        }
        let [from, to] = [corner, next].map(|corner| self.mesh.corners[corner as usize]);
        let edge = [from.min(to), from.max(to)];
        let &vertex = self.crossings.get(&edge)?;
        let share = self.share(edge);
        let [low, high] = if from < to { [corner, next] } else { [next, corner] };
        Some(NewCorner::mixed(vertex, vec![(low, 1.0 - share), (high, share)]))
    }

    /// Gives all parts in the order of their faces.
    pub(super) fn for_each(&self, mut take: impl FnMut(&Fragment)) {
        let mut rest = self.crossing.as_slice();
        for face in 0..self.mesh.face_count() {
            let count = rest.iter().take_while(|(other, _)| *other as usize == face).count();
            for (_, corners) in &rest[..count] {
                self.part(face as u32, corners, &mut take);
            }
            rest = &rest[count..];
            if count == 0 && !self.mesh.face(face).is_empty() {
                take(&self.unparted(face));
            }
        }
    }

    fn part(&self, face: u32, corners: &[u32], take: &mut impl FnMut(&Fragment)) {
        let mut sides: [Vec<NewCorner>; 2] = [Vec::new(), Vec::new()];
        for (i, &corner) in corners.iter().enumerate() {
            let here = NewCorner::like(self.mesh.corners[corner as usize], corner);
            if self.sign(corner) <= 0 {
                sides[0].push(here.clone());
            }
            if self.sign(corner) >= 0 {
                sides[1].push(here);
            }
            if let Some(crossing) = self.crossing_between(corner, corners[(i + 1) % corners.len()]) {
                sides.iter_mut().for_each(|side| side.push(crossing.clone()));
            }
        }
        for (side, (border, reaches)) in sides
            .into_iter()
            .zip([-1, 1].map(|sign| corners.iter().any(|&c| self.sign(c) == sign)))
            .enumerate()
        {
            if reaches {
                take(&Fragment { face, borders: vec![border], is_above: side == 1, is_whole: false });
            } else if corners.iter().all(|&corner| self.sign(corner) == 0) && side == 0 {
                // A triangle of a face that is cut, in the plane itself.
                let fragment = Fragment { face, borders: vec![border], is_above: true, is_whole: false };
                take(&fragment);
            }
        }
    }

    /// A face on one side, or one that is not to be cut but gets the vertices that its neighbours have got.
    fn unparted(&self, face: usize) -> Fragment {
        let borders = self.mesh.borders(face);
        let signs = || self.mesh.face(face).map(|corner| self.sign(corner as u32));
        let is_above = if signs().all(|sign| sign == 0) {
            // The body lies behind the face.
            area_vector(self.mesh, borders[0].clone()).dot(self.plane.normal) < 0.0
        } else {
            signs().any(|sign| sign > 0)
        };
        let with_crossings = |border: std::ops::Range<usize>| {
            let mut corners = Vec::with_capacity(border.len());
            for corner in border.clone() {
                let next = if corner + 1 == border.end { border.start } else { corner + 1 };
                corners.push(NewCorner::like(self.mesh.corners[corner], corner as u32));
                corners.extend(self.crossing_between(corner as u32, next as u32));
            }
            corners
        };
        Fragment {
            face: face as u32,
            borders: borders.into_iter().map(with_crossings).collect(),
            is_above,
            is_whole: !self.is_marked[face],
        }
    }
}
