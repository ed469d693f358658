//! SVG path data: `M L H V C S Q T A Z`, absolute and relative (SVG 2, chapter 9).

use glam::DVec2;

use super::flatten::{EndpointArc, cubic, quadratic};
use super::path_scanner::Scanner;
use super::{MAX_POINTS, OutlineError};

/// One stroke of a path.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SubPath {
    /// The points, curves resolved.
    pub points: Vec<DVec2>,
    /// Whether it was closed by `Z`; the first point is not repeated then.
    pub is_closed: bool,
}

/// Reads path data; curves become chords within `tolerance` of them. Coordinates are taken as they are: in SVG files
/// y points down, in this crate it points up.
pub fn svg_path(text: &str, tolerance: f64) -> Result<Vec<SubPath>, OutlineError> {
    if tolerance <= 0.0 || !tolerance.is_finite() {
        return Err(OutlineError::OutOfRange {
            name: "the tolerance",
            found: tolerance,
            expected: "above 0",
        });
    }
    let mut pen = Pen { tolerance, ..Pen::default() };
    let mut scanner = Scanner::new(text);
    while !scanner.is_done() {
        let Some(letter) = scanner.command() else {
            return Err(scanner.error("a command such as M, L or C"));
        };
        if pen.paths.is_empty() && !letter.eq_ignore_ascii_case(&'m') {
            scanner.step_back();
            return Err(scanner.error("M: a path begins with it"));
        }
        if letter.eq_ignore_ascii_case(&'z') {
            pen.close();
            continue;
        }
        // A command may be followed by several sets of numbers; after M they draw lines.
        let mut next = letter;
        loop {
            pen.draw(next, &mut scanner)?;
            next = match next {
                'M' => 'L',
                'm' => 'l',
                other => other,
            };
            if pen.count > MAX_POINTS {
                return Err(OutlineError::TooManyPoints { count: pen.count, most: MAX_POINTS });
            }
            if !scanner.has_number() {
                break;
            }
        }
    }
    pen.paths.retain(|path| path.points.len() > 1);
    Ok(pen.paths)
}

#[derive(Default)]
struct Pen {
    tolerance: f64,
    paths: Vec<SubPath>,
    /// Points so far.
    count: usize,
    at: DVec2,
    /// The last control point of a curve, for `S` or `T`, and of which degree the curve was.
    control: Option<Control>,
    /// After `Z` the next stroke begins where this one did.
    must_begin: bool,
}

#[derive(Clone, Copy)]
struct Control {
    point: DVec2,
    degree: u8,
}

impl Pen {
    fn close(&mut self) {
        if let Some(path) = self.paths.last_mut() {
            path.is_closed = true;
            self.at = path.points[0];
            while path.points.len() > 1 && path.points.last() == path.points.first() {
                path.points.pop();
            }
        }
        self.control = None;
        self.must_begin = true;
    }

    /// The control point that goes on smoothly from the last curve.
    fn mirrored(&self, degree: u8) -> DVec2 {
        match self.control {
            Some(control) if control.degree == degree => 2.0 * self.at - control.point,
            _ => self.at,
        }
    }

    fn draw(&mut self, command: char, scanner: &mut Scanner) -> Result<(), OutlineError> {
        let origin = if command.is_ascii_lowercase() { self.at } else { DVec2::ZERO };
        let point = |scanner: &mut Scanner| -> Result<DVec2, OutlineError> {
            Ok(origin + DVec2::new(scanner.number()?, scanner.number()?))
        };
        let kind = command.to_ascii_uppercase();
        if kind == 'M' {
            self.at = point(scanner)?;
            self.paths.push(SubPath { points: vec![self.at], is_closed: false });
            self.count += 1;
            (self.control, self.must_begin) = (None, false);
            return Ok(());
        }
        if std::mem::take(&mut self.must_begin) {
            self.paths.push(SubPath { points: vec![self.at], is_closed: false });
        }
        let (from, tolerance) = (self.at, self.tolerance);
        let mut drawn = Vec::new();
        let mut control = None;
        match kind {
            'L' => drawn.push(point(scanner)?),
            'H' => drawn.push(DVec2::new(origin.x + scanner.number()?, from.y)),
            'V' => drawn.push(DVec2::new(from.x, origin.y + scanner.number()?)),
            'C' | 'S' => {
                let first = if kind == 'C' { point(scanner)? } else { self.mirrored(3) };
                let [second, to] = [point(scanner)?, point(scanner)?];
                cubic([from, first, second, to], tolerance, &mut drawn);
                control = Some(Control { point: second, degree: 3 });
            }
            'Q' | 'T' => {
                let middle = if kind == 'Q' { point(scanner)? } else { self.mirrored(2) };
                quadratic([from, middle, point(scanner)?], tolerance, &mut drawn);
                control = Some(Control { point: middle, degree: 2 });
            }
            'A' => {
                let radii = DVec2::new(scanner.number()?, scanner.number()?);
                let tilt = scanner.number()?.to_radians();
                let (is_large, is_positive) = (scanner.flag()?, scanner.flag()?);
                let to = point(scanner)?;
                EndpointArc { from, to, radii, tilt, is_large, is_positive }.flatten(tolerance, &mut drawn);
                // An arc to where it begins is nothing.
                drawn.push(to);
                drawn.dedup();
            }
            _ => {
                scanner.step_back();
                return Err(scanner.error("one of M, L, H, V, C, S, Q, T, A, Z"));
            }
        }
        self.control = control;
        self.count += drawn.len();
        self.at = drawn.last().copied().unwrap_or(from);
        if let Some(path) = self.paths.last_mut() {
            path.points.append(&mut drawn);
        }
        Ok(())
    }
}
