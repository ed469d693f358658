//! Text from a font file (TrueType or OpenType).

use glam::DVec2;
use ttf_parser::{Face, GlyphId, OutlineBuilder};

use super::flatten::{cubic, quadratic};
use super::nesting::overlapping;
use super::{FillRule, MAX_POINTS, Outline, OutlineError, nested};

/// Where the lines of a text begin.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Alignment {
    /// At the origin, to the right of it.
    #[default]
    Left,
    /// In the middle over the origin.
    Center,
    /// They end at the origin.
    Right,
}

/// How text is set.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TextLayout {
    /// Height of the font (its em), in metres.
    pub size: f64,
    /// From line to line, times what the font says.
    pub line_spacing: f64,
    /// Added between letters, in ems.
    pub letter_spacing: f64,
    /// Where lines begin.
    pub alignment: Alignment,
    /// How far chords may lie off the curves, in metres.
    pub tolerance: f64,
}

impl Default for TextLayout {
    fn default() -> Self {
        Self {
            size: 1.0,
            line_spacing: 1.0,
            letter_spacing: 0.0,
            alignment: Alignment::Left,
            tolerance: 0.002,
        }
    }
}

/// The outlines of a text. The first line stands on the x axis, further ones below. Pairs of letters stand as the
/// font's `kern` table says; ligatures and the rules of complex scripts are not applied.
///
/// Where a font draws one letter with borders that cross, the letter is several outlines that overlap.
pub fn text(font: &[u8], text: &str, layout: &TextLayout) -> Result<Vec<Outline>, OutlineError> {
    let face = Face::parse(font, 0).map_err(|error| OutlineError::Font { message: error.to_string() })?;
    let scale = layout.size / f64::from(face.units_per_em().max(1));
    super::check_positive("the size of the text", layout.size)?;
    super::check_positive("the tolerance", layout.tolerance)?;
    let height = f64::from(face.height()) + f64::from(face.line_gap());
    let mut outlines = Vec::new();
    let mut count = 0;
    for (number, line) in text.lines().enumerate() {
        let letters = set(&face, line, layout.letter_spacing)?;
        let width = letters.last().map_or(0.0, |last| last.end);
        let start = match layout.alignment {
            Alignment::Left => 0.0,
            Alignment::Center => -width / 2.0,
            Alignment::Right => -width,
        };
        let drop = number as f64 * height * layout.line_spacing;
        for letter in letters {
            let origin = DVec2::new(start + letter.start, -drop) * scale;
            let mut pen = Pen { scale, origin, tolerance: layout.tolerance, ..Pen::default() };
            // Blanks have no outline.
            if face.outline_glyph(letter.glyph, &mut pen).is_none() || pen.borders.iter().all(|b| b.len() < 3)
            {
                continue;
            }
            count += pen.borders.iter().map(Vec::len).sum::<usize>();
            if count > MAX_POINTS {
                return Err(OutlineError::TooManyPoints { count, most: MAX_POINTS });
            }
            match nested(&pen.borders, FillRule::NonZero) {
                Err(OutlineError::Crossing { .. }) => outlines.extend(overlapping(&pen.borders)?),
                Err(OutlineError::Empty) => {}
                other => outlines.extend(other?),
            }
        }
    }
    if outlines.is_empty() { Err(OutlineError::Empty) } else { Ok(outlines) }
}

/// A letter in its line, in units of the font.
struct Letter {
    glyph: GlyphId,
    start: f64,
    end: f64,
}

/// Places the letters of a line one after another.
fn set(face: &Face, line: &str, letter_spacing: f64) -> Result<Vec<Letter>, OutlineError> {
    let mut letters: Vec<Letter> = Vec::new();
    let mut at = 0.0;
    for character in line.chars() {
        if letters.len() > MAX_POINTS {
            return Err(OutlineError::TooManyPoints { count: letters.len(), most: MAX_POINTS });
        }
        let glyph = face.glyph_index(character).ok_or(OutlineError::MissingCharacter { character })?;
        if let Some(before) = letters.last() {
            at += kerning(face, before.glyph, glyph) + letter_spacing * f64::from(face.units_per_em());
        }
        let start = at;
        at += f64::from(face.glyph_hor_advance(glyph).unwrap_or(0));
        letters.push(Letter { glyph, start, end: at });
    }
    Ok(letters)
}

fn kerning(face: &Face, left: GlyphId, right: GlyphId) -> f64 {
    let Some(table) = face.tables().kern else { return 0.0 };
    let tables =
        table.subtables.into_iter().filter(|sub| sub.horizontal && !sub.variable && !sub.has_cross_stream);
    tables.filter_map(|sub| sub.glyphs_kerning(left, right)).map(f64::from).sum()
}

/// Collects the borders of a glyph.
#[derive(Default)]
struct Pen {
    scale: f64,
    origin: DVec2,
    tolerance: f64,
    borders: Vec<Vec<DVec2>>,
}

impl Pen {
    fn place(&self, x: f32, y: f32) -> DVec2 {
        self.origin + DVec2::new(f64::from(x), f64::from(y)) * self.scale
    }

    fn last(&self) -> DVec2 {
        self.borders.last().and_then(|border| border.last()).copied().unwrap_or(self.origin)
    }

    fn border(&mut self) -> &mut Vec<DVec2> {
        if self.borders.is_empty() {
            self.borders.push(Vec::new());
        }
        let last = self.borders.len() - 1;
        &mut self.borders[last]
    }
}

impl OutlineBuilder for Pen {
    fn move_to(&mut self, x: f32, y: f32) {
        self.borders.push(vec![self.place(x, y)]);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        let to = self.place(x, y);
        self.border().push(to);
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        let controls = [self.last(), self.place(x1, y1), self.place(x, y)];
        let tolerance = self.tolerance;
        quadratic(controls, tolerance, self.border());
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        let controls = [self.last(), self.place(x1, y1), self.place(x2, y2), self.place(x, y)];
        let tolerance = self.tolerance;
        cubic(controls, tolerance, self.border());
    }

    fn close(&mut self) {}
}
