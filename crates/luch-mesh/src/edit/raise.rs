//! Lifting faces off a mesh and closing the gap with walls: what extrusion and inset have in common.

use glam::DVec3;

use super::EditError;
use super::builder::{Builder, NewCorner, Origin, Shade, Uv};
use super::error::check_size;
use super::extrude::Grouping;
use super::fans::Fans;
use super::geometry::{corner_place, previous_corners, unit_normals};
use crate::PolygonMesh;
use crate::normals::corner_angle;
use crate::polygon_mesh::HalfEdges;

/// The corners of lifted faces that stay together at one vertex.
pub(super) struct Fan {
    pub(super) vertex: u32,
    /// How far to go so that the faces end up one metre outward (as nearly as one vector can).
    pub(super) outward: DVec3,
    /// How far to go so that the border ends up one metre inward; zero inside the region.
    pub(super) inward: DVec3,
    has_border: bool,
}

/// How values at the lifted corners come about.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Carry {
    /// The faces take theirs along; walls unfold.
    Along,
    /// The faces shrink within themselves: values are those of the place.
    Within {
        /// Whether the walls lie in the old faces.
        flat: bool,
    },
}

/// The lifted part of a mesh before it is known how far.
pub(super) struct Region<'a> {
    mesh: &'a PolygonMesh,
    selected: Vec<bool>,
    half_edges: HalfEdges,
    opposites: Vec<Option<u32>>,
    previous: Vec<u32>,
    grouping: Grouping,
    pub(super) fans: Vec<Fan>,
    /// For each corner its fan; meaningless for other faces.
    fan_of: Vec<u32>,
}

/// No even offset goes farther than so many times the distance.
const MOST_STRETCH: f64 = 5.0;

/// The vector that moves all planes with these unit normals outward by one, as nearly as it can: `sum` is the sum of
/// weighted normals, `total` that of the weights.
pub(super) fn even_outward(sum: DVec3, total: f64) -> DVec3 {
    let length = sum.length();
    let Some(direction) = sum.try_normalize() else { return DVec3::ZERO };
    direction * (total / length).min(MOST_STRETCH)
}

impl<'a> Region<'a> {
    /// The marked faces of a prepared mesh.
    pub(super) fn new(mesh: &'a PolygonMesh, faces: &[bool], grouping: Grouping) -> Self {
        let is_selected = |face| faces.get(face).copied().unwrap_or(false) && !mesh.face(face).is_empty();
        let selected: Vec<bool> = (0..mesh.face_count()).map(is_selected).collect();
        let half_edges = HalfEdges::new(mesh);
        let opposites = half_edges.opposites();
        let previous = previous_corners(&half_edges, mesh.corners.len());
        let mut joined = Fans::new(&half_edges, &opposites, |one, other| {
            grouping == Grouping::Region
                && selected[half_edges.face(one) as usize]
                && selected[half_edges.face(other) as usize]
        });
        let mut region = Self {
            mesh,
            fan_of: vec![0; mesh.corners.len()],
            fans: Vec::new(),
            selected,
            half_edges,
            opposites,
            previous,
            grouping,
        };
        region.find_fans(&mut joined);
        region
    }

