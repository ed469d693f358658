//! Writing files whole or not at all.

use luch_image::codec::{self as image_codec, EncodeError, Layer, Layers, Metadata};
use luch_image::tone::Tone;
use luch_image::{Image, Rgb};
use luch_mesh::codec as mesh_codec;
use luch_mesh::{PolygonMesh, TriangleMesh};
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
    /// What has the name cannot be replaced: a folder, a device, a pipe.
    #[error("{}: is {what}, not a plain file, and is not replaced; name a plain file or a new one", path.display())]
    NotPlain {
        /// What has the name.
        path: PathBuf,
        /// What it is.
        what: &'static str,
    },
    /// The extension is none of a mesh format.
    #[error("{}: cannot tell the mesh format from the extension{advice}; accepted are {accepted}", path.display())]
    MeshExtension {
        /// The file.
        path: PathBuf,
        /// The extension that was perhaps meant, as `; did you mean .obj?`, or nothing.
        advice: String,
        /// Extensions that can be written.
        accepted: String,
    },
    /// The mesh cannot be written.
    #[error("{}: {source}", path.display())]
    Mesh {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        source: luch_mesh::codec::EncodeError,
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
/// The bytes go to a temporary file in the same folder, are forced to the disk and take the file's name at once. A link stays one: the file
/// it leads to is replaced.
///
/// # Errors
/// If the folder does not exist, the disk refuses or what is there is no plain file; it is then untouched.
pub fn write_atomically(path: &Path, bytes: &[u8]) -> Result<(), SaveError> {
    let disk = |source| SaveError::Disk { path: path.to_owned(), source };
    let path = &replaced_file(path)?;
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    let mut temporary = create_temporary(folder, path).map_err(disk)?;
    temporary.write_all(bytes).map_err(disk)?;
    temporary.as_file().sync_all().map_err(disk)?;
    temporary.persist(path).map_err(|error| disk(error.error))?;
    sync_folder(folder).map_err(disk)
}

/// The file that writing to `path` makes or replaces: `path` itself or, if that is a link, what it leads to.
///
/// # Errors
/// If something else than a plain file is there, a link leads nowhere, or the system does not take the name.
pub fn replaced_file(path: &Path) -> Result<PathBuf, SaveError> {
    let disk = |source| SaveError::Disk { path: path.to_owned(), source };
    let is_link = match std::fs::symlink_metadata(path) {
        Ok(about) => about.is_symlink(),
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(path.to_owned()),
        Err(error) => return Err(disk(error)),
    };
    let about = std::fs::metadata(path).map_err(disk)?;
    if !about.is_file() {
        let what = if about.is_dir() { "a folder" } else { "a device or a pipe" };
        return Err(SaveError::NotPlain { path: path.to_owned(), what });
    }
    if is_link { path.canonicalize().map_err(disk) } else { Ok(path.to_owned()) }
}

/// A temporary file with the rights of the file it will replace, or those of any new file.
#[cfg(unix)]
fn create_temporary(folder: &Path, path: &Path) -> std::io::Result<tempfile::NamedTempFile> {
    use std::os::unix::fs::PermissionsExt;
    let old = std::fs::metadata(path).ok().map(|about| about.permissions().mode() & 0o777);
    // The system takes away what the user's mask forbids to new files.
    let rights = std::fs::Permissions::from_mode(old.unwrap_or(0o666));
    let temporary =
        tempfile::Builder::new().prefix(".luch-").permissions(rights.clone()).tempfile_in(folder)?;
    if old.is_some() {
        temporary.as_file().set_permissions(rights)?;
    }
    Ok(temporary)
}

#[cfg(not(unix))]
fn create_temporary(folder: &Path, _: &Path) -> std::io::Result<tempfile::NamedTempFile> {
    tempfile::Builder::new().prefix(".luch-").tempfile_in(folder)
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
/// `.exr`, `.hdr`, `.pfm` and `.npy` keep the light; `.png` and `.jpg` show it as `tone` says, in 8 bits.
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
        Some(Format::Npy) => image_codec::encode_npy(image),
        Some(Format::Png) => image_codec::encode_png8(&tone.to_u8(image), metadata),
        Some(Format::Jpeg) => image_codec::encode_jpeg(&tone.to_u8(image), 92, metadata),
        Some(Format::Bmp | Format::Tga) | None => {
            let accepted = ".png, .jpg, .exr, .hdr, .pfm, .npy";
            return Err(SaveError::Extension { path: path.to_owned(), accepted });
        }
    };
    let bytes = encoded.map_err(|source| SaveError::Image { path: path.to_owned(), source })?;
    write_atomically(path, &bytes)
}

/// Writes a mesh in the format of the extension: `.obj`, `.ply`, `.stl`, `.off`, `.3mf`, `.glb` or `.gltf`; see [`crate::write_mesh`]. Of
/// these only glTF keeps tangents.
///
/// # Errors
/// If the extension is another, the mesh is broken or the disk refuses.
pub fn save_mesh(path: &Path, mesh: &TriangleMesh) -> Result<(), SaveError> {
    use mesh_codec::{Format, gltf};
    let broken = |source| SaveError::Mesh { path: path.to_owned(), source };
    let bytes = match crate::mesh_file::format_to_write(path)? {
        Format::Glb => gltf::encode_binary(mesh, &Default::default()),
        Format::Gltf => gltf::encode_text(mesh, &Default::default()).map(String::into_bytes),
        format => mesh_codec::encode_polygons(&PolygonMesh::from(mesh), format, &Default::default()),
    };
    write_atomically(path, &bytes.map_err(broken)?)
}
