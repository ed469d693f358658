//! Cameras and lamps.

use crate::asset::Asset;
use glam::Vec3;
use luch_image::Rgb;
use luch_scene::{Light, Projection};
use serde_json::{Value, json};

fn with_light(light: Value, node: Value) -> Asset {
    let mut asset = Asset::new();
    asset.json["extensions"] = json!({ "KHR_lights_punctual": { "lights": [light] } });
    asset.json["nodes"] = json!([node]);
    asset.json["nodes"][0]["extensions"] = json!({ "KHR_lights_punctual": { "light": 0 } });
    asset
}

#[test]
fn point_lights() {
    let light = json!({ "type": "point", "color": [1, 0.5, 0.25], "intensity": 8 });
    let scene = with_light(light, json!({ "translation": [1, 2, 3], "scale": [5, 5, 5] })).scene();
    let expected = Light::Point { position: Vec3::new(1.0, 2.0, 3.0), intensity: Rgb::new(8.0, 4.0, 2.0) };
    assert_eq!(scene.lights, [expected]);
}

#[test]
fn spots_shine_along_minus_z_of_their_node() {
    // Half a turn about y.
    let node = json!({ "rotation": [0, 1, 0, 0] });
    let spot = json!({ "innerConeAngle": 0.25, "outerConeAngle": 0.5 });
    for (light, angles) in [
        (json!({ "type": "spot", "spot": spot }), [0.25, 0.5]),
        (json!({ "type": "spot", "spot": {} }), [0.0, std::f32::consts::FRAC_PI_4]),
    ] {
        let scene = with_light(light, node.clone()).scene();
        let Light::Spot { direction, intensity, inner_angle, outer_angle, .. } = scene.lights[0] else {
            panic!()
        };
        assert!(direction.abs_diff_eq(Vec3::Z, 1e-6));
        assert_eq!((intensity, [inner_angle, outer_angle]), (Rgb::WHITE, angles));
    }
    let wrong = json!({ "type": "spot", "spot": { "innerConeAngle": 1, "outerConeAngle": 0.5 } });
    let (_, warning) = with_light(wrong, node).scene_and_warning();
    assert!(
        warning.contains("/extensions/KHR_lights_punctual/lights/0/spot: the cone angles 1 and 0.5"),
        "{warning}"
    );
}

#[test]
fn suns() {
    let scene = with_light(json!({ "type": "directional", "intensity": 3 }), json!({})).scene();
    let expected = Light::Sun { direction: Vec3::NEG_Z, irradiance: Rgb::gray(3.0), angular_radius: 0.0 };
    assert_eq!(scene.lights, [expected]);
    let (_, warning) = with_light(json!({ "type": "point", "range": 3 }), json!({})).scene_and_warning();
    assert!(warning.contains("the range of a lamp is not honoured"), "{warning}");
}

#[test]
fn wrong_lights_are_refused() {
    let error = with_light(json!({ "type": "area" }), json!({})).error();
    assert!(error.contains("/lights/0/type: is \"area\", expected"), "{error}");
}

#[test]
fn cameras_set_the_view_and_the_shape_of_the_picture() {
    let mut asset = Asset::new();
    asset.json["cameras"] = json!([
        { "name": "wide", "type": "perspective", "perspective": { "yfov": 0.75, "aspectRatio": 2, "znear": 0.1 } },
        { "type": "orthographic", "orthographic": { "xmag": 3, "ymag": 1.5, "znear": 0, "zfar": 9 } },
    ]);
    // Half a turn about x: looks along +Z, head down.
    asset.json["nodes"] = json!([
        { "camera": 0, "translation": [1, 2, 3], "rotation": [1, 0, 0, 0], "scale": [2, 2, 2] },
        { "camera": 1, "name": "plan" },
        { "camera": 0, "name": "again" },
    ]);
    let scene = asset.scene();
    let names: Vec<&str> = scene.cameras.iter().map(|named| named.name.as_str()).collect();
    assert_eq!(names, ["wide", "plan", "again"]);
    let camera = &scene.cameras[0].camera;
    assert_eq!(camera.projection, Projection::Perspective { field_of_view_y: 0.75 });
    assert_eq!(camera.position, Vec3::new(1.0, 2.0, 3.0));
    assert!(camera.orientation.z_axis.abs_diff_eq(Vec3::NEG_Z, 1e-6));
    assert!(camera.orientation.y_axis.abs_diff_eq(Vec3::NEG_Y, 1e-6));
    assert_eq!(scene.cameras[1].camera.projection, Projection::Orthographic { height: 3.0 });
    assert_eq!(scene.settings.width, 2 * scene.settings.height);
}

#[test]
fn cameras_that_see_nothing_are_left_out() {
    for camera in [
        json!({ "type": "perspective", "perspective": { "yfov": 3.5, "znear": 0.1 } }),
        json!({ "type": "orthographic", "orthographic": { "xmag": 1, "ymag": 0, "znear": 0, "zfar": 1 } }),
    ] {
        let mut asset = Asset::new();
        asset.json["cameras"] = json!([camera]);
        asset.json["nodes"] = json!([{ "camera": 0 }]);
        let (_, warning) = asset.scene_and_warning();
        assert!(warning.contains("/cameras/0: a camera that sees nothing"), "{warning}");
    }
}
