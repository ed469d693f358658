//! Pictures and files that the tests share.

use luch_image::codec::{self, Format, Layer, Layers, Metadata};
use luch_image::{Image, Rgb};

/// Numbers from nothing up to 6.9, unrelated from pixel to pixel.
pub(crate) fn random(width: u32, height: u32, seed: u32) -> Image<Rgb> {
    let mut state = seed.wrapping_mul(2_654_435_761) | 1;
    let mut next = || {
        // Marsaglia, "Xorshift RNGs" (2003)
        state ^= state << 13;
        state ^= state >> 17;
        state ^= state << 5;
        (state >> 8) as f32 / 16_777_216.0
    };
    let pixels = (0..width * height).map(|_| Rgb::new(next() * 6.9, next(), next() * next())).collect();
    Image::from_pixels(width, height, pixels).unwrap()
}

/// A picture without edges.
pub(crate) fn smooth(width: u32, height: u32) -> Image<Rgb> {
    let pixels = (0..height)
        .flat_map(|y| (0..width).map(move |x| (x as f32 / width as f32, y as f32 / height as f32)))
        .map(|(x, y)| Rgb::new(0.1 + 0.8 * x * y, 0.2 + 0.6 * x * (1.0 - x), 0.9 - 0.7 * y * y))
        .collect();
    Image::from_pixels(width, height, pixels).unwrap()
}

/// A picture of slopes and steps from 0 to 1 with equal pixels here and there.
pub(crate) fn gradient(width: u32, height: u32) -> Image<Rgb> {
    let at = |i: u32, n: u32| (i * 8 / n.max(8)) as f32 / 8.0 + 0.1 * i as f32 / n as f32;
    let pixels = (0..height)
        .flat_map(|y| (0..width).map(move |x| Rgb::new(at(x, width) * 0.8, at(y, height) * 0.8, 0.5)))
        .collect();
    Image::from_pixels(width, height, pixels).unwrap()
}

/// Every kind of float: signed zero, subnormal, huge, infinite, NaN with a payload.
pub(crate) fn light(width: u32, height: u32) -> Image<Rgb> {
    let odd =
        [-0.0, 1e-45, 3.4e38, f32::INFINITY, f32::NEG_INFINITY, f32::from_bits(0x7fc1_2345), -17.25, 0.1];
    let mut index = 0;
    random(width, height, 99).map(|pixel| {
        index += 1;
        Rgb::new(odd[index % odd.len()], pixel.g, pixel.b)
    })
}

/// The bits of all channels.
pub(crate) fn bits(image: &Image<Rgb>) -> Vec<[u32; 3]> {
    image.pixels().iter().map(|pixel| pixel.to_array().map(f32::to_bits)).collect()
}

/// A small file of every format; those that cannot be written are made by hand.
pub(crate) fn examples(metadata: &Metadata) -> Vec<(Format, Vec<u8>)> {
    let image = gradient(23, 17);
    let eight = image.map(|light| light.to_array().map(luch_image::srgb::encode_u8));
    let sixteen = image.map(|light| light.to_array().map(luch_image::srgb::encode_u16));
    let layers = vec![Layer::from_rgb("", &image), Layer::from_rgb("albedo", &random(23, 17, 4))];
    let layers = Layers { width: 23, height: 17, layers };
    vec![
        (Format::Png, codec::encode_png8(&eight, metadata).unwrap()),
        (Format::Png, codec::encode_png16(&sixteen, metadata).unwrap()),
        (Format::Jpeg, codec::encode_jpeg(&eight, 80, metadata).unwrap()),
        (Format::Hdr, codec::encode_hdr(&image, metadata).unwrap()),
        (Format::Exr, codec::encode_exr(&layers, metadata).unwrap()),
        (Format::Pfm, codec::encode_pfm(&image).unwrap()),
        (Format::Npy, codec::encode_npy(&image).unwrap()),
        (Format::Bmp, bmp(&eight)),
        (Format::Tga, tga(&eight)),
    ]
}

/// A Windows bitmap of 24 bits: lowest row first, blue first, rows of multiples of four bytes.
fn bmp(image: &Image<[u8; 3]>) -> Vec<u8> {
    let mut bytes = bmp_header(image.width(), image.height());
    for row in image.pixels().chunks(image.width() as usize).rev() {
        bytes.extend(row.iter().flat_map(|[r, g, b]| [b, g, r]));
        bytes.resize(bytes.len().next_multiple_of(4) + 2, 0);
        bytes.truncate(54 + (bytes.len() - 54) / 4 * 4);
    }
    bytes
}

