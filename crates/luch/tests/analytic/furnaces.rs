//! Ground truth F1 to F8: enclosures and bodies in uniform light, where every pixel is known.

use super::measure::{DIRECT, PATH, PLAIN, aimed, expect, expect_exactly};
use super::stage::{black, floor, gray, lamp, put, surround, world};
use glam::{Affine3A, Mat3, Quat, Vec3};
use luch::image::{Bitmap, Image};
use luch::mesh::generate;
use luch::prelude::*;
use luch::scene::preset::{furnace, material_ball, parallelogram};
use luch::scene::{
    ColorValue, Emission, Integrator as Name, Light, Normals, Reflectance, Surface, Texture, TextureFilter,
    TextureUse, Wrap,
};

/// A closed box or ball with the same emission and albedo everywhere, its inside the front or the back.
fn enclosure(shape: Shape, albedo: f32) -> World {
    let mut material = gray(albedo);
    material.emission = Some(Emission { radiance: Rgb::WHITE.into(), two_sided: true });
    let mut scene = Scene::default();
    scene.settings.normals = Normals::Flat;
    put(&mut scene, shape, material, Affine3A::IDENTITY);
    world(scene)
}

fn inside() -> Camera {
    Camera::looking_at(Vec3::new(0.2, 0.1, 0.3), Vec3::new(1.0, 0.3, -0.2), Vec3::Y, 1.2)
}

