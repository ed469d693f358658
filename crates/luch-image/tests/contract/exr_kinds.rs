//! The kinds of OpenEXR that this library reads and does not write.

use exr::image::write::WritableImage;
use exr::math::RoundingMode;
use exr::prelude::{
    AnyChannel, AnyChannels, Blocks, Compression, Encoding, FlatSamples, Image, ImageAttributes,
    IntegerBounds, Layer, LayerAttributes, Levels, LineOrder, SmallVec, Vec2, f16,
};
use luch_image::codec::{self, DecodeError};
use std::io::Cursor;

const SIZE: (usize, usize) = (70, 45);
const COUNT: usize = SIZE.0 * SIZE.1;

fn numbers(seed: usize) -> impl Iterator<Item = f32> {
    (0..COUNT).map(move |i| ((i * (seed + 3)) % 97) as f32 / 8.0)
}

fn encoding(compression: Compression, blocks: Blocks) -> Encoding {
    Encoding { compression, blocks, line_order: LineOrder::Increasing }
}

fn channels() -> AnyChannels<FlatSamples> {
    let list: SmallVec<[_; 4]> = [
        AnyChannel::new("R", FlatSamples::F32(numbers(0).collect())),
        AnyChannel::new("G", FlatSamples::F16(numbers(1).map(f16::from_f32).collect())),
        AnyChannel::new("B", FlatSamples::U32(numbers(2).map(|v| v as u32).collect())),
    ]
    .into_iter()
    .collect();
    AnyChannels::sort(list)
}

/// Every lossless compression, in lines and in tiles, with floats, halves and whole numbers in one picture.
#[test]
fn lossless_compressions_in_lines_and_tiles() {
    use Compression::{PIZ, RLE, Uncompressed, ZIP1, ZIP16};
    for compression in [Uncompressed, RLE, ZIP1, ZIP16, PIZ] {
        for blocks in [Blocks::ScanLines, Blocks::Tiles(Vec2(16, 32))] {
            let layer =
                Layer::new(SIZE, LayerAttributes::default(), encoding(compression, blocks), channels());
            let mut bytes = Cursor::new(Vec::new());
            Image::from_layer(layer).write().non_parallel().to_buffered(&mut bytes).unwrap();
            let bitmap = codec::decode(&bytes.into_inner(), None).unwrap();
            let expected = numbers(0).zip(numbers(1)).zip(numbers(2)).map(|((r, g), b)| [r, g, b.floor()]);
            for (got, expected) in bitmap.to_rgb().pixels().iter().zip(expected) {
                assert_eq!(got.to_array(), expected, "{compression} {blocks:?}");
            }
        }
    }
}

#[test]
fn the_largest_level_of_a_mip_map_is_the_picture() {
    let (mut width, mut height) = SIZE;
    let mut levels = vec![FlatSamples::F32(numbers(0).collect())];
    while width > 1 || height > 1 {
        (width, height) = ((width / 2).max(1), (height / 2).max(1));
        levels.push(FlatSamples::F32(vec![-1.0; width * height]));
    }
    let channel = AnyChannel::new("Y", Levels::Mip { rounding_mode: RoundingMode::Down, level_data: levels });
    let blocks = Blocks::Tiles(Vec2(16, 16));
    let channels = AnyChannels::sort([channel].into_iter().collect());
    let layer = Layer::new(SIZE, LayerAttributes::default(), encoding(Compression::ZIP16, blocks), channels);
    let mut bytes = Cursor::new(Vec::new());
    Image::from_layer(layer).write().non_parallel().to_buffered(&mut bytes).unwrap();
    let image = codec::decode(&bytes.into_inner(), None).unwrap().to_rgb();
    for (got, expected) in image.pixels().iter().zip(numbers(0)) {
        assert_eq!(got.to_array(), [expected; 3]);
    }
}

/// The second part has the colour; parts name the layers.
#[test]
fn several_parts() {
    let attributes = ImageAttributes::new(IntegerBounds::from_dimensions(SIZE));
    let scan_lines = encoding(Compression::ZIP16, Blocks::ScanLines);
    let depth = AnyChannel::new("Z", FlatSamples::F32(numbers(7).collect()));
    let depth = AnyChannels::sort([depth].into_iter().collect());
    let mut image = Image::empty(attributes)
        .with_layer(Layer::new(SIZE, LayerAttributes::named("depth"), scan_lines, depth))
        .with_layer(Layer::new(SIZE, LayerAttributes::named("paint"), scan_lines, channels()));
    image.attributes.pixel_aspect = 1.0;
    let mut bytes = Cursor::new(Vec::new());
    image.write().non_parallel().to_buffered(&mut bytes).unwrap();
    let bytes = bytes.into_inner();
    let picture = codec::decode(&bytes, None).unwrap().to_rgb();
    assert!(picture.pixels().iter().zip(numbers(0)).all(|(got, expected)| got.r == expected));
    let layers = codec::decode_exr_layers(&bytes).unwrap();
    assert_eq!(layers.layers.iter().map(|layer| layer.name.as_str()).collect::<Vec<_>>(), ["", "paint"]);
    assert_eq!(layers.layer("").unwrap().channel("Z").unwrap(), numbers(7).collect::<Vec<_>>());
    assert_eq!(layers.rgb("paint").unwrap(), picture);
}

/// Four pixels must not ask for gigabytes by a display window of 16000×16000.
#[test]
fn a_huge_frame_around_a_small_picture_is_refused() {
    let channel = AnyChannel::new("Y", FlatSamples::F32(vec![1.0; 4]));
    let channels = AnyChannels::sort([channel].into_iter().collect());
    let layer = Layer::new((2, 2), LayerAttributes::default(), Encoding::SMALL_LOSSLESS, channels);
    for (side, is_read) in [(1920, true), (16_000, false)] {
        let attributes = ImageAttributes::new(IntegerBounds::from_dimensions((side, side)));
        let mut bytes = Cursor::new(Vec::new());
        Image::new(attributes, layer.clone()).write().non_parallel().to_buffered(&mut bytes).unwrap();
        match codec::decode(&bytes.into_inner(), None) {
            Ok(bitmap) => {
                assert_eq!((bitmap.width as usize, bitmap.average()[0] > 0.0, is_read), (side, true, true))
            }
            Err(error) => assert!(matches!(error, DecodeError::Unsupported { .. }) && !is_read, "{error}"),
        }
    }
}
