//! Frames along a path that turn no more than they must: rotation-minimising frames.

use glam::{DVec2, DVec3};

/// Two unit vectors square to the path and to one another: right × up = forward.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Frame {
    pub right: DVec3,
    pub up: DVec3,
}

impl Frame {
    /// A first frame: up is as much +y as can be, or −z where the path runs along y.
    pub(super) fn at_start(forward: DVec3) -> Self {
        let wanted = if forward.y.abs() > 0.999_999 { DVec3::NEG_Z * forward.y.signum() } else { DVec3::Y };
        let up = wanted.reject_from_normalized(forward).normalize_or(DVec3::Y);
        Self { right: up.cross(forward), up }
    }

    /// The frame turned about its path.
    pub(super) fn turned(self, turn: DVec2) -> Self {
        Self { right: self.right * turn.x + self.up * turn.y, up: self.up * turn.x - self.right * turn.y }
    }

    /// The angle about the path from this frame to another at the same place.
    pub(super) fn angle_to(self, other: Self) -> f64 {
        libm::atan2(other.right.dot(self.up), other.right.dot(self.right))
    }
}

/// A place on a path and the unit direction there.
#[derive(Clone, Copy, Debug)]
pub(super) struct Station {
    pub place: DVec3,
    pub forward: DVec3,
}

/// The frame at the next station by two reflections (Wang, Jüttler, Zheng, Liu 2008, "Computation of Rotation Minimizing
/// Frames", table I): in the plane halfway between the places, then in the one that takes the direction to the next.
pub(super) fn carried(frame: Frame, from: Station, to: Station) -> Frame {
    let reflected = |vector: DVec3, normal: DVec3| {
        let squared = normal.length_squared();
        if squared < 1e-30 { vector } else { vector - normal * (2.0 * normal.dot(vector) / squared) }
    };
    let between = to.place - from.place;
    let halfway = reflected(frame.right, between);
    let direction = reflected(from.forward, between);
    let right = reflected(halfway, to.forward - direction);
    // Rounding is not allowed to gather over many stations.
    let right = right.reject_from_normalized(to.forward).normalize_or(frame.right);
    Frame { right, up: to.forward.cross(right) }
}
