//! Metals by name.

use luch_image::Rgb;
use serde::{Deserialize, Serialize};

/// A metal with a measured complex index of refraction.
///
/// Values at about 630, 532 and 465 nm for red, green and blue: Ag, Au, Cu from Johnson and Christy 1972; Cr, Fe, Ni, Ti from
/// Johnson and Christy 1974; Al, W from Rakić 1998 and Weaver 1981 as quoted by the CRC Handbook.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Metal {
    /// Al.
    Aluminium,
    /// Cr.
    Chromium,
    /// Cu.
    Copper,
    /// Au.
    Gold,
    /// Fe.
    Iron,
    /// Ni.
    Nickel,
    /// Ag.
    Silver,
    /// Ti.
    Titanium,
    /// W.
    Tungsten,
}

impl Metal {
    /// All metals, by name.
    pub const ALL: [Metal; 9] = [
        Metal::Aluminium,
        Metal::Chromium,
        Metal::Copper,
        Metal::Gold,
        Metal::Iron,
        Metal::Nickel,
        Metal::Silver,
        Metal::Titanium,
        Metal::Tungsten,
    ];

    /// The name in scene files.
    pub const fn name(self) -> &'static str {
        match self {
            Metal::Aluminium => "aluminium",
            Metal::Chromium => "chromium",
            Metal::Copper => "copper",
            Metal::Gold => "gold",
            Metal::Iron => "iron",
            Metal::Nickel => "nickel",
            Metal::Silver => "silver",
            Metal::Titanium => "titanium",
            Metal::Tungsten => "tungsten",
        }
    }

    /// The metal called `name`.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|metal| metal.name() == name)
    }

    /// Real part of the index of refraction.
    pub const fn eta(self) -> Rgb {
        match self {
            Metal::Aluminium => Rgb::new(1.37, 0.91, 0.64),
            Metal::Chromium => Rgb::new(3.11, 2.79, 2.06),
            Metal::Copper => Rgb::new(0.23, 1.12, 1.17),
            Metal::Gold => Rgb::new(0.18, 0.54, 1.33),
            Metal::Iron => Rgb::new(2.88, 2.89, 2.59),
            Metal::Nickel => Rgb::new(1.98, 1.82, 1.63),
            Metal::Silver => Rgb::new(0.056, 0.054, 0.046),
            Metal::Titanium => Rgb::new(2.68, 2.43, 2.13),
            Metal::Tungsten => Rgb::new(3.64, 3.48, 3.31),
        }
    }

    /// Imaginary part of the index of refraction.
    pub const fn k(self) -> Rgb {
        match self {
            Metal::Aluminium => Rgb::new(7.60, 6.43, 5.57),
            Metal::Chromium => Rgb::new(3.32, 3.33, 3.06),
            Metal::Copper => Rgb::new(3.42, 2.59, 2.41),
            Metal::Gold => Rgb::new(3.43, 2.23, 1.88),
            Metal::Iron => Rgb::new(3.36, 3.12, 2.77),
            Metal::Nickel => Rgb::new(3.74, 3.21, 2.71),
            Metal::Silver => Rgb::new(4.28, 3.43, 2.87),
            Metal::Titanium => Rgb::new(3.61, 3.24, 2.88),
            Metal::Tungsten => Rgb::new(2.92, 2.74, 2.47),
        }
    }
}
