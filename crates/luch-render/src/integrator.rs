//! Light transport algorithms: a batch of camera samples becomes their radiance.

mod inspect;
mod occlusion;
mod path;
mod plain_path;

pub use inspect::Inspect;
pub use occlusion::Occlusion;
pub use path::{
    AskedLamp, Departure, FollowedPath, FoundOnPath, MetSurface, PathEnd, PathTracer, PathVertex,
};
pub use plain_path::PlainPathTracer;

use crate::stop::{Stop, Stopped};
use crate::view::{CameraSample, View};
use crate::world::World;
use luch_image::Rgb;
use luch_scene::Integrator as Name;

/// Finds the radiance of camera samples.
///
/// Samples come in bundles: blocks of [`BUNDLE`](crate::BUNDLE) × `BUNDLE` pixels with one index, cut at the edges of the picture. What
/// a sample returns may depend on the world and the samples of its bundle, which are the same whoever renders it, and on nothing
/// else: not on who travels beside it in the batch.
pub trait Integrator: Send + Sync {
    /// Writes the radiance of `samples[i]` to `radiance[i]`; both have the same length. Bundles are whole.
    ///
    /// # Errors
    /// [`Stopped`] if `stop` came due; `radiance` is then worthless.
    fn radiance(
        &self,
        world: &World,
        samples: &[CameraSample],
        radiance: &mut [Rgb],
        stop: &Stop,
    ) -> Result<(), Stopped>;
}

/// The algorithm that settings name.
pub fn from_settings(name: Name, view: &View) -> Box<dyn Integrator> {
    match name {
        Name::Path { max_depth } => Box::new(PathTracer { max_depth, reuse: true }),
        Name::PlainPath { max_depth } => Box::new(PlainPathTracer { max_depth }),
        // Emitted light and one scattering is a path cut short.
        Name::Direct => Box::new(PathTracer { max_depth: 1, reuse: false }),
        Name::Occlusion { distance } => Box::new(Occlusion { distance }),
        Name::Inspect(property) => Box::new(Inspect::new(property, view)),
    }
}
