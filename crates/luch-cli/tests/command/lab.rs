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

#[test]
fn routines_are_held_against_their_densities() {
    let place = Workplace::empty();
    let page = json(&place, "lab chi2 camera warp table sphere");
    let found = rows(&page);
    assert!(found.len() > 25 && found.iter().all(|row| row[9] == "agrees"), "{found:?}");
    place.done("lab chi2 cone:3 --samples 20000 -o cone.png -o cone.csv");
    assert!(place.path("cone.png").exists() && place.path("cone.csv").exists());
    let wrong = place.run("lab chi2 planted");
    assert_eq!(wrong.code, Some(1), "{}", wrong.out);
    assert!(wrong.out.contains("3 of 3 REJECTED"), "{}", wrong.out);
    assert!(place.fails("lab chi2 conducter", 2).err.contains("did you mean `conductor`"));
    assert!(place.fails("lab chi2 cone:33", 2).err.contains("did you mean `cone:"));
    place.fails("lab chi2 cone --samples 10", 2);
    place.fails("lab chi2 cone --alpha 2", 2);
}

#[test]
fn ways_to_save_samples_are_compared() {
    let place = Workplace::empty();
    let number = |text: &str| -> f64 { text.split(' ').next().unwrap().parse().unwrap() };
    // Ground truth: the best width for cos⁷⁷, and 0.08 against 0.15.
    let widths = rows(&json(&place, "lab width"));
    let best = widths.iter().find(|row| row[0].contains("best")).unwrap();
    assert!((number(&best[0]) - 0.113_231).abs() < 1e-6, "{best:?}");
    let at = |width: &str| number(&widths.iter().find(|row| row[0] == width).unwrap()[1]);
    assert!((at("0.08") / at("0.15") - 14.816).abs() < 0.01);
    let weights = rows(&json(&place, "lab mis"));
    let variance = |name: &str| number(&weights.iter().find(|row| row[0] == name).unwrap()[1]);
    assert!(variance("optimal") <= variance("balance") && variance("balance") < variance("second alone"));
    assert!(place.done("lab control").out.contains("times less variance"));
    assert!(place.done("lab roulette").out.contains("cheap and uncertain: best"));
    let strata = rows(&json(&place, "lab strata --repetitions 1000"));
    assert!(strata.iter().all(|row| number(&row[5]).abs() < 4.0), "{strata:?}");
    for (line, code, says) in [
        ("lab width --from 2", 2, "not below"),
        ("lab width --mean x", 2, "no number"),
        ("lab mis x --over x=0..1,y=0..1", 2, "one dimension"),
        ("lab mis x --first rubbish", 1, "rubbish"),
        ("lab control exp(x) --samples 50", 2, "at least 100"),
        ("lab roulette --cost 1,0", 2, "above 0"),
        ("lab roulette --direct 1,-1", 2, "no mean and variance"),
        ("lab strata --repetitions 3", 2, "from 100"),
        ("lab strat", 2, "did you mean `strata`"),
    ] {
        let said = place.fails(line, code);
        assert!(said.err.contains(says), "{line}: {}", said.err);
    }
}

/// A lamp of 2 × 1 metres at height 3 behind a half-plane at height 1.
const HALF_HIDDEN: &str = r#"luch 1
camera { from 0 1 4; to 0 0 0 }
material "dark" { absorber }
material "lamp" { emission 2 2 2 }
object "panel" material="lamp" { mesh { plane size=1 }; rotate-x 180; scale 2 1 1; translate 0 3 0 }
object "edge" material="dark" { mesh { plane size=1 }; scale 2000 1 4000; translate -1000 1 0 }
"#;

#[test]
fn a_point_of_a_scene_sees_its_lamps() {
    let place = Workplace::new();
    place.write("half.kdl", HALF_HIDDEN);
    // Ground truth 4.4 (a): visible fraction and form factor.
    for (p, fraction, factor) in [("-0.25", 0.25, 0.014_066_780), ("0.2", 0.7, 0.046_860_819)] {
        let found = rows(&json(&place, &format!("lab lamp --scene half.kdl --at {p},0,0")));
        let number = |at: usize| found[0][at].parse::<f64>().unwrap();
        assert_eq!((found.len(), found[0][0].as_str()), (1, "panel"));
        assert!((number(3) - fraction).abs() <= 4.0 * number(4) + 1e-6, "{found:?}");
        let truth = 2.0 * std::f64::consts::PI * factor;
        assert!((number(5) - truth).abs() <= 4.0 * number(6) + 1e-5 * truth, "{found:?}");
        assert!(number(6) < 0.01 * truth, "{found:?}");
    }
    let all = place.done("lab lamp --scene scene.kdl --at 0.1,0,0.3 --samples 4096").out;
    assert!(all.contains("lamp") && all.contains("sky") && all.contains("total irradiance"), "{all}");
    let one = rows(&json(&place, "lab lamp --scene scene.kdl --at 0.1,0,0.3 --light sky --samples 4096"));
    assert!(one.len() == 1 && one[0][0] == "sky", "{one:?}");
    place.write(
        "dark.kdl",
        "luch 1\nmaterial \"m\" { diffuse 0.5 }\nobject material=\"m\" { sphere radius=1 }\nenvironment 0\n",
    );
    assert!(place.fails("lab lamp --scene dark.kdl --at 0,0,0", 1).err.contains("no lamp"));
    let far = place.fails("lab lamp --scene scene.kdl --at 0,0,0 --light lmp", 2);
    assert!(far.err.contains("did you mean `lamp`"), "{}", far.err);
    for line in ["--at 1,2", "--at 0,0,0 --normal 0,0,0", "--at 0,nan,0", "--at 0,0,0 --sampler jittered"] {
        place.fails(&format!("lab lamp --scene scene.kdl {line}"), 2);
    }
    place.fails("lab lamp --scene none.kdl --at 0,0,0", 1);
}

#[test]
fn the_renderer_finds_what_is_known() {
    let place = Workplace::empty();
    let said = place.done("lab truth F11 f2 --integrator path,plain -o t.html -o t.json -o t.csv");
    assert!(said.out.contains("ACCEPTED") && said.out.contains("beside a wall"), "{}", said.out);
    assert!(place.files().len() >= 3);
    let page = json(&place, "lab truth color --sampler all --error 2% --seed 3");
    let sections = page["sections"].as_array().unwrap();
    let tables: Vec<&Value> = sections.iter().filter_map(|section| section.get("table")).collect();
    let rows: Vec<Vec<String>> = serde_json::from_value(tables[1]["rows"].clone()).unwrap();
    assert_eq!(rows.len(), 3 * 3 * 4);
    for row in rows {
        assert!(row[7].parse::<f64>().unwrap().abs() < 5.0, "{row:?}");
    }
    assert!(place.done("lab truth --list").out.contains("F15"));
    assert!(place.fails("lab truth glosy", 2).err.contains("did you mean `glossy`"));
    assert!(place.fails("lab truth F9", 2).err.contains("needs fog"));
    assert!(place.fails("lab truth --integrator occlusion F1", 2).err.contains("no case"));
    assert!(place.fails("lab truth -o t.bmp", 2).err.contains(".svg, .png, .csv, .json, .html"));
    for wrong in ["--alpha 0", "--error 0", "--error 90%", "--sampler sobbol", "--integrator pth"] {
        place.fails(&format!("lab truth F11 {wrong}"), 2);
    }
}
