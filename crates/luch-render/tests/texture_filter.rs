//! Textures that are finer than the pixels: what is averaged, and what must stay as it is.

use glam::{Affine2, Affine3A, Vec2, Vec3};
use luch_image::{Bitmap, Encoding, Pixels, Rgb};
use luch_mesh::{Attribute, TriangleMesh};
use luch_render::{Inspect, Integrator, Stop, View, World};
use luch_scene::{
    Camera, ColorValue, Environment, Filter, Material, Minification, Property, Scene, Shape, Surface,
    Texture, TextureFilter, TextureUse, Wrap,
};

/// A square of 2 m in the plane y = 0 under a white sky, uv from 0 to 1, with a picture of `size` pixels a side repeated `times`.
fn floor(size: u32, times: f32, camera: Camera, pixel: impl Fn(u32, u32) -> [u8; 4]) -> Scene {
    let mut scene = Scene::default();
    let pixels = (0..size).flat_map(|y| (0..size).map(move |x| (x, y))).map(|(x, y)| pixel(x, y)).collect();
    let encoding = Encoding::Srgb;
    let image = scene.add_image(Bitmap {
        width: size,
        height: size,
        pixels: Pixels::U8(pixels),
        encoding,
        has_alpha: false,
    });
    let filter = TextureFilter::Bilinear;
    let texture = scene.add_texture(Texture::Image { image, encoding, wrap: [Wrap::Repeat; 2], filter });
    let used = TextureUse { transform: Affine2::from_scale(Vec2::splat(times)), ..TextureUse::new(texture) };
    let material = scene.add_material(Material::new(Surface::Diffuse { color: ColorValue::textured(used) }));
    let corners = [(-1.0, 1.0), (1.0, 1.0), (1.0, -1.0), (-1.0, -1.0)].map(|(x, z)| Vec3::new(x, 0.0, z));
    let mut mesh = TriangleMesh::new(corners.to_vec(), vec![[0, 1, 2], [0, 2, 3]]);
    mesh.uv_sets = vec![Attribute::per_position(vec![Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y])];
    let shape = scene.add_shape(Shape::Mesh(mesh));
    scene.add_instance(shape, material, Affine3A::from_scale(Vec3::splat(10.0)));
    scene.environment = Some(Environment::Constant { radiance: Rgb::WHITE });
    scene.add_camera(camera);
    (scene.settings.width, scene.settings.height) = (16, 16);
    scene.settings.filter = Filter::Box { radius: 0.5 };
    scene
}

/// From 8 m above, straight down; a pixel of 16 covers 0.5 m.
fn above() -> Camera {
    Camera::looking_at(Vec3::Y * 8.0, Vec3::ZERO, Vec3::NEG_Z, 2.0 * libm::atanf(0.5))
}

fn chessboard(x: u32, y: u32) -> [u8; 4] {
    let value = if (x ^ y) & 1 == 0 { 255 } else { 0 };
    [value, value, value, 255]
}

/// The albedo of `count` samples of every pixel, pixel by pixel.
fn albedos(scene: &Scene, filter: Minification, count: u64) -> Vec<Vec<f32>> {
    let mut scene = scene.clone();
    scene.settings.texture_filter = filter;
    let view = View::new(&scene.cameras[0].camera, &scene.settings);
    let world = World::build(scene).unwrap();
    let inspect = Inspect::new(Property::Albedo, &view);
    let pixels = (0..view.height()).flat_map(|y| (0..view.width()).map(move |x| [x, y]));
    pixels
        .map(|pixel| {
            let samples: Vec<_> = (0..count).map(|index| view.start(pixel, index)).collect();
            let mut light = vec![Rgb::BLACK; samples.len()];
            inspect.radiance(&world, &samples, &mut light, &Stop::new()).unwrap();
            light.iter().map(|light| light.g).collect()
        })
        .collect()
}

struct Moments {
    mean: f64,
    variance: f64,
    error: f64,
}

fn moments(values: &[f32]) -> Moments {
    let count = values.len() as f64;
    let mean = values.iter().map(|&v| f64::from(v)).sum::<f64>() / count;
    let variance =
        values.iter().map(|&v| (f64::from(v) - mean) * (f64::from(v) - mean)).sum::<f64>() / (count - 1.0);
    Moments { mean, variance, error: (variance / count).sqrt() }
}

