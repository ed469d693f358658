//! Linear colour.

use serde::{Deserialize, Serialize};
use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Sub};

/// Linear light in Rec. 709 primaries: a radiance, a reflectance or a weight.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, bytemuck::Pod, bytemuck::Zeroable,
)]
#[repr(C)]
pub struct Rgb {
    /// Red.
    pub r: f32,
    /// Green.
    pub g: f32,
    /// Blue.
    pub b: f32,
}

impl Rgb {
    /// No light.
    pub const BLACK: Rgb = Rgb::gray(0.0);
    /// One in every channel.
    pub const WHITE: Rgb = Rgb::gray(1.0);

    /// A colour from its channels.
    #[inline]
    pub const fn new(r: f32, g: f32, b: f32) -> Self {
        Self { r, g, b }
    }

    /// The same value in every channel.
    #[inline]
    pub const fn gray(value: f32) -> Self {
        Self::new(value, value, value)
    }

    /// The channels in order.
    #[inline]
    pub const fn to_array(self) -> [f32; 3] {
        [self.r, self.g, self.b]
    }

    /// Relative luminance Y (Rec. ITU-R BT.709).
    #[inline]
    pub fn luminance(self) -> f32 {
        0.212_639 * self.r + 0.715_169 * self.g + 0.072_192 * self.b
    }

    /// The largest channel.
    #[inline]
    pub fn max_channel(self) -> f32 {
        self.r.max(self.g).max(self.b)
    }

    /// The mean of the channels.
    #[inline]
    pub fn mean(self) -> f32 {
        (self.r + self.g + self.b) / 3.0
    }

    /// True if every channel is exactly zero.
    #[inline]
    pub fn is_black(self) -> bool {
        self.r == 0.0 && self.g == 0.0 && self.b == 0.0
    }

    /// True if no channel is infinite or NaN.
    #[inline]
    pub fn is_finite(self) -> bool {
        self.r.is_finite() && self.g.is_finite() && self.b.is_finite()
    }

    /// Applies `f` to each channel.
    #[inline]
    pub fn map(self, mut f: impl FnMut(f32) -> f32) -> Self {
        Self::new(f(self.r), f(self.g), f(self.b))
    }

    /// `self` at weight 0, `other` at weight 1.
    #[inline]
    pub fn lerp(self, other: Rgb, weight: f32) -> Self {
        self * (1.0 - weight) + other * weight
    }
}

impl From<[f32; 3]> for Rgb {
    #[inline]
    fn from([r, g, b]: [f32; 3]) -> Self {
        Self::new(r, g, b)
    }
}

impl Add for Rgb {
    type Output = Rgb;
    #[inline]
    fn add(self, other: Rgb) -> Rgb {
        Rgb::new(self.r + other.r, self.g + other.g, self.b + other.b)
    }
}

impl AddAssign for Rgb {
    #[inline]
    fn add_assign(&mut self, other: Rgb) {
        *self = *self + other;
    }
}

impl Sub for Rgb {
    type Output = Rgb;
    #[inline]
    fn sub(self, other: Rgb) -> Rgb {
        Rgb::new(self.r - other.r, self.g - other.g, self.b - other.b)
    }
}

impl Mul for Rgb {
    type Output = Rgb;
    #[inline]
    fn mul(self, other: Rgb) -> Rgb {
        Rgb::new(self.r * other.r, self.g * other.g, self.b * other.b)
    }
}

impl Mul<f32> for Rgb {
    type Output = Rgb;
    #[inline]
    fn mul(self, factor: f32) -> Rgb {
        Rgb::new(self.r * factor, self.g * factor, self.b * factor)
    }
}

impl Mul<Rgb> for f32 {
    type Output = Rgb;
    #[inline]
    fn mul(self, color: Rgb) -> Rgb {
        color * self
    }
}

impl MulAssign for Rgb {
    #[inline]
    fn mul_assign(&mut self, other: Rgb) {
        *self = *self * other;
    }
}

impl MulAssign<f32> for Rgb {
    #[inline]
    fn mul_assign(&mut self, factor: f32) {
        *self = *self * factor;
    }
}

impl Div<f32> for Rgb {
    type Output = Rgb;
    #[inline]
    fn div(self, divisor: f32) -> Rgb {
        Rgb::new(self.r / divisor, self.g / divisor, self.b / divisor)
    }
}
