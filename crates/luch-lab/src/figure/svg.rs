//! SVG: shapes as paths, text as text, colours by class.

use super::drawing::{Drawing, Shape, Stroke, Text};
use super::theme::{Paint, Theme};
use super::{Anchor, Dash, Marker, png};
use std::fmt::Write;

/// Which colours a document has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Look {
    /// Those of the reader's theme.
    Both,
    One(Theme),
}

/// The document.
pub(super) fn write(drawing: &Drawing, look: Look) -> String {
    let (width, height) = (length(drawing.width), length(drawing.height));
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"luch\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" height=\"{height}\" role=\"img\" aria-label=\"{}\">\n",
        escaped(&drawing.title)
    );
    let _ = writeln!(out, "<title>{}</title>", escaped(&drawing.title));
    if !drawing.description.is_empty() {
        let _ = writeln!(out, "<desc>{}</desc>", escaped(&drawing.description));
    }
    out.push_str(&style(look));
    let _ = writeln!(out, "<rect class=\"f-ground\" width=\"{width}\" height=\"{height}\"/>");
    for shape in &drawing.shapes {
        write_shape(shape, &mut out);
    }
    out.push_str("</svg>\n");
    out
}

/// Each paint fills by the class f-name and draws by s-name.
fn style(look: Look) -> String {
    let mut out = String::from("<style>");
    out.push_str(
        ".luch text{font-family:system-ui,-apple-system,'Segoe UI',Roboto,'Helvetica Neue',Arial,sans-serif}",
    );
    out.push_str(
        ".luch .b{font-weight:600}.luch .h{paint-order:stroke;stroke-width:3.5px;stroke-linejoin:round}",
    );
    let rules = |theme: Theme, out: &mut String| {
        for paint in Paint::ALL {
            let (name, [r, g, b]) = (paint.class(), paint.color(theme));
            let _ = write!(
                out,
                ".luch .f-{name}{{fill:#{r:02x}{g:02x}{b:02x}}}.luch .s-{name}{{fill:none;stroke:#{r:02x}{g:02x}{b:02x}}}"
            );
        }
        let [r, g, b] = Paint::Panel.color(theme);
        let _ = write!(out, ".luch .h{{stroke:#{r:02x}{g:02x}{b:02x}}}");
    };
    match look {
        Look::One(theme) => rules(theme, &mut out),
        Look::Both => {
            rules(Theme::Light, &mut out);
            out.push_str("@media (prefers-color-scheme:dark){");
            rules(Theme::Dark, &mut out);
            out.push('}');
        }
    }
    out.push_str("</style>\n");
    out
}

/// A number of pixels with two digits, without what is not needed.
fn length(value: f64) -> String {
    let text = format!("{value:.2}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".into() } else { text.into() }
}

/// Text made safe for SVG and HTML.
pub(super) fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for character in text.chars().take(4000) {
        match character {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\n' | '\t' => out.push(' '),
            // Neither control characters nor the two that XML refuses.
            c if c.is_control() || c == '\u{fffe}' || c == '\u{ffff}' => out.push('�'),
            c => out.push(c),
        }
    }
    out
}

fn path(lines: &[Vec<[f64; 2]>], is_closed: bool) -> String {
    let mut out = String::new();
    for line in lines {
        for (at, [x, y]) in line.iter().enumerate() {
            out.push(if at == 0 { 'M' } else { 'L' });
            let _ = write!(out, "{} {}", length(*x), length(*y));
        }
        if is_closed && !line.is_empty() {
            out.push('Z');
        }
    }
    out
}

fn opacity(value: f64) -> String {
    if value >= 1.0 { String::new() } else { format!(" opacity=\"{}\"", length(value)) }
}

