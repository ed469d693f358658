//! The image formats by name, file extension and first bytes.

use std::fmt;

/// An image file format.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Format {
    /// Portable Network Graphics.
    Png,
    /// JPEG (JFIF or Exif).
    Jpeg,
    /// Windows bitmap; read only.
    Bmp,
    /// Truevision TGA; read only.
    Tga,
    /// Radiance picture, red, green, blue with a shared exponent.
    Hdr,
    /// OpenEXR.
    Exr,
    /// Portable float map.
    Pfm,
    /// Array file of NumPy.
    Npy,
}

impl Format {
    /// Every format.
    pub const ALL: [Format; 8] = [
        Format::Png,
        Format::Jpeg,
        Format::Bmp,
        Format::Tga,
        Format::Hdr,
        Format::Exr,
        Format::Pfm,
        Format::Npy,
    ];

    /// The usual name, in capitals.
    pub fn name(self) -> &'static str {
        match self {
            Format::Png => "PNG",
            Format::Jpeg => "JPEG",
            Format::Bmp => "BMP",
            Format::Tga => "TGA",
            Format::Hdr => "HDR",
            Format::Exr => "EXR",
            Format::Pfm => "PFM",
            Format::Npy => "NPY",
        }
    }

    /// All names, separated by commas, for messages.
    pub fn names() -> String {
        Self::ALL.map(Self::name).join(", ")
    }

    /// File extensions in lower case, the usual one first.
    pub fn extensions(self) -> &'static [&'static str] {
        match self {
            Format::Png => &["png"],
            Format::Jpeg => &["jpg", "jpeg", "jpe", "jfif"],
            Format::Bmp => &["bmp", "dib"],
            Format::Tga => &["tga", "icb", "vda", "vst"],
            Format::Hdr => &["hdr", "pic", "rgbe"],
            Format::Exr => &["exr"],
            Format::Pfm => &["pfm"],
            Format::Npy => &["npy"],
        }
    }

    /// The format of a file extension, with or without the dot, in any case.
    pub fn from_extension(extension: &str) -> Option<Format> {
        let extension = extension.strip_prefix('.').unwrap_or(extension).to_ascii_lowercase();
        Self::ALL.into_iter().find(|format| format.extensions().contains(&extension.as_str()))
    }

    /// The format of a whole file or its beginning. TGA has no mark at its start, so its header must be plausible
    /// in every field, or the file must end with the mark of TGA 2.
    pub fn from_magic(bytes: &[u8]) -> Option<Format> {
        let marks: [(&[u8], Format); 10] = [
            (b"\x89PNG\r\n\x1a\n", Format::Png),
            (b"\xff\xd8\xff", Format::Jpeg),
            (b"BM", Format::Bmp),
            (b"#?RADIANCE", Format::Hdr),
            (b"#?RGBE", Format::Hdr),
            (b"\x76\x2f\x31\x01", Format::Exr),
            (b"PF\n", Format::Pfm),
            (b"Pf\n", Format::Pfm),
            (b"PF4\n", Format::Pfm),
            (super::npy::MAGIC, Format::Npy),
        ];
        marks
            .into_iter()
            .find(|(mark, _)| bytes.starts_with(mark))
            .map(|(_, format)| format)
            .or_else(|| is_plausible_tga(bytes).then_some(Format::Tga))
    }

    /// True if this library writes the format.
    pub fn can_write(self) -> bool {
        !matches!(self, Format::Bmp | Format::Tga)
    }

    /// True if a file of the format can carry a [`Metadata`](super::Metadata).
    pub fn has_metadata(self) -> bool {
        matches!(self, Format::Png | Format::Jpeg | Format::Hdr | Format::Exr)
    }
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// Truevision TGA file format specification 2.0, 1989: header fields of table 1, footer of table 3.
fn is_plausible_tga(bytes: &[u8]) -> bool {
    let Some(header) = bytes.first_chunk::<18>() else { return false };
    if bytes.ends_with(b"TRUEVISION-XFILE.\0") {
        return true;
    }
    let (map_kind, image_kind, map_depth, depth) = (header[1], header[2], header[7], header[16]);
    let is_mapped = matches!(image_kind, 1 | 9);
    let kinds_agree = match map_kind {
        0 => !is_mapped && header[3..8] == [0; 5],
        1 => matches!(map_depth, 15 | 16 | 24 | 32),
        _ => false,
    };
    let depth_agrees = match image_kind {
        1 | 9 => matches!(depth, 8 | 16),
        2 | 10 => matches!(depth, 15 | 16 | 24 | 32),
        3 | 11 => matches!(depth, 8 | 16),
        _ => false,
    };
    let has_size = header[12..14] != [0; 2] && header[14..16] != [0; 2];
    kinds_agree && depth_agrees && has_size && header[17] & 0xc0 == 0
}

#[cfg(test)]
mod tests {
    use super::Format;

    #[test]
    fn extensions_find_their_format() {
        for format in Format::ALL {
            for extension in format.extensions() {
                assert_eq!(Format::from_extension(extension), Some(format));
                assert_eq!(Format::from_extension(&format!(".{}", extension.to_uppercase())), Some(format));
            }
        }
        assert_eq!(Format::from_extension("gif"), None);
        assert_eq!(Format::from_extension(""), None);
    }

    #[test]
    fn text_is_no_image() {
        for text in ["", "P", "hello", "<html><head><title>x</title>", "{\"asset\":{\"version\":\"2.0\"}}"] {
            assert_eq!(Format::from_magic(text.as_bytes()), None, "{text}");
        }
    }
}
