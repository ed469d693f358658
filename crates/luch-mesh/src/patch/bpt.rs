//! The text format `.bpt` for Bezier patches.
//!
//! First the number of patches; then for each patch its degrees along u and v and its points, three numbers each, u running
//! fastest: `(degree u + 1) · (degree v + 1)` of them. Words may stand on any lines. As an addition of ours, `#` begins a
//! comment.

use std::fmt::Write;

use glam::DVec3;

use super::{ControlPoint, MAX_DEGREE, Patch, PatchModel, Surface};
use crate::codec::{DecodeError, ErrorKind};
use crate::words::Words;

/// Why a model cannot be written as `.bpt`.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum EncodeError {
    /// A trimmed patch.
    #[error("patch {patch} is trimmed; .bpt holds whole patches only")]
    Trimmed {
        /// The patch, from 0.
        patch: usize,
    },
    /// A patch with weights.
    #[error("patch {patch} has weights; .bpt holds none")]
    Rational {
        /// The patch, from 0.
        patch: usize,
    },
}

/// Reads a model.
///
/// # Errors
/// Line and column of what is wrong: a number that is none, a degree that is not 1 to [`MAX_DEGREE`], too few or too many
/// words.
pub fn decode(bytes: &[u8]) -> Result<PatchModel, DecodeError> {
    let mut words = Words::new(bytes);
    let count = words.count(0, u64::from(u32::MAX), "the number of patches")?;
    // A patch takes thirty bytes at least: a false count cannot ask for more memory than the file has.
    let mut patches = Vec::with_capacity(count.min(words.rest() as u64 / 30) as usize);
    for _ in 0..count {
        let start = words.peek();
        let most = MAX_DEGREE as u64;
        let degrees = [words.count(1, most, "a degree")?, words.count(1, most, "a degree")?];
        let [columns, rows] = degrees.map(|degree| degree as usize + 1);
        let mut points = Vec::with_capacity(columns * rows);
        for _ in 0..columns * rows {
            let mut place = DVec3::ZERO;
            for axis in 0..3 {
                place[axis] = words.number("a coordinate of a point")?;
            }
            points.push(ControlPoint::new(place));
        }
        let surface = Surface::bezier([columns - 1, rows - 1], &points);
        patches.push(surface.map_err(|error| DecodeError {
            kind: ErrorKind::TooLarge,
            place: start.map_or(crate::codec::Place::Byte { offset: 0 }, |word| word.place),
            found: format!("a patch in which {error}"),
            expected: "points within range".into(),
        })?);
    }
    match words.peek() {
        Some(word) => Err(word.wrong(format!("the end of the file after {count} patches"))),
        None => Ok(PatchModel::from_iter(patches)),
    }
}

/// Writes a model; B-splines become their Bezier pieces. Numbers are written so that they are read back to the last bit.
///
/// # Errors
/// If a patch is trimmed or has weights.
pub fn encode(model: &PatchModel) -> Result<String, EncodeError> {
    let mut pieces = Vec::new();
    for (patch, Patch { surface, trimming }) in model.patches.iter().enumerate() {
        if trimming.is_some() {
            return Err(EncodeError::Trimmed { patch });
        }
        if surface.is_rational() {
            return Err(EncodeError::Rational { patch });
        }
        pieces.extend(surface.bezier_pieces());
    }
    let mut text = format!("{}\n", pieces.len());
    for piece in pieces {
        let [p, q] = piece.knots().each_ref().map(|knots| knots.degree());
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{p} {q}");
        for point in piece.points() {
            let DVec3 { x, y, z } = point.position;
            let _ = writeln!(text, "{x} {y} {z}");
        }
    }
    Ok(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bump() -> Surface {
        let points: Vec<_> = (0..35)
            .map(|k| {
                let (i, j) = (f64::from(k % 7), f64::from(k / 7));
                ControlPoint::new(DVec3::new(i / 3.0, (i * j) * 0.1, -j / 7.0))
            })
            .collect();
        Surface::b_spline([3, 2], [7, 5], &points).unwrap()
    }

    #[test]
    fn what_is_written_is_read_back() {
        let model = PatchModel::from(bump());
        let text = encode(&model).unwrap();
        let again = decode(text.as_bytes()).unwrap();
        assert_eq!(again.patches.len(), 4 * 3);
        let pieces: Vec<_> = bump().bezier_pieces();
        assert!(again.patches.iter().zip(&pieces).all(|(patch, piece)| patch.surface == *piece));
        assert_eq!(encode(&again).unwrap(), text);
        assert!(encode(&super::super::shapes::sphere(1.0).unwrap().into()).is_err());
    }

    #[test]
    fn errors_say_where() {
        let flat = "1\n1 1\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n";
        assert_eq!(decode(flat.as_bytes()).unwrap().patches.len(), 1);
        for (text, message) in [
            (
                "",
                "line 1, column 1: found the end of the file, expected the number of patches, a whole number from 0 to 4294967295",
            ),
            ("1\n3 26", "line 2, column 3: found “26”, expected a degree, a whole number from 1 to 25"),
            ("1\n1 1\n0 0 0\n1 O 0", "line 4, column 3: found “O”, expected a coordinate of a point"),
            (
                "4294967295 3 3 1 2",
                "line 1, column 19: found the end of the file, expected a coordinate of a point",
            ),
            ("0 7", "line 1, column 3: found “7”, expected the end of the file after 0 patches"),
        ] {
            assert_eq!(decode(text.as_bytes()).unwrap_err().to_string(), message);
        }
        let far = flat.replace("1 1 0", "1 1e300 0");
        assert!(decode(far.as_bytes()).unwrap_err().to_string().contains("line 2, column 1"));
    }
}
