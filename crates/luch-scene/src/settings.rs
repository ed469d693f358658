//! How a picture is to be made, as plain data.

use luch_sampling::Sequence;
use serde::{Deserialize, Serialize};

/// Choices of one rendering. Those that change samples are part of the picture's identity; the rest (targets, display) is not.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Settings {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Which light transport is computed.
    pub integrator: Integrator,
    /// Where the sample points come from.
    pub sequence: Sequence,
    /// The pixel's window on the picture plane.
    pub filter: Filter,
    /// Chooses the randomisation; pictures of different seeds are independent.
    pub seed: u64,
    /// Which normals are shaded with.
    pub normals: Normals,
    /// Skips back faces of closed opaque meshes that the camera is outside of (the lecture's optimisation 84).
    pub cull_back_faces: bool,
    /// Whether textures are blurred that are finer than the pixels.
    pub texture_filter: Minification,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            width: 960,
            height: 540,
            integrator: Integrator::default(),
            sequence: Sequence::Sobol,
            filter: Filter::default(),
            seed: 0,
            normals: Normals::Interpolated,
            cull_back_faces: false,
            texture_filter: Minification::Footprint,
        }
    }
}

/// The names of the light transport algorithms.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Integrator {
    /// Path tracing with light sampling and multiple importance sampling.
    Path {
        /// Most scatterings of a path; 0 shows only lamps.
        max_depth: u32,
    },
    /// Path tracing without light sampling: the reference for lights that have a surface.
    PlainPath {
        /// Most scatterings of a path.
        max_depth: u32,
    },
    /// Emitted light and one scattering.
    Direct,
    /// How much of the cosine-weighted hemisphere is open within a distance.
    Occlusion {
        /// Metres; infinite for all the way.
        distance: f32,
    },
    /// One property of the surface seen.
    Inspect(Property),
}

impl Default for Integrator {
    fn default() -> Self {
        Integrator::Path { max_depth: 64 }
    }
}

/// What `inspect` shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Property {
    /// Shading normal in world axes, −1 to 1.
    Normal,
    /// Geometric normal in world axes, −1 to 1.
    GeometricNormal,
    /// Texture coordinates of set 0.
    Uv,
    /// Distance along the viewing axis, metres.
    Depth,
    /// Colour without light.
    Albedo,
    /// A colour for each instance.
    Instance,
    /// A colour for each material.
    Material,
    /// A colour for each triangle.
    Primitive,
    /// Barycentric coordinates.
    Barycentric,
}

impl Property {
    /// Every property.
    pub const ALL: [Property; 9] = [
        Property::Normal,
        Property::GeometricNormal,
        Property::Uv,
        Property::Depth,
        Property::Albedo,
        Property::Instance,
        Property::Material,
        Property::Primitive,
        Property::Barycentric,
    ];

    /// The name in files and on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Property::Normal => "normal",
            Property::GeometricNormal => "geometric-normal",
            Property::Uv => "uv",
            Property::Depth => "depth",
            Property::Albedo => "albedo",
            Property::Instance => "instance",
            Property::Material => "material",
            Property::Primitive => "primitive",
            Property::Barycentric => "barycentric",
        }
    }

    /// The property called `name`.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|property| property.name() == name)
    }
}

/// The weight of light about a pixel's centre. Radii and widths are in pixels.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Filter {
    /// The same everywhere up to `radius` in x and in y.
    Box {
        /// 0.5 is the pixel itself.
        radius: f32,
    },
    /// Falls linearly to zero at `radius`.
    Tent {
        /// 1 reaches the neighbours' centres.
        radius: f32,
    },
    /// A normal distribution, cut at `radius`.
    Gaussian {
        /// Where it is cut.
        radius: f32,
        /// Its standard deviation.
        deviation: f32,
    },
    /// The Blackman–Harris window of four terms, zero at `radius`.
    BlackmanHarris {
        /// Where it ends.
        radius: f32,
    },
}

impl Default for Filter {
    fn default() -> Self {
        Filter::BlackmanHarris { radius: 1.5 }
    }
}

/// Which normals are shaded with.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Normals {
    /// One for each triangle: the facetted look (lecture 82).
    Flat,
    /// Interpolated from the corners: the smooth look (lecture 83).
    #[default]
    Interpolated,
}

/// What becomes of textures that are finer than the pixels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Minification {
    /// They are averaged over the narrower side of what a pixel covers of them; the wider one is left to the samples. Less noise, and
    /// memory for smaller copies of them: a third of theirs.
    #[default]
    Footprint,
    /// Every sample reads the texture as it is.
    None,
}

impl Minification {
    /// All of them.
    pub const ALL: [Self; 2] = [Self::Footprint, Self::None];

    /// The name in files and on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Footprint => "footprint",
            Self::None => "none",
        }
    }

    /// The one called `name`.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.name() == name)
    }
}
