//! Changing polygons by hand: selections, topology, deformations.
//!
//! Every operation takes a mesh and flags of the elements it works on, one for each face, vertex or edge; [`Selection`]
//! makes them from text. Corner values (normals, uvs, colours) are carried through: new corners get values mixed from the
//! corners they lie between, new walls unfold from the edge they rise from. Creases follow the vertices. Faces that make
//! no sense (fewer than three different corners, corners that do not exist) are left out of what is made.
//!
//! ```
//! use luch_mesh::edit::{self, Extrusion, Selection};
//! use luch_mesh::{PolygonMesh, generate, measure};
//!
//! let cube = PolygonMesh::from(&generate::cuboid(glam::Vec3::ONE, [1; 3]));
//! let top = Selection::parse("normal(0,1,0, 10deg)")?.faces(&cube);
//! let tower = edit::extrude(&cube, &top, &Extrusion::along_normals(2.0))?;
//! assert!((measure::volume(&tower.triangulate()) - 3.0).abs() < 1e-6);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod bevel;
mod bridge;
mod builder;
mod collapse;
mod copies;
mod cut;
mod deform;
mod dissolve;
mod error;
mod extrude;
mod fans;
mod field;
mod geometry;
mod lattice;
mod normals;
mod pieces;
mod place;
mod prepare;
mod quadrangulate;
mod raise;
mod selection;
mod solidify;
mod split;
mod symmetry;
mod triangles;
mod unwrap;

pub use bevel::{Beveled, bevel_edges, bevel_vertices};
pub use bridge::bridge;
pub use collapse::collapse_edges;
pub use copies::{append, array, radial_array};
pub use cut::{Cut, Plane, Side, cut, slice};
pub use deform::{Deformation, Span, deform, displace};
pub use dissolve::{dissolve_edges, dissolve_flat, dissolve_vertices};
pub use error::{EditError, MOST_CORNERS, MOST_FACES};
pub use extrude::{Extrusion, Grouping, Inset, extrude, extrude_borders, inset};
pub use field::Field;
pub use lattice::Lattice;
pub use normals::{creased_normals, flat_normals, refresh_normals, smooth_normals, vertex_normals};
pub use pieces::{component, components, delete_faces, detach, duplicate, flip_faces, rip, set_slot};
pub use place::{
    about_center, inflate, mean_distance, move_vertices, rotation_about, transform, vertex_bounds,
};
pub use prepare::prepared;
pub use quadrangulate::{Quadrangulation, quadrangulate};
pub use selection::{Selection, SelectionError};
pub use solidify::solidify;
pub use split::{poke, split_edges, split_quads};
pub use symmetry::{Symmetry, symmetrize};
pub use triangles::triangulate_faces;
pub use unwrap::{Projection, unwrap};
