//! The crate seen from outside: against rays, against areas, under bad input.

mod coverage;
mod framing;
mod hostile;
mod lines;
mod ray_casts;
mod shading;
mod views;