    fn find_fans(&mut self, joined: &mut Fans) {
        struct Sum {
            normal: DVec3,
            weight: f64,
            inward: [DVec3; 2],
        }
        const UNSEEN: u32 = u32::MAX;
        let normals = unit_normals(self.mesh);
        let mut number_of = vec![UNSEEN; self.mesh.corners.len()];
        let mut sums: Vec<Sum> = Vec::new();
        for corner in self.lifted_corners() {
            let root = joined.of(corner) as usize;
            if number_of[root] == UNSEEN {
                number_of[root] = sums.len() as u32;
                let vertex = self.mesh.corners[corner as usize];
                self.fans.push(Fan { vertex, outward: DVec3::ZERO, inward: DVec3::ZERO, has_border: false });
                sums.push(Sum { normal: DVec3::ZERO, weight: 0.0, inward: [DVec3::ZERO; 2] });
            }
            let number = number_of[root] as usize;
            self.fan_of[corner as usize] = number as u32;
            let (before, after) = (self.previous[corner as usize], self.half_edges.next(corner));
            let [before_place, here, after_place] =
                [before, corner, after].map(|corner| corner_place(self.mesh, corner as usize));
            let normal = normals[self.half_edges.face(corner) as usize];
            let angle = corner_angle(before_place, here, after_place);
            if normal != DVec3::ZERO && angle.is_finite() {
                sums[number].normal += normal * angle;
                sums[number].weight += angle;
            }
            // The borders that end and begin here, and the way inward from them.
            for (place, half_edge) in [before, corner].into_iter().enumerate() {
                if self.is_border(half_edge) {
                    let along = if place == 0 { here - before_place } else { after_place - here };
                    let inward = normal.cross(along).try_normalize().unwrap_or(DVec3::ZERO);
                    sums[number].inward[place] = inward;
                    self.fans[number].has_border = true;
                }
            }
        }
        for (fan, Sum { normal, weight, inward: [one, other] }) in self.fans.iter_mut().zip(sums) {
            fan.outward = even_outward(normal, weight);
            // Where both lines meet that run one metre inside the borders.
            let spread = (1.0 + one.dot(other)).max(2.0 / (MOST_STRETCH * MOST_STRETCH));
            fan.inward = (one + other) / spread;
        }
    }

    fn lifted_corners(&self) -> impl Iterator<Item = u32> + use<> {
        let faces: Vec<_> = (0..self.mesh.face_count())
            .filter(|&face| self.selected[face])
            .map(|face| self.mesh.face(face))
            .collect();
        faces.into_iter().flatten().map(|corner| corner as u32)
    }

    /// Whether the half-edge of a lifted face has no lifted face across that goes along with it.
    fn is_border(&self, half_edge: u32) -> bool {
        self.grouping == Grouping::Individual
            || self.opposites[half_edge as usize]
                .is_none_or(|other| !self.selected[self.half_edges.face(other) as usize])
    }

    /// For each face, or for all together if they move together, the widest inset at which no edge turns round.
    pub(super) fn widest_inset(&self) -> Vec<f64> {
        let mut widest = vec![f64::INFINITY; self.mesh.face_count()];
        for corner in self.lifted_corners() {
            let next = self.half_edges.next(corner);
            let inward = |corner: u32| self.fans[self.fan_of[corner as usize] as usize].inward;
            let along = corner_place(self.mesh, next as usize) - corner_place(self.mesh, corner as usize);
            let shrinking = -(inward(next) - inward(corner)).dot(along) / along.length_squared();
            if shrinking > 0.0 {
                let widest = &mut widest[self.half_edges.face(corner) as usize];
                *widest = widest.min(1.0 / shrinking);
            }
        }
        if self.grouping == Grouping::Region {
            let least = widest.iter().copied().fold(f64::INFINITY, f64::min);
            widest.fill(least);
        }
        widest
    }

    /// How far a lifted corner goes so that its faces end up one metre outward.
    pub(super) fn outward(&self, corner: u32) -> DVec3 {
        self.fans[self.fan_of[corner as usize] as usize].outward
    }

    /// A face of each fan.
    pub(super) fn face_of_fans(&self) -> Vec<u32> {
        let mut faces = vec![0; self.fans.len()];
        for corner in self.lifted_corners() {
            faces[self.fan_of[corner as usize] as usize] = self.half_edges.face(corner);
        }
        faces
    }

