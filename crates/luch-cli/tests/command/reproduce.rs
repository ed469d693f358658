//! Pictures that say where they come from.

use crate::workplace::{SCENE, Workplace};

#[test]
fn a_picture_comes_out_the_same_until_its_scene_changes() {
    let place = Workplace::new();
    place.done("render scene.kdl --seed 7 --size 40x40 --filter tent:1 -o a.png -o a.jpg -o a.exr -o a.hdr");
    for name in ["a.png", "a.jpg", "a.exr", "a.hdr", "a.luch"] {
        assert!(place.done(&format!("reproduce {name}")).out.starts_with("equal"), "{name}");
    }
    place.write(
        "scene.kdl",
        &SCENE.replace("rotate-x 180; translate 0 2.5 0", "rotate-x 180; translate 0 2.6 0"),
    );
    let said = place.run("reproduce a.png --threads 1");
    assert_eq!(said.code, Some(1));
    assert!(said.out.starts_with("different: scene.kdl"), "{}", said.out);
    place.write("moved.kdl", SCENE);
    place.done("reproduce a.png --scene moved.kdl");
}

#[test]
fn an_uneven_picture_is_reproduced_tile_by_tile() {
    let place = Workplace::new();
    place.done("render scene.kdl --size 200x100 --time 400ms --threads 1 -o a.exr");
    assert!(place.film("a.luch").coverage().len() > 1, "time ended just between two passes");
    place.done("reproduce a.exr");
}

#[test]
fn pictures_of_others_are_refused() {
    let place = Workplace::new();
    place.done("render scene.kdl --no-checkpoint -o a.pfm");
    assert!(place.fails("reproduce a.pfm", 1).err.contains("luch:"));
    place.fails("reproduce scene.kdl", 1);
    place.done("render scene.kdl -o b.png");
    std::fs::remove_file(place.path("scene.kdl")).unwrap();
    assert!(place.fails("reproduce b.png", 1).err.contains("--scene"));
}
