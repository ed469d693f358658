//! What MTL keywords become (the table of `docs/importers.md`).

use luch_formats::{Files, Loaded, load_with};
use luch_image::{Image, Rgb, codec};
use luch_scene::*;
use std::path::{Path, PathBuf};

/// A triangle of one material, which `mtl` defines.
fn load(mtl: &str) -> Loaded {
    let obj = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl m\nf 1/1 2/2 3/3\n";
    let png = codec::encode_png8(&Image::filled(2, 2, [200, 150, 90]), &codec::Metadata::new()).unwrap();
    let files: [(PathBuf, Vec<u8>); 3] = [
        ("a.obj".into(), obj.into()),
        ("a.mtl".into(), format!("newmtl m\n{mtl}\n").into()),
        ("p.png".into(), png),
    ];
    load_with(Path::new("a.obj"), &Files::memory(files)).unwrap_or_else(|error| panic!("{error}"))
}

fn material(mtl: &str) -> Material {
    let scene = load(mtl).scene;
    scene.materials[scene.instances[0].materials[0].index()].clone()
}

fn surface(mtl: &str) -> Surface {
    material(mtl).surface
}

#[test]
fn surfaces_follow_the_table() {
    let gray = |v: f32| ColorValue::from(Rgb::gray(v));
    assert_eq!(surface(""), Surface::Diffuse { color: gray(0.8) });
    assert_eq!(surface("Kd 0.5 0.5 0.5\nKs 0.4 0.4 0.4\nillum 1"), Surface::Diffuse { color: gray(0.5) });
    assert_eq!(
        surface("Kd 0.5 0.5 0.5\nKs 0.25 0.25 0.25\nNs 30\nillum 2"),
        Surface::Phong { diffuse: gray(0.5), specular: gray(0.25), exponent: 30.0.into() }
    );
    let mirror = Surface::Conductor {
        reflectance: Reflectance::Color(gray(0.9)),
        roughness: 0.0.into(),
        compensated: true,
    };
    assert_eq!(surface("Kd 0 0 0\nKs 0.9 0.9 0.9\nillum 3"), mirror);
    assert_eq!(surface("Ks 0.9 0.9 0.9\nNs 1000\nillum 5"), mirror);
    let glass = |ior, tint| Surface::Dielectric { ior, roughness: 0.0.into(), tint: gray(tint) };
    assert_eq!(surface("illum 7\nNi 1.3"), glass(1.3, 1.0));
    assert_eq!(surface("illum 6\nNi 1.5\nTf 0.5 0.5 0.5\nd 0.1"), glass(1.5, 0.5));
    assert_eq!(surface("illum 4\nd 0.5\nNi 1.5"), glass(1.5, 1.0));
    assert_eq!(surface("Ni 1.4\nd 0.5\nTf 0.5 0.5 0.5"), glass(1.4, 0.5));
    let Surface::Principled(principled) = surface("Kd 0.5 0.5 0.5\nPr 0.3\nPm 1\nNi 1.45") else { panic!() };
    let expected = Principled {
        base_color: gray(0.5),
        roughness: 0.3.into(),
        metallic: 1.0.into(),
        ior: 1.45,
        ..Default::default()
    };
    assert_eq!(principled, expected);
}

#[test]
fn glass_is_not_see_through_besides() {
    assert_eq!(material("illum 7\nd 0.1").opacity, Opacity::Opaque);
    assert_eq!(material("d 0.25").opacity, Opacity::Blend { alpha: 0.25.into() });
    assert_eq!(material("Tr 0.25").opacity, Opacity::Blend { alpha: 0.75.into() });
}

#[test]
fn a_diffuse_mirror_is_as_bright_as_its_two_colours() {
    let scene = load("Kd 0.2 0.2 0.2\nKs 0.6 0.6 0.6\nillum 3").scene;
    let Surface::Mix { first, second, weight } =
        scene.materials[scene.instances[0].materials[0].index()].surface.clone()
    else {
        panic!()
    };
    let Surface::Diffuse { color: diffuse } = scene.materials[first.index()].surface.clone() else {
        panic!()
    };
    let Surface::Conductor { reflectance: Reflectance::Color(mirror), .. } =
        scene.materials[second.index()].surface.clone()
    else {
        panic!()
    };
    assert!(((1.0 - weight.factor) * diffuse.factor.g - 0.2).abs() < 1e-6);
    assert!((weight.factor * mirror.factor.g - 0.6).abs() < 1e-6);
}

