//! Scene files made to do harm, and files that are good but for a few bytes.

use luch_formats::{Files, load_with};
use proptest::prelude::*;
use std::path::{Path, PathBuf};

fn survives(bytes: Vec<u8>) -> bool {
    let files = Files::memory([(PathBuf::from("s.kdl"), bytes)]);
    match load_with(Path::new("s.kdl"), &files) {
        Ok(loaded) => {
            assert!(loaded.scene.problems().is_empty());
            true
        }
        Err(error) => {
            assert!((1..=101).contains(&error.problems.len()));
            for problem in &error.problems {
                assert!(problem.to_string().len() < 4000, "{problem}");
            }
            false
        }
    }
}

fn scene(name: &str) -> String {
    std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes").join(name)).unwrap()
}

/// Words and numbers of the format, good and bad, to be put in the place of others.
const WORDS: [&str; 40] = [
    "0",
    "-1",
    "1e39",
    "-1e39",
    "1e-46",
    "#inf",
    "#-inf",
    "#nan",
    "#true",
    "#null",
    "99999999999999999999",
    "4096",
    "{",
    "}",
    ";",
    "\n",
    "\"",
    "=",
    "\"gold\"",
    "\"floor\"",
    "texture=\"floor\"",
    "material",
    "mesh",
    "object",
    "sphere",
    "scale 1e-9",
    "scale 1e9",
    "emission 1e18",
    "opacity 0.5",
    "mix \"floor\" \"wall\"",
    "plane",
    "include \"s.kdl\"",
    "import \"s.kdl\"",
    "group {",
    "/-",
    "/*",
    "\\",
    "é",
    "sides \"front\"",
    "fov 179.999",
];

proptest! {
    #![proptest_config(ProptestConfig { cases: 1500, failure_persistence: None, rng_seed: proptest::test_runner::RngSeed::Fixed(11), ..ProptestConfig::default() })]

    #[test]
    fn scenes_with_words_changed_are_survived(changes in prop::collection::vec((any::<prop::sample::Index>(), 0..WORDS.len(), 0..3u8), 1..6)) {
        let text = scene("lecture.kdl");
        let mut words: Vec<&str> = text.split_inclusive(&[' ', '\n', ';', '=']).collect();
        for (place, word, way) in changes {
            let place = place.index(words.len());
            match way {
                0 => words[place] = WORDS[word],
                1 => words.insert(place, WORDS[word]),
                _ => { words.remove(place); }
            }
        }
        survives(words.join(" ").into_bytes());
    }

    #[test]
    fn scenes_with_bytes_changed_are_survived(changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..8), cut in any::<prop::sample::Index>()) {
        let mut bytes = scene("materials.kdl").into_bytes();
        for (place, byte) in changes {
            let place = place.index(bytes.len());
            bytes[place] = byte;
        }
        bytes.truncate(cut.index(bytes.len() * 2));
        survives(bytes);
    }
}

#[test]
fn words_are_put_where_they_are_understood() {
    // The mutations above must also produce scenes that load, or they would test the first error only.
    assert!(survives(scene("lecture.kdl").into_bytes()));
    assert!(survives(scene("lecture.kdl").replace("roughness 0.35", "roughness 0.5").into_bytes()));
}

#[test]
fn deep_and_long_texts_end_quickly() {
    for text in [
        format!("luch 1\n{}", "group { ".repeat(100_000)),
        format!("luch 1\n{}{}", "group { ".repeat(40), "}".repeat(40)),
        format!("luch 1\n{}", "object { sphere }\n".repeat(20_000)),
        format!(
            "luch 1\nmaterial \"{}\" {{ diffuse 0.5 }}\nobject {{ sphere; material \"y\" }}",
            "x".repeat(1 << 20)
        ),
        format!("luch 1\nobject {{ sphere; material \"{}\" }}", "x".repeat(1 << 20)),
        format!("luch 1\n{} 1", "x".repeat(1 << 20)),
        format!("luch 1\ncamera {{ from {} }}", "1 ".repeat(200_000)),
        format!("luch 1\nobject {{ {} }}", "translate 1 1 1; ".repeat(100_000)),
    ] {
        survives(text.into_bytes());
    }
}

#[test]
fn placements_that_leave_the_range_of_numbers_are_refused() {
    for text in [
        format!("luch 1\nobject {{ sphere; {} }}", "scale 1e9; ".repeat(9)),
        format!("luch 1\nobject {{ sphere; {} }}", "scale 1e-9; ".repeat(9)),
        format!("luch 1\ngroup {{ {} object {{ sphere; scale 1e9 }} }}", "scale 1e9; ".repeat(4)),
        "luch 1\nobject { sphere; matrix 1 0 0 0  1 0 0 0  0 0 1 0 }".to_owned(),
        "luch 1\nobject { mesh { cuboid; scale 1e9; scale 1e9; scale 1e9; scale 1e9; scale 1e9 } }"
            .to_owned(),
    ] {
        assert!(!survives(text.clone().into_bytes()), "{text}");
    }
}

#[test]
fn forms_of_too_many_triangles_are_refused_before_they_are_made() {
    let text = "luch 1\nobject { mesh { cuboid divisions=4096 } }\n".to_owned();
    let files = Files::memory([(PathBuf::from("s.kdl"), text.into_bytes())]);
    let said = load_with(Path::new("s.kdl"), &files).unwrap_err().to_string();
    assert!(said.contains("s.kdl:2:"), "{said}");
}
