//! Real files: all load, and what is in them is what is known to be in them.

use crate::asset::{data_folder, gltf_files, mesh, triangle_count};
use glam::{Vec2, Vec3, Vec4};
use luch_formats::{Files, Loaded, load_with};
use luch_image::Rgb;
use luch_scene::{Light, Material, Opacity, Principled, Projection, Sides, Surface, Texture, Wrap};
use std::path::Path;

/// Sound files that need what is not done, and the reason given.
const REFUSED: [(&str, &str); 9] = [
    ("asset-generator/Compatibility/Compatibility_04.gltf", "/asset/minVersion"),
    ("asset-generator/Compatibility/Compatibility_05.gltf", "FAKE_materials_quantumRendering"),
    ("draco/Box/glTF_Binary/Box_Draco.glb", "KHR_draco_mesh_compression"),
    ("gltf-transform/BoxDraco.gltf", "KHR_draco_mesh_compression"),
    ("gltf-transform/BoxMeshopt.glb", "EXT_meshopt_compression"),
    ("gltf-transform/BoxMeshopt.gltf", "EXT_meshopt_compression"),
    ("gltf-transform/DracoSparseMesh.gltf", "KHR_draco_mesh_compression"),
    ("meshopt/", "EXT_meshopt_compression"),
    ("playcanvas/heart_draco/heart_draco.glb", "KHR_draco_mesh_compression"),
];

#[test]
fn every_sound_file_loads_or_says_what_it_needs() {
    let Some(folder) = data_folder() else { return };
    let (mut loaded, mut refused) = (0, 0);
    for file in gltf_files(&folder) {
        let name = file.strip_prefix(&folder).unwrap().to_str().unwrap().replace('\\', "/");
        if name.starts_with("invalid") {
            continue;
        }
        let reason = REFUSED.iter().find(|(prefix, _)| name.starts_with(prefix)).map(|(_, reason)| *reason);
        match (load_with(&file, &Files::disk()), reason) {
            (Ok(Loaded { scene, .. }), None) => {
                assert_eq!(scene.problems(), [""; 0], "{name}");
                loaded += 1;
            }
            (Err(error), Some(reason)) => {
                assert!(error.to_string().contains(reason), "{error}");
                refused += 1;
            }
            (Ok(_), Some(_)) => panic!("{name} loads, though it cannot be decoded"),
            (Err(error), None) => panic!("{name} is sound, but: {error}"),
        }
    }
    eprintln!("glTF files: {loaded} loaded, {refused} refused for what they need");
    assert!(loaded >= 90 && refused >= 9, "{loaded} and {refused}");
}

/// What is in a file: instances, shapes, triangles, materials, textures.
#[rustfmt::skip]
const COUNTS: [(&str, [usize; 5]); 22] = [
    ("asset-generator/Buffer_Interleaved/Buffer_Interleaved_03.gltf", [1, 1, 2, 1, 1]),
    ("asset-generator/Instancing/Instancing_06.gltf", [2, 1, 2, 1, 1]),
    ("asset-generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_01.gltf", [0, 0, 0, 0, 0]),
    ("asset-generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_04.gltf", [1, 1, 2, 1, 0]),
    ("asset-generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_05.gltf", [1, 1, 2, 1, 0]),
    ("asset-generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_12.gltf", [1, 1, 2, 1, 0]),
    ("asset-generator/Mesh_Primitives/Mesh_Primitives_00.gltf", [1, 1, 2, 2, 0]),
    ("blender-io/00_empty_scene/00_empty_scene.gltf", [0, 0, 0, 0, 0]),
    ("blender-io/00_no_scene/00_no_scene.gltf", [1, 1, 12, 1, 0]),
    ("blender-io/02_node_hierarchy/02_node_hierarchy.gltf", [2, 2, 60, 1, 0]),
    ("blender-io/03_skinned_cylinder/03_skinned_cylinder.gltf", [1, 1, 316, 1, 0]),
    ("blender-io/14_emission_strength/14_emission_strength.gltf", [18, 18, 17280, 18, 1]),
    ("blender-io/16_volume/16_volume.gltf", [25, 20, 236, 20, 2]),
    ("blender-io/24_gpu_instancing/24_gpu_instancing.gltf", [1900, 2, 4034, 2, 0]),
    ("draco/Box/glTF_Binary/Box.glb", [1, 1, 12, 1, 0]),
    ("draco/VertexColorTest/glTF/VertexColorTest.gltf", [2, 2, 36, 2, 2]),
    ("khronos/AnisotropyStrengthTest/AnisotropyStrengthTest.glb", [50, 50, 97240, 50, 1]),
    ("khronos/ClearCoatTest/ClearCoatTest.glb", [27, 27, 37116, 19, 5]),
    ("khronos/TextureSettingsTest/glTF/TextureSettingsTest.gltf", [10, 10, 72, 10, 9]),
    ("khronos/TextureTransformTest/glTF/TextureTransformTest.gltf", [12, 9, 18, 9, 5]),
    ("ktx2/agi-ktx2/0/0.glb", [1, 1, 18916, 1, 0]),
    ("playcanvas/simple-instancing/simple-instancing.glb", [125, 1, 12, 1, 0]),
];

