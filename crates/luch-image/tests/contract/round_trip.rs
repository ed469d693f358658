//! Pictures and texts come back, the same picture gives the same bytes, and a header that lies fails at once.

use crate::pictures::{self, examples, gradient, light, random, smooth};
use luch_image::codec::{self, DecodeError, EncodeError, Format, Layer, Layers, MAX_PIXELS, Metadata};
use luch_image::compare::compare;
use luch_image::{Bitmap, Encoding, Image, Pixels, Rgb};

fn texts() -> Metadata {
    Metadata::from([
        ("Software", "luch"),
        ("Scene file", "C:\\сцены\\новая стая.kdl"),
        ("lines", "one\ntwo\r\n\\n three = 3\n"),
        ("empty", ""),
        ("snow", "雪 ❄ \u{1f3bf}"),
        ("A long name that needs the long name bit of OpenEXR", "yes"),
    ])
}

fn u8_pixels(bitmap: &Bitmap) -> Vec<u8> {
    let Pixels::U8(pixels) = &bitmap.pixels else { panic!("8 bits expected") };
    pixels.iter().flat_map(|&[r, g, b, _]| [r, g, b]).collect()
}

#[test]
fn png_keeps_every_bit() {
    for (width, height) in [(1, 1), (7, 3), (64, 33)] {
        let eight = random(width, height, 1).map(|light| light.to_array().map(|v| (v * 37.0) as u8));
        let bytes = codec::encode_png8(&eight, &texts()).unwrap();
        let bitmap = codec::decode(&bytes, None).unwrap();
        assert_eq!(u8_pixels(&bitmap), eight.pixels().as_flattened());
        assert_eq!((bitmap.width, bitmap.height, bitmap.encoding), (width, height, Encoding::Srgb));

        let sixteen = random(width, height, 2).map(|light| light.to_array().map(|v| (v * 9973.0) as u16));
        let bytes = codec::encode_png16(&sixteen, &texts()).unwrap();
        let Pixels::U16(pixels) = codec::decode(&bytes, Some(Format::Png)).unwrap().pixels else {
            panic!("16 bits")
        };
        let got: Vec<u16> = pixels.iter().flat_map(|&[r, g, b, _]| [r, g, b]).collect();
        assert_eq!(got, sixteen.pixels().as_flattened());
    }
}

#[test]
fn pfm_and_npy_keep_every_bit() {
    for (width, height) in [(1, 1), (5, 4)] {
        let image = light(width, height);
        for bytes in [codec::encode_pfm(&image).unwrap(), codec::encode_npy(&image).unwrap()] {
            let again = codec::decode(&bytes, None).unwrap();
            assert_eq!(pictures::bits(&again.to_rgb()), pictures::bits(&image));
        }
    }
}

#[test]
fn hdr_keeps_each_channel_to_half_a_step() {
    // 7 is too narrow and 40000 too wide for run lengths.
    for (width, height) in [(1, 1), (7, 5), (8, 5), (300, 4), (40_000, 1)] {
        for image in [random(width, height, 3), gradient(width, height)] {
            let bytes = codec::encode_hdr(&image, &texts()).unwrap();
            let bitmap = codec::decode(&bytes, None).unwrap();
            let again = bitmap.to_rgb();
            for (a, b) in image.pixels().iter().zip(again.pixels()) {
                // 256 steps cover at most twice the largest channel, which may itself be rounded up; half of one.
                let bound = a.max_channel().max(b.max_channel()) / 256.0;
                assert!((*a - *b).map(f32::abs).max_channel() <= bound, "{a:?} {b:?}");
            }
            // What was read is written again with the same bytes.
            assert_eq!(codec::encode_hdr(&again, &texts()).unwrap(), bytes);
        }
    }
}

#[test]
fn jpeg_keeps_a_smooth_picture_to_42_decibel() {
    let image = smooth(120, 77).map(|light| light.to_array().map(luch_image::srgb::encode_u8));
    for (quality, least) in [(100, 50.0), (90, 48.0), (75, 42.0)] {
        let bytes = codec::encode_jpeg(&image, quality, &texts()).unwrap();
        let bitmap = codec::decode(&bytes, None).unwrap();
        let error: f64 = u8_pixels(&bitmap)
            .iter()
            .zip(image.pixels().as_flattened())
            .map(|(&a, &b)| f64::from(a.abs_diff(b)))
            .map(|difference| difference * difference)
            .sum();
        let mean = error / (image.pixels().len() * 3) as f64;
        let psnr = 10.0 * libm::log10(255.0 * 255.0 / mean);
        assert!(psnr > least, "quality {quality}: {psnr} dB");
    }
}

#[test]
fn exr_keeps_every_bit_of_every_layer() {
    let (width, height) = (21, 37);
    let count = (width * height) as usize;
    let plane = |seed| random(width, height, seed).pixels().iter().map(|p| p.g).collect::<Vec<f32>>();
    let layers = Layers {
        width,
        height,
        layers: vec![
            Layer::from_rgb("", &light(width, height)),
            Layer::from_rgb("albedo", &random(width, height, 5)),
            Layer::from_plane("depth", "Z", plane(6)),
            Layer {
                name: "normal".to_owned(),
                channels: ["X", "Y", "Z"]
                    .iter()
                    .zip(7..)
                    .map(|(name, seed)| (name.to_string(), plane(seed)))
                    .collect(),
            },
            Layer::from_plane("samples", "N", (0..count).map(|i| (i * 21_000) as f32).collect()),
            Layer::from_plane("стандартная ошибка", "очень длинное имя канала", plane(10)),
        ],
    };
    let bytes = codec::encode_exr(&layers, &texts()).unwrap();
    let again = codec::decode_exr_layers(&bytes).unwrap();
    assert_eq!((again.width, again.height), (width, height));
    for (a, b) in layers.layers.iter().zip(&again.layers) {
        assert_eq!(a.name, b.name);
        for ((name, values), (other, numbers)) in a.channels.iter().zip(&b.channels) {
            assert_eq!(name, other);
            let bits = |values: &[f32]| values.iter().map(|v| v.to_bits()).collect::<Vec<_>>();
            assert_eq!(bits(values), bits(numbers), "{}.{name}", a.name);
        }
    }
    assert_eq!(again.layers.len(), layers.layers.len());
    // As a plain picture it is the beauty.
    let beauty = codec::decode(&bytes, None).unwrap();
    assert_eq!(pictures::bits(&beauty.to_rgb()), pictures::bits(&light(width, height)));
    assert_eq!(again.rgb("normal").unwrap().get(0, 0).b.to_bits(), plane(9)[0].to_bits());
}

