//! The scenes of the project load, without a warning, and hold what they say.

use luch_formats::load;
use luch_scene::{Environment, Integrator, Shape};
use std::path::PathBuf;

fn folder() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../scenes")
}

#[test]
fn every_scene_loads_silently() {
    let mut count = 0;
    for entry in std::fs::read_dir(folder()).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|e| e != "kdl") {
            continue;
        }
        let loaded = load(&path).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(loaded.warnings, [], "{}", path.display());
        assert_eq!(loaded.notes, [] as [String; 0], "{}", path.display());
        count += 1;
    }
    assert!(count >= 5, "only {count} scenes in {}", folder().display());
}

#[test]
fn the_lecture_shows_flat_and_interpolated_normals_of_one_ball() {
    let scene = load(&folder().join("lecture.kdl")).unwrap().scene;
    let mesh = |name: &str| {
        let instance = scene.instances.iter().find(|instance| instance.name == name).unwrap();
        match &*scene.shapes[instance.shape.index()] {
            Shape::Mesh(mesh) => mesh,
            other => panic!("{other:?}"),
        }
    };
    let (flat, smooth) = (mesh("facetted"), mesh("smooth"));
    assert_eq!(flat.triangles, smooth.triangles);
    assert!(flat.normals.is_empty());
    assert_eq!(smooth.normals.values.len(), smooth.positions.len());
    let triangles: usize = scene
        .shapes
        .iter()
        .map(|shape| if let Shape::Mesh(mesh) = &**shape { mesh.triangles.len() } else { 0 })
        .sum();
    assert!(triangles < 50_000, "the scene stays quick to render: {triangles} triangles");
}

#[test]
fn the_furnace_says_what_its_closed_form_needs() {
    let scene = load(&folder().join("furnace.kdl")).unwrap().scene;
    let emission = scene.materials[0].emission.unwrap();
    assert!(emission.two_sided && emission.radiance.factor.r == 1.0);
    assert_eq!(scene.settings.integrator, Integrator::Path { max_depth: 256 });
    assert_eq!(scene.environment, None::<Environment>);
}
