//! What a scene file says arrives in the scene: every variant, every unit, every default.

use glam::{Affine3A, Mat3, Vec2, Vec3};
use luch_formats::{Files, Loaded, load_with};
use luch_image::{Encoding, Image, Rgb, codec};
use luch_sampling::Sequence;
use luch_scene::*;
use std::f32::consts::{FRAC_PI_2, PI};
use std::path::{Path, PathBuf};

fn load(text: &str) -> Loaded {
    load_files(&[("main.kdl", format!("luch 1\n{text}").into_bytes())])
}

fn load_files(files: &[(&str, Vec<u8>)]) -> Loaded {
    let files = Files::memory(files.iter().map(|(path, bytes)| (PathBuf::from(path), bytes.clone())));
    load_with(Path::new("main.kdl"), &files).unwrap_or_else(|error| panic!("{error}"))
}

fn surface(text: &str) -> Surface {
    load(&format!("material \"m\" {{ {text} }}\nobject {{ sphere; material \"m\" }}")).scene.materials[0]
        .surface
        .clone()
}

#[test]
fn a_file_that_says_nothing_has_default_settings() {
    assert_eq!(load("object { sphere }").scene.settings, Settings::default());
    assert_eq!(load("settings { }\nobject { sphere }").scene.settings, Settings::default());
}

#[test]
fn settings_arrive() {
    let text = "settings { size 640 360; integrator \"plain-path\" { max-depth 7 }; sequence \"halton\"\n
        filter \"gaussian\" radius=2 deviation=0.6; seed 18446744073709551615; normals \"flat\"; cull-back-faces; texture-filter \"none\" }\nobject { sphere }";
    let expected = Settings {
        width: 640,
        height: 360,
        integrator: Integrator::PlainPath { max_depth: 7 },
        sequence: Sequence::Halton,
        filter: Filter::Gaussian { radius: 2.0, deviation: 0.6 },
        seed: u64::MAX,
        normals: Normals::Flat,
        cull_back_faces: true,
        texture_filter: luch_scene::Minification::None,
    };
    assert_eq!(load(text).scene.settings, expected);
    let integrator = |text: &str| {
        load(&format!("settings {{ integrator {text} }}\nobject {{ sphere }}")).scene.settings.integrator
    };
    assert_eq!(integrator("\"direct\""), Integrator::Direct);
    assert_eq!(integrator("\"occlusion\""), Integrator::Occlusion { distance: f32::INFINITY });
    assert_eq!(integrator("\"occlusion\" distance=2"), Integrator::Occlusion { distance: 2.0 });
    for property in Property::ALL {
        assert_eq!(
            integrator(&format!("\"inspect\" property=\"{}\"", property.name())),
            Integrator::Inspect(property)
        );
    }
    let filter = |text: &str| {
        load(&format!("settings {{ filter {text} }}\nobject {{ sphere }}")).scene.settings.filter
    };
    assert_eq!(filter("\"box\""), Filter::Box { radius: 0.5 });
    assert_eq!(filter("\"tent\" radius=3"), Filter::Tent { radius: 3.0 });
    assert_eq!(filter("\"blackman-harris\" radius=2"), Filter::BlackmanHarris { radius: 2.0 });
}

#[test]
fn cameras_arrive_in_radians() {
    let scene = load(
        "camera { from 0 1 5; to 0 1 0; fov 90; lens-radius 0.02; focus 4 }\n\
         camera \"plan\" { from 0 9 0; direction 0 -2 0; up 0 0 -1; orthographic height=3 }\nobject { sphere }",
    )
    .scene;
    let expected = Camera {
        lens_radius: 0.02,
        focus_distance: 4.0,
        ..Camera::looking_at(Vec3::new(0.0, 1.0, 5.0), Vec3::Y, Vec3::Y, FRAC_PI_2)
    };
    assert_eq!(scene.cameras[0].camera, expected);
    let plan = scene.camera(Some("plan")).unwrap();
    assert_eq!(plan.projection, Projection::Orthographic { height: 3.0 });
    assert_eq!(plan.orientation, Mat3::from_cols(Vec3::X, Vec3::NEG_Z, Vec3::Y));
    assert_eq!(plan.focus_distance, 1.0);
}

