//! How triangles hang together, for large meshes: edges are sorted in slices of the vertices, many at once.
//!
//! The slices keep the memory small (a slice's edges only, besides four bytes for each corner) and run on all threads. All
//! figures are sums, so their number does not matter.

use std::sync::atomic::{AtomicU32, Ordering};

use rayon::prelude::*;

use crate::edges::half_edge_ends;
use crate::measure::EdgeFault;
use crate::sets::DisjointSets;

/// No half-edge.
const NONE: u32 = u32::MAX;

/// What edges and vertices say about the surface.
#[derive(Default)]
pub(super) struct Topology {
    pub(super) edges: usize,
    pub(super) boundary: Option<EdgeFault>,
    pub(super) non_manifold: Option<EdgeFault>,
    pub(super) inconsistent: Option<EdgeFault>,
    pub(super) duplicates: usize,
    /// Half-edges without a counterpart, rising.
    pub(super) border: Vec<u32>,
    /// For each half-edge its one counterpart, or [`NONE`].
    opposites: Vec<u32>,
    /// Half-edges of the same edge, where there are more than two.
    crowds: Vec<[u32; 2]>,
}

impl Topology {
    /// Examines triangles without repeated corners, whose indices are below `vertex_count`.
    pub(super) fn new(triangles: &[[u32; 3]], vertex_count: usize) -> Self {
        let opposites: Vec<AtomicU32> =
            (0..3 * triangles.len()).into_par_iter().map(|_| AtomicU32::new(NONE)).collect();
        // A slice has about a million triangles; each reads the whole list once, so there are not too many.
        let slices = (triangles.len() >> 20).clamp(1, 16);
        let size = vertex_count.div_ceil(slices).max(1);
        let parts: Vec<Self> = (0..slices)
            .into_par_iter()
            .map(|slice| {
                let first = (slice * size).min(vertex_count);
                examine(triangles, first..(first + size).min(vertex_count), &opposites)
            })
            .collect();
        let mut whole = Self::default();
        for part in parts {
            whole.edges += part.edges;
            whole.duplicates += part.duplicates;
            add(&mut whole.boundary, part.boundary);
            add(&mut whole.non_manifold, part.non_manifold);
            add(&mut whole.inconsistent, part.inconsistent);
            whole.border.extend(part.border);
            whole.crowds.extend(part.crowds);
        }
        whole.border.sort_unstable();
        whole.opposites = opposites.into_par_iter().map(AtomicU32::into_inner).collect();
        whole
    }

    /// For each triangle the lowest triangle of its piece; pieces hang together by edges.
    pub(super) fn pieces(&self, triangles: usize) -> DisjointSets {
        let mut pieces = DisjointSets::new(triangles);
        for (half_edge, &opposite) in self.opposites.iter().enumerate() {
            if opposite != NONE && opposite > half_edge as u32 {
                pieces.join(half_edge as u32 / 3, opposite / 3);
            }
        }
        for [one, other] in &self.crowds {
            pieces.join(one / 3, other / 3);
        }
        pieces
    }

    /// The number of fans of triangles at each vertex, 0 for vertices without any.
    pub(super) fn fans(&self, triangles: &[[u32; 3]], vertex_count: usize) -> Vec<u32> {
        // How many triangles a vertex has, and one corner there.
        let mut degrees = vec![0u32; vertex_count];
        let mut corners = vec![NONE; vertex_count];
        for (corner, &vertex) in triangles.as_flattened().iter().enumerate() {
            degrees[vertex as usize] += 1;
            corners[vertex as usize] = corner as u32;
        }
        let mut fans: Vec<u32> = (corners.par_iter().zip(&degrees))
            .map(|(&corner, &degree)| match corner {
                NONE => 0,
                // One walk around the vertex meets all its triangles, or there is another fan.
                corner => 1 + u32::from(self.walk(triangles, corner, degree) < degree),
            })
            .collect();
        // Few vertices have several fans: those are counted by joining.
        let mut crowded: Vec<(u32, u32)> = (triangles.as_flattened().par_iter().enumerate())
            .filter(|(_, vertex)| fans[**vertex as usize] > 1)
            .map(|(corner, &vertex)| (vertex, corner as u32))
            .collect();
        crowded.par_sort_unstable();
        for at_vertex in crowded.chunk_by(|one, other| one.0 == other.0) {
            let place = |corner: u32| {
                at_vertex.binary_search(&(at_vertex[0].0, corner)).ok().map(|place| place as u32)
            };
            let mut sets = DisjointSets::new(at_vertex.len());
            for (number, &(_, corner)) in at_vertex.iter().enumerate() {
                for neighbour in
                    [self.next_around(triangles, corner), self.previous_around(triangles, corner)]
                {
                    if let Some(neighbour) = neighbour.and_then(place) {
                        sets.join(number as u32, neighbour);
                    }
                }
            }
            let count = (0..at_vertex.len() as u32).filter(|&number| sets.root(number) == number).count();
            fans[at_vertex[0].0 as usize] = count as u32;
        }
        fans
    }

