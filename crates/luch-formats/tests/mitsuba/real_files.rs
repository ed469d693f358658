//! Scenes of other projects: each loads.

use luch_formats::load;
use std::path::{Path, PathBuf};

/// The folder of test data, if there is one.
fn data() -> Option<PathBuf> {
    let folder = match std::env::var_os("LUCH_TEST_DATA") {
        Some(folder) => PathBuf::from(folder),
        None => Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data"),
    }
    .join("mitsuba");
    folder.is_dir().then_some(folder)
}

fn scenes_under(folder: &Path, found: &mut Vec<PathBuf>) {
    let Ok(entries) = std::fs::read_dir(folder) else { return };
    for entry in entries.flatten() {
        let path = entry.path();
        if path.is_dir() {
            scenes_under(&path, found);
        } else if path.extension().is_some_and(|extension| extension == "xml") {
            found.push(path);
        }
    }
}

#[test]
fn every_scene_loads() {
    let Some(data) = data() else {
        eprintln!("skipped: no test data");
        return;
    };
    let mut scenes = Vec::new();
    scenes_under(&data, &mut scenes);
    scenes.sort();
    let mut told = 0;
    for path in &scenes {
        let loaded = load(path).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(loaded.scene.problems(), [] as [String; 0], "{}", path.display());
        for warning in &loaded.warnings {
            // Whatever is not done is told with the file it is in.
            assert!(!warning.message.is_empty() && warning.file.exists(), "{warning}");
        }
        told += loaded.warnings.len();
    }
    eprintln!("{} scenes load, with {told} warnings", scenes.len());
    assert!(!scenes.is_empty());
}
