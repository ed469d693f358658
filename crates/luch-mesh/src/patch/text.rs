//! A text format of our own for what `.bpt` cannot hold: B-splines, weights, trimming. The usual extension is `.patches`.
//!
//! Words may stand on any lines; `#` begins a comment.
//!
//! ```text
//! luch-patches 1
//! surface 1 1  2 2          # degrees along u and v, points along u and v
//! knots 0 0 1 1  0 0 1 1    # along u, then along v
//! points                    # x y z weight, u running fastest
//!   0 0 0 1   1 0 0 1
//!   0 1 0 1   1 1 0 1
//! keep inside               # or outside; without it all of the surface is there
//! loop                      # closed, of one or more curves in the parameter plane
//! curve 1 4                 # degree, points
//! knots 0 0 1 2 3 3
//! points  0.2 0.2 1  0.8 0.2 1  0.5 0.8 1  0.2 0.2 1   # u v weight
//! ```

use std::fmt::Write;

use glam::DVec3;

use super::{
    ControlPoint, Curve, Keeps, Knots, MAX_DEGREE, Patch, PatchError, PatchModel, Surface, TrimLoop, Trimming,
};
use crate::codec::{DecodeError, ErrorKind};
use crate::words::{Word, Words};

/// The word that a file begins with.
pub const MARK: &str = "luch-patches";

/// Reads a model.
///
/// # Errors
/// Line and column of what is wrong.
pub fn decode(bytes: &[u8]) -> Result<PatchModel, DecodeError> {
    let mut words = Words::new(bytes);
    keyword(&mut words, MARK)?;
    words.count(1, 1, "the version")?;
    let mut model = PatchModel::default();
    while let Some(start) = words.peek() {
        keyword(&mut words, "surface")?;
        let degrees = [degree(&mut words)?, degree(&mut words)?];
        let counts = [count(&mut words)?, count(&mut words)?];
        keyword(&mut words, "knots")?;
        let knots = [knots(&mut words, degrees[0], counts[0])?, knots(&mut words, degrees[1], counts[1])?];
        keyword(&mut words, "points")?;
        let points = points(&mut words, counts[0].saturating_mul(counts[1]), 3)?;
        let surface = Surface::new(knots, &points).map_err(|error| refused(start, &error))?;
        model.patches.push(Patch { surface, trimming: trimming(&mut words)? });
    }
    Ok(model)
}

fn trimming(words: &mut Words) -> Result<Option<Trimming>, DecodeError> {
    if !next_is(words, "keep") {
        return Ok(None);
    }
    words.next("keep")?;
    let word = words.next("inside or outside")?;
    let keeps = match word.text {
        b"inside" => Keeps::Inside,
        b"outside" => Keeps::Outside,
        _ => return Err(word.wrong("inside or outside")),
    };
    let mut loops = Vec::new();
    while next_is(words, "loop") {
        words.next("loop")?;
        let mut curves = Vec::new();
        while let Some(start) = words.peek().filter(|word| word.text == b"curve") {
            words.next("curve")?;
            let (degree, count) = (degree(words)?, count(words)?);
            keyword(words, "knots")?;
            let knots = knots(words, degree, count)?;
            keyword(words, "points")?;
            let points = points(words, count, 2)?;
            curves.push(Curve::new(knots, &points).map_err(|error| refused(start, &error))?);
        }
        loops.push(TrimLoop { curves });
    }
    Ok(Some(Trimming { loops, keeps }))
}

fn next_is(words: &mut Words, name: &str) -> bool {
    words.peek().is_some_and(|word| word.text == name.as_bytes())
}

fn keyword(words: &mut Words, name: &str) -> Result<(), DecodeError> {
    let word = words.next(name)?;
    if word.text == name.as_bytes() { Ok(()) } else { Err(word.wrong(name)) }
}

fn degree(words: &mut Words) -> Result<usize, DecodeError> {
    Ok(words.count(1, MAX_DEGREE as u64, "a degree")? as usize)
}

fn count(words: &mut Words) -> Result<usize, DecodeError> {
    Ok(words.count(2, u64::from(u32::MAX), "a number of points")? as usize)
}

fn knots(words: &mut Words, degree: usize, count: usize) -> Result<Knots, DecodeError> {
    let expected = count.saturating_add(degree + 1);
    // A number takes two bytes at least: a false count cannot ask for more memory than the file has.
    let mut values = Vec::with_capacity(expected.min(words.rest() / 2 + 1));
    let start = words.peek();
    for _ in 0..expected {
        values.push(words.number("a knot")?);
    }
    let knots = Knots::new(degree, values);
    knots.map_err(|error| {
        start.map_or_else(|| unreachable!("at least four knots were read"), |word| refused(word, &error))
    })
}

fn points(words: &mut Words, count: usize, dimensions: usize) -> Result<Vec<ControlPoint>, DecodeError> {
    let mut points = Vec::with_capacity(count.min(words.rest() / 6 + 1));
    for _ in 0..count {
        let mut position = DVec3::ZERO;
        for axis in 0..dimensions {
            position[axis] = words.number("a coordinate of a point")?;
        }
        points.push(ControlPoint::weighted(position, words.number("a weight")?));
    }
    Ok(points)
}

