//! The tree of nodes and where it puts things.

use crate::asset::Asset;
use glam::{Affine3A, Quat, Vec3};
use serde_json::json;
use std::f32::consts::FRAC_PI_2;

fn assert_near(found: Affine3A, expected: Affine3A) {
    assert!(found.abs_diff_eq(expected, 1e-6), "{found:?} is not {expected:?}");
}

#[test]
fn transforms_multiply_down_the_tree() {
    let mut asset = Asset::triangle();
    let half = std::f32::consts::FRAC_1_SQRT_2;
    asset.json["nodes"] = json!([
        { "mesh": 0, "scale": [2, 3, 4] },
        { "children": [0], "rotation": [0, half, 0, half] },
        { "children": [1], "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1] },
    ]);
    let expected = Affine3A::from_translation(Vec3::new(5.0, 6.0, 7.0))
        * Affine3A::from_quat(Quat::from_rotation_y(FRAC_PI_2))
        * Affine3A::from_scale(Vec3::new(2.0, 3.0, 4.0));
    assert_near(asset.scene().instances[0].placement, expected);
}

#[test]
fn mirrors_keep_their_determinant() {
    let mut asset = Asset::triangle();
    asset.json["nodes"] = json!([{ "mesh": 0, "scale": [-1, 1, 1] }, { "mesh": 0 }]);
    let scene = asset.scene();
    assert_eq!(scene.shapes.len(), 1, "both nodes share the mesh");
    assert!(scene.instances[0].placement.matrix3.determinant() < 0.0);
    assert!(scene.instances[1].placement.matrix3.determinant() > 0.0);
}

#[test]
fn only_the_chosen_scene_is_shown() {
    let mut asset = Asset::triangle();
    asset.json["nodes"] = json!([{ "mesh": 0, "name": "a" }, { "mesh": 0, "name": "b", "children": [2] }, { "mesh": 0, "name": "c" }]);
    let names = |asset: &Asset| -> Vec<String> {
        asset.load().unwrap().scene.instances.into_iter().map(|instance| instance.name).collect()
    };
    assert_eq!(names(&asset), ["a", "b", "c"], "no scene: all roots");
    asset.json["scenes"] = json!([{ "nodes": [1] }]);
    assert_eq!(names(&asset), ["b", "c"], "no default: the first scene");
    asset.json["scenes"] = json!([{ "nodes": [1] }, { "nodes": [0] }]);
    asset.json["scene"] = json!(1);
    assert_eq!(names(&asset), ["a"]);
    let (_, warning) = asset.scene_and_warning();
    assert!(warning.contains("/scenes: the file has 2 scenes; scene 1 alone is shown"), "{warning}");
}

#[test]
fn objects_without_volume_are_left_out() {
    let mut asset = Asset::triangle();
    asset.json["nodes"] = json!([{ "mesh": 0, "scale": [0, 0, 0] }, { "mesh": 0 }]);
    let (scene, warning) = asset.scene_and_warning();
    assert_eq!(scene.instances.len(), 1);
    assert!(warning.contains("/nodes/0: an object whose transform cannot be inverted"), "{warning}");
}

#[test]
fn rings_and_second_parents_are_refused() {
    let trees = [
        (json!([{ "children": [1] }, { "children": [0] }]), "/nodes/0: the node is among its own ancestors"),
        (json!([{ "children": [0] }]), "/nodes/0: the node is among its own ancestors"),
        (
            json!([{ "children": [2] }, { "children": [2] }, {}]),
            "/nodes/1/children/0: node 2 already is a child of node 0",
        ),
        (json!([{ "children": [7] }]), "/nodes/0/children/0: refers to /nodes/7, which does not exist"),
    ];
    for (nodes, expected) in trees {
        let mut asset = Asset::new();
        asset.json["nodes"] = nodes;
        assert!(asset.error().contains(expected), "{}", asset.error());
    }
}

#[test]
fn a_long_chain_of_nodes_is_no_recursion() {
    const LENGTH: usize = 100_000;
    let mut asset = Asset::triangle();
    let mut nodes: Vec<_> =
        (1..LENGTH).map(|child| json!({ "children": [child], "translation": [0.5, 0, 0] })).collect();
    nodes.push(json!({ "mesh": 0 }));
    asset.json["nodes"] = json!(nodes);
    assert_eq!(asset.scene().instances[0].placement.translation.x, 0.5 * (LENGTH - 1) as f32);
}

#[test]
fn instancing_puts_many() {
    let mut asset = Asset::triangle();
    let translations = asset.floats("VEC3", &[1.0, 0.0, 0.0, 2.0, 0.0, 0.0]);
    let scales = asset.floats("VEC3", &[1.0, 1.0, 1.0, 3.0, 3.0, 3.0]);
    asset.json["nodes"] = json!([{
        "mesh": 0,
        "translation": [0, 10, 0],
        "extensions": { "EXT_mesh_gpu_instancing": { "attributes": { "TRANSLATION": translations, "SCALE": scales } } },
    }]);
    let scene = asset.scene();
    assert_eq!((scene.shapes.len(), scene.instances.len()), (1, 2));
    let expected =
        Affine3A::from_translation(Vec3::new(2.0, 10.0, 0.0)) * Affine3A::from_scale(Vec3::splat(3.0));
    assert_near(scene.instances[1].placement, expected);
}

#[test]
fn skins_are_shown_as_bound() {
    let mut asset = Asset::triangle();
    // The joint stands at (0, 2, 0); the inverse bind matrix takes (0, 2, 0) away and scales by two.
    let matrix = [2.0, 0.0, 0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 0.0, 2.0, 0.0, 0.0, -2.0, 0.0, 1.0];
    let matrices = asset.floats("MAT4", &matrix);
    asset.json["skins"] = json!([{ "joints": [1], "inverseBindMatrices": matrices }]);
    asset.json["nodes"] =
        json!([{ "mesh": 0, "skin": 0, "translation": [100, 0, 0] }, { "translation": [0, 2, 0] }]);
    let (scene, warning) = asset.scene_and_warning();
    assert_near(scene.instances[0].placement, Affine3A::from_scale(Vec3::splat(2.0)));
    assert!(warning.contains("/nodes/0/skin: skins are not applied"), "{warning}");
}
