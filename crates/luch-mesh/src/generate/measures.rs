//! What is known about the true shapes: topology, area, volume.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3, Vec3};

use super::Generator;
use super::ellipsoid::exponents;
use super::knot::{MAX_SPRING_TURNS, TorusKnot};
use super::moebius::MAX_HALF_TWISTS;

impl Generator {
    /// True if the mesh encloses a body.
    pub fn is_closed(&self) -> bool {
        match *self {
            Self::Plane { .. }
            | Self::Disc { .. }
            | Self::Annulus { .. }
            | Self::Polygon { .. }
            | Self::Moebius { .. }
            | Self::KleinBottle { .. }
            | Self::Teapot { .. } => false,
            Self::Cylinder { capped, .. } | Self::Cone { capped, .. } => capped,
            _ => true,
        }
    }

    /// True if the surface has two sides, so that all faces can be wound alike.
    pub fn is_orientable(&self) -> bool {
        match *self {
            Self::KleinBottle { .. } => false,
            Self::Moebius { half_twists, .. } => half_twists.min(MAX_HALF_TWISTS) % 2 == 0,
            _ => true,
        }
    }

    /// True if the surface has a border.
    pub fn has_border(&self) -> bool {
        !self.is_closed() && !matches!(self, Self::KleinBottle { .. })
    }

    /// How many pieces the mesh has.
    pub fn component_count(&self) -> usize {
        match self {
            Self::Teapot { .. } => 4,
            _ => 1,
        }
    }

    /// Vertices − edges + faces.
    pub fn euler_characteristic(&self) -> i64 {
        match *self {
            Self::Torus { .. }
            | Self::Tube { .. }
            | Self::TorusKnot { .. }
            | Self::Annulus { .. }
            | Self::Moebius { .. }
            | Self::KleinBottle { .. }
            | Self::Cylinder { capped: false, .. } => 0,
            Self::Plane { .. } | Self::Disc { .. } | Self::Polygon { .. } => 1,
            // An open cone is a disc, an open frustum a ring.
            Self::Cone { bottom_radius, top_radius, capped: false, .. } => {
                i64::from(bottom_radius == 0.0 || top_radius == 0.0)
            }
            // The teapot is two bowls, of body and lid, and two open tubes.
            _ => 2,
        }
    }

    /// The area of the true shape, which the mesh approaches; exact to about ten digits where it is an integral
    /// without closed form, `None` where nobody knows better than the mesh.
    pub fn area_of_shape(&self) -> Option<f64> {
        Some(match *self {
            Self::Sphere { radius, .. } | Self::Icosphere { radius, .. } => 4.0 * PI * squared(radius),
            Self::Cuboid { size, .. } => cuboid_area(size.as_dvec3()),
            Self::Plane { size, .. } => size.as_dvec2().element_product(),
            Self::Cylinder { radius, height, capped, .. } => frustum_area(radius, radius, height, capped),
            Self::Cone { bottom_radius, top_radius, height, capped, .. } => {
                frustum_area(bottom_radius, top_radius, height, capped)
            }
            Self::Torus { major_radius, minor_radius, .. } => {
                TAU * TAU * f64::from(major_radius) * f64::from(minor_radius)
            }
            Self::Ellipsoid { radii, .. } => ellipsoid_area(radii),
            Self::Capsule { radius, height, .. } => {
                TAU * f64::from(radius) * (2.0 * f64::from(radius) + f64::from(height))
            }
            Self::Disc { radius, .. } => PI * squared(radius),
            Self::Annulus { outer_radius, inner_radius, .. } => {
                PI * (squared(outer_radius) - squared(inner_radius))
            }
            Self::Tube { outer_radius, inner_radius, height, .. } => {
                let (outer, inner) = (f64::from(outer_radius), f64::from(inner_radius));
                TAU * (outer + inner) * (f64::from(height) + outer - inner)
            }
            Self::Polygon { sides, radius } => polygon_area(sides, radius),
            Self::Prism { sides, radius, height } => pyramid_area(sides, radius, radius, height),
            Self::Pyramid { sides, radius, top_radius, height } => {
                pyramid_area(sides, radius, top_radius, height)
            }
            Self::RoundedCuboid { size, radius, .. } => {
                let Rounding { inner, radius } = Rounding::of(size, radius);
                cuboid_area(inner) + TAU * radius * inner.element_sum() + 4.0 * PI * radius * radius
            }
            Self::Polyhedron { solid, radius } => {
                let measures = solid.measures();
                let edge = f64::from(radius) / measures.radius;
                measures.area * edge * edge
            }
            Self::Moebius { radius, width, half_twists, .. } => moebius_area(radius, width, half_twists),
            Self::TorusKnot { around_axis, around_tube, major_radius, minor_radius, tube_radius, .. } => {
                let knot = TorusKnot::new([around_axis, around_tube], major_radius, minor_radius);
                TAU * f64::from(tube_radius) * knot.length()
            }
            Self::Spring { radius, tube_radius, pitch, turns, .. } => {
                TAU * f64::from(tube_radius) * (spring_length(radius, pitch, turns) + f64::from(tube_radius))
            }
            Self::Superellipsoid { .. } | Self::KleinBottle { .. } | Self::Teapot { .. } => return None,
        })
    }

