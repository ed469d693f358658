//! What the user reads when a scene file is wrong: the exact words, with line, column and advice.
//!
//! `tests/errors.txt` holds texts after `>>>` and what is said about them. With `LUCH_BLESS=1` in the environment the test
//! writes that file anew; read the difference before keeping it.

use luch_formats::{Files, LoadError, load_with};
use std::path::{Path, PathBuf};

/// Loads `main.kdl` of files in memory.
fn fails(files: &[(&str, &str)]) -> LoadError {
    let files =
        Files::memory(files.iter().map(|(path, text)| (PathBuf::from(path), text.as_bytes().to_vec())));
    load_with(Path::new("main.kdl"), &files).expect_err("the scene is wrong")
}

#[test]
fn errors_are_worded_as_agreed() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/errors.txt");
    let mut golden = std::fs::read_to_string(&path).unwrap();
    let mut actual = String::new();
    for text in golden.lines().filter_map(|line| line.strip_prefix(">>> ")) {
        let whole = format!("luch 1\n{text}\n");
        let files = Files::memory([(PathBuf::from("s.kdl"), whole.into_bytes())]);
        let said = match load_with(Path::new("s.kdl"), &files) {
            Ok(_) => "no error".to_owned(),
            Err(error) => error.to_string(),
        };
        actual += &format!(">>> {text}\n{said}\n\n");
    }
    if std::env::var_os("LUCH_BLESS").is_some() {
        std::fs::write(&path, &actual).unwrap();
        golden.clone_from(&actual);
    }
    assert!(!actual.contains("no error"));
    for (line, (golden, actual)) in golden.lines().zip(actual.lines()).enumerate() {
        assert_eq!(actual, golden, "errors.txt:{}", line + 1);
    }
    assert_eq!(golden.lines().count(), actual.lines().count());
}

#[test]
fn all_problems_of_a_file_are_told_in_order() {
    let text = "luch 1\n\
                settings { size 0 540 }\n\
                material \"a\" { difuse 0.5 }\n\
                camera { from 0 0 5; to 0 0 zero }\n\
                object { sphere radius=-1 }\n";
    let problems = fails(&[("main.kdl", text)]).problems;
    let lines: Vec<String> =
        problems.iter().map(|p| p.to_string().lines().next().unwrap().to_owned()).collect();
    assert_eq!(
        lines,
        [
            "main.kdl:2:17: `size` is `0`, expected a whole number from 1 to 65536",
            "main.kdl:3:16: unknown surface or option `difuse` in `material`",
            "main.kdl:4:29: `to` is `zero`, expected a number",
            "main.kdl:5:24: `radius` is `-1`, expected a number above 0",
        ]
    );
}

#[test]
fn references_of_all_kinds_are_checked_together() {
    let text = "luch 1\nmaterial \"a\" { diffuse texture=\"t\" }\nobject mesh=\"m\" material=\"b\"\n";
    let said = fails(&[("main.kdl", text)]).to_string();
    for part in ["2:32: unknown texture \"t\"", "3:13: unknown mesh \"m\"", "3:26: unknown material \"b\""] {
        assert!(said.contains(part), "{said}");
    }
}

#[test]
fn the_version_must_be_there_and_be_known() {
    let said = fails(&[("main.kdl", "object { sphere }")]).to_string();
    assert!(said.starts_with("main.kdl:1:1: the version of the format is missing"), "{said}");
    let said = fails(&[("main.kdl", "luch 2")]).to_string();
    assert!(
        said.starts_with(
            "main.kdl:1:6: the version of the format is `2`, expected a whole number from 1 to 1"
        ),
        "{said}"
    );
    assert!(fails(&[("main.kdl", "")]).to_string().starts_with("main.kdl:1:1: the version"));
    let said = fails(&[("main.kdl", "luch 1\nluch 1")]).to_string();
    assert!(said.starts_with("main.kdl:2:1: `luch` stands before everything else"), "{said}");
}

