//! All ways a surface can run through a cell, made by code.
//!
//! The signs of the corners give 256 cases. A face whose signs alternate leaves open which two corners are joined over it;
//! each answer is a variant of the case (the asymptotic decider of Nielson and Hamann, "The Asymptotic Decider", 1991, gives
//! it). On the faces the surface then has loops. Each loop is filled by a disc; two loops may instead bound one tube (Chernyaev,
//! "Marching Cubes 33", 1995), for which [`Variant::tubes`] holds the condition.
//!
//! The surface is a manifold in every case: vertices lie on the cell's edges, one on each crossed edge, and inner edges
//! never join two vertices of one face, so that no neighbour has the same edge.

use std::sync::LazyLock;

use super::cell::{
    CORNERS, EDGES, FACES, edge_between, edge_corners, edge_middle, face_corners, faces_of_edge,
};

/// The number that stands for a vertex in the middle of a loop, in [`Variant::triangles`].
pub(super) const CENTRE: u8 = EDGES as u8;

/// One way of running through a cell.
#[derive(Clone, Debug, Default)]
pub(super) struct Variant {
    /// Crossed edges in order round each loop, the surface to the left seen from the outer side.
    pub(super) loops: Vec<Vec<u8>>,
    /// Corners as numbers of edges, or [`CENTRE`]; counter-clockwise seen from the outer side.
    pub(super) triangles: Vec<[u8; 3]>,
    /// The edges round [`CENTRE`], if there is one.
    pub(super) centre_of: Vec<u8>,
    /// Two loops that may be joined through the inside.
    pub(super) tubes: Vec<Tube>,
    /// Faces, as bits, both of whose segments belong to one loop.
    pub(super) twice_crossed: u8,
}

/// Two loops joined.
#[derive(Clone, Debug)]
pub(super) struct Tube {
    /// If these two corners are joined inside the cell, the tube is there.
    pub(super) corners: [u8; 2],
    /// All triangles of the cell then.
    pub(super) triangles: Vec<[u8; 3]>,
    /// The edges round [`CENTRE`], if there is one.
    pub(super) centre_of: Vec<u8>,
}

/// The variants of one pattern of signs.
#[derive(Clone, Debug)]
pub(super) struct Case {
    /// Faces whose signs alternate; face `n` of this list decides bit `n` of the variant's number.
    pub(super) open_faces: Vec<u8>,
    /// Bit set: the inner corners are joined over the face.
    pub(super) variants: Vec<Variant>,
}

/// Every pattern of signs; bit `c` of the place is set if corner `c` is inside.
pub(super) struct Cases {
    /// By pattern.
    pub(super) all: Vec<Case>,
    /// The triangles of patterns with nothing to decide, one after another.
    pub(super) triangles: Vec<[u8; 3]>,
    /// Where those of each pattern begin, and the end of the last.
    pub(super) starts: [u16; 257],
    /// Whether there is something to decide.
    pub(super) is_open: [bool; 256],
}

/// The one table.
pub(super) static CASES: LazyLock<Cases> = LazyLock::new(Cases::new);

impl Cases {
    fn new() -> Self {
        let all: Vec<Case> = (0..256).map(|signs| Case::new(signs as u8)).collect();
        let mut table = Self { all, triangles: Vec::new(), starts: [0; 257], is_open: [false; 256] };
        for signs in 0..256 {
            let case = &table.all[signs];
            let only = &case.variants[0];
            table.is_open[signs] =
                case.variants.len() > 1 || !only.tubes.is_empty() || !only.centre_of.is_empty();
            if !table.is_open[signs] {
                table.triangles.extend(&only.triangles);
            }
            table.starts[signs + 1] = table.triangles.len() as u16;
        }
        table
    }
}

impl Case {
    fn new(signs: u8) -> Self {
        let inside = |corner: usize| signs >> corner & 1 == 1;
        let alternates = |face: &usize| {
            let [a, b, c, d] = face_corners(*face).map(inside);
            a == c && b == d && a != b
        };
        let open_faces: Vec<u8> = (0..FACES).filter(alternates).map(|face| face as u8).collect();
        let variants = (0..1usize << open_faces.len())
            .map(|decisions| {
                let joined = (0..open_faces.len())
                    .filter(|n| decisions >> n & 1 == 1)
                    .fold(0u8, |bits, n| bits | 1 << open_faces[n]);
                Variant::new(signs, joined)
            })
            .collect();
        Self { open_faces, variants }
    }
}

