//! Isotropic remeshing (Botsch and Kobbelt 2004, "A remeshing approach to multiresolution modeling"): split long edges, collapse short
//! ones, flip for even valences, relax along the surface, project back; again and again.

use luch_bvh::{Quality, TriangleBvh};

use super::surface::Surface;
use crate::{TriangleMesh, clean, measure, weld};

/// How to remesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Remesh {
    /// The length that edges shall have, in metres.
    pub length: f64,
    /// How often all steps are done.
    pub iterations: u32,
    /// Edges bent by more than this angle (radians) stay.
    pub feature_angle: f64,
}

impl Default for Remesh {
    fn default() -> Self {
        Self { length: 0.1, iterations: 5, feature_angle: 0.7 }
    }
}

/// The most triangles of a result, as far as area and length foretell it.
pub const MOST_TRIANGLES: f64 = 16_777_216.0;

/// Why a mesh cannot be remeshed.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum RemeshError {
    /// Indices out of range or values that are not finite.
    #[error("the mesh is not valid: repair it first")]
    Invalid,
    /// The length is not a positive number.
    #[error("the length of edges must be above 0, not {length}")]
    Length {
        /// What was given.
        length: f64,
    },
    /// The edges are too short for this surface.
    #[error("edges of length {length} give some {triangles:.0} triangles, more than {MOST_TRIANGLES}")]
    TooFine {
        /// What was given.
        length: f64,
        /// How many triangles are expected.
        triangles: f64,
    },
}

/// Makes triangles with edges of about the same length. Borders and sharp edges stay as lines; their vertices move along
/// straight parts only. The result has positions and triangles, no attributes. Closed stays closed.
pub fn remesh(mesh: &TriangleMesh, settings: &Remesh) -> Result<TriangleMesh, RemeshError> {
    if !mesh.validate().is_empty() {
        return Err(RemeshError::Invalid);
    }
    let length = settings.length;
    if !(length > 0.0 && length.is_finite()) {
        return Err(RemeshError::Length { length });
    }
    let mesh = clean::remove_collapsed(
        &weld::weld_exact(&TriangleMesh::new(mesh.positions.clone(), mesh.triangles.clone())).mesh,
    )
    .mesh;
    // An even triangle has the area √3/4 of its square; long edges of thin triangles are cut as well.
    let edges: f64 = (0..mesh.triangles.len())
        .flat_map(|t| {
            let [a, b, c] = mesh.corners(t).map(|p| p.as_dvec3());
            [a.distance(b), b.distance(c), c.distance(a)]
        })
        .sum();
    let triangles = measure::area(&mesh) / (length * length) * 4.0 / 3f64.sqrt() + edges / length;
    if triangles.is_nan() || triangles > MOST_TRIANGLES {
        return Err(RemeshError::TooFine { length, triangles });
    }
    let tree = TriangleBvh::build(&mesh.positions, &mesh.triangles, Quality::Balanced);
    let mut surface = Surface::new(&mesh, settings.feature_angle);
    let (longest, shortest) = (length * 4.0 / 3.0, length * 4.0 / 5.0);
    for _ in 0..settings.iterations.min(100) {
        split_long(&mut surface, longest * longest);
        for [a, b] in surface.edges() {
            if surface.length_squared([a, b]) < shortest * shortest {
                // The other direction where the first is not allowed.
                let _ =
                    surface.collapse(a, b, longest * longest) || surface.collapse(b, a, longest * longest);
            }
        }
        for edge in surface.edges() {
            surface.flip(edge);
        }
        relax(&mut surface, &tree);
    }
    Ok(surface.into_mesh())
}

/// Halves edges until none is too long; each round halves the longest length.
fn split_long(surface: &mut Surface, most: f64) {
    for _ in 0..64 {
        let long: Vec<[u32; 2]> =
            surface.edges().into_iter().filter(|edge| surface.length_squared(*edge) > most).collect();
        if long.is_empty() || surface.triangle_count() as f64 > 2.0 * MOST_TRIANGLES {
            return;
        }
        for edge in long {
            surface.split(edge);
        }
    }
}

/// Vertices off features move toward the middle of their neighbours, along the surface, and back onto it.
fn relax(surface: &mut Surface, tree: &TriangleBvh) {
    let mut moved = surface.places.clone();
    for vertex in 0..surface.places.len() as u32 {
        let neighbours = surface.neighbours(vertex);
        let Some(normal) = surface.normal_at(vertex).try_normalize() else { continue };
        if surface.is_on_feature(vertex) || neighbours.is_empty() {
            continue;
        }
        let own = surface.places[vertex as usize];
        let mean = neighbours.iter().map(|&v| surface.places[v as usize]).sum::<glam::DVec3>()
            / neighbours.len() as f64;
        let target = mean + normal * normal.dot(own - mean);
        if let Some(nearest) = tree.nearest_point(target.as_vec3(), f32::INFINITY) {
            moved[vertex as usize] = nearest.point.as_dvec3();
        }
    }
    surface.places = moved;
}
