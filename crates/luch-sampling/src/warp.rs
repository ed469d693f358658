//! From the unit square to discs, spheres, cones and triangles; each with its density.
//!
//! Conventions: `u` are numbers in [0, 1); the z axis is the pole; directions have unit length. A density named `pdf` is
//! per solid angle for directions, `pdf_area` per area; it is zero outside the image of the square. Every warp is
//! continuous nearly everywhere and keeps neighbours together, so that an even set of points stays even.
//!
//! ```
//! use luch_sampling::warp;
//! let direction = warp::cosine_hemisphere([0.3, 0.8]);
//! assert!(direction.z > 0.0 && warp::cosine_hemisphere_pdf(direction) > 0.0);
//! ```

mod cone;
mod line;
mod planar;
mod round;
mod spherical_rectangle;
mod spherical_triangle;

pub use cone::Cone;
pub use line::{
    exponential, exponential_pdf, normal, normal_cumulative, normal_pdf, normal_quantile, tent, tent_pdf,
};
pub use planar::{disc, disc_pdf_area, triangle, triangle_pdf_area};
pub use round::{cosine_hemisphere, cosine_hemisphere_pdf, hemisphere, hemisphere_pdf, sphere, sphere_pdf};
pub use spherical_rectangle::{SphericalRectangle, SphericalRectangleSample};
pub use spherical_triangle::{SphericalTriangle, SphericalTriangleSample};
