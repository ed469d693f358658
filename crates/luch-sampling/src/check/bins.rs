//! Bins that hold about as many samples each: narrow where samples crowd.

use super::density_fit::Area;

/// Samples that a bin must have to be divided further.
const LEAST: usize = 16;

/// A rectangle divided again and again at the middle sample, across and along in turn (a k-d tree, Bentley 1975).
pub(super) struct Bins {
    nodes: Vec<Node>,
    pub(super) bins: Vec<Bin>,
}

/// A part of the rectangle.
pub(super) struct Bin {
    pub(super) area: Area,
    /// Where the samples lie that the division was made by.
    pub(super) crowded: Area,
}

enum Node {
    Split { axis: usize, at: f64, above: usize },
    Leaf(usize),
}

impl Bins {
    /// A division into at most `most` bins by these samples, which must not be those that are counted later.
    pub(super) fn new(area: Area, samples: &mut [[f64; 2]], most: usize) -> Self {
        let mut bins = Self { nodes: Vec::new(), bins: Vec::new() };
        bins.divide(area, samples, most.max(1).ilog2(), 0);
        bins
    }

    fn divide(&mut self, area: Area, samples: &mut [[f64; 2]], depth: u32, axis: usize) {
        if depth > 0 && samples.len() >= LEAST {
            for axis in [axis, 1 - axis] {
                let middle = samples.len() / 2;
                samples.sort_unstable_by(|a, b| a[axis].total_cmp(&b[axis]));
                let at = 0.5 * (samples[middle - 1][axis] + samples[middle][axis]);
                // Samples of one value cannot be parted.
                if !(samples[middle - 1][axis] < at && at <= samples[middle][axis]) {
                    continue;
                }
                let (mut low, mut high) = (area, area);
                low.high[axis] = at;
                high.low[axis] = at;
                let node = self.nodes.len();
                self.nodes.push(Node::Split { axis, at, above: 0 });
                let (left, right) = samples.split_at_mut(middle);
                self.divide(low, left, depth - 1, 1 - axis);
                let above = self.nodes.len();
                self.nodes[node] = Node::Split { axis, at, above };
                self.divide(high, right, depth - 1, 1 - axis);
                return;
            }
        }
        self.nodes.push(Node::Leaf(self.bins.len()));
        self.bins.push(Bin { area, crowded: Area::around(samples).unwrap_or(area) });
    }

    /// The bin of a place.
    pub(super) fn find(&self, place: [f64; 2]) -> usize {
        let mut node = 0;
        loop {
            match self.nodes[node] {
                Node::Leaf(bin) => return bin,
                Node::Split { axis, at, above } => node = if place[axis] < at { node + 1 } else { above },
            }
        }
    }
}
