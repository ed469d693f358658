//! Letters made of strokes, drawn for this project: no font file is needed for a PNG, and none is carried along.

mod glyphs;

use glyphs::GLYPHS;

/// Units of a letter's drawing in one em: capitals are seven units high.
const EM: f64 = 10.0;

/// Room beside every letter, in units.
const GAP: f64 = 1.6;

/// A piece of an outline, in units, y upward.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Piece {
    Move([f64; 2]),
    Line([f64; 2]),
    Cubic([[f64; 2]; 3]),
}

/// How a letter is drawn.
struct Glyph {
    path: &'static str,
    width: f64,
    scale: f64,
    raise: f64,
}

fn find(character: char) -> Glyph {
    let plain = |wanted: char| GLYPHS.iter().find(|(character, _, _)| *character == wanted);
    let (base, scale, raise) = match character {
        '⁰' => ('0', 0.64, 3.3),
        '¹' => ('1', 0.64, 3.3),
        '²' => ('2', 0.64, 3.3),
        '³' => ('3', 0.64, 3.3),
        '⁴' => ('4', 0.64, 3.3),
        '⁵' => ('5', 0.64, 3.3),
        '⁶' => ('6', 0.64, 3.3),
        '⁷' => ('7', 0.64, 3.3),
        '⁸' => ('8', 0.64, 3.3),
        '⁹' => ('9', 0.64, 3.3),
        '⁻' => ('-', 0.64, 3.3),
        '⁺' => ('+', 0.64, 3.3),
        '₀' => ('0', 0.64, -1.4),
        '₁' => ('1', 0.64, -1.4),
        '₂' => ('2', 0.64, -1.4),
        '₃' => ('3', 0.64, -1.4),
        '₄' => ('4', 0.64, -1.4),
        '₅' => ('5', 0.64, -1.4),
        '₆' => ('6', 0.64, -1.4),
        '₇' => ('7', 0.64, -1.4),
        '₈' => ('8', 0.64, -1.4),
        '₉' => ('9', 0.64, -1.4),
        '½' => ('½', 1.0, 0.0),
        'µ' => ('μ', 1.0, 0.0),
        '\u{a0}' | '\u{202f}' => (' ', 1.0, 0.0),
        other => (glyphs::twin(other), 1.0, 0.0),
    };
    // What has no drawing is an empty box.
    let (_, width, path) = plain(base).copied().unwrap_or(('□', 4.0, "M0 0L4 0L4 7L0 7L0 0"));
    Glyph { path, width, scale, raise }
}

/// The width of a line of text.
pub(super) fn width(text: &str, size: f64, is_bold: bool) -> f64 {
    let units: f64 = text.chars().map(advance).sum();
    let wider = if is_bold { 1.06 } else { 1.0 };
    units * size / EM * wider
}

fn advance(character: char) -> f64 {
    let glyph = find(character);
    (glyph.width + GAP) * glyph.scale
}

/// The strokes of a line of text in pixels, y downward, its left end at `at`.
pub(super) fn strokes(text: &str, at: [f64; 2], size: f64, is_bold: bool) -> Vec<Piece> {
    let unit = size / EM;
    let wider = if is_bold { 1.06 } else { 1.0 };
    let mut pieces = Vec::new();
    let mut x = at[0];
    for character in text.chars() {
        let glyph = find(character);
        let left = x + 0.5 * GAP * glyph.scale * unit * wider;
        let place = |[px, py]: [f64; 2]| {
            [left + px * glyph.scale * unit * wider, at[1] - (py * glyph.scale + glyph.raise) * unit]
        };
        pieces.extend(outline(glyph.path).into_iter().map(|piece| match piece {
            Piece::Move(p) => Piece::Move(place(p)),
            Piece::Line(p) => Piece::Line(place(p)),
            Piece::Cubic(p) => Piece::Cubic(p.map(place)),
        }));
        x += advance(character) * unit * wider;
    }
    pieces
}

/// The pen's width for a size.
pub(super) fn pen(size: f64, is_bold: bool) -> f64 {
    size * if is_bold { 0.125 } else { 0.083 }
}

/// Reads a drawing: `M` begins a stroke, `L` and `C` go on, `O` is a whole ellipse by middle and radii.
fn outline(path: &str) -> Vec<Piece> {
    let mut pieces = Vec::new();
    for (start, _) in path.match_indices(|c: char| c.is_ascii_uppercase()) {
        let rest = &path[start + 1..];
        let end = rest.find(|c: char| c.is_ascii_uppercase()).unwrap_or(rest.len());
        let numbers: Vec<f64> = rest[..end].split_whitespace().filter_map(|word| word.parse().ok()).collect();
        match (path.as_bytes()[start], numbers.as_slice()) {
            (b'M', &[x, y]) => pieces.push(Piece::Move([x, y])),
            (b'L', &[x, y]) => pieces.push(Piece::Line([x, y])),
            (b'C', &[a, b, c, d, x, y]) => pieces.push(Piece::Cubic([[a, b], [c, d], [x, y]])),
            (b'O', &[x, y, rx, ry]) => {
                // A quarter of a circle as one cubic.
                let (kx, ky) = (0.552_285 * rx, 0.552_285 * ry);
                pieces.push(Piece::Move([x + rx, y]));
                pieces.push(Piece::Cubic([[x + rx, y + ky], [x + kx, y + ry], [x, y + ry]]));
                pieces.push(Piece::Cubic([[x - kx, y + ry], [x - rx, y + ky], [x - rx, y]]));
                pieces.push(Piece::Cubic([[x - rx, y - ky], [x - kx, y - ry], [x, y - ry]]));
                pieces.push(Piece::Cubic([[x + kx, y - ry], [x + rx, y - ky], [x + rx, y]]));
            }
            _ => {}
        }
    }
    pieces
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_drawing_is_read_whole() {
        for (character, width, path) in GLYPHS {
            let commands = path.chars().filter(char::is_ascii_uppercase).count();
            let circles = path.matches('O').count();
            let pieces = outline(path);
            assert_eq!(pieces.len(), commands + 4 * circles, "{character}: {path}");
            let starts = matches!(pieces.first(), None | Some(Piece::Move(_)));
            assert!(starts && *width >= 0.0, "{character}");
            let twice = GLYPHS.iter().filter(|(other, _, _)| other == character).count();
            assert_eq!(twice, 1, "{character}");
        }
        for character in ' '..='~' {
            assert!(GLYPHS.iter().any(|(known, _, _)| *known == character), "{character}");
        }
        for character in "πσμρ²⁻³×±−–—·½∞≈≤≥→√∫αβγδεθλ’“”…°₂АЖяю".chars()
        {
            assert_ne!(find(character).path, find('\u{1}').path, "{character}");
        }
    }

    #[test]
    fn widths_add_up() {
        assert!((width("ab", 10.0, false) - width("a", 10.0, false) - width("b", 10.0, false)).abs() < 1e-12);
        assert_eq!(width("0123456789", 12.0, false), 10.0 * width("8", 12.0, false));
    }
}