fn write_shape(shape: &Shape, out: &mut String) {
    match shape {
        Shape::Lines { lines, stroke } => {
            if lines.is_empty() {
                return;
            }
            let Stroke { paint, width, dash, opacity: alpha } = stroke;
            let dashes = match dash {
                Dash::Solid => "",
                Dash::Dashed => " stroke-dasharray=\"6 4\"",
                Dash::Dotted => " stroke-dasharray=\"0.1 4\"",
            };
            let _ = writeln!(
                out,
                "<path class=\"s-{}\" stroke-width=\"{}\" stroke-linejoin=\"round\" stroke-linecap=\"{}\"{dashes}{} d=\"{}\"/>",
                paint.class(),
                length(*width),
                if *width <= 1.0 || *dash == Dash::Dashed { "butt" } else { "round" },
                opacity(*alpha),
                path(lines, false)
            );
        }
        Shape::Area { outlines, paint, opacity: alpha } => {
            if !outlines.is_empty() {
                let data = path(outlines, true);
                let _ =
                    writeln!(out, "<path class=\"f-{}\"{} d=\"{data}\"/>", paint.class(), opacity(*alpha));
            }
        }
        Shape::Dots { centers, radius, marker, paint, opacity: alpha } => {
            if centers.is_empty() {
                return;
            }
            let r = *radius;
            // One path with a round pen of the dot's width draws thousands of discs.
            let (class, extra, data) = match marker {
                Marker::Disc => {
                    let dots = centers.iter().map(|[x, y]| format!("M{} {}h0", length(*x), length(*y)));
                    let extra = format!(" stroke-width=\"{}\" stroke-linecap=\"round\"", length(2.0 * r));
                    ("s", extra, dots.collect::<String>())
                }
                Marker::Ring | Marker::Cross => {
                    let extra = " stroke-width=\"1.5\" stroke-linecap=\"round\"".to_owned();
                    ("s", extra, path(&marker_lines(centers, r, *marker), *marker == Marker::Ring))
                }
                _ => ("f", String::new(), path(&marker_lines(centers, r, *marker), true)),
            };
            let _ = writeln!(
                out,
                "<path class=\"{class}-{}\"{extra}{} d=\"{data}\"/>",
                paint.class(),
                opacity(*alpha)
            );
        }
        Shape::Discs { centers, radii, paint, opacity: alpha } => {
            let _ = writeln!(out, "<g class=\"f-{}\"{}>", paint.class(), opacity(*alpha));
            for ([x, y], radius) in centers.iter().zip(radii) {
                let _ = write!(
                    out,
                    "<circle cx=\"{}\" cy=\"{}\" r=\"{}\"/>",
                    length(*x),
                    length(*y),
                    length(*radius)
                );
            }
            out.push_str("</g>\n");
        }
        Shape::Text(text) => write_text(text, out),
        Shape::Picture { rect, width, pixels } => {
            let height = pixels.len().checked_div(*width).unwrap_or(0);
            if let Some(bytes) = png::encode_pixels(*width, height, pixels) {
                let _ = writeln!(
                    out,
                    "<image x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" preserveAspectRatio=\"none\" style=\"image-rendering:pixelated\" href=\"data:image/png;base64,{}\"/>",
                    length(rect.x),
                    length(rect.y),
                    length(rect.width),
                    length(rect.height),
                    base64(&bytes)
                );
            }
        }
    }
}

/// Outlines of markers that are not discs; a ring as a polygon of 16 corners.
pub(super) fn marker_lines(centers: &[[f64; 2]], r: f64, marker: Marker) -> Vec<Vec<[f64; 2]>> {
    let ring: Vec<[f64; 2]> = (0..16)
        .map(|i| {
            let angle = std::f64::consts::TAU * f64::from(i) / 16.0;
            [r * libm::cos(angle), r * libm::sin(angle)]
        })
        .collect();
    let s = 0.886 * r;
    // All of about the area of the disc.
    let forms: Vec<Vec<[f64; 2]>> = match marker {
        Marker::Disc | Marker::Ring => vec![ring],
        Marker::Square => vec![vec![[-s, -s], [s, -s], [s, s], [-s, s]]],
        Marker::Triangle => vec![vec![[-1.17 * r, 0.77 * r], [1.17 * r, 0.77 * r], [0.0, -1.25 * r]]],
        Marker::Diamond => vec![vec![[0.0, -1.3 * r], [1.3 * r, 0.0], [0.0, 1.3 * r], [-1.3 * r, 0.0]]],
        Marker::Cross => vec![vec![[-s, -s], [s, s]], vec![[-s, s], [s, -s]]],
    };
    let at = |[x, y]: [f64; 2], form: &Vec<[f64; 2]>| form.iter().map(|[dx, dy]| [x + dx, y + dy]).collect();
    centers.iter().flat_map(|&center| forms.iter().map(move |form| at(center, form))).collect()
}

fn write_text(text: &Text, out: &mut String) {
    let anchor = match text.anchor {
        Anchor::Left => "",
        Anchor::Middle => " text-anchor=\"middle\"",
        Anchor::Right => " text-anchor=\"end\"",
    };
    let bold = if text.is_bold { " b" } else { "" };
    let halo = if text.has_halo { " h" } else { "" };
    let _ = writeln!(
        out,
        "<text class=\"f-{}{bold}{halo}\" x=\"{}\" y=\"{}\" font-size=\"{}\"{anchor}>{}</text>",
        text.paint.class(),
        length(text.at[0]),
        length(text.at[1]),
        length(text.size),
        escaped(&text.text)
    );
}

/// Bytes as text (RFC 4648).
pub(super) fn base64(bytes: &[u8]) -> String {
    const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut out = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for chunk in bytes.chunks(3) {
        let word = u32::from(chunk[0]) << 16
            | u32::from(chunk.get(1).copied().unwrap_or(0)) << 8
            | u32::from(chunk.get(2).copied().unwrap_or(0));
        for i in 0..4 {
            let letter = LETTERS[(word >> (18 - 6 * i)) as usize & 63];
            out.push(if i <= chunk.len() { char::from(letter) } else { '=' });
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_has_its_known_values() {
        for (plain, coded) in
            [("", ""), ("f", "Zg=="), ("fo", "Zm8="), ("foo", "Zm9v"), ("foobar", "Zm9vYmFy")]
        {
            assert_eq!(base64(plain.as_bytes()), coded);
        }
    }

    #[test]
    fn text_is_made_safe() {
        assert_eq!(escaped("a<b & \"c\"\u{1}"), "a&lt;b &amp; &quot;c&quot;�");
        assert_eq!((length(1.0), length(-0.001), length(2.504)), ("1".into(), "0".into(), "2.5".into()));
    }
}
