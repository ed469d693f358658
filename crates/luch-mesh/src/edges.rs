//! The edges of a mesh with the triangles that use them, found by sorting: no hash order reaches a result.

/// All half-edges of a triangle list, those of the same edge side by side.
///
/// Half-edge `3 t + k` runs from corner `k` of triangle `t` to corner `k + 1`.
#[derive(Clone, Debug, Default)]
pub struct Edges {
    /// Half-edge numbers, sorted by lower end, higher end, number.
    half_edges: Vec<u32>,
    /// Where each edge begins in `half_edges`, and the end of the last.
    starts: Vec<u32>,
}

/// One edge and its half-edges.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Edge<'a> {
    /// The lower and the higher end.
    pub vertices: [u32; 2],
    /// The half-edges along it, rising.
    pub half_edges: &'a [u32],
}

impl Edges {
    /// Sorts the half-edges of triangles whose indices are below `vertex_count`; time O(n log m) with m the highest
    /// number of edges at a vertex. Half-edges from a vertex to itself are left out.
    pub fn new(triangles: &[[u32; 3]], vertex_count: usize) -> Self {
        Self::from_ends(triangles.len() * 3, vertex_count, |half_edge| half_edge_ends(triangles, half_edge))
    }

    /// The same for any half-edges, numbered below `count`, whose start and end `ends_of` tells.
    pub fn from_ends(count: usize, vertex_count: usize, ends_of: impl Fn(u32) -> [u32; 2]) -> Self {
        // Counting sort by the lower end.
        let ends = |half_edge: usize| {
            let [from, to] = ends_of(half_edge as u32);
            [from.min(to), from.max(to)]
        };
        let mut buckets = vec![0u32; vertex_count + 1];
        for half_edge in 0..count {
            let [low, high] = ends(half_edge);
            // A half-edge to itself may be at a vertex that is not there.
            if low != high {
                buckets[low as usize + 1] += 1;
            }
        }
        for vertex in 0..vertex_count {
            buckets[vertex + 1] += buckets[vertex];
        }
        let total = buckets[vertex_count] as usize;
        let mut next = buckets.clone();
        let mut keyed = vec![0u64; total];
        for half_edge in 0..count {
            let [low, high] = ends(half_edge);
            if low != high {
                let place = &mut next[low as usize];
                keyed[*place as usize] = u64::from(high) << 32 | half_edge as u64;
                *place += 1;
            }
        }
        // Within a bucket by the higher end, then by number.
        let mut edges = Self { half_edges: Vec::with_capacity(total), starts: Vec::new() };
        for bucket in buckets.windows(2) {
            let bucket = &mut keyed[bucket[0] as usize..bucket[1] as usize];
            bucket.sort_unstable();
            let mut previous = None;
            for &key in bucket.iter() {
                if previous != Some(key >> 32) {
                    edges.starts.push(edges.half_edges.len() as u32);
                    previous = Some(key >> 32);
                }
                edges.half_edges.push(key as u32);
            }
        }
        edges.starts.push(edges.half_edges.len() as u32);
        edges
    }

    /// How many edges there are.
    pub fn len(&self) -> usize {
        self.starts.len().saturating_sub(1)
    }

    /// True if there is no edge.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The edges, rising by lower end, then higher end. `triangles` must be the list given to [`Edges::new`].
    pub fn iter<'a>(&'a self, triangles: &'a [[u32; 3]]) -> impl Iterator<Item = Edge<'a>> {
        self.iter_ends(|half_edge| half_edge_ends(triangles, half_edge))
    }

    /// The same for any half-edges; `ends_of` must be what was given to [`Edges::from_ends`].
    pub fn iter_ends<'a>(&'a self, ends_of: impl Fn(u32) -> [u32; 2] + 'a) -> impl Iterator<Item = Edge<'a>> {
        self.starts.windows(2).map(move |range| {
            let half_edges = &self.half_edges[range[0] as usize..range[1] as usize];
            let [from, to] = ends_of(half_edges[0]);
            Edge { vertices: [from.min(to), from.max(to)], half_edges }
        })
    }
}

/// Start and end vertex of a half-edge.
pub fn half_edge_ends(triangles: &[[u32; 3]], half_edge: u32) -> [u32; 2] {
    let corners = triangles[half_edge as usize / 3];
    let corner = half_edge as usize % 3;
    [corners[corner], corners[(corner + 1) % 3]]
}

/// The corner `3 t + k` of the half-edge's triangle that lies at `vertex`, one of its ends.
pub fn corner_at(triangles: &[[u32; 3]], half_edge: u32, vertex: u32) -> u32 {
    if half_edge_ends(triangles, half_edge)[0] == vertex {
        return half_edge;
    }
    half_edge / 3 * 3 + (half_edge % 3 + 1) % 3
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_triangles_share_one_edge() {
        let triangles = [[0, 1, 2], [2, 1, 3]];
        let edges = Edges::new(&triangles, 4);
        let list: Vec<_> = edges.iter(&triangles).collect();
        assert_eq!(edges.len(), 5);
        assert_eq!(list[2], Edge { vertices: [1, 2], half_edges: &[1, 3] });
        assert!(list.windows(2).all(|pair| pair[0].vertices < pair[1].vertices));
    }

    #[test]
    fn a_repeated_corner_gives_no_edge_to_itself() {
        let edges = Edges::new(&[[0, 0, 1]], 2);
        assert_eq!(edges.len(), 1);
    }
}
