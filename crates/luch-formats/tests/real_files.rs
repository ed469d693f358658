//! Mesh files of other projects: each gives a sound scene, or an error that says in which file and where.
#![expect(clippy::print_stderr, reason = "a test says that it skipped its work")]

use luch_formats::{Place, load};
use std::path::{Path, PathBuf};

/// The folder of test data, if there is one.
fn data() -> Option<PathBuf> {
    let folder = match std::env::var_os("LUCH_TEST_DATA") {
        Some(folder) => PathBuf::from(folder),
        None => Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data"),
    };
    folder.is_dir().then_some(folder)
}

fn files_under(folder: &Path, found: &mut Vec<PathBuf>) {
    let Ok(entries) = std::fs::read_dir(folder) else { return };
    for entry in entries.flatten() {
        let path = entry.path();
        if path.is_dir() {
            files_under(&path, found);
        } else if path
            .extension()
            .is_some_and(|e| ["obj", "ply", "stl"].iter().any(|known| e.eq_ignore_ascii_case(known)))
        {
            found.push(path);
        }
    }
}

#[test]
fn every_mesh_file_loads_or_says_what_is_wrong() {
    let Some(data) = data() else {
        eprintln!("skipped: no test data");
        return;
    };
    let mut files = Vec::new();
    files_under(&data.join("mesh"), &mut files);
    files.sort();
    let (mut loaded, mut refused) = (0, Vec::new());
    for path in &files {
        match load(path) {
            Ok(scene) => {
                assert_eq!(scene.scene.problems(), [] as [String; 0], "{}", path.display());
                loaded += 1;
            }
            Err(error) => {
                for problem in &error.problems {
                    assert!(!problem.message.is_empty());
                    // Something in the file, or the file as a whole because it holds no faces.
                    let about_all = problem.place.is_none() && problem.message.contains("no faces");
                    let line_shown = matches!(&problem.place, Some(Place::Text { line, .. }) if *line > 0);
                    let byte_shown = matches!(&problem.place, Some(Place::Byte(_)));
                    let numbers = problem.message.contains("is not finite")
                        || problem.message.contains("from the origin");
                    assert!(about_all || line_shown || byte_shown || numbers, "{error}");
                }
                refused.push(error.to_string());
            }
        }
    }
    assert!(loaded * 10 > files.len() * 7, "only {loaded} of {}:\n{}", files.len(), refused.join("\n"));
}
