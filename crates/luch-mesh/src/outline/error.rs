//! Why an outline or its body cannot be made.

use glam::{DVec2, DVec3};

use super::{MAX_COORDINATE, MAX_FACES};

/// Why an outline or its body cannot be made.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum OutlineError {
    /// There is nothing to make a body of.
    #[error("the outline is empty: it has no area")]
    Empty,
    /// A border is no polygon.
    #[error("a border has {count} points, expected three or more")]
    TooFewPoints {
        /// How many it has.
        count: usize,
    },
    /// There are too many points.
    #[error("the outline has {count} points; at most {most} are taken")]
    TooManyPoints {
        /// How many there are.
        count: usize,
        /// How many there may be.
        most: usize,
    },
    /// A coordinate is not a number or far too large.
    #[error("a point is at {point}; coordinates reach from −{MAX_COORDINATE:e} to {MAX_COORDINATE:e}")]
    NotFinite {
        /// The point.
        point: DVec2,
    },
    /// Borders cross, so it is not said what is inside.
    #[error("borders cross near {place}")]
    Crossing {
        /// Where.
        place: DVec2,
    },
    /// Path data or notation cannot be read.
    #[error("at character {character}: {message}")]
    Syntax {
        /// Counted from 1.
        character: usize,
        /// What was found and what was expected.
        message: String,
    },
    /// The bytes are no font that can be read.
    #[error("the font cannot be read: {message}")]
    Font {
        /// What its reader says.
        message: String,
    },
    /// The font lacks a character.
    #[error("the font has no “{character}” (U+{:04X})", u32::from(*character))]
    MissingCharacter {
        /// The character.
        character: char,
    },
    /// A measure is out of range.
    #[error("{name} is {found}, expected {expected}")]
    OutOfRange {
        /// The measure.
        name: &'static str,
        /// What it is.
        found: f64,
        /// What it may be.
        expected: &'static str,
    },
    /// A profile to be turned around the axis lies on its wrong side.
    #[error("a point of the profile is at {point}, but x is the distance from the axis: from 0 up")]
    BehindAxis {
        /// The point.
        point: DVec2,
    },
    /// A path has too few different points.
    #[error("the path has {count} different points, expected {least} or more")]
    ShortPath {
        /// How many it has.
        count: usize,
        /// How many it needs.
        least: usize,
    },
    /// A path turns back so sharply that no section fits there.
    #[error("the path turns back at {place}: bend it in several steps, or do without mitres")]
    TurnsBack {
        /// Where.
        place: DVec3,
    },
    /// Two outlines to be joined differ.
    #[error("the outlines do not match: border {border} has {first} points in one and {second} in the other")]
    Unequal {
        /// Which border, from 0.
        border: usize,
        /// Points in the first outline.
        first: usize,
        /// Points in the second.
        second: usize,
    },
    /// The body would be too large.
    #[error("that would be {faces} faces; at most {MAX_FACES} are made")]
    TooManyFaces {
        /// How many.
        faces: u64,
    },
}