#[test]
fn colours_out_of_range_are_brought_back_with_a_warning() {
    let loaded = load("Kd 0.8 0.8 0.8\nKs 0.8 0.8 0.8\nNs 10");
    assert!(loaded.warnings.iter().any(|w| w.message.contains("add up to 1.6")), "{:?}", loaded.warnings);
    let loaded = load("Kd 2 -1 0.5");
    assert!(
        loaded.warnings.iter().any(|w| w.message.contains("Kd is [2, -1, 0.5]: taken as [1, 0, 0.5]")),
        "{:?}",
        loaded.warnings
    );
}

#[test]
fn emission_shines_from_both_sides() {
    let emission = material("Ke 5 4 3").emission.unwrap();
    assert_eq!((emission.radiance.factor, emission.two_sided), (Rgb::new(5.0, 4.0, 3.0), true));
    assert_eq!(material("Ke 0 0 0").emission, None);
    let emission = material("map_Ke p.png").emission.unwrap();
    assert_eq!(emission.radiance.factor, Rgb::WHITE);
    assert!(emission.radiance.texture.is_some());
}

#[test]
fn maps_are_laid_on_with_their_options() {
    let loaded = load(
        "Kd 0 0 0\nmap_Kd -s 2 3 1 -o 0.5 0 0 -clamp on sub\\dir\\p.png\nmap_d -imfchan g p.png\nnorm -bm 0.5 p.png",
    );
    let scene = &loaded.scene;
    // The picture, read once, and the sky.
    assert_eq!((scene.images.len(), loaded.warnings.len()), (2, 0), "{:?}", loaded.warnings);
    let material = &scene.materials[0];
    let Surface::Diffuse { color } = &material.surface else { panic!() };
    assert_eq!(color.factor, Rgb::WHITE);
    let used = color.texture.unwrap();
    assert_eq!(used.place(glam::Vec2::ONE), glam::Vec2::new(2.5, 3.0));
    let Texture::Image { encoding, wrap, .. } = scene.textures[used.texture.index()] else { panic!() };
    assert_eq!((encoding, wrap), (luch_image::Encoding::Srgb, [Wrap::Clamp; 2]));
    let Opacity::Blend { alpha } = material.opacity else { panic!() };
    assert_eq!(alpha.texture.unwrap().1, Channel::Green);
    let normal_map = material.normal_map.unwrap();
    assert_eq!(normal_map.scale, 0.5);
    let Texture::Image { encoding, .. } = scene.textures[normal_map.texture.texture.index()] else {
        panic!()
    };
    assert_eq!(encoding, luch_image::Encoding::Linear);
}

#[test]
fn what_is_missing_or_not_honoured_is_told() {
    let loaded = load("map_Kd none.png\nbump p.png\nPc 1");
    let said: Vec<String> = loaded.warnings.iter().map(ToString::to_string).collect();
    for part in [
        "none.png: no such file",
        "a.mtl: bump (heights) is not honoured",
        "a.mtl: Pc (clearcoat) is not honoured",
    ] {
        assert!(said.iter().any(|line| line.starts_with(part)), "{part}: {said:?}");
    }
    let files = Files::memory([(
        "a.obj".into(),
        b"mtllib none.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl x\nf 1 2 3\n".to_vec(),
    )]);
    let loaded = load_with(Path::new("a.obj"), &files).unwrap();
    let said: Vec<String> = loaded.warnings.iter().map(ToString::to_string).collect();
    assert!(said[0].starts_with("none.mtl: no such file"), "{said:?}");
    assert!(said[1].starts_with("a.obj: material \"x\" is in none of the material files"), "{said:?}");
}
