//! What can keep a preview from being drawn.

/// Largest number of pixels along a side of a picture.
pub const LARGEST_SIDE: u32 = 1 << 14;

/// Most samples of a picture, that is pixels times samples in each: eight bytes each make a gigabyte.
pub const MOST_SAMPLES: u64 = 1 << 27;

/// Why there is no picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum PreviewError {
    /// The picture has no pixels, or too many.
    #[error(
        "a picture of {width}×{height} pixels with {samples} samples in each: sides must be 1 to {LARGEST_SIDE} and all samples \
         at most {MOST_SAMPLES}"
    )]
    Size {
        /// Pixels in a row.
        width: u32,
        /// Rows.
        height: u32,
        /// Samples in each pixel.
        samples: u32,
    },
    /// The camera has no place, no axes or no angle.
    #[error("the camera's {what}")]
    Camera {
        /// What is wrong with it.
        what: &'static str,
    },
    /// More triangles than numbers.
    #[error("{count} triangles in all instances together: a preview can tell {} apart", u32::MAX)]
    TooManyTriangles {
        /// How many there are.
        count: u64,
    },
}
