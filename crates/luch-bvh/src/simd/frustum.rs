//! Four planes around the rays of a packet: eight boxes at a time are found to be beside it.
//!
//! One axis, z, is chosen along which all rays run to the same side. In x and in y each ray is a straight line over z; the
//! greatest of sixteen lines is a convex function, so between two places `z_low` and `z_high` it lies below the chord between
//! its values there, and the least above its own chord. That holds for rays that share their origin as for rays that share
//! their end.
//!
//! The planes only prune, and they err to one side: a box that any ray of the packet enters by the test of
//! [`slab`](crate::slab) is never found to be beside. That test moves planes by 2⁻¹⁹ of their distance from the origin, beside
//! rounding of a few units in the last place; all the numbers here together are off by some 2⁻²⁰ of the largest coordinate,
//! for slopes up to [`STEEPEST`]. The chords are moved outward by [`MARGIN`] of it.

#![expect(clippy::neg_cmp_op_on_partial_ord, reason = "what is not a number must fail the comparison")]

use super::lanes::{Isa, Lanes};
use super::packet::Packet;
use crate::Aabb;
use crate::wide::WideNode;

/// Of the largest coordinate: 2⁻¹⁵.
const MARGIN: f32 = 1.0 / 32_768.0;
/// The greatest coordinate.
const LARGEST: f32 = 1e30;
/// The greatest slope against the z axis.
const STEEPEST: f32 = 8.0;

/// A chord: `start + slope · z`, compared with one plane of a box at another.
#[derive(Clone, Copy)]
struct Chord {
    start: f32,
    slope: f32,
    /// Row of a node with the planes that are compared.
    row: usize,
    /// Row with the z at which they are: where the chord is farthest out.
    row_z: usize,
}

/// A bundle of rays as boxes see it.
#[derive(Clone, Copy)]
pub(super) struct Frustum {
    /// Above which no ray runs, in x and y.
    above: [Chord; 2],
    /// Below which none does.
    below: [Chord; 2],
    z_low: f32,
    z_high: f32,
    /// Row of the z planes with the lesser coordinates.
    row_z: usize,
    /// Row of the z planes that face the rays.
    facing: usize,
    /// What is at least as far ahead in z as the origin of any ray.
    origin: f32,
    /// At most the reciprocal direction in z of any ray.
    inverse: f32,
}

/// Which children of a node may be met, and from when on at the earliest.
pub(super) struct Beside<I: Isa> {
    pub(super) met: <I::Eight as Lanes<8>>::Mask,
    pub(super) near: I::Eight,
}

impl Frustum {
    /// The planes around the sound rays of a packet as far as these are inside `bounds`; `None` if the rays do not run the
    /// same way, or their numbers are too large to say.
    #[inline(always)]
    pub(super) fn new<I: Isa>(packet: &Packet, bounds: &Aabb) -> Option<Self> {
        let sound = I::Sixteen::mask(packet.sound);
        let load = I::Sixteen::load;
        // The extreme of the sound rays. No closures: those are compiled for all processors.
        macro_rules! least {
            ($row:expr) => {
                I::Sixteen::select(sound, $row, I::Sixteen::splat(f32::INFINITY)).least()
            };
        }
        macro_rules! most {
            ($row:expr) => {
                I::Sixteen::select(sound, $row, I::Sixteen::splat(f32::NEG_INFINITY)).most()
            };
        }
        // The axis of the least slope against the worst of the rays that all run to one side of it.
        let mut best = (0.0, 0);
        for axis in 0..3 {
            let backward = packet.backward[axis] & packet.sound;
            if backward == 0 || backward == packet.sound {
                let slowest = least!(load(&packet.direction[axis]).abs());
                if slowest > best.0 {
                    best = (slowest, axis);
                }
            }
        }
        let z = best.1;
        if !(best.0 > 0.0) {
            return None;
        }
        let is_backward = packet.backward[z] & packet.sound != 0;
        let (origin_z, direction_z) = (load(&packet.origin[z]), load(&packet.direction[z]));
        let inverse_z = load(&packet.near_inverse[z]);
        let end_z = origin_z + load(&packet.t_max) * direction_z;
        let (first, last) = if is_backward { (end_z, origin_z) } else { (origin_z, end_z) };
        let low = largest(least!(first), bounds.min[z]);
        let high = smallest(most!(last), bounds.max[z]);
        let mut scale = 0.0;
        for axis in 0..3 {
            let origin = load(&packet.origin[axis]).abs();
            scale = largest(scale, most!(origin));
            scale = largest(scale, largest(bounds.min[axis].abs(), bounds.max[axis].abs()));
        }
        // Nothing below overflows, so no number goes missing.
        if !(scale <= LARGEST) {
            return None;
        }
        let margin = scale * MARGIN;
        // Chords over a wider piece hold as well, and are no steeper than the rays.
        let (z_low, z_high) = (low - margin, largest(high, low) + margin);
        let mut chords = [[Chord { start: 0.0, slope: 0.0, row: 0, row_z: 0 }; 2]; 2];
        for (place, across) in [(z + 1) % 3, (z + 2) % 3].into_iter().enumerate() {
            let slope = load(&packet.direction[across]) / direction_z;
            if !(most!(slope.abs()) <= STEEPEST) {
                return None;
            }
            let origin = load(&packet.origin[across]);
            let at_low = origin + (I::Sixteen::splat(z_low) - origin_z) * slope;
            let at_high = origin + (I::Sixteen::splat(z_high) - origin_z) * slope;
            let chord = |from: f32, to: f32, above: bool| {
                let slope = (to - from) / (z_high - z_low);
                let outward = if above { margin } else { -margin };
                Chord {
                    start: from - slope * z_low + outward * (2.0 + 2.0 * slope.abs()),
                    slope,
                    row: 2 * across + usize::from(!above),
                    row_z: 2 * z + usize::from((slope > 0.0) == above),
                }
            };
            chords[0][place] = chord(most!(at_low), most!(at_high), true);
            chords[1][place] = chord(least!(at_low), least!(at_high), false);
        }
        if !(z_high > z_low) {
            return None;
        }
        let (origin, inverse) = if is_backward {
            (least!(origin_z), most!(inverse_z))
        } else {
            (most!(origin_z), least!(inverse_z))
        };
        Some(Self {
            above: chords[0],
            below: chords[1],
            z_low: z_low - margin,
            z_high: z_high + margin,
            row_z: 2 * z,
            facing: 2 * z + usize::from(is_backward),
            origin,
            inverse,
        })
    }

    /// Compares all eight children.
    #[inline(always)]
    pub(super) fn beside<I: Isa>(&self, node: &WideNode) -> Beside<I> {
        let splat = I::Eight::splat;
        // SAFETY: all rows were chosen below six.
        let row = |row: usize| I::Eight::load(unsafe { node.planes.get_unchecked(row) });
        let mut beside =
            splat(self.z_high).below(row(self.row_z)) | row(self.row_z + 1).below(splat(self.z_low));
        for chord in &self.above {
            let line = splat(chord.start) + splat(chord.slope) * row(chord.row_z);
            beside = beside | line.below(row(chord.row));
        }
        for chord in &self.below {
            let line = splat(chord.start) + splat(chord.slope) * row(chord.row_z);
            beside = beside | row(chord.row).below(line);
        }
        let near = (row(self.facing) - splat(self.origin)) * splat(self.inverse);
        Beside { met: !beside, near: splat(0.0).larger(near) }
    }
}

fn largest(a: f32, b: f32) -> f32 {
    if b > a { b } else { a }
}

fn smallest(a: f32, b: f32) -> f32 {
    if b < a { b } else { a }
}
