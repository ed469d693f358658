//! Union, intersection and difference of bodies.
//!
//! The cutting is done by a library (a port of Manifold); what it needs and what it gives is checked here, and attributes
//! are carried over by barycentric coordinates in the triangles that the pieces come from. Another library can take its
//! place without a change outside this file.
//!
//! ```
//! use glam::Vec3;
//! use luch_mesh::boolean::{Operation, boolean};
//! use luch_mesh::{generate, measure};
//!
//! let cube = generate::cuboid(Vec3::ONE, [1; 3]);
//! let ball = generate::icosphere(0.6, 3);
//! let rest = boolean(&cube, &ball, Operation::Difference)?;
//! assert!(measure::closedness(&rest).is_closed() && measure::volume(&rest) < 0.25);
//! # Ok::<(), luch_mesh::boolean::BooleanError>(())
//! ```

mod attributes;
mod hull;

use std::panic::{AssertUnwindSafe, catch_unwind};

use glam::DVec3;
use manifold_rust::manifold::Manifold;
use manifold_rust::types::{BooleanEngine, Error, MeshGLP, OpType};

use crate::{TriangleMesh, clean, measure, weld};
pub use hull::{HullError, MOST_POINTS, convex_hull};

/// What is kept of two bodies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operation {
    /// What is in one or both.
    Union,
    /// What is in both.
    Intersection,
    /// What is in the first but not in the second.
    Difference,
}

/// Which of two bodies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operand {
    /// The first.
    First,
    /// The second.
    Second,
}

impl std::fmt::Display for Operand {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::First => "first",
            Self::Second => "second",
        })
    }
}

/// The most triangles of both bodies together.
pub const MOST_TRIANGLES: usize = 1 << 22;

/// Why two meshes cannot be combined.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum BooleanError {
    /// A mesh does not enclose a body.
    #[error("the {operand} mesh encloses no body: {reason}")]
    NotClosed {
        /// Which mesh.
        operand: Operand,
        /// Why it is not closed.
        reason: String,
    },
    /// Indices out of range, infinite positions and their like.
    #[error("the {operand} mesh is not valid: {reason}")]
    Invalid {
        /// Which mesh.
        operand: Operand,
        /// The first problem.
        reason: String,
    },
    /// The meshes are too large.
    #[error("both meshes have {triangles} triangles, more than {MOST_TRIANGLES}")]
    TooLarge {
        /// How many they have.
        triangles: usize,
    },
    /// The library gave up.
    #[error("the bodies could not be combined: {reason}")]
    Failed {
        /// What it said.
        reason: String,
    },
}

/// Combines two bodies. Positions that coincide are merged first; both meshes must then be closed and consistently wound.
///
/// Normals, uvs and colours are interpolated; cut faces of the second body in a difference are turned inside out. Material
/// slots keep their numbers. The result may be empty, and may have several pieces that touch. It is the same on every
/// machine.
pub fn boolean(
    first: &TriangleMesh,
    second: &TriangleMesh,
    operation: Operation,
) -> Result<TriangleMesh, BooleanError> {
    let triangles = first.triangles.len().saturating_add(second.triangles.len());
    if triangles > MOST_TRIANGLES {
        return Err(BooleanError::TooLarge { triangles });
    }
    let bodies =
        [(first, Operand::First), (second, Operand::Second)].map(|(mesh, operand)| body(mesh, operand));
    let [first, second] = bodies;
    let (first, second) = (first?, second?);
    // The library has assertions of its own; what trips them is refused, not passed on.
    let combined = catch_unwind(AssertUnwindSafe(|| combine(&first, &second, operation)));
    let pieces = combined.unwrap_or_else(|_| {
        Err(BooleanError::Failed { reason: "the library met a case that it does not handle".into() })
    })?;
    Ok(attributes::carried(&first, &second, &pieces, operation == Operation::Difference))
}

/// Triangles of a result, and where each comes from.
struct Pieces {
    positions: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
    /// The body, and the triangle of it.
    sources: Vec<(Operand, u32)>,
}

