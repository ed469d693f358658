//! Meshes that are as fine as the cameras of their scene ask for.

use luch_formats::{Files, load_with};
use luch_scene::Shape;
use std::path::{Path, PathBuf};

fn load(text: &str) -> Result<Vec<usize>, String> {
    let files = Files::memory([(PathBuf::from("scene.kdl"), format!("luch 1\n{text}").into_bytes())]);
    let loaded = load_with(Path::new("scene.kdl"), &files).map_err(|error| error.to_string())?;
    let triangles = |shape: &Shape| match shape {
        Shape::Mesh(mesh) => mesh.triangles.len(),
        _ => 0,
    };
    Ok(loaded.scene.shapes.iter().map(|shape| triangles(shape)).collect())
}

fn count(mesh: &str, camera: &str, object: &str) -> usize {
    load(&format!("{camera}\nmesh \"m\" {{ {mesh} }}\nobject mesh=\"m\" {{ {object} }}")).unwrap()[0]
}

const NEAR: &str = "camera { from 0 0 3; to 0 0 0; fov 40 }";
const FAR: &str = "camera { from 0 0 30; to 0 0 0; fov 40 }";

#[test]
fn what_is_near_gets_more_triangles() {
    for mesh in [
        "cuboid; subdivide pixels=8",
        "tetrahedron; subdivide scheme=loop pixels=8",
        "nurbs-sphere pixels=0.5",
    ] {
        let near = count(mesh, NEAR, "");
        let far = count(mesh, FAR, "");
        assert!(near > 3 * far && far > 8, "{mesh}: {near} {far}");
        // A copy that is ten times as large and ten times as far away looks the same.
        assert_eq!(count(mesh, "camera { from 0 0 30; to 0 0 0; fov 40 }", "scale 10"), near, "{mesh}");
        // The copy that is seen best decides.
        let copies = |camera| {
            let two = "object mesh=\"m\"\nobject mesh=\"m\" { translate 0 0 -100 }";
            load(&format!("{camera}\nmesh \"m\" {{ {mesh} }}\n{two}")).unwrap()[0]
        };
        assert!(copies(NEAR) >= near && copies(NEAR) < near + near / 4, "{mesh}");
        // So does any of several cameras, and more rows are finer.
        assert!(count(mesh, &format!("{FAR}\n{NEAR}"), "") >= near);
        assert!(count(mesh, &format!("settings {{ size 1920 1080 }}\n{FAR}"), "") > far);
        let parallel = "camera { from 0 0 30; to 0 0 0; orthographic height=2 }";
        assert!(count(mesh, parallel, "") > far, "{mesh}");
    }
    // What is done to the mesh afterwards counts.
    let later = count("cuboid; subdivide pixels=8; scale 10", FAR, "");
    assert_eq!(later, count("cuboid; subdivide pixels=8", FAR, "scale 10"));
}

#[test]
fn pixels_want_a_camera() {
    let error = load("mesh \"m\" { cuboid; subdivide pixels=8 }\nobject mesh=\"m\"").unwrap_err();
    assert!(error.contains("no camera") && error.contains("scene.kdl:2:"), "{error}");
    let error =
        load(&format!("{NEAR}\nmesh \"m\" {{ cuboid; subdivide pixels=0 }}\nobject mesh=\"m\"")).unwrap_err();
    assert!(error.contains("from 0.1 to 1000"), "{error}");
    let error =
        load(&format!("{NEAR}\nmesh \"m\" {{ cuboid; subdivide scheme=sqrt3 pixels=5 }}\nobject mesh=\"m\""))
            .unwrap_err();
    assert!(error.contains("catmull-clark and loop"), "{error}");
}
