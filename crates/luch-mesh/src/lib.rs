//! Mesh toolkit: free functions on one plain type.
//!
//! A [`TriangleMesh`] keeps positions, normals and texture coordinates in lists of their own, and triangles index each
//! list separately. A hard edge gives one position two normals; it does not split the position. So a closed mesh is
//! closed by its indices, and can be checked for it.
//!
//! ```
//! use luch_mesh::{codec, generate, measure, normals};
//!
//! // A cylinder: smooth side, sharp rims, one closed surface.
//! let mut mesh = generate::cylinder(1.0, 2.0, 64, 1, true);
//! assert_eq!(measure::closedness(&mesh).to_string(), "closed (1 piece, genus 0)");
//! assert!((measure::volume(&mesh) - 2.0 * std::f64::consts::PI).abs() < 0.02);
//!
//! // Its normals could as well have been found by crease angle.
//! mesh.normals = normals::creased(&mesh, 0.5, normals::Weight::Angle);
//!
//! // To a file and back, bit for bit.
//! let text = codec::obj::encode(&mesh, &Default::default());
//! let again = codec::decode(text.as_bytes(), codec::Format::Obj)?;
//! assert_eq!(again.mesh.positions, mesh.positions);
//! # Ok::<(), codec::DecodeError>(())
//! ```
//!
//! Errors of files say where:
//!
//! ```
//! let error = luch_mesh::codec::obj::decode(b"v 0 0 0\nv 1 O 0\n").unwrap_err();
//! assert_eq!(error.to_string(), "line 2, column 5: found “O”, expected a number");
//! ```

pub mod barycentric;
pub mod boolean;
pub mod clean;
pub mod codec;
pub mod edges;
pub mod edit;
pub mod generate;
pub mod height_map;
pub mod implicit;
pub mod inspect;
pub mod measure;
pub mod normals;
pub mod outline;
pub mod patch;
pub mod polygon_mesh;
pub mod query;
pub mod repair;
pub mod scatter;
pub mod screen;
mod sets;
pub mod simplify;
pub mod smooth;
mod statistics;
pub mod subdivide;
mod transform;
mod triangle_mesh;
pub mod unify;
mod validate;
pub mod weld;
mod words;
pub mod workshop;

pub use barycentric::Barycentric;
pub use generate::Generator;
pub use polygon_mesh::PolygonMesh;
pub use statistics::MemoryStatistics;
pub use triangle_mesh::{Attribute, TriangleMesh};
pub use validate::{List, Problem};