/// A welded mesh that encloses a body.
fn body(mesh: &TriangleMesh, operand: Operand) -> Result<TriangleMesh, BooleanError> {
    if let Some(problem) = mesh.validate().first() {
        return Err(BooleanError::Invalid { operand, reason: problem.to_string() });
    }
    let mesh = clean::remove_collapsed(&weld::weld_exact(mesh).mesh).mesh;
    let report = measure::closedness(&mesh);
    // Bodies that touch along an edge are bodies all the same; the second engine takes them.
    let encloses = report.boundary.is_none() && report.inconsistent.is_none() && report.components > 0;
    if !encloses {
        return Err(BooleanError::NotClosed { operand, reason: report.to_string() });
    }
    Ok(mesh)
}

fn combine(
    first: &TriangleMesh,
    second: &TriangleMesh,
    operation: Operation,
) -> Result<Pieces, BooleanError> {
    let ids = [Manifold::reserve_ids(1), Manifold::reserve_ids(1)];
    let solids = [(first, ids[0]), (second, ids[1])].map(|(mesh, id)| solid(mesh, id));
    for (solid, operand) in solids.iter().zip([Operand::First, Operand::Second]) {
        refuse(solid, operand)?;
    }
    let operation = match operation {
        Operation::Union => OpType::Add,
        Operation::Intersection => OpType::Intersect,
        Operation::Difference => OpType::Subtract,
    };
    let result = solids[0].boolean_with_engine(&solids[1], operation, BooleanEngine::Auto);
    if result.status() != Error::NoError {
        return Err(BooleanError::Failed { reason: format!("{:?}", result.status()) });
    }
    let mesh: MeshGLP<f64, u32> = result.get_mesh_glp(-1);
    let mut target: Vec<u32> = (0..mesh.num_vert() as u32).collect();
    for (&from, &to) in mesh.merge_from_vert.iter().zip(&mesh.merge_to_vert) {
        target[from as usize] = to;
    }
    let mut sources = Vec::with_capacity(mesh.num_tri());
    for (run, &id) in mesh.run_original_id.iter().enumerate() {
        let operand = if id == ids[0] { Operand::First } else { Operand::Second };
        let end = mesh.run_index.get(run + 1).map_or(mesh.num_tri(), |end| *end as usize / 3);
        for triangle in sources.len()..end.min(mesh.num_tri()) {
            sources.push((operand, mesh.face_id.get(triangle).copied().unwrap_or(0)));
        }
    }
    let triangles = (0..mesh.num_tri()).map(|t| mesh.get_tri_verts(t).map(|v| target[v as usize]));
    Ok(Pieces {
        positions: (0..mesh.num_vert()).map(|v| DVec3::from(mesh.get_vert_pos(v))).collect(),
        triangles: triangles.collect(),
        sources,
    })
}

/// The library's form of a body. Every triangle has a number of its own, so that the source of each piece is known.
fn solid(mesh: &TriangleMesh, id: u32) -> Manifold {
    Manifold::from_mesh_glp_robust(&MeshGLP::<f64, u32> {
        num_prop: 3,
        vert_properties: mesh.positions.iter().flat_map(|p| p.as_dvec3().to_array()).collect(),
        tri_verts: mesh.triangles.as_flattened().to_vec(),
        run_index: vec![0, mesh.triangles.len() as u32 * 3],
        run_original_id: vec![id],
        face_id: (0..mesh.triangles.len() as u32).collect(),
        ..MeshGLP::default()
    })
}

fn refuse(solid: &Manifold, operand: Operand) -> Result<(), BooleanError> {
    match solid.status() {
        Error::NoError => Ok(()),
        Error::NotManifold | Error::NotClosed => {
            let reason = "its faces do not close, or do not agree about inside and outside".into();
            Err(BooleanError::NotClosed { operand, reason })
        }
        other => Err(BooleanError::Invalid { operand, reason: format!("{other:?}") }),
    }
}

#[cfg(test)]
mod tests;
