//! The tree of bounded lights: one of them is picked about in proportion to the light it sends.
//!
//! Conty Estevez and Kulla, "Importance Sampling of Many Lights with Adaptive Tree Splitting" (2018), with eight children a node:
//! up to eight lights are weighed exactly, 400 take three steps. One light is picked for each receiver; splitting, that is several
//! lights for groups that are near, would go where [`LightTree::step`] takes a child.

use super::bounds::LightBounds;
use super::build::{Leaf, nodes};
use super::node::{LEAF, Node, PickedLane, Shares};
use glam::Vec3;

/// Bits of a trail for each step.
const STEP: u32 = 3;

/// Trail of an emitter that is not in the tree.
const NOWHERE: u64 = u64::MAX;

/// A tree over at least one light.
#[derive(Debug)]
pub(crate) struct LightTree {
    nodes: Vec<Node>,
    /// For each emitter the children to take from the root, three bits each from the lowest.
    trails: Vec<u64>,
    /// Nodes are in coordinates of the size of the lights' extent: no distance overflows when squared.
    origin: Vec3,
    scale: f32,
    /// Irradiance of a unit of importance.
    unit: f64,
}

/// On the way down to a light.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Descent {
    from: Vec3,
    normal: Vec3,
    /// A node, or an emitter at the end.
    child: u32,
    /// What is left of the number that chooses.
    rest: f64,
    /// Of the way so far.
    pub(crate) probability: f64,
}

impl Descent {
    /// The emitter, at the end of the way.
    #[inline(always)]
    pub(crate) fn emitter(&self) -> Option<u32> {
        (self.child & LEAF != 0).then_some(self.child & !LEAF)
    }
}

impl LightTree {
    /// A tree over what is usable of the emitters' bounds; `None` if nothing is.
    pub(crate) fn new(bounds: &[Option<LightBounds>]) -> Option<Self> {
        let mut leaves: Vec<Leaf> = bounds
            .iter()
            .enumerate()
            .filter_map(|(emitter, bounds)| {
                let bounds = bounds.filter(LightBounds::is_usable)?;
                Some(Leaf { bounds, emitter: emitter as u32 })
            })
            .collect();
        let total: f64 = leaves.iter().map(|leaf| f64::from(leaf.bounds.intensity)).sum();
        let (mut low, mut high) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
        for Leaf { bounds, .. } in &leaves {
            low = low.min(bounds.center - bounds.radius);
            high = high.max(bounds.center + bounds.radius);
        }
        let (low, high) = (low.max(Vec3::MIN), high.min(Vec3::MAX));
        let origin = low / 2.0 + high / 2.0;
        let size = (high / 2.0 - low / 2.0).max_element();
        let scale = 1.0 / if size > 0.0 { size.clamp(1e-30, 1e30) } else { 1.0 };
        for Leaf { bounds, .. } in &mut leaves {
            bounds.center = (bounds.center - origin) * scale;
            bounds.radius *= scale;
            // However weak beside the others, a light stays in reach.
            bounds.intensity = (f64::from(bounds.intensity) / total).max(1e-12) as f32;
        }
        let nodes = (!leaves.is_empty()).then(|| nodes(&mut leaves, 0))?;
        let mut tree = Self {
            trails: vec![NOWHERE; bounds.len()],
            nodes,
            origin,
            scale,
            unit: total * f64::from(scale) * f64::from(scale),
        };
        tree.lay_trails();
        Some(tree)
    }

    fn lay_trails(&mut self) {
        let mut open = vec![(0u32, 0u64, 0u32)];
        while let Some((node, trail, shift)) = open.pop() {
            let node = &self.nodes[node as usize];
            for lane in node.used() {
                let (child, trail) = (node.children[lane], trail | (lane as u64) << shift);
                match child & LEAF != 0 {
                    true => self.trails[(child & !LEAF) as usize] = trail,
                    false => open.push((child, trail, shift + STEP)),
                }
            }
        }
    }

    #[inline(always)]
    fn local(&self, from: Vec3) -> Vec3 {
        (from - self.origin) * self.scale
    }

    /// The chances at the root.
    #[inline(always)]
    pub(crate) fn root(&self, from: Vec3, normal: Vec3) -> Shares {
        Shares::new(self.nodes[0].importances(self.local(from), normal))
    }

    /// About the irradiance of all lights, from the chances at the root.
    #[inline(always)]
    pub(crate) fn irradiance(&self, root: &Shares) -> f64 {
        root.total() * self.unit
    }

    /// The first step down, by a number in [0, 1); `None` if no light arrives.
    #[inline(always)]
    pub(crate) fn start(&self, root: Shares, from: Vec3, normal: Vec3, choice: f64) -> Option<Descent> {
        let PickedLane { lane, probability, rest } = root.pick(choice)?;
        let child = self.nodes[0].children[lane];
        Some(Descent { from: self.local(from), normal, child, rest, probability })
    }

    /// A step down from a node; `None` if no light arrives from there after all.
    #[inline(always)]
    pub(crate) fn step(&self, descent: Descent) -> Option<Descent> {
        let node = &self.nodes[descent.child as usize];
        let picked = Shares::new(node.importances(descent.from, descent.normal)).pick(descent.rest)?;
        let probability = descent.probability * picked.probability;
        Some(Descent { child: node.children[picked.lane], rest: picked.rest, probability, ..descent })
    }

    /// The chance with which a descent ends at an emitter.
    #[inline(always)]
    pub(crate) fn probability(&self, root: Shares, emitter: u32, from: Vec3, normal: Vec3) -> f64 {
        let mut trail = self.trails[emitter as usize];
        if trail == NOWHERE {
            return 0.0;
        }
        let from = self.local(from);
        let (mut node, mut shares, mut probability) = (&self.nodes[0], root, 1.0);
        loop {
            let lane = (trail & ((1 << STEP) - 1)) as usize;
            probability *= shares.probability(lane);
            let child = node.children[lane];
            if child & LEAF != 0 || probability == 0.0 {
                return probability;
            }
            trail >>= STEP;
            node = &self.nodes[child as usize];
            shares = Shares::new(node.importances(from, normal));
        }
    }
}
