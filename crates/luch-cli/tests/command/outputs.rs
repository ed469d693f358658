//! What is written, and what is told.

use crate::workplace::Workplace;
use luch::image::codec::{self, Format, decode_exr_layers};

#[test]
fn every_format_holds_the_picture() {
    let place = Workplace::new();
    place.done("render scene.kdl -o a.png -o a.jpg -o a.exr -o a.hdr -o a.pfm -o a.npy");
    assert_eq!(place.files(), ["a.exr", "a.hdr", "a.jpg", "a.luch", "a.npy", "a.pfm", "a.png", "scene.kdl"]);
    let film = place.film("a.luch");
    assert!(film.holds(&(0..4)) && film.mean_samples() == 4.0);
    for (name, format) in [("a.exr", Format::Exr), ("a.pfm", Format::Pfm), ("a.npy", Format::Npy)] {
        let light = codec::decode(&place.bytes(name), Some(format)).unwrap().to_rgb();
        assert_eq!(light, film.to_image(), "{name}");
    }
    for (name, format) in [("a.png", Format::Png), ("a.jpg", Format::Jpeg), ("a.hdr", Format::Hdr)] {
        let bitmap = codec::decode(&place.bytes(name), Some(format)).unwrap();
        assert_eq!([bitmap.width, bitmap.height], [48, 40]);
        let metadata = codec::read_metadata(&place.bytes(name)).unwrap();
        assert_eq!(metadata.get("luch:scene"), Some("scene.kdl"));
        assert_eq!(metadata.get("luch:samples"), Some("0..4"));
        assert_eq!(metadata.get("luch:fingerprint").unwrap().len(), 64);
    }
}

#[test]
fn an_exr_has_the_layers_that_were_asked_for() {
    let place = Workplace::new();
    place.done("render scene.kdl --no-checkpoint -o a.exr -o b.png");
    assert_eq!(place.files(), ["a.exr", "b.png", "scene.kdl"]);
    let layers = decode_exr_layers(&place.bytes("a.exr")).unwrap();
    for (layer, channels) in [
        ("", vec!["R", "G", "B"]),
        ("albedo", vec!["R", "G", "B"]),
        ("normal", vec!["X", "Y", "Z"]),
        ("depth", vec!["Z"]),
        ("stderr", vec!["R", "G", "B"]),
        ("samples", vec!["N"]),
    ] {
        let layer = layers.layer(layer).unwrap_or_else(|| panic!("no layer {layer}"));
        channels
            .iter()
            .for_each(|channel| assert!(layer.channel(channel).is_some(), "{}.{channel}", layer.name));
    }
    assert!(layers.layer("samples").unwrap().channel("N").unwrap().iter().all(|&n| n == 4.0));
    // The middle of the lower edge shows the floor, whose normal is +Y.
    let below = 39 * 48 + 24;
    assert!((layers.layer("normal").unwrap().channel("Y").unwrap()[below] - 1.0).abs() < 1e-5);
    assert!((layers.layer("albedo").unwrap().channel("R").unwrap()[below] - 0.8).abs() < 1e-5);

    place.done("render scene.kdl --no-checkpoint -o c.exr --layers samples,instance");
    let layers = decode_exr_layers(&place.bytes("c.exr")).unwrap();
    assert!(layers.layer("instance").is_some() && layers.layer("albedo").is_none());
}

#[test]
fn the_usual_output_is_named_after_the_scene_and_lies_here() {
    let place = Workplace::empty();
    std::fs::create_dir(place.path("scenes")).unwrap();
    place.write("scenes/ball.one.kdl", crate::workplace::SCENE);
    let said = place.done("render scenes/ball.one.kdl");
    assert_eq!(place.files(), ["ball.one.luch", "ball.one.png", "scenes"]);
    assert!(said.out.is_empty() && said.err.contains("4 samples per pixel"), "{}", said.err);
    assert!(place.done("render scenes/ball.one.kdl --quiet").err.is_empty());
}

#[test]
fn what_is_typed_goes_before_what_the_scene_says() {
    let place = Workplace::new();
    place.done("render scene.kdl --size 16x8 --spp 2 --camera side --integrator depth -o d.pfm");
    let film = place.film("d.luch");
    assert_eq!((film.width(), film.height(), film.mean_samples()), (16, 8, 2.0));
    place.done("render scene.kdl --integrator normal -o flat.png --depth 16 --exposure -1 --tone agx");
    assert!(place.fails("render scene.kdl --integrator normal --max-depth 3", 2).err.contains("normal"));
}

#[test]
fn progress_as_json_is_one_object_a_line() {
    let place = Workplace::new();
    let said = place.done("render scene.kdl --spp 64 --progress json");
    let events: Vec<serde_json::Value> =
        said.out.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    let names: Vec<&str> = events.iter().map(|event| event["event"].as_str().unwrap()).collect();
    assert_eq!((names.first(), names.last()), (Some(&"start"), Some(&"end")));
    assert!(names[1..names.len() - 1].iter().all(|name| *name == "progress"));
    let end = events.last().unwrap();
    assert_eq!((end["samples_per_pixel"].as_f64(), end["ending"].as_str()), (Some(64.0), Some("samples")));
    let number = |key: &str| end[key].as_f64().unwrap();
    assert!(number("error") > 0.0 && number("elapsed") > 0.0);
    // Rendering alone took time, and no more than there was.
    assert!(number("render_seconds") > 0.0 && number("render_seconds") <= number("elapsed"));
    assert!(!cfg!(unix) || number("processor_seconds") > 0.0);
}

#[test]
fn goals_end_the_work() {
    let place = Workplace::new();
    place.done("render scene.kdl --time 300ms -o t.png");
    assert!(place.film("t.luch").mean_samples() > 0.0);
    place.done("render scene.kdl --error 50% -o e.png");
    assert!(place.film("e.luch").error().unwrap().relative <= 0.5);
    place.done("render scene.kdl --samples 3..7 -o part.luch");
    assert!(place.film("part.luch").holds(&(3..7)) && place.film("part.luch").mean_samples() == 4.0);
}

#[test]
fn the_number_of_threads_changes_nothing() {
    let place = Workplace::new();
    place.done("render scene.kdl --threads 1 -o one.pfm");
    place.done("render scene.kdl --threads 3 -o three.pfm");
    assert_eq!(place.film("one.luch"), place.film("three.luch"));
    assert_eq!(place.bytes("one.pfm"), place.bytes("three.pfm"));
}

#[test]
fn a_film_is_refined_and_developed() {
    let place = Workplace::new();
    place.done("render scene.kdl --spp 4 -o a.png");
    place.done("render scene.kdl --spp 16 --resume -o a.png");
    place.done("render scene.kdl --spp 16 -o b.png");
    assert_eq!(place.film("a.luch"), place.film("b.luch"));
    // The film alone is enough.
    place.done("render --resume a.luch --spp 32");
    place.done("render scene.kdl --spp 32 -o c.png");
    assert_eq!(place.film("a.luch"), place.film("c.luch"));
    place.done("develop a.luch -o again.png -o again.exr");
    let image = |name: &str| codec::decode(&place.bytes(name), None).unwrap().to_rgb();
    assert_eq!(image("again.png"), image("c.png"));
    assert_eq!(image("again.exr"), place.film("c.luch").to_image());
}
