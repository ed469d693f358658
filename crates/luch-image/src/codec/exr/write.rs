//! Writes layers as one part of 32-bit floats, ZIP compressed.

use super::header::read_parts;
use crate::codec::{EncodeError, Format, Layers, Metadata};
use exr::image::write::WritableImage;
use exr::image::{AnyChannel, AnyChannels, Encoding, FlatSamples, Image, Layer};
use exr::meta::attribute::Text;
use exr::prelude::{LayerAttributes, SmallVec};
use std::io::Cursor;

/// Attributes that the format gives a meaning of its own.
const RESERVED: [&str; 16] = [
    "channels",
    "chromaticities",
    "chunkCount",
    "compression",
    "dataWindow",
    "displayWindow",
    "envmap",
    "lineOrder",
    "maxSamplesPerPixel",
    "name",
    "pixelAspectRatio",
    "screenWindowCenter",
    "screenWindowWidth",
    "tiles",
    "type",
    "version",
];

/// Names longer than 31 bytes must be announced by this bit of the version field.
const LONG_NAMES: u8 = 1 << 2;
const SHORT_NAME: usize = 31;
const LONGEST_NAME: usize = 255;

pub(super) fn is_reserved(name: &str) -> bool {
    RESERVED.contains(&name) || name == "view"
}

/// An OpenEXR file of one part with 32-bit float channels `layer.channel` (`R`, `G`, `B` for the layer `""`), ZIP
/// compressed, every bit kept. Each text becomes an attribute of type `string`, in order. Sample counts are floats
/// too, exact up to 2²⁴.
///
/// # Errors
/// [`EncodeError`] for an empty picture, a channel of the wrong length or with a bad or repeated name, or texts that
/// cannot be stored.
pub fn encode_exr(layers: &Layers, metadata: &Metadata) -> Result<Vec<u8>, EncodeError> {
    let (width, height) = (layers.width, layers.height);
    EncodeError::check_size(Format::Exr, width, height, i32::MAX as u32)?;
    metadata.check(Format::Exr, i32::MAX as usize)?;
    if let Some((key, _)) = metadata.iter().find(|(key, _)| is_reserved(key)) {
        let reason = "OpenEXR gives this name a meaning of its own".to_owned();
        return Err(EncodeError::Metadata { format: Format::Exr, key: key.to_owned(), reason });
    }
    let channels = collect_channels(layers)?;
    let names_are_short = channels.iter().all(|channel| channel.name.as_slice().len() <= SHORT_NAME)
        && metadata.iter().all(|(key, _)| key.len() <= SHORT_NAME);
    let encoding = Encoding::SMALL_LOSSLESS;
    let size = (width as usize, height as usize);
    let layer = Layer::new(size, LayerAttributes::default(), encoding, AnyChannels::sort(channels));
    let mut plain = Cursor::new(Vec::new());
    Image::from_layer(layer)
        .write()
        .non_parallel()
        .to_buffered(&mut plain)
        .map_err(|error| EncodeError::refused(Format::Exr, error))?;
    add_attributes(plain.into_inner(), metadata, names_are_short)
}

fn collect_channels(layers: &Layers) -> Result<SmallVec<[AnyChannel<FlatSamples>; 4]>, EncodeError> {
    let pixels = layers.width as usize * layers.height as usize;
    let mut names = std::collections::BTreeSet::new();
    let mut channels = SmallVec::new();
    for layer in &layers.layers {
        for (channel, plane) in &layer.channels {
            let name =
                if layer.name.is_empty() { channel.clone() } else { format!("{}.{channel}", layer.name) };
            let refuse = |reason: String| Err(EncodeError::Channel { channel: name.clone(), reason });
            if plane.len() != pixels {
                return refuse(format!("it holds {} numbers, the picture {pixels} pixels", plane.len()));
            }
            if channel.is_empty() || channel.contains('.') || name.len() > LONGEST_NAME || name.contains('\0')
            {
                return refuse(format!(
                    "a channel's name is neither empty nor holds a dot or NUL, and has at most {LONGEST_NAME} bytes with its layer's"
                ));
            }
            if !names.insert(name.clone()) {
                return refuse("the name occurs twice".to_owned());
            }
            let text = Text::from_bytes_unchecked(name.as_bytes().into());
            channels.push(AnyChannel::new(text, FlatSamples::F32(plane.clone())));
        }
    }
    if channels.is_empty() {
        let reason = "the picture has no channel at all".to_owned();
        return Err(EncodeError::Channel { channel: String::new(), reason });
    }
    Ok(channels)
}

/// Puts the texts at the end of the header and moves the table of chunks accordingly. (Given to the crate, they would
/// come out in the order of a hash map, another one each time.)
fn add_attributes(
    plain: Vec<u8>,
    metadata: &Metadata,
    names_are_short: bool,
) -> Result<Vec<u8>, EncodeError> {
    let parts = read_parts(&plain).map_err(|error| EncodeError::refused(Format::Exr, error))?;
    let end = parts[0].end;
    let chunks =
        parts[0].attributes.iter().find(|a| a.name == "chunkCount").and_then(|a| a.value.first_chunk());
    let chunks = chunks.map_or(0, |&count| u32::from_le_bytes(count) as usize);
    let mut bytes = plain[..end].to_vec();
    for (key, value) in metadata.iter() {
        bytes.extend(key.as_bytes());
        bytes.extend(b"\0string\0");
        bytes.extend((value.len() as u32).to_le_bytes());
        bytes.extend(value.as_bytes());
    }
    let moved = (bytes.len() - end) as u64;
    let table = end + 1..end + 1 + chunks * 8;
    bytes.push(0);
    for entry in plain[table.clone()].as_chunks().0 {
        bytes.extend((u64::from_le_bytes(*entry) + moved).to_le_bytes());
    }
    bytes.extend(&plain[table.end..]);
    if !names_are_short {
        bytes[5] |= LONG_NAMES;
    }
    Ok(bytes)
}
