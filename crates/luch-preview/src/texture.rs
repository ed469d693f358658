//! Colours and numbers of materials at a place of a surface.

use crate::surface::Spot;
use glam::Vec2;
use luch_image::{Bitmap, Encoding, Pixels, Rgb};
use luch_scene::{
    Channel, ColorValue, Material, Opacity, ScalarValue, Texture, TextureFilter, TextureUse, Wrap,
};

impl Spot<'_> {
    /// A colour here.
    pub(crate) fn color(&self, value: &ColorValue) -> Rgb {
        let mut color = value.factor;
        if let Some([r, g, b, _]) = value.texture.as_ref().and_then(|used| self.texture(used)) {
            color *= Rgb::new(r, g, b);
        }
        if let Some(c) = self.vertex_color().filter(|_| value.vertex_color) {
            color *= Rgb::new(c.x, c.y, c.z);
        }
        color
    }

    /// A number here.
    pub(crate) fn scalar(&self, value: &ScalarValue) -> f32 {
        let mut number = value.factor;
        if let Some((used, channel)) = &value.texture
            && let Some([r, g, b, a]) = self.texture(used)
        {
            number *= match channel {
                Channel::Red => r,
                Channel::Green => g,
                Channel::Blue => b,
                Channel::Alpha => a,
                Channel::Luminance => Rgb::new(r, g, b).luminance(),
            };
        }
        if let Some(color) = self.vertex_color().filter(|_| value.vertex_alpha) {
            number *= color.w;
        }
        number
    }

    /// Whether the material is there. What is there by chance counts where its chance is at least half of the greatest that
    /// its factor allows, so that a leaf keeps its outline and a thin veil is seen.
    pub(crate) fn is_there(&self, material: &Material) -> bool {
        match &material.opacity {
            Opacity::Opaque => true,
            Opacity::Mask { alpha, cutoff } => self.scalar(alpha) >= *cutoff,
            Opacity::Blend { alpha } => {
                let chance = self.scalar(alpha);
                chance > 0.0 && chance >= alpha.factor / 2.0
            }
        }
    }

    fn texture(&self, used: &TextureUse) -> Option<[f32; 4]> {
        let scene = self.seen.subject.scene?;
        let uv = used.place(self.uv(usize::from(used.uv_set)).unwrap_or(Vec2::ZERO));
        match scene.textures.get(used.texture.index())? {
            Texture::Image { image, encoding, wrap, filter } => {
                look_up(scene.images.get(image.index())?, *encoding, *wrap, *filter, uv)
            }
            Texture::Checker { even, odd } => {
                let is_odd = (uv.x.floor() as i64 ^ uv.y.floor() as i64) & 1 == 1;
                let color = if is_odd { odd } else { even };
                Some([color.r, color.g, color.b, 1.0])
            }
        }
    }
}

/// The pixel of an endless row that stands at `at`.
fn wrapped(at: i64, count: u32, wrap: Wrap) -> u32 {
    let count = i64::from(count);
    let place = match wrap {
        Wrap::Repeat => at.rem_euclid(count),
        Wrap::Mirror => {
            let there_and_back = at.rem_euclid(2 * count);
            there_and_back.min(2 * count - 1 - there_and_back)
        }
        Wrap::Clamp => at.clamp(0, count - 1),
    };
    place as u32
}

/// A picture at texture coordinates; `None` if it has not the pixels it should have.
fn look_up(
    image: &Bitmap,
    encoding: Encoding,
    wrap: [Wrap; 2],
    filter: TextureFilter,
    uv: Vec2,
) -> Option<[f32; 4]> {
    let count = match &image.pixels {
        Pixels::U8(pixels) => pixels.len(),
        Pixels::U16(pixels) => pixels.len(),
        Pixels::F32(pixels) => pixels.len(),
    };
    if count == 0 || count as u64 != u64::from(image.width) * u64::from(image.height) {
        return None;
    }
    let place = Vec2::new(uv.x * image.width as f32, (1.0 - uv.y) * image.height as f32);
    let read = |column: i64, row: i64| {
        image.linear(wrapped(column, image.width, wrap[0]), wrapped(row, image.height, wrap[1]), encoding)
    };
    if filter == TextureFilter::Nearest {
        return Some(read(place.x.floor() as i64, place.y.floor() as i64));
    }
    let place = place - 0.5;
    let corner = place.floor();
    let part = place - corner;
    let (left, top) = (corner.x as i64, corner.y as i64);
    let weights =
        [(1.0 - part.x) * (1.0 - part.y), part.x * (1.0 - part.y), (1.0 - part.x) * part.y, part.x * part.y];
    let mut sum = [0.0; 4];
    for (i, weight) in (0..).zip(weights) {
        // A weight of zero must not let an infinite pixel in.
        if weight > 0.0 {
            let pixel = read(left.saturating_add(i & 1), top.saturating_add(i >> 1));
            sum.iter_mut().zip(pixel).for_each(|(total, value)| *total += weight * value);
        }
    }
    Some(sum)
}
