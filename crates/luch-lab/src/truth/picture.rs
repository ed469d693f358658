//! How places of the scene become pixels: the lens, and the lecture's glossy disc.

use super::formulas::disc_left_of;
use super::stage::{aimed, facing_down, half_plane, lamp, put};
use super::{Case, Family, Way};
use glam::{Affine3A, Vec3};
use luch_image::Rgb;
use luch_scene::{Camera, Material, Projection, Scene, Shape, Surface};

pub(super) fn lens() -> Vec<Case> {
    let radius = 0.3;
    let narrow = Camera { lens_radius: radius, focus_distance: 4.0, ..aimed(Vec3::ZERO, Vec3::NEG_Z) };
    let parallel = Camera { projection: Projection::Orthographic { height: 1e-4 }, ..narrow };
    let case = |name: &str, scene: &Scene, camera, truth| {
        Case::new(Family::Lens, name, scene, camera, truth).by(&[Way::PATH])
    };
    // Rays of one pixel meet at the focus and spread behind it: at 6 m each is half its place on the lens away, mirrored.
    let behind = |name, offset: f32| {
        let part = disc_left_of(f64::from(-2.0 * offset / radius));
        case(name, &half_plane(0.0, offset, -6.0), narrow, part)
    };
    vec![
        behind("behind the focus, most", -0.03),
        behind("behind the focus, less", 0.06),
        // In front of it, at 2 m, each is half its place away, not mirrored.
        case("before the focus", &half_plane(0.0, 0.06, -2.0), narrow, disc_left_of(-0.4)),
        case("parallel rays", &half_plane(0.0, 0.06, -6.0), parallel, disc_left_of(-0.4)),
    ]
}

pub(super) fn glossy() -> Vec<Case> {
    let (color, glossiness) = (0.8_f32, 0.8_f32);
    let largest = libm::tanf((1.0 - glossiness) * std::f32::consts::FRAC_PI_2);
    // A normal of slope p turns the view from straight above by 2 atan p.
    let case = |slope: f32| {
        let mut scene = Scene::default();
        let glossy =
            Material::new(Surface::Glossy { color: Rgb::gray(color).into(), glossiness: glossiness.into() });
        put(&mut scene, Shape::Plane, glossy, Affine3A::IDENTITY);
        let radius = libm::tanf(2.0 * libm::atanf(slope));
        put(&mut scene, Shape::Disc { radius }, lamp(3.0), facing_down(Vec3::Y));
        let part = f64::from(slope / largest) * f64::from(slope / largest);
        let camera = aimed(Vec3::Y * 0.5, Vec3::ZERO);
        let name = format!("lamp as wide as slopes of {slope}");
        Case::new(Family::Glossy, name, &scene, camera, f64::from(color) * 3.0 * part).by(&[
            Way::PATH,
            Way::PLAIN,
            Way::DIRECT,
        ])
    };
    [0.15, 0.25].map(case).into()
}
