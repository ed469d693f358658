//! Files of other programs, good and broken, from the test data folder.

use luch_image::Pixels;
use luch_image::codec::{self, DecodeError, Format};
use std::path::{Path, PathBuf};

/// Good pictures with their display window. The same bits as those of OpenEXR 3.5 in every pixel.
const GOOD: [(&str, u32, u32); 21] = [
    ("environments/city.exr", 1024, 512),
    ("environments/interior.exr", 1024, 512),
    ("environments/studio.exr", 1024, 512),
    ("environments/studio.hdr", 1024, 512),
    ("environments/sunset.exr", 1024, 512),
    ("openexr/comp_dwaa_v2.exr", 587, 675),
    ("openexr/lineOrder_decreasing.exr", 237, 119),
    ("openexr/lineOrder_increasing.exr", 237, 119),
    ("openexr/src/test/bin/test_images/WavyLinesLatLong.exr", 1024, 512),
    ("openexr/v1.7.test.1.exr", 217, 197),
    ("openexr-images/DisplayWindow/t01.exr", 400, 300),
    ("openexr-images/DisplayWindow/t02.exr", 400, 300),
    ("openexr-images/DisplayWindow/t03.exr", 370, 280),
    ("openexr-images/TestImages/AllHalfValues.exr", 256, 256),
    ("openexr-images/TestImages/AllHalfValues.jpg", 256, 256),
    ("openexr-images/TestImages/BrightRings.exr", 800, 800),
    ("openexr-images/TestImages/BrightRings.jpg", 800, 800),
    ("openexr-images/TestImages/BrightRingsNanInf.exr", 800, 800),
    ("openexr-images/TestImages/BrightRingsNanInf.jpg", 800, 800),
    ("openexr-images/TestImages/WideFloatRange.exr", 500, 500),
    ("openexr-images/TestImages/WideFloatRange.jpg", 500, 500),
];

/// Good files of kinds that are not read.
const UNSUPPORTED: [&str; 2] = ["openexr/comp_b44.exr", "openexr/src/test/bin/test_images/11.deep.exr"];

fn data_folder() -> Option<PathBuf> {
    let folder = std::env::var_os("LUCH_TEST_DATA")
        .map_or_else(|| Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data"), PathBuf::from);
    if folder.join("image").is_dir() {
        return Some(folder);
    }
    #[expect(clippy::print_stdout, reason = "a test that did not run says so")]
    {
        println!("skipped: no test data");
    }
    None
}

fn files_under(folder: &Path, found: &mut Vec<PathBuf>) {
    let mut entries: Vec<PathBuf> =
        std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    entries.sort();
    for entry in entries {
        if entry.is_dir() { files_under(&entry, found) } else { found.push(entry) }
    }
}

#[test]
fn good_files_decode_and_all_others_say_why_not() {
    let Some(folder) = data_folder().map(|folder| folder.join("image")) else { return };
    let mut files = Vec::new();
    files_under(&folder, &mut files);
    let mut decoded = 0;
    for path in files {
        let bytes = std::fs::read(&path).unwrap();
        let name = path.strip_prefix(&folder).unwrap().to_str().unwrap().replace('\\', "/");
        match (codec::decode(&bytes, None), GOOD.iter().find(|good| good.0 == name)) {
            (Ok(bitmap), Some(good)) => {
                assert_eq!((bitmap.width, bitmap.height), (good.1, good.2), "{name}");
                decoded += 1;
            }
            (Ok(_), None) => panic!("{name} is not among the good files"),
            (Err(error), Some(_)) => panic!("{name}: {error}"),
            (Err(error), None) => {
                let is_unsupported = matches!(error, DecodeError::Unsupported { .. });
                assert!(is_unsupported || !UNSUPPORTED.contains(&name.as_str()), "{name}: {error}");
            }
        }
        drop(codec::decode_exr_layers(&bytes));
        drop(codec::read_metadata(&bytes));
    }
    assert_eq!(decoded, GOOD.len());
}

/// All 65536 bit patterns of a half: 2 infinities and 2046 NaNs among them.
#[test]
fn values_that_are_no_number_stay() {
    let Some(folder) = data_folder() else { return };
    let bytes = std::fs::read(folder.join("image/openexr-images/TestImages/AllHalfValues.exr")).unwrap();
    let Pixels::F32(pixels) = codec::decode(&bytes, None).unwrap().pixels else { panic!("floats") };
    let count = |is: fn(f32) -> bool| pixels.iter().filter(|pixel| is(pixel[0])).count();
    assert_eq!((count(f32::is_nan), count(f32::is_infinite)), (2046, 2));
    let mut finite: Vec<u32> = pixels.iter().filter(|p| p[0].is_finite()).map(|p| p[0].to_bits()).collect();
    finite.sort_unstable();
    finite.dedup();
    assert_eq!(finite.len(), 65536 - 2048);
}

/// The textures of all scenes.
#[test]
fn textures_decode() {
    let Some(folder) = data_folder() else { return };
    let mut files = Vec::new();
    files_under(&folder, &mut files);
    let mut decoded = 0;
    for path in files.iter().filter(|path| !path.starts_with(folder.join("image"))) {
        let extension = path.extension().and_then(|extension| extension.to_str()).unwrap_or_default();
        let Some(format) = Format::from_extension(extension) else { continue };
        let bytes = std::fs::read(path).unwrap();
        // The first bytes must tell the format too: files may be named wrongly.
        let found = Format::from_magic(&bytes);
        let bitmap = codec::decode(&bytes, found.or(Some(format)));
        assert!(bitmap.is_ok(), "{}: {}", path.display(), bitmap.unwrap_err());
        assert!(found.is_some(), "{}", path.display());
        decoded += 1;
    }
    assert!(decoded > 100, "{decoded} textures");
}

/// Small real files of every compression with single bytes changed.
#[test]
fn changed_bytes_in_real_files_do_no_harm() {
    let Some(folder) = data_folder() else { return };
    for (name, ..) in GOOD {
        let bytes = std::fs::read(folder.join("image").join(name)).unwrap();
        if bytes.len() > 80_000 {
            continue;
        }
        for trial in 0..40u32 {
            let hash = trial.wrapping_mul(2_654_435_761) ^ 0x9e37_79b9u32.wrapping_mul(trial >> 2);
            let span = if trial % 2 == 0 { 600.min(bytes.len()) } else { bytes.len() };
            let mut changed = bytes.clone();
            changed[hash as usize % span] ^= 1 << (trial % 8);
            if let Ok(bitmap) = codec::decode(&changed, None) {
                assert!(bitmap.width > 0 && bitmap.memory_bytes() > 0, "{name}");
            }
        }
    }
}