#[test]
fn counts() {
    let Some(folder) = data_folder() else { return };
    for (name, expected) in COUNTS {
        let scene = load(&folder, name).scene;
        let found = [
            scene.instances.len(),
            scene.shapes.len(),
            triangle_count(&scene),
            scene.materials.len(),
            scene.textures.len(),
        ];
        assert_eq!(found, expected, "{name}");
    }
}

fn load(folder: &Path, name: &str) -> Loaded {
    load_with(&folder.join(name), &Files::disk()).unwrap_or_else(|error| panic!("{error}"))
}

fn principled(material: &Material) -> &Principled {
    match &material.surface {
        Surface::Principled(principled) => principled,
        other => panic!("{other:?} is not principled"),
    }
}

#[test]
fn sparse_values() {
    let Some(folder) = data_folder() else { return };
    let scene = load(&folder, "khronos/SimpleSparseAccessor/glTF/SimpleSparseAccessor.gltf").scene;
    // The file's bounds: seven by two vertices at height 0 and 1, of which three of the upper row are raised up to 4.
    let positions = &mesh(&scene, 0).positions;
    let highest = positions.iter().copied().reduce(Vec3::max).unwrap();
    assert_eq!((positions.len(), highest), (14, Vec3::new(6.0, 4.0, 0.0)));
    assert_eq!(positions.iter().filter(|position| position.y > 1.0).count(), 3);
}

#[test]
fn vertex_colours_are_the_same_in_every_storage() {
    let Some(folder) = data_folder() else { return };
    let colors = |kind: usize| -> Vec<Vec4> {
        let name =
            format!("asset-generator/Mesh_PrimitiveVertexColor/Mesh_PrimitiveVertexColor_0{kind}.gltf");
        mesh(&load(&folder, &name).scene, 0).colors.values.clone()
    };
    let [rgb, rgba] = [0, 3].map(colors);
    assert_eq!((rgb.len(), rgba.len()), (4, 4));
    // The stored integers are within one step of the floating-point colours.
    for (kind, reference, step) in
        [(1, &rgb, 1.0 / 255.0), (2, &rgb, 1.0 / 65535.0), (4, &rgba, 1.0 / 255.0), (5, &rgba, 1.0 / 65535.0)]
    {
        for (found, expected) in colors(kind).iter().zip(reference) {
            assert!(found.abs_diff_eq(*expected, step), "{kind}: {found} is not {expected}");
        }
    }
}

#[test]
fn texture_transforms_and_wraps() {
    let Some(folder) = data_folder() else { return };
    let scene = load(&folder, "blender-io/09_texture_transform/09_texture_transform.gltf").scene;
    let used = principled(&scene.materials[0]).base_color.texture.unwrap();
    // offset (0.1, 0.2), rotation 0.3, scale (4, 5): the mesh's upper left corner is glTF's origin.
    assert!(used.place(Vec2::new(0.0, 1.0)).abs_diff_eq(Vec2::new(0.1, 0.8), 1e-6));
    let along_u = used.place(Vec2::new(1.0, 1.0)) - used.place(Vec2::new(0.0, 1.0));
    assert!(along_u.abs_diff_eq(4.0 * Vec2::new(libm::cosf(0.3), libm::sinf(0.3)), 1e-5), "{along_u}");
    let scene = load(&folder, "blender-io/13_texture_wrapping/13_texture_wrapping.gltf").scene;
    let wraps: Vec<[Wrap; 2]> = scene
        .textures
        .iter()
        .map(|texture| match texture {
            Texture::Image { wrap, .. } => *wrap,
            Texture::Checker { .. } => panic!("no picture"),
        })
        .collect();
    assert_eq!(wraps, [[Wrap::Mirror; 2], [Wrap::Repeat, Wrap::Clamp]]);
}

