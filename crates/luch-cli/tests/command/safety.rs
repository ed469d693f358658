//! What must not be written over stays as it is.

use crate::workplace::{SCENE, Said, Workplace, signal};

#[test]
fn a_scene_is_never_replaced() {
    let place = Workplace::new();
    for name in ["inp.png", "s2.luch"] {
        place.write(name, SCENE);
    }
    std::fs::hard_link(place.path("scene.kdl"), place.path("hard.png")).unwrap();
    for line in [
        "render scene.kdl -o y.png --checkpoint scene.kdl",
        "render inp.png -o inp.png",
        "render inp.png -o ./inp.png --no-checkpoint",
        "render s2.luch -o s2.png",
        "render scene.kdl -o hard.png",
    ] {
        place.fails(line, 2);
    }
    assert_eq!(place.files(), ["hard.png", "inp.png", "s2.luch", "scene.kdl"]);
    for name in ["inp.png", "s2.luch", "scene.kdl"] {
        assert_eq!(place.bytes(name), SCENE.as_bytes(), "{name}");
    }
}

#[test]
fn what_a_scene_is_made_of_is_never_replaced() {
    let place = Workplace::new();
    place.done("render scene.kdl --no-checkpoint -o wood.png");
    let before = place.bytes("wood.png");
    place.write(
        "quad.obj",
        "mtllib quad.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl wood\nf 1/1 2/1 3/1\n",
    );
    place.write("quad.mtl", "newmtl wood\nKd 1 1 1\nmap_Kd wood.png\n");
    let said = place.fails("render quad.obj -o wood.png --spp 1", 2);
    assert!(said.err.contains("wood.png"), "{}", said.err);
    assert_eq!(place.bytes("wood.png"), before);
}

#[test]
fn a_film_replaces_nothing_but_a_film() {
    let place = Workplace::new();
    assert!(place.fails("render scene.kdl -o y.png --checkpoint y.film", 2).err.contains(".luch"));
    place.write("notes.luch", "hours of work");
    for line in [
        "render scene.kdl -o notes.png",
        "render scene.kdl -o notes.luch",
        "render scene.kdl -o y.png --checkpoint notes.luch",
    ] {
        assert!(place.fails(line, 1).err.contains("LUCHFILM"), "{line}");
    }
    assert_eq!(place.bytes("notes.luch"), b"hours of work");
    place.done("render scene.kdl -o a.png");
    place.done("render scene.kdl -o a.png");
}

#[test]
fn pictures_that_are_compared_stay() {
    let place = Workplace::new();
    place.done("render scene.kdl --no-checkpoint -o a.png -o b.png");
    let before = place.bytes("b.png");
    for line in [
        "compare a.png b.png -o b.png",
        "compare a.png b.png -o ./a.png",
        "compare a.png b.png -o c.gif",
        "compare a.png b.png -o c.luch",
        "compare a.png b.png --max-mse nan",
        "compare a.png b.png --max-mse -1",
    ] {
        place.fails(line, 2);
    }
    assert_eq!(place.bytes("b.png"), before);
    assert_eq!(place.files(), ["a.png", "b.png", "scene.kdl"]);
}

#[test]
fn one_file_has_one_content() {
    let place = Workplace::new();
    assert!(place.fails("render scene.kdl -o x.png -o ./x.png", 2).err.contains("twice"));
    let said = place.fails("render scene.kdl --error 1% --integrator normal", 2);
    assert!(said.err.contains("normal"), "{}", said.err);
    let long = "x".repeat(300);
    place.fails(&format!("render scene.kdl -o {long}.png"), 1);
    place.done("render scene.kdl --no-checkpoint -o x.exr --layers normal,normal");
}

#[test]
fn a_film_finds_its_scene_beside_it() {
    let place = Workplace::new();
    place.done("render scene.kdl -o a.png");
    std::fs::create_dir(place.path("away")).unwrap();
    for name in ["scene.kdl", "a.luch"] {
        std::fs::rename(place.path(name), place.path("away").join(name)).unwrap();
    }
    place.done("render --resume away/a.luch --spp 8");
    assert_eq!(place.film("away/a.luch").mean_samples(), 8.0);
}

#[cfg(unix)]
#[test]
fn links_stay_and_devices_are_refused() {
    use std::os::unix::fs::symlink;
    let place = Workplace::new();
    place.write("target.png", "old");
    symlink("target.png", place.path("link.png")).unwrap();
    place.done("render scene.kdl --no-checkpoint -o link.png");
    assert!(place.path("link.png").is_symlink() && place.bytes("target.png").starts_with(b"\x89PNG"));
    symlink("/dev/null", place.path("null.png")).unwrap();
    assert!(place.fails("render scene.kdl -o null.png", 1).err.contains("not a plain file"));
    assert!(std::process::Command::new("mkfifo").arg(place.path("pipe.png")).status().unwrap().success());
    assert!(place.fails("render scene.kdl -o pipe.png", 1).err.contains("not a plain file"));
}

#[cfg(target_os = "linux")]
#[test]
fn lost_results_are_told() {
    let place = Workplace::new();
    let full = std::fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
    let ran = std::process::Command::new(env!("CARGO_BIN_EXE_luch"))
        .args(["check".as_ref(), place.path("scene.kdl").as_os_str()])
        .stdout(full)
        .output()
        .unwrap();
    let said = Said::of(ran);
    assert_eq!(said.code, Some(1));
    assert!(said.err.contains("standard output"), "{}", said.err);
}

#[test]
fn the_advice_to_continue_can_be_followed() {
    let place = Workplace::new();
    let child = place.start("render --spp 65536 -o a.png -- scene.kdl");
    place.await_file("a.png");
    signal(&child, "INT");
    let said = Said::of(child.wait_with_output().unwrap());
    let advice = said.err.lines().find_map(|line| line.strip_prefix("continue with: ")).unwrap();
    assert!(advice.ends_with("render --spp 65536 -o a.png --resume -- scene.kdl"), "{advice}");
    let before = place.film("a.luch").mean_samples();
    let child = place.start("render --spp 65536 -o a.png --resume -- scene.kdl");
    std::thread::sleep(std::time::Duration::from_millis(500));
    signal(&child, "INT");
    let said = Said::of(child.wait_with_output().unwrap());
    assert_eq!(said.code, Some(130), "{}", said.err);
    assert!(place.film("a.luch").mean_samples() > before);
}