#[test]
fn surfaces_arrive() {
    let red = Rgb::new(0.8, 0.1, 0.2);
    assert_eq!(surface("absorber"), Surface::Absorber);
    assert_eq!(surface("diffuse 0.8 0.1 0.2"), Surface::Diffuse { color: red.into() });
    assert_eq!(surface("diffuse \"#f00\""), Surface::Diffuse { color: Rgb::new(1.0, 0.0, 0.0).into() });
    let conductor = |reflectance, roughness: f32| Surface::Conductor {
        reflectance,
        roughness: roughness.into(),
        compensated: true,
    };
    for metal in Metal::ALL {
        let text = format!("conductor \"{}\" roughness=0.3", metal.name());
        assert_eq!(surface(&text), conductor(Reflectance::Metal(metal), 0.3));
    }
    assert_eq!(surface("conductor { color 0.8 0.1 0.2 }"), conductor(Reflectance::Color(red.into()), 0.0));
    let index = Reflectance::Index { eta: Rgb::new(1.0, 2.0, 3.0), k: Rgb::gray(4.0) };
    assert_eq!(surface("conductor { eta 1 2 3; k 4 }"), conductor(index, 0.0));
    assert_eq!(
        surface("dielectric ior=1.33 roughness=0.1 tint=0.9"),
        Surface::Dielectric { ior: 1.33, roughness: 0.1.into(), tint: Rgb::gray(0.9).into() }
    );
    assert_eq!(
        surface(
            "principled { base-color 0.8 0.1 0.2; metallic 0.1; roughness 0.2; ior 1.4; transmission 0.3; thin-walled; specular 0.4; specular-color 2 }"
        ),
        Surface::Principled(Principled {
            base_color: red.into(),
            metallic: 0.1.into(),
            roughness: 0.2.into(),
            ior: 1.4,
            transmission: 0.3.into(),
            thin_walled: true,
            specular: 0.4.into(),
            specular_color: Rgb::gray(2.0).into(),
        })
    );
    assert_eq!(
        surface("phong diffuse=0.5 specular=0.25 exponent=40"),
        Surface::Phong {
            diffuse: Rgb::gray(0.5).into(),
            specular: Rgb::gray(0.25).into(),
            exponent: 40.0.into()
        }
    );
    assert_eq!(
        surface("glossy color=0.9 glossiness=0.7"),
        Surface::Glossy { color: Rgb::gray(0.9).into(), glossiness: 0.7.into() }
    );
}

#[test]
fn mixes_stand_after_their_parts_whatever_the_order_of_the_text() {
    let scene = load(
        "material \"outer\" { mix \"inner\" \"a\" weight=0.25 }\nmaterial \"inner\" { mix \"a\" \"b\" }\n\
         material \"a\" { diffuse 0.1 }\nmaterial \"b\" { diffuse 0.2 }\nobject { sphere; material \"outer\" }",
    )
    .scene;
    let place = |name: &str| Id::new(scene.materials.iter().position(|m| m.name == name).unwrap() as u32);
    let outer = &scene.materials[place("outer").index()];
    assert_eq!(
        outer.surface,
        Surface::Mix { first: place("inner"), second: place("a"), weight: 0.25.into() }
    );
    let inner = &scene.materials[place("inner").index()];
    assert_eq!(inner.surface, Surface::Mix { first: place("a"), second: place("b"), weight: 0.5.into() });
    assert_eq!(scene.instances[0].materials, [place("outer")]);
    // A chain of a hundred thousand mixes does not exhaust the stack.
    let chain: String =
        (0..100_000).map(|i| format!("material \"{i}\" {{ mix \"{}\" \"{}\" }}\n", i + 1, i + 1)).collect();
    let text = format!("{chain}material \"100000\" {{ diffuse 0.5 }}\nobject {{ sphere; material \"0\" }}");
    assert_eq!(load(&text).scene.instances[0].materials[0].index(), 100_000);
}