    /// Moves each fan by its vector and builds walls. `base` leaves the faces behind too, turned round.
    pub(super) fn lift(&self, ways: &[DVec3], carry: Carry, base: bool) -> Result<PolygonMesh, EditError> {
        let mesh = self.mesh;
        let walls: Vec<u32> = self.lifted_corners().filter(|&corner| self.is_border(corner)).collect();
        let more = walls.len() as u64 + if base { mesh.face_count() as u64 } else { 0 };
        check_size(mesh.face_count() as u64 + more, mesh.corners.len() as u64 * 2 + walls.len() as u64 * 4)?;
        let mut builder = Builder::new(mesh);
        let lifted = self.fans.iter().zip(ways).map(|(fan, &way)| {
            if !fan.has_border && !base && way == DVec3::ZERO {
                return fan.vertex;
            }
            let from = mesh.positions[fan.vertex as usize].as_dvec3();
            builder.vertex(if way.is_finite() { from + way } else { from }, Origin::Of(fan.vertex))
        });
        let lifted: Vec<u32> = lifted.collect();
        let lifted_vertex = |corner: u32| lifted[self.fan_of[corner as usize] as usize];
        let lifted_corner = |corner: u32| match carry {
            Carry::Along => NewCorner::like(lifted_vertex(corner), corner),
            Carry::Within { .. } => {
                let way = ways[self.fan_of[corner as usize] as usize];
                self.corner_within(corner, lifted_vertex(corner), way)
            }
        };
        for face in 0..mesh.face_count() {
            if !self.selected[face] {
                builder.copy_face(face);
            } else if carry == Carry::Along {
                builder.copy_face_with(face, lifted_vertex);
            } else {
                let borders = mesh.borders(face);
                let borders =
                    borders.into_iter().map(|b| b.map(|corner| lifted_corner(corner as u32)).collect());
                builder.face(face, &borders.collect::<Vec<Vec<_>>>(), Shade::Mixed, None);
            }
        }
        let is_flat = carry == Carry::Within { flat: true };
        for from in walls {
            let to = self.half_edges.next(from);
            let vertex = |corner: u32| mesh.corners[corner as usize];
            let [mut far, mut near] = [to, from].map(lifted_corner);
            if carry == Carry::Along {
                let length = corner_place(mesh, to as usize).distance(corner_place(mesh, from as usize));
                let unfold = |corner: u32| {
                    let rise = ways[self.fan_of[corner as usize] as usize].length();
                    let ratio = if length > 0.0 { (rise / length).min(1e6) } else { 0.0 };
                    Uv::Unfolded { from, to, ratio }
                };
                (far.uv, near.uv) = (unfold(to), unfold(from));
            }
            let wall = vec![NewCorner::like(vertex(from), from), NewCorner::like(vertex(to), to), far, near];
            let shade = if is_flat { Shade::Mixed } else { Shade::Flat };
            builder.face(self.half_edges.face(from) as usize, &[wall], shade, None);
        }
        if base {
            for face in (0..mesh.face_count()).filter(|&face| self.selected[face]) {
                builder.turn_face_with(face, |corner| mesh.corners[corner as usize]);
            }
        }
        Ok(builder.finish())
    }

    /// A corner moved within its face: the values of the plane through it and its two neighbours.
    fn corner_within(&self, corner: u32, vertex: u32, way: DVec3) -> NewCorner {
        let (before, after) = (self.previous[corner as usize], self.half_edges.next(corner));
        let here = corner_place(self.mesh, corner as usize);
        let forward = corner_place(self.mesh, after as usize) - here;
        let backward = corner_place(self.mesh, before as usize) - here;
        let Some([along_forward, along_backward]) = split_along(way, forward, backward) else {
            return NewCorner::like(vertex, corner);
        };
        let rest = 1.0 - along_forward - along_backward;
        NewCorner::mixed(vertex, vec![(corner, rest), (after, along_forward), (before, along_backward)])
    }
}

/// The vector as a sum of parts of two others, as nearly as can be; `None` if they are on one line.
pub(super) fn split_along(way: DVec3, one: DVec3, other: DVec3) -> Option<[f64; 2]> {
    let (a, b, c) = (one.dot(one), one.dot(other), other.dot(other));
    let determinant = a * c - b * b;
    if !(determinant > 1e-9 * a * c && determinant.is_finite()) {
        return None;
    }
    let (p, q) = (way.dot(one), way.dot(other));
    let parts = [(p * c - q * b) / determinant, (q * a - p * b) / determinant];
    parts.iter().all(|part| part.is_finite()).then_some(parts)
}
