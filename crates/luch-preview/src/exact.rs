//! Shapes that are no triangles: every sample's own line of sight is cut with them, so their outline is that of the ray tracer.

use crate::outline::Outline;
use crate::view::Sight;
use glam::{DVec3, Vec2, Vec3};
use luch_bvh::Aabb;

/// A shape known by its equation, in its own coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Exact {
    /// About the origin.
    Sphere { radius: f64 },
    /// In the plane y = 0 about the origin.
    Disc { radius: f64 },
    /// The plane y = 0.
    Plane,
}

/// Where a line of sight meets a shape.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Meeting {
    pub(crate) depth: f64,
    /// Whether the outside is seen.
    pub(crate) is_front: bool,
}

impl Exact {
    /// A box around the shape; empty if there is no such shape.
    pub(crate) fn bounds(&self) -> Aabb {
        let around = |corner: Vec3| Aabb { min: -corner, max: corner };
        match *self {
            _ if !self.is_sound() => Aabb::empty(),
            Self::Sphere { radius } => around(Vec3::splat(radius as f32)),
            Self::Disc { radius } => around(Vec3::new(radius as f32, 0.0, radius as f32)),
            Self::Plane => Aabb::empty(),
        }
    }

    fn is_sound(&self) -> bool {
        match *self {
            Self::Sphere { radius } | Self::Disc { radius } => radius > 0.0 && radius.is_finite(),
            Self::Plane => true,
        }
    }

    /// Where the line meets the shape at depths that are not negative, nearest first.
    pub(crate) fn meetings(&self, sight: &Sight) -> impl Iterator<Item = Meeting> {
        let (origin, direction) = (sight.origin, sight.direction);
        let both = match *self {
            _ if !self.is_sound() => [None; 2],
            Self::Sphere { radius } => {
                // About the point of the line nearest to the centre, so that a small sphere far away loses no digits.
                let a = direction.length_squared();
                let middle = -origin.dot(direction) / a;
                let squared = (radius * radius - (origin + direction * middle).length_squared()) / a;
                if squared >= 0.0 {
                    let half = squared.sqrt();
                    let at = |depth, is_front| Some(Meeting { depth, is_front });
                    [at(middle - half, true), at(middle + half, false)]
                } else {
                    [None; 2]
                }
            }
            Self::Disc { .. } | Self::Plane => {
                let depth = -origin.y / direction.y;
                let point = sight.at(depth);
                let is_there = match *self {
                    Self::Disc { radius } => point.x * point.x + point.z * point.z <= radius * radius,
                    _ => true,
                };
                [is_there.then_some(Meeting { depth, is_front: direction.y < 0.0 }), None]
            }
        };
        let limit = f64::from(f32::MAX);
        both.into_iter().flatten().filter(move |meeting| meeting.depth >= 0.0 && meeting.depth <= limit)
    }

    /// The outward normal at a point of the shape, of any length.
    pub(crate) fn normal(&self, point: DVec3) -> DVec3 {
        match self {
            Self::Sphere { .. } => point,
            Self::Disc { .. } | Self::Plane => DVec3::Y,
        }
    }

    /// Texture coordinates at a point of the shape: the renderer's.
    pub(crate) fn uv(&self, point: DVec3) -> Vec2 {
        use std::f64::consts::PI;
        match *self {
            Self::Sphere { radius } => {
                // u runs eastward from −Z, v from pole to pole.
                let p = point / radius;
                let u = 0.5 + libm::atan2(p.x, p.z) / (2.0 * PI);
                let v = 1.0 - libm::acos(p.y.clamp(-1.0, 1.0)) / PI;
                Vec2::new(u as f32, v as f32)
            }
            Self::Disc { radius } => {
                Vec2::new((0.5 + point.x / (2.0 * radius)) as f32, (0.5 - point.z / (2.0 * radius)) as f32)
            }
            Self::Plane => Vec2::new(point.x as f32, -point.z as f32),
        }
    }

    /// Meridians and parallels of a sphere, rim and spokes of a disc; a plane has no edges.
    pub(crate) fn outline(&self) -> Outline {
        /// Meridians, and spokes.
        const SECTORS: u32 = 24;
        /// Parallels are as far apart as meridians at the equator.
        const PARALLELS: u32 = 11;
        /// Pieces of a full circle: they stay within 2⁻¹³ of the radius.
        const PIECES: u32 = 240;
        let mut outline = Outline::default();
        if !self.is_sound() {
            return outline;
        }
        let angle = |part: u32, of: u32| std::f64::consts::TAU * f64::from(part % of) / f64::from(of);
        let on_circle = |part: u32, of: u32| {
            let angle = angle(part, of);
            DVec3::new(libm::cos(angle), 0.0, libm::sin(angle))
        };
        match *self {
            Self::Sphere { radius } => {
                for parallel in 1..=PARALLELS {
                    let latitude = angle(parallel, SECTORS);
                    let (height, width) = (libm::cos(latitude), libm::sin(latitude));
                    let ring = (0..=PIECES).map(|piece| on_circle(piece, PIECES) * width + DVec3::Y * height);
                    outline.add_curve(ring.map(|point| point * radius), false);
                }
                for meridian in 0..SECTORS {
                    let outward = on_circle(meridian, SECTORS);
                    let arc = (0..=PIECES / 2).map(|piece| {
                        let latitude = angle(piece, PIECES);
                        outward * libm::sin(latitude) + DVec3::Y * libm::cos(latitude)
                    });
                    outline.add_curve(arc.map(|point| point * radius), false);
                }
            }
            Self::Disc { radius } => {
                outline.add_curve((0..=PIECES).map(|piece| on_circle(piece, PIECES) * radius), true);
                for spoke in 0..SECTORS {
                    outline.add_curve([DVec3::ZERO, on_circle(spoke, SECTORS) * radius].into_iter(), false);
                }
            }
            Self::Plane => {}
        }
        outline
    }
}