#[test]
fn material_options_arrive() {
    let material = |text: &str| {
        load(&format!("object {{ sphere; material {{ diffuse 0.5; {text} }} }}")).scene.materials[0].clone()
    };
    let emission = Emission { radiance: Rgb::new(3.0, 2.0, 1.0).into(), two_sided: true };
    assert_eq!(material("emission 3 2 1 two-sided=#true").emission, Some(emission));
    assert_eq!(material("opacity 0.25").opacity, Opacity::Blend { alpha: 0.25.into() });
    assert_eq!(
        material("opacity 0.25 cutoff=0.5").opacity,
        Opacity::Mask { alpha: 0.25.into(), cutoff: 0.5 }
    );
    assert_eq!(material("sides \"front\"").sides, Sides::Front);
    assert_eq!(material("sides \"both\""), material(""));
    let vertex = material("opacity vertex-alpha=#true").opacity;
    assert_eq!(vertex, Opacity::Blend { alpha: ScalarValue { vertex_alpha: true, ..1.0.into() } });
}

fn png() -> Vec<u8> {
    codec::encode_png8(&Image::filled(2, 2, [200, 150, 90]), &codec::Metadata::new()).unwrap()
}

#[test]
fn textures_arrive_and_are_read_as_their_use_asks() {
    let text = "luch 1\ntexture \"t\" { image \"sub/a.png\" wrap=\"mirror\" filter=\"nearest\" }\n\
        texture \"c\" { checker { even 1 0 0; odd 0.5 } }\n\
        material \"m\" { principled { base-color 0.5 texture=\"t\" { scale 2 3; rotate 90; offset 1 0; uv-set 1 }\n\
        roughness texture=\"t\" channel=\"green\"; metallic 0.3 texture=\"c\" } }\nobject { sphere; material \"m\" }\nenvironment 1";
    let scene = load_files(&[("main.kdl", text.into()), ("sub/a.png", png())]).scene;
    let image = |encoding| Texture::Image {
        image: Id::new(0),
        encoding,
        wrap: [Wrap::Mirror; 2],
        filter: TextureFilter::Nearest,
    };
    assert_eq!(scene.images.len(), 1);
    assert!(
        scene.textures.contains(&Texture::Checker { even: Rgb::new(1.0, 0.0, 0.0), odd: Rgb::gray(0.5) })
    );
    let Surface::Principled(principled) = &scene.materials[0].surface else { panic!() };
    let used = principled.base_color.texture.unwrap();
    assert_eq!(scene.textures[used.texture.index()], image(Encoding::Srgb));
    assert_eq!((principled.base_color.factor, used.uv_set), (Rgb::gray(0.5), 1));
    // Scaled to (2, 3), turned to (−3, 2), moved to (−2, 2).
    assert!(used.place(Vec2::ONE).abs_diff_eq(Vec2::new(-2.0, 2.0), 1e-6), "{}", used.place(Vec2::ONE));
    let (used, channel) = principled.roughness.texture.unwrap();
    assert_eq!(
        (scene.textures[used.texture.index()].clone(), channel),
        (image(Encoding::Linear), Channel::Green)
    );
    assert_eq!(principled.roughness.factor, 1.0);
    assert_eq!(principled.metallic.texture.unwrap().1, Channel::Red);
}

