//! What can be wrong with curves and patches.

/// Why a curve, a patch or a model of patches cannot be made or cut into triangles.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PatchError {
    /// A degree out of range.
    #[error("the degree is {degree}, expected 1 to {}", super::MAX_DEGREE)]
    Degree {
        /// What was given.
        degree: usize,
    },
    /// Points and knots do not fit together.
    #[error("there are {found} points, expected {expected}")]
    PointCount {
        /// What was given.
        found: usize,
        /// What the knots ask for.
        expected: usize,
    },
    /// A knot that is out of order, not a number, or repeated too often.
    #[error(
        "knot {index} is {value}: knots must be finite, must not fall, and may repeat as often as the degree"
    )]
    Knot {
        /// Its place, from 0.
        index: usize,
        /// Its value.
        value: f64,
    },
    /// The first and the last knot of the domain are the same, or there are too few.
    #[error("{count} knots span no interval at degree {degree}")]
    Domain {
        /// How many knots there are.
        count: usize,
        /// The degree.
        degree: usize,
    },
    /// A point that is not finite or too far away.
    #[error("point {index} is not finite or farther away than {}", super::MAX_COORDINATE)]
    Point {
        /// Its place, from 0.
        index: usize,
    },
    /// A weight that is out of range.
    #[error("the weight of point {index} is {weight}, expected {} to {}", super::MIN_WEIGHT, 1.0 / super::MIN_WEIGHT)]
    Weight {
        /// Its place, from 0.
        index: usize,
        /// Its value.
        weight: f64,
    },
    /// A tolerance or another wish that cannot be fulfilled.
    #[error("the tolerance is {tolerance}, expected a number above 0")]
    Tolerance {
        /// What was given.
        tolerance: f64,
    },
    /// More triangles than may be.
    #[error("this would take about {count} triangles, the most is {}; be less fine", super::MAX_TRIANGLES)]
    TooFine {
        /// How many triangles it would take.
        count: u64,
    },
    /// A loop that trims a patch is open.
    #[error("loop {index} of the trimming of patch {patch} is not closed")]
    OpenLoop {
        /// The patch, from 0.
        patch: usize,
        /// The loop, from 0.
        index: usize,
    },
    /// Loops cross themselves or one another.
    #[error("the trimming of patch {patch} crosses itself near u = {u}, v = {v}")]
    Crossing {
        /// The patch, from 0.
        patch: usize,
        /// Where.
        u: f64,
        /// Where.
        v: f64,
    },
}
