//! Colours at pixels against closed forms.

use crate::views::ray;
use glam::{Affine3A, Vec2, Vec3};
use luch_image::{Bitmap, Encoding, Pixels, Rgb, srgb};
use luch_mesh::{Attribute, generate};
use luch_preview::{Fill, NOTHING, Picture, Size, Style, Subject, draw};
use luch_scene::{
    Camera, ColorValue, Emission, Material, Metal, Normals, Projection, Reflectance, ScalarValue, Scene,
    Shape, Surface, Texture, TextureFilter, TextureUse, Wrap, preset,
};

const SIZE: Size = Size { width: 48, height: 48 };

fn front() -> Camera {
    Camera {
        projection: Projection::Orthographic { height: 2.0 },
        ..Camera::looking_at(Vec3::Z * 3.0, Vec3::ZERO, Vec3::Y, 1.0)
    }
}

fn ball(material: Material) -> Scene {
    preset::material_ball(Shape::Sphere { radius: 1.0 }, material)
}

fn at_middle(scene: &Scene, fill: Fill) -> Rgb {
    let size = Size { width: 33, height: 33 };
    *draw(&Subject::scene(scene), &front(), size, &Style::filled(fill)).unwrap().color.get(16, 16)
}

/// The normal of the unit ball is its own point; under a lamp at the eye a face shows its colour times 0.12 + 0.88 cos.
#[test]
fn a_ball_has_the_normals_and_the_light_of_a_ball() {
    let color = Rgb::new(0.8, 0.5, 0.3);
    let scene = ball(Material::diffuse(color));
    let picture = |fill| draw(&Subject::scene(&scene), &front(), SIZE, &Style::filled(fill)).unwrap();
    let (normals, shaded) = (picture(Fill::Normals), picture(Fill::Shaded));
    for y in 0..SIZE.height {
        for x in 0..SIZE.width {
            let place = ray(&front(), SIZE, Vec2::new(x as f32 + 0.5, y as f32 + 0.5)).origin.truncate();
            let height = (1.0 - place.length_squared()).max(0.0).sqrt();
            if height == 0.0 {
                assert_eq!(*normals.faces.get(x, y), NOTHING);
                continue;
            }
            let stored = normals.color.get(x, y).to_array().map(|light| f32::from(srgb::encode_u8(light)));
            let expected = (place.extend(height) * 0.5 + 0.5) * 255.0;
            assert!((Vec3::from(stored) - expected).abs().max_element() <= 0.501);
            let lit = color * (0.12 + 0.88 * height);
            let error = *shaded.color.get(x, y) - lit;
            assert!(error.to_array().into_iter().all(|v| v.abs() < 1e-5), "{x} {y}");
        }
    }
}

/// Smooth normals of a fine mesh come near to those of the ball, flat ones are constant on every triangle.
#[test]
fn normals_are_flat_or_smooth_as_asked_for() {
    let mesh = generate::icosphere(1.0, 2);
    let picture = |normals| {
        let style = Style { normals, ..Style::filled(Fill::Normals) };
        draw(&Subject::triangles(&mesh), &front(), SIZE, &style).unwrap()
    };
    let colors = |picture: &Picture| {
        let mut of_face = std::collections::BTreeMap::<u32, Vec<[f32; 3]>>::new();
        for (face, color) in picture.faces.pixels().iter().zip(picture.color.pixels()) {
            of_face.entry(*face).or_default().push(color.to_array());
        }
        of_face.values().filter(|colors| colors.iter().any(|color| *color != colors[0])).count()
    };
    assert_eq!(colors(&picture(Normals::Flat)), 0);
    assert!(colors(&picture(Normals::Interpolated)) > 100);
}

