//! `luch lab render` and `luch lab coverage` as people use them.

use crate::workplace::{SCENE, Said, Workplace, signal};
use serde_json::Value;
use std::time::{Duration, Instant};

const STUDY: &str = "lab render scene.kdl --size 16x12 --spp 2^0..2^3 --replicates 3 --reference-spp 64";
const COVERAGE: &str = "lab coverage scene.kdl --size 16x12 --spp 4 --renders 10 --reference-spp 64";

#[test]
fn samplers_are_compared() {
    let place = Workplace::new();
    let said = place.done(&format!(
        "{STUDY} --integrator path:4,plain:4,direct -o study.html -o study.json -o study.svg"
    ));
    for word in [
        "independent",
        "stratified",
        "halton",
        "sobol",
        "plain-path:4",
        "slope",
        "processor time",
        "equal time",
    ] {
        assert!(said.out.contains(word), "{word}: {}", said.out);
    }
    let html = std::fs::read_to_string(place.path("study.html")).unwrap();
    assert!(html.contains("data:image/png;base64,") && html.contains("lab render scene.kdl"));
    // Two references: paths with and without lamps aimed at share one.
    assert!(html.contains("Reference 2:") && !html.contains("Reference 3:"));
    assert!(place.files().iter().any(|file| file == "study-2.svg"));
    let page: Value = serde_json::from_slice(&place.bytes("study.json")).unwrap();
    assert_eq!(page["data"]["results"]["series"].as_array().unwrap().len(), 12);
    assert_eq!(page["data"]["times"]["series"].as_array().unwrap().len(), 12);

    // Nothing but JSON, the same every time but for the times.
    let again = || -> Value {
        let said = place.done(&format!("{STUDY} --json"));
        assert_eq!(said.err, "");
        let page: Value = serde_json::from_str(&said.out).unwrap();
        page["data"]["results"].clone()
    };
    assert_eq!(again(), again());
}

#[test]
fn references_come_from_files_and_closed_forms() {
    let place = Workplace::new();
    place.done("render scene.kdl --size 16x12 --spp 64 -o reference.exr -o reference.png -q");
    let study = "lab render scene.kdl --sampler sobol --spp 2^0..2^2 --replicates 3";
    // The size is the reference's.
    for file in ["reference.exr", "reference.luch"] {
        let said = place.done(&format!("{study} --reference {file}"));
        assert!(said.out.contains("16×12") && said.out.contains("its own noise is"), "{}", said.out);
    }
    assert!(place.fails(&format!("{study} --reference reference.png"), 1).err.contains(".exr"));
    assert!(place.fails(&format!("{study} --reference reference.exr --size 8x8"), 1).err.contains("16×12"));
    place.fails(&format!("{study} --reference nothing.exr"), 1);
    place.write("sky.kdl", "luch 1\ncamera { from 0 0 0; to 1 0 0 }\nenvironment 0.5\nobject { sphere radius=1; translate -9 0 0; material { diffuse 0.5 } }");
    let said = place.done("lab render sky.kdl --sampler sobol --truth 0.5 --size 8x8 --spp 2^0..2^2");
    assert!(said.out.contains("exact"), "{}", said.out);
}

#[test]
fn coverage_is_counted() {
    let place = Workplace::new();
    let said = place.done(&format!("{COVERAGE} -o coverage.html -o coverage.png"));
    for word in ["flat", "edge", "noisy", "mean of the picture", "stated/true", "95 %"] {
        assert!(said.out.contains(word), "{word}: {}", said.out);
    }
    let page: Value =
        serde_json::from_str(&place.done(&format!("{COVERAGE} --levels 68,99.5 --json")).out).unwrap();
    let levels = page["data"]["results"]["mean"]["student"].as_array().unwrap();
    assert_eq!(levels.iter().map(|one| one["level"].as_f64().unwrap()).collect::<Vec<_>>(), [0.68, 0.995]);
}

#[test]
fn slips_are_told() {
    let place = Workplace::new();
    let says = |line: &str, code: i32| place.fails(line, code).err;
    assert!(says(&format!("{STUDY} --sampler sobl"), 2).contains("did you mean `sobol`"));
    assert!(says(&format!("{STUDY} --integrator pth"), 2).contains("did you mean `path`"));
    assert!(says(&format!("{COVERAGE} --sampler all"), 2).contains("no sampler `all`"));
    assert!(says("lab coverage scene.kdl --levels 95,100", 2).contains("`100` is no level"));
    assert!(says("lab coverage scene.kdl --spp 1", 2).contains("2 and more"));
    assert!(says("lab render nothing.kdl", 1).contains("nothing.kdl"));
    assert!(says(&format!("{STUDY} --camera sde"), 1).contains("front"));
    assert!(says("lab render scene.kdl --size 9999x9999", 2).contains("at most"));
    // Before the work, not after it.
    assert!(says(&format!("{STUDY} -o study.bmp"), 2).contains(".svg, .png, .csv, .json, .html"));
    assert!(says("lab coverage scene.kdl -o scene.kdl", 2).contains("accepted are"));
    assert_eq!(place.files(), ["scene.kdl"]);
    assert_eq!(std::fs::read_to_string(place.path("scene.kdl")).unwrap(), SCENE);
}

#[test]
fn long_work_can_be_ended() {
    let place = Workplace::new();
    let child =
        place.start("lab coverage scene.kdl --size 512x512 --reference-spp 65536 --json -o coverage.json");
    std::thread::sleep(Duration::from_millis(400));
    let asked = Instant::now();
    signal(&child, "INT");
    let said = Said::of(child.wait_with_output().unwrap());
    assert_eq!(said.code, Some(130), "{}", said.err);
    assert!(said.err.contains("interrupted") && said.out.is_empty(), "{}", said.err);
    assert!(asked.elapsed() < Duration::from_secs(5), "{:?}", asked.elapsed());
    assert_eq!(place.files(), ["scene.kdl"]);
}
