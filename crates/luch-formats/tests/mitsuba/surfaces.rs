//! Bsdfs.

use crate::text::{load, material, near, surface, warnings};
use luch_image::Rgb;
use luch_scene::{ColorValue, Metal, Opacity, Principled, Reflectance, Surface, Texture};

fn gray(value: f32) -> ColorValue {
    Rgb::gray(value).into()
}

#[test]
fn diffuse_in_all_spellings_of_colour() {
    for (color, expected) in [
        ("", [0.5; 3]),
        (r#"<rgb name="reflectance" value="0.1, 0.2, 0.3"/>"#, [0.1, 0.2, 0.3]),
        (r#"<rgb name="reflectance" value="0.1 0.2 0.3"/>"#, [0.1, 0.2, 0.3]),
        (r#"<rgb name="reflectance" value="0.4"/>"#, [0.4; 3]),
        // sRGB 188 is 0.502 886 of light.
        (r##"<rgb name="reflectance" value="#bcbcbc"/>"##, [0.502_886; 3]),
        (r#"<spectrum name="reflectance" value="0.25"/>"#, [0.25; 3]),
        (r#"<spectrum name="reflectance" value="300:0.5, 900:0.5"/>"#, [0.5; 3]),
        (r#"<float name="reflectance" value="0.75"/>"#, [0.75; 3]),
    ] {
        let Surface::Diffuse { color } = surface(&format!("<bsdf type=\"diffuse\">{color}</bsdf>")) else {
            panic!("is diffuse")
        };
        near(color.factor, expected);
    }
}

#[test]
fn a_shape_without_a_bsdf_is_gray() {
    assert_eq!(surface(""), Surface::Diffuse { color: gray(0.5) });
}

#[test]
fn glass_by_name_and_number() {
    let glass = |inside: &str| match surface(&format!("<bsdf type=\"dielectric\">{inside}</bsdf>")) {
        Surface::Dielectric { ior, roughness, tint } => {
            assert_eq!((roughness.factor, tint), (0.0, gray(1.0)));
            ior
        }
        other => panic!("{other:?}"),
    };
    let name = |side: &str, name: &str| format!("<string name=\"{side}_ior\" value=\"{name}\"/>");
    let close = |ior: f32, expected: f32| assert!((ior - expected).abs() < 1e-5, "{ior}, not {expected}");
    close(glass(""), 1.5046 / 1.000_277);
    close(glass(&(name("int", "diamond") + &name("ext", "water"))), 2.419 / 1.333);
    close(glass(&(name("int", "Water") + &name("ext", "vacuum"))), 1.333);
    close(glass(r#"<float name="int_ior" value="1.5"/><integer name="ext_ior" value="1"/>"#), 1.5);
}

#[test]
fn roughness_is_the_root_of_alpha() {
    let ggx = r#"<string name="distribution" value="ggx"/>"#;
    let Surface::Dielectric { roughness, .. } =
        surface(&format!(r#"<bsdf type="roughdielectric">{ggx}<float name="alpha" value="0.25"/></bsdf>"#))
    else {
        panic!("is a dielectric")
    };
    assert_eq!(roughness, 0.5.into());
    let (metal, loaded) =
        material(r#"<bsdf type="roughconductor"><float name="alpha" value="0.09"/></bsdf>"#);
    assert!(
        matches!(metal.surface, Surface::Conductor { roughness, compensated: false, .. } if (roughness.factor - 0.3).abs() < 1e-6)
    );
    assert!(warnings(&loaded).contains("GGX, not by Beckmann"));
    let (metal, loaded) = material(&format!(
        r#"<bsdf type="roughconductor">{ggx}<float name="alpha_u" value="0.1"/><float name="alpha_v" value="0.4"/></bsdf>"#
    ));
    let Surface::Conductor { roughness, .. } = metal.surface else { panic!("is a conductor") };
    assert!((roughness.factor - 0.2_f32.sqrt()).abs() < 1e-6);
    assert!(warnings(&loaded).contains("`alpha_u` and `alpha_v` differ"));
}

#[test]
fn a_varying_alpha_is_rooted_pixel_by_pixel() {
    let bsdf = r#"<bsdf type="roughconductor"><string name="distribution" value="ggx"/>
        <texture type="bitmap" name="alpha"><string name="filename" value="p.png"/><boolean name="raw" value="true"/></texture></bsdf>"#;
    let (metal, loaded) = material(bsdf);
    let Surface::Conductor { roughness, .. } = metal.surface else { panic!("is a conductor") };
    let Texture::Image { image, .. } = loaded.scene.textures[roughness.texture.unwrap().0.texture.index()]
    else {
        panic!("is a picture")
    };
    let rooted = loaded.scene.images[image.index()].raw(0, 0)[0];
    assert!((rooted - (188.0_f32 / 255.0).sqrt()).abs() < 1e-6, "{rooted}");
}

#[test]
fn metals_by_name_and_index() {
    let metal = |inside: &str| match surface(&format!("<bsdf type=\"conductor\">{inside}</bsdf>")) {
        Surface::Conductor { reflectance, compensated: false, .. } => reflectance,
        other => panic!("{other:?}"),
    };
    let gold = metal(r#"<string name="material" value="Au"/>"#);
    assert!(matches!(gold, Reflectance::Index { eta, k } if eta.b > 10.0 * eta.r * 0.9 && k.r > k.b));
    assert_eq!(metal(r#"<string name="material" value="none"/>"#), Reflectance::Color(gray(1.0)));
    assert_eq!(metal(""), Reflectance::Color(gray(1.0)));
    let index = metal(r#"<rgb name="eta" value="0.1, 0.2, 0.3"/><rgb name="k" value="4, 3, 2"/>"#);
    let expected = Reflectance::Index { eta: Rgb::new(0.1, 0.2, 0.3), k: Rgb::new(4.0, 3.0, 2.0) };
    assert_eq!(index, expected);
    let (unknown, loaded) =
        material(r#"<bsdf type="conductor"><string name="material" value="SnTe"/></bsdf>"#);
    assert!(matches!(
        unknown.surface,
        Surface::Conductor { reflectance: Reflectance::Metal(Metal::Chromium), .. }
    ));
    assert!(warnings(&loaded).contains("the metal \"SnTe\" is not known"));
    let error = load(r#"<shape type="cube"><bsdf type="conductor"><rgb name="k" value="1"/></bsdf></shape>"#);
    assert!(error.unwrap_err().to_string().contains("needs both `eta` and `k`"));
}

#[test]
fn tinted_metal_is_schlicks() {
    let (metal, loaded) = material(
        r#"<bsdf type="conductor"><rgb name="eta" value="1"/><rgb name="k" value="2"/><float name="specular_reflectance" value="0.5"/></bsdf>"#,
    );
    let Surface::Conductor { reflectance: Reflectance::Color(color), .. } = metal.surface else {
        panic!("has a colour")
    };
    // (0 + 4) / (4 + 4) of the light, half of which is kept.
    near(color.factor, [0.25; 3]);
    assert!(warnings(&loaded).contains("Schlick"));
}

#[test]
fn thin_glass_reflects_as_two_faces() {
    let Surface::Principled(thin) = surface(
        r#"<bsdf type="thindielectric"><float name="int_ior" value="1.5"/><float name="ext_ior" value="1"/></bsdf>"#,
    ) else {
        panic!("is principled")
    };
    assert!(thin.thin_walled && thin.transmission == 1.0.into() && thin.roughness == 0.0.into());
    // One face reflects 4 %, both 2 · 0.04 / 1.04.
    let root = (thin.ior - 1.0) / (thin.ior + 1.0);
    assert!((root * root - 0.08 / 1.04).abs() < 1e-6);
}

#[test]
fn plastics() {
    let Surface::Principled(plastic) = surface(
        r#"<bsdf type="roughplastic"><string name="distribution" value="ggx"/><float name="alpha" value="0.04"/>
        <rgb name="diffuse_reflectance" value="0.2, 0.3, 0.4"/><float name="int_ior" value="1.6"/><float name="ext_ior" value="1"/>
        <boolean name="nonlinear" value="true"/></bsdf>"#,
    ) else {
        panic!("is principled")
    };
    // Nonlinear: less than the given albedo, and the less the darker it is.
    let ratio = |have: f32, given: f32| have / given;
    let color = plastic.base_color.factor;
    let [r, g, b] = [ratio(color.r, 0.2), ratio(color.g, 0.3), ratio(color.b, 0.4)];
    assert!(0.3 < r && r < g && g < b && b < 0.8, "{r} {g} {b}");
    assert!((plastic.roughness.factor - 0.2).abs() < 1e-6);
    assert_eq!((plastic.ior, plastic.metallic), (1.6, 0.0.into()));
    let Surface::Principled(smooth) = surface(r#"<bsdf type="plastic"/>"#) else { panic!("is principled") };
    assert_eq!((smooth.roughness, smooth.base_color), (0.0.into(), gray(0.5)));
}

#[test]
fn principled_with_what_is_not_there() {
    let Surface::Principled(Principled { metallic, roughness, transmission, ior, .. }) = surface(
        r#"<bsdf type="principled"><float name="metallic" value="0.25"/><float name="roughness" value="0.3"/>
        <float name="spec_trans" value="0.5"/><float name="specular" value="0.5"/><float name="sheen" value="0"/></bsdf>"#,
    ) else {
        panic!("is principled")
    };
    assert_eq!((metallic, roughness, transmission), (0.25.into(), 0.3.into(), 0.5.into()));
    assert!((ior - 1.5).abs() < 1e-6);
    let (_, loaded) = material(
        r#"<bsdf type="principled"><float name="clearcoat" value="1"/><float name="sheen" value="0.5"/></bsdf>"#,
    );
    assert!(warnings(&loaded).contains("`clearcoat` of bsdf `principled`"));
    assert!(warnings(&loaded).contains("`sheen`"));
}

#[test]
fn masks_blends_and_both_sides() {
    let red = r#"<bsdf type="diffuse"><rgb name="reflectance" value="1, 0, 0"/></bsdf>"#;
    assert!(matches!(surface(&format!(r#"<bsdf type="twosided">{red}</bsdf>"#)), Surface::Diffuse { .. }));
    let (masked, _) =
        material(&format!(r#"<bsdf type="mask"><float name="opacity" value="0.3"/>{red}</bsdf>"#));
    assert_eq!(masked.opacity, Opacity::Blend { alpha: 0.3.into() });
    let (nothing, loaded) = material(r#"<bsdf type="null"/>"#);
    assert_eq!((nothing.opacity, loaded.warnings), (Opacity::Blend { alpha: 0.0.into() }, vec![]));
    let blend = format!(
        r#"<bsdf type="blendbsdf"><float name="weight" value="0.2"/>{red}<bsdf type="conductor"/></bsdf>"#
    );
    let (blend, loaded) = material(&blend);
    let Surface::Mix { first, second, weight } = blend.surface else { panic!("is a mix") };
    assert_eq!(weight, 0.2.into());
    assert!(matches!(loaded.scene.materials[first.index()].surface, Surface::Diffuse { .. }));
    assert!(matches!(loaded.scene.materials[second.index()].surface, Surface::Conductor { .. }));
}

#[test]
fn a_mixture_of_three_keeps_their_shares() {
    let (mixed, loaded) = material(
        r#"<bsdf type="mixturebsdf"><string name="weights" value="0.5, 0.3, 0.2"/><bsdf type="diffuse"/><bsdf type="conductor"/><bsdf type="dielectric"/></bsdf>"#,
    );
    let Surface::Mix { first, weight: last, .. } = mixed.surface else { panic!("is a mix") };
    let Surface::Mix { weight: middle, .. } = loaded.scene.materials[first.index()].surface else {
        panic!("is a mix")
    };
    assert!((last.factor - 0.2).abs() < 1e-6 && ((1.0 - last.factor) * middle.factor - 0.3).abs() < 1e-6);
}

#[test]
fn normal_maps_are_read_as_stored() {
    let (material, loaded) = material(
        r#"<bsdf type="normalmap"><texture type="bitmap" name="normalmap"><string name="filename" value="p.png"/></texture><bsdf type="diffuse"/></bsdf>"#,
    );
    let map = material.normal_map.unwrap();
    assert_eq!(loaded.warnings, []);
    let Texture::Image { encoding, .. } = loaded.scene.textures[map.texture.texture.index()] else {
        panic!("is a picture")
    };
    assert_eq!(encoding, luch_image::Encoding::Linear);
}

#[test]
fn what_is_not_supported_is_named() {
    for (bsdf, expected) in [
        (r#"<bsdf type="hair"/>"#, "bsdf `hair` is not supported: gray takes its place"),
        (r#"<bsdf type="bumpmap"><bsdf type="diffuse"/></bsdf>"#, "`bumpmap` is not supported"),
        (
            r#"<bsdf type="coating"><float name="thickness" value="1"/><bsdf type="diffuse"/></bsdf>"#,
            "only what it covers",
        ),
        (r#"<bsdf type="roughdiffuse"/>"#, "as smooth as `diffuse`"),
        (
            r#"<bsdf type="twosided"><bsdf type="diffuse"/><bsdf type="conductor"/></bsdf>"#,
            "the first is on both sides",
        ),
        (r#"<bsdf type="diffuse"><rgb name="reflectance" value="2"/></bsdf>"#, "is more than 1"),
        (
            r#"<bsdf type="dielectric"><float name="specular_reflectance" value="0.5"/></bsdf>"#,
            "is not supported: it is 1",
        ),
        (
            r#"<bsdf type="diffuse"><rgb name="reflectence" value="0.2"/></bsdf>"#,
            "bsdf `diffuse` has no `reflectence`",
        ),
    ] {
        let (_, loaded) = material(bsdf);
        assert!(warnings(&loaded).contains(expected), "{bsdf}: {}", warnings(&loaded));
    }
    let (_, loaded) = material(r#"<bsdf type="diffuse"><rgb name="reflectence" value="0.2"/></bsdf>"#);
    assert!(loaded.warnings[0].help.as_ref().unwrap().starts_with("did you mean `reflectance`?"));
}

#[test]
fn one_bsdf_with_two_lamps_is_two_materials() {
    let lamp = |radiance: u32| {
        format!(
            "<shape type=\"rectangle\"><ref id=\"b\"/><emitter type=\"area\"><rgb name=\"radiance\" value=\"{radiance}\"/></emitter></shape>"
        )
    };
    let loaded = crate::text::honoured(&format!(
        "<bsdf type=\"twosided\" id=\"b\"><bsdf type=\"diffuse\"/></bsdf>{}{}<shape type=\"cube\"><ref id=\"b\"/></shape>",
        lamp(1),
        lamp(2)
    ));
    let of = |place: usize| &loaded.scene.materials[loaded.scene.instances[place].materials[0].index()];
    assert_eq!(of(0).emission.unwrap().radiance, gray(1.0));
    assert_eq!(of(1).emission.unwrap().radiance, gray(2.0));
    assert!(!of(1).emission.unwrap().two_sided && of(2).emission.is_none());
    assert!(
        loaded
            .scene
            .materials
            .iter()
            .all(|m| m.surface == Surface::Diffuse { color: gray(0.5) } && m.name == "b")
    );
}
