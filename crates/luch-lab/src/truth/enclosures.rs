//! F1 to F5: enclosures in which light goes to and fro without end.

use super::stage::{aimed, gray, put};
use super::{Case, Family, Way};
use glam::{Affine3A, Vec3};
use luch_image::{Bitmap, Encoding, Image, Rgb};
use luch_mesh::generate;
use luch_scene::preset::furnace;
use luch_scene::{
    Camera, ColorValue, Emission, Id, Integrator, Light, Normals, Scene, Shape, Texture, TextureFilter,
    TextureUse, Wrap,
};

/// A closed box or ball with the same emission and albedo everywhere, its inside the front or the back.
fn enclosure(shape: Shape, albedo: f32) -> Scene {
    let mut material = gray(albedo);
    material.emission = Some(Emission { radiance: Rgb::WHITE.into(), two_sided: true });
    let mut scene = Scene::default();
    scene.settings.normals = Normals::Flat;
    put(&mut scene, shape, material, Affine3A::IDENTITY);
    scene
}

fn inside() -> Camera {
    Camera::looking_at(Vec3::new(0.2, 0.1, 0.3), Vec3::new(1.0, 0.3, -0.2), Vec3::Y, 1.2)
}

fn cuboid() -> Shape {
    Shape::Mesh(generate::cuboid(Vec3::splat(2.0), [1, 1, 1]))
}

pub(super) fn uniform() -> Vec<Case> {
    let case = |name: String, scene: &Scene, camera, truth| Case::new(Family::F1, name, scene, camera, truth);
    let mut cases = Vec::new();
    let albedo = 0.8;
    for (name, shape) in [
        ("sphere", Shape::Sphere { radius: 1.0 }),
        ("box", cuboid()),
        ("icosphere", Shape::Mesh(generate::icosphere(1.0, 1))),
    ] {
        let scene = enclosure(shape, albedo);
        for k in 0..=3 {
            let truth = (1.0 - libm::pow(f64::from(albedo), f64::from(k + 1))) / (1.0 - f64::from(albedo));
            let case = case(format!("{name}, {k} scatterings"), &scene, inside(), truth);
            // Before roulette begins a plain path sees the same on every way.
            let case = case.exactly_by(&[Integrator::PlainPath { max_depth: k }]);
            cases.push(case.by(&[Integrator::Path { max_depth: k }]));
        }
        let truth = 1.0 + f64::from(albedo);
        cases.push(case(format!("{name}, direct light"), &scene, inside(), truth).by(&[Way::DIRECT]));
    }
    let sphere = furnace(Rgb::gray(0.5), Rgb::gray(3.0));
    cases.push(case("sphere, without end".into(), &sphere, inside(), 6.0).by(&[Way::PATH, Way::PLAIN]));
    let room = enclosure(cuboid(), 0.9);
    cases.push(case("box, without end".into(), &room, inside(), 10.0).by(&[Way::PATH, Way::PLAIN]));
    // Where neighbours are near.
    let corner = aimed(Vec3::ZERO, Vec3::new(0.9995, 0.9996, 0.9997));
    cases.push(case("corner of the box".into(), &room, corner, 10.0).by(&[Way::PATH]));
    cases
}

pub(super) fn point_in_sphere() -> Vec<Case> {
    let mut scene = Scene::default();
    put(&mut scene, Shape::Sphere { radius: 1.0 }, gray(0.5), Affine3A::IDENTITY);
    scene.lights.push(Light::Point { position: Vec3::ZERO, intensity: Rgb::gray(std::f32::consts::PI) });
    let case = |name: String, truth| Case::new(Family::F2, name, &scene, inside(), truth);
    let cut = |k: u32| {
        let truth = 1.0 - libm::pow(0.5, f64::from(k));
        case(format!("{k} scatterings"), truth).exactly_by(&[Integrator::Path { max_depth: k }])
    };
    let whole = case("without end".into(), 1.0).by(&[Way::PATH]);
    let direct = case("direct light".into(), 0.5).exactly_by(&[Way::DIRECT]);
    (1..=3).map(cut).chain([direct, whole]).collect()
}

