//! From scene light to what a screen shows: exposure, a display curve, the sRGB transfer curve.
//!
//! A curve takes linear Rec. 709 light of any brightness and gives linear Rec. 709 light between 0 and 1, where 1 is the
//! screen's white. The published source of each formula stands at its function in `tone/curve.rs`.

mod curve;
mod dither;

use crate::{Image, Rgb, srgb};
use serde::{Deserialize, Serialize};
use std::fmt;

/// How light too bright for a screen is brought into its range.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Curve {
    /// Nothing: light above 1 is clipped.
    #[default]
    Linear,
    /// Extended Reinhard on luminance; luminance 4 becomes white.
    Reinhard,
    /// Hable's filmic curve of "Uncharted 2"; light 11.2 becomes white.
    Hable,
    /// Hill's fit of the ACES reference and output transforms.
    AcesFitted,
    /// Sobotka's AgX with its base look, Wrensch's polynomial.
    Agx,
    /// The Khronos PBR neutral tone mapper: leaves colours below 0.8 nearly as they are.
    PbrNeutral,
}

impl Curve {
    /// Every curve.
    pub const ALL: [Curve; 6] =
        [Curve::Linear, Curve::Reinhard, Curve::Hable, Curve::AcesFitted, Curve::Agx, Curve::PbrNeutral];

    /// Its name in scene files and on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Curve::Linear => "linear",
            Curve::Reinhard => "reinhard",
            Curve::Hable => "hable",
            Curve::AcesFitted => "aces",
            Curve::Agx => "agx",
            Curve::PbrNeutral => "pbr-neutral",
        }
    }

    /// All names, separated by commas, for messages.
    pub fn names() -> String {
        Self::ALL.map(Self::name).join(", ")
    }

    /// The curve of a name.
    pub fn from_name(name: &str) -> Option<Curve> {
        Self::ALL.into_iter().find(|curve| curve.name() == name)
    }

    /// Display-linear colour, each channel 0 to 1. Negative and NaN channels count as 0, infinite ones as very bright.
    pub fn apply(self, light: Rgb) -> Rgb {
        let light = light.map(|v| if v > 0.0 { v.min(BRIGHTEST) } else { 0.0 });
        let shown = match self {
            Curve::Linear => light,
            Curve::Reinhard => curve::reinhard(light),
            Curve::Hable => light.map(curve::hable),
            Curve::AcesFitted => curve::aces(light),
            Curve::Agx => curve::agx(light),
            Curve::PbrNeutral => curve::pbr_neutral(light),
        };
        shown.map(|v| v.clamp(0.0, 1.0))
    }
}

/// Far beyond every curve's white, and its square is still a number.
const BRIGHTEST: f32 = 1e9;

impl fmt::Display for Curve {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// Everything between scene light and stored numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Tone {
    /// Stops: light is multiplied by 2 to this power.
    pub exposure: f32,
    /// The display curve.
    pub curve: Curve,
}

impl Tone {
    /// Display-linear colour of one pixel, each channel 0 to 1.
    pub fn apply(&self, light: Rgb) -> Rgb {
        self.curve.apply(light * self.gain())
    }

    /// The picture as sRGB bytes, each rounded to nearest.
    pub fn to_u8(&self, image: &Image<Rgb>) -> Image<[u8; 3]> {
        let gain = self.gain();
        image.map(|&light| self.curve.apply(light * gain).to_array().map(srgb::encode_u8))
    }

    /// The picture as sRGB bytes, each rounded up or down by chance, so that smooth gradients show no steps and
    /// areas keep their mean. The chance depends on the pixel's place alone: the same picture gives the same bytes.
    pub fn to_u8_dithered(&self, image: &Image<Rgb>) -> Image<[u8; 3]> {
        let gain = self.gain();
        let width = image.width().max(1);
        let mut index = 0u32;
        image.map(|&light| {
            let (x, y) = (index % width, index / width);
            index += 1;
            let shown = self.curve.apply(light * gain).to_array();
            std::array::from_fn(|channel| {
                let exact = srgb::encode(shown[channel]) * 255.0;
                (exact + dither::threshold(x, y, channel as u32)) as u8
            })
        })
    }

    /// The picture as sRGB numbers of 16 bits, each rounded to nearest.
    pub fn to_u16(&self, image: &Image<Rgb>) -> Image<[u16; 3]> {
        let gain = self.gain();
        image.map(|&light| self.curve.apply(light * gain).to_array().map(srgb::encode_u16))
    }

    fn gain(&self) -> f32 {
        libm::exp2f(self.exposure)
    }
}

#[cfg(test)]
mod tests;
