//! Images of heights as meshes.
//!
//! A [`HeightField`] holds heights at the points of a grid, from an image, a file of real elevations, or made by chance. It
//! becomes a sheet of triangles with a vertex for each point ([`sheet`]), a closed body ([`solid`]), or a sheet of few
//! triangles that is nowhere off by more than a given height ([`reduced`]).
//!
//! ```
//! use luch_mesh::{height_map::{self, Terrain}, measure};
//!
//! let field = height_map::terrain(&Terrain { columns: 65, rows: 65, ..Terrain::default() })?;
//! let exact = height_map::sheet(&field);
//! assert_eq!(exact.positions.len(), 65 * 65);
//!
//! let few = height_map::reduced(&field, &height_map::Reduction { error: 0.01, most_triangles: None });
//! assert!(few.triangles.len() < exact.triangles.len());
//!
//! let body = height_map::solid(&field, &few, -0.5)?;
//! assert!(measure::closedness(&body).is_closed());
//! # Ok::<(), height_map::HeightError>(())
//! ```

pub mod ascii_grid;
mod delaunay;
mod displace;
mod edit;
mod field;
mod image;
mod noise;
mod reduce;
mod sheet;
mod solid;
mod terrain;

pub use displace::{Displacement, displace};
pub use field::{HeightError, HeightField, MAX_POINTS};
pub use image::{Channel, from_bitmap};
pub use reduce::{Reduction, reduced};
pub use sheet::sheet;
pub use solid::solid;
pub use terrain::{Landform, Terrain, terrain};
