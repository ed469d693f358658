//! What every codec promises: pictures and texts come back, the same picture gives the same bytes, and no file, cut
//! or changed or lying about its size, does worse than an error.

mod damage;
mod exr_kinds;
mod pictures;
mod png_kinds;
mod real_files;
mod round_trip;
