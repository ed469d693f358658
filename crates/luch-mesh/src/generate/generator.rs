//! All generators as one type.

use glam::{Vec2, Vec3};

use super::knot::TorusKnot;
use super::{KleinForm, Solid, fan};
use super::{
    capsule, cone, cuboid, disc, ellipsoid, icosphere, klein, knot, moebius, plane, polyhedron, prism,
};
use super::{rounded, sphere, teapot, torus};
use crate::{PolygonMesh, TriangleMesh};

/// A shape with its measures and resolution.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Generator {
    /// A sphere by longitude and latitude. u runs around from +x over −z, v from the south pole to the north pole.
    Sphere {
        /// Distance of the surface from the centre.
        radius: f32,
        /// Pieces around the axis.
        segments: u32,
        /// Pieces from pole to pole.
        rings: u32,
    },
    /// A sphere of nearly equal triangles: an icosahedron with corners at the poles of the y axis, each triangle cut into
    /// four again and again. u is the longitude from +x over −z (past 1 where a triangle crosses the seam), v the
    /// latitude.
    Icosphere {
        /// Distance of the surface from the centre.
        radius: f32,
        /// How often each triangle is cut into four.
        subdivisions: u32,
    },
    /// A box with hard edges. Every side carries the whole uv square, upright for one who looks at it from outside (the
    /// top with −z up, the bottom with +z up).
    Cuboid {
        /// Lengths of the sides.
        size: Vec3,
        /// Pieces of each side.
        divisions: [u32; 3],
    },
    /// A rectangle in the xz plane, facing +Y. u runs along +x, v along −z.
    Plane {
        /// Lengths along x and z.
        size: Vec2,
        /// Pieces along x and z.
        divisions: [u32; 2],
    },
    /// A cylinder from −height/2 to height/2: see the cone.
    Cylinder {
        /// Radius.
        radius: f32,
        /// Length along y.
        height: f32,
        /// Pieces around the axis.
        segments: u32,
        /// Pieces along the axis.
        stacks: u32,
        /// With a disc at both ends.
        capped: bool,
    },
    /// A cone or truncated cone from −height/2 to height/2, side smooth, rims hard. u runs around from +x over −z, v
    /// upward; each disc carries the inscribed circle of the uv square. With both radii zero there is no surface.
    Cone {
        /// Radius at the lower end.
        bottom_radius: f32,
        /// Radius at the upper end; zero for a point.
        top_radius: f32,
        /// Length along y.
        height: f32,
        /// Pieces around the axis.
        segments: u32,
        /// Pieces along the axis.
        stacks: u32,
        /// With a disc at every end that is not a point.
        capped: bool,
    },
    /// A ring around the y axis. u runs around the axis from +x over −z, v around the tube from its inner side over its
    /// lower.
    Torus {
        /// From the centre to the middle of the tube.
        major_radius: f32,
        /// Radius of the tube.
        minor_radius: f32,
        /// Pieces around the axis.
        segments: u32,
        /// Pieces around the tube.
        sides: u32,
    },
    /// A sphere stretched along the axes.
    Ellipsoid {
        /// Radii along x, y and z.
        radii: Vec3,
        /// Pieces around the axis.
        segments: u32,
        /// Pieces from pole to pole.
        rings: u32,
    },
    /// Something between an octahedron (exponents 2), an ellipsoid (1), a cylinder and a box (towards 0).
    Superellipsoid {
        /// Radii along x, y and z.
        radii: Vec3,
        /// Exponent of sections across the y axis, from 0.1 to 2.
        around: f32,
        /// Exponent of sections along the y axis, from 0.1 to 2.
        upright: f32,
        /// Pieces around the axis.
        segments: u32,
        /// Pieces from pole to pole.
        rings: u32,
    },
    /// A cylinder between two half balls.
    Capsule {
        /// Radius of all three.
        radius: f32,
        /// Length of the straight part along y; zero gives a sphere.
        height: f32,
        /// Pieces around the axis.
        segments: u32,
        /// Pieces of a half ball from its pole to the straight part.
        rings: u32,
        /// Pieces of the straight part.
        stacks: u32,
    },
    /// A disc in the xz plane, facing +Y, on the inscribed circle of the uv square.
    Disc {
        /// Radius.
        radius: f32,
        /// Pieces around the axis.
        segments: u32,
        /// Pieces from the rim to the centre.
        rings: u32,
    },
    /// A disc with a round hole.
    Annulus {
        /// Radius.
        outer_radius: f32,
        /// Radius of the hole.
        inner_radius: f32,
        /// Pieces around the axis.
        segments: u32,
        /// Pieces from rim to rim.
        rings: u32,
    },
    /// A pipe: a cylinder with a round hole from end to end, sides smooth, rims hard.
    Tube {
        /// Radius.
        outer_radius: f32,
        /// Radius of the hole.
        inner_radius: f32,
        /// Length along y.
        height: f32,
        /// Pieces around the axis.
        segments: u32,
        /// Pieces along the axis.
        stacks: u32,
    },
    /// A regular polygon in the xz plane, facing +Y, as one face; its first corner lies on +x.
    Polygon {
        /// How many corners.
        sides: u32,
        /// From the centre to the corners.
        radius: f32,
    },
    /// A body with flat sides over a regular polygon; both ends are one face each.
    Prism {
        /// How many sides.
        sides: u32,
        /// From the axis to the corners.
        radius: f32,
        /// Length along y.
        height: f32,
    },
    /// A pyramid over a regular polygon, or what is left of it when the tip is cut off.
    Pyramid {
        /// How many sides.
        sides: u32,
        /// From the axis to the corners of the base.
        radius: f32,
        /// From the axis to the corners of the upper end; zero for a point.
        top_radius: f32,
        /// Length along y.
        height: f32,
    },
    /// A box with rounded edges and corners, smooth everywhere, all of quads.
    RoundedCuboid {
        /// Lengths of the sides, roundings included.
        size: Vec3,
        /// Radius of the rounding; at most half the shortest side counts.
        radius: f32,
        /// Pieces of half a rounded edge, at most [`super::MAX_ROUNDING`].
        segments: u32,
    },
    /// A regular or half regular polyhedron with hard edges.
    Polyhedron {
        /// Which one.
        solid: Solid,
        /// From the centre to the corners.
        radius: f32,
    },
    /// A band around the y axis that turns over on its way; after an odd number of half turns it has one side only
    /// (Möbius' strip). Then no winding is consistent: it changes at +x.
    Moebius {
        /// From the axis to the middle of the band.
        radius: f32,
        /// Width of the band.
        width: f32,
        /// How often it turns over, at most [`super::MAX_HALF_TWISTS`].
        half_twists: u32,
        /// Pieces around the axis.
        segments: u32,
        /// Pieces across.
        stacks: u32,
    },
    /// A surface without border that has one side only. It crosses itself, and its winding changes at its first ring.
    KleinBottle {
        /// Which form.
        form: KleinForm,
        /// Height or diameter of the line it goes along.
        size: f32,
        /// Pieces along.
        segments: u32,
        /// Pieces around.
        sides: u32,
    },
    /// A tube along a knot that lies on a torus.
    TorusKnot {
        /// How often it goes around the y axis. A factor common to both numbers is taken out.
        around_axis: u32,
        /// How often it goes around the tube of the torus.
        around_tube: u32,
        /// From the centre to the middle of the torus' tube.
        major_radius: f32,
        /// Radius of the torus' tube.
        minor_radius: f32,
        /// Radius of the tube along the knot.
        tube_radius: f32,
        /// Pieces along the knot.
        segments: u32,
        /// Pieces around the tube.
        sides: u32,
    },
    /// A wire wound around the y axis, with flat ends.
    Spring {
        /// From the axis to the middle of the wire.
        radius: f32,
        /// Radius of the wire.
        tube_radius: f32,
        /// How far one turn rises along y.
        pitch: f32,
        /// How many turns, at most [`super::MAX_SPRING_TURNS`].
        turns: f32,
        /// Pieces of one turn.
        segments: u32,
        /// Pieces around the wire.
        sides: u32,
    },
    /// The Utah teapot. It stands on the xz plane, its spout along +x, as high as 3.15 times its size. It is open: lid,
    /// body, handle and spout are four pieces that do not meet.
    Teapot {
        /// Times the original numbers.
        size: f32,
        /// Pieces of each of its 32 patches along each side, from 2 to [`super::MAX_TEAPOT_DIVISIONS`].
        divisions: u32,
    },
}