fn bmp_header(width: u32, height: u32) -> Vec<u8> {
    let mut bytes = b"BM".to_vec();
    for number in [0, 0, 54, 40, width, height, 1 | 24 << 16, 0, 0, 2835, 2835, 0, 0] {
        bytes.extend(u32::to_le_bytes(number));
    }
    bytes
}

/// A TGA with runs of single pixels, lowest row first, blue first.
fn tga(image: &Image<[u8; 3]>) -> Vec<u8> {
    let mut bytes = tga_header(image.width() as u16, image.height() as u16);
    for row in image.pixels().chunks(image.width() as usize).rev() {
        bytes.extend(row.iter().flat_map(|[r, g, b]| [0x80, *b, *g, *r]));
    }
    bytes
}

fn tga_header(width: u16, height: u16) -> Vec<u8> {
    let mut bytes = vec![0, 0, 10, 0, 0, 0, 0, 0, 0, 0, 0, 0];
    bytes.extend(width.to_le_bytes());
    bytes.extend(height.to_le_bytes());
    bytes.extend([24, 0]);
    bytes
}

/// Files of every format whose header claims a size and whose pixels are missing. JPEG and TGA have 16-bit sides.
pub(crate) fn lying_headers(width: u32, height: u32) -> Vec<(Format, Vec<u8>)> {
    let patch = |mut bytes: Vec<u8>, at: usize, number: &[u8]| {
        bytes[at..at + number.len()].copy_from_slice(number);
        bytes
    };
    let file = |format| examples(&Metadata::new()).into_iter().find(|example| example.0 == format).unwrap().1;
    let find = |bytes: &[u8], text: &[u8]| bytes.windows(text.len()).position(|w| w == text).unwrap();
    let (short_width, short_height) = (width.min(65_535) as u16, height.min(65_535) as u16);

    // PNG: the first chunk, with a sum that fits, then a data chunk of nothing.
    let mut png = file(Format::Png)[..33].to_vec();
    png[16..20].copy_from_slice(&width.to_be_bytes());
    png[20..24].copy_from_slice(&height.to_be_bytes());
    let sum = crc(&png[12..29]);
    png[29..33].copy_from_slice(&sum.to_be_bytes());
    png.extend([0, 0, 0, 0, b'I', b'D', b'A', b'T', 0x35, 0xaf, 0x06, 0x1e]);

    let jpeg = file(Format::Jpeg);
    let frame = find(&jpeg, &[0xff, 0xc0]);
    let jpeg = patch(jpeg, frame + 5, &[short_height.to_be_bytes(), short_width.to_be_bytes()].concat());

    let exr = file(Format::Exr);
    let far = [width - 1, height - 1].map(u32::to_le_bytes).concat();
    let data = find(&exr, b"dataWindow\0box2i\0") + 17 + 4 + 8;
    let display = find(&exr, b"displayWindow\0box2i\0") + 20 + 4 + 8;
    let exr = patch(patch(exr, data, &far), display, &far);

    // The numbers of the other size are blanked out as well.
    let npy = file(Format::Npy)[..128].to_vec();
    let shape = find(&npy, b"(17, 23, 3), }");
    let npy = patch(npy, shape, format!("({height}, {width}, 3), }}").as_bytes());

    vec![
        (Format::Png, png),
        (Format::Jpeg, jpeg),
        (Format::Bmp, bmp_header(width, height)),
        (Format::Tga, tga_header(short_width, short_height)),
        (Format::Hdr, format!("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {height} +X {width}\n").into_bytes()),
        (Format::Exr, exr),
        (Format::Pfm, format!("PF\n{width} {height}\n-1\n").into_bytes()),
        (Format::Npy, npy),
    ]
}

/// The sum of PNG chunks (ISO 3309).
pub(crate) fn crc(bytes: &[u8]) -> u32 {
    let mut sum = !0u32;
    for &byte in bytes {
        sum ^= u32::from(byte);
        for _ in 0..8 {
            sum = if sum & 1 == 1 { sum >> 1 ^ 0xedb8_8320 } else { sum >> 1 };
        }
    }
    !sum
}
