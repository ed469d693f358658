//! What a preview shows.

use luch_image::Rgb;
use luch_scene::Normals;

/// How a subject is drawn. The default is a shaded picture without lines.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Style {
    /// What surfaces show.
    pub fill: Fill,
    /// Which normals they are shaded with, and which [`Fill::Normals`] shows.
    pub normals: Normals,
    /// Whether surfaces seen from behind are passed over; right for closed meshes only.
    pub hides_back_faces: bool,
    /// Edges as thin lines.
    pub lines: Option<Lines>,
    /// Borders and faulty edges in loud colours.
    pub marks: Option<Marks>,
    /// Vertices as dots.
    pub dots: Option<Dots>,
    /// Linear light where there is nothing.
    pub background: Rgb,
    /// How steps at outlines are softened.
    pub antialiasing: Antialiasing,
}

impl Default for Style {
    fn default() -> Self {
        Self {
            fill: Fill::Shaded,
            normals: Normals::Interpolated,
            hides_back_faces: false,
            lines: None,
            marks: None,
            dots: None,
            background: Rgb::gray(0.02),
            antialiasing: Antialiasing::None,
        }
    }
}

impl Style {
    /// Surfaces that show `fill`.
    pub fn filled(fill: Fill) -> Self {
        Self { fill, ..Self::default() }
    }

    /// Bright lines on dark ground, without surfaces.
    pub fn wireframe(hidden: Hidden) -> Self {
        let lines = Lines { hidden, color: Rgb::gray(0.8), ..Lines::default() };
        Self { fill: Fill::Nothing, lines: Some(lines), ..Self::default() }
    }
}

/// What surfaces show. Quantities such as normals come out so that the stored bytes of an sRGB picture are the customary ones.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Fill {
    /// The background; surfaces still hide what is behind them.
    Nothing,
    /// The material's own colour under a lamp at the eye.
    #[default]
    Shaded,
    /// Normals in world axes, −1 to 1 as bytes 0 to 255.
    Normals,
    /// Texture coordinates of set 0: u as red, v as green, both taken modulo one.
    Uv,
    /// Texture coordinates of set 0 as a chessboard of 16 × 16 squares, shaded.
    Checker,
    /// A colour for each instance: the one that the renderer's `inspect` gives it.
    Instances,
    /// A colour for each face: of a triangle the one that the renderer's `inspect` gives it.
    Faces,
    /// A colour for each material.
    Materials,
    /// The nearest white, the farthest dark, even in the inverse of the depth as z-buffers are.
    Depth,
    /// The outside grey, the inside red.
    Facing,
}

impl Fill {
    /// All of them.
    pub const ALL: [Self; 10] = [
        Self::Nothing,
        Self::Shaded,
        Self::Normals,
        Self::Uv,
        Self::Checker,
        Self::Instances,
        Self::Faces,
        Self::Materials,
        Self::Depth,
        Self::Facing,
    ];

    /// The name on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Nothing => "nothing",
            Self::Shaded => "shaded",
            Self::Normals => "normals",
            Self::Uv => "uv",
            Self::Checker => "checker",
            Self::Instances => "instances",
            Self::Faces => "faces",
            Self::Materials => "materials",
            Self::Depth => "depth",
            Self::Facing => "facing",
        }
    }

    /// The one called `name`.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|fill| fill.name() == name)
    }
}

/// Edges as lines.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lines {
    /// Which edges.
    pub edges: EdgeSet,
    /// What becomes of those behind something.
    pub hidden: Hidden,
    /// In pixels, 0 to 64.
    pub width: f32,
    /// Linear light.
    pub color: Rgb,
}

impl Default for Lines {
    fn default() -> Self {
        Self { edges: EdgeSet::All, hidden: Hidden::Removed, width: 1.0, color: Rgb::BLACK }
    }
}

/// Which edges are drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum EdgeSet {
    /// All; of polygons, not of the triangles they are cut into.
    #[default]
    All,
    /// Creases, borders and faulty edges.
    Features {
        /// The least angle between neighbouring faces that is a crease, radians.
        crease_angle: f32,
    },
}

/// What becomes of lines behind something.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Hidden {
    /// They are left out.
    #[default]
    Removed,
    /// They are drawn at a quarter of their strength.
    Faint,
    /// They are drawn like the others.
    Shown,
}

/// Edges that a closed surface has none of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Marks {
    /// Where there is one face only.
    pub border: Rgb,
    /// Where there are more than two faces, or two of which one is turned round.
    pub non_manifold: Rgb,
    /// What becomes of those behind something.
    pub hidden: Hidden,
    /// In pixels, 0 to 64.
    pub width: f32,
}

impl Default for Marks {
    fn default() -> Self {
        let (border, non_manifold) = (Rgb::new(1.0, 0.35, 0.0), Rgb::new(1.0, 0.0, 1.0));
        Self { border, non_manifold, hidden: Hidden::Faint, width: 3.0 }
    }
}

/// Vertices as dots.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dots {
    /// In pixels, 0 to 64.
    pub diameter: f32,
    /// What becomes of those behind something.
    pub hidden: Hidden,
    /// Linear light.
    pub color: Rgb,
}

impl Default for Dots {
    fn default() -> Self {
        Self { diameter: 4.0, hidden: Hidden::Removed, color: Rgb::new(0.1, 0.3, 1.0) }
    }
}

/// How many samples a pixel's colour is the mean of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Antialiasing {
    /// One in the middle.
    #[default]
    None,
    /// Two by two.
    Four,
    /// Four by four.
    Sixteen,
}

impl Antialiasing {
    /// Samples along each side of a pixel.
    pub const fn factor(self) -> u32 {
        match self {
            Self::None => 1,
            Self::Four => 2,
            Self::Sixteen => 4,
        }
    }
}
