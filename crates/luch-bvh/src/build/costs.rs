//! Which descendants of a binary node become the eight children of a wide one.
//!
//! Ylitie, Karras, Laine, "Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs" (2017): the least cost of
//! turning the tree under a node into a forest of at most so many wide trees follows from that of its two children. The
//! cost is the sum of the areas of all wide nodes; that of leaves is the same however they are gathered.

use super::binary::Binary;
use super::collapse::Children;

/// Children of a wide node.
const WIDTH: usize = 8;

/// Of each binary node the least cost of a forest of at most 1, 2, … 7 wide trees; the eighth is not used.
pub(super) struct Costs(Vec<[f32; WIDTH]>);

impl Costs {
    pub(super) fn of(tree: &Binary) -> Self {
        let mut costs = vec![[0.0; WIDTH]; tree.nodes.len()];
        for (place, node) in tree.nodes.iter().enumerate().rev() {
            if node.is_leaf() {
                continue;
            }
            let left = node.index() as usize;
            let children = [&costs[left], &costs[left + 1]];
            let mut best = [0.0; WIDTH];
            best[0] = tree.scale.half_area(&node.bounds()) + shared(children, WIDTH).cost;
            for trees in 2..WIDTH {
                let cost = shared(children, trees).cost;
                best[trees - 1] = if cost < best[trees - 2] { cost } else { best[trees - 2] };
            }
            costs[place] = best;
        }
        Self(costs)
    }

    /// Replaces the only child in the list by up to eight descendants: those of the least cost.
    pub(super) fn open(&self, tree: &Binary, children: &mut Children) {
        let mut shares = [WIDTH; WIDTH];
        let mut place = 0;
        while place < children.as_slice().len() {
            let node = children.as_slice()[place] as usize;
            let share = shares[place];
            let binary = &tree.nodes[node];
            // Only the node to be opened has a share of all eight.
            if !binary.is_leaf() && share > 1 {
                let left = binary.index();
                let split = shared([&self.0[left as usize], &self.0[left as usize + 1]], share);
                if share == WIDTH || split.cost < self.0[node][share - 2] {
                    shares[children.as_slice().len()] = share - split.left;
                    shares[place] = split.left;
                    children.replace(place, left);
                } else {
                    shares[place] = share - 1;
                }
            } else {
                place += 1;
            }
        }
    }
}

/// How many of some wide trees go to the left child.
struct Shared {
    cost: f32,
    left: usize,
}

/// The best way to share `trees` between two children; the first of equals.
#[inline(always)]
fn shared(costs: [&[f32; WIDTH]; 2], trees: usize) -> Shared {
    let mut best = Shared { cost: f32::INFINITY, left: 1 };
    for left in 1..trees {
        let cost = costs[0][left - 1] + costs[1][trees - left - 1];
        if cost < best.cost {
            best = Shared { cost, left };
        }
    }
    best
}