impl Variant {
    /// `joined` are the faces, as bits, over which inner corners are joined.
    fn new(signs: u8, joined: u8) -> Self {
        let segments = Segments::new(signs, joined);
        let loops = segments.loops();
        let twice_crossed = (0..FACES as u8)
            .filter(|face| {
                let on_face = |round: &&Vec<u8>| {
                    round.iter().filter(|&&edge| faces_of_edge(edge as usize) >> face & 1 == 1).count() == 4
                };
                loops.iter().any(|round| on_face(&round))
            })
            .fold(0, |bits, face| bits | 1 << face);
        let mut variant = Self { twice_crossed, ..Self::default() };
        for round in &loops {
            fill_disc(round, &mut variant.triangles, &mut variant.centre_of);
        }
        variant.tubes = tubes(signs, joined, &loops);
        variant.loops = loops;
        variant
    }
}

/// Where the surface meets the faces: from each crossed edge to the next, the inside on the left seen from outside the cell.
struct Segments {
    next: [Option<u8>; EDGES],
}

impl Segments {
    fn new(signs: u8, joined: u8) -> Self {
        let inside = |corner: usize| signs >> corner & 1 == 1;
        let mut next = [None; EDGES];
        for face in 0..FACES {
            let corners = face_corners(face);
            for n in 0..4 {
                let [a, b] = [corners[n], corners[(n + 1) % 4]];
                if inside(a) || !inside(b) {
                    continue;
                }
                // The border of the face enters the inside here. The segment ends where it leaves the inside: after the
                // corners that follow, or, if the inside is joined over the face, before the corner that lies outside.
                let alternates = inside(corners[(n + 3) % 4]) && !inside(corners[(n + 2) % 4]);
                let steps = if alternates && joined >> face & 1 == 1 {
                    3
                } else {
                    (1..4).find(|step| !inside(corners[(n + 1 + step) % 4])).unwrap_or(3)
                };
                let [from, to] = [corners[(n + steps) % 4], corners[(n + steps + 1) % 4]];
                next[edge_between(a, b)] = Some(edge_between(from, to) as u8);
            }
        }
        Self { next }
    }

    fn loops(&self) -> Vec<Vec<u8>> {
        let mut loops = Vec::new();
        let mut seen = [false; EDGES];
        for start in 0..EDGES {
            if seen[start] || self.next[start].is_none() {
                continue;
            }
            let mut round = Vec::new();
            let mut edge = start;
            while !seen[edge] {
                seen[edge] = true;
                round.push(edge as u8);
                edge = self.next[edge].map_or(start, usize::from);
            }
            loops.push(round);
        }
        loops
    }
}

/// Whether a line between the vertices of two edges runs through the inside of the cell.
fn is_inner(one: u8, other: u8) -> bool {
    faces_of_edge(one as usize) & faces_of_edge(other as usize) == 0
}

/// Square of the distance of two edges' middles.
fn distance(one: u8, other: u8) -> i32 {
    let [a, b] = [one, other].map(|edge| edge_middle(edge as usize));
    (0..3).map(|axis| (a[axis] - b[axis]) * (a[axis] - b[axis])).sum()
}

/// Fills a loop by inner edges of least length; where none fit, by a fan about a vertex in its middle.
fn fill_disc(round: &[u8], triangles: &mut Vec<[u8; 3]>, centre_of: &mut Vec<u8>) {
    const NEVER: i32 = i32::MAX / 4;
    let n = round.len();
    // Klincsek's dynamic programme: the cheapest filling of each run of the loop.
    let mut cost = vec![[0i32; EDGES]; n];
    let mut split = vec![[0usize; EDGES]; n];
    let side = |a: usize, b: usize| {
        if b - a == 1 || (a == 0 && b == n - 1) {
            0
        } else if is_inner(round[a], round[b]) {
            distance(round[a], round[b])
        } else {
            NEVER
        }
    };
    for width in 2..n {
        for a in 0..n - width {
            let b = a + width;
            let (best, middle) = (a + 1..b)
                .map(|middle| (cost[a][middle] + cost[middle][b], middle))
                .min()
                .unwrap_or((NEVER, a + 1));
            cost[a][b] = best.saturating_add(side(a, b)).min(NEVER);
            split[a][b] = middle;
        }
    }
    if cost[0][n - 1] >= NEVER {
        debug_assert!(centre_of.is_empty(), "two loops of a cell need a middle");
        centre_of.extend(round);
        triangles.extend((0..n).map(|k| [round[k], round[(k + 1) % n], CENTRE]));
        return;
    }
    let mut runs = vec![(0, n - 1)];
    while let Some((a, b)) = runs.pop() {
        if b - a >= 2 {
            let middle = split[a][b];
            triangles.push([round[a], round[middle], round[b]]);
            runs.extend([(a, middle), (middle, b)]);
        }
    }
}

