//! Why an operation cannot be done.

/// The most faces an operation makes.
pub const MOST_FACES: usize = 1 << 26;
/// The most corners an operation makes.
pub const MOST_CORNERS: usize = 1 << 29;

/// Why an operation on a mesh cannot be done.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum EditError {
    /// The result would not fit.
    #[error("the result would have {faces} faces; the most is {MOST_FACES}")]
    TooManyFaces {
        /// How many faces there would be.
        faces: u64,
    },
    /// An edge that has to have two faces of opposite direction has others.
    #[error("the edge {0}-{1} does not have two faces of opposite direction: repair the mesh first", .vertices[0], .vertices[1])]
    NotManifold {
        /// The ends of the edge.
        vertices: [u32; 2],
    },
    /// A bridge needs two loops.
    #[error("a bridge needs one loop of border edges in each selection; there are {first} and {second}")]
    NoLoops {
        /// How many loops the first selection has.
        first: usize,
        /// How many loops the second selection has.
        second: usize,
    },
    /// A direction of length zero, or not finite.
    #[error("the {0} must have a direction")]
    NoDirection(&'static str),
    /// A number that is out of range.
    #[error("{name} must be {range}")]
    OutOfRange {
        /// What it is.
        name: &'static str,
        /// What would be right.
        range: &'static str,
    },
    /// A piece that does not exist.
    #[error("there is no component {index}; there are {count}")]
    NoComponent {
        /// What was asked for.
        index: usize,
        /// How many there are.
        count: usize,
    },
}

/// An error if a result of so many faces and corners would not fit.
pub(super) fn check_size(faces: u64, corners: u64) -> Result<(), EditError> {
    if faces > MOST_FACES as u64 || corners > MOST_CORNERS as u64 {
        return Err(EditError::TooManyFaces { faces });
    }
    Ok(())
}
