//! Text as a body.

use super::outlined::{CREASE, TOLERANCE, refused};
use super::{LENGTH, LENGTH_OR_ZERO};
use crate::PolygonMesh;
use crate::outline::{Alignment, Extrusion, Stand, TextLayout, flat, text};
use crate::workshop::{Action, Arguments, Kind, Parameter, Verb, WorkshopError};

/// The verbs.
pub(super) const VERBS: &[Verb] = &[Verb {
    name: "text",
    summary: "Letters of a font file as bodies or flat faces, upright and facing +z",
    parameters: &[
        Parameter::required("text", Kind::Text, "what is written; lines are parted by line breaks or \\n"),
        Parameter::required("font", Kind::File, "a TrueType or OpenType font file"),
        Parameter::new("size", LENGTH, "1", "height of the font (its em), in metres"),
        Parameter::new(
            "depth",
            LENGTH_OR_ZERO,
            "0.2",
            "how thick the letters are, in metres; 0 makes flat faces",
        ),
        Parameter::new("bevel", LENGTH_OR_ZERO, "0", "how far their edges are cut off, in metres"),
        Parameter::new("align", Kind::Choice(&["left", "center", "right"]), "left", "where lines begin"),
        Parameter::new(
            "line-spacing",
            Kind::NOT_NEGATIVE,
            "1",
            "from line to line, times what the font says",
        ),
        Parameter::new("letter-spacing", SPACING, "0", "added between letters, in ems"),
        Parameter::new("lying", Kind::Flag, "false", "on the ground, to be read from above"),
        CREASE,
        TOLERANCE,
    ],
    example: "--text Hello --font font.ttf",
    action: Action::Make { closed: true, run: lettering },
}];

const SPACING: Kind = Kind::Number { least: -1.0, most: 1000.0 };

fn lettering(a: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    let alignment = match a.choice("align") {
        "left" => Alignment::Left,
        "center" => Alignment::Center,
        _ => Alignment::Right,
    };
    let layout = TextLayout {
        size: a.number("size"),
        line_spacing: a.number("line-spacing"),
        letter_spacing: a.number("letter-spacing"),
        alignment,
        tolerance: a.number("tolerance"),
    };
    let written = a.text("text").unwrap_or_default().replace("\\n", "\n");
    let outlines = text(a.file("font").unwrap_or_default(), &written, &layout).map_err(refused)?;
    let stand = if a.flag("lying") { Stand::Lying } else { Stand::Upright };
    let height = a.number("depth");
    if height == 0.0 {
        return flat(&outlines, stand).map_err(refused);
    }
    let (bevel, crease_angle) = (a.number("bevel"), a.number("crease"));
    Extrusion { height, bevel, crease_angle, stand, ..Extrusion::default() }.of(&outlines).map_err(refused)
}
