//! Outlines in a line of text.
//!
//! Forms stand one after another with `;` between them. Together they are borders by the even-odd rule: a form within
//! another is a hole, a form within a hole is an island.
//!
//! | form | what it is |
//! |---|---|
//! | `circle RADIUS [PIECES]` | a circle |
//! | `ellipse RX RY [PIECES]` | an ellipse |
//! | `polygon SIDES RADIUS` | a regular polygon, a corner on +x |
//! | `star TIPS OUTER INNER` | a star, a tip on +y |
//! | `rectangle WIDTH [HEIGHT]` | a rectangle, or a square |
//! | `rounded-rectangle WIDTH HEIGHT RADIUS [PIECES]` | the same with rounded corners |
//! | `gear TEETH MODULE [DEGREES]` | a gear with involute teeth and a pressure angle (20) |
//! | `points X Y X Y X Y …` | any polygon |
//! | `M 0 0 L 1 0 Q …` | SVG path data, y up |
//!
//! `at X Y` after a form moves it; `nonzero` as a form of its own takes the other rule. Numbers are parted by blanks or
//! commas.

use glam::DVec2;

use super::shapes::{self, Gear};
use super::{FillRule, Outline, OutlineError, nested, svg_path};

/// Reads outlines; curves become chords within `tolerance` where no number of pieces is given.
pub fn outlines(text: &str, tolerance: f64) -> Result<Vec<Outline>, OutlineError> {
    let mut borders = Vec::new();
    let mut rule = FillRule::EvenOdd;
    let mut place = 0;
    for form in text.split(';') {
        let start = place
            + text[place..].chars().take_while(|c| c.is_whitespace()).map(char::len_utf8).sum::<usize>();
        let character = text[..start.min(text.len())].chars().count() + 1;
        match form.trim() {
            "nonzero" => rule = FillRule::NonZero,
            "evenodd" => rule = FillRule::EvenOdd,
            form => borders.extend(read(form, tolerance, character)?),
        }
        place += form.len() + 1;
    }
    nested(&borders, rule)
}

/// The points of a line: `points …`, or the first stroke of a path.
pub fn line(text: &str, tolerance: f64) -> Result<Vec<DVec2>, OutlineError> {
    let mut lines = read(text.trim(), tolerance, 1)?;
    if lines.is_empty() { Err(OutlineError::Empty) } else { Ok(lines.swap_remove(0)) }
}

/// The borders of one form that begins at a character.
fn read(form: &str, tolerance: f64, character: usize) -> Result<Vec<Vec<DVec2>>, OutlineError> {
    let wrong = |message: String| OutlineError::Syntax { character, message };
    if form.starts_with(['M', 'm']) {
        let paths = svg_path(form, tolerance).map_err(|error| match error {
            OutlineError::Syntax { character: inner, message } => {
                OutlineError::Syntax { character: character + inner - 1, message }
            }
            other => other,
        })?;
        // A line that ends where it began says so with a repeated point.
        let closed = |path: super::SubPath| {
            let mut points = path.points;
            if path.is_closed {
                points.push(points[0]);
            }
            points
        };
        return Ok(paths.into_iter().map(closed).collect());
    }
    let mut words = form.split([' ', ',', '\t', '\n', '\r']).filter(|word| !word.is_empty());
    let name = words.next().ok_or_else(|| wrong("a form is empty".into()))?;
    let mut numbers = Vec::new();
    let mut shift = None;
    for word in words {
        if word == "at" && shift.is_none() {
            shift = Some(numbers.len());
            continue;
        }
        let number = word.parse().ok().filter(|n: &f64| n.is_finite());
        numbers.push(number.ok_or_else(|| wrong(format!("{name}: found “{word}”, expected a number")))?);
    }
    let at = match shift.map(|start| numbers.split_off(start)).as_deref() {
        None => DVec2::ZERO,
        Some(&[x, y]) => DVec2::new(x, y),
        Some(others) => {
            return Err(wrong(format!("{name}: `at` has {} numbers, expected two", others.len())));
        }
    };
    if tolerance.is_nan() || tolerance <= 0.0 {
        return Err(OutlineError::OutOfRange {
            name: "the tolerance",
            found: tolerance,
            expected: "above 0",
        });
    }
    let mut border = border(name, &numbers, tolerance).map_err(|mistake| match mistake {
        Mistake::Usage(usage) => wrong(format!("found “{form}”, expected {usage}")),
        Mistake::Form(error) => error,
    })?;
    border.iter_mut().for_each(|point| *point += at);
    Ok(vec![border])
}

