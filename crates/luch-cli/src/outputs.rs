//! The files that are asked for.

use crate::display::Display;
use crate::failure::Failure;
use crate::film_file;
use crate::interrupt::Pen;
use crate::same_file::{folder_of, place};
use luch::formats::{SaveError, replaced_file, write_atomically};
use luch::image::codec::{self, EncodeError, Format, Layer, Layers, Metadata};
use luch::image::{Image, Rgb};
use std::path::{Path, PathBuf};

/// Quality of JPEG, of 100: artefacts are hard to find.
const JPEG_QUALITY: u8 = 92;

/// What a file holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Picture(Format),
    Film,
}

/// A file to be written.
#[derive(Clone, Debug)]
pub(crate) struct Output {
    pub(crate) path: PathBuf,
    kind: Kind,
}

/// Files to be written, found to be writable.
#[derive(Clone, Debug)]
pub(crate) struct Outputs {
    files: Vec<Output>,
    png_is_deep: bool,
}

/// What goes into pictures.
pub(crate) struct Content<'a> {
    pub(crate) image: &'a Image<Rgb>,
    pub(crate) layers: Vec<Layer>,
    pub(crate) display: Display,
    pub(crate) metadata: &'a Metadata,
}

impl Outputs {
    /// Outputs by their extensions; `depth` is that of PNG.
    pub(crate) fn new(paths: &[PathBuf], depth: u8) -> Result<Self, Failure> {
        let png_is_deep = match depth {
            8 => false,
            16 => true,
            _ => return Err(Failure::usage(format!("PNG has 8 or 16 bits a channel, not {depth}"))),
        };
        let mut files: Vec<Output> = Vec::new();
        for path in paths {
            if files.iter().any(|file| place(&file.path) == place(path)) {
                return Err(Failure::usage(format!("{} is to be written twice", path.display())));
            }
            files.push(Output { path: path.clone(), kind: kind_of(path)? });
        }
        Ok(Self { files, png_is_deep })
    }

    /// The first file.
    pub(crate) fn first(&self) -> Option<&Path> {
        self.files.first().map(|file| file.path.as_path())
    }

    /// Paths of the pictures, that is of all files but films.
    pub(crate) fn pictures(&self) -> impl Iterator<Item = &Output> {
        self.files.iter().filter(|file| file.kind != Kind::Film)
    }

    /// Paths of the films.
    pub(crate) fn films(&self) -> impl Iterator<Item = &Path> {
        self.files.iter().filter(|file| file.kind == Kind::Film).map(|file| file.path.as_path())
    }

    /// Whether any file can hold layers.
    pub(crate) fn have_layers(&self) -> bool {
        self.files.iter().any(|file| file.kind == Kind::Picture(Format::Exr))
    }

    /// Writes one picture whole or not at all.
    pub(crate) fn write(&self, output: &Output, content: &Content<'_>, pen: &Pen) -> Result<(), SaveError> {
        let Kind::Picture(format) = output.kind else { return Ok(()) };
        let bytes = self
            .encode(format, content)
            .map_err(|source| SaveError::Image { path: output.path.clone(), source })?;
        let _held = pen.hold();
        write_atomically(&output.path, &bytes)
    }

    fn encode(&self, format: Format, content: &Content<'_>) -> Result<Vec<u8>, EncodeError> {
        let Content { image, layers, display, metadata } = content;
        match format {
            Format::Png if self.png_is_deep => codec::encode_png16(&display.to_u16(image), metadata),
            Format::Png => codec::encode_png8(&display.to_u8(image), metadata),
            Format::Jpeg => codec::encode_jpeg(&display.to_u8(image), JPEG_QUALITY, metadata),
            Format::Hdr => codec::encode_hdr(image, metadata),
            Format::Pfm => codec::encode_pfm(image),
            Format::Npy => codec::encode_npy(image),
            Format::Exr | Format::Bmp | Format::Tga => {
                let mut all = vec![Layer::from_rgb("", image)];
                all.extend(layers.iter().cloned());
                codec::encode_exr(
                    &Layers { width: image.width(), height: image.height(), layers: all },
                    metadata,
                )
            }
        }
    }
}

fn kind_of(path: &Path) -> Result<Kind, Failure> {
    let extension = path.extension().and_then(|extension| extension.to_str()).unwrap_or("");
    if film_file::is_film(path) {
        return Ok(Kind::Film);
    }
    match Format::from_extension(extension) {
        Some(format) if format.can_write() => Ok(Kind::Picture(format)),
        _ => Err(Failure::usage(format!(
            "{}: cannot tell the format from the extension; accepted are .png, .jpg, .exr, .hdr, .pfm, .npy, .luch",
            path.display()
        ))),
    }
}

/// Makes sure that a file can be written, before hours of work depend on it: its folder takes files, nothing but a
/// plain file has its name, and a film replaces nothing but a film.
pub(crate) fn probe(path: &Path) -> Result<(), Failure> {
    let target = replaced_file(path)?;
    if film_file::is_film(path) {
        film_file::refuse_replacing_others(path)?;
    }
    let folder = folder_of(&target);
    if !folder.is_dir() {
        return Err(Failure::new(format!(
            "{}: the folder {} does not exist",
            path.display(),
            folder.display()
        )));
    }
    let trial = folder.join(format!(".luch-trial-{}", std::process::id()));
    let written = std::fs::write(&trial, b"luch").and_then(|()| std::fs::remove_file(&trial));
    written.map_err(|error| {
        Failure::new(format!("{}: nothing can be written into {}: {error}", path.display(), folder.display()))
    })
}
