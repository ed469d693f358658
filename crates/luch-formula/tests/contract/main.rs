//! What the crate promises.

mod derivatives;
mod errors;
mod expressions;
mod language;
mod noise;
mod polynomials;
mod ranges;
mod roots;
mod samples;
mod values;
