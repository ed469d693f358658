//! The numbers of the Utah teapot: Martin Newell, 1975, as published with Crow, "The Origins of the Teapot", 1987.
//!
//! Here z is up. Of the 32 patches only what is not repeated by symmetry is written down: six profiles that go around
//! in four quarters, and one half of the handle and of the spout.

/// A row of control points of a quarter around the axis: (radius, 0), (radius, bulge), (bulge, radius), (0, radius).
pub(super) struct Circle {
    pub radius: f64,
    pub bulge: f64,
    pub z: f64,
}

/// Newell took 0.56 for the length of the tangents; the exact quarter of a circle is out of reach, 0.5523 is best.
const fn circle(radius: f64, z: f64) -> Circle {
    Circle { radius, bulge: radius * 0.56, z }
}

/// Rim, upper body, lower body, bottom, knob, lid: each from the upper end down, or from the inside out and down.
pub(super) const PROFILES: [[Circle; 4]; 6] = [
    [circle(1.4, 2.4), circle(1.3375, 2.53125), circle(1.4375, 2.53125), circle(1.5, 2.4)],
    [circle(1.5, 2.4), circle(1.75, 1.875), circle(2.0, 1.35), circle(2.0, 0.9)],
    [circle(2.0, 0.9), circle(2.0, 0.45), circle(1.5, 0.225), circle(1.5, 0.15)],
    [circle(1.5, 0.15), circle(1.5, 0.075), circle(1.425, 0.0), circle(0.0, 0.0)],
    // The one row whose tangents are not 0.56 of the radius.
    [circle(0.0, 3.15), Circle { radius: 0.8, bulge: 0.45, z: 3.15 }, circle(0.0, 2.85), circle(0.2, 2.7)],
    [circle(0.2, 2.7), circle(0.4, 2.55), circle(1.3, 2.55), circle(1.3, 2.4)],
];

/// Which of the profiles are the lid: this and those after it.
pub(super) const FIRST_OF_LID: usize = 4;

/// A row of control points of half a section: from the plane y = 0 out to −`width` and back.
pub(super) struct Section {
    /// x and z of the first two points.
    pub first: [f64; 2],
    /// x and z of the last two.
    pub last: [f64; 2],
    /// How far the middle two lie beside the plane.
    pub width: f64,
}

const fn section(first: [f64; 2], last: [f64; 2], width: f64) -> Section {
    Section { first, last, width }
}

/// From the upper end of the handle to its lower: two patches, which share the fourth row. Sections run from the inner
/// side to the outer.
pub(super) const HANDLE: [Section; 7] = [
    section([-1.6, 2.025], [-1.5, 2.25], 0.3),
    section([-2.3, 2.025], [-2.5, 2.25], 0.3),
    section([-2.7, 2.025], [-3.0, 2.25], 0.3),
    section([-2.7, 1.8], [-3.0, 1.8], 0.3),
    section([-2.7, 1.575], [-3.0, 1.35], 0.3),
    section([-2.5, 1.125], [-2.65, 0.9375], 0.3),
    section([-2.0, 0.9], [-1.9, 0.6], 0.3),
];

/// From the body to the mouth of the spout, sections from the upper side to the lower.
pub(super) const SPOUT: [Section; 7] = [
    section([1.7, 1.425], [1.7, 0.6], 0.66),
    section([2.6, 1.425], [3.1, 0.825], 0.66),
    section([2.3, 2.1], [2.4, 2.025], 0.25),
    section([2.7, 2.4], [3.3, 2.4], 0.25),
    section([2.8, 2.475], [3.525, 2.49375], 0.25),
    section([2.9, 2.475], [3.45, 2.5125], 0.15),
    section([2.8, 2.4], [3.2, 2.4], 0.15),
];
