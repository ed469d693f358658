//! Pictures as text for a terminal.

mod kitty;
mod palette;

use luch_image::{Image, Rgb, srgb};
use std::fmt::Write;

pub use kitty::to_kitty;

/// What a terminal can show.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Depth {
    /// Any colour of 24 bits.
    #[default]
    TrueColor,
    /// The 240 fixed colours of the customary 256.
    Palette,
    /// Letters without colour.
    Letters,
}

/// Most rows of text.
const MOST_ROWS: u32 = 1000;
/// Most columns of text.
const MOST_COLUMNS: u32 = 1000;

/// From dark to bright, each about as much brighter than the one before.
const LETTERS: [char; 10] = [' ', '.', ':', '-', '=', '+', '*', '#', '%', '@'];

/// A picture of linear light as lines of text, `columns` wide (1 to 1000), each with a line break at its end.
///
/// With colours each place shows two pixels by a half block; letters show one. Pixels of the text are the means of what they
/// cover. Places are taken to be twice as high as wide.
pub fn to_terminal(image: &Image<Rgb>, columns: u32, depth: Depth) -> String {
    let mut text = String::new();
    if image.pixels().is_empty() {
        return text;
    }
    let columns = columns.clamp(1, MOST_COLUMNS);
    // As many rows of pixels as keep the shape, up to a limit.
    let pixels = f64::from(columns) * f64::from(image.height()) / f64::from(image.width());
    let rows = ((pixels / 2.0).round() as u32).clamp(1, MOST_ROWS);
    match depth {
        Depth::Letters => letters(&shrunk(image, columns, rows), &mut text),
        Depth::TrueColor | Depth::Palette => half_blocks(&shrunk(image, columns, 2 * rows), depth, &mut text),
    }
    text
}

fn letters(image: &Image<Rgb>, text: &mut String) {
    for row in image.pixels().chunks(image.width() as usize) {
        text.extend(row.iter().map(|light| {
            let shade = srgb::encode(light.luminance()) * LETTERS.len() as f32;
            LETTERS[(shade as usize).min(LETTERS.len() - 1)]
        }));
        text.push('\n');
    }
}

/// Two rows of pixels in one of text: the letters' colour is the upper, the ground's the lower.
fn half_blocks(image: &Image<Rgb>, depth: Depth, text: &mut String) {
    let width = image.width() as usize;
    for pair in image.pixels().chunks(2 * width) {
        let mut current = None;
        let (upper, lower) = pair.split_at(width);
        for (&upper, &lower) in upper.iter().zip(lower) {
            let colors = [upper, lower].map(|light| light.to_array().map(srgb::encode_u8));
            // Said again only where it changes.
            if current != Some(colors) {
                set_colors(colors, depth, text);
                current = Some(colors);
            }
            text.push('▀');
        }
        text.push_str("\x1b[0m\n");
    }
}

/// Select Graphic Rendition of ECMA-48: 38 for letters, 48 for the ground; then 2 and red, green, blue, or 5 and a number.
fn set_colors(colors: [[u8; 3]; 2], depth: Depth, text: &mut String) {
    for (which, [red, green, blue]) in [38, 48].into_iter().zip(colors) {
        let written = match depth {
            Depth::Palette => write!(text, "\x1b[{which};5;{}m", palette::nearest([red, green, blue])),
            _ => write!(text, "\x1b[{which};2;{red};{green};{blue}m"),
        };
        written.expect("a string takes any text");
    }
}

/// The picture at another size, each pixel the mean of those it covers, or the one it lies in if it covers none.
fn shrunk(image: &Image<Rgb>, width: u32, height: u32) -> Image<Rgb> {
    let range = |i: u32, parts: u32, count: u32| {
        let at = |i: u32| (u64::from(i) * u64::from(count) / u64::from(parts)) as u32;
        at(i)..at(i + 1).max(at(i) + 1)
    };
    let pixels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).map(|(x, y)| {
        let (columns, rows) = (range(x, width, image.width()), range(y, height, image.height()));
        let count = columns.len() * rows.len();
        let covered = rows.flat_map(|row| columns.clone().map(move |column| *image.get(column, row)));
        covered.fold(Rgb::BLACK, |sum, light| sum + light) / count as f32
    });
    let pixels = pixels.collect();
    Image::from_pixels(width, height, pixels).expect("one colour for each pixel")
}
