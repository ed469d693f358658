//! A tree that may be walked: its references are known to lead somewhere, its depth is known to have an end.

use crate::Aabb;
use crate::wide::{EMPTY, LEAF, MAX_WIDE_DEPTH, Wide, WideNode};
use glam::Vec3;

/// The nodes of a wide tree. What belongs to leaf `k` its owner keeps at place `k` of a list of their own.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Tree {
    nodes: Vec<WideNode>,
    root: u32,
    leaves: usize,
    depth: usize,
    bounds: Aabb,
}

impl Tree {
    /// Takes over the nodes of a finished build.
    ///
    /// # Panics
    ///
    /// If a reference leads nowhere or backward, or a way from the root is too long: the kernels rely on neither being so.
    pub(crate) fn new(wide: Wide) -> Self {
        let Wide { nodes, leaves, root, bounds } = wide;
        let leads = |reference: u32, after: usize| match reference {
            EMPTY => true,
            leaf if leaf & LEAF != 0 => ((leaf & !LEAF) as usize) < leaves.len(),
            node => (after..nodes.len()).contains(&(node as usize)),
        };
        assert!(leads(root, 0), "the root is not in the tree");
        // Nodes stand behind their parents, so one pass knows the depth of all.
        let mut depths = vec![1_u8; nodes.len()];
        for (index, node) in nodes.iter().enumerate() {
            for child in node.children {
                assert!(leads(child, index + 1), "node {index} leads nowhere");
                if child & LEAF == 0 && child != EMPTY {
                    depths[child as usize] = depths[index] + 1;
                }
            }
            assert!(usize::from(depths[index]) <= MAX_WIDE_DEPTH, "the tree is too deep");
        }
        let depth = depths.iter().max().map_or(0, |depth| usize::from(*depth));
        Self { root, leaves: leaves.len(), depth, bounds, nodes }
    }

    /// Every reference in here is [`EMPTY`], or a node behind its parent, or a leaf below [`Tree::leaves`].
    #[inline(always)]
    pub(crate) fn nodes(&self) -> &[WideNode] {
        &self.nodes
    }

    /// Reference of the root; [`EMPTY`] for a tree over nothing.
    #[inline(always)]
    pub(crate) fn root(&self) -> u32 {
        self.root
    }

    /// How many leaves there are.
    #[inline(always)]
    pub(crate) fn leaves(&self) -> usize {
        self.leaves
    }

    /// The box of everything.
    pub(crate) fn bounds(&self) -> Aabb {
        self.bounds
    }

    /// Hands every leaf that may hold a point at or within the squared distance `bound` to `visit`, near ones first;
    /// `visit` returns the bound from now on.
    pub(crate) fn walk_near(&self, point: Vec3, bound: f32, mut visit: impl FnMut(usize, f32) -> f32) {
        let mut bound = bound;
        let mut waiting = vec![(self.root, self.bounds.distance_squared(point))];
        while let Some((reference, distance)) = waiting.pop() {
            if reference == EMPTY || distance > bound {
                continue;
            }
            if reference & LEAF != 0 {
                bound = visit((reference & !LEAF) as usize, bound);
                continue;
            }
            let node = &self.nodes[reference as usize];
            let first = waiting.len();
            for (place, child) in node.children.into_iter().enumerate().filter(|(_, child)| *child != EMPTY) {
                waiting.push((child, node.bounds(place).distance_squared(point)));
            }
            waiting[first..].sort_by(|a, b| b.1.total_cmp(&a.1));
        }
    }

    /// Measures the tree; `leaf_size` tells how many primitives a leaf has, `primitive_bytes` what the owner keeps.
    pub(crate) fn statistics(
        &self,
        leaf_size: impl Fn(usize) -> usize,
        primitive_bytes: usize,
    ) -> Statistics {
        let whole = self.bounds.half_area();
        let share = |bounds: &Aabb| if whole > 0.0 { bounds.half_area() / whole } else { 1.0 };
        let mut statistics = Statistics {
            nodes: self.nodes.len(),
            leaves: self.leaves,
            references: 0,
            children_per_node: 0.0,
            depth: self.depth,
            expected_nodes: 0.0,
            expected_leaves: 0.0,
            expected_cost: 0.0,
            memory_bytes: primitive_bytes + self.nodes.len() * size_of::<WideNode>(),
        };
        let mut count = |reference: u32, bounds: Aabb| match reference {
            EMPTY => {}
            leaf if leaf & LEAF != 0 => {
                let size = leaf_size((leaf & !LEAF) as usize);
                statistics.references += size;
                statistics.expected_leaves += share(&bounds);
                statistics.expected_cost += share(&bounds) * size as f64;
            }
            _ => {
                statistics.expected_nodes += share(&bounds);
                statistics.expected_cost += share(&bounds);
            }
        };
        count(self.root, self.bounds);
        let mut children = 0;
        for node in &self.nodes {
            for (place, child) in node.children.into_iter().enumerate() {
                children += usize::from(child != EMPTY);
                count(child, node.bounds(place));
            }
        }
        statistics.children_per_node = children as f64 / self.nodes.len().max(1) as f64;
        statistics
    }
}

/// The size and worth of a tree.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Statistics {
    /// Inner nodes, of up to eight children each.
    pub nodes: usize,
    /// Leaves, of up to four primitives each.
    pub leaves: usize,
    /// Primitives in all leaves together. More than there are primitives where spatial splits put some into several.
    pub references: usize,
    /// Children of an inner node, on average.
    pub children_per_node: f64,
    /// Inner nodes on the longest way from the root to a leaf; 0 for a single leaf.
    pub depth: usize,
    /// Inner nodes that a random ray through the whole box is expected to visit, by the surface area heuristic.
    pub expected_nodes: f64,
    /// Leaves that it is expected to visit.
    pub expected_leaves: f64,
    /// What a random ray through the whole box is expected to cost by the surface area heuristic: node visits plus
    /// primitive tests, one each.
    pub expected_cost: f64,
    /// Bytes of nodes and packed primitives.
    pub memory_bytes: usize,
}
