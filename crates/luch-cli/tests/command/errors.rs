//! Plain words about what is wrong, before any time is spent.

use crate::workplace::{SCENE, Workplace};

#[test]
fn alone_it_helps() {
    let place = Workplace::empty();
    let said = place.run("");
    assert_eq!(said.code, Some(2));
    assert!(said.err.contains("render") && said.err.contains("Usage"), "{}", said.err);
    for verb in ["render", "reproduce", "merge", "develop", "compare", "check", "completions"] {
        assert!(place.done(&format!("{verb} --help")).out.contains("Example"), "{verb}");
    }
    assert!(place.done("--version").out.contains("sobol"));
    assert!(place.done("completions bash").out.contains("luch"));
    assert!(place.files().is_empty());
}

#[test]
fn a_slip_in_the_scene_is_shown_where_it_is() {
    let place = Workplace::empty();
    place.write("scene.kdl", &SCENE.replace("diffuse 0.8", "difuse 0.8"));
    let said = place.fails("render scene.kdl", 1);
    assert!(said.err.contains("scene.kdl:5:19") && said.err.contains("^^^^^^"), "{}", said.err);
    assert_eq!(said.err, place.fails("check scene.kdl", 1).err);
    assert!(place.fails("render nowhere.kdl", 1).err.contains("nowhere.kdl: no such file"));
}

#[test]
fn an_impossible_wish_is_refused_before_the_work() {
    let place = Workplace::new();
    for (line, code, word) in [
        ("render scene.kdl -o nowhere/a.png", 1, "nowhere"),
        ("render scene.kdl -o a.gif", 2, ".png"),
        ("render scene.kdl -o a.png -o a.png", 2, "twice"),
        ("render scene.kdl --size 10", 2, "960x540"),
        ("render scene.kdl --size 60000x60000", 1, "pixels"),
        ("render scene.kdl --error 5", 2, "5%"),
        ("render scene.kdl --samples 9..3", 2, "9..3"),
        ("render scene.kdl --spp 4 --samples 0..4", 2, "--samples"),
        ("render scene.kdl --time soon", 2, "30s"),
        ("render scene.kdl --camera top", 1, "\"front\", \"side\""),
        ("render scene.kdl --integrator pth", 2, "plain-path"),
        ("render scene.kdl --tone bright", 2, "pbr-neutral"),
        ("render scene.kdl --layers normal", 2, ".exr"),
        ("render scene.kdl --depth 12", 2, "16"),
        ("render scene.kdl --threads 0", 2, "threads"),
        ("render scene.kdl --resume", 1, "nothing to resume"),
        ("render", 2, "scene"),
        ("merge a.luch -o b.png", 2, ".luch"),
    ] {
        let said = place.fails(line, code);
        assert!(said.err.contains(word), "luch {line}\n{}", said.err);
    }
    assert_eq!(place.files(), ["scene.kdl"]);
}

#[test]
fn a_film_of_something_else_is_not_continued() {
    let place = Workplace::new();
    place.done("render scene.kdl -o a.png");
    let said = place.fails("render scene.kdl -o a.png --resume --seed 5", 1);
    assert!(said.err.contains("seed is 5, was 0"), "{}", said.err);
    place.write("scene.kdl", &SCENE.replace("9 8 7", "9 8 6"));
    let before = place.bytes("a.luch");
    let said = place.fails("render scene.kdl -o a.png --resume --spp 8", 1);
    assert!(said.err.contains("the scene has changed"), "{}", said.err);
    assert_eq!(before, place.bytes("a.luch"));
}

#[test]
fn glass_without_an_inside_is_told() {
    let place = Workplace::empty();
    let scene = |mesh: &str| {
        format!(
            "luch 1\nmaterial \"g\" {{ dielectric ior=1.5 }}\nobject \"bowl\" material=\"g\" {{ mesh {{ {mesh} }} }}\n"
        )
    };
    place.write("open.kdl", &scene("teapot"));
    place.write("closed.kdl", &scene("torus"));
    let said = place.done("check open.kdl").out;
    assert!(
        said.contains("\"bowl\"") && said.contains("no closed body") && said.contains("160 border"),
        "{said}"
    );
    assert!(!place.done("check closed.kdl").out.contains("no closed body"));
}