#[test]
fn exr_without_beauty_shows_its_first_coloured_layer() {
    let image = random(4, 4, 1);
    let layers = Layers { width: 4, height: 4, layers: vec![Layer::from_rgb("direct", &image)] };
    let bytes = codec::encode_exr(&layers, &Metadata::new()).unwrap();
    assert_eq!(compare(&codec::decode(&bytes, None).unwrap().to_rgb(), &image).unwrap().mse, 0.0);
}

#[test]
fn texts_come_back_in_order() {
    for (format, bytes) in examples(&texts()) {
        let expected = if format.has_metadata() { texts() } else { Metadata::new() };
        assert_eq!(codec::read_metadata(&bytes).unwrap(), expected, "{format}");
    }
}

#[test]
fn the_same_picture_gives_the_same_bytes() {
    assert_eq!(examples(&texts()), examples(&texts()));
}

#[test]
fn every_format_is_known_by_its_first_bytes() {
    let known = examples(&Metadata::new());
    for (format, bytes) in &known {
        assert_eq!(Format::from_magic(bytes), Some(*format));
        assert_eq!(codec::decode(bytes, None), codec::decode(bytes, Some(*format)));
    }
    for format in Format::ALL {
        assert!(known.iter().any(|(example, _)| *example == format), "no example of {format}");
    }
    let error = codec::decode(b"<svg xmlns=", None).unwrap_err().to_string();
    assert!(error.contains("<svg") && error.contains("PNG, JPEG, BMP, TGA, HDR, EXR, PFM, NPY"), "{error}");
}

#[test]
fn what_cannot_be_written_is_refused() {
    let empty = Image::from_pixels(0, 5, Vec::new()).unwrap();
    let empty8 = Image::from_pixels(0, 5, Vec::new()).unwrap();
    let none = Metadata::new();
    assert!(matches!(codec::encode_pfm(&empty), Err(EncodeError::Size { .. })));
    assert!(matches!(codec::encode_npy(&empty), Err(EncodeError::Size { .. })));
    assert!(matches!(codec::encode_hdr(&empty, &none), Err(EncodeError::Size { .. })));
    assert!(matches!(codec::encode_png8(&empty8, &none), Err(EncodeError::Size { .. })));
    assert!(matches!(codec::encode_jpeg(&empty8, 90, &none), Err(EncodeError::Size { .. })));
    let wide = Image::filled(65_536, 1, [0u8; 3]);
    assert!(matches!(codec::encode_jpeg(&wide, 90, &none), Err(EncodeError::Size { limit: 65_535, .. })));
    let long = Metadata::from([("log", "x".repeat(65_530))]);
    let small = Image::filled(1, 1, [0u8; 3]);
    assert!(matches!(codec::encode_jpeg(&small, 90, &long), Err(EncodeError::Metadata { .. })));

    let plane = |count| vec![0.0; count];
    for (layers, key) in [
        (vec![], "a"),
        (vec![Layer::from_plane("", "R", plane(3))], "a"),
        (vec![Layer::from_plane("", "", plane(4))], "a"),
        (vec![Layer::from_plane("a", "b.c", plane(4))], "a"),
        (vec![Layer::from_plane("a", "Z", plane(4)), Layer::from_plane("a", "Z", plane(4))], "a"),
        (vec![Layer::from_plane("a", "Z", plane(4))], "dataWindow"),
    ] {
        let layers = Layers { width: 2, height: 2, layers };
        assert!(codec::encode_exr(&layers, &Metadata::from([(key, "x")])).is_err(), "{layers:?}");
    }
}

/// Headers of 100000×100000 (more than is ever decoded) and of 16000×16000 (allowed, but not in so few bytes).
#[test]
fn a_lying_header_fails_at_once() {
    for (width, height) in [(100_000u32, 100_000u32), (16_000, 16_000)] {
        for (format, mut bytes) in pictures::lying_headers(width, height) {
            bytes.resize(bytes.len() + 50, 0);
            let error = codec::decode(&bytes, Some(format)).unwrap_err();
            let is_about_size = match &error {
                DecodeError::TooLarge { width, height, channels, .. } => {
                    width * height * channels.max(&4) > 4 * MAX_PIXELS
                }
                DecodeError::Damaged { reason, .. } => {
                    reason.contains("cannot be coded")
                        || reason.contains("ends")
                        || reason.contains("too large")
                }
                _ => false,
            };
            assert!(is_about_size, "{format} {width}×{height}: {error}");
        }
    }
}

#[test]
fn light_survives_a_bitmap() {
    let image = light(3, 3);
    assert_eq!(pictures::bits(&Bitmap::from_rgb(&image).to_rgb()), pictures::bits(&image));
    assert_eq!(image.map(|p: &Rgb| *p).width(), 3);
}
