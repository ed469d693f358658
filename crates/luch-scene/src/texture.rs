//! What varies over a surface: pictures and patterns, and how they are laid on.

use crate::Id;
use glam::{Affine2, Vec2};
use luch_image::{Bitmap, Encoding, Rgb};
use serde::{Deserialize, Serialize};

/// A function from texture coordinates to a colour and an alpha.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Texture {
    /// A picture; u runs to the right, v upward, the whole picture fills the unit square.
    Image {
        /// The picture.
        image: Id<Bitmap>,
        /// How its stored numbers are read; floating-point pictures are linear whatever is said here.
        encoding: Encoding,
        /// What lies beyond the unit square, along u and along v.
        wrap: [Wrap; 2],
        /// How values between the pixels are made.
        filter: TextureFilter,
    },
    /// A chessboard of unit squares: `even` where ⌊u⌋ + ⌊v⌋ is even.
    Checker {
        /// Colour of the square at the origin.
        even: Rgb,
        /// Colour of its neighbours.
        odd: Rgb,
    },
}

/// How a picture continues beyond its border.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Wrap {
    /// Again and again.
    #[default]
    Repeat,
    /// Again and again, every second time mirrored.
    Mirror,
    /// The border pixel for ever.
    Clamp,
}

/// How values between the pixels are made.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum TextureFilter {
    /// The pixel that holds the point.
    Nearest,
    /// Linear between the four nearest pixel centres.
    #[default]
    Bilinear,
}

/// A texture as a material uses it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct TextureUse {
    /// What is laid on.
    pub texture: Id<Texture>,
    /// Which uv set of the mesh.
    pub uv_set: u8,
    /// Applied to the mesh's uv before the look-up.
    pub transform: Affine2,
}

impl TextureUse {
    /// The texture laid on by uv set 0, unchanged.
    pub fn new(texture: Id<Texture>) -> Self {
        Self { texture, uv_set: 0, transform: Affine2::IDENTITY }
    }

    /// Texture coordinates for a mesh's uv.
    pub fn place(&self, uv: Vec2) -> Vec2 {
        self.transform.transform_point2(uv)
    }
}

/// A channel of a texture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Channel {
    /// Red.
    Red,
    /// Green.
    Green,
    /// Blue.
    Blue,
    /// Alpha.
    Alpha,
    /// Relative luminance of the colour.
    Luminance,
}

/// A colour that may vary: `factor`, times the texture if there is one, times the vertex colour if asked for.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ColorValue {
    /// The constant part.
    pub factor: Rgb,
    /// The varying part.
    pub texture: Option<TextureUse>,
    /// Whether the mesh's vertex colours multiply the rest; a mesh without them counts as white.
    pub vertex_color: bool,
}

impl ColorValue {
    /// The same colour everywhere.
    pub const fn constant(factor: Rgb) -> Self {
        Self { factor, texture: None, vertex_color: false }
    }

    /// A texture as it is.
    pub const fn textured(texture: TextureUse) -> Self {
        Self { factor: Rgb::WHITE, texture: Some(texture), vertex_color: false }
    }
}

impl From<Rgb> for ColorValue {
    fn from(factor: Rgb) -> Self {
        Self::constant(factor)
    }
}

/// A number that may vary: `factor`, times one channel of a texture if there is one, times the vertex alpha if asked for.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ScalarValue {
    /// The constant part.
    pub factor: f32,
    /// The varying part and the channel that is read.
    pub texture: Option<(TextureUse, Channel)>,
    /// Whether the mesh's vertex alpha multiplies the rest; a mesh without vertex colours counts as 1.
    pub vertex_alpha: bool,
}

impl ScalarValue {
    /// The same number everywhere.
    pub const fn constant(factor: f32) -> Self {
        Self { factor, texture: None, vertex_alpha: false }
    }

    /// A channel of a texture as it is.
    pub const fn textured(texture: TextureUse, channel: Channel) -> Self {
        Self { factor: 1.0, texture: Some((texture, channel)), vertex_alpha: false }
    }
}

impl From<f32> for ScalarValue {
    fn from(factor: f32) -> Self {
        Self::constant(factor)
    }
}
