//! The array file of NumPy: a header that is a Python dictionary, then the numbers, top row first.
//!
//! Written as version 1.0, `float32`, little-endian, C order, of shape (height, width, 3): the bytes that `numpy.save` writes for the
//! same array. Read are versions 1 to 3, floats of 32 and 64 bits in either byte order, of shape (height, width) or (height, width, 1),
//! which is gray, (height, width, 3), or (height, width, 4), whose last channel is alpha.
//!
//! Source: "The NPY format", NumPy reference.

mod header;

use super::guard::check_size;
use super::{DecodeError, EncodeError, Format};
use crate::{Bitmap, Encoding, Image, Pixels, Rgb};
use header::{Header, Number};

/// How every file starts.
pub(super) const MAGIC: &[u8] = b"\x93NUMPY";

/// NumPy aligns the numbers to this many bytes.
const ALIGNMENT: usize = 64;

/// The picture; numbers of 32 bits with every bit as stored, those of 64 bits rounded.
pub(super) fn decode(bytes: &[u8]) -> Result<Bitmap, DecodeError> {
    let header = Header::read(bytes)?;
    if header.is_column_major {
        return Err(DecodeError::unsupported(Format::Npy, "an array in Fortran order"));
    }
    let (height, width, channels) = match header.shape[..] {
        [height, width] => (height, width, 1),
        [height, width, channels @ (1 | 3 | 4)] => (height, width, channels as usize),
        _ => {
            let what = format!(
                "an array of shape {:?}; accepted are (height, width), also with 1, 3 or 4 channels",
                header.shape
            );
            return Err(DecodeError::unsupported(Format::Npy, what));
        }
    };
    check_size(Format::Npy, width, height, channels as u64, bytes.len(), 1)?;

    let (width, height) = (width as usize, height as usize);
    let size = header.number.bytes();
    let needed = width * height * channels * size;
    let data = &bytes[header.end..];
    if data.len() < needed {
        let reason = format!("the file ends after {} of {needed} bytes of numbers", data.len());
        return Err(DecodeError::damaged_at(Format::Npy, bytes.len(), reason));
    }
    let mut numbers = data[..needed].chunks_exact(size).map(|bytes| header.number.read(bytes));
    let mut next = || numbers.next().unwrap_or_default();
    let mut pixels = Vec::with_capacity(width * height);
    for _ in 0..width * height {
        let r = next();
        let (g, b) = if channels >= 3 { (next(), next()) } else { (r, r) };
        let alpha = if channels == 4 { next() } else { 1.0 };
        pixels.push([r, g, b, alpha]);
    }
    Ok(Bitmap {
        width: width as u32,
        height: height as u32,
        pixels: Pixels::F32(pixels),
        encoding: Encoding::Linear,
        has_alpha: channels == 4,
    })
}

