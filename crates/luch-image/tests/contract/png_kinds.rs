//! The kinds of PNG that this library reads and does not write.

use crate::pictures::crc;
use luch_image::codec::{self, Format};
use luch_image::{Encoding, Pixels};
use png::{BitDepth, ColorType, Encoder, ScaledFloat};

fn write(
    color: ColorType,
    depth: BitDepth,
    data: &[u8],
    change: impl FnOnce(&mut Encoder<&mut Vec<u8>>),
) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = Encoder::new(&mut bytes, 2, 2);
    encoder.set_color(color);
    encoder.set_depth(depth);
    change(&mut encoder);
    let mut writer = encoder.write_header().unwrap();
    writer.write_image_data(data).unwrap();
    writer.finish().unwrap();
    bytes
}

fn read(bytes: &[u8]) -> (Pixels, bool) {
    let bitmap = codec::decode(bytes, Some(Format::Png)).unwrap();
    assert_eq!((bitmap.width, bitmap.height), (2, 2));
    (bitmap.pixels, bitmap.has_alpha)
}

#[test]
fn gray_of_one_bit_and_of_sixteen() {
    let one = write(ColorType::Grayscale, BitDepth::One, &[0b1000_0000, 0b0100_0000], |_| {});
    let (on, off) = ([255; 4], [0, 0, 0, 255]);
    assert_eq!(read(&one), (Pixels::U8(vec![on, off, off, on]), false));
    let data = [0x12, 0x34, 0xff, 0xff, 0x00, 0x01, 0x80, 0x00].repeat(2);
    let sixteen = write(ColorType::GrayscaleAlpha, BitDepth::Sixteen, &data, |_| {});
    let pair = [[0x1234, 0x1234, 0x1234, 0xffff], [1, 1, 1, 0x8000]];
    assert_eq!(read(&sixteen), (Pixels::U16([pair, pair].concat()), true));
}

#[test]
fn palettes_with_and_without_transparency() {
    const PALETTE: [u8; 9] = [10, 20, 30, 40, 50, 60, 70, 80, 90];
    // Two bits a pixel: 0, 1 and 2, 0.
    let data = [0x10, 0x80];
    let plain = write(ColorType::Indexed, BitDepth::Two, &data, |encoder| encoder.set_palette(&PALETTE[..]));
    let (a, b, c) = ([10, 20, 30, 255], [40, 50, 60, 255], [70, 80, 90, 255]);
    assert_eq!(read(&plain), (Pixels::U8(vec![a, b, c, a]), false));
    let clear = write(ColorType::Indexed, BitDepth::Two, &data, |encoder| {
        encoder.set_palette(&PALETTE[..]);
        encoder.set_trns(&[7u8, 8][..]);
    });
    assert_eq!(read(&clear), (Pixels::U8(vec![[10, 20, 30, 7], [40, 50, 60, 8], c, [10, 20, 30, 7]]), true));
}

#[test]
fn gamma_one_means_linear() {
    for (gamma, encoding) in [(1.0, Encoding::Linear), (0.45455, Encoding::Srgb)] {
        let bytes = write(ColorType::Grayscale, BitDepth::Eight, &[1, 2, 3, 4], |encoder| {
            encoder.set_source_gamma(ScaledFloat::new(gamma));
        });
        assert_eq!(codec::decode(&bytes, None).unwrap().encoding, encoding);
    }
}

/// Made by hand: Adam7 sends the pixels of 2×2 in three passes: first, its right neighbour, then the second row.
#[test]
fn interlaced() {
    let raw = [0, 11, 0, 22, 0, 33, 44];
    let mut data = vec![0x78, 0x01, 1, raw.len() as u8, 0, !(raw.len() as u8), 0xff];
    data.extend(raw);
    // Adler's sum: 1 + all bytes, and the sum of those sums.
    let (mut low, mut high) = (1u32, 0u32);
    for byte in raw {
        low += u32::from(byte);
        high += low;
    }
    data.extend((high << 16 | low).to_be_bytes());
    let mut bytes = b"\x89PNG\r\n\x1a\n".to_vec();
    let header = [0, 0, 0, 2, 0, 0, 0, 2, 8, 0, 0, 0, 1];
    for (name, data) in [(b"IHDR", &header[..]), (b"IDAT", &data), (b"IEND", &[])] {
        bytes.extend((data.len() as u32).to_be_bytes());
        let start = bytes.len();
        bytes.extend(name);
        bytes.extend(data);
        let sum = crc(&bytes[start..]);
        bytes.extend(sum.to_be_bytes());
    }
    let gray = |v| [v, v, v, 255];
    assert_eq!(read(&bytes), (Pixels::U8(vec![gray(11), gray(22), gray(33), gray(44)]), false));
}

#[test]
fn compressed_and_latin_texts_are_read() {
    let bytes = write(ColorType::Grayscale, BitDepth::Eight, &[1, 2, 3, 4], |encoder| {
        encoder.add_text_chunk("Author".to_owned(), "Käthe".to_owned()).unwrap();
        encoder.add_ztxt_chunk("Comment".to_owned(), "snow ".repeat(1000)).unwrap();
    });
    let metadata = codec::read_metadata(&bytes).unwrap();
    assert_eq!(metadata.get("Author"), Some("Käthe"));
    assert_eq!(metadata.get("Comment"), Some("snow ".repeat(1000).as_str()));
}
