//! Progressive, deterministic light transport.
//!
//! | value | what it is |
//! |---|---|
//! | [`World`] | a scene plus what is derived from it: trees and light tables; read only |
//! | [`View`] | how a pixel and a sample index become a ray |
//! | [`Integrator`] | how rays become radiance, a batch at a time |
//! | [`Film`] | exact sums of samples: the only thing that changes |
//! | [`render_pass`] | adds a range of samples to a film |
//! | [`RenderJob`] | a thread around it: goals, pause, cancel, snapshots |
//! | [`Checkpoint`] | a film as a file: resume, merge, reproduce |
//!
//! A sample is a pure function of (scene, settings, seed, pixel, index), and sums are exact, so a film depends only on which
//! samples it holds.
//!
//! ```
//! use luch_render::{Film, PathTracer, Stop, View, World, render_pass};
//! use std::sync::atomic::AtomicU64;
//!
//! let mut scene = luch_scene::preset::cornell_box();
//! (scene.settings.width, scene.settings.height) = (32, 32);
//! let view = View::new(&scene.cameras[0].camera, &scene.settings);
//! let world = World::build(scene)?;
//! let mut film = Film::new(view.width(), view.height());
//! render_pass(&world, &view, &PathTracer::default(), &mut film, 0..16, &Stop::new(), &AtomicU64::new(0))?;
//! let error = film.error().unwrap();
//! assert!(error.relative > 0.0 && error.relative < 1.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod bsdf;
mod checkpoint;
mod cone;
mod emitter;
mod exact;
mod film;
mod filter;
mod fingerprint;
mod footprint;
mod geometry;
pub mod integrator;
mod job;
mod joined;
mod lights;
mod material;
mod merge;
mod pass;
mod place;
mod plain;
mod purpose;
mod ranges;
mod reuse;
mod roulette;
mod stop;
mod surface;
mod texture;
mod traced;
mod view;
mod wave;
mod world;

pub use bsdf::{Bsdf, BsdfSample};
pub use checkpoint::{Checkpoint, CheckpointError, Provenance};
pub use cone::Cone;
pub use emitter::{EmitterSample, FlatForm, FlatLamp};
pub use film::{BUNDLE, Coverage, ErrorEstimate, Film, Losses, MeanEstimate, PixelEstimate, TILE, Tile};
pub use filter::FilterSampler;
pub use fingerprint::Fingerprint;
pub use geometry::Geometry;
pub use integrator::{AskedLamp, Departure, FollowedPath, FoundOnPath, MetSurface, PathEnd, PathVertex};
pub use integrator::{Inspect, Integrator, Occlusion, PathTracer, PlainPathTracer, from_settings};
pub use job::{Ending, Goal, JobEnd, JobPlan, OnSnapshot, Progress, RenderJob, StartError};
pub use lights::{Candidate, ChosenEmitter, FoundLight, LightSource, Lights, Receiver};
pub use material::{bsdf_at, emitted};
pub use merge::MergeError;
pub use pass::render_pass;
pub use ranges::Ranges;
pub use stop::{Stop, Stopped};
pub use surface::SurfacePoint;
pub use view::{CameraSample, View};
pub use world::{UnsoundScene, World};

/// A random number for the surfaces that a ray meets and that are only partly there.
fn opacity_key(sampler: &luch_sampling::Sampler, domain: luch_sampling::Domain) -> u64 {
    let [a, b, ..] = sampler.group_words(domain);
    u64::from(a) << 32 | u64::from(b)
}
