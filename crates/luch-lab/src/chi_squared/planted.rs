//! Routines whose stated density is wrong on purpose, by little: the test must reject them.

use super::Routine;
use super::bsdf::{direction, draw};
use glam::Vec3;
use luch_image::Rgb;
use luch_render::Bsdf;
use luch_render::bsdf::{Conductor, ConductorFresnel};
use luch_sampling::warp;

pub(super) fn routines() -> Vec<Routine> {
    let mixed = Routine::directions(
        "planted-hemisphere",
        "drawn evenly; the density says 8 % by the cosine",
        Vec3::Z,
        |u| Some(warp::hemisphere([u[0], u[1]])),
        |d| 0.92 * warp::hemisphere_pdf(d) + 0.08 * warp::cosine_hemisphere_pdf(d),
    );
    let conductor =
        |roughness| Bsdf::Conductor(Conductor::new(ConductorFresnel::from_color(Rgb::WHITE), roughness));
    let (drawn, stated) = (conductor(0.3), conductor(0.305));
    let outgoing = direction(0.5, 1.0);
    let rough = Routine::directions(
        "planted-conductor",
        "drawn with roughness 0.3; the density is that of 0.305",
        Vec3::Z,
        move |u| draw(&drawn, outgoing, u),
        move |incoming| stated.pdf(outgoing, incoming),
    );
    let scaled = Routine::directions(
        "planted-scale",
        "the density is right but for a factor of 1.01",
        Vec3::Z,
        |u| Some(warp::sphere([u[0], u[1]])),
        |_| 1.01 * warp::sphere_pdf(),
    );
    vec![mixed, rough, scaled]
}
