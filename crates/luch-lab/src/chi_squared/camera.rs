//! Places of the lens and of the pixel.

use super::Routine;
use glam::{EulerRot, Mat3, Vec2, Vec3};
use luch_render::{FilterSampler, View};
use luch_sampling::check::Area;
use luch_sampling::warp::disc_pdf_area;
use luch_scene::{Camera, Filter, Projection, Settings};
use std::f64::consts::{PI, SQRT_2, TAU};

const AXES: [&str; 2] = ["x", "y"];

/// Where rays leave the lens, in radii.
fn lens(parameters: &str, projection: Projection) -> Routine {
    const RADIUS: f32 = 0.3;
    let orientation = Mat3::from_euler(EulerRot::YXZ, 0.7, -0.4, 0.0);
    let camera = Camera {
        position: Vec3::new(1.0, 2.0, -0.5),
        orientation,
        projection,
        lens_radius: RADIUS,
        focus_distance: 2.0,
    };
    let settings = Settings { width: 64, height: 48, ..Settings::default() };
    let view = View::new(&camera, &settings);
    // Through the middle of the picture: parallel rays start from the lens alone.
    let draw = move |[u, v, ..]: [f32; 4]| {
        let ray = view.ray(Vec2::new(32.0, 24.0), [u, v]);
        let place = orientation.transpose() * (ray.origin - camera.position) / RADIUS;
        Some([f64::from(place.x), f64::from(place.y)])
    };
    let area = Area { low: [-1.0; 2], high: [1.0; 2] };
    let pdf = |[x, y]: [f64; 2]| f64::from(disc_pdf_area(Vec2::new(x as f32, y as f32)));
    Routine::places("lens", parameters, area, AXES, draw, pdf)
}

/// Offsets from the pixel's middle against the filter itself, divided by its integral.
fn filter(
    parameters: &str,
    filter: Filter,
    radius: f64,
    density: impl Fn(f64) -> f64 + Send + Sync + 'static,
) -> Routine {
    let sampler = FilterSampler::new(filter);
    let draw = move |[u, v, ..]: [f32; 4]| Some([u, v].map(|u| f64::from(sampler.offset(u))));
    let area = Area { low: [-radius; 2], high: [radius; 2] };
    Routine::places("filter", parameters, area, AXES, draw, move |[x, y]| density(x) * density(y))
}

pub(super) fn routines() -> Vec<Routine> {
    let gaussian = |x: f64| {
        let inside = libm::erf(1.5 / (0.5 * SQRT_2));
        libm::exp(-0.5 * (x / 0.5) * (x / 0.5)) / (0.5 * TAU.sqrt() * inside)
    };
    // Harris 1978; the integral over −1 to 1 is twice the first term.
    let blackman_harris = |x: f64| {
        let term = |k: f64| libm::cos(k * PI * (x / 1.5 + 1.0));
        let window = 0.35875 - 0.48829 * term(1.0) + 0.14128 * term(2.0) - 0.01168 * term(3.0);
        window / (2.0 * 0.35875 * 1.5)
    };
    vec![
        lens("perspective", Projection::Perspective { field_of_view_y: 0.8 }),
        lens("parallel", Projection::Orthographic { height: 3.0 }),
        filter("box, radius 0.5", Filter::Box { radius: 0.5 }, 0.5, |_| 1.0),
        filter("tent, radius 1", Filter::Tent { radius: 1.0 }, 1.0, |x| 1.0 - x.abs()),
        filter(
            "gaussian, radius 1.5, deviation 0.5",
            Filter::Gaussian { radius: 1.5, deviation: 0.5 },
            1.5,
            gaussian,
        ),
        filter("blackman-harris, radius 1.5", Filter::BlackmanHarris { radius: 1.5 }, 1.5, blackman_harris),
    ]
}
