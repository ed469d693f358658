//! Light for scenes that bring none: a soft studio that shows form.

use glam::Vec3;
use luch_image::{Bitmap, Encoding, Pixels, Rgb};

const WIDTH: u32 = 128;
const HEIGHT: u32 = 64;

/// Radiance straight up, at the horizon and straight down: a room, bright above, dim below.
const ZENITH: Rgb = Rgb::new(0.42, 0.47, 0.55);
const HORIZON: Rgb = Rgb::new(0.34, 0.35, 0.37);
const NADIR: Rgb = Rgb::new(0.16, 0.15, 0.14);

/// A round lamp with soft edges: radiance `peak · exp(sharpness · (cos θ − 1))` at the angle θ from its middle.
struct Lamp {
    toward: Vec3,
    peak: Rgb,
    sharpness: f32,
}

/// Warm from the upper left of a camera that looks along −Z, cool and wide from the right, a rim from behind.
const LAMPS: [Lamp; 3] = [
    Lamp { toward: Vec3::new(-0.55, 0.65, 0.52), peak: Rgb::new(10.0, 8.8, 7.2), sharpness: 20.0 },
    Lamp { toward: Vec3::new(0.94, 0.25, 0.22), peak: Rgb::new(0.42, 0.56, 0.78), sharpness: 4.0 },
    Lamp { toward: Vec3::new(0.3, 0.45, -0.84), peak: Rgb::new(2.2, 2.3, 2.5), sharpness: 16.0 },
];

/// A picture in latitude and longitude for [`luch_scene::Environment::LatLong`], 128×64: a gradient from above to below
/// with a warm key lamp, a cool fill and a rim lamp, all soft. A gray ball in it is neither too dark nor burnt out.
pub fn neutral_sky() -> Bitmap {
    let mut pixels = Vec::with_capacity((WIDTH * HEIGHT) as usize);
    for row in 0..HEIGHT {
        for column in 0..WIDTH {
            let Rgb { r, g, b } = radiance(direction(column, row));
            pixels.push([r, g, b, 1.0]);
        }
    }
    let pixels = Pixels::F32(pixels);
    Bitmap { width: WIDTH, height: HEIGHT, pixels, encoding: Encoding::Linear, has_alpha: false }
}

/// The direction of a pixel's centre: top row +Y, middle column −Z, a quarter to the right of it +X.
fn direction(column: u32, row: u32) -> Vec3 {
    let longitude = ((column as f32 + 0.5) / WIDTH as f32 - 0.5) * std::f32::consts::TAU;
    let polar = (row as f32 + 0.5) / HEIGHT as f32 * std::f32::consts::PI;
    let ring = libm::sinf(polar);
    Vec3::new(ring * libm::sinf(longitude), libm::cosf(polar), -ring * libm::cosf(longitude))
}

fn radiance(direction: Vec3) -> Rgb {
    let end = if direction.y > 0.0 { ZENITH } else { NADIR };
    let height = direction.y.abs().sqrt();
    LAMPS.iter().fold(HORIZON * (1.0 - height) + end * height, |sum, lamp| {
        let cosine = direction.dot(lamp.toward.normalize());
        sum + lamp.peak * libm::expf(lamp.sharpness * (cosine - 1.0))
    })
}
