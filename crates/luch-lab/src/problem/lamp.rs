//! Soft shadows: a horizontal lamp, things between it and a point on the ground.

use super::polygon::{area, form_factor, intersection, lens};
use std::f64::consts::{PI, TAU};

/// A horizontal lamp above a point that faces up, and what stands between.
#[derive(Clone, Debug, PartialEq)]
pub struct Lamp {
    /// Its form; its middle is above the origin.
    pub shape: LampShape,
    /// Its height above the point.
    pub height: f64,
    /// Where the point is, on the ground.
    pub point: [f64; 2],
    /// What stands between; at most 8 count.
    pub blockers: Vec<Blocker>,
}

/// The form of a lamp.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LampShape {
    /// A rectangle with these full sides.
    Rectangle([f64; 2]),
    /// A disc with this radius.
    Disc(f64),
}

/// Something opaque and flat, at a height between ground and lamp.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Blocker {
    /// All x below an edge.
    HalfPlane {
        /// Its height.
        height: f64,
        /// Where it ends.
        edge: f64,
    },
    /// A rectangle.
    Rectangle {
        /// Its height.
        height: f64,
        /// Its middle.
        middle: [f64; 2],
        /// Its full sides.
        sides: [f64; 2],
    },
    /// A disc, for disc lamps alone.
    Disc {
        /// Its height.
        height: f64,
        /// Its middle.
        middle: [f64; 2],
        /// Its radius.
        radius: f64,
    },
}

/// What is asked of a lamp.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// The share of its area that is seen.
    VisibleFraction,
    /// The form factor of what is seen: irradiance over π times radiance. For rectangles.
    FormFactor,
}

impl Quantity {
    /// Its name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::VisibleFraction => "visible fraction",
            Self::FormFactor => "form factor",
        }
    }
}

/// Far enough to stand for no end.
const FAR: f64 = 1e6;

impl Lamp {
    /// A lamp of 2 × 1 at height 3 over a half-plane at height 1, seen from (p, 0): the lecture's half-covered lamp at p = 0.
    pub fn half_covered(p: f64) -> Self {
        Self {
            shape: LampShape::Rectangle([2.0, 1.0]),
            height: 3.0,
            point: [p, 0.0],
            blockers: vec![Blocker::HalfPlane { height: 1.0, edge: 0.0 }],
        }
    }

    /// A lamp of 2 × 2 at height 4 over a square of ½ at height 2.
    pub fn over_rectangle(point: [f64; 2]) -> Self {
        let blocker = Blocker::Rectangle { height: 2.0, middle: [0.0; 2], sides: [0.5; 2] };
        Self { shape: LampShape::Rectangle([2.0; 2]), height: 4.0, point, blockers: vec![blocker] }
    }

    /// A disc lamp of radius 1 that is seen left of the edge x = s.
    pub fn disc_with_edge(s: f64) -> Self {
        // Seen from below its middle mirrored, the half-plane hides x < −s, which is as much as x > s.
        let blocker = Blocker::HalfPlane { height: 1.0, edge: -0.5 * s };
        Self { shape: LampShape::Disc(1.0), height: 2.0, point: [0.0; 2], blockers: vec![blocker] }
    }

    /// A disc lamp of radius 1 at height 4 over a disc of 0.4 at height 2, seen from (p, 0).
    pub fn over_disc(p: f64) -> Self {
        let blocker = Blocker::Disc { height: 2.0, middle: [0.0; 2], radius: 0.4 };
        Self { shape: LampShape::Disc(1.0), height: 4.0, point: [p, 0.0], blockers: vec![blocker] }
    }

    /// Its area.
    pub fn area(&self) -> f64 {
        match self.shape {
            LampShape::Rectangle([w, l]) => w * l,
            LampShape::Disc(radius) => PI * radius * radius,
        }
    }

    /// A place of the blocker's plane, thrown onto the plane of the lamp.
    fn thrown(&self, place: [f64; 2], height: f64) -> [f64; 2] {
        let k = self.height / height;
        [0, 1].map(|axis| self.point[axis] + (place[axis] - self.point[axis]) * k)
    }

    /// The lamp's outline; of a disc, a polygon of 128 corners for pictures.
    pub fn outline(&self) -> Vec<[f64; 2]> {
        match self.shape {
            LampShape::Rectangle([w, l]) => rectangle([0.0; 2], [w, l]),
            LampShape::Disc(radius) => circle([0.0; 2], radius),
        }
    }

    /// The shadow of each blocker in the plane of the lamp.
    pub fn shadows(&self) -> Vec<Vec<[f64; 2]>> {
        let shadow = |blocker: &Blocker| match *blocker {
            Blocker::HalfPlane { height, edge } => {
                let x = self.thrown([edge, 0.0], height)[0];
                vec![[-FAR, -FAR], [x, -FAR], [x, FAR], [-FAR, FAR]]
            }
            Blocker::Rectangle { height, middle, sides } => {
                rectangle(middle, sides).into_iter().map(|corner| self.thrown(corner, height)).collect()
            }
            Blocker::Disc { height, middle, radius } => {
                circle(self.thrown(middle, height), radius * self.height / height)
            }
        };
        self.blockers.iter().take(8).map(shadow).collect()
    }