/// All pairs of loops that bound a region of the cell's surface together, and the tube between them.
fn tubes(signs: u8, joined: u8, loops: &[Vec<u8>]) -> Vec<Tube> {
    let regions = surface_regions(signs, joined);
    let ends = |round: &[u8]| {
        let [a, b] = edge_corners(round[0] as usize);
        if signs >> a & 1 == 1 { [a, b] } else { [b, a] }
    };
    let mut tubes = Vec::new();
    for (n, one) in loops.iter().enumerate() {
        for (m, other) in loops.iter().enumerate().take(n) {
            for side in 0..2 {
                // The region between them lies on the other side, so that these two regions are apart on the surface.
                let [a, b] = [ends(one)[side], ends(other)[side]];
                let [shared, shared_too] = [ends(one)[1 - side], ends(other)[1 - side]];
                if regions[shared] != regions[shared_too] {
                    continue;
                }
                let Some(mut triangles) = fill_tube(one, other) else { continue };
                let mut centre_of = Vec::new();
                for (k, round) in loops.iter().enumerate() {
                    if k != n && k != m {
                        fill_disc(round, &mut triangles, &mut centre_of);
                    }
                }
                tubes.push(Tube { corners: [a as u8, b as u8], triangles, centre_of });
            }
        }
    }
    tubes
}

/// For each corner the least corner of equal sign that is joined to it on the cell's surface.
fn surface_regions(signs: u8, joined: u8) -> [usize; CORNERS] {
    let inside = |corner: usize| signs >> corner & 1 == 1;
    let mut region: [usize; CORNERS] = std::array::from_fn(|corner| corner);
    let mut join = |a: usize, b: usize| {
        let [low, high] = [region[a].min(region[b]), region[a].max(region[b])];
        for place in &mut region {
            if *place == high {
                *place = low;
            }
        }
    };
    for edge in 0..EDGES {
        let [a, b] = edge_corners(edge);
        if inside(a) == inside(b) {
            join(a, b);
        }
    }
    for face in 0..FACES {
        let [a, b, c, d] = face_corners(face);
        if inside(a) == inside(c) && inside(b) == inside(d) && inside(a) != inside(b) {
            let inner_joined = joined >> face & 1 == 1;
            if inside(a) == inner_joined { join(a, c) } else { join(b, d) }
        }
    }
    region
}

