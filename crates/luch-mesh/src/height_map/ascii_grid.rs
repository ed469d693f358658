//! ESRI ASCII grids (`.asc`): real elevations as text.
//!
//! A header of names and values (`ncols`, `nrows`, `xllcorner` or `xllcenter`, `yllcorner` or `yllcenter`, `cellsize`, and
//! perhaps `nodata_value`), then the heights row by row from the north. Some writers give `dx` and `dy` in place of
//! `cellsize`. Points without data become holes.

use std::fmt::Write;

use glam::{DVec2, Vec2};

use super::{HeightField, MAX_POINTS};
use crate::codec::{DecodeError, ErrorKind};
use crate::words::{Word, Words};

/// A grid and where it lies.
#[derive(Clone, Debug, PartialEq)]
pub struct AsciiGrid {
    /// The heights; the size is the extent between the outermost points.
    pub field: HeightField,
    /// The south-west corner of the first cell of the last row, in the units of the file.
    pub corner: DVec2,
}

/// Reads a grid. Heights and cell sizes are taken as metres.
///
/// # Errors
/// Line and column of what is wrong: a name that is unknown or repeated, a number that is none, too few or too many heights.
pub fn decode(bytes: &[u8]) -> Result<AsciiGrid, DecodeError> {
    const NAMES: &str =
        "ncols, nrows, xllcorner, xllcenter, yllcorner, yllcenter, cellsize, dx, dy or nodata_value";
    let mut words = Words::new(bytes);
    let mut header = Header::default();
    let mut last = None;
    while let Some(word) = words.peek() {
        if !word.text[0].is_ascii_alphabetic() || word.text.eq_ignore_ascii_case(b"nan") {
            break;
        }
        last = Some(word);
        let word = words.next(NAMES)?;
        let name = String::from_utf8_lossy(word.text).to_ascii_lowercase();
        let place = match name.as_str() {
            "ncols" | "nrows" => {
                let count = words.count(2, MAX_POINTS / 2, &name)?;
                let place = if name == "ncols" { &mut header.columns } else { &mut header.rows };
                put(place, count, word)?;
                continue;
            }
            "xllcorner" => &mut header.corner[0],
            "yllcorner" => &mut header.corner[1],
            "xllcenter" => &mut header.centre[0],
            "yllcenter" => &mut header.centre[1],
            "cellsize" => &mut header.cell,
            "dx" => &mut header.cell_xy[0],
            "dy" => &mut header.cell_xy[1],
            "nodata_value" => &mut header.no_data,
            _ => return Err(word.wrong(NAMES)),
        };
        let is_size = matches!(name.as_str(), "cellsize" | "dx" | "dy");
        let value_word = words.peek();
        let value = words.number(&format!("a number for {name}"))?;
        if is_size
            && !(value > 0.0 && value < 1e18)
            && let Some(word) = value_word
        {
            return Err(word.wrong(format!("a number above 0 for {name}")));
        }
        put(place, value, word)?;
    }
    let incomplete = |what: &str| DecodeError {
        kind: ErrorKind::Syntax,
        place: last.map_or(crate::codec::Place::Text { line: 1, column: 1 }, |word| word.place),
        found: format!("a header without {what}"),
        expected: "ncols, nrows and cellsize before the heights".into(),
    };
    let columns = header.columns.ok_or_else(|| incomplete("ncols"))?;
    let rows = header.rows.ok_or_else(|| incomplete("nrows"))?;
    let cell = match (header.cell, header.cell_xy) {
        (Some(cell), _) => DVec2::splat(cell),
        (None, [Some(dx), Some(dy)]) => DVec2::new(dx, dy),
        _ => return Err(incomplete("cellsize")),
    };
    if columns * rows > MAX_POINTS {
        return Err(DecodeError {
            kind: ErrorKind::TooLarge,
            ..incomplete(&format!("measure: {columns} × {rows} points, the most is {MAX_POINTS}"))
        });
    }
    // A height takes two bytes at least: a false header cannot ask for more memory than the file has.
    let mut heights = Vec::with_capacity((columns * rows).min(words.rest() as u64 / 2 + 1) as usize);
    for _ in 0..columns * rows {
        let word = words.next("a height")?;
        let text = std::str::from_utf8(word.text).ok();
        let height: f64 = text.and_then(|text| text.parse().ok()).ok_or_else(|| word.wrong("a height"))?;
        let single = height as f32;
        let missing = header.no_data == Some(height) || !single.is_finite();
        heights.push(if missing { f32::NAN } else { single });
    }
    if let Some(word) = words.peek() {
        return Err(word.wrong(format!("the end of the file after {columns} × {rows} heights")));
    }
    let extent = cell * DVec2::new((columns - 1) as f64, (rows - 1) as f64);
    let field = HeightField::new(columns as u32, rows as u32, heights, extent.as_vec2())
        .map_err(|error| DecodeError { found: error.to_string(), ..incomplete("measure") })?;
    let along = |axis: usize| {
        let from_centre = header.centre[axis].map(|centre| centre - cell[axis] / 2.0);
        header.corner[axis].or(from_centre).unwrap_or(0.0)
    };
    Ok(AsciiGrid { field, corner: DVec2::new(along(0), along(1)) })
}

