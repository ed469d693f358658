//! What a rule selects of one mesh.

use glam::DVec3;

use super::Selection;
use crate::PolygonMesh;
use crate::edit::geometry::{angle_between, unit_normal};
use crate::edit::pieces::component_of_faces;
use crate::polygon_mesh::HalfEdges;

/// The elements of a mesh and who is at whom.
pub(super) struct Elements<'a> {
    mesh: &'a PolygonMesh,
    half_edges: HalfEdges,
    /// Lower end first, rising.
    edges: Vec<[u32; 2]>,
    /// For each edge its first two faces, and how many there are.
    edge_faces: Vec<EdgeFaces>,
}

struct EdgeFaces {
    first: [u32; 2],
    count: u32,
}

/// A kind of element.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Vertices,
    Edges,
    Faces,
}

impl<'a> Elements<'a> {
    /// Those of a prepared mesh.
    pub(super) fn new(mesh: &'a PolygonMesh) -> Self {
        let half_edges = HalfEdges::new(mesh);
        let mut edges = Vec::with_capacity(half_edges.edge_count());
        let mut edge_faces = Vec::with_capacity(half_edges.edge_count());
        for edge in half_edges.edges() {
            edges.push(edge.vertices);
            let face = |place: usize| half_edges.face(edge.half_edges[place.min(edge.half_edges.len() - 1)]);
            edge_faces.push(EdgeFaces { first: [face(0), face(1)], count: edge.half_edges.len() as u32 });
        }
        Self { mesh, half_edges, edges, edge_faces }
    }

