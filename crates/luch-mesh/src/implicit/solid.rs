//! Solids as plain data: simple bodies, formulas, and how they are put together.

mod bodies;
mod expression;
mod field;

use glam::{DAffine3, DVec3};
use luch_formula::{Expression, Formula, FormulaError, TapeError};
use serde::{Deserialize, Serialize};

pub use field::SolidField;

/// A solid: a function of space that is negative inside.
///
/// Bodies give exact distances; unions of them are exact outside, the rest are bounds or good guesses. Lengths in metres. The whole
/// tree becomes one calculation: [`Solid::expression`], and with it intervals, gradients and bulk evaluation: [`Solid::field`].
///
/// ```
/// use luch_mesh::implicit::{Method, Region, Sampling, Solid, surface};
/// use luch_mesh::measure;
///
/// let ball = Solid::Sphere { radius: 1.0 };
/// let hole = Solid::Cylinder { radius: 0.5, height: 3.0 };
/// let bead = Solid::Difference { from: Box::new(ball), parts: vec![hole], blend: 0.0 };
/// let sampling = Sampling { region: Region::cube(1.25), resolution: 40, closed: true };
/// let mesh = surface(&bead.field()?, &sampling, Method::DualContouring)?;
/// assert_eq!(measure::closedness(&mesh).to_string(), "closed (1 piece, genus 1)");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Solid {
    /// A ball about the origin.
    Sphere {
        /// Its radius.
        radius: f64,
    },
    /// A box about the origin.
    Cuboid {
        /// The lengths of its sides.
        size: DVec3,
        /// The radius of its edges; 0 for sharp ones. At most half the shortest side counts.
        #[serde(default)]
        rounding: f64,
    },
    /// A cylinder along the y axis, its middle at the origin.
    Cylinder {
        /// Its radius.
        radius: f64,
        /// Its length.
        height: f64,
    },
    /// All points at most a radius away from a line along the y axis, its middle at the origin.
    Capsule {
        /// The radius.
        radius: f64,
        /// The length of the line.
        height: f64,
    },
    /// A ring around the y axis.
    Torus {
        /// From the origin to the middle of the tube.
        major_radius: f64,
        /// Of the tube.
        minor_radius: f64,
    },
    /// All points behind a plane.
    HalfSpace {
        /// Points out of the solid; of any length but zero.
        normal: DVec3,
        /// From the origin to the plane, along the normal.
        distance: f64,
    },
    /// A wall along the gyroid sin x cos y + sin y cos z + sin z cos x = 0 (Schoen, 1970).
    Gyroid {
        /// After which length it repeats.
        period: f64,
        /// Of the wall, to the first order; with 0 one of the two rooms that it parts is filled.
        thickness: f64,
    },
    /// Balls that flow together: where the sum of (1 − d²/r²)³ over all balls with d < r is above a half (Wyvill et al., "Data
    /// structure for soft objects", 1986).
    Metaballs {
        /// The balls.
        balls: Vec<Ball>,
    },
    /// Where a formula of `x`, `y` and `z` is negative, or the left side of an equation is less than the right.
    Formula(Formula),
    /// All points in one of the parts.
    Union {
        /// The parts.
        parts: Vec<Solid>,
        /// Where their functions differ by less than this the seam is rounded; 0 for none.
        #[serde(default)]
        blend: f64,
    },
    /// All points that are in every part.
    Intersection {
        /// The parts.
        parts: Vec<Solid>,
        /// As of a union.
        #[serde(default)]
        blend: f64,
    },
    /// A solid without the points of others.
    Difference {
        /// The solid.
        from: Box<Solid>,
        /// What is taken away.
        parts: Vec<Solid>,
        /// As of a union.
        #[serde(default)]
        blend: f64,
    },
    /// A solid grown by a length, round at its edges; shrunk by a negative one.
    Offset {
        /// The solid.
        solid: Box<Solid>,
        /// How much it grows.
        distance: f64,
    },
    /// A wall along the surface of a solid, half of it on either side.
    Shell {
        /// The solid.
        solid: Box<Solid>,
        /// Of the wall.
        thickness: f64,
    },
    /// A solid moved, turned, scaled or sheared.
    Place {
        /// The solid.
        solid: Box<Solid>,
        /// Where its points go.
        map: DAffine3,
    },
    /// A solid twisted about the y axis.
    Twist {
        /// The solid.
        solid: Box<Solid>,
        /// Radians a metre of height.
        turn: f64,
    },
    /// A solid bent about the z axis: the x axis becomes a circle through the origin about a centre on the y axis.
    Bend {
        /// The solid.
        solid: Box<Solid>,
        /// One over the radius of the circle, per metre; positive upward.
        curvature: f64,
    },
    /// A solid again and again.
    Repeat {
        /// The solid; what reaches beyond half a period from the origin is lost.
        solid: Box<Solid>,
        /// After which lengths along each axis; not along an axis with 0.
        period: DVec3,
    },
    /// The part of a solid in front of a plane through the origin, and its mirror image behind.
    Mirror {
        /// The solid.
        solid: Box<Solid>,
        /// Across the plane.
        normal: DVec3,
    },
}

/// One of several balls that flow together.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Ball {
    /// The middle.
    pub center: DVec3,
    /// Where its influence ends; alone it is a ball of 0.45 times this.
    pub radius: f64,
}

/// Why a solid has no function.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SolidError {
    /// A formula that cannot be understood.
    #[error("{0}")]
    Formula(#[from] FormulaError),
    /// A calculation that cannot be compiled.
    #[error("{0}")]
    Tape(#[from] TapeError),
    /// A number that makes no sense.
    #[error("{name} is {value}, it must be {accepted}")]
    Number {
        /// What it is.
        name: &'static str,
        /// What it was.
        value: f64,
        /// What would be right.
        accepted: &'static str,
    },
    /// A map or direction that leads nowhere.
    #[error("{0}")]
    Flat(&'static str),
    /// Solids within solids within solids.
    #[error("solids stand more than {most} deep within each other")]
    TooDeep {
        /// The most that is accepted.
        most: usize,
    },
    /// More to compute than anyone would wait for.
    #[error("the solid takes more than {most} operations a point")]
    TooLong {
        /// The most that is accepted.
        most: usize,
    },
}

impl Solid {
    /// The function as an expression of `x`, `y` and `z`.
    pub fn expression(&self) -> Result<Expression, SolidError> {
        expression::expression(self, 0)
    }

    /// The function compiled.
    pub fn field(&self) -> Result<SolidField, SolidError> {
        SolidField::new(&self.expression()?)
    }
}
