//! Textures at a point.

use crate::footprint::Blend;
use luch_image::{Bitmap, Encoding};
use luch_scene::{Scene, Texture, TextureFilter, Wrap};

use glam::Vec2;

/// Colour and alpha of a texture at texture coordinates. Of a picture that is finer than what is looked at, the copies that
/// `blend` says are read.
pub(crate) fn look_up(scene: &Scene, texture: &Texture, uv: Vec2, blend: Option<Blend>) -> [f32; 4] {
    match texture {
        Texture::Image { image, encoding, wrap, filter } => {
            let base = &*scene.images[image.index()];
            let read = |image: &Bitmap| match filter {
                TextureFilter::Nearest => nearest(image, *encoding, *wrap, uv),
                TextureFilter::Bilinear => bilinear(image, *encoding, *wrap, uv),
            };
            let Some(Blend { first, second, part }) = blend else { return read(base) };
            let (near, far) = (read(first.unwrap_or(base)), read(second));
            std::array::from_fn(|i| near[i] + (far[i] - near[i]) * part)
        }
        Texture::Checker { even, odd } => {
            let parity = whole(uv.x.floor()) ^ whole(uv.y.floor());
            let color = if parity & 1 == 0 { even } else { odd };
            [color.r, color.g, color.b, 1.0]
        }
    }
}

/// A coordinate as an integer; what is not finite or too large is cut.
fn whole(x: f32) -> i64 {
    x as i64
}

/// The pixel of a row of `count` that stands for place `at` of the endless row.
fn wrapped(at: i64, count: u32, wrap: Wrap) -> u32 {
    let n = i64::from(count);
    let place = match wrap {
        Wrap::Repeat => at.rem_euclid(n),
        Wrap::Mirror => {
            let m = at.rem_euclid(2 * n);
            m.min(2 * n - 1 - m)
        }
        Wrap::Clamp => at.clamp(0, n - 1),
    };
    place as u32
}

/// Place in pixels, rows counted from the top.
fn in_pixels(image: &Bitmap, uv: Vec2) -> [f32; 2] {
    [uv.x * image.width as f32, (1.0 - uv.y) * image.height as f32]
}

fn nearest(image: &Bitmap, encoding: Encoding, wrap: [Wrap; 2], uv: Vec2) -> [f32; 4] {
    let [x, y] = in_pixels(image, uv);
    let x = wrapped(whole(x.floor()), image.width, wrap[0]);
    let y = wrapped(whole(y.floor()), image.height, wrap[1]);
    image.linear(x, y, encoding)
}

fn bilinear(image: &Bitmap, encoding: Encoding, wrap: [Wrap; 2], uv: Vec2) -> [f32; 4] {
    let [x, y] = in_pixels(image, uv).map(|place| place - 0.5);
    let (left, top) = (x.floor(), y.floor());
    let (right_part, low_part) = (x - left, y - top);
    let (left, top) = (whole(left), whole(top));
    let columns = [left, left.saturating_add(1)].map(|at| wrapped(at, image.width, wrap[0]));
    let rows = [top, top.saturating_add(1)].map(|at| wrapped(at, image.height, wrap[1]));
    let weights = [
        (1.0 - right_part) * (1.0 - low_part),
        right_part * (1.0 - low_part),
        (1.0 - right_part) * low_part,
        right_part * low_part,
    ];
    let mut sum = [0.0; 4];
    for (i, weight) in weights.into_iter().enumerate() {
        // A weight of zero must not let an infinite pixel in.
        if weight > 0.0 {
            let pixel = image.linear(columns[i & 1], rows[i >> 1], encoding);
            for (total, value) in sum.iter_mut().zip(pixel) {
                *total += weight * value;
            }
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use luch_image::Pixels;

    #[test]
    fn wrapping_continues_the_row_as_named() {
        let row = |wrap| (-5..7).map(|at| wrapped(at, 3, wrap)).collect::<Vec<_>>();
        assert_eq!(row(Wrap::Repeat), [1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0]);
        assert_eq!(row(Wrap::Mirror), [1, 2, 2, 1, 0, 0, 1, 2, 2, 1, 0, 0]);
        assert_eq!(row(Wrap::Clamp), [0, 0, 0, 0, 0, 0, 1, 2, 2, 2, 2, 2]);
    }

    #[test]
    fn uv_origin_is_the_lower_left_corner_and_linear_ramps_are_reproduced() {
        // Two by two: the value is 10·column + row from the bottom.
        let pixels = [1.0, 11.0, 0.0, 10.0].map(|v| [v, 0.0, 0.0, 1.0]).to_vec();
        let image = Bitmap {
            width: 2,
            height: 2,
            pixels: Pixels::F32(pixels),
            encoding: Encoding::Linear,
            has_alpha: false,
        };
        let wrap = [Wrap::Clamp; 2];
        let at = |u, v| nearest(&image, Encoding::Linear, wrap, Vec2::new(u, v))[0];
        assert_eq!([at(0.1, 0.1), at(0.9, 0.1), at(0.1, 0.9), at(0.9, 0.9)], [0.0, 10.0, 1.0, 11.0]);
        for (u, v) in [(0.25, 0.25), (0.5, 0.5), (0.6, 0.3), (0.75, 0.75)] {
            let expected = 10.0 * (u - 0.25) * 2.0 + (v - 0.25) * 2.0;
            assert!((bilinear(&image, Encoding::Linear, wrap, Vec2::new(u, v))[0] - expected).abs() < 1e-5);
        }
        for uv in [Vec2::NAN, Vec2::INFINITY, Vec2::splat(1e30)] {
            // Any value will do, but it must be one.
            let _ = bilinear(&image, Encoding::Linear, [Wrap::Mirror; 2], uv);
        }
    }
}
