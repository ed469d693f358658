//! The numbers of chosen channels of one part, as planes that fill the display window.

use super::header::{Part, Window, damaged};
use crate::codec::guard::{Tracked, guarded};
use crate::codec::{DecodeError, Format};
use exr::block::reader::ChunksReader;
use exr::error::Error;
use exr::meta::attribute::{ChannelDescription, SampleType};
use exr::prelude::f16;
use std::cell::Cell;
use std::collections::BTreeSet;

/// Reads the channels for which `is_wanted` holds, in the file's order.
pub(super) fn read_planes(
    bytes: &[u8],
    parts: &[Part],
    part: usize,
    is_wanted: impl Fn(&str) -> bool,
) -> Result<Vec<(String, Vec<f32>)>, DecodeError> {
    let (data, display) = (parts[part].data_window, parts[part].display_window);
    let planes = guarded(Format::Exr, || read_data(bytes, parts, part, is_wanted))?;
    Ok(planes.into_iter().map(|(name, plane)| (name, fill(plane, data, display))).collect())
}

fn read_data(
    bytes: &[u8],
    parts: &[Part],
    part: usize,
    is_wanted: impl Fn(&str) -> bool,
) -> Result<Vec<(String, Vec<f32>)>, DecodeError> {
    let position = Cell::new(0);
    let describe = |error| match error {
        Error::NotSupported(what) => DecodeError::unsupported(Format::Exr, what),
        Error::Invalid(reason) => damaged(position.get() as usize, reason),
        other => damaged(position.get() as usize, other.to_string()),
    };
    let reader = exr::block::read(Tracked::new(bytes, &position), false).map_err(describe)?;
    let window = parts[part].data_window;
    let (width, height) = (window.width as usize, window.height as usize);
    let header = reader.headers().get(part).filter(|header| {
        (header.layer_size.0, header.layer_size.1, reader.headers().len()) == (width, height, parts.len())
    });
    let header = header.ok_or_else(|| damaged(0, "the header can be read in two ways"))?;
    let channels = header.channels.clone();
    let mut planes: Vec<Option<Vec<f32>>> = Vec::new();
    for channel in &channels.list {
        planes.push(is_wanted(&name_of(channel)).then(|| vec![0.0; width * height]));
    }

    // As many chunks are read as there should be; none twice means none is missing. (The crate's own strict check of the
    // table of chunks refuses good files with tiles.)
    let mut seen = BTreeSet::new();
    let chunks = reader
        .filter_chunks(false, |_, _, block| block.layer == part && block.level.0 == 0 && block.level.1 == 0);
    chunks
        .and_then(|chunks| {
            chunks.decompress_sequential(false, |_, block| {
                let (index, place) = (block.index, block.index.pixel_position);
                if index.layer != part
                    || (index.level.0, index.level.1) != (0, 0)
                    || !seen.insert((place.1, place.0))
                {
                    return Err(Error::Invalid(
                        "the table of chunks leads to a chunk twice or to a wrong one".into(),
                    ));
                }
                for line in block.lines(&channels) {
                    let Some(plane) = &mut planes[line.location.channel] else { continue };
                    let start = line.location.position.1 * width + line.location.position.0;
                    let target = plane.get_mut(start..start + line.location.sample_count);
                    let target = target.ok_or(Error::Invalid("a line outside the data window".into()))?;
                    convert(line.value, channels.list[line.location.channel].sample_type, target);
                }
                Ok(())
            })
        })
        .map_err(describe)?;
    let named = channels.list.iter().zip(planes);
    Ok(named.filter_map(|(channel, plane)| Some((name_of(channel), plane?))).collect())
}

/// The name as UTF-8; the crate itself takes each byte for a letter.
fn name_of(channel: &ChannelDescription) -> String {
    String::from_utf8_lossy(channel.name.as_slice()).into_owned()
}

/// Samples in the machine's byte order, as `f32`; whole numbers above 2²⁴ are rounded.
fn convert(samples: &[u8], kind: SampleType, target: &mut [f32]) {
    match kind {
        SampleType::F16 => {
            target
                .iter_mut()
                .zip(samples.as_chunks().0)
                .for_each(|(v, &b)| *v = f16::from_ne_bytes(b).to_f32());
        }
        SampleType::F32 => {
            target.iter_mut().zip(samples.as_chunks().0).for_each(|(v, &b)| *v = f32::from_ne_bytes(b))
        }
        SampleType::U32 => {
            target
                .iter_mut()
                .zip(samples.as_chunks().0)
                .for_each(|(v, &b)| *v = u32::from_ne_bytes(b) as f32);
        }
    }
}

/// A plane of the data window laid into the display window, 0 where it has nothing.
fn fill(plane: Vec<f32>, data: Window, display: Window) -> Vec<f32> {
    if data == display {
        return plane;
    }
    let mut filled = vec![0.0; (display.width * display.height) as usize];
    let left = data.x.max(display.x);
    let right = (data.x + data.width as i64).min(display.x + display.width as i64);
    let top = data.y.max(display.y);
    let bottom = (data.y + data.height as i64).min(display.y + display.height as i64);
    for y in top..bottom {
        if left < right {
            let count = (right - left) as usize;
            let from = ((y - data.y) * data.width as i64 + left - data.x) as usize;
            let to = ((y - display.y) * display.width as i64 + left - display.x) as usize;
            filled[to..to + count].copy_from_slice(&plane[from..from + count]);
        }
    }
    filled
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn windows_overlap_in_every_way() {
        let display = Window { x: 0, y: 0, width: 3, height: 2 };
        let data = |x, y| Window { x, y, width: 2, height: 2 };
        let plane = || vec![1.0, 2.0, 3.0, 4.0];
        assert_eq!(fill(plane(), data(0, 0), display), [1.0, 2.0, 0.0, 3.0, 4.0, 0.0]);
        assert_eq!(fill(plane(), data(-1, 1), display), [0.0, 0.0, 0.0, 2.0, 0.0, 0.0]);
        assert_eq!(fill(plane(), data(2, -1), display), [0.0, 0.0, 3.0, 0.0, 0.0, 0.0]);
        assert_eq!(fill(plane(), data(9, 9), display), [0.0; 6]);
    }
}