#[test]
fn a_missing_picture_is_one_warning_and_a_neutral_value() {
    let loaded = load(
        "texture \"t\" { image \"none.png\" }\n\
         material \"m\" { principled { base-color 0.8 texture=\"t\"; roughness 0.4 texture=\"t\" }; normal-map texture=\"t\"; opacity texture=\"t\" cutoff=0.5 }\n\
         object { sphere; material \"m\" }",
    );
    assert_eq!(loaded.warnings.len(), 1);
    assert!(loaded.warnings[0].to_string().starts_with("none.png: no such file"), "{}", loaded.warnings[0]);
    let material = &loaded.scene.materials[0];
    let Surface::Principled(principled) = &material.surface else { panic!() };
    assert_eq!(principled.base_color, Rgb::gray(0.4).into());
    assert_eq!(principled.roughness, 0.4.into());
    assert_eq!(material.normal_map, None);
    assert_eq!(material.opacity, Opacity::Mask { alpha: 1.0.into(), cutoff: 0.5 });
    let loaded = load("environment image=\"none.hdr\" scale=2\nobject { sphere }");
    assert_eq!(loaded.scene.environment, Some(Environment::Constant { radiance: Rgb::WHITE }));
    assert_eq!(loaded.warnings.len(), 2);
}

#[test]
fn the_first_transform_is_done_first() {
    let scene = load(
        "group { translate 0 0 10\nobject { sphere; scale 2; translate 1 0 0; rotate-z 90 }\n\
         point-light { position 1 2 3; intensity 1 } }\n\
         object { sphere; rotate 0 2 0 angle=90 }\nobject { sphere; matrix 1 0 0 5  0 0 -1 6  0 1 0 7 }",
    )
    .scene;
    let at = |place: usize, x, y, z| scene.instances[place].placement.transform_point3(Vec3::new(x, y, z));
    assert!(at(0, 1.0, 0.0, 0.0).abs_diff_eq(Vec3::new(0.0, 3.0, 10.0), 1e-6), "{}", at(0, 1.0, 0.0, 0.0));
    assert!(at(1, 0.0, 0.0, 1.0).abs_diff_eq(Vec3::X, 1e-6));
    assert_eq!(at(2, 1.0, 2.0, 3.0), Vec3::new(6.0, 3.0, 9.0));
    assert_eq!(scene.lights[0], Light::Point { position: Vec3::new(1.0, 2.0, 13.0), intensity: Rgb::WHITE });
}

#[test]
fn lights_arrive() {
    let scene = load(
        "spot-light { position 0 3 0; to 0 0 0; intensity 5 4 3; inner-angle 20; outer-angle 30 }\n\
         sun { direction 0 -2 0; irradiance 3; angular-radius 1 }\nobject { sphere }",
    )
    .scene;
    let spot = Light::Spot {
        position: Vec3::new(0.0, 3.0, 0.0),
        direction: Vec3::NEG_Y,
        intensity: Rgb::new(5.0, 4.0, 3.0),
        inner_angle: 20f32.to_radians(),
        outer_angle: 30f32.to_radians(),
    };
    let sun = Light::Sun { direction: Vec3::NEG_Y, irradiance: Rgb::gray(3.0), angular_radius: PI / 180.0 };
    assert_eq!(scene.lights, [spot, sun]);
    assert_eq!(scene.environment, None);
    let scene = load("environment preset=\"neutral\" { scale 2; rotate-y 90 }\nobject { sphere }").scene;
    let Some(Environment::LatLong { scale, rotation, .. }) = scene.environment else { panic!() };
    assert_eq!(scale, Rgb::gray(2.0));
    assert!((rotation * Vec3::NEG_Z).abs_diff_eq(Vec3::NEG_X, 1e-6));
}

