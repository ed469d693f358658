//! Materials and their extensions.

use crate::asset::Asset;
use luch_image::Rgb;
use luch_scene::{Material, Opacity, Principled, Sides, Surface};
use serde_json::{Value, json};

fn material(json: Value) -> Material {
    let scene = Asset::with_material(json).scene();
    assert_eq!(scene.materials.len(), 1);
    scene.materials[0].clone()
}

fn principled(json: Value) -> Principled {
    match material(json).surface {
        Surface::Principled(principled) => principled,
        other => panic!("{other:?} is not principled"),
    }
}

fn extended(name: &str, extension: Value) -> Value {
    let mut json = json!({ "extensions": {} });
    json["extensions"][name] = extension;
    json
}

#[test]
fn the_default_material_is_white_rough_metal() {
    // Specification, section 3.9.6: all factors are 1.
    let scene = Asset::triangle().scene();
    assert_eq!(scene.materials[0].sides, Sides::Front);
    for surface in [&scene.materials[0].surface, &material(json!({})).surface] {
        let Surface::Principled(principled) = surface else { panic!("{surface:?}") };
        let expected = Principled { metallic: 1.0.into(), roughness: 1.0.into(), ..Principled::default() };
        assert_eq!(*principled, expected);
    }
}

#[test]
fn factors() {
    let found = material(json!({
        "name": "m",
        "pbrMetallicRoughness": { "baseColorFactor": [0.25, 0.5, 0.75, 0.5], "metallicFactor": 0.125, "roughnessFactor": 0.375 },
        "alphaMode": "BLEND",
        "doubleSided": true,
    }));
    assert_eq!(found.name, "m");
    assert_eq!(found.sides, Sides::Both);
    let Surface::Principled(principled) = found.surface else { panic!() };
    assert_eq!(principled.base_color, Rgb::new(0.25, 0.5, 0.75).into());
    assert_eq!((principled.metallic, principled.roughness), (0.125.into(), 0.375.into()));
    assert_eq!(found.opacity, Opacity::Blend { alpha: 0.5.into() });
}

#[test]
fn alpha_modes() {
    let alpha = json!({ "baseColorFactor": [1, 1, 1, 0.25] });
    let found = |mode: Value| {
        let mut json = mode;
        json["pbrMetallicRoughness"] = alpha.clone();
        material(json).opacity
    };
    assert_eq!(found(json!({})), Opacity::Opaque);
    assert_eq!(found(json!({ "alphaMode": "MASK" })), Opacity::Mask { alpha: 0.25.into(), cutoff: 0.5 });
    let mask = json!({ "alphaMode": "MASK", "alphaCutoff": 0.125 });
    assert_eq!(found(mask), Opacity::Mask { alpha: 0.25.into(), cutoff: 0.125 });
    assert_eq!(material(json!({ "alphaMode": "BLEND" })).opacity, Opacity::Opaque, "alpha is 1 everywhere");
    let (scene, warning) = Asset::with_material(json!({ "alphaMode": "DITHER" })).scene_and_warning();
    assert_eq!(scene.materials[0].opacity, Opacity::Opaque);
    assert!(warning.contains("/materials/0/alphaMode: \"DITHER\" is no alpha mode"), "{warning}");
}

#[test]
fn emission_times_strength_from_the_sides_that_are_there() {
    let strength = json!({ "KHR_materials_emissive_strength": { "emissiveStrength": 8 } });
    let json = json!({ "emissiveFactor": [0.5, 0.25, 0], "extensions": strength, "doubleSided": true });
    let emission = material(json).emission.unwrap();
    assert_eq!(emission.radiance, Rgb::new(4.0, 2.0, 0.0).into());
    assert!(emission.two_sided);
    let emission = material(json!({ "emissiveFactor": [1, 1, 1] })).emission.unwrap();
    assert_eq!((emission.radiance, emission.two_sided), (Rgb::WHITE.into(), false));
    assert_eq!(material(json!({ "emissiveFactor": [0, 0, 0] })).emission, None);
}

