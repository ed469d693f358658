//! `luch compare` and `luch check`.

use crate::workplace::{SCENE, Workplace};

#[test]
fn pictures_are_compared() {
    let place = Workplace::new();
    place.done("render scene.kdl --spp 2 -o a.exr");
    place.done("render scene.kdl --spp 64 -o b.exr");
    let said = place.done("compare a.exr a.luch --json --max-mse 0");
    let object: serde_json::Value = serde_json::from_str(&said.out).unwrap();
    assert_eq!((object["mse"].as_f64(), object["ssim"].as_f64()), (Some(0.0), Some(1.0)));
    let said = place.done("compare a.exr b.exr -o difference.png");
    assert!(said.out.contains("PSNR") && place.path("difference.png").exists());
    let said = place.run("compare a.exr b.exr --max-rel-mse 1e-9");
    assert_eq!(said.code, Some(1));
    assert!(said.out.contains("exceeded"), "{}", said.out);
    place.done("render scene.kdl --size 20x20 -o small.png");
    assert!(place.fails("compare a.exr small.png", 1).err.contains("48×40"));
}

#[test]
fn a_scene_is_examined() {
    let place = Workplace::empty();
    let more = "material \"spare\" { diffuse 0.1 }\nobject \"hull\" material=\"clay\" { sphere radius=9 }\n";
    place.write("scene.kdl", &format!("{SCENE}{more}"));
    let said = place.done("check scene.kdl");
    for word in
        ["\"spare\" is not used", "inside object \"hull\"", "open: 4 border edges", "48×40, 4 samples"]
    {
        assert!(said.out.contains(word), "{word}\n{}", said.out);
    }
    let report: serde_json::Value = serde_json::from_str(&place.done("check scene.kdl --json").out).unwrap();
    assert_eq!(
        (report["counts"]["instances"].as_u64(), report["counts"]["triangles"].as_u64()),
        (Some(4), Some(4))
    );
    assert_eq!(report["meshes"][0]["is_closed"].as_bool(), Some(false));
}