#[test]
fn shapes_and_meshes_arrive() {
    let obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
    let text = "luch 1\nmesh \"file\" { file \"a.obj\"; translate 1 0 0; flip }\nmesh \"hard\" { cuboid { size 1 2 3; divisions 2 1 1 } }\n\
        object \"one\" mesh=\"file\"\nobject \"two\" mesh=\"file\" { scale 2 }\n\
        object mesh=\"hard\"\nobject { disc radius=2 }\nobject { plane }\nobject { mesh { torus; normals \"flat\" } }";
    let scene = load_files(&[("main.kdl", text.into()), ("a.obj", obj.into())]).scene;
    let shape = |place: usize| &*scene.shapes[scene.instances[place].shape.index()];
    assert_eq!(scene.instances[0].shape, scene.instances[1].shape, "instances share their mesh");
    assert_eq!((scene.instances[0].name.as_str(), scene.instances[1].name.as_str()), ("one", "two"));
    let Shape::Mesh(mesh) = shape(0) else { panic!() };
    assert_eq!((mesh.positions[0], mesh.triangles.len()), (Vec3::X, 4));
    assert!(!mesh.normals.is_empty(), "a mesh from a file has normals");
    assert!(luch_mesh::measure::volume(mesh) < 0.0, "flip turns the surface inside out");
    let Shape::Mesh(mesh) = shape(2) else { panic!() };
    assert_eq!(luch_mesh::measure::bounds(mesh).max, Vec3::new(0.5, 1.0, 1.5));
    assert_eq!(*shape(3), Shape::Disc { radius: 2.0 });
    assert_eq!(*shape(4), Shape::Plane);
    let Shape::Mesh(mesh) = shape(5) else { panic!() };
    assert!(mesh.normals.is_empty());
    assert_eq!(scene.materials.len(), 1, "objects without a material share the clay");
}

#[test]
fn imports_are_placed_and_share_what_they_bring() {
    let part = "luch 1\nsettings { size 10 10 }\nmaterial \"m\" { mix \"a\" \"a\" }\nmaterial \"a\" { diffuse texture=\"t\" }\n\
        texture \"t\" { checker 1 0 }\nobject { sphere; material \"m\"; translate 1 0 0 }\ncamera { from 0 0 5; to 0 0 0 }\nenvironment 0.5";
    let text =
        "luch 1\nobject { plane }\nimport \"part.kdl\" { scale 2 }\nimport \"part.kdl\" { translate 0 3 0 }";
    let loaded = load_files(&[("main.kdl", text.into()), ("part.kdl", part.into())]);
    let scene = &loaded.scene;
    assert_eq!((scene.instances.len(), scene.shapes.len(), scene.materials.len()), (3, 2, 3));
    assert_eq!(
        scene.instances[1].placement,
        Affine3A::from_scale(Vec3::splat(2.0)) * Affine3A::from_translation(Vec3::X)
    );
    assert_eq!(scene.instances[1].materials, scene.instances[2].materials);
    let mixed = &scene.materials[scene.instances[1].materials[0].index()];
    let Surface::Mix { first, .. } = mixed.surface else { panic!() };
    let Surface::Diffuse { color } = &scene.materials[first.index()].surface else { panic!() };
    assert_eq!(
        scene.textures[color.texture.unwrap().texture.index()],
        Texture::Checker { even: Rgb::WHITE, odd: Rgb::BLACK }
    );
    assert_eq!(scene.settings, Settings::default());
    assert_eq!(scene.cameras[0].camera.position, Vec3::new(0.0, 0.0, 10.0));
    assert_eq!(scene.environment, Some(Environment::Constant { radiance: Rgb::gray(0.5) }));
}

#[test]
fn a_file_included_twice_counts_once() {
    let loaded = load_files(&[
        (
            "main.kdl",
            b"luch 1\ninclude \"a.kdl\"\ninclude \"b.kdl\"\nobject { sphere; material \"m\" }".to_vec(),
        ),
        ("a.kdl", b"include \"b.kdl\"".to_vec()),
        ("b.kdl", b"material \"m\" { diffuse 0.5 }".to_vec()),
    ]);
    assert_eq!(loaded.scene.materials.len(), 1);
}