pub(super) fn partly_glowing() -> Vec<Case> {
    let mut scene = Scene::default();
    let mut quarter = Image::filled(4, 1, Rgb::BLACK);
    quarter.pixels_mut()[0] = Rgb::WHITE;
    scene.images.push(Bitmap::from_rgb(&quarter).into());
    let texture = scene.add_texture(Texture::Image {
        image: Id::new(0),
        encoding: Encoding::Linear,
        wrap: [Wrap::Clamp; 2],
        filter: TextureFilter::Nearest,
    });
    let mut material = gray(0.6);
    let radiance = ColorValue { factor: Rgb::gray(2.0), ..ColorValue::textured(TextureUse::new(texture)) };
    material.emission = Some(Emission { radiance, two_sided: true });
    put(&mut scene, Shape::Sphere { radius: 1.0 }, material, Affine3A::IDENTITY);
    let indirect = 0.6 * 2.0 * 0.25 / 0.4;
    // u runs eastward from −Z: the first quarter glows from −Z to −X.
    let glowing = Vec3::new(-0.5, 0.3, -0.5);
    let eye = Vec3::new(0.1, 0.0, 0.2);
    let case = |name: &str, target, truth| Case::new(Family::F3, name, &scene, aimed(eye, target), truth);
    vec![
        case("dark part", -glowing, indirect).by(&[Way::PATH, Way::PLAIN]),
        case("glowing part", glowing, indirect + 2.0).by(&[Way::PATH, Way::PLAIN]),
        case("direct light", -glowing, 0.6 * 2.0 * 0.25).by(&[Way::DIRECT]),
    ]
}

pub(super) fn concentric() -> Vec<Case> {
    let mut scene = Scene::default();
    let mut inner = gray(0.5);
    inner.emission = Some(Emission::constant(Rgb::WHITE));
    put(&mut scene, Shape::Sphere { radius: 0.5 }, inner, Affine3A::IDENTITY);
    put(&mut scene, Shape::Sphere { radius: 1.0 }, gray(0.8), Affine3A::IDENTITY);
    let eye = Vec3::new(0.0, 0.8, 0.1);
    let outward = Vec3::new(0.3, 2.0, -0.4);
    let case = |name: &str, target, truth| Case::new(Family::F4, name, &scene, aimed(eye, target), truth);
    vec![
        case("inner sphere", Vec3::ZERO, 4.0 / 3.0).by(&[Way::PATH, Way::PLAIN]),
        case("outer sphere", outward, 2.0 / 3.0).by(&[Way::PATH, Way::PLAIN]),
        // One scattering on the outer sphere sees the inner one under the form factor 1/4.
        case("direct light", outward, 0.8 * 0.25).by(&[Way::DIRECT]),
    ]
}

pub(super) fn parallel_planes() -> Vec<Case> {
    // The edges are two thousand gaps away: less than a millionth of the light is lost there.
    const RADIUS: f32 = 2000.0;
    let mut scene = Scene::default();
    let mut lower = gray(0.5);
    lower.emission = Some(Emission::constant(Rgb::WHITE));
    put(&mut scene, Shape::Disc { radius: RADIUS }, lower, Affine3A::IDENTITY);
    put(&mut scene, Shape::Disc { radius: RADIUS }, gray(0.8), Affine3A::from_translation(Vec3::Y));
    let case = |name: &str, y, truth| {
        let camera = aimed(Vec3::new(0.0, 0.5, 0.0), Vec3::new(0.3, y, 0.2));
        Case::new(Family::F5, name, &scene, camera, truth)
    };
    vec![
        case("glowing plane", 0.0, 5.0 / 3.0).by(&[Way::PATH, Way::PLAIN]),
        case("other plane", 1.0, 4.0 / 3.0).by(&[Way::PATH, Way::PLAIN]),
        case("direct light", 1.0, 0.8).by(&[Way::DIRECT]),
    ]
}
