//! What random numbers are for: every decision of a path draws from a domain of its own.

use luch_sampling::Domain;

/// Place under the filter (two numbers) and on the lens (two).
pub(crate) const CAMERA: Domain = Domain::new(0, 0);

/// Direction (two numbers), lobe, roulette.
pub(crate) const fn scatter(bounce: u32) -> Domain {
    Domain::new(bounce, 1)
}

/// Which emitter (one number) and where on it (two).
pub(crate) const fn light(bounce: u32) -> Domain {
    Domain::new(bounce, 2)
}

/// Whether partly transparent surfaces stop the path's ray.
pub(crate) const fn opacity(bounce: u32) -> Domain {
    Domain::new(bounce, 3)
}

/// Whether partly transparent surfaces stop the ray to a light.
pub(crate) const fn light_opacity(bounce: u32) -> Domain {
    Domain::new(bounce, 4)
}

/// Which part of a mixed material.
pub(crate) const fn mix(bounce: u32) -> Domain {
    Domain::new(bounce, 5)
}
