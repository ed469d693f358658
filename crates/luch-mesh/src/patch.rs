//! Curves and patches of splines: Bezier, B-spline, rational (NURBS), trimmed; and their triangles.
//!
//! A [`Curve`] and a [`Surface`] are knots and weighted points. A [`PatchModel`] is a list of surfaces, some of them
//! trimmed by loops in their parameter plane. [`PatchModel::tessellate`] makes one mesh of all without cracks.
//!
//! ```
//! use luch_mesh::{measure, patch::{Fineness, PatchModel, shapes}};
//!
//! let model = PatchModel::from(shapes::torus(2.0, 0.5)?);
//! let mesh = model.tessellate(Fineness::Tolerance(0.001))?;
//! assert_eq!(measure::closedness(&mesh).to_string(), "closed (1 piece, genus 1)");
//! # Ok::<(), luch_mesh::patch::PatchError>(())
//! ```

mod bezier;
pub mod bpt;
pub mod car;
mod curve;
mod delaunay;
mod error;
mod fineness;
mod grid;
mod knots;
mod model;
pub mod shapes;
mod surface;
mod tessellate;
pub mod text;
mod trim;

pub use bezier::SurfacePoint;
pub use curve::{Curve, CurvePoint};
pub use error::PatchError;
pub use fineness::Fineness;
pub use knots::{Basis, Interval, Knots};
pub use model::{Patch, PatchModel};
pub use surface::{Direction, Side, Surface};
pub use trim::{Keeps, TrimLoop, Trimming};

pub(crate) use delaunay::region_triangles;

use glam::{DVec3, DVec4};

/// The highest degree.
pub const MAX_DEGREE: usize = 25;
/// The farthest a point may be from the origin along an axis, in metres.
pub const MAX_COORDINATE: f64 = 1e18;
/// The least weight; the largest is its reciprocal.
pub const MIN_WEIGHT: f64 = 1e-9;
/// The most triangles that a model may become.
pub const MAX_TRIANGLES: u64 = 1 << 26;

/// A point that pulls a curve or surface, the more the larger its weight is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ControlPoint {
    /// Its place.
    pub position: DVec3,
    /// Above zero; only ratios count.
    pub weight: f64,
}

impl ControlPoint {
    /// A point of weight 1.
    pub fn new(position: DVec3) -> Self {
        Self { position, weight: 1.0 }
    }

    /// A point with its weight.
    pub fn weighted(position: DVec3, weight: f64) -> Self {
        Self { position, weight }
    }

    fn homogeneous(self) -> DVec4 {
        (self.position * self.weight).extend(self.weight)
    }

    fn from_homogeneous(point: DVec4) -> Self {
        Self { position: point.truncate() / point.w, weight: point.w }
    }
}

/// Points in homogeneous form, if all are in range.
fn checked(points: &[ControlPoint]) -> Result<Vec<DVec4>, PatchError> {
    for (index, point) in points.iter().enumerate() {
        if !point.position.is_finite() || point.position.abs().max_element() > MAX_COORDINATE {
            return Err(PatchError::Point { index });
        }
        if !(MIN_WEIGHT..=1.0 / MIN_WEIGHT).contains(&point.weight) {
            return Err(PatchError::Weight { index, weight: point.weight });
        }
    }
    Ok(points.iter().map(|point| point.homogeneous()).collect())
}