#[test]
fn factors_of_every_material_extension() {
    let Some(folder) = data_folder() else { return };
    let Loaded { scene, warnings, .. } = load(&folder, "blender-io/22_factors/22_factors.gltf");
    let material = &scene.materials[0];
    let found = principled(material);
    assert_eq!(found.base_color.factor, Rgb::new(0.5, 0.6, 0.7));
    assert_eq!((found.metallic.factor, found.roughness.factor), (0.2, 0.3));
    assert_eq!((found.ior, found.transmission.factor, found.thin_walled), (1.45, 0.36, false));
    assert_eq!((found.specular.factor, found.specular_color.factor), (0.25, Rgb::new(0.7, 0.6, 0.5)));
    assert_eq!(material.emission.unwrap().radiance.factor, Rgb::new(0.4, 0.5, 0.6));
    assert!(matches!(material.opacity, Opacity::Blend { alpha } if alpha.factor == 0.123));
    assert_eq!(material.sides, Sides::Both);
    let named = |word: &str| warnings.iter().any(|warning| warning.to_string().contains(word));
    assert!(["KHR_materials_clearcoat", "KHR_materials_sheen", "attenuation"].into_iter().all(named));
    assert_eq!(warnings.len(), 3, "{warnings:?}");
}

#[test]
fn alpha_mask_and_unlit() {
    let Some(folder) = data_folder() else { return };
    let scene = load(&folder, "blender-io/01_alpha_mask/01_alpha_mask.gltf").scene;
    let Opacity::Mask { alpha, cutoff } = scene.materials[0].opacity else { panic!() };
    assert!(alpha.texture.is_some() && cutoff > 0.0);
    let scene = load(&folder, "khronos/UnlitTest/glTF/UnlitTest.gltf").scene;
    let emitted: Vec<Rgb> =
        scene.materials.iter().map(|material| material.emission.unwrap().radiance.factor).collect();
    assert_eq!(emitted, [Rgb::new(1.0, 0.217_637_64, 0.0), Rgb::new(0.0, 0.217_637_64, 1.0)]);
}

#[test]
fn lamps_and_cameras() {
    let Some(folder) = data_folder() else { return };
    let scene = load(&folder, "playcanvas/Lights/Lights.glb").scene;
    assert_eq!(scene.lights.len(), 4);
    assert!(
        matches!(scene.lights[0], Light::Point { intensity, .. } if intensity == Rgb::new(5.0, 0.0, 0.0))
    );
    // The first spot hangs above and points straight down.
    let Light::Spot { position, direction, outer_angle, .. } = scene.lights[1] else { panic!() };
    assert!(position.abs_diff_eq(Vec3::new(-0.270_571, 1.943_267, 0.352_657), 1e-5));
    assert!(direction.abs_diff_eq(Vec3::NEG_Y, 1e-6), "{direction}");
    assert_eq!(outer_angle, std::f32::consts::FRAC_PI_8);
    assert!(
        matches!(scene.lights[3], Light::Sun { irradiance, .. } if irradiance.r == 0.0 && irradiance.g > 0.999)
    );
    assert_eq!(scene.cameras[0].name, "Camera");
    let scene = load(&folder, "playcanvas/geometry-camera-light/geometry-camera-light.glb").scene;
    let names: Vec<&str> = scene.cameras.iter().map(|named| named.name.as_str()).collect();
    assert_eq!(names, ["Persp", "Ortho"]);
    assert_eq!(scene.cameras[1].camera.projection, Projection::Orthographic { height: 27.0 });
    assert_eq!((scene.settings.width, scene.settings.height), (960, 540), "16 : 9");
}