#[test]
fn cycles_of_includes_and_imports_end_in_an_error() {
    let said = fails(&[
        ("main.kdl", "luch 1\ninclude \"sub/a.kdl\""),
        ("sub/a.kdl", "include \"../sub/./b.kdl\""),
        ("sub/b.kdl", "include \"../main.kdl\""),
    ])
    .to_string();
    assert!(
        said.contains(
            "sub/b.kdl:1:9: this file includes itself: main.kdl → sub/a.kdl → sub/b.kdl → main.kdl"
        ),
        "{said}"
    );
    let said =
        fails(&[("main.kdl", "luch 1\nimport \"other.kdl\""), ("other.kdl", "luch 1\nimport \"main.kdl\"")])
            .to_string();
    assert!(
        said.contains("other.kdl:2:8: this file imports itself: main.kdl → other.kdl → main.kdl"),
        "{said}"
    );
    let said = fails(&[("main.kdl", "luch 1\nimport \"sub/../main.kdl\"")]).to_string();
    assert!(said.contains("imports itself"), "{said}");
}

#[test]
fn long_chains_of_includes_and_imports_are_bounded() {
    let mut files: Vec<(String, String)> = vec![("main.kdl".into(), "luch 1\ninclude \"f0.kdl\"".into())];
    files.extend((0..40).map(|i| (format!("f{i}.kdl"), format!("include \"f{}.kdl\"", i + 1))));
    let borrowed: Vec<(&str, &str)> =
        files.iter().map(|(path, text)| (path.as_str(), text.as_str())).collect();
    assert!(fails(&borrowed).to_string().contains("more than 16 files inside one another"));
    // Every scene imports the next one twice, so that 2^n copies are asked for.
    let mut files: Vec<(String, String)> = vec![("main.kdl".into(), "luch 1\nimport \"f0.kdl\"".into())];
    let twice = |i: usize| {
        format!("luch 1\nobject {{ sphere }}\nimport \"f{0}.kdl\"\nimport \"f{0}.kdl\" {{ scale 2 }}", i + 1)
    };
    files.extend((0..40).map(|i| (format!("f{i}.kdl"), twice(i))));
    let borrowed: Vec<(&str, &str)> =
        files.iter().map(|(path, text)| (path.as_str(), text.as_str())).collect();
    let said = fails(&borrowed).to_string();
    assert!(said.contains("more than 8 scenes inside one another"), "{said}");
}

#[test]
fn problems_of_included_files_carry_their_name() {
    let said =
        fails(&[("main.kdl", "luch 1\ninclude \"m/a.kdl\""), ("m/a.kdl", "\nmaterial \"x\" { diffuse 2 }")])
            .to_string();
    assert!(said.starts_with("m/a.kdl:2:24: `diffuse` is `2`"), "{said}");
    let twice = "material \"x\" { diffuse 1 }";
    let said =
        fails(&[("main.kdl", &format!("luch 1\ninclude \"a.kdl\"\n{twice}")), ("a.kdl", twice)]).to_string();
    assert!(
        said.contains("main.kdl:3:10: material \"x\" is defined twice") && said.contains("first at a.kdl:1"),
        "{said}"
    );
}

#[test]
fn thousands_of_problems_are_counted_not_listed() {
    let text = format!("luch 1\n{}", "object mesh=\"none\" nonsense=1\n".repeat(30_000));
    let error = fails(&[("main.kdl", &text)]);
    assert_eq!(error.problems.len(), 101);
    assert!(
        error.problems[100].message.starts_with("and 29900 more problems"),
        "{}",
        error.problems[100].message
    );
}

#[test]
fn text_that_is_no_utf8_and_unknown_files_are_refused() {
    let load = |path: &str, bytes: &[u8]| {
        load_with(Path::new(path), &Files::memory([(PathBuf::from(path), bytes.to_vec())]))
            .unwrap_err()
            .to_string()
    };
    assert_eq!(load("a.kdl", b"luch 1\nobject \xff"), "a.kdl: byte 14: is no UTF-8 text");
    assert_eq!(
        load("a.blend", b"BLENDER-v300"),
        "a.blend: is of no format that is known here\n  help: accepted are .kdl, .gltf, .glb, .xml, .obj, .ply, .stl, .off, .3mf"
    );
    let none = load_with(Path::new("none.obj"), &Files::memory([])).unwrap_err().to_string();
    assert_eq!(none, "none.obj: no such file");
}
