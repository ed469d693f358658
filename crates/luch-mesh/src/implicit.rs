//! Surfaces where a function of space is zero.
//!
//! A [`Field`] gives values, gradients and proven intervals in bulk. It may be a [`Solid`] (bodies and formulas, put together as one
//! calculation), a [`Grid`] of samples, the distance of a mesh ([`MeshDistance`]) or a function ([`FunctionField`]). Negative is inside.
//!
//! [`surface`] makes a mesh of any field by marching cubes or dual contouring; [`marching_cubes`] is the fast way from samples. Both
//! always give manifolds: in a thousand random fields no edge has three faces and no vertex two fans.
//!
//! ```
//! use luch_formula::Formula;
//! use luch_mesh::implicit::{Method, Region, Sampling, Solid, surface};
//! use luch_mesh::measure;
//!
//! let heart = Solid::Formula(Formula::new("(x^2 + 9/4*y^2 + z^2 - 1)^3 - x^2*z^3 - 9/80*y^2*z^3"));
//! let sampling = Sampling { region: Region::cube(1.5), resolution: 48, closed: true };
//! let mesh = surface(&heart.field()?, &sampling, Method::MarchingCubes)?;
//! assert_eq!(measure::closedness(&mesh).to_string(), "closed (1 piece, genus 0)");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod cases;
mod cell;
mod composite;
mod crossing;
mod dual_contouring;
mod error;
mod field;
mod grid;
mod interior;
mod marching_cubes;
mod mesh_distance;
mod quadric;
mod roots;
mod sampling;
mod signs;
mod solid;
mod surface;

pub use composite::{Composite, Operation};
pub use error::ImplicitError;
pub use field::{Field, FunctionField, Interval, PointList, Points, Region};
pub use grid::Grid;
pub use marching_cubes::marching_cubes;
pub use mesh_distance::MeshDistance;
pub use sampling::{Sampling, sample};
pub use solid::{Ball, Solid, SolidError, SolidField};
pub use surface::{Method, surface};

/// The most samples a grid may hold: 1 GiB of them.
pub const MOST_SAMPLES: usize = 1 << 28;
/// The most vertices a surface may have.
pub const MOST_VERTICES: usize = 1 << 26;
