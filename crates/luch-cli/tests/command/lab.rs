//! `luch lab` as people use it.

use crate::workplace::Workplace;
use serde_json::Value;

fn json(place: &Workplace, command: &str) -> Value {
    serde_json::from_str(&place.done(&format!("{command} --json")).out).unwrap()
}

/// The rows of the first table of a page.
fn rows(page: &Value) -> Vec<Vec<String>> {
    let sections = page["sections"].as_array().unwrap();
    let table = sections.iter().find_map(|section| section.get("table")).expect("a table");
    serde_json::from_value(table["rows"].clone()).unwrap()
}

#[test]
fn problems_have_their_answers() {
    let place = Workplace::empty();
    let list = place.done("lab problems").out;
    for name in ["pi", "acute", "cos77-normal", "lamp", "edge", "glossy"] {
        assert!(list.contains(name), "{name}");
        let said = place.done(&format!("lab {name} --samples 4096")).out;
        let off = said.split(" standard errors off").next().unwrap().rsplit(' ').next().unwrap();
        assert!(off.parse::<f64>().unwrap().abs() < 4.0, "{name}: {off}");
        assert_eq!(said, place.done(&format!("lab {name} --samples 4096")).out, "{name}");
    }
    assert!(place.fails("lab acutte", 2).err.contains("did you mean `acute`"));
    assert!(place.fails("lab pi --sampler sobbol", 2).err.contains("did you mean `sobol`"));
}

#[test]
fn integrals_by_many_samplers() {
    let place = Workplace::empty();
    let page = json(
        &place,
        "lab integrate exp(x+y)/(exp(1)-1)^2 --over x=0..1,y=0..1 --truth 1 --sampler independent,sobol-owen,jittered --n 2^6..2^12",
    );
    let rows = rows(&page);
    let slope = |name: &str| -> f64 {
        let row = rows.iter().find(|row| row[0] == name).expect("a row");
        row[4].parse().unwrap()
    };
    // Ground truth of smooth integrands in two dimensions; ± 0.1 with seven sizes and 32 replicates.
    assert!((slope("independent") + 0.5).abs() < 0.1, "{rows:?}");
    assert!((slope("sobol-owen") + 1.45).abs() < 0.15, "{rows:?}");
    assert!((slope("jittered") + 1.0).abs() < 0.1, "{rows:?}");
    let said = place.done("lab integrate x*y --over x=0..1,y=0..1 --until rel1e-4@95%");
    assert!(said.out.contains("0.25") && said.out.contains("±"), "{}", said.out);
    // An infinite variance gets no interval.
    let heavy = place.run("lab integrate x^-0.6 --over x=0..1 --until rel1e-3@95%");
    assert!(heavy.code == Some(1) && heavy.out.contains("variance may be infinite"), "{}", heavy.out);
    let slip = place.fails("lab integrate x*z --over x=0..1", 1);
    assert!(slip.err.contains('z'), "{}", slip.err);
}

#[test]
fn poor_generators_fail_and_good_ones_pass() {
    let place = Workplace::empty();
    let page = json(&place, "lab prng randu mt19937 xoshiro256++");
    for row in rows(&page) {
        let fails = row.iter().filter(|cell| *cell == "FAILS").count();
        assert_eq!(fails > 2, row[0] == "randu", "{row:?}");
    }
    let text = page.to_string();
    assert!(text.contains("15 planes"));
}

#[test]
fn figures_are_written() {
    let place = Workplace::empty();
    place.done("lab points sobol-owen independent --count 100 -o points.svg -o points.png -o points.csv -o points.html");
    place.done("lab measure sobol halton --count 64 -o measure.json");
    place.done("lab density -o density.svg");
    let files = place.files();
    for name in ["points.svg", "points.png", "points.csv", "points.html", "measure.json", "density.svg"] {
        assert!(files.iter().any(|file| file == name), "{name} in {files:?}");
    }
    let svg = std::fs::read_to_string(place.path("points.svg")).unwrap();
    assert!(svg.starts_with("<svg") && svg.contains("prefers-color-scheme"));
    let refused = place.fails("lab points sobol -o points.bmp", 2);
    assert!(refused.err.contains(".svg, .png, .csv, .json, .html"), "{}", refused.err);
}

#[test]
fn the_lecture_has_its_figures() {
    let place = Workplace::empty();
    place.done("lab lecture -o figures");
    let made: Vec<_> = std::fs::read_dir(place.path("figures")).unwrap().flatten().collect();
    for number in ["06", "13", "14", "16", "18", "19", "22", "23"] {
        assert!(made.iter().any(|entry| entry.file_name().to_string_lossy().starts_with(number)), "{number}");
    }
    assert!(std::fs::read_to_string(place.path("figures/index.html")).unwrap().contains("fifteen planes"));
}

#[test]
fn pixels_are_explained() {
    let place = Workplace::new();
    let said =
        place.done("lab explain scene.kdl --pixel 3,4 --size 16x16 --spp 64 --sample 5 -o pixel.html").out;
    for word in ["camera  64 paths", "Sample 5", "p by BSDF", "scatterings", "Brightest"] {
        assert!(said.contains(word), "{word}: {said}");
    }
    assert!(String::from_utf8(place.bytes("pixel.html")).unwrap().contains("luch lab explain"));
    assert!(place.fails("lab explain scene.kdl --pixel 99,0 --size 16x16", 1).err.contains("16x16"));
    assert!(place.fails("lab explain scene.kdl --pixel 3", 2).err.contains("column and row"));
    let other = place.fails("lab explain scene.kdl --pixel 3,4 --integrator normal", 2).err;
    assert!(other.contains("`path`"), "{other}");
}