#[derive(Default)]
struct Header {
    columns: Option<u64>,
    rows: Option<u64>,
    corner: [Option<f64>; 2],
    centre: [Option<f64>; 2],
    cell: Option<f64>,
    cell_xy: [Option<f64>; 2],
    no_data: Option<f64>,
}

fn put<T>(place: &mut Option<T>, value: T, word: Word) -> Result<(), DecodeError> {
    match place.replace(value) {
        Some(_) => Err(word.wrong("each name once")),
        None => Ok(()),
    }
}

/// Writes a grid, so that its heights are read back to the last bit. Holes are written as a number below all heights.
pub fn encode(grid: &AsciiGrid) -> String {
    let AsciiGrid { field, corner } = grid;
    let lowest = field.range().map_or(0.0, |[low, _]| low);
    let no_data = if lowest > -9999.0 { -9999.0 } else { f32::MIN };
    let cells = Vec2::new(field.width.saturating_sub(1) as f32, field.height.saturating_sub(1) as f32);
    let cell = field.size.as_dvec2() / cells.as_dvec2();
    let mut text = format!(
        "ncols {}\nnrows {}\nxllcorner {}\nyllcorner {}\n",
        field.width, field.height, corner.x, corner.y
    );
    // Writing to a string cannot fail.
    let _ = if cell.x == cell.y {
        writeln!(text, "cellsize {}", cell.x)
    } else {
        writeln!(text, "dx {}\ndy {}", cell.x, cell.y)
    };
    let _ = writeln!(text, "nodata_value {no_data}");
    for row in field.heights.chunks(field.width.max(1) as usize) {
        let words: Vec<String> =
            row.iter().map(|h| if h.is_finite() { h.to_string() } else { no_data.to_string() }).collect();
        let _ = writeln!(text, "{}", words.join(" "));
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    const SMALL: &str = "ncols 3\nNROWS 2\nxllcorner 10\nyllcorner -5.5\ncellsize 30\nNODATA_value -9999\n1 2 3\n4.5 -9999 6e1\n";

    #[test]
    fn a_small_grid_is_read_and_written() {
        let grid = decode(SMALL.as_bytes()).unwrap();
        assert_eq!((grid.field.width, grid.field.height, grid.field.size), (3, 2, Vec2::new(60.0, 30.0)));
        assert_eq!(grid.corner, DVec2::new(10.0, -5.5));
        assert_eq!(
            (grid.field.at(0, 0), grid.field.at(1, 1), grid.field.at(2, 1)),
            (Some(1.0), None, Some(60.0))
        );
        let again = decode(encode(&grid).as_bytes()).unwrap();
        assert_eq!(format!("{again:?}"), format!("{grid:?}"));
        let centred = SMALL.replace("xllcorner", "xllcenter").replace("cellsize 30", "dx 30 dy 20");
        let centred = decode(centred.as_bytes()).unwrap();
        assert_eq!((centred.corner.x, centred.field.size), (-5.0, Vec2::new(60.0, 20.0)));
    }

    #[test]
    fn errors_say_where() {
        for (from, to, message) in [
            ("4.5", "4,5", "line 8, column 1: found “4,5”, expected a height"),
            (" 6e1", "", "line 9, column 1: found the end of the file, expected a height"),
            (
                "6e1",
                "6e1 7",
                "line 8, column 15: found “7”, expected the end of the file after 3 × 2 heights",
            ),
            (
                "ncols 3",
                "ncols 1",
                "line 1, column 7: found “1”, expected ncols, a whole number from 2 to 16777216",
            ),
            (
                "ncols 3",
                "ncols x",
                "line 1, column 7: found “x”, expected ncols, a whole number from 2 to 16777216",
            ),
            (
                "cellsize 30",
                "cellsize -30",
                "line 5, column 10: found “-30”, expected a number above 0 for cellsize",
            ),
            ("NROWS 2", "ncols 2", "line 2, column 1: found “ncols”, expected each name once"),
            (
                "cellsize 30\n",
                "",
                "line 5, column 1: found a header without cellsize, expected ncols, nrows and cellsize before the heights",
            ),
            (
                "NROWS 2",
                "nrowz 2",
                "line 2, column 1: found “nrowz”, expected ncols, nrows, xllcorner, xllcenter, yllcorner, yllcenter, cellsize, dx, dy or nodata_value",
            ),
        ] {
            let text = SMALL.replace(from, to);
            assert_eq!(decode(text.as_bytes()).unwrap_err().to_string(), message);
        }
        // A header that lies about its size takes no memory.
        let huge = SMALL.replace("ncols 3", "ncols 8000000");
        assert!(decode(huge.as_bytes()).unwrap_err().to_string().contains("expected a height"));
        let huger = huge.replace("NROWS 2", "nrows 8000000");
        assert_eq!(decode(huger.as_bytes()).unwrap_err().kind, ErrorKind::TooLarge);
        assert!(decode(b"").is_err() && decode(b"\0\xff").is_err());
    }
}