/// The band of least length between two loops, by inner edges only.
fn fill_tube(one: &[u8], other: &[u8]) -> Option<Vec<[u8; 3]>> {
    // Seen along the tube one loop turns one way and the second the other.
    let back: Vec<u8> = other.iter().rev().copied().collect();
    let (n, m) = (one.len(), back.len());
    let mut best: Option<(i32, Vec<[u8; 3]>)> = None;
    for shift in 0..m {
        let a = |i: usize| one[i % n];
        let b = |j: usize| back[(j + shift) % m];
        // The cheapest way from the rung (0, 0) to (n, m); a rung must be inner, and none may come twice.
        let rung = |i: usize, j: usize| {
            let turned = (i == n && j < m) || (j == m && i < n);
            let again = turned && ((i == n && j == 0) || (j == m && i == 0));
            (is_inner(a(i), b(j)) && !again).then(|| distance(a(i), b(j)))
        };
        let mut cost = vec![vec![None::<i32>; m + 1]; n + 1];
        cost[0][0] = rung(0, 0).map(|_| 0);
        for i in 0..=n {
            for j in 0..=m {
                if i + j > 0 {
                    let before = [
                        i.checked_sub(1).and_then(|i| cost[i][j]),
                        j.checked_sub(1).and_then(|j| cost[i][j]),
                    ];
                    let least = before.into_iter().flatten().min();
                    cost[i][j] = least.and_then(|least| Some(least + rung(i, j)?));
                }
            }
        }
        let Some(total) = cost[n][m] else { continue };
        if best.as_ref().is_some_and(|(least, _)| *least <= total) {
            continue;
        }
        // Back from the end, a triangle a step.
        let mut triangles = Vec::with_capacity(n + m);
        let mut rungs = Vec::new();
        let (mut i, mut j) = (n, m);
        while i + j > 0 {
            rungs.push((a(i), b(j)));
            let by_one = i.checked_sub(1).and_then(|i| cost[i][j]);
            let by_other = j.checked_sub(1).and_then(|j| cost[i][j]);
            if by_one.is_some() && (by_other.is_none() || by_one <= by_other) {
                triangles.push([a(i - 1), a(i), b(j)]);
                i -= 1;
            } else {
                triangles.push([b(j), b(j - 1), a(i)]);
                j -= 1;
            }
        }
        rungs.sort_unstable();
        if rungs.windows(2).all(|pair| pair[0] != pair[1]) {
            best = Some((total, triangles));
        }
    }
    best.map(|(_, triangles)| triangles)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_variant_is_a_surface_whose_border_are_its_segments() {
        for (signs, case) in CASES.all.iter().enumerate() {
            for (decisions, variant) in case.variants.iter().enumerate() {
                let joined = (0..case.open_faces.len())
                    .filter(|n| decisions >> n & 1 == 1)
                    .fold(0u8, |bits, n| bits | 1 << case.open_faces[n]);
                let mut border: Vec<[u8; 2]> = Segments::new(signs as u8, joined)
                    .next
                    .iter()
                    .enumerate()
                    .filter_map(|(edge, next)| Some([edge as u8, (*next)?]))
                    .collect();
                border.sort_unstable();
                check(&variant.triangles, &border);
                for tube in &variant.tubes {
                    check(&tube.triangles, &border);
                    let euler = |triangles: &[[u8; 3]]| {
                        let mut vertices = triangles.as_flattened().to_vec();
                        vertices.sort_unstable();
                        vertices.dedup();
                        let half_edges = triangles.len() * 3;
                        vertices.len() as i64 - ((half_edges + border.len()) / 2) as i64
                            + triangles.len() as i64
                    };
                    assert_eq!(euler(&variant.triangles), variant.loops.len() as i64);
                    assert_eq!(euler(&tube.triangles), variant.loops.len() as i64 - 2);
                }
            }
        }
    }

    /// Half-edges without a partner are the border; inner edges have two and lie on no face.
    fn check(triangles: &[[u8; 3]], border: &[[u8; 2]]) {
        let mut half_edges: Vec<[u8; 2]> =
            triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]).collect();
        half_edges.sort_unstable();
        assert!(half_edges.windows(2).all(|pair| pair[0] != pair[1]), "{triangles:?}");
        let alone: Vec<[u8; 2]> =
            half_edges.iter().copied().filter(|&[a, b]| half_edges.binary_search(&[b, a]).is_err()).collect();
        assert_eq!(alone, border, "{triangles:?}");
        for &[a, b] in &half_edges {
            let inner = half_edges.binary_search(&[b, a]).is_ok();
            assert!(!inner || a == CENTRE || b == CENTRE || is_inner(a, b));
        }
    }

    #[test]
    fn one_corner_gives_one_triangle_that_faces_away() {
        let case = &CASES.all[1];
        assert_eq!(case.variants.len(), 1);
        let triangle = case.variants[0].triangles[0];
        let start = triangle.iter().position(|&edge| edge == 0).unwrap();
        assert_eq!([0, 1, 2].map(|k| triangle[(start + k) % 3]), [0, 4, 8]);
    }

    #[test]
    fn the_table_holds_the_known_numbers() {
        // Two patterns have no surface, and the two with all six faces open have 64 variants each.
        assert_eq!(CASES.all.iter().filter(|case| case.variants[0].loops.is_empty()).count(), 2);
        assert_eq!(CASES.all.iter().filter(|case| case.variants.len() == 64).count(), 2);
        let opposite = &CASES.all[0b1000_0001];
        assert_eq!(opposite.variants[0].loops.len(), 2);
        assert_eq!(opposite.variants[0].tubes[0].triangles.len(), 6);
    }
}
