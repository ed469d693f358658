//! What cases belong to.

use super::{Case, bodies, enclosures, hidden, lamps, partly, picture};
use serde::Serialize;

/// Cases that are about one thing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "lowercase")]
#[expect(missing_docs, reason = "`shows` says what each is")]
pub enum Family {
    F1,
    F2,
    F3,
    F4,
    F5,
    F6,
    F7,
    F8,
    F10,
    F11,
    F12,
    F14,
    F15,
    Alpha,
    Sides,
    Mixture,
    Color,
    Lens,
    Glossy,
}

/// Families of the list that are not here, and why.
pub const MISSING: [(&str, &str); 3] = [
    ("F9", "it needs fog"),
    ("F13", "no path from the camera finds the light of a point over a mirror"),
    ("F16", "it needs fog"),
];

impl Family {
    /// All of them.
    pub const ALL: [Self; 19] = [
        Self::F1,
        Self::F2,
        Self::F3,
        Self::F4,
        Self::F5,
        Self::F6,
        Self::F7,
        Self::F8,
        Self::F10,
        Self::F11,
        Self::F12,
        Self::F14,
        Self::F15,
        Self::Alpha,
        Self::Sides,
        Self::Mixture,
        Self::Color,
        Self::Lens,
        Self::Glossy,
    ];

    /// The name used on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::F1 => "F1",
            Self::F2 => "F2",
            Self::F3 => "F3",
            Self::F4 => "F4",
            Self::F5 => "F5",
            Self::F6 => "F6",
            Self::F7 => "F7",
            Self::F8 => "F8",
            Self::F10 => "F10",
            Self::F11 => "F11",
            Self::F12 => "F12",
            Self::F14 => "F14",
            Self::F15 => "F15",
            Self::Alpha => "alpha",
            Self::Sides => "sides",
            Self::Mixture => "mixture",
            Self::Color => "color",
            Self::Lens => "lens",
            Self::Glossy => "glossy",
        }
    }

    /// The member with this [`name`](Self::name), in capitals or not, or `None`.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|family| family.name().eq_ignore_ascii_case(name))
    }

    /// What its cases show, in a sentence.
    pub const fn shows(self) -> &'static str {
        match self {
            Self::F1 => {
                "A closed room that glows and reflects the same everywhere shows L/(1 − ρ), and after k scatterings k terms of that series."
            }
            Self::F2 => "A point light in the middle of a gray sphere lights all of it the same.",
            Self::F3 => "A sphere that glows in part has the same indirect light everywhere.",
            Self::F4 => "Concentric spheres exchange light by the form factor (r₁/r₂)².",
            Self::F5 => "Endless parallel planes light each other without end.",
            Self::F6 => "A convex body in uniform light shows its albedo; a white one cannot be seen.",
            Self::F7 => "A white body cannot be seen in white light, however concave it is.",
            Self::F8 => {
                "Glass and mirrors that absorb nothing cannot be seen in uniform light; what absorbs all, and a lamp, show themselves."
            }
            Self::F10 => "A gray floor under sun, point light and spot reflects ρE/π.",
            Self::F11 => "A gray floor under a uniform sky, open or half hidden by a wall.",
            Self::F12 => "A gray sphere with the sun behind the viewer, by point and as a whole.",
            Self::F14 => {
                "Rectangles, discs and spheres over a gray floor shine by their form factors, sampled by light, by BSDF and by both."
            }
            Self::F15 => "Lamps and skies that are hidden in part, in their soft shadows.",
            Self::Alpha => "What is there in part lets through, and shines, in part.",
            Self::Sides => "What has only a front lets light from behind pass.",
            Self::Mixture => "A mixture of materials reflects the mean of its parts.",
            Self::Color => "Colours of vertices multiply those of the material.",
            Self::Lens => "An edge out of focus is blurred by the shape of the lens.",
            Self::Glossy => {
                "A glossy floor, of normals that are uniform in a disc of slopes, mirrors a lamp by the part of the disc that points there."
            }
        }
    }

    /// Its cases.
    pub fn cases(self) -> Vec<Case> {
        match self {
            Self::F1 => enclosures::uniform(),
            Self::F2 => enclosures::point_in_sphere(),
            Self::F3 => enclosures::partly_glowing(),
            Self::F4 => enclosures::concentric(),
            Self::F5 => enclosures::parallel_planes(),
            Self::F6 => bodies::convex_bodies(),
            Self::F7 => bodies::concave_bodies(),
            Self::F8 => bodies::unabsorbing_bodies(),
            Self::F10 => lamps::sun_point_and_spot(),
            Self::F11 => bodies::under_the_sky(),
            Self::F12 => lamps::sunlit_sphere(),
            Self::F14 => lamps::over_a_floor(),
            Self::F15 => hidden::in_part(),
            Self::Alpha => partly::alpha(),
            Self::Sides => partly::sides(),
            Self::Mixture => partly::mixtures(),
            Self::Color => partly::colors(),
            Self::Lens => picture::lens(),
            Self::Glossy => picture::glossy(),
        }
    }
}
