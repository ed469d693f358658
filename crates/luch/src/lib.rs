//! luch: a renderer, a Monte Carlo laboratory and a mesh workshop.
//!
//! This crate is the family in one place. Each part also stands alone: `luch-sampling`, `luch-bvh`, `luch-image`, `luch-mesh`,
//! `luch-scene`, `luch-formats`, `luch-render`. The organisation into crates is an implementation detail; the values are not:
//!
//! ```text
//! file ─ load ─▶ Scene ─ World::build ─▶ World ─ render_pass ─▶ Film ─ to_image ─▶ Image ─ save_image ─▶ file
//! ```
//!
//! ```
//! use luch::prelude::*;
//!
//! let mut scene = luch::scene::preset::cornell_box();
//! (scene.settings.width, scene.settings.height) = (64, 64);
//! let view = View::new(&scene.cameras[0].camera, &scene.settings);
//! let world = World::build(scene)?;
//! let mut film = Film::new(view.width(), view.height());
//! render_pass(&world, &view, &PathTracer::default(), &mut film, 0..4, &Stop::new(), &Default::default())?;
//! let picture = film.to_image();
//! assert!(picture.get(32, 40).luminance() > 0.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub use luch_bvh as bvh;
pub use luch_formats as formats;
pub use luch_formula as formula;
pub use luch_image as image;
pub use luch_mesh as mesh;
pub use luch_preview as preview;
pub use luch_render as render;
pub use luch_sampling as sampling;
pub use luch_scene as scene;

pub use luch_formats::load;

/// The names most programs need.
pub mod prelude {
    pub use luch_formats::{load, save_image};
    pub use luch_image::{Image, Rgb};
    pub use luch_render::{
        Checkpoint, Film, Fingerprint, Goal, Integrator, JobPlan, PathTracer, RenderJob, Stop, View, World,
        from_settings, render_pass,
    };
    pub use luch_scene::{Camera, Material, Scene, Settings, Shape};
}
