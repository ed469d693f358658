//! From a field to its surface.

use super::ImplicitError;
use super::crossing::{Vertices, crossings};
use super::dual_contouring::contour;
use super::field::Field;
use super::marching_cubes::triangles;
use super::roots::roots;
use super::sampling::{Sampling, sample_near_surface};
use super::signs::Signs;
use crate::TriangleMesh;

/// How a surface is made of samples.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Method {
    /// A vertex on each crossed edge: smooth surfaces, the topology of trilinear interpolation; edges are cut off.
    #[default]
    MarchingCubes,
    /// Vertices within cells, where tangent planes meet: sharp edges and corners.
    DualContouring,
}

/// The surface where a field is zero.
///
/// The field is evaluated only where its intervals cannot exclude the surface. Crossings are found to a hundred-millionth of a cell, so
/// vertices of marching cubes lie on the surface itself; they get the gradient as normal. Dual contouring gives no normals: its
/// vertices lie on edges, where there is more than one ([`crate::normals::creased`] finds them).
///
/// The surface is a manifold, closed but where it meets the side of an open region.
pub fn surface(
    field: &dyn Field,
    sampling: &Sampling,
    method: Method,
) -> Result<TriangleMesh, ImplicitError> {
    let grid = sample_near_surface(field, sampling)?;
    let signs = Signs::new(&grid, 0.0);
    let numbers = signs.number_edges()?;
    let crossings = crossings(&grid, &signs, &numbers);
    let roots = roots(field, &grid, &crossings);
    if method == Method::DualContouring {
        return Ok(contour(field, &grid, &signs, &numbers, &crossings, &roots));
    }
    let mut vertices = Vertices { positions: Vec::new(), normals: Vec::new() };
    for (crossing, root) in crossings.iter().zip(&roots) {
        let fraction = crossing.apart(&signs, root.fraction);
        vertices.positions.push(crossing.point(&grid, fraction).as_vec3());
        vertices.normals.push(root.normal);
    }
    Ok(triangles(&grid, 0.0, &signs, &numbers, vertices))
}
