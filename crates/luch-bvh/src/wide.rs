//! The wide tree: nodes of eight children, leaves of up to four primitives.
//!
//! A child reference is one number: with the top bit set it names a leaf, else a node; [`EMPTY`] names nothing and stands
//! beside a box that no ray meets. Owners keep what belongs to leaf `k` at place `k` of their own list.

use crate::Aabb;

/// Marks a child reference as a leaf.
pub(crate) const LEAF: u32 = 1 << 31;
/// A child that is not there.
pub(crate) const EMPTY: u32 = 0x7fff_ffff;
/// A lane of a leaf that holds no primitive.
pub(crate) const NO_PRIMITIVE: u32 = u32::MAX;

/// Eight boxes and what is in them: four cache lines.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(64))]
pub(crate) struct WideNode {
    /// Rows min x, max x, min y, max y, min z, max z; one column for each child. The plane that faces a ray is thus found
    /// by its address. Empty children have minima of +∞ and maxima of -∞.
    pub(crate) planes: [[f32; 8]; 6],
    /// References.
    pub(crate) children: [u32; 8],
    spare: [u32; 8],
}

impl WideNode {
    /// A node without children.
    pub(crate) fn empty() -> Self {
        let (low, high) = ([f32::INFINITY; 8], [f32::NEG_INFINITY; 8]);
        Self { planes: [low, high, low, high, low, high], children: [EMPTY; 8], spare: [0; 8] }
    }

    /// Puts a child into one of the eight places.
    pub(crate) fn set(&mut self, place: usize, bounds: &Aabb, child: u32) {
        for axis in 0..3 {
            self.planes[2 * axis][place] = bounds.min[axis];
            self.planes[2 * axis + 1][place] = bounds.max[axis];
        }
        self.children[place] = child;
    }

    /// The box of a child.
    pub(crate) fn bounds(&self, place: usize) -> Aabb {
        let corner = |end: usize| {
            glam::Vec3::new(self.planes[end][place], self.planes[2 + end][place], self.planes[4 + end][place])
        };
        Aabb { min: corner(0), max: corner(1) }
    }
}

/// No way from the root of a wide tree passes more nodes; the build sees to it. A walk that puts off all children of a node
/// but one therefore never has more than [`MAX_WAITING`] waiting.
pub(crate) const MAX_WIDE_DEPTH: usize = 24;
/// The most children that ever wait in a walk.
pub(crate) const MAX_WAITING: usize = 7 * MAX_WIDE_DEPTH + 1;

/// A tree of wide nodes over numbered primitives.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Wide {
    pub(crate) nodes: Vec<WideNode>,
    /// The primitives of each leaf; unused lanes, always the last ones, hold [`NO_PRIMITIVE`].
    pub(crate) leaves: Vec<[u32; 4]>,
    /// Reference of the root; [`EMPTY`] for a tree over nothing.
    pub(crate) root: u32,
    pub(crate) bounds: Aabb,
}
