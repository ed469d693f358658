//! `luch mesh` and `luch preview` as people use them.

use crate::workplace::Workplace;
use std::process::{Command, Stdio};

fn luch() -> Command {
    Command::new(env!("CARGO_BIN_EXE_luch"))
}

/// Runs verbs joined by pipes; what the last one says.
fn piped(place: &Workplace, verbs: &[&[&str]]) -> String {
    let mut input = Stdio::null();
    let (last, first) = verbs.split_last().expect("a verb");
    let mut children = Vec::new();
    for verb in first {
        let mut child = luch()
            .current_dir(place.path(""))
            .arg("mesh")
            .args(*verb)
            .stdin(input)
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        input = child.stdout.take().expect("a pipe").into();
        children.push(child);
    }
    let output = luch().current_dir(place.path("")).arg("mesh").args(*last).stdin(input).output().unwrap();
    for mut child in children {
        assert!(child.wait().unwrap().success());
    }
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

#[test]
fn verbs_are_joined_by_pipes() {
    let place = Workplace::empty();
    let said = piped(
        &place,
        &[
            &["cuboid", "--size", "2"],
            &["subdivide", "--levels", "2"],
            &["twist", "--angle", "90deg"],
            &["info", "--json"],
        ],
    );
    let report: serde_json::Value = serde_json::from_str(&said).unwrap();
    assert_eq!((report["closed"].as_bool(), report["genus"].as_u64()), (Some(true), Some(0)), "{report}");
    // 6 quads, two levels of four each, two triangles a quad.
    assert_eq!(report["triangles"].as_u64(), Some(6 * 16 * 2));
}

#[test]
fn a_pipe_and_a_pipeline_give_the_same_mesh() {
    let place = Workplace::empty();
    piped(
        &place,
        &[
            &["torus", "--segments", "12", "--sides", "6"],
            &["bend", "--angle", "40deg"],
            &["convert", "-o", "a.obj"],
        ],
    );
    piped(&place, &[&["run", "torus --segments 12 --sides 6 | bend --angle 40deg", "-o", "b.obj"]]);
    let report: serde_json::Value =
        serde_json::from_str(&piped(&place, &[&["compare", "a.obj", "b.obj", "--json"]])).unwrap();
    assert_eq!(report["hausdorff"].as_f64(), Some(0.0), "{report}");
    assert_eq!(report["a"], report["b"]);
}

#[test]
fn every_format_is_written_and_read_again() {
    let place = Workplace::empty();
    for extension in ["obj", "ply", "stl", "off", "glb", "3mf"] {
        let name = format!("mesh.{extension}");
        piped(&place, &[&["icosphere", "--subdivisions", "1", "-o", &name]]);
        let said = piped(&place, &[&["compare", &name, "icosphere --subdivisions 1", "--json"]]);
        let report: serde_json::Value = serde_json::from_str(&said).unwrap();
        assert_eq!(report["hausdorff"].as_f64(), Some(0.0), "{extension}: {report}");
    }
}

#[test]
fn mistakes_say_what_would_be_right() {
    let place = Workplace::empty();
    for (words, said) in [
        (&["mesh", "cuboit"][..], "cuboid"),
        (&["mesh", "cuboid", "--sice", "2"], "--size"),
        (&["mesh", "cuboid", "--size", "-1"], "positive"),
        (&["mesh", "run", "cuboid | twits"], "twist"),
        (&["mesh", "implicit", "x^2 + y^2 + z^"], "x^2 + y^2 + z^"),
        (&["mesh", "cuboid", "-o", "a.ojb"], ".obj"),
        (&["mesh", "info", "nothing.obj"], "no such file"),
        (&["preview", "cuboid", "--fill", "shiny"], "shaded"),
    ] {
        let output = luch().current_dir(place.path("")).args(words).stdin(Stdio::null()).output().unwrap();
        let error = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(!output.status.success() && error.contains(said), "{words:?}: {error}");
    }
    assert!(place.files().is_empty(), "{:?}", place.files());
}

#[test]
fn questions_about_points() {
    let place = Workplace::empty();
    piped(&place, &[&["cuboid", "--size", "2", "-o", "box.ply"]]);
    let said = piped(&place, &[&["query", "box.ply", "--point", "0,0.5,0", "--point", "3,0,0", "--json"]]);
    let answers: Vec<serde_json::Value> =
        said.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    assert_eq!((answers[0]["inside"].as_bool(), answers[0]["distance"].as_f64()), (Some(true), Some(-0.5)));
    assert_eq!((answers[1]["inside"].as_bool(), answers[1]["distance"].as_f64()), (Some(false), Some(2.0)));
    let points = piped(&place, &[&["sample", "box.ply", "--count", "100", "--blue-noise"]]);
    assert_eq!(points.lines().count(), 100);
    for line in points.lines() {
        let numbers: Vec<f64> = line.split(',').map(|n| n.parse().unwrap()).collect();
        let far = numbers[..3].iter().fold(0.0_f64, |most, n| most.max(n.abs()));
        assert!(numbers.len() == 6 && (far - 1.0).abs() <= 2.0 * f64::from(f32::EPSILON), "{line}");
    }
}

#[test]
fn previews_of_a_mesh_and_a_scene() {
    let place = Workplace::new();
    place.done("preview scene.kdl -o scene.png");
    place.done("preview torus --size 64x48 --wireframe -o torus.png");
    place.done("preview teapot --sheet --size 90x60 --marks -o sheet.png");
    assert_eq!(place.files(), ["scene.kdl", "scene.png", "sheet.png", "torus.png"]);
    let shown = place.done("preview icosphere --terminal letters --columns 20");
    assert!(shown.out.lines().count() > 3 && shown.out.contains('#'), "{}", shown.out);
}

#[test]
fn the_list_of_verbs() {
    let said = piped(&Workplace::empty(), &[&["verbs"]]);
    assert!(said.contains("Makes a mesh:") && said.contains("  subdivide "), "{said}");
}

#[test]
fn a_form_is_held_against_its_meshes() {
    let place = Workplace::empty();
    let read = |form: &str, more: &[&str]| -> serde_json::Value {
        let verb: Vec<&str> = ["compare", form, "--json"].into_iter().chain(more.iter().copied()).collect();
        serde_json::from_str(&piped(&place, &[&verb])).unwrap()
    };
    let said = read("cylinder --radius 0.5", &["--resolutions", "8,16", "-o", "forms.png"]);
    let meshes = said["meshes"].as_array().unwrap();
    let distance = |k: usize| meshes[k]["hausdorff"].as_f64().unwrap();
    // A chord of 1/8 of a circle is r (1 − cos(π/8)) away from it, against the mesh of 64 by r (1 − cos(π/64)) less.
    assert!((distance(0) - 0.5 * (1.0 - 0.923_879_5)).abs() < 2e-3, "{said}");
    assert!((3.5..4.5).contains(&(distance(0) / distance(1))), "{said}");
    let image = |k: usize| meshes[k]["image_difference"].as_f64().unwrap();
    assert!(image(0) > 2.0 * image(1) && image(1) > 0.0, "{said}");
    assert!(place.path("forms.png").exists());
    let ball =
        read("implicit 'x^2+y^2+z^2-1' --bounds -1.2,-1.2,-1.2,1.2,1.2,1.2", &["--resolutions", "6,12"]);
    assert!(ball["meshes"][0]["hausdorff"].as_f64() > ball["meshes"][1]["hausdorff"].as_f64(), "{ball}");
    let refused = luch().args(["mesh", "compare", "torus"]).output().unwrap();
    assert!(String::from_utf8_lossy(&refused.stderr).contains("known as a mesh only"));
}