#[test]
fn one_colour_is_unchanged_at_any_distance() {
    for times in [0.1, 3.0, 70.0, 5000.0] {
        let scene = floor(64, times, above(), |_, _| [188, 60, 250, 255]);
        let as_it_is = albedos(&scene, Minification::None, 4);
        assert!(as_it_is.iter().flatten().all(|&v| v > 0.04));
        for (one, other) in albedos(&scene, Minification::Footprint, 4).concat().iter().zip(as_it_is.concat())
        {
            // Weights of four pixels add up to 1 but for some roundings, and so do those of two copies.
            assert!((one - other).abs() <= 8.0 * f32::EPSILON * other, "{one} {other}");
        }
    }
}

#[test]
fn magnified_textures_keep_their_bits() {
    // The floor is 20 m and has 40 pixels of the picture, each as large as one of the screen: twice what is averaged.
    let scene = floor(40, 1.0, above(), chessboard);
    assert_eq!(albedos(&scene, Minification::Footprint, 8), albedos(&scene, Minification::None, 8));
    // Four times as fine is not.
    let scene = floor(40, 4.0, above(), chessboard);
    assert_ne!(albedos(&scene, Minification::Footprint, 8), albedos(&scene, Minification::None, 8));
}

#[test]
fn a_fine_chessboard_is_its_mean_with_less_noise() {
    for (times, share) in [(4.0, 0.5), (16.0, 0.01), (300.0, 0.01)] {
        let scene = floor(64, times, above(), chessboard);
        let seen = |filter| moments(&albedos(&scene, filter, 64).concat());
        let (plain, filtered) = (seen(Minification::None), seen(Minification::Footprint));
        for found in [&plain, &filtered] {
            // Half the cells are white. Roundings of sums of 64² pixels are far below a millionth.
            assert!(
                (found.mean - 0.5).abs() < 4.0 * found.error + 1e-6,
                "{times}: {} ± {}",
                found.mean,
                found.error
            );
        }
        assert!(
            filtered.variance < share * plain.variance,
            "{times}: {} {}",
            filtered.variance,
            plain.variance
        );
    }
}

#[test]
fn a_floor_to_the_horizon_keeps_the_mean_of_its_rows() {
    // Bands along x of random grays, so that rows differ; across, another pattern, so that the wide side of the footprint counts.
    let camera = Camera::looking_at(Vec3::new(0.0, 0.4, 9.5), Vec3::new(0.0, 0.0, 4.0), Vec3::Y, 0.35);
    let gray = |x: u32, y: u32| {
        let value =
            (luch_sampling::hash::mix64(u64::from(y) << 8) as u8) / 2 + ((x * 37 + y * 11) % 128) as u8;
        [value, value, value, 255]
    };
    let scene = floor(128, 3.0, camera, gray);
    let width = scene.settings.width as usize;
    let rows = |filter, count| -> Vec<Moments> {
        albedos(&scene, filter, count).chunks(width).map(|row| moments(&row.concat())).collect()
    };
    let (filtered, reference) = (rows(Minification::Footprint, 256), rows(Minification::None, 4096));
    assert!(reference.iter().any(|row| row.variance > 1e-3), "the floor is in the picture");
    for (y, row) in filtered.iter().enumerate() {
        // A filtered value is a mean over less than a pixel around its place (two copies' pixels, each at most half a pixel of the
        // screen wide, reach a pixel at most): the row's mean lies between those of the row and its neighbours, up to noise.
        let near = &reference[y.saturating_sub(1)..(y + 2).min(reference.len())];
        let error = 4.0 * near.iter().fold(row.error, |error, other| error.max(other.error)) * 2.0_f64.sqrt();
        let least = near.iter().map(|other| other.mean).fold(f64::INFINITY, f64::min) - error;
        let most = near.iter().map(|other| other.mean).fold(0.0, f64::max) + error;
        assert!((least..=most).contains(&row.mean), "row {y}: {} is not in {least}..{most}", row.mean);
        assert!(
            row.variance <= reference[y].variance * 1.1,
            "row {y}: {} {}",
            row.variance,
            reference[y].variance
        );
    }
}
