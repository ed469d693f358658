//! Every example of `docs/scene-format.md` loads, without a warning, and every option of the format is in one of them.

use luch_formats::{Files, load_with};
use luch_image::codec::{Metadata, encode_hdr, encode_png8};
use luch_image::{Image, Rgb};
use std::path::{Path, PathBuf};

fn page() -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/scene-format.md");
    std::fs::read_to_string(path).unwrap()
}

/// The words of the mesh workshop have a page of their own.
fn words() -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/mesh-verbs.md");
    page() + &std::fs::read_to_string(path).unwrap()
}

/// The fenced blocks of KDL.
fn examples(page: &str) -> Vec<String> {
    let mut all = Vec::new();
    let mut open: Option<String> = None;
    for line in page.lines() {
        match (&mut open, line) {
            (None, "```kdl") => open = Some(String::new()),
            (Some(_), "```") => all.extend(open.take()),
            (Some(text), line) => *text += &format!("{line}\n"),
            (None, _) => {}
        }
    }
    all
}

/// The files that the examples name.
fn files(example: &str) -> Files {
    let png = encode_png8(&Image::filled(2, 2, [200, 150, 90]), &Metadata::new()).unwrap();
    let hdr = encode_hdr(&Image::filled(8, 4, Rgb::gray(0.7)), &Metadata::new()).unwrap();
    let obj = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n".to_vec();
    let include = b"material \"from include\" { diffuse 0.5 }".to_vec();
    let mut all: Vec<(PathBuf, Vec<u8>)> = vec![
        ("studio.hdr".into(), hdr),
        ("teapot.obj".into(), obj),
        ("materials.kdl".into(), include),
        ("scene.kdl".into(), example.into()),
    ];
    all.extend(["wood", "leaf", "bumps"].map(|name| (format!("textures/{name}.png").into(), png.clone())));
    Files::memory(all)
}

#[test]
fn every_example_loads() {
    let examples = examples(&page());
    assert!(examples.len() >= 9, "{} examples", examples.len());
    for example in examples {
        let loaded =
            load_with(Path::new("scene.kdl"), &files(&example)).unwrap_or_else(|e| panic!("{example}\n{e}"));
        assert_eq!(loaded.warnings, [], "{example}");
        assert!(!loaded.scene.instances.is_empty(), "{example}");
    }
}

/// True if `word` stands in `text` as a whole word.
fn is_word_of(text: &str, word: &str) -> bool {
    let is_part = |c: char| c.is_alphanumeric() || c == '-';
    text.match_indices(word).any(|(at, _)| {
        let (before, after) = (text[..at].chars().next_back(), text[at + word.len()..].chars().next());
        !before.is_some_and(is_part) && !after.is_some_and(is_part)
    })
}

/// What the reader says it accepts is written on the page.
#[test]
fn every_accepted_word_is_documented() {
    let page = words();
    let questions = [
        "nonsense",
        "settings { nonsense }",
        "settings { integrator \"nonsense\" }",
        "settings { integrator \"inspect\" property=\"nonsense\" }",
        "settings { filter \"nonsense\" }",
        "settings { sequence \"nonsense\" }",
        "camera { nonsense }",
        "texture \"t\" { nonsense }",
        "texture \"t\" { image \"a\" nonsense=1 }",
        "texture \"t\" { image \"a\" wrap=\"nonsense\" filter=\"nonsense\" encoding=\"nonsense\" }",
        "material \"m\" { nonsense }",
        "material \"m\" { conductor \"nonsense\" }",
        "material \"m\" { conductor \"gold\" nonsense=1 }",
        "material \"m\" { dielectric nonsense=1 }",
        "material \"m\" { principled nonsense=1 }",
        "material \"m\" { phong nonsense=1 }",
        "material \"m\" { glossy nonsense=1 }",
        "material \"m\" { mix \"a\" \"b\" nonsense=1 }",
        "material \"m\" { diffuse 1 nonsense=1 }",
        "material \"m\" { glossy { glossiness { nonsense 1 } } }",
        "material \"m\" { opacity 1 nonsense=1 }",
        "material \"m\" { emission 1 nonsense=1 }",
        "object { nonsense }",
        "object { mesh { nonsense } }",
        "object { implicit \"x\" nonsense=1 }",
        "object { terrain nonsense=1 }",
        "object { mesh { cone nonsense=1 } }",
        "object { mesh { torus nonsense=1 } }",
        "object { mesh { cuboid nonsense=1 } }",
        "object { mesh { icosphere nonsense=1 } }",
        "point-light { nonsense }",
        "spot-light { nonsense }",
        "sun { nonsense }",
        "environment preset=\"neutral\" nonsense=1",
    ];
    let mut checked = std::collections::BTreeSet::new();
    for question in questions {
        let files = Files::memory([("s.kdl".into(), format!("luch 1\n{question}").into())]);
        let said = load_with(Path::new("s.kdl"), &files).unwrap_err().to_string();
        let lists: Vec<&str> =
            said.lines().filter_map(|line| line.split_once("accepted: ")).map(|(_, list)| list).collect();
        assert!(!lists.is_empty(), "{said}");
        for word in lists.iter().flat_map(|list| list.split(", ")) {
            let word = word.trim_matches(['`', '"']);
            // Long lists are cut.
            if word.starts_with("and ") && word.ends_with(" more") {
                continue;
            }
            assert!(is_word_of(&page, word), "`{word}` is not in the documentation: {question}");
            checked.insert(word.to_owned());
        }
    }
    assert!(checked.len() > 100, "{}", checked.len());
}
