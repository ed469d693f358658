//! Writing files whole or not at all.

use luch_image::codec::{self as image_codec, EncodeError, Layer, Layers, Metadata};
use luch_image::tone::Tone;
use luch_image::{Image, Rgb};
use luch_mesh::TriangleMesh;
use luch_mesh::codec as mesh_codec;
use std::io::Write;
use std::path::{Path, PathBuf};

/// Why a file could not be written.
#[derive(Debug, thiserror::Error)]
pub enum SaveError {
    /// The disk refused.
    #[error("{}: cannot be written: {source}", path.display())]
    Disk {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// The extension is none that can be written.
    #[error("{}: cannot tell the format from the extension; accepted are {accepted}", path.display())]
    Extension {
        /// The file.
        path: PathBuf,
        /// Extensions that can be written.
        accepted: &'static str,
    },
    /// The picture does not fit the format.
    #[error("{}: {source}", path.display())]
    Image {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        source: EncodeError,
    },
}

/// Writes a file so that at any moment, even after a loss of power, either the old or the new content is there.
///
/// The bytes go to a temporary file in the same folder, are forced to the disk and take the file's name at once.
///
/// # Errors
/// If the folder does not exist or the disk refuses; the old file is then untouched.
pub fn write_atomically(path: &Path, bytes: &[u8]) -> Result<(), SaveError> {
    let disk = |source| SaveError::Disk { path: path.to_owned(), source };
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    let mut temporary = tempfile::Builder::new().prefix(".luch-").tempfile_in(folder).map_err(disk)?;
    temporary.write_all(bytes).map_err(disk)?;
    set_permissions(temporary.as_file(), path).map_err(disk)?;
    temporary.as_file().sync_all().map_err(disk)?;
    temporary.persist(path).map_err(|error| disk(error.error))?;
    sync_folder(folder).map_err(disk)
}

/// Temporary files are made for their owner alone; the final file keeps its rights, or gets the usual ones.
#[cfg(unix)]
fn set_permissions(file: &std::fs::File, path: &Path) -> std::io::Result<()> {
    use std::os::unix::fs::PermissionsExt;
    let mode = std::fs::metadata(path).map_or(0o644, |about| about.permissions().mode() & 0o777);
    file.set_permissions(std::fs::Permissions::from_mode(mode))
}

#[cfg(not(unix))]
fn set_permissions(_: &std::fs::File, _: &Path) -> std::io::Result<()> {
    Ok(())
}

/// The new name must reach the disk as well.
#[cfg(unix)]
fn sync_folder(folder: &Path) -> std::io::Result<()> {
    std::fs::File::open(folder)?.sync_all()
}

#[cfg(not(unix))]
fn sync_folder(_: &Path) -> std::io::Result<()> {
    Ok(())
}

/// Writes linear light as a picture, in the format of the extension.
///
/// `.exr`, `.hdr` and `.pfm` keep the light; `.png` and `.jpg` show it as `tone` says, in 8 bits.
///
/// # Errors
/// If the extension is another, the picture is empty or too large for the format, or the disk refuses.
pub fn save_image(
    path: &Path,
    image: &Image<Rgb>,
    tone: &Tone,
    metadata: &Metadata,
) -> Result<(), SaveError> {
    use image_codec::Format;
    let extension = path.extension().and_then(|e| e.to_str()).unwrap_or("");
    let encoded = match Format::from_extension(extension) {
        Some(Format::Exr) => {
            let layers = vec![Layer::from_rgb("", image)];
            image_codec::encode_exr(
                &Layers { width: image.width(), height: image.height(), layers },
                metadata,
            )
        }
        Some(Format::Hdr) => image_codec::encode_hdr(image, metadata),
        Some(Format::Pfm) => image_codec::encode_pfm(image),
        Some(Format::Png) => image_codec::encode_png8(&tone.to_u8(image), metadata),
        Some(Format::Jpeg) => image_codec::encode_jpeg(&tone.to_u8(image), 92, metadata),
        Some(Format::Bmp | Format::Tga) | None => {
            let accepted = ".png, .jpg, .exr, .hdr, .pfm";
            return Err(SaveError::Extension { path: path.to_owned(), accepted });
        }
    };
    let bytes = encoded.map_err(|source| SaveError::Image { path: path.to_owned(), source })?;
    write_atomically(path, &bytes)
}

/// Writes a mesh in the format of the extension: `.obj`, `.ply` (binary) or `.stl` (binary, positions alone).
///
/// # Errors
/// If the extension is another or the disk refuses.
pub fn save_mesh(path: &Path, mesh: &TriangleMesh) -> Result<(), SaveError> {
    let extension = path.extension().and_then(|e| e.to_str()).unwrap_or("");
    let Some(format) = mesh_codec::Format::from_extension(extension) else {
        return Err(SaveError::Extension { path: path.to_owned(), accepted: ".obj, .ply, .stl" });
    };
    let bytes = match format {
        mesh_codec::Format::Obj => mesh_codec::obj::encode(mesh, &Default::default()).into_bytes(),
        mesh_codec::Format::Ply => mesh_codec::ply::encode(mesh, mesh_codec::ply::Encoding::LittleEndian),
        mesh_codec::Format::Stl => mesh_codec::stl::encode_binary(mesh),
    };
    write_atomically(path, &bytes)
}
