//! 3MF (3MF Consortium, "3D Manufacturing Format, core specification" 1.3): a packet of XML for 3D printing.
//!
//! Read: objects with meshes and components, the build, transforms, units, base materials as slots, parts in files of their
//! own (production extension). Written: one object, one base material for each slot. Colours, textures, lattices and
//! slicer settings are skipped.

mod model;
mod packet;
mod read;
mod write;

use super::error::Warning;
use crate::PolygonMesh;
pub use read::decode;
pub use write::{EncodeOptions, encode};

/// What a 3MF file holds.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ThreeMfFile {
    /// All that is to be built, in metres.
    pub mesh: PolygonMesh,
    /// The name of each material slot; the empty name for triangles without material.
    pub materials: Vec<String>,
    /// What was left out or put right.
    pub warnings: Vec<Warning>,
}

/// What a number of a file stands for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LengthUnit {
    /// 10⁻⁶ m.
    Micron,
    /// 10⁻³ m.
    Millimeter,
    /// 10⁻² m.
    Centimeter,
    /// 0.0254 m.
    Inch,
    /// 0.3048 m.
    Foot,
    /// 1 m.
    #[default]
    Meter,
}

impl LengthUnit {
    /// All units.
    pub const ALL: [Self; 6] =
        [Self::Micron, Self::Millimeter, Self::Centimeter, Self::Inch, Self::Foot, Self::Meter];

    /// The name in the file.
    pub fn name(self) -> &'static str {
        match self {
            Self::Micron => "micron",
            Self::Millimeter => "millimeter",
            Self::Centimeter => "centimeter",
            Self::Inch => "inch",
            Self::Foot => "foot",
            Self::Meter => "meter",
        }
    }

    /// The unit of this name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|unit| unit.name() == name)
    }

    /// Metres.
    pub fn meters(self) -> f64 {
        match self {
            Self::Micron => 1e-6,
            Self::Millimeter => 1e-3,
            Self::Centimeter => 1e-2,
            Self::Inch => 0.0254,
            Self::Foot => 0.3048,
            Self::Meter => 1.0,
        }
    }
}

/// True if bytes of unknown kind are probably 3MF.
pub(crate) fn looks_like(bytes: &[u8]) -> bool {
    bytes.starts_with(b"PK\x03\x04")
}