#[test]
fn glass() {
    let thin = extended("KHR_materials_transmission", json!({ "transmissionFactor": 0.75 }));
    let found = material(thin.clone());
    assert_eq!(found.sides, Sides::Both);
    let Surface::Principled(principled) = found.surface else { panic!() };
    assert_eq!(principled.transmission, 0.75.into());
    assert!(principled.thin_walled);
    for (thickness, is_thin) in [(0.0, true), (0.5, false)] {
        let mut json = thin.clone();
        json["extensions"]["KHR_materials_volume"] = json!({ "thicknessFactor": thickness });
        let Surface::Principled(principled) = material(json).surface else { panic!() };
        assert_eq!(principled.thin_walled, is_thin);
    }
    let mut json = thin;
    json["extensions"]["KHR_materials_volume"] =
        json!({ "thicknessFactor": 1, "attenuationDistance": 2, "attenuationColor": [1, 0, 0] });
    let (_, warning) = Asset::with_material(json).scene_and_warning();
    assert!(warning.contains("/materials/0/extensions/KHR_materials_volume: attenuation"), "{warning}");
}

#[test]
fn index_of_refraction_and_specular() {
    assert_eq!(principled(extended("KHR_materials_ior", json!({ "ior": 1.25 }))).ior, 1.25);
    assert_eq!(principled(extended("KHR_materials_ior", json!({}))).ior, 1.5);
    let json = json!({ "specularFactor": 0.5, "specularColorFactor": [2, 1, 0.5] });
    let found = principled(extended("KHR_materials_specular", json));
    assert_eq!(found.specular, 0.5.into());
    assert_eq!(found.specular_color, Rgb::new(2.0, 1.0, 0.5).into());
    let json = extended("KHR_materials_ior", json!({ "ior": 0 }));
    let (_, warning) = Asset::with_material(json).scene_and_warning();
    assert!(warning.contains("/materials/0/extensions/KHR_materials_ior/ior"), "{warning}");
}

#[test]
fn unlit_surfaces_emit_their_colour() {
    let json = json!({
        "pbrMetallicRoughness": { "baseColorFactor": [0.25, 0.5, 0.75, 1] },
        "emissiveFactor": [1, 1, 1],
        "extensions": { "KHR_materials_unlit": {} },
    });
    let loaded = Asset::with_material(json).load().unwrap();
    assert_eq!(loaded.warnings, []);
    assert!(loaded.notes.iter().any(|note| note.contains("unlit")), "{:?}", loaded.notes);
    let material = &loaded.scene.materials[0];
    assert_eq!(material.surface, Surface::Absorber);
    assert_eq!(material.emission.unwrap().radiance, Rgb::new(0.25, 0.5, 0.75).into());
}

#[test]
fn numbers_out_of_range_are_moved_and_named() {
    let json = json!({ "pbrMetallicRoughness": { "baseColorFactor": [2, -1, 0.5, 1] } });
    let (scene, warning) = Asset::with_material(json).scene_and_warning();
    let Surface::Principled(principled) = &scene.materials[0].surface else { panic!() };
    assert_eq!(principled.base_color.factor, Rgb::new(1.0, 0.0, 0.5));
    assert!(warning.contains("/materials/0/pbrMetallicRoughness/baseColorFactor"), "{warning}");
}

#[test]
fn vertex_colours_multiply_the_base_colour() {
    let mut asset = Asset::with_material(json!({ "alphaMode": "BLEND" }));
    let colors = asset.floats("VEC4", &[0.5; 12]);
    asset.json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = json!(colors);
    let scene = asset.scene();
    let Surface::Principled(principled) = &scene.materials[0].surface else { panic!() };
    assert!(principled.base_color.vertex_color);
    let Opacity::Blend { alpha } = scene.materials[0].opacity else { panic!() };
    assert!(alpha.vertex_alpha);
}

#[test]
fn what_is_not_honoured_is_named_once_with_a_count() {
    let clearcoat = extended("KHR_materials_clearcoat", json!({ "clearcoatFactor": 1 }));
    let mut asset = Asset::with_material(clearcoat.clone());
    asset.push("materials", clearcoat);
    asset.json["extensionsRequired"] = json!(["KHR_materials_clearcoat"]);
    let (_, warning) = asset.scene_and_warning();
    let expected = "/materials/0/extensions/KHR_materials_clearcoat: the extension \"KHR_materials_clearcoat\" is not \
                    honoured (2 times; this is the first)";
    assert!(warning.contains(expected), "{warning}");
}

#[test]
fn what_hides_geometry_or_is_unknown_is_refused() {
    let names =
        ["KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_meshopt_compression", "X_unknown"];
    for name in names {
        let mut asset = Asset::triangle();
        asset.json["extensionsRequired"] = json!(["KHR_materials_ior", name]);
        let error = asset.error();
        assert!(
            error.contains("/extensionsRequired/1: the file requires") && error.contains(name),
            "{error}"
        );
    }
}
