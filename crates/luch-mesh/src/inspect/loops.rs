//! The borders of an open mesh.

use glam::Vec3;

use crate::edges::half_edge_ends;

/// Closed runs of border edges.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Loops {
    pub(super) count: usize,
    /// Edges of the loop with most of them.
    pub(super) most_edges: usize,
    /// Length of the longest loop.
    pub(super) longest: f64,
}

/// Follows the border half-edges, given rising. Where several meet in a vertex the lowest is taken first. Runs that do not
/// close, which only faces of opposed winding make, count as loops too.
pub(super) fn loops(positions: &[Vec3], triangles: &[[u32; 3]], border: &[u32]) -> Loops {
    let mut from: Vec<(u32, u32)> =
        border.iter().map(|&edge| (half_edge_ends(triangles, edge)[0], edge)).collect();
    from.sort_unstable();
    // For each entry the first of its vertex that may still be free.
    let mut is_used = vec![false; from.len()];
    let mut next_free: Vec<usize> = (0..from.len()).collect();
    let mut loops = Loops::default();
    for start in 0..from.len() {
        if is_used[start] {
            continue;
        }
        let (mut edges, mut length) = (0, 0.0);
        let mut at = start;
        loop {
            is_used[at] = true;
            let [begin, end] = half_edge_ends(triangles, from[at].1);
            edges += 1;
            length += positions[begin as usize].as_dvec3().distance(positions[end as usize].as_dvec3());
            let first = from.partition_point(|&(vertex, _)| vertex < end);
            let Some(mut place) = next_free.get(first).copied() else { break };
            while place < from.len() && from[place].0 == end && is_used[place] {
                place += 1;
            }
            next_free[first] = place;
            if place >= from.len() || from[place].0 != end {
                break;
            }
            at = place;
        }
        loops.count += 1;
        loops.most_edges = loops.most_edges.max(edges);
        loops.longest = loops.longest.max(length);
    }
    loops
}
