//! The terminal graphics protocol of kitty: a PNG file in escape sequences.

use luch_image::codec::{self, EncodeError, Metadata};
use luch_image::{Image, Rgb, srgb};

/// Most bytes of text in one sequence.
const PIECE: usize = 4096;

/// The bytes that make a terminal with kitty's graphics protocol show a picture of linear light at the cursor.
///
/// # Errors
/// If the picture has no pixels.
pub fn to_kitty(image: &Image<Rgb>) -> Result<Vec<u8>, EncodeError> {
    let bytes = image.map(|light| light.to_array().map(srgb::encode_u8));
    let text = base64(&codec::encode_png8(&bytes, &Metadata::default())?);
    let mut output = Vec::with_capacity(text.len() + 64 + text.len() / 256);
    let mut pieces = text.chunks(PIECE).peekable();
    // a=T: send and show; f=100: a PNG file; m=1: more follows.
    let mut keys = "a=T,f=100,";
    while let Some(piece) = pieces.next() {
        let more = u8::from(pieces.peek().is_some());
        output.extend_from_slice(format!("\x1b_G{keys}m={more};").as_bytes());
        output.extend_from_slice(piece);
        output.extend_from_slice(b"\x1b\\");
        keys = "";
    }
    output.push(b'\n');
    Ok(output)
}

/// RFC 4648, section 4.
fn base64(bytes: &[u8]) -> Vec<u8> {
    const ALPHABET: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = Vec::with_capacity(bytes.len().div_ceil(3) * 4);
    for group in bytes.chunks(3) {
        let byte = |i: usize| u32::from(group.get(i).copied().unwrap_or(0));
        let bits = byte(0) << 16 | byte(1) << 8 | byte(2);
        for i in 0..4 {
            let letter = ALPHABET[(bits >> (18 - 6 * i) & 63) as usize];
            text.push(if i <= group.len() { letter } else { b'=' });
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The test vectors of RFC 4648, section 10.
    #[test]
    fn base64_is_that_of_the_standard() {
        let vectors = [
            ("", ""),
            ("f", "Zg=="),
            ("fo", "Zm8="),
            ("foo", "Zm9v"),
            ("foob", "Zm9vYg=="),
            ("fooba", "Zm9vYmE="),
        ];
        for (bytes, text) in vectors {
            assert_eq!(base64(bytes.as_bytes()), text.as_bytes());
        }
    }

    #[test]
    fn the_pieces_hold_a_png_file() {
        let pixels =
            (0..90_000u32).map(|i| Rgb::gray((i.wrapping_mul(2_654_435_761) >> 8) as f32 / 16_777_216.0));
        let image = Image::from_pixels(300, 300, pixels.collect()).unwrap();
        let output = String::from_utf8(to_kitty(&image).unwrap()).unwrap();
        let pieces: Vec<_> = output.trim_end().split_terminator("\x1b\\").collect();
        assert!(pieces.len() > 3);
        // A PNG file begins with 89 50 4E 47 0D 0A.
        assert!(pieces[0].starts_with("\x1b_Ga=T,f=100,m=1;iVBORw0K"));
        for (i, piece) in pieces.iter().enumerate() {
            let (keys, text) = piece.split_once(';').unwrap();
            assert!(text.len() <= PIECE);
            assert_eq!(keys.ends_with("m=0"), i + 1 == pieces.len());
        }
        assert!(to_kitty(&Image::filled(0, 5, Rgb::BLACK)).is_err());
    }
}