    /// The exact answer. Rectangles: inclusion and exclusion over the shadows, each a cut polygon. Discs: half-planes and discs as
    /// single blockers.
    pub fn exact(&self, quantity: Quantity) -> f64 {
        if let LampShape::Disc(radius) = self.shape {
            return self.exact_disc(radius);
        }
        let lamp = self.outline();
        let measure = |polygon: &[[f64; 2]]| match quantity {
            Quantity::VisibleFraction => area(polygon) / self.area(),
            Quantity::FormFactor => form_factor(polygon, self.height, self.point),
        };
        let shadows = self.shadows();
        // Every set of shadows: what all of them hide together, added or taken away by the parity of their number.
        let sets = (0..1u32 << shadows.len()).map(|set| {
            let members = shadows.iter().enumerate().filter(|(at, _)| set >> at & 1 == 1);
            let shared = members.fold(lamp.clone(), |shared, (_, shadow)| intersection(&shared, shadow));
            let sign = if set.count_ones() % 2 == 0 { 1.0 } else { -1.0 };
            sign * measure(&shared)
        });
        sets.sum()
    }

    fn exact_disc(&self, radius: f64) -> f64 {
        let hidden = match self.blockers.first() {
            None => 0.0,
            Some(&Blocker::HalfPlane { height, edge }) => {
                let s = (self.thrown([edge, 0.0], height)[0] / radius).clamp(-1.0, 1.0);
                0.5 + (s * (1.0 - s * s).sqrt() + libm::asin(s)) / PI
            }
            Some(&Blocker::Disc { height, middle, radius: own }) => {
                let [x, y] = self.thrown(middle, height);
                lens(radius, own * self.height / height, (x * x + y * y).sqrt()) / self.area()
            }
            // A rectangle in a disc: corners of 128 are not exact, so the disc is cut finely.
            Some(_) => {
                let shadow = &self.shadows()[0];
                let fine: Vec<[f64; 2]> = (0..1 << 16)
                    .map(|i| TAU * f64::from(i) / 65536.0)
                    .map(|angle| [radius * libm::cos(angle), radius * libm::sin(angle)])
                    .collect();
                area(&intersection(&fine, shadow)) / area(&fine)
            }
        };
        1.0 - hidden
    }

    /// A uniform place of the lamp.
    pub fn place(&self, u: [f64; 2]) -> [f64; 2] {
        match self.shape {
            LampShape::Rectangle([w, l]) => [(u[0] - 0.5) * w, (u[1] - 0.5) * l],
            LampShape::Disc(radius) => {
                let (r, angle) = (radius * u[0].sqrt(), TAU * u[1]);
                [r * libm::cos(angle), r * libm::sin(angle)]
            }
        }
    }

    /// Whether nothing stands between the point and a place of the lamp.
    pub fn is_seen(&self, place: [f64; 2]) -> bool {
        !self.blockers.iter().take(8).any(|blocker| {
            let crossing = |height: f64| {
                let t = height / self.height;
                [0, 1].map(|axis| self.point[axis] + t * (place[axis] - self.point[axis]))
            };
            match *blocker {
                Blocker::HalfPlane { height, edge } => crossing(height)[0] < edge,
                Blocker::Rectangle { height, middle, sides } => {
                    let at = crossing(height);
                    (0..2).all(|axis| (at[axis] - middle[axis]).abs() < 0.5 * sides[axis])
                }
                Blocker::Disc { height, middle, radius } => {
                    let at = crossing(height);
                    let (x, y) = (at[0] - middle[0], at[1] - middle[1]);
                    x * x + y * y < radius * radius
                }
            }
        })
    }

    pub(super) fn sample(&self, quantity: Quantity, u: [f64; 2]) -> f64 {
        let place = self.place(u);
        if !self.is_seen(place) {
            return 0.0;
        }
        match quantity {
            Quantity::VisibleFraction => 1.0,
            Quantity::FormFactor => {
                // Both cosines are height over distance.
                let (x, y) = (place[0] - self.point[0], place[1] - self.point[1]);
                let square = x * x + y * y + self.height * self.height;
                self.height * self.height / (PI * square * square) * self.area()
            }
        }
    }

    /// The outline of what is seen of a rectangle behind one half-plane; for pictures.
    pub(super) fn hidden(&self) -> Vec<Vec<[f64; 2]>> {
        let lamp = self.outline();
        self.shadows()
            .iter()
            .map(|shadow| intersection(&lamp, shadow))
            .filter(|part| area(part) > 0.0)
            .collect()
    }
}

fn rectangle(middle: [f64; 2], sides: [f64; 2]) -> Vec<[f64; 2]> {
    let (w, l) = (0.5 * sides[0], 0.5 * sides[1]);
    [[-w, -l], [w, -l], [w, l], [-w, l]].map(|[x, y]| [middle[0] + x, middle[1] + y]).to_vec()
}

fn circle(middle: [f64; 2], radius: f64) -> Vec<[f64; 2]> {
    (0..128)
        .map(|i| TAU * f64::from(i) / 128.0)
        .map(|angle| [middle[0] + radius * libm::cos(angle), middle[1] + radius * libm::sin(angle)])
        .collect()
}