#[test]
fn materials_show_their_own_colors() {
    let close = |scene: &Scene, expected: Rgb| {
        let error = at_middle(scene, Fill::Shaded) - expected;
        assert!(error.to_array().into_iter().all(|v| v.abs() < 1e-4), "{error:?}");
    };
    // Of index 1.5 without absorption 4 % is reflected; dark surfaces are shown a little brighter than black.
    let glassy = Reflectance::Index { eta: Rgb::gray(1.5), k: Rgb::BLACK };
    let conductor = |reflectance| {
        Material::new(Surface::Conductor { reflectance, roughness: 0.1.into(), compensated: true })
    };
    close(&ball(conductor(glassy)), Rgb::gray(0.04));
    close(&ball(Material::new(Surface::Absorber)), Rgb::gray(0.03));
    close(&ball(Material::emitter(Rgb::new(10.0, 5.0, 1.0))), Rgb::new(1.0, 0.5, 0.1));
    let dim = Emission::constant(Rgb::new(0.2, 0.5, 0.1));
    close(
        &ball(Material { emission: Some(dim), ..Material::new(Surface::Absorber) }),
        Rgb::new(0.2, 0.5, 0.1),
    );
    let gold = at_middle(&ball(conductor(Reflectance::Metal(Metal::Gold))), Fill::Shaded);
    assert!(gold.r > 0.9 && gold.g > 0.6 && gold.b < 0.5, "{gold:?}");

    let mut mixed = ball(Material::diffuse(Rgb::new(1.0, 0.2, 0.2)));
    let first = mixed.instances[0].materials[0];
    let second = mixed.add_material(Material::diffuse(Rgb::new(0.2, 0.2, 1.0)));
    let mix = Surface::Mix { first, second, weight: ScalarValue::constant(0.25) };
    mixed.instances[0].materials[0] = mixed.add_material(Material::new(mix));
    close(&mixed, Rgb::new(0.8, 0.2, 0.4));
}

/// A picture of two by two pixels on a square: red upper left, green upper right, blue lower left, white lower right.
#[test]
fn pictures_lie_on_surfaces_the_right_way_round() {
    let mut scene = Scene::default();
    let pixels = [[255, 0, 0, 255], [0, 255, 0, 255], [0, 0, 255, 255], [255; 4]];
    let image = Bitmap {
        width: 2,
        height: 2,
        pixels: Pixels::U8(pixels.to_vec()),
        encoding: Encoding::Srgb,
        has_alpha: false,
    };
    let image = scene.add_image(image);
    let mut mesh = preset::parallelogram(Vec3::new(-1.0, -1.0, 0.0), Vec3::X * 2.0, Vec3::Y * 2.0);
    let uvs = mesh.positions.iter().map(|p| p.truncate() * 0.5 + 0.5).collect();
    mesh.uv_sets.push(Attribute::per_position(uvs));
    let shape = scene.add_shape(Shape::Mesh(mesh));
    let filters = [TextureFilter::Nearest, TextureFilter::Bilinear];
    for filter in filters {
        let mut scene = scene.clone();
        let wrap = [Wrap::Clamp; 2];
        let texture = scene.add_texture(Texture::Image { image, encoding: Encoding::Srgb, wrap, filter });
        let color = ColorValue::textured(TextureUse::new(texture));
        let material = scene.add_material(Material::new(Surface::Diffuse { color }));
        scene.add_instance(shape, material, Affine3A::IDENTITY);
        let picture = draw(&Subject::scene(&scene), &front(), SIZE, &Style::default()).unwrap();
        // A quarter of the picture from the corner: the middle of a pixel, where both filters agree.
        let channels = |x, y| picture.color.get(x, y).to_array().map(|light| light > 0.5);
        assert_eq!(channels(11, 11), [true, false, false]);
        assert_eq!(channels(36, 11), [false, true, false]);
        assert_eq!(channels(11, 36), [false, false, true]);
        assert_eq!(channels(36, 36), [true; 3]);
        let between = picture.color.get(24, 11).r;
        assert_eq!(between > 0.3 && between < 0.7, filter == TextureFilter::Bilinear);
    }
}

/// Nearer is brighter, for both kinds of rays.
#[test]
fn depth_falls_from_white() {
    let mesh = generate::icosphere(0.9, 4);
    for camera in [front(), Camera::looking_at(Vec3::Z * 3.0, Vec3::ZERO, Vec3::Y, 0.7)] {
        let picture = draw(&Subject::triangles(&mesh), &camera, SIZE, &Style::filled(Fill::Depth)).unwrap();
        let mut seen: Vec<(f32, f32)> = Vec::new();
        for (depth, color) in picture.depth.pixels().iter().zip(picture.color.pixels()) {
            if depth.is_finite() {
                seen.push((*depth, color.r));
            }
        }
        seen.sort_by(|a, b| a.0.total_cmp(&b.0));
        assert!(seen.windows(2).all(|pair| pair[0].1 >= pair[1].1));
        assert_eq!(srgb::encode_u8(seen[0].1), 255);
        assert_eq!(srgb::encode_u8(seen[seen.len() - 1].1), 38);
    }
}