fn refused(word: Word, error: &PatchError) -> DecodeError {
    DecodeError {
        kind: ErrorKind::Syntax,
        place: word.place,
        found: format!("something of which {error}"),
        expected: "a sound curve or surface".into(),
    }
}

/// Writes a model. Knots are read back to the last bit, points as far as their product with the weight is.
pub fn encode(model: &PatchModel) -> String {
    let mut text = format!("{MARK} 1\n");
    for Patch { surface, trimming } in &model.patches {
        let [u, v] = surface.knots();
        write_line(
            &mut text,
            format_args!("surface {} {} {} {}", u.degree(), v.degree(), u.point_count(), v.point_count()),
        );
        write_line(&mut text, format_args!("knots {} {}", list(u.values()), list(v.values())));
        write_line(&mut text, format_args!("points"));
        for ControlPoint { position: p, weight } in surface.points() {
            write_line(&mut text, format_args!("{} {} {} {weight}", p.x, p.y, p.z));
        }
        let Some(Trimming { loops, keeps }) = trimming else { continue };
        let side = if *keeps == Keeps::Inside { "inside" } else { "outside" };
        write_line(&mut text, format_args!("keep {side}"));
        for TrimLoop { curves } in loops {
            write_line(&mut text, format_args!("loop"));
            for curve in curves {
                let knots = curve.knots();
                write_line(&mut text, format_args!("curve {} {}", knots.degree(), knots.point_count()));
                write_line(&mut text, format_args!("knots {}\npoints", list(knots.values())));
                for ControlPoint { position: p, weight } in curve.points() {
                    write_line(&mut text, format_args!("{} {} {weight}", p.x, p.y));
                }
            }
        }
    }
    text
}

fn write_line(text: &mut String, line: std::fmt::Arguments) {
    // Writing to a string cannot fail.
    let _ = writeln!(text, "{line}");
}

fn list(numbers: &[f64]) -> String {
    numbers.iter().map(f64::to_string).collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure;
    use crate::patch::{Fineness, shapes};
    use glam::DVec2;

    const EXAMPLE: &str = "luch-patches 1\nsurface 1 1 2 2\nknots 0 0 1 1 0 0 1 1\npoints\n\
         0 0 0 1 1 0 0 1\n0 1 0 1 1 1 0 1\nkeep inside\nloop\n\
         curve 1 4\nknots 0 0 1 2 3 3\npoints 0.2 0.2 1 0.8 0.2 1 0.5 0.8 1 0.2 0.2 1\n";

    #[test]
    fn a_trimmed_square_is_a_triangle() {
        let mesh = decode(EXAMPLE.as_bytes()).unwrap().tessellate(Fineness::Tolerance(0.1)).unwrap();
        // Base 0.6, height 0.6; corners are rounded to f32.
        assert!((measure::area(&mesh) - 0.18).abs() < 1e-6);
    }

    #[test]
    fn what_is_written_is_read_back() {
        let mut model =
            PatchModel::from_iter([shapes::sphere(1.5).unwrap(), shapes::torus(2.0, 0.5).unwrap()]);
        let circle = |radius| TrimLoop::from(shapes::circle_in_plane(DVec2::splat(0.5), radius).unwrap());
        model.patches[1].trimming =
            Some(Trimming { loops: vec![circle(0.3), circle(0.1)], keeps: Keeps::Outside });
        let text = encode(&model);
        let again = decode(text.as_bytes()).unwrap();
        let meshes = [&model, &again].map(|model| model.tessellate(Fineness::Tolerance(0.02)).unwrap());
        assert_eq!(meshes[0].triangles, meshes[1].triangles);
        let far = meshes[0].positions.iter().zip(&meshes[1].positions).map(|(a, b)| a.distance(*b));
        assert!(far.fold(0.0, f32::max) < 1e-6);
        assert!(again.patches[0].trimming.is_none());
        assert_eq!(again.patches[1].trimming.as_ref().unwrap().loops.len(), 2);
    }

    #[test]
    fn errors_say_where() {
        for (from, to, message) in [
            ("luch-patches", "patches", "line 1, column 1: found “patches”, expected luch-patches"),
            (
                "patches 1",
                "patches 2",
                "line 1, column 14: found “2”, expected the version, a whole number from 1 to 1",
            ),
            (
                "0 0 1 1 0",
                "0 2 1 1 0",
                "line 3, column 7: found something of which knot 2 is 1: knots must be finite",
            ),
            (
                "1 1 0 1\nkeep",
                "1 1 0 0\nkeep",
                "line 2, column 1: found something of which the weight of point 3 is 0",
            ),
            ("inside", "both", "line 7, column 6: found “both”, expected inside or outside"),
            ("curve 1 4", "curve 1 5", "line 11, column 1: found “points”, expected a knot"),
            (
                " 0.2 0.2 1\n",
                "",
                "line 11, column 37: found the end of the file, expected a coordinate of a point",
            ),
        ] {
            let error = decode(EXAMPLE.replace(from, to).as_bytes()).unwrap_err().to_string();
            assert!(error.starts_with(message), "{error}");
        }
        let huge = EXAMPLE.replace("1 1 2 2", "1 1 4294967295 4294967295");
        assert!(decode(huge.as_bytes()).is_err() && decode(b"").is_err());
    }
}