enum Mistake {
    /// How it would be right.
    Usage(&'static str),
    /// The form cannot be made.
    Form(OutlineError),
}

fn border(name: &str, numbers: &[f64], tolerance: f64) -> Result<Vec<DVec2>, Mistake> {
    let usage = match name {
        "circle" => "circle RADIUS [PIECES]",
        "ellipse" => "ellipse RX RY [PIECES]",
        "polygon" => "polygon SIDES RADIUS",
        "star" => "star TIPS OUTER INNER",
        "rectangle" => "rectangle WIDTH [HEIGHT]",
        "rounded-rectangle" => "rounded-rectangle WIDTH HEIGHT RADIUS [PIECES]",
        "gear" => "gear TEETH MODULE [DEGREES]",
        "points" => "points X Y X Y …",
        _ => {
            return Err(Mistake::Usage(
                "circle, ellipse, polygon, star, rectangle, rounded-rectangle, gear, points, or path data that \
                 begins with M",
            ));
        }
    };
    // Casts take numbers that are too large to the ends, and the forms have limits of their own.
    let count = |number: f64| number as u32;
    let pieces = |given: Option<&f64>, radius: f64| match given {
        Some(&given) => count(given),
        None => shapes::circle_pieces(radius, tolerance),
    };
    let are_positive = |numbers: &[f64]| numbers.iter().all(|n| *n > 0.0);
    let points = match (name, numbers) {
        ("points", numbers) if numbers.len() >= 4 && numbers.len() % 2 == 0 => {
            return Ok(numbers.chunks_exact(2).map(|p| DVec2::new(p[0], p[1])).collect());
        }
        (_, numbers) if !are_positive(numbers) => return Err(Mistake::Usage(usage)),
        ("circle", [radius, rest @ ..]) if rest.len() < 2 => {
            shapes::polygon(pieces(rest.first(), *radius), *radius)
        }
        ("ellipse", [x, y, rest @ ..]) if rest.len() < 2 => {
            shapes::ellipse(DVec2::new(*x, *y), pieces(rest.first(), x.max(*y)))
        }
        ("polygon", [sides, radius]) => shapes::polygon(count(*sides), *radius),
        ("star", [tips, outer, inner]) => shapes::star(count(*tips), *outer, *inner),
        ("rectangle", [side]) => shapes::rectangle(DVec2::splat(*side)),
        ("rectangle", [width, height]) => shapes::rectangle(DVec2::new(*width, *height)),
        ("rounded-rectangle", [width, height, radius, rest @ ..]) if rest.len() < 2 => {
            let quarter =
                rest.first().map_or(shapes::circle_pieces(*radius, tolerance).div_ceil(4), |n| count(*n));
            shapes::rounded_rectangle(DVec2::new(*width, *height), *radius, quarter)
        }
        ("gear", [teeth, module, rest @ ..]) if rest.len() < 2 => {
            let pressure_angle = rest.first().copied().unwrap_or(20.0).to_radians();
            let gear = Gear { teeth: count(*teeth), module: *module, pressure_angle, pieces: 8 };
            gear.border().map_err(Mistake::Form)?
        }
        _ => return Err(Mistake::Usage(usage)),
    };
    Ok(points)
}