impl Generator {
    /// Makes the mesh of triangles: every polygon becomes a fan about its first corner. Their number is that of
    /// [`Generator::triangle_count`]; look at it before memory is taken.
    pub fn mesh(&self) -> TriangleMesh {
        fan::fans(self.polygons())
    }

    /// Makes the mesh of polygons: quads wherever the surface is a grid, ends of prisms as one face. All faces are
    /// convex and none has a hole. There are at most [`Generator::triangle_count`].
    pub fn polygons(&self) -> PolygonMesh {
        match *self {
            Self::Sphere { radius, segments, rings } => sphere::sphere(radius, segments, rings),
            Self::Icosphere { radius, subdivisions } => icosphere::icosphere(radius, subdivisions),
            Self::Cuboid { size, divisions } => cuboid::cuboid(size, divisions),
            Self::Plane { size, divisions } => plane::plane(size, divisions),
            Self::Cylinder { radius, height, segments, stacks, capped } => {
                cone::cone(radius, radius, height, segments, stacks, capped)
            }
            Self::Cone { bottom_radius, top_radius, height, segments, stacks, capped } => {
                cone::cone(bottom_radius, top_radius, height, segments, stacks, capped)
            }
            Self::Torus { major_radius, minor_radius, segments, sides } => {
                torus::torus(major_radius, minor_radius, segments, sides)
            }
            Self::Ellipsoid { radii, segments, rings } => ellipsoid::ellipsoid(radii, segments, rings),
            Self::Superellipsoid { radii, around, upright, segments, rings } => {
                ellipsoid::superellipsoid(radii, around, upright, segments, rings)
            }
            Self::Capsule { radius, height, segments, rings, stacks } => {
                capsule::capsule(radius, height, segments, rings, stacks)
            }
            Self::Disc { radius, segments, rings } => disc::annulus(radius, 0.0, segments, rings),
            Self::Annulus { outer_radius, inner_radius, segments, rings } => {
                disc::annulus(outer_radius, inner_radius, segments, rings)
            }
            Self::Tube { outer_radius, inner_radius, height, segments, stacks } => {
                disc::tube(outer_radius, inner_radius, height, segments, stacks)
            }
            Self::Polygon { sides, radius } => prism::polygon(sides, radius),
            Self::Prism { sides, radius, height } => prism::prism(sides, radius, radius, height),
            Self::Pyramid { sides, radius, top_radius, height } => {
                prism::prism(sides, radius, top_radius, height)
            }
            Self::RoundedCuboid { size, radius, segments } => rounded::rounded_cuboid(size, radius, segments),
            Self::Polyhedron { solid, radius } => polyhedron::polyhedron(solid, radius),
            Self::Moebius { radius, width, half_twists, segments, stacks } => {
                moebius::moebius(radius, width, half_twists, segments, stacks)
            }
            Self::KleinBottle { form, size, segments, sides } => {
                klein::klein_bottle(form, size, segments, sides)
            }
            Self::TorusKnot {
                around_axis,
                around_tube,
                major_radius,
                minor_radius,
                tube_radius,
                segments,
                sides,
            } => {
                let knot = TorusKnot::new([around_axis, around_tube], major_radius, minor_radius);
                knot::torus_knot(knot, tube_radius, segments, sides)
            }
            Self::Spring { radius, tube_radius, pitch, turns, segments, sides } => {
                knot::spring(radius, tube_radius, pitch, turns, segments, sides)
            }
            Self::Teapot { size, divisions } => teapot::teapot(size, divisions),
        }
    }
}
