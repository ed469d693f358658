//! Writes Radiance pictures.

use super::{RUN_WIDTHS, rgbe};
use crate::codec::{EncodeError, Format, Metadata};
use crate::{Image, Rgb};

/// A Radiance picture. Each channel is kept to 1/256 of the largest channel of its pixel; negative and NaN values are
/// written as 0. Each text becomes a comment line `# key=text`, line ends and backslashes escaped as `\n`, `\r`, `\\`.
///
/// # Errors
/// [`EncodeError`] for an empty picture or texts that cannot be stored.
pub fn encode_hdr(image: &Image<Rgb>, metadata: &Metadata) -> Result<Vec<u8>, EncodeError> {
    let (width, height) = (image.width(), image.height());
    EncodeError::check_size(Format::Hdr, width, height, i32::MAX as u32)?;
    metadata.check(Format::Hdr, i32::MAX as usize)?;
    let mut bytes = b"#?RADIANCE\n".to_vec();
    for (key, value) in metadata.iter() {
        let value = value.replace('\\', "\\\\").replace('\n', "\\n").replace('\r', "\\r");
        bytes.extend(format!("# {key}={value}\n").as_bytes());
    }
    bytes.extend(format!("FORMAT=32-bit_rle_rgbe\n\n-Y {height} +X {width}\n").as_bytes());
    for row in image.pixels().chunks_exact(width as usize) {
        let row: Vec<[u8; 4]> = row.iter().map(|&light| rgbe::encode(light)).collect();
        if RUN_WIDTHS.contains(&row.len()) {
            bytes.extend([2, 2, (row.len() >> 8) as u8, row.len() as u8]);
            for channel in 0..4 {
                let channel: Vec<u8> = row.iter().map(|pixel| pixel[channel]).collect();
                write_runs(&channel, &mut bytes);
            }
        } else {
            bytes.extend(row.as_flattened());
        }
    }
    Ok(bytes)
}

/// Runs of at least this many equal bytes are worth their own code.
const SHORTEST_RUN: usize = 4;

/// A count above 128 says how often (less 128) the next byte repeats; one up to 128 how many bytes follow as they are.
fn write_runs(mut rest: &[u8], bytes: &mut Vec<u8>) {
    while let Some(&first) = rest.first() {
        let run = run_length(rest);
        if run >= SHORTEST_RUN {
            bytes.extend([128 + run as u8, first]);
            rest = &rest[run..];
        } else {
            let limit = rest.len().min(128);
            let plain = (1..limit).find(|&at| run_length(&rest[at..]) >= SHORTEST_RUN).unwrap_or(limit);
            bytes.push(plain as u8);
            bytes.extend(&rest[..plain]);
            rest = &rest[plain..];
        }
    }
}

/// How many bytes equal the first, at most 127.
fn run_length(bytes: &[u8]) -> usize {
    bytes.iter().take(127).take_while(|&&b| b == bytes[0]).count()
}