    pub(super) fn edge_list(&self) -> impl Iterator<Item = [u32; 2]> + '_ {
        self.edges.iter().copied()
    }

    pub(super) fn faces(&self, rule: &Selection) -> Vec<bool> {
        self.flags(rule, Kind::Faces)
    }

    pub(super) fn vertices(&self, rule: &Selection) -> Vec<bool> {
        self.flags(rule, Kind::Vertices)
    }

    pub(super) fn edges(&self, rule: &Selection) -> Vec<bool> {
        self.flags(rule, Kind::Edges)
    }

    fn count(&self, kind: Kind) -> usize {
        match kind {
            Kind::Vertices => self.mesh.positions.len(),
            Kind::Edges => self.edges.len(),
            Kind::Faces => self.mesh.face_count(),
        }
    }

    fn flags(&self, rule: &Selection, kind: Kind) -> Vec<bool> {
        let by_vertex = |holds: &dyn Fn(DVec3) -> bool| {
            let flags = self.mesh.positions.iter().map(|position| holds(position.as_dvec3())).collect();
            self.convert(flags, Kind::Vertices, kind)
        };
        let by_face = |holds: &dyn Fn(usize) -> bool| {
            self.convert((0..self.mesh.face_count()).map(holds).collect(), Kind::Faces, kind)
        };
        let by_edge = |holds: &dyn Fn(usize) -> bool| {
            self.convert((0..self.edges.len()).map(holds).collect(), Kind::Edges, kind)
        };
        match rule {
            Selection::All => vec![true; self.count(kind)],
            Selection::None => vec![false; self.count(kind)],
            Selection::Faces(ranges) => {
                self.convert(in_ranges(ranges, self.mesh.face_count()), Kind::Faces, kind)
            }
            Selection::Vertices(ranges) => {
                self.convert(in_ranges(ranges, self.mesh.positions.len()), Kind::Vertices, kind)
            }
            Selection::Edges(list) => {
                let mut flags = vec![false; self.edges.len()];
                for &[one, other] in list {
                    if let Ok(found) = self.edges.binary_search(&[one.min(other), one.max(other)]) {
                        flags[found] = true;
                    }
                }
                self.convert(flags, Kind::Edges, kind)
            }
            Selection::Box { low, high } => by_vertex(&|p| p.cmpge(*low).all() && p.cmple(*high).all()),
            Selection::Sphere { center, radius } => by_vertex(&|p| p.distance(*center) <= *radius),
            Selection::Normal { direction, angle } => {
                let direction = direction.try_normalize().unwrap_or(DVec3::ZERO);
                by_face(&|face| {
                    let normal = unit_normal(self.mesh, face);
                    normal != DVec3::ZERO && angle_between(normal, direction) <= *angle
                })
            }
            Selection::Component(number) => {
                let components = component_of_faces(self.mesh, &self.half_edges);
                by_face(&|face| components[face] == Some(*number))
            }
            Selection::Material(slot) => {
                by_face(&|face| self.mesh.slots.get(face).copied().unwrap_or(0) == *slot)
            }
            Selection::Border => by_edge(&|edge| self.edge_faces[edge].count == 1),
            Selection::Sharp(angle) => by_edge(&|edge| {
                let EdgeFaces { first, count } = self.edge_faces[edge];
                let [one, other] = first.map(|face| unit_normal(self.mesh, face as usize));
                count == 2 && angle_between(one, other) > *angle
            }),
            Selection::Creased => {
                let mut creased: Vec<[u32; 2]> = self
                    .mesh
                    .creases
                    .iter()
                    .map(|c| [c.vertices[0].min(c.vertices[1]), c.vertices[0].max(c.vertices[1])])
                    .collect();
                creased.sort_unstable();
                by_edge(&|edge| creased.binary_search(&self.edges[edge]).is_ok())
            }
            Selection::Corners([least, most]) => {
                by_face(&|face| (*least as usize..=*most as usize).contains(&self.mesh.face(face).len()))
            }
            Selection::Where(field) => {
                let places: Vec<DVec3> = self.mesh.positions.iter().map(|p| p.as_dvec3()).collect();
                let is_true = |value: f64| value != 0.0 && !value.is_nan();
                let flags = field.values(&places).into_iter().map(is_true).collect();
                self.convert(flags, Kind::Vertices, kind)
            }
            Selection::And(rules) => self.folded(rules, kind, true, |one, other| one & other),
            Selection::Or(rules) => self.folded(rules, kind, false, |one, other| one | other),
            Selection::Not(rule) => self.flags(rule, kind).into_iter().map(|flag| !flag).collect(),
            Selection::Grow(rule, times) => self.grown(self.flags(rule, kind), kind, *times),
            Selection::Shrink(rule, times) => {
                let outside = self.flags(rule, kind).into_iter().map(|flag| !flag).collect();
                self.grown(outside, kind, *times).into_iter().map(|flag| !flag).collect()
            }
        }
    }

    fn folded(
        &self,
        rules: &[Selection],
        kind: Kind,
        first: bool,
        join: fn(bool, bool) -> bool,
    ) -> Vec<bool> {
        let mut flags = vec![first; self.count(kind)];
        for rule in rules {
            for (flag, other) in flags.iter_mut().zip(self.flags(rule, kind)) {
                *flag = join(*flag, other);
            }
        }
        flags
    }

    /// What the flags of one kind say about another.
    fn convert(&self, flags: Vec<bool>, from: Kind, to: Kind) -> Vec<bool> {
        let mesh = self.mesh;
        let corners_of = |face: usize| &mesh.corners[mesh.face(face)];
        match (from, to) {
            (Kind::Vertices, Kind::Edges) => {
                self.edges.iter().map(|ends| ends.iter().all(|&end| flags[end as usize])).collect()
            }
            (Kind::Vertices, Kind::Faces) => {
                let holds = |face: usize| {
                    let corners = corners_of(face);
                    !corners.is_empty() && corners.iter().all(|&vertex| flags[vertex as usize])
                };
                (0..mesh.face_count()).map(holds).collect()
            }
            (Kind::Edges, Kind::Vertices) => {
                let mut vertices = vec![false; mesh.positions.len()];
                for (ends, _) in self.edges.iter().zip(&flags).filter(|(_, flag)| **flag) {
                    ends.iter().for_each(|&end| vertices[end as usize] = true);
                }
                vertices
            }
            (Kind::Edges, Kind::Faces) => {
                let mut faces = vec![false; mesh.face_count()];
                for (edge, _) in self.half_edges.edges().zip(&flags).filter(|(_, flag)| **flag) {
                    edge.half_edges.iter().for_each(|&h| faces[self.half_edges.face(h) as usize] = true);
                }
                faces
            }
            (Kind::Faces, Kind::Vertices) => {
                let mut vertices = vec![false; mesh.positions.len()];
                for (face, _) in flags.iter().enumerate().filter(|(_, flag)| **flag) {
                    corners_of(face).iter().for_each(|&vertex| vertices[vertex as usize] = true);
                }
                vertices
            }
            (Kind::Faces, Kind::Edges) => {
                let holds = |edge: crate::edges::Edge| {
                    edge.half_edges.iter().any(|&h| flags[self.half_edges.face(h) as usize])
                };
                self.half_edges.edges().map(holds).collect()
            }
            _ => flags,
        }
    }

    /// With the neighbours: elements that share a vertex, or for vertices an edge.
    fn grown(&self, mut flags: Vec<bool>, kind: Kind, times: u32) -> Vec<bool> {
        for _ in 0..times {
            let before = flags.clone();
            if kind == Kind::Vertices {
                for &[one, other] in &self.edges {
                    let touched = before[one as usize] || before[other as usize];
                    flags[one as usize] |= touched;
                    flags[other as usize] |= touched;
                }
            } else {
                let vertices = self.convert(before.clone(), kind, Kind::Vertices);
                let touches = |vertex: &u32| vertices[*vertex as usize];
                flags = if kind == Kind::Edges {
                    self.edges.iter().map(|ends| ends.iter().any(touches)).collect()
                } else {
                    let corners = |face| &self.mesh.corners[self.mesh.face(face)];
                    (0..self.mesh.face_count())
                        .map(|face| before[face] || corners(face).iter().any(touches))
                        .collect()
                };
            }
            if flags == before {
                break;
            }
        }
        flags
    }
}

fn in_ranges(ranges: &[[u32; 2]], count: usize) -> Vec<bool> {
    let mut flags = vec![false; count];
    for &[first, last] in ranges {
        let (first, end) = ((first as usize).min(count), (last as usize + 1).min(count));
        if first < end {
            flags[first..end].fill(true);
        }
    }
    flags
}
