//! Who is whose neighbour, in flat lists, and how the lists of the next level follow from those of this one.
//!
//! Only the first level is sorted. Afterwards every number has a closed form: the children of vertices, then of edges,
//! then of faces follow one another, and so do the halves of edges and the edges inside faces. All lists are therefore
//! filled in parallel, and do not depend on the number of threads.

mod quads;
mod triangles;

use rayon::prelude::*;

use crate::edges::Edges;

/// How the corners are spread over the faces.
#[derive(Clone, Debug)]
pub(super) enum Sides {
    /// Every face has so many.
    All(u32),
    /// Where the corners of each face begin and the last end, and the face of each corner.
    Mixed { starts: Vec<u32>, faces: Vec<u32> },
}

/// Vertices, edges and faces. Half-edge `h` runs from corner `h` to the next corner of the face.
#[derive(Clone, Debug)]
pub(super) struct Topology {
    pub(super) vertex_count: u32,
    pub(super) sides: Sides,
    /// The vertex of each corner.
    pub(super) corners: Vec<u32>,
    /// The edge of each half-edge.
    pub(super) corner_edges: Vec<u32>,
    pub(super) edge_ends: Vec<[u32; 2]>,
    /// The half-edges of each edge, rising on the first level: groups, see [`group`].
    pub(super) edge_half_starts: Vec<u32>,
    pub(super) edge_halves: Vec<u32>,
    pub(super) vertex_edge_starts: Vec<u32>,
    pub(super) vertex_edges: Vec<u32>,
    pub(super) vertex_corner_starts: Vec<u32>,
    pub(super) vertex_corners: Vec<u32>,
    /// How many more levels an edge stays sharp; infinite at borders and where more than two faces meet.
    pub(super) edge_sharpness: Vec<f32>,
    pub(super) vertex_sharpness: Vec<f32>,
}

/// The members of a group: `members[starts[i]..starts[i + 1]]`.
pub(super) fn group<'a>(starts: &[u32], members: &'a [u32], index: u32) -> &'a [u32] {
    &members[starts[index as usize] as usize..starts[index as usize + 1] as usize]
}

/// A list by a function of the place.
pub(super) fn list<T: Send>(count: usize, value: impl Fn(u32) -> T + Sync + Send) -> Vec<T> {
    (0..count as u32).into_par_iter().with_min_len(1 << 12).map(value).collect()
}

/// The members of all groups, each group filled by a function.
fn groups(starts: &[u32], fill: impl Fn(u32, &mut [u32]) + Sync) -> Vec<u32> {
    const BLOCK: usize = 1 << 12;
    let mut members = vec![0; starts.last().copied().unwrap_or(0) as usize];
    // Disjoint slices for blocks of groups.
    let mut blocks = Vec::with_capacity(starts.len() / BLOCK + 1);
    let mut rest = members.as_mut_slice();
    let group_count = starts.len() - 1;
    for first in (0..group_count).step_by(BLOCK) {
        let end = (first + BLOCK).min(group_count);
        let (block, others) = std::mem::take(&mut rest).split_at_mut((starts[end] - starts[first]) as usize);
        blocks.push((first..end, block));
        rest = others;
    }
    blocks.into_par_iter().for_each(|(range, mut block)| {
        for index in range {
            let (own, others) =
                std::mem::take(&mut block).split_at_mut((starts[index + 1] - starts[index]) as usize);
            fill(index as u32, own);
            block = others;
        }
    });
    members
}

impl Topology {
    /// Sorts the edges of faces whose corners are all different and exist. `face_ends` as in a polygon mesh.
    pub(super) fn new(face_ends: &[u32], corners: Vec<u32>, vertex_count: u32) -> Self {
        let mut starts = Vec::with_capacity(face_ends.len() + 1);
        starts.push(0);
        starts.extend_from_slice(face_ends);
        let side_count = starts.get(1).copied().unwrap_or(3);
        let sides = if starts.windows(2).all(|pair| pair[1] - pair[0] == side_count) {
            Sides::All(side_count)
        } else {
            let faces = starts.windows(2).enumerate();
            let faces = faces
                .flat_map(|(face, pair)| std::iter::repeat_n(face as u32, (pair[1] - pair[0]) as usize))
                .collect();
            Sides::Mixed { starts, faces }
        };
        let mut topology = Self {
            vertex_count,
            sides,
            corner_edges: vec![0; corners.len()],
            corners,
            edge_ends: Vec::new(),
            edge_half_starts: Vec::new(),
            edge_halves: Vec::new(),
            vertex_edge_starts: Vec::new(),
            vertex_edges: Vec::new(),
            vertex_corner_starts: Vec::new(),
            vertex_corners: Vec::new(),
            edge_sharpness: Vec::new(),
            vertex_sharpness: vec![0.0; vertex_count as usize],
        };
        let ends =
            |half: u32| [topology.corners[half as usize], topology.corners[topology.next(half) as usize]];
        let edges = Edges::from_ends(topology.corners.len(), vertex_count as usize, ends);
        let mut corner_edges = vec![0; topology.corners.len()];
        let (mut edge_ends, mut edge_halves) = (Vec::with_capacity(edges.len()), Vec::new());
        let (mut edge_half_starts, mut edge_sharpness) = (vec![0], Vec::with_capacity(edges.len()));
        for edge in edges.iter_ends(ends) {
            for &half in edge.half_edges {
                corner_edges[half as usize] = edge_ends.len() as u32;
            }
            edge_halves.extend_from_slice(edge.half_edges);
            edge_half_starts.push(edge_halves.len() as u32);
            let is_inner = edge.half_edges.len() == 2;
            edge_sharpness.push(if is_inner { 0.0 } else { f32::INFINITY });
            edge_ends.push(edge.vertices);
        }
        (topology.corner_edges, topology.edge_ends) = (corner_edges, edge_ends);
        (topology.edge_halves, topology.edge_half_starts) = (edge_halves, edge_half_starts);
        topology.edge_sharpness = edge_sharpness;
        let count = vertex_count as usize;
        let by_vertex = |list: &[[u32; 2]]| grouped(count, list.iter().enumerate().flat_map(both));
        (topology.vertex_edge_starts, topology.vertex_edges) = by_vertex(&topology.edge_ends);
        (topology.vertex_corner_starts, topology.vertex_corners) =
            grouped(count, topology.corners.iter().enumerate().map(|(corner, &v)| (v, corner as u32)));
        topology
    }

