//! Why a surface cannot be made.

/// Why a field cannot be sampled or meshed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ImplicitError {
    /// The region has no inside, or a side that is not finite.
    #[error(
        "the region from {min} to {max} must have finite sides above zero that single precision can tell apart"
    )]
    Region {
        /// One corner.
        min: glam::DVec3,
        /// The other.
        max: glam::DVec3,
    },
    /// More samples than memory should hold.
    #[error("{samples:.3e} samples are too many: at most {most} can be held; lower the resolution")]
    TooManySamples {
        /// How many it would be.
        samples: f64,
        /// The most that is accepted.
        most: usize,
    },
    /// A list of samples that does not fit its counts.
    #[error("{given} samples do not fill a grid of {x} × {y} × {z}; each count must be at least 2")]
    SampleCount {
        /// How many there are.
        given: usize,
        /// Samples along x.
        x: usize,
        /// Samples along y.
        y: usize,
        /// Samples along z.
        z: usize,
    },
    /// More vertices than a mesh should have.
    #[error("the surface has more than {most} vertices; lower the resolution")]
    TooManyVertices {
        /// The most that is accepted.
        most: usize,
    },
}