    /// How many triangles are met around the vertex of a corner, both ways.
    fn walk(&self, triangles: &[[u32; 3]], start: u32, most: u32) -> u32 {
        let mut met = 1;
        let mut corner = start;
        while let Some(next) = self.next_around(triangles, corner) {
            if next == start || met >= most {
                return met;
            }
            (corner, met) = (next, met + 1);
        }
        corner = start;
        while let Some(previous) = self.previous_around(triangles, corner) {
            if previous == start || met >= most {
                return met;
            }
            (corner, met) = (previous, met + 1);
        }
        met
    }

    /// The corner at the same vertex of the triangle across the edge that leaves the corner.
    fn next_around(&self, triangles: &[[u32; 3]], corner: u32) -> Option<u32> {
        self.across(triangles, corner, corner)
    }

    /// The corner at the same vertex of the triangle across the edge that comes to the corner.
    fn previous_around(&self, triangles: &[[u32; 3]], corner: u32) -> Option<u32> {
        self.across(triangles, corner / 3 * 3 + (corner + 2) % 3, corner)
    }

    fn across(&self, triangles: &[[u32; 3]], half_edge: u32, corner: u32) -> Option<u32> {
        let opposite = self.opposites[half_edge as usize];
        if opposite == NONE {
            return None;
        }
        let vertex = triangles[corner as usize / 3][corner as usize % 3];
        Some(crate::edges::corner_at(triangles, opposite, vertex))
    }
}

fn add(whole: &mut Option<EdgeFault>, part: Option<EdgeFault>) {
    match (whole, part) {
        (Some(whole), Some(part)) => whole.count += part.count,
        (whole @ None, part) => *whole = part,
        (Some(_), None) => {}
    }
}

/// Examines the edges whose lower end is in a range.
fn examine(triangles: &[[u32; 3]], range: std::ops::Range<usize>, opposites: &[AtomicU32]) -> Topology {
    let mut slice = Topology::default();
    let (first, count) = (range.start as u32, range.len());
    // Counting sort by the lower end.
    let mut buckets = vec![0u32; count + 1];
    let own = |[a, b]: [u32; 2]| {
        let low = a.min(b).wrapping_sub(first);
        ((low as usize) < count).then_some((low as usize, a.max(b)))
    };
    for &[a, b, c] in triangles {
        for ends in [[a, b], [b, c], [c, a]] {
            if let Some((low, _)) = own(ends) {
                buckets[low + 1] += 1;
            }
        }
    }
    for vertex in 0..count {
        buckets[vertex + 1] += buckets[vertex];
    }
    let mut keyed = vec![0u64; buckets[count] as usize];
    for (t, &[a, b, c]) in triangles.iter().enumerate() {
        for (k, ends) in [[a, b], [b, c], [c, a]].into_iter().enumerate() {
            if let Some((low, high)) = own(ends) {
                keyed[buckets[low] as usize] = u64::from(high) << 32 | (3 * t + k) as u64;
                buckets[low] += 1;
            }
        }
    }
    // Every start has moved to the end of its bucket. Within a bucket by the higher end, then by number.
    let mut start = 0;
    for (low, &end) in buckets[..count].iter().enumerate() {
        let bucket = &mut keyed[start as usize..end as usize];
        start = end;
        bucket.sort_unstable();
        for edge in bucket.chunk_by(|one, other| one >> 32 == other >> 32) {
            slice.note_edge(triangles, [first + low as u32, (edge[0] >> 32) as u32], edge, opposites);
        }
    }
    slice
}

impl Topology {
    fn note_edge(&mut self, triangles: &[[u32; 3]], ends: [u32; 2], edge: &[u64], opposites: &[AtomicU32]) {
        self.edges += 1;
        let note = |fault: &mut Option<EdgeFault>| {
            fault.get_or_insert(EdgeFault { count: 0, first: ends }).count += 1;
        };
        match *edge {
            [only] => {
                note(&mut self.boundary);
                self.border.push(only as u32);
            }
            [one, other] => {
                let (one, other) = (one as u32, other as u32);
                if half_edge_ends(triangles, one)[0] == half_edge_ends(triangles, other)[0] {
                    note(&mut self.inconsistent);
                }
                opposites[one as usize].store(other, Ordering::Relaxed);
                opposites[other as usize].store(one, Ordering::Relaxed);
            }
            _ => {
                note(&mut self.non_manifold);
                self.crowds.extend(edge.windows(2).map(|pair| [pair[0] as u32, pair[1] as u32]));
            }
        }
        if edge.len() > 1 {
            self.duplicates += duplicates(triangles, ends, edge);
        }
    }
}

/// Triangles at an edge with the same third vertex as an earlier one, counted at the edge of their two lowest vertices.
fn duplicates(triangles: &[[u32; 3]], ends: [u32; 2], edge: &[u64]) -> usize {
    let third = |half_edge: u64| {
        let half_edge = half_edge as u32 as usize;
        triangles[half_edge / 3][(half_edge + 2) % 3]
    };
    if let [one, other] = *edge {
        return usize::from(third(one) == third(other) && third(one) > ends[1]);
    }
    let mut thirds: Vec<u32> =
        edge.iter().map(|&half_edge| third(half_edge)).filter(|&third| third > ends[1]).collect();
    thirds.sort_unstable();
    thirds.windows(2).filter(|pair| pair[0] == pair[1]).count()
}
