//! Several views in one picture.

use crate::draw::{check, draw};
use crate::{PreviewError, Size, Style, Subject};
use luch_image::{Image, Rgb};
use luch_scene::Camera;

/// Pixels between two views.
const GAP: u32 = 4;

/// Draws a subject once for each camera, `columns` in a row (as many as there are, if that is fewer; at least one), in the order
/// of reading. Each view has `tile` pixels; the gaps between them, and what is left of the last row, are lighter than the
/// background.
///
/// # Errors
/// As [`draw`], for each view and for the whole; also if there is no camera.
pub fn contact_sheet(
    subject: &Subject,
    cameras: &[Camera],
    tile: Size,
    columns: u32,
    style: &Style,
) -> Result<Image<Rgb>, PreviewError> {
    check(tile, style.antialiasing.factor())?;
    let count = u32::try_from(cameras.len()).unwrap_or(u32::MAX);
    let columns = columns.clamp(1, count.max(1));
    let rows = count.div_ceil(columns);
    let extent = |tiles: u32, side: u32| (side + GAP).saturating_mul(tiles).saturating_sub(GAP);
    let whole = Size { width: extent(columns, tile.width), height: extent(rows, tile.height) };
    check(whole, 1)?;
    let gap = style.background * 0.5 + Rgb::gray(0.15);
    let mut sheet = Image::filled(whole.width, whole.height, gap);
    for (number, camera) in (0..).zip(cameras) {
        let view = draw(subject, camera, tile, style)?.color;
        let (left, top) = (number % columns * (tile.width + GAP), number / columns * (tile.height + GAP));
        for (y, row) in (top..).zip(view.pixels().chunks(tile.width as usize)) {
            let start = y as usize * whole.width as usize + left as usize;
            sheet.pixels_mut()[start..start + row.len()].copy_from_slice(row);
        }
    }
    Ok(sheet)
}
