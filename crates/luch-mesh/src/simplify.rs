//! Fewer triangles for nearly the same surface.
//!
//! [`simplify`] collapses edges, cheapest first, by quadric error (Garland and Heckbert 1997, "Surface simplification using quadric error
//! metrics"). Vertices only ever move onto another vertex, so attributes stay true; borders, hard edges, uv seams and
//! borders of materials are curves that collapse along themselves. [`cluster`] merges all that lies in one cell of a grid: faster
//! by far, and without regard for connectivity.
//!
//! ```
//! use luch_mesh::simplify::{Settings, simplify};
//! use luch_mesh::{generate, measure};
//!
//! let ball = generate::icosphere(1.0, 4);
//! let simple = simplify(&ball, &Settings { triangles: 500, ..Settings::default() });
//! assert!(simple.mesh.triangles.len() <= 500 && measure::closedness(&simple.mesh).is_closed());
//! ```

mod cluster;
mod collapse;
mod fans;
mod quadric;
mod rules;
mod start;
mod wedges;

use crate::{TriangleMesh, clean, weld};
pub use cluster::{MOST_CELLS, cluster};

/// How far to simplify. It ends at whichever limit comes first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// So many triangles are few enough.
    pub triangles: usize,
    /// The most that the surface may move, in metres: the root of the weighted mean of squared distances to the planes that a vertex stands
    /// for.
    pub error: f64,
    /// Borders stay exactly as they are.
    pub keeps_borders: bool,
}

impl Default for Settings {
    fn default() -> Self {
        Self { triangles: 0, error: f64::INFINITY, keeps_borders: false }
    }
}

/// A simpler mesh.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Simplified {
    /// The mesh; positions and values that are not used any more are left out.
    pub mesh: TriangleMesh,
    /// The largest error of a collapse, in metres.
    pub error: f64,
}

/// Collapses edges until a limit is reached or no collapse is allowed.
///
/// Refused are collapses that turn a triangle over or fold it sharply, and those that change the topology: closed stays closed, a handle
/// stays a handle, pieces stay apart. Positions that coincide are merged first. Meshes that are no manifolds keep those
/// places as they are. The same on every machine and number of threads.
pub fn simplify(mesh: &TriangleMesh, settings: &Settings) -> Simplified {
    if !mesh.validate().is_empty() {
        return Simplified { mesh: mesh.clone(), error: 0.0 };
    }
    let mesh = clean::remove_collapsed(&weld::weld_exact(mesh).mesh).mesh;
    let wedges = wedges::Wedges::of(&mesh);
    let result = collapse::run(&mesh, &wedges, settings);
    Simplified { mesh: clean::remove_unused_positions(&result.mesh).mesh, error: result.error }
}

#[cfg(test)]
mod tests;