/// An array of shape (height, width, 3), every bit kept.
///
/// # Errors
/// [`EncodeError::Size`] for an empty picture.
pub fn encode_npy(image: &Image<Rgb>) -> Result<Vec<u8>, EncodeError> {
    let (width, height) = (image.width(), image.height());
    EncodeError::check_size(Format::Npy, width, height, i32::MAX as u32)?;
    let descr = Number::F32Little.descr();
    let mut header =
        format!("{{'descr': '{descr}', 'fortran_order': False, 'shape': ({height}, {width}, 3), }}");
    // Magic, two bytes of version and two of the header's length stand before it, the end of a line after it.
    let before = MAGIC.len() + 4;
    let padded = (before + header.len() + 1).next_multiple_of(ALIGNMENT) - before;
    while header.len() < padded - 1 {
        header.push(' ');
    }
    header.push('\n');

    let mut bytes = Vec::with_capacity(before + padded + image.pixels().len() * 12);
    bytes.extend(MAGIC);
    bytes.extend([1, 0]);
    bytes.extend((padded as u16).to_le_bytes());
    bytes.extend(header.as_bytes());
    for value in image.pixels().iter().flat_map(|pixel| pixel.to_array()) {
        bytes.extend(value.to_le_bytes());
    }
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A file of version 1.0 with this dictionary.
    fn file(dictionary: &str, data: &[u8]) -> Vec<u8> {
        let mut bytes = [MAGIC, &[1, 0], &(dictionary.len() as u16).to_le_bytes()].concat();
        bytes.extend(dictionary.as_bytes());
        bytes.extend(data);
        bytes
    }

    #[test]
    fn the_bytes_are_those_of_numpy() {
        // numpy.save of numpy.arange(6, dtype='<f4').reshape(1, 2, 3), NumPy 2.
        let image = Image::from_pixels(2, 1, vec![Rgb::new(0.0, 1.0, 2.0), Rgb::new(3.0, 4.0, 5.0)]).unwrap();
        let dictionary = "{'descr': '<f4', 'fortran_order': False, 'shape': (1, 2, 3), }";
        let mut expected = file(&format!("{dictionary:<117}\n"), &[]);
        expected.extend((0..6u8).flat_map(|i| f32::from(i).to_le_bytes()));
        assert_eq!(encode_npy(&image).unwrap(), expected);
    }

    #[test]
    fn all_kinds_of_numbers_and_shapes_are_read() {
        let values = [0.5f64, -2.0, 1e-3, 7.0, 0.25, 3.0, 4.0, 1.5];
        let narrow =
            |write: fn(f32) -> [u8; 4]| values.iter().flat_map(|&v| write(v as f32)).collect::<Vec<u8>>();
        let wide = |write: fn(f64) -> [u8; 8]| values.iter().flat_map(|&v| write(v)).collect::<Vec<u8>>();
        let kinds = [
            ("<f4", narrow(f32::to_le_bytes)),
            (">f4", narrow(f32::to_be_bytes)),
            ("<f8", wide(f64::to_le_bytes)),
            (">f8", wide(f64::to_be_bytes)),
        ];
        let expected = values.map(|v| v as f32);
        for (descr, data) in &kinds {
            let read = |shape: &str| {
                let text = format!("{{ \"shape\":({shape}) , 'fortran_order':False,'descr':'{descr}'}}\n");
                decode(&file(&text, data)).unwrap()
            };
            let gray = read("2, 4");
            assert_eq!((gray.width, gray.height, gray.has_alpha), (4, 2, false));
            assert_eq!(gray.raw(2, 1), [expected[6], expected[6], expected[6], 1.0]);
            assert_eq!(read("4,2,1,"), read("4, 2"));
            let colored = read("1, 2, 4");
            assert_eq!((colored.raw(1, 0), colored.has_alpha), (expected[4..].try_into().unwrap(), true));
        }
    }

    #[test]
    fn errors_say_where_and_what() {
        let whole = "{'descr': '<f4', 'fortran_order': False, 'shape': (1, 1, 3), }";
        assert!(decode(&file(whole, &[0; 12])).is_ok());
        for (from, to, part) in [
            ("<f4", "<i4", "numbers of type '<i4'"),
            ("<f4", "|O", "numbers of type '|O'"),
            ("False", "True", "Fortran order"),
            ("False", "0", "byte 44"),
            ("(1, 1, 3)", "(3,)", "[3]; accepted"),
            ("(1, 1, 3)", "(1, 1, 2)", "[1, 1, 2]"),
            ("(1, 1, 3)", "(1, 0, 3)", "empty (0×1)"),
            ("(1, 1, 3)", "(1, -1, 3)", "byte 64"),
            ("(1, 1, 3)", "(1, 99999999999999999999, 3)", "byte 64"),
            ("(1, 1, 3)", "((((1, 1, 3)", "byte 61"),
            ("'shape'", "'form'", "byte 51: unknown key 'form'"),
            ("'fortran_order': False, ", "", "'fortran_order' is missing"),
            ("{", "", "byte 10: expected '{'"),
            ("}", "", "ends"),
            ("}", "} + f()", "after the dictionary"),
            ("'<f4'", "[('r', '<f4')]", "byte 20"),
            ("'<f4'", "'<f4', 'descr': '<f8'", "twice"),
        ] {
            let text = whole.replacen(from, to, 1);
            let message = decode(&file(&text, &[0; 12])).unwrap_err().to_string();
            assert!(message.contains(part), "{text}: {message}");
        }
        let cut = decode(&file(whole, &[0; 11])).unwrap_err().to_string();
        assert!(cut.contains("11 of 12 bytes"), "{cut}");
        let late = [MAGIC, &[9, 0, 0, 0]].concat();
        assert!(decode(&late).unwrap_err().to_string().contains("version 9"));
    }
}