    /// The volume of the true shape, which the mesh approaches; `None` if it is open. Tubes are taken to be so thin
    /// that they do not meet themselves.
    pub fn volume_of_shape(&self) -> Option<f64> {
        let volume = match *self {
            Self::Sphere { radius, .. } | Self::Icosphere { radius, .. } => ball(radius),
            Self::Cuboid { size, .. } => size.as_dvec3().element_product(),
            Self::Cylinder { radius, height, .. } => PI * squared(radius) * f64::from(height),
            Self::Cone { bottom_radius, top_radius, height, .. } => {
                PI * f64::from(height) * mean_square(bottom_radius, top_radius)
            }
            Self::Torus { major_radius, minor_radius, .. } => {
                TAU * PI * f64::from(major_radius) * squared(minor_radius)
            }
            Self::Ellipsoid { radii, .. } => 4.0 / 3.0 * PI * radii.as_dvec3().element_product(),
            Self::Superellipsoid { radii, around, upright, .. } => {
                // Jaklič, Leonardis, Solina 2000, "Segmentation and Recovery of Superquadrics", 2.4.
                let [around, upright] = exponents(around, upright);
                let betas = beta(upright / 2.0 + 1.0, upright) * beta(around / 2.0, around / 2.0);
                2.0 * radii.as_dvec3().element_product() * around * upright * betas
            }
            Self::Capsule { radius, height, .. } => ball(radius) + PI * squared(radius) * f64::from(height),
            Self::Tube { outer_radius, inner_radius, height, .. } => {
                PI * (squared(outer_radius) - squared(inner_radius)) * f64::from(height)
            }
            Self::Prism { sides, radius, height } => polygon_area(sides, radius) * f64::from(height),
            Self::Pyramid { sides, radius, top_radius, height } => {
                polygon_area(sides, 1.0) * f64::from(height) * mean_square(radius, top_radius)
            }
            Self::RoundedCuboid { size, radius, .. } => {
                let Rounding { inner, radius } = Rounding::of(size, radius);
                inner.element_product()
                    + cuboid_area(inner) * radius
                    + PI * radius * radius * inner.element_sum()
                    + 4.0 / 3.0 * PI * radius * radius * radius
            }
            Self::Polyhedron { solid, radius } => {
                let measures = solid.measures();
                let edge = f64::from(radius) / measures.radius;
                measures.volume * edge * edge * edge
            }
            Self::TorusKnot { around_axis, around_tube, major_radius, minor_radius, tube_radius, .. } => {
                let knot = TorusKnot::new([around_axis, around_tube], major_radius, minor_radius);
                PI * squared(tube_radius) * knot.length()
            }
            Self::Spring { radius, tube_radius, pitch, turns, .. } => {
                PI * squared(tube_radius) * spring_length(radius, pitch, turns)
            }
            Self::Plane { .. }
            | Self::Disc { .. }
            | Self::Annulus { .. }
            | Self::Polygon { .. }
            | Self::Moebius { .. }
            | Self::KleinBottle { .. }
            | Self::Teapot { .. } => return None,
        };
        self.is_closed().then_some(volume)
    }
}

fn squared(length: f32) -> f64 {
    f64::from(length) * f64::from(length)
}