/// Closed shapes around the origin.
fn enclosures() -> [(&'static str, Shape); 3] {
    [
        ("sphere", Shape::Sphere { radius: 1.0 }),
        ("box", Shape::Mesh(generate::cuboid(Vec3::splat(2.0), [1, 1, 1]))),
        ("icosphere", Shape::Mesh(generate::icosphere(1.0, 1))),
    ]
}

#[test]
fn f1_after_k_scatterings_an_enclosure_shows_k_terms_of_the_series() {
    let albedo = 0.8;
    for (name, shape) in enclosures() {
        let world = enclosure(shape, albedo);
        for k in 0..=3 {
            let truth = (1.0 - libm::pow(f64::from(albedo), f64::from(k + 1))) / (1.0 - f64::from(albedo));
            // Before roulette begins a plain path sees the same on every way.
            expect_exactly(name, &world, &inside(), truth, &[Name::PlainPath { max_depth: k }]);
            expect(name, &world, &inside(), truth, &[Name::Path { max_depth: k }]);
        }
        expect(name, &world, &inside(), 1.0 + f64::from(albedo), &[DIRECT]);
    }
}

#[test]
fn f1_an_enclosure_shows_emission_over_one_minus_albedo() {
    let world = World::build(furnace(Rgb::gray(0.5), Rgb::gray(3.0))).unwrap();
    expect("sphere", &world, &inside(), 6.0, &[PATH, PLAIN]);
    let world = enclosure(enclosures()[1].1.clone(), 0.9);
    expect("box", &world, &inside(), 10.0, &[PATH, PLAIN]);
    // Into a corner, where neighbours are near.
    expect("corner", &world, &aimed(Vec3::ZERO, Vec3::new(0.9995, 0.9996, 0.9997)), 10.0, &[PATH]);
}

#[test]
fn f2_a_point_light_in_the_middle_of_a_sphere() {
    let mut scene = Scene::default();
    put(&mut scene, Shape::Sphere { radius: 1.0 }, gray(0.5), Affine3A::IDENTITY);
    scene.lights.push(Light::Point { position: Vec3::ZERO, intensity: Rgb::gray(std::f32::consts::PI) });
    let world = world(scene);
    for k in 1..=3 {
        let truth = 1.0 - libm::pow(0.5, f64::from(k));
        expect_exactly("point in sphere", &world, &inside(), truth, &[Name::Path { max_depth: k }]);
    }
    expect_exactly("direct part", &world, &inside(), 0.5, &[DIRECT]);
    expect("point in sphere", &world, &inside(), 1.0, &[PATH]);
}

#[test]
fn f3_a_sphere_that_glows_in_part_has_the_same_indirect_light_everywhere() {
    let mut scene = Scene::default();
    let quarter = Image::from_pixels(4, 1, vec![Rgb::WHITE, Rgb::BLACK, Rgb::BLACK, Rgb::BLACK]).unwrap();
    let image = luch::scene::Id::new(0);
    scene.images.push(Bitmap::from_rgb(&quarter).into());
    let texture = scene.add_texture(Texture::Image {
        image,
        encoding: luch::image::Encoding::Linear,
        wrap: [Wrap::Clamp; 2],
        filter: TextureFilter::Nearest,
    });
    let mut material = gray(0.6);
    let radiance = ColorValue { factor: Rgb::gray(2.0), ..ColorValue::textured(TextureUse::new(texture)) };
    material.emission = Some(Emission { radiance, two_sided: true });
    put(&mut scene, Shape::Sphere { radius: 1.0 }, material, Affine3A::IDENTITY);
    let world = world(scene);
    let indirect = 0.6 * 2.0 * 0.25 / 0.4;
    // u runs eastward from −Z: the first quarter glows from −Z to −X.
    let glowing = Vec3::new(-0.5, 0.3, -0.5);
    expect("dark part", &world, &aimed(Vec3::new(0.1, 0.0, 0.2), -glowing), indirect, &[PATH, PLAIN]);
    expect("glowing part", &world, &aimed(Vec3::new(0.1, 0.0, 0.2), glowing), indirect + 2.0, &[PATH, PLAIN]);
    expect("one scattering", &world, &aimed(Vec3::new(0.1, 0.0, 0.2), -glowing), 0.6 * 2.0 * 0.25, &[DIRECT]);
}

#[test]
fn f4_concentric_spheres() {
    let mut scene = Scene::default();
    let mut inner = gray(0.5);
    inner.emission = Some(Emission::constant(Rgb::WHITE));
    put(&mut scene, Shape::Sphere { radius: 0.5 }, inner, Affine3A::IDENTITY);
    put(&mut scene, Shape::Sphere { radius: 1.0 }, gray(0.8), Affine3A::IDENTITY);
    let world = world(scene);
    let eye = Vec3::new(0.0, 0.8, 0.1);
    expect("inner sphere", &world, &aimed(eye, Vec3::ZERO), 4.0 / 3.0, &[PATH, PLAIN]);
    expect("outer sphere", &world, &aimed(eye, Vec3::new(0.3, 2.0, -0.4)), 2.0 / 3.0, &[PATH, PLAIN]);
    // One scattering on the outer sphere sees the inner one under the form factor 1/4.
    expect("direct", &world, &aimed(eye, Vec3::new(0.3, 2.0, -0.4)), 0.8 * 0.25, &[DIRECT]);
}

#[test]
fn f5_parallel_planes_that_reach_far() {
    // The edges are two thousand gaps away: less than a millionth of the light is lost there.
    const RADIUS: f32 = 2000.0;
    let mut scene = Scene::default();
    let mut lower = gray(0.5);
    lower.emission = Some(Emission::constant(Rgb::WHITE));
    put(&mut scene, Shape::Disc { radius: RADIUS }, lower, Affine3A::IDENTITY);
    put(&mut scene, Shape::Disc { radius: RADIUS }, gray(0.8), Affine3A::from_translation(Vec3::Y));
    let world = world(scene);
    let eye = Vec3::new(0.0, 0.5, 0.0);
    expect("glowing plane", &world, &aimed(eye, Vec3::new(0.3, 0.0, 0.2)), 5.0 / 3.0, &[PATH, PLAIN]);
    expect("other plane", &world, &aimed(eye, Vec3::new(0.3, 1.0, 0.2)), 4.0 / 3.0, &[PATH, PLAIN]);
    expect("direct", &world, &aimed(eye, Vec3::new(0.3, 1.0, 0.2)), 0.8, &[DIRECT]);
}

/// Convex bodies about the origin.
fn convex() -> [(&'static str, Shape); 4] {
    [
        ("sphere", Shape::Sphere { radius: 1.0 }),
        ("cuboid", Shape::Mesh(generate::cuboid(Vec3::new(1.0, 0.7, 1.2), [2, 1, 1]))),
        ("icosphere", Shape::Mesh(generate::icosphere(1.0, 2))),
        ("cone", Shape::Mesh(generate::cone(0.9, 0.0, 1.5, 16, 2, true))),
    ]
}

/// The body alone in light of radiance 1, its triangles flat.
fn in_white(shape: Shape, material: Material) -> Scene {
    let mut scene = material_ball(shape, material);
    scene.settings.normals = Normals::Flat;
    scene.instances[0].placement = Affine3A::from_quat(Quat::from_euler(glam::EulerRot::XYZ, 0.5, 0.7, 0.2));
    scene
}

#[test]
fn f6_a_convex_body_in_uniform_light_shows_its_albedo_and_a_white_one_vanishes() {
    for (name, shape) in convex() {
        let scene = in_white(shape.clone(), gray(0.6));
        let camera = aimed(Vec3::new(0.0, 0.0, 4.0), Vec3::new(0.21, -0.13, 0.0));
        let body = world(scene);
        expect_exactly(name, &body, &camera, 0.6, &[PLAIN]);
        expect(name, &body, &camera, 0.6, &[PATH, DIRECT]);
        let scene = in_white(shape, gray(1.0));
        let camera = scene.cameras[0].camera;
        expect_exactly(name, &world(scene), &camera, 1.0, &[PLAIN]);
    }
}

#[test]
fn f7_white_concave_bodies_vanish_too() {
    let wedge = {
        let mut mesh = parallelogram(Vec3::new(0.0, -0.8, -1.0), Vec3::new(0.4, 0.0, 2.0), Vec3::Y * 1.6);
        mesh.append(&parallelogram(Vec3::new(0.0, -0.8, -1.0), Vec3::new(-0.4, 0.0, 2.0), Vec3::Y * 1.6), 0);
        mesh
    };
    // A cylinder open at one end: the upper cap is left out.
    let cup = {
        let mut mesh = generate::cylinder(0.6, 1.2, 24, 1, true);
        let heights: Vec<f32> = mesh.positions.iter().map(|p| p.y).collect();
        let top = heights.iter().copied().fold(f32::MIN, f32::max);
        mesh.triangles.retain(|corners| !corners.iter().all(|&i| heights[i as usize] >= top - 1e-4));
        luch::mesh::TriangleMesh::new(mesh.positions, mesh.triangles)
    };
    let torus = generate::torus(0.7, 0.28, 24, 12);
    for (name, mesh, turned) in [("wedge", wedge, 0.0), ("cup", cup, 1.3), ("torus", torus, 0.8)] {
        let mut scene = in_white(Shape::Mesh(mesh), gray(1.0));
        scene.instances[0].placement = Affine3A::from_rotation_x(turned);
        let camera = scene.cameras[0].camera;
        let world = world(scene);
        expect_exactly(name, &world, &camera, 1.0, &[PLAIN]);
        expect(name, &world, &camera, 1.0, &[PATH]);
    }
}

#[test]
fn f8_what_absorbs_nothing_vanishes() {
    let glass = |ior: f32, roughness: f32| {
        Material::new(Surface::Dielectric { ior, roughness: roughness.into(), tint: Rgb::WHITE.into() })
    };
    let mirror = |roughness: f32| {
        let reflectance = Reflectance::Color(Rgb::WHITE.into());
        Material::new(Surface::Conductor { reflectance, roughness: roughness.into(), compensated: true })
    };
    for (name, shape) in convex() {
        for ior in [1.33, 1.5, 2.4, 0.7] {
            let scene = in_white(shape.clone(), glass(ior, 0.0));
            let camera = scene.cameras[0].camera;
            let world = world(scene);
            expect_exactly(&format!("{name} of index {ior}"), &world, &camera, 1.0, &[PATH]);
            // A plain path plays roulette with radiance as it is inside, which costs variance: one index will do.
            if ior == 1.5 {
                expect(&format!("{name} of index {ior}"), &world, &camera, 1.0, &[PLAIN]);
            }
        }
        let scene = in_white(shape.clone(), mirror(0.0));
        let camera = scene.cameras[0].camera;
        expect_exactly(name, &world(scene), &camera, 1.0, &[PATH, PLAIN]);
    }
    for roughness in [0.25, 0.5, 1.0] {
        for (name, material) in [("mirror", mirror(roughness)), ("glass", glass(1.5, roughness))] {
            let scene = in_white(Shape::Sphere { radius: 1.0 }, material);
            let camera = aimed(Vec3::new(0.0, 0.0, 4.0), Vec3::new(0.43, 0.3, 0.0));
            expect(&format!("{name} of roughness {roughness}"), &world(scene), &camera, 1.0, &[PATH, PLAIN]);
        }
    }
}

#[test]
fn a_black_body_in_white_light_is_black_and_an_absorbing_lamp_shows_itself() {
    let scene = in_white(Shape::Sphere { radius: 1.0 }, black());
    let camera = aimed(Vec3::new(0.0, 0.0, 4.0), Vec3::ZERO);
    expect_exactly("black", &world(scene), &camera, 0.0, &[PATH, PLAIN, DIRECT]);
    let scene = in_white(Shape::Sphere { radius: 1.0 }, lamp(0.25));
    expect_exactly("lamp", &world(scene), &camera, 0.25, &[PATH, PLAIN, DIRECT]);
}

#[test]
fn f11_a_lambert_plane_under_a_uniform_sky() {
    let mut scene = Scene::default();
    floor(&mut scene, 0.7);
    surround(&mut scene, 2.0);
    let camera = aimed(Vec3::new(1.0, 2.0, 0.5), Vec3::ZERO);
    let open = world(scene.clone());
    expect_exactly("open sky", &open, &camera, 1.4, &[PLAIN]);
    expect("open sky", &open, &camera, 1.4, &[PATH, DIRECT]);
    // An endless black wall hides half of it, wherever one stands.
    let upright =
        Affine3A::from_mat3_translation(Mat3::from_rotation_z(-std::f32::consts::FRAC_PI_2), Vec3::X * -0.01);
    put(&mut scene, Shape::Plane, black(), upright);
    expect("beside a wall", &world(scene), &camera, 0.7, &[PATH, PLAIN, DIRECT]);
}
