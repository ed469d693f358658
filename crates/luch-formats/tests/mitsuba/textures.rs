//! Textures and how they are laid on.

use crate::text::{material, near, sound, warnings};
use glam::Vec2;
use luch_image::{Encoding, Rgb};
use luch_scene::{ColorValue, Surface, Texture, TextureFilter, Wrap};

/// The colour of a `diffuse` with this texture, and the scene's textures.
fn color(texture: &str) -> (ColorValue, Vec<Texture>, String) {
    let (material, loaded) = material(&format!(r#"<bsdf type="diffuse">{texture}</bsdf>"#));
    let Surface::Diffuse { color } = material.surface else { panic!("is diffuse") };
    (color, loaded.scene.textures.clone(), warnings(&loaded))
}

const FILE: &str = r#"<string name="filename" value="p.png"/>"#;

#[test]
fn bitmaps_and_their_options() {
    let (plain, textures, told) =
        color(&format!(r#"<texture type="bitmap" name="reflectance">{FILE}</texture>"#));
    assert_eq!(told, "");
    let Texture::Image { encoding, wrap, filter, .. } = &textures[plain.texture.unwrap().texture.index()]
    else {
        panic!("is a picture")
    };
    assert_eq!((*encoding, *wrap, *filter), (Encoding::Srgb, [Wrap::Repeat; 2], TextureFilter::Bilinear));
    // The mesh's v was turned over as well, so nothing is left to do.
    let place = plain.texture.unwrap().place(Vec2::new(0.3, 0.2));
    assert!(place.abs_diff_eq(Vec2::new(0.3, 0.2), 1e-6));

    let (raw, textures, told) = color(&format!(
        r#"<texture type="bitmap" name="reflectance">{FILE}<boolean name="raw" value="true"/><string name="wrap_mode" value="mirror"/>
        <string name="filter_type" value="nearest"/></texture>"#
    ));
    assert_eq!(told, "");
    let Texture::Image { encoding, wrap, filter, .. } = &textures[raw.texture.unwrap().texture.index()]
    else {
        panic!("is a picture")
    };
    assert_eq!((*encoding, *wrap, *filter), (Encoding::Linear, [Wrap::Mirror; 2], TextureFilter::Nearest));
}

#[test]
fn transforms_act_where_v_runs_down() {
    let (moved, ..) = color(&format!(
        r#"<texture type="bitmap" name="reflectance">{FILE}<transform name="to_uv"><scale x="2" y="4"/><translate x="0.5" y="0.25"/></transform></texture>"#
    ));
    // Mitsuba's (0.3, 0.2) goes to (1.1, 1.05).
    let place = moved.texture.unwrap().place(Vec2::new(0.3, 1.0 - 0.2));
    assert!(place.abs_diff_eq(Vec2::new(1.1, 1.0 - 1.05), 1e-6), "{place}");
}

#[test]
fn a_checkerboard_has_two_squares_to_a_unit() {
    let checker = r#"<texture type="checkerboard" name="reflectance"><rgb name="color0" value="0.9"/><rgb name="color1" value="0.1"/>
        <transform name="to_uv"><scale x="4" y="2"/></transform></texture>"#;
    let (value, textures, told) = color(checker);
    assert_eq!(told, "");
    let used = value.texture.unwrap();
    let Texture::Checker { even, odd } = textures[used.texture.index()] else { panic!("is a checker") };
    // What Mitsuba 3.9 shows at its (u, v).
    for (uv, expected) in [([0.1, 0.1], 0.9), ([0.2, 0.1], 0.1), ([0.1, 0.3], 0.1)] {
        let [u, v] = uv;
        let place = used.place(Vec2::new(u, 1.0 - v)).floor();
        let shown = if (place.x + place.y).rem_euclid(2.0) == 0.0 { even } else { odd };
        near(shown, [expected; 3]);
    }
}

#[test]
fn vertex_colours_and_spectra_as_textures() {
    let (colored, ..) = color(
        r#"<texture type="mesh_attribute" name="reflectance"><string name="name" value="vertex_color"/></texture>"#,
    );
    assert!(colored.vertex_color);
    let (_, _, told) = color(
        r#"<texture type="mesh_attribute" name="reflectance"><string name="name" value="face_x"/></texture>"#,
    );
    assert!(told.contains("\"face_x\" is not read"));
    let (uniform, ..) =
        color(r#"<spectrum type="uniform" name="reflectance"><float name="value" value="0.3"/></spectrum>"#);
    near(uniform.factor, [0.3; 3]);
    let (listed, ..) = color(
        r#"<spectrum type="irregular" name="reflectance"><string name="wavelengths" value="300, 900"/><string name="values" value="0.5, 0.5"/></spectrum>"#,
    );
    near(listed.factor, [0.5; 3]);
    let (scaled, ..) = color(
        r#"<texture type="scale" name="reflectance"><float name="scale" value="0.5"/><texture type="bitmap"><string name="filename" value="p.png"/></texture></texture>"#,
    );
    assert!(scaled.texture.is_some());
    near(scaled.factor, [0.5; 3]);
}

#[test]
fn a_missing_picture_is_a_warning() {
    let loaded = sound(
        r#"<shape type="rectangle"><bsdf type="diffuse"><texture type="bitmap" name="reflectance"><string name="filename" value="none.png"/></texture></bsdf></shape>"#,
    );
    assert!(warnings(&loaded).contains("no such file"));
    let (unknown, _, told) = color(r#"<texture type="wireframe" name="reflectance"/>"#);
    assert_eq!(unknown.factor, Rgb::gray(0.5));
    assert!(told.contains("texture `wireframe` is not supported"));
}
