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

#[cfg(test)]
mod tests {
    use super::*;

    /// Along a helix Frenet's frame turns by the torsion times the length; one that turns as little as it must stays
    /// behind by just that. The error of two reflections falls with the fourth power of the step.
    #[test]
    fn frames_along_a_helix_do_not_turn() {
        let (radius, rise) = (1.0, 0.5);
        let speed = libm::sqrt(radius * radius + rise * rise);
        let whole = 5.0;
        let station = |t: f64| Station {
            place: DVec3::new(radius * libm::cos(t), radius * libm::sin(t), rise * t),
            forward: DVec3::new(-radius * libm::sin(t), radius * libm::cos(t), rise) / speed,
        };
        // Square to the helix, towards its axis, and the third.
        let frenet = |t: f64| {
            let right = DVec3::new(-libm::cos(t), -libm::sin(t), 0.0);
            Frame { right, up: station(t).forward.cross(right) }
        };
        let error = |steps: u32| {
            let at = |k: u32| station(whole * f64::from(k) / f64::from(steps));
            let frame = (0..steps).fold(frenet(0.0), |frame, k| carried(frame, at(k), at(k + 1)));
            let forward = at(steps).forward;
            assert!((frame.right.cross(frame.up) - forward).length() < 1e-12);
            let torsion = rise / (speed * speed);
            let behind = frame.angle_to(frenet(whole));
            (behind - torsion * whole * speed).abs()
        };
        let (coarse, fine) = (error(20), error(40));
        assert!(coarse < 1e-3 && (14.0..18.0).contains(&(coarse / fine)), "{coarse} {fine}");
    }

    #[test]
    fn first_frames_are_upright() {
        for forward in [DVec3::X, DVec3::NEG_Z, DVec3::Y, DVec3::NEG_Y, DVec3::new(0.6, 0.64, 0.48)] {
            let Frame { right, up } = Frame::at_start(forward);
            assert!((right.cross(up) - forward).length() < 1e-12, "{forward}");
            assert!(up.y > 0.0 || forward.y.abs() == 1.0, "{forward}: {up}");
        }
        assert_eq!(Frame::at_start(DVec3::Y), Frame { right: DVec3::X, up: DVec3::NEG_Z });
        let turned = Frame::at_start(DVec3::X).turned(DVec2::from_array([0.0, 1.0]));
        assert_eq!(Frame::at_start(DVec3::X).angle_to(turned), std::f64::consts::FRAC_PI_2);
    }
}
