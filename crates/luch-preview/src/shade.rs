//! From what a sample shows to its colour.

use crate::style::{Fill, Style};
use crate::surface::Spot;
use crate::visibility::Visibility;
use glam::{DVec2, Vec3};
use luch_image::{Rgb, srgb};
use luch_sampling::hash;
use rayon::prelude::*;

/// Turns samples into colours.
#[derive(Debug)]
pub(crate) struct Shader<'v> {
    seen: &'v Visibility<'v>,
    style: &'v Style,
    /// Least and greatest linear depth that is seen; where [`Fill::Depth`] needs them.
    depths: [f64; 2],
}

/// Light from all sides beside the lamp at the eye, so that grazing faces are not black.
const AMBIENT: f32 = 0.12;
/// Even black surfaces show their form.
const DARKEST: f32 = 0.03;
/// Squares along u and along v of a chessboard.
const SQUARES: f32 = 16.0;

impl<'v> Shader<'v> {
    pub(crate) fn new(seen: &'v Visibility<'v>, style: &'v Style) -> Self {
        let depths = if style.fill == Fill::Depth { range(seen) } else { [0.0; 2] };
        Self { seen, style, depths }
    }

    /// The colour of a sample, lines not counted.
    pub(crate) fn color(&self, x: u32, y: u32) -> Rgb {
        if self.style.fill == Fill::Nothing {
            return self.style.background;
        }
        let Some(spot) = Spot::of_sample(self.seen, x, y) else { return self.style.background };
        let instance = spot.part().number;
        match self.style.fill {
            Fill::Nothing => self.style.background,
            Fill::Shaded => self.lit(&spot, spot.base_color(), x, y),
            Fill::Normals => {
                let normal = spot.normal(self.style.normals) * 0.5 + 0.5;
                Rgb::from(normal.to_array()).map(shown)
            }
            Fill::Uv => spot.uv(0).map_or(Rgb::BLACK, |uv| {
                let wrapped = |v: f32| shown(v - v.floor());
                Rgb::new(wrapped(uv.x), wrapped(uv.y), 0.0)
            }),
            Fill::Checker => {
                let color = spot.uv(0).map_or(Rgb::gray(0.3), |uv| {
                    let [u, v] = [uv.x - uv.x.floor(), uv.y - uv.y.floor()];
                    let is_odd = ((u * SQUARES) as u32 + (v * SQUARES) as u32) & 1 == 1;
                    let tint = Rgb::new(0.2 + 0.7 * u, 0.2 + 0.7 * v, 0.9 - 0.35 * (u + v));
                    if is_odd { tint } else { tint * 0.25 }
                });
                self.lit(&spot, color, x, y)
            }
            Fill::Instances => id_color(u64::from(instance)),
            Fill::Faces => id_color(u64::from(instance) << 32 | u64::from(spot.face())),
            Fill::Materials => {
                let slot_color = || {
                    let id = spot.part().instance?.material(spot.slot())?;
                    Some(id_color(id.index() as u64))
                };
                slot_color().unwrap_or_else(|| id_color(u64::from(spot.slot())))
            }
            Fill::Depth => {
                let [least, most] = self.depths;
                let linear = self.seen.linear(x, y);
                let part = if most > least { ((linear - least) / (most - least)) as f32 } else { 1.0 };
                let nearness = if self.seen.nearer_is_greater() { part } else { 1.0 - part };
                Rgb::gray(shown(0.15 + 0.85 * nearness))
            }
            Fill::Facing => {
                let color =
                    if spot.is_front { Rgb::new(0.45, 0.55, 0.65) } else { Rgb::new(0.9, 0.05, 0.03) };
                self.lit(&spot, color, x, y)
            }
        }
    }

    /// Lambert's law on both sides under a lamp at the eye.
    fn lit(&self, spot: &Spot, color: Rgb, x: u32, y: u32) -> Rgb {
        let place = DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5);
        let toward_eye: Vec3 = self.seen.view.toward_eye(place).as_vec3();
        let cosine = spot.normal(self.style.normals).dot(toward_eye).abs();
        color.map(|v| v.max(DARKEST)) * (AMBIENT + (1.0 - AMBIENT) * cosine)
    }
}

/// Light that an sRGB picture stores as this fraction of 255.
fn shown(fraction: f32) -> f32 {
    srgb::decode_u8((fraction * 255.0 + 0.5) as u8)
}

/// A colour that tells neighbouring numbers apart: the renderer's.
fn id_color(id: u64) -> Rgb {
    let bits = hash::mix64(id.wrapping_add(hash::GOLDEN));
    let channel = |shift: u32| 0.15 + 0.75 * hash::unit_f32((bits >> shift) as u32);
    Rgb::new(channel(0), channel(20), channel(32))
}

/// Least and greatest linear depth of all samples that show something.
fn range(seen: &Visibility) -> [f64; 2] {
    let rows = (0..seen.view.size.height).into_par_iter().map(|y| {
        let row = (0..seen.view.size.width).filter(|&x| !seen.is_empty(x, y)).map(|x| seen.linear(x, y));
        row.fold([f64::INFINITY, 0.0], |[least, most], linear| [linear.min(least), linear.max(most)])
    });
    rows.reduce(|| [f64::INFINITY, 0.0], |a, b| [a[0].min(b[0]), a[1].max(b[1])])
}
