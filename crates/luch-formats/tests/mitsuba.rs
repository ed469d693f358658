//! Importing scenes of Mitsuba: every plugin on a small text, errors with their places, real files, and damage to both.

#![expect(clippy::print_stderr, reason = "tests say what they skipped and how many files they read")]

#[path = "mitsuba/cameras.rs"]
mod cameras;
#[path = "mitsuba/errors.rs"]
mod errors;
#[path = "mitsuba/hostile.rs"]
mod hostile;
#[path = "mitsuba/lights.rs"]
mod lights;
#[path = "mitsuba/old_versions.rs"]
mod old_versions;
#[path = "mitsuba/parameters.rs"]
mod parameters;
#[path = "mitsuba/real_files.rs"]
mod real_files;
#[path = "mitsuba/shapes.rs"]
mod shapes;
#[path = "mitsuba/surfaces.rs"]
mod surfaces;
#[path = "mitsuba/text.rs"]
mod text;
#[path = "mitsuba/textures.rs"]
mod textures;