fn ball(radius: f32) -> f64 {
    4.0 / 3.0 * PI * squared(radius) * f64::from(radius)
}

/// The mean of the square of a length that changes evenly.
fn mean_square(one: f32, other: f32) -> f64 {
    (squared(one) + f64::from(one) * f64::from(other) + squared(other)) / 3.0
}

fn cuboid_area(DVec3 { x, y, z }: DVec3) -> f64 {
    2.0 * (x * y + y * z + z * x)
}

fn frustum_area(bottom: f32, top: f32, height: f32, capped: bool) -> f64 {
    let slant = (squared(height) + squared(bottom - top)).sqrt();
    let discs = if capped { PI * (squared(bottom) + squared(top)) } else { 0.0 };
    PI * (f64::from(bottom) + f64::from(top)) * slant + discs
}

fn polygon_area(sides: u32, radius: f32) -> f64 {
    let sides = f64::from(sides.clamp(3, super::MAX_DIVISIONS));
    sides / 2.0 * squared(radius) * libm::sin(TAU / sides)
}

fn pyramid_area(sides: u32, bottom: f32, top: f32, height: f32) -> f64 {
    let half_angle = PI / f64::from(sides.clamp(3, super::MAX_DIVISIONS));
    let narrowing = f64::from(bottom - top) * libm::cos(half_angle);
    let slant = DVec2::new(f64::from(height), narrowing).length();
    let edges = (f64::from(bottom) + f64::from(top)) * libm::sin(half_angle);
    PI / half_angle * edges * slant + polygon_area(sides, bottom) + polygon_area(sides, top)
}

fn spring_length(radius: f32, pitch: f32, turns: f32) -> f64 {
    f64::from(turns.clamp(0.0, MAX_SPRING_TURNS))
        * DVec2::new(TAU * f64::from(radius), f64::from(pitch)).length()
}

/// A rounded box is the inner box grown by the radius (Steiner's formula gives its measures).
struct Rounding {
    inner: DVec3,
    radius: f64,
}

impl Rounding {
    fn of(size: Vec3, radius: f32) -> Self {
        let size = size.as_dvec3();
        let radius = f64::from(radius).min(size.min_element() / 2.0);
        Self { inner: size - 2.0 * radius, radius }
    }
}

/// Euler's beta function.
fn beta(one: f64, other: f64) -> f64 {
    libm::exp(libm::lgamma(one) + libm::lgamma(other) - libm::lgamma(one + other))
}

/// ∫∫ over height and longitude of the length of the normal that the stretched sphere has.
fn ellipsoid_area(radii: Vec3) -> f64 {
    let DVec3 { x, y, z } = radii.as_dvec3();
    integral([-1.0, 1.0], |height| {
        integral([0.0, PI / 2.0], |longitude| {
            let flat = (1.0 - height * height).max(0.0);
            let (cos, sin) = (libm::cos(longitude), libm::sin(longitude));
            let across = squares(y * z * cos, y * x * sin) * flat;
            (across + x * z * height * (x * z * height)).sqrt()
        })
    }) * 4.0
}

/// The derivatives around and across are square to each other; the one across has length 1.
fn moebius_area(radius: f32, width: f32, half_twists: u32) -> f64 {
    let half_twists = f64::from(half_twists.min(MAX_HALF_TWISTS));
    let half_width = f64::from(width) / 2.0;
    // All tilts come alike, whatever the number of half twists; without any there is but one.
    integral([0.0, PI], |angle| {
        let tilt = if half_twists == 0.0 { 1.0 } else { libm::cos(angle) };
        integral([-half_width, half_width], |aside| {
            squares(f64::from(radius) + aside * tilt, aside * half_twists / 2.0).sqrt()
        })
    }) * 2.0
}

fn squares(one: f64, other: f64) -> f64 {
    one * one + other * other
}

/// Simpson's rule with 512 pieces.
fn integral([from, to]: [f64; 2], function: impl Fn(f64) -> f64) -> f64 {
    let pieces = 512;
    let width = (to - from) / f64::from(pieces);
    let weight = |k: i32| if k == 0 || k == pieces { 1.0 } else { 2.0 + 2.0 * f64::from(k % 2) };
    let sum: f64 = (0..=pieces).map(|k| weight(k) * function(from + width * f64::from(k))).sum();
    sum * width / 3.0
}