    pub(super) fn face_count(&self) -> usize {
        match &self.sides {
            Sides::All(count) => self.corners.len() / (*count).max(1) as usize,
            Sides::Mixed { starts, .. } => starts.len() - 1,
        }
    }

    /// True if all faces are quads.
    pub(super) fn is_quads(&self) -> bool {
        matches!(self.sides, Sides::All(4))
    }

    pub(super) fn face_of(&self, corner: u32) -> u32 {
        match &self.sides {
            Sides::All(count) => corner / count,
            Sides::Mixed { faces, .. } => faces[corner as usize],
        }
    }

    /// Where the corners of a face begin; of the number after the last face, where they end.
    pub(super) fn face_start(&self, face: u32) -> u32 {
        match &self.sides {
            Sides::All(count) => face * count,
            Sides::Mixed { starts, .. } => starts[face as usize],
        }
    }

    pub(super) fn next(&self, corner: u32) -> u32 {
        let face = self.face_of(corner);
        if corner + 1 == self.face_start(face + 1) { self.face_start(face) } else { corner + 1 }
    }

    pub(super) fn previous(&self, corner: u32) -> u32 {
        let face = self.face_of(corner);
        let start = self.face_start(face);
        if corner == start { self.face_start(face + 1) - 1 } else { corner - 1 }
    }

    pub(super) fn halves_of(&self, edge: u32) -> &[u32] {
        group(&self.edge_half_starts, &self.edge_halves, edge)
    }

    pub(super) fn edges_at(&self, vertex: u32) -> &[u32] {
        group(&self.vertex_edge_starts, &self.vertex_edges, vertex)
    }

    pub(super) fn corners_at(&self, vertex: u32) -> &[u32] {
        group(&self.vertex_corner_starts, &self.vertex_corners, vertex)
    }

    /// The other end of an edge.
    pub(super) fn across(&self, edge: u32, vertex: u32) -> u32 {
        let [one, other] = self.edge_ends[edge as usize];
        if one == vertex { other } else { one }
    }

    /// The corner after this one, counter-clockwise around their vertex; `None` past a border or a change of winding.
    pub(super) fn next_around(&self, corner: u32) -> Option<u32> {
        let incoming = self.previous(corner);
        let &[one, other] = self.halves_of(self.corner_edges[incoming as usize]) else { return None };
        let next = if one == incoming { other } else { one };
        (self.corners[next as usize] == self.corners[corner as usize]).then_some(next)
    }

    /// The child of an edge that touches one of its ends.
    fn half_at(&self, edge: u32, vertex: u32) -> u32 {
        2 * edge + u32::from(self.edge_ends[edge as usize][0] != vertex)
    }

    /// Sharpness of the children of edges and vertices; `inner_edges` lie inside faces and are smooth.
    fn sharpness_of_children(&self, inner_edges: usize, new_vertices: usize) -> [Vec<f32>; 2] {
        let mut edges = list(self.edge_ends.len() * 2 + inner_edges, |child| {
            self.edge_sharpness.get(child as usize / 2).map_or(0.0, |sharpness| less_sharp(*sharpness))
        });
        edges[self.edge_ends.len() * 2..].fill(0.0);
        let mut vertices: Vec<f32> = self.vertex_sharpness.iter().map(|s| less_sharp(*s)).collect();
        vertices.resize(vertices.len() + new_vertices, 0.0);
        [edges, vertices]
    }
}

/// What is left of a sharpness after a level.
pub(super) fn less_sharp(sharpness: f32) -> f32 {
    (sharpness - 1.0).max(0.0)
}

fn both((index, ends): (usize, &[u32; 2])) -> [(u32, u32); 2] {
    ends.map(|vertex| (vertex, index as u32))
}

/// Groups of members by vertex, in the order given: starts and members.
fn grouped(vertex_count: usize, pairs: impl Iterator<Item = (u32, u32)> + Clone) -> (Vec<u32>, Vec<u32>) {
    let mut starts = vec![0u32; vertex_count + 1];
    for (vertex, _) in pairs.clone() {
        starts[vertex as usize + 1] += 1;
    }
    for vertex in 0..vertex_count {
        starts[vertex + 1] += starts[vertex];
    }
    let mut next = starts.clone();
    let mut members = vec![0; starts[vertex_count] as usize];
    for (vertex, member) in pairs {
        members[next[vertex as usize] as usize] = member;
        next[vertex as usize] += 1;
    }
    (starts, members)
}
