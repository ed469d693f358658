//! Files are written whole or not at all.

use glam::Vec3;
use luch_formats::{SaveError, load, save_image, save_mesh, write_atomically};
use luch_image::codec::{self, Metadata};
use luch_image::tone::Tone;
use luch_image::{Image, Rgb};
use luch_mesh::generate;
use luch_scene::Shape;

#[test]
fn a_file_is_replaced_and_nothing_else_stays() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.bin");
    write_atomically(&path, b"one").unwrap();
    write_atomically(&path, b"two").unwrap();
    assert_eq!(std::fs::read(&path).unwrap(), b"two");
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
}

#[test]
fn a_failure_leaves_the_old_file() {
    let folder = tempfile::tempdir().unwrap();
    let missing = folder.path().join("none").join("a.bin");
    assert!(matches!(write_atomically(&missing, b"x"), Err(SaveError::Disk { .. })));
    // A folder in the place of the file cannot be replaced.
    let taken = folder.path().join("taken");
    std::fs::create_dir(&taken).unwrap();
    assert!(matches!(write_atomically(&taken, b"x"), Err(SaveError::NotPlain { .. })));
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1, "no temporary file stays");
}

#[cfg(unix)]
#[test]
fn others_may_read_what_is_written() {
    use std::os::unix::fs::PermissionsExt;
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.bin");
    write_atomically(&path, b"x").unwrap();
    // As the user's mask has it for any new file.
    let usual = folder.path().join("usual.bin");
    std::fs::write(&usual, b"x").unwrap();
    let mode = |path| std::fs::metadata(path).unwrap().permissions().mode() & 0o777;
    assert_eq!(mode(&path), mode(&usual));
    std::fs::set_permissions(&path, std::fs::Permissions::from_mode(0o600)).unwrap();
    write_atomically(&path, b"y").unwrap();
    assert_eq!(std::fs::metadata(&path).unwrap().permissions().mode() & 0o777, 0o600);
}

#[test]
fn pictures_are_written_in_the_format_of_the_extension() {
    let folder = tempfile::tempdir().unwrap();
    let image = Image::from_pixels(2, 1, vec![Rgb::new(0.25, 0.5, 4.0), Rgb::gray(1.0)]).unwrap();
    for (name, is_exact) in [
        ("a.exr", true),
        ("a.pfm", true),
        ("a.npy", true),
        ("a.hdr", false),
        ("a.png", false),
        ("a.jpg", false),
    ] {
        let path = folder.path().join(name);
        save_image(&path, &image, &Tone::default(), &Metadata::new()).unwrap();
        let read = codec::decode(&std::fs::read(&path).unwrap(), None).unwrap().to_rgb();
        assert_eq!((read.width(), read.height()), (2, 1));
        if is_exact {
            assert_eq!(read.pixels(), image.pixels(), "{name}");
        }
    }
    let error =
        save_image(&folder.path().join("a.bmp"), &image, &Tone::default(), &Metadata::new()).unwrap_err();
    assert!(error.to_string().ends_with("accepted are .png, .jpg, .exr, .hdr, .pfm, .npy"), "{error}");
}

#[test]
fn meshes_read_back() {
    let folder = tempfile::tempdir().unwrap();
    let mesh = generate::cuboid(Vec3::new(1.0, 2.0, 3.0), [2, 1, 1]);
    for name in ["a.obj", "a.ply", "a.stl"] {
        let path = folder.path().join(name);
        save_mesh(&path, &mesh).unwrap();
        let scene = load(&path).unwrap().scene;
        let Shape::Mesh(read) = &*scene.shapes[0] else { panic!() };
        assert_eq!(read.triangles.len(), mesh.triangles.len(), "{name}");
        assert_eq!(luch_mesh::measure::volume(read), 6.0, "{name}");
    }
    assert!(matches!(save_mesh(&folder.path().join("a.txt"), &mesh), Err(SaveError::MeshExtension { .. })));
}
