//! Triangles and segments cut to what can be projected: in front of the eye, and not so far outside the picture that places
//! would not fit the raster's integers.
//!
//! Sutherland and Hodgman, "Reentrant polygon clipping" (1974), in view space before the division (Blinn and Newell,
//! "Clipping using homogeneous coordinates", 1978). A cut is always computed from the inner end of an edge to the outer one,
//! so both triangles of an edge cut it at the same place.

use crate::view::{Rays, View};
use glam::{DVec2, DVec3};

/// The half-spaces that are kept.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Frustum {
    rays: Rays,
    /// Least depth.
    near: f64,
    /// Farthest place from the middle of the picture, in samples.
    reach: DVec2,
}

/// Corners of a triangle that was cut: each of the five planes adds one at most.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cut {
    corners: [DVec3; 8],
    count: usize,
}

impl Cut {
    pub(crate) fn corners(&self) -> &[DVec3] {
        &self.corners[..self.count]
    }

    fn push(&mut self, corner: DVec3) {
        self.corners[self.count] = corner;
        self.count += 1;
    }
}

const PLANES: usize = 5;

impl Frustum {
    /// `near` is the least depth where rays are central; where they are parallel it is 0, the camera's plane itself.
    pub(crate) fn new(view: &View, near: f64, reach: DVec2) -> Self {
        let near = match view.rays {
            Rays::Central => near,
            Rays::Parallel => 0.0,
        };
        Self { rays: view.rays, near, reach }
    }

    /// How far inside a plane a point is; linear in the point, not negative inside.
    #[inline]
    fn inside(&self, plane: usize, p: DVec3) -> f64 {
        let divisor = match self.rays {
            Rays::Central => p.z,
            Rays::Parallel => 1.0,
        };
        match plane {
            0 => p.z - self.near,
            1 => self.reach.x * divisor - p.x,
            2 => self.reach.x * divisor + p.x,
            3 => self.reach.y * divisor - p.y,
            _ => self.reach.y * divisor + p.y,
        }
    }

    /// Whether a point is inside all planes; false where a coordinate is not a number.
    #[inline]
    pub(crate) fn contains(&self, p: DVec3) -> bool {
        (0..PLANES).all(|plane| self.inside(plane, p) >= 0.0)
    }

    /// What is left of a triangle: a convex polygon, or fewer than three corners if nothing is.
    pub(crate) fn cut(&self, triangle: [DVec3; 3]) -> Cut {
        let mut kept = Cut { corners: [DVec3::ZERO; 8], count: 0 };
        if !triangle.iter().all(|corner| corner.is_finite()) {
            return kept;
        }
        triangle.into_iter().for_each(|corner| kept.push(corner));
        for plane in 0..PLANES {
            let before = kept;
            kept.count = 0;
            let corners = before.corners();
            for (i, &from) in corners.iter().enumerate() {
                let to = corners[(i + 1) % corners.len()];
                let (at_from, at_to) = (self.inside(plane, from), self.inside(plane, to));
                if at_from >= 0.0 {
                    kept.push(from);
                    if at_to < 0.0 {
                        kept.push(crossing(from, at_from, to, at_to));
                    }
                } else if at_to >= 0.0 {
                    kept.push(crossing(to, at_to, from, at_from));
                }
            }
            if kept.count < 3 {
                kept.count = 0;
                return kept;
            }
        }
        kept
    }

    /// What is left of a segment.
    pub(crate) fn cut_segment(&self, mut ends: [DVec3; 2]) -> Option<[DVec3; 2]> {
        if !ends.iter().all(|end| end.is_finite()) {
            return None;
        }
        for plane in 0..PLANES {
            let [at_first, at_second] = ends.map(|end| self.inside(plane, end));
            match (at_first >= 0.0, at_second >= 0.0) {
                (true, true) => {}
                (true, false) => ends[1] = crossing(ends[0], at_first, ends[1], at_second),
                (false, true) => ends[0] = crossing(ends[1], at_second, ends[0], at_first),
                (false, false) => return None,
            }
        }
        Some(ends)
    }
}

/// The point between an inner and an outer point where the distance to a plane is 0.
fn crossing(inner: DVec3, at_inner: f64, outer: DVec3, at_outer: f64) -> DVec3 {
    inner + (outer - inner) * (at_inner / (at_inner - at_outer))
}
