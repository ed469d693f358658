//! Directions to the sky and to suns.

use super::Routine;
use super::emitter::{built, toward};
use glam::{EulerRot, Mat3, Vec3};
use luch_image::{Bitmap, Image, Rgb};
use luch_scene::{Environment, Id, Light, Scene};

/// A sky in latitude and longitude with the brightness of a function of pixel, turned.
fn picture(parameters: &str, [width, height]: [u32; 2], light: impl Fn(u32, u32) -> f32) -> Option<Routine> {
    let places = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    let pixels: Vec<Rgb> = places.map(|(x, y)| Rgb::gray(light(x, y))).collect();
    let image = Image::from_pixels(width, height, pixels)?;
    let mut scene = Scene::default();
    scene.add_image(Bitmap::from_rgb(&image));
    let rotation = Mat3::from_euler(EulerRot::XYZ, 0.4, 1.0, 0.2);
    let image = Id::new(0);
    scene.environment = Some(Environment::LatLong { image, scale: Rgb::gray(1.0), rotation });
    toward("sky", parameters, built(scene), Vec3::ZERO, rotation * Vec3::Y)
}

fn sun(parameters: &str, angular_radius: f32) -> Option<Routine> {
    let mut scene = Scene::default();
    let direction = Vec3::new(0.48, -0.6, 0.64);
    scene.lights.push(Light::Sun { direction, irradiance: Rgb::gray(3.0), angular_radius });
    toward("sun", parameters, built(scene), Vec3::ZERO, -direction)
}

pub(super) fn routines() -> Vec<Routine> {
    let hot = |x: u32, y: u32| match (x, y) {
        (5, 2) => 30.0,
        (4 | 6, 2) | (5, 1 | 3) => 0.0,
        _ => 0.2,
    };
    let smooth = |x: u32, y: u32| {
        let (across, down) = (x as f32 / 64.0, y as f32 / 32.0);
        1.0 + libm::sinf(6.3 * across) * libm::sinf(3.1 * down) + 3.0 * libm::expf(-8.0 * down)
    };
    let both = {
        let mut scene = Scene::default();
        let pixels: Vec<Rgb> = (0..16 * 8).map(|at| Rgb::gray(if at == 37 { 40.0 } else { 0.1 })).collect();
        Image::from_pixels(16, 8, pixels).and_then(|image| {
            scene.add_image(Bitmap::from_rgb(&image));
            let (image, rotation) = (Id::new(0), Mat3::IDENTITY);
            scene.environment = Some(Environment::LatLong { image, scale: Rgb::gray(1.0), rotation });
            let direction = Vec3::new(0.6, -0.8, 0.0);
            let irradiance = Rgb::gray(1.5);
            scene.lights.push(Light::Sun { direction, irradiance, angular_radius: 0.2 });
            toward("sky", "a picture and a sun, picked by light", built(scene), Vec3::ZERO, Vec3::Y)
        })
    };
    [
        picture("16 × 8 pixels, one of them hot", [16, 8], hot),
        picture("64 × 32 pixels, smooth", [64, 32], smooth),
        both,
        sun("radius 0.3", 0.3),
        sun("radius 0.004 65, the real one", 0.004_65),
        sun("radius 0.000 5", 5e-4),
    ]
    .into_iter()
    .flatten()
    .collect()
}
