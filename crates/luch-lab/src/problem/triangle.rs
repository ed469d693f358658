//! Random triangles.

use std::f64::consts::{LN_2, PI, TAU};

/// Where the three points are uniform.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TriangleDomain {
    /// The unit square.
    Square,
    /// A rectangle twice as long as wide.
    Rectangle,
    /// A disc.
    Disc,
    /// A ball in space.
    Ball,
}

/// Which triangles are counted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wanted {
    /// All angles below a right one.
    Acute,
    /// One angle above a right one.
    Obtuse,
}

impl TriangleDomain {
    /// Its name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Square => "square",
            Self::Rectangle => "rectangle",
            Self::Disc => "disc",
            Self::Ball => "ball",
        }
    }

    pub(super) const fn description(self) -> &'static str {
        match self {
            Self::Square => "the unit square",
            Self::Rectangle => "a rectangle twice as long as wide",
            Self::Disc => "a disc",
            Self::Ball => "a ball",
        }
    }

    /// Numbers for one point.
    pub const fn dimensions(self) -> usize {
        match self {
            Self::Ball => 3,
            _ => 2,
        }
    }

    /// A uniform point of the domain.
    pub fn place(self, u: &[f64]) -> [f64; 3] {
        match self {
            Self::Square => [u[0], u[1], 0.0],
            Self::Rectangle => [2.0 * u[0], u[1], 0.0],
            Self::Disc => {
                let (radius, angle) = (u[0].sqrt(), TAU * u[1]);
                [radius * libm::cos(angle), radius * libm::sin(angle), 0.0]
            }
            Self::Ball => {
                let (radius, angle, z) = (libm::cbrt(u[2]), TAU * u[1], 2.0 * u[0] - 1.0);
                let ring = (1.0 - z * z).max(0.0).sqrt();
                [radius * ring * libm::cos(angle), radius * ring * libm::sin(angle), radius * z]
            }
        }
    }
}

impl Wanted {
    /// The word.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Acute => "acute",
            Self::Obtuse => "obtuse",
        }
    }
}

/// The exact probability. Square and rectangle: Langford, "The probability that a random triangle is obtuse" (1969); right
/// triangles have none.
pub(super) fn probability(domain: TriangleDomain, wanted: Wanted) -> f64 {
    let obtuse = match domain {
        TriangleDomain::Square => 97.0 / 150.0 + PI / 40.0,
        TriangleDomain::Rectangle => 1199.0 / 1200.0 + 13.0 * PI / 128.0 - 0.75 * LN_2,
        TriangleDomain::Disc => 9.0 / 8.0 - 4.0 / (PI * PI),
        TriangleDomain::Ball => 37.0 / 70.0,
    };
    match wanted {
        Wanted::Acute => 1.0 - obtuse,
        Wanted::Obtuse => obtuse,
    }
}

/// Three corners of the numbers.
pub(super) fn corners(domain: TriangleDomain, u: &[f64]) -> [[f64; 3]; 3] {
    let d = domain.dimensions();
    std::array::from_fn(|corner| domain.place(&u[corner * d..(corner + 1) * d]))
}

/// Whether the triangle of some numbers counts. A right angle, which coarse numbers may give, counts as neither.
pub(super) fn is_wanted(domain: TriangleDomain, wanted: Wanted, u: &[f64]) -> bool {
    let p = corners(domain, u);
    let dot = |at: usize| -> f64 {
        let (a, b, c) = (p[at], p[(at + 1) % 3], p[(at + 2) % 3]);
        (0..3).map(|axis| (b[axis] - a[axis]) * (c[axis] - a[axis])).sum()
    };
    let least = dot(0).min(dot(1)).min(dot(2));
    match wanted {
        Wanted::Acute => least > 0.0,
        Wanted::Obtuse => least < 0.0,
    }
}
