//! Files cut short and files with a byte changed: an error or a picture of the claimed size, never a panic.

use crate::pictures::examples;
use luch_image::codec::{self, Format, Metadata};
use luch_image::{Bitmap, Pixels};
use proptest::prelude::*;
use std::sync::LazyLock;

static FILES: LazyLock<Vec<(Format, Vec<u8>)>> =
    LazyLock::new(|| examples(&Metadata::from([("key", "text"), ("other", "more text")])));

fn is_whole(bitmap: &Bitmap) -> bool {
    let count = match &bitmap.pixels {
        Pixels::U8(p) => p.len(),
        Pixels::U16(p) => p.len(),
        Pixels::F32(p) => p.len(),
    };
    count == bitmap.width as usize * bitmap.height as usize && count > 0
}

/// How many bytes may be missing at the end without the picture being cut: the end chunk of PNG, the end mark of
/// nothing else, and the padding of the last BMP row.
fn spare_bytes(format: Format) -> usize {
    match format {
        Format::Png => 12,
        Format::Bmp => 3,
        _ => 0,
    }
}

#[test]
fn a_cut_file_is_an_error() {
    for (format, bytes) in FILES.iter() {
        let whole = codec::decode(bytes, Some(*format)).unwrap();
        assert!(is_whole(&whole));
        for length in (0..bytes.len()).filter(|i| i % 7 == 0 || *i < 200 || i + 100 > bytes.len()) {
            match codec::decode(&bytes[..length], Some(*format)) {
                Err(error) => assert!(error.to_string().contains(format.name()), "{error}"),
                Ok(bitmap) => {
                    assert!(
                        length + spare_bytes(*format) >= bytes.len(),
                        "{format} cut to {length} of {}",
                        bytes.len()
                    );
                    assert_eq!(bitmap, whole, "{format} cut to {length} of {}", bytes.len());
                }
            }
            // Texts may lie before the cut; nothing may panic.
            drop(codec::read_metadata(&bytes[..length]));
        }
    }
}

#[test]
fn zero_bytes_and_other_formats_are_errors() {
    for format in Format::ALL {
        for (other, bytes) in FILES.iter().filter(|(other, _)| *other != format) {
            assert!(codec::decode(bytes, Some(format)).is_err(), "{other} read as {format}");
        }
        assert!(codec::decode(&[], Some(format)).is_err());
        assert!(codec::decode(&[0; 4096], Some(format)).is_err());
    }
    assert!(codec::decode(&[], None).is_err());
    assert!(codec::decode_exr_layers(&[]).is_err());
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 8000, ..ProptestConfig::default() })]

    #[test]
    fn a_changed_byte_does_no_harm(which in 0..9usize, place in 0.0..1.0f64, early in any::<bool>(), value in any::<u8>()) {
        let (format, mut bytes) = FILES[which].clone();
        // Half of the changes go to the header.
        let span = if early { bytes.len().min(400) } else { bytes.len() };
        let at = (place * span as f64) as usize;
        bytes[at] = value;
        if let Ok(bitmap) = codec::decode(&bytes, Some(format)) {
            prop_assert!(is_whole(&bitmap));
        }
        drop(codec::read_metadata(&bytes));
        if format == Format::Exr {
            drop(codec::decode_exr_layers(&bytes));
        }
    }

    #[test]
    fn noise_after_a_true_beginning_does_no_harm(which in 0..9usize, keep in 2..400usize, noise in prop::collection::vec(any::<u8>(), 0..600)) {
        let (format, bytes) = &FILES[which];
        let mut bytes = bytes[..keep.min(bytes.len())].to_vec();
        bytes.extend(noise);
        if let Ok(bitmap) = codec::decode(&bytes, Some(*format)) {
            prop_assert!(is_whole(&bitmap));
        }
        drop(codec::read_metadata(&bytes));
    }
}
