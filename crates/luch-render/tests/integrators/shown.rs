//! What inspection and occlusion show of scenes whose answer is known.

use glam::{Affine3A, Vec2, Vec3};
use luch_image::Rgb;
use luch_mesh::{Attribute, generate};
use luch_render::{Film, Inspect, Integrator, Occlusion, Stop, View, World, render_pass};
use luch_scene::preset::parallelogram;
use luch_scene::{Camera, Filter, Material, Projection, Property, Scene, Shape};
use std::sync::atomic::AtomicU64;

const SIZE: u32 = 24;

fn scene_of(shape: Shape, camera: Camera) -> Scene {
    let mut scene = Scene::default();
    let gray = scene.add_material(Material::diffuse(Rgb::gray(0.5)));
    let shape = scene.add_shape(shape);
    scene.add_instance(shape, gray, Affine3A::IDENTITY);
    scene.add_camera(camera);
    (scene.settings.width, scene.settings.height) = (SIZE, SIZE);
    scene.settings.filter = Filter::Box { radius: 0.5 };
    scene
}

/// The value of every sample beside the place where its ray meets the scene, given by `meets`.
fn check(scene: &Scene, property: Property, mut each: impl FnMut(luch_bvh::Ray, Rgb)) {
    let view = View::new(&scene.cameras[0].camera, &scene.settings);
    let world = World::build(scene.clone()).unwrap();
    let samples: Vec<_> = (0..SIZE * SIZE)
        .flat_map(|i| (0..3).map(move |index| ([i % SIZE, i / SIZE], index)))
        .map(|(pixel, index)| view.start(pixel, index))
        .collect();
    let mut shown = vec![Rgb::BLACK; samples.len()];
    Inspect::new(property, &view).radiance(&world, &samples, &mut shown, &Stop::new()).unwrap();
    samples.iter().zip(shown).for_each(|(sample, shown)| each(sample.ray, shown));
}

fn close(shown: Rgb, expected: Vec3, bound: f32) -> bool {
    let [r, g, b] = shown.to_array();
    (Vec3::new(r, g, b) - expected).abs().max_element() <= bound
}

/// A square of two triangles about the origin that faces +Z, with the unit square as uv.
fn square(side: f32) -> Shape {
    let corner = Vec3::new(-side / 2.0, -side / 2.0, 0.0);
    let mut mesh = parallelogram(corner, side * Vec3::X, side * Vec3::Y);
    mesh.uv_sets = vec![Attribute::per_position(vec![Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y])];
    Shape::Mesh(mesh)
}

#[test]
fn depth_is_along_the_axis() {
    // Everything of a plane across the axis has one depth, in whatever direction the camera looks.
    let mut scene =
        scene_of(square(100.0), Camera::looking_at(Vec3::new(0.0, 0.0, 3.0), Vec3::ZERO, Vec3::Y, 1.0));
    check(&scene, Property::Depth, |_, shown| assert!(close(shown, Vec3::splat(3.0), 1e-5), "{shown:?}"));
    scene.cameras[0].camera.projection = Projection::Orthographic { height: 5.0 };
    check(&scene, Property::Depth, |_, shown| assert!(close(shown, Vec3::splat(3.0), 1e-5), "{shown:?}"));
    // Obliquely seen: by similar triangles along each ray.
    scene.cameras[0].camera =
        Camera::looking_at(Vec3::new(1.0, 2.0, 3.0), Vec3::new(0.5, 0.0, 0.0), Vec3::Y, 1.0);
    let forward = -scene.cameras[0].camera.orientation.z_axis;
    check(&scene, Property::Depth, |ray, shown| {
        let depth = -ray.origin.z / ray.direction.z * ray.direction.dot(forward);
        assert!(close(shown, Vec3::splat(depth), 2e-5 * depth), "{shown:?} instead of {depth}");
    });
}

#[test]
fn normals_of_a_sphere_are_its_radii() {
    let center = Vec3::new(0.0, 0.0, 4.0);
    let scene = scene_of(Shape::Sphere { radius: 1.5 }, Camera::looking_at(center, Vec3::ZERO, Vec3::Y, 0.9));
    for property in [Property::Normal, Property::GeometricNormal] {
        let mut met = 0;
        check(&scene, property, |ray, shown| {
            let (b, c) = (ray.origin.dot(ray.direction), ray.origin.length_squared() - 1.5 * 1.5);
            let discriminant = b * b - c;
            if discriminant < -1e-3 {
                assert_eq!(shown, Rgb::BLACK);
            } else if discriminant > 1e-2 {
                met += 1;
                let normal = ray.at(-b - discriminant.sqrt()) / 1.5;
                // Near the rim the place depends steeply on the ray.
                assert!(close(shown, normal, 3e-5), "{shown:?} instead of {normal}");
            }
        });
        assert!(met > 300);
    }
}

#[test]
fn smooth_and_true_normals_are_told_apart() {
    let mesh = generate::icosphere(1.0, 2);
    let camera = Camera::looking_at(Vec3::new(0.0, 0.0, 4.0), Vec3::ZERO, Vec3::Y, 0.4);
    let scene = scene_of(Shape::Mesh(mesh), camera);
    let mut smooth = Vec::new();
    check(&scene, Property::Normal, |_, shown| smooth.push(shown));
    let mut flat = Vec::new();
    check(&scene, Property::GeometricNormal, |_, shown| flat.push(shown));
    let seen: Vec<_> = smooth.iter().zip(&flat).filter(|(_, flat)| !flat.is_black()).collect();
    let vector = |rgb: &Rgb| Vec3::from(rgb.to_array());
    let cosine = |(a, b): &(&Rgb, &Rgb)| vector(a).dot(vector(b));
    assert!(seen.len() > 500 && seen.iter().all(|pair| cosine(pair) > 0.95));
    assert!(seen.iter().filter(|pair| cosine(pair) < 0.9999).count() > seen.len() / 4);
}

#[test]
fn uv_and_barycentrics_are_linear_on_a_triangle() {
    let mut scene =
        scene_of(square(2.0), Camera::looking_at(Vec3::new(0.0, 0.0, 3.0), Vec3::ZERO, Vec3::Y, 0.5));
    let place = |ray: luch_bvh::Ray| ray.at(-ray.origin.z / ray.direction.z);
    check(&scene, Property::Uv, |ray, shown| {
        let at = place(ray);
        let uv = Vec3::new((at.x + 1.0) / 2.0, (at.y + 1.0) / 2.0, 0.0);
        assert!(close(shown, uv, 1e-5), "{shown:?} instead of {uv}");
    });
    check(&scene, Property::Barycentric, |_, shown| {
        let sum: f32 = shown.to_array().iter().sum();
        assert!(
            (sum - 1.0).abs() <= 2e-7 && shown.to_array().iter().all(|w| (-1e-6..=1.0 + 1e-6).contains(w)),
            "{shown:?}"
        );
    });
    // Toward the corners the whole range appears.
    scene.cameras[0].camera.projection = Projection::Orthographic { height: 2.0 };
    let (mut least, mut most) = (Vec2::ONE, Vec2::ZERO);
    check(&scene, Property::Uv, |_, shown| {
        least = least.min(Vec2::new(shown.r, shown.g));
        most = most.max(Vec2::new(shown.r, shown.g));
    });
    let pixel = 1.0 / SIZE as f32;
    assert!(least.max_element() < pixel && most.min_element() > 1.0 - pixel, "{least} to {most}");
}

#[test]
fn ids_differ_and_albedo_is_the_colour() {
    let mut scene = luch_scene::preset::cornell_box();
    (scene.settings.width, scene.settings.height) = (SIZE, SIZE);
    let distinct = |property| {
        let mut seen: Vec<[u32; 3]> = Vec::new();
        check(&scene, property, |_, shown| {
            let bits = shown.to_array().map(f32::to_bits);
            if !shown.is_black() && !seen.contains(&bits) {
                seen.push(bits);
            }
        });
        seen.len()
    };
    assert_eq!((distinct(Property::Instance), distinct(Property::Material)), (8, 4));
    assert!(distinct(Property::Primitive) > 14);
    let colors = [[0.73; 3], [0.63, 0.06, 0.05], [0.14, 0.45, 0.09], [1.0; 3], [0.0; 3]];
    check(&scene, Property::Albedo, |_, shown| assert!(colors.contains(&shown.to_array()), "{shown:?}"));
}

fn occlusion_of(scene: Scene, distance: f32) -> Vec<f32> {
    let view = View::new(&scene.cameras[0].camera, &scene.settings);
    let world = World::build(scene).unwrap();
    let mut film = Film::new(SIZE, SIZE);
    let integrator = Occlusion { distance };
    render_pass(&world, &view, &integrator, &mut film, 0..16, &Stop::new(), &AtomicU64::new(0)).unwrap();
    film.to_image().pixels().iter().map(|rgb| rgb.g).collect()
}

#[test]
fn an_open_plane_is_open_and_a_closed_box_is_closed() {
    let camera = Camera::looking_at(Vec3::new(0.0, 2.0, 3.0), Vec3::ZERO, Vec3::Y, 1.0);
    for shape in [Shape::Plane, Shape::Disc { radius: 50.0 }, Shape::Sphere { radius: 1.0 }] {
        assert!(occlusion_of(scene_of(shape, camera), f32::INFINITY).iter().all(|v| *v == 1.0));
    }
    let inside = Camera::looking_at(Vec3::new(0.1, 0.2, 0.3), Vec3::X, Vec3::Y, 1.0);
    let cuboid = Shape::Mesh(generate::cuboid(Vec3::splat(2.0), [1, 1, 1]));
    for shape in [cuboid, Shape::Sphere { radius: 1.0 }] {
        assert!(occlusion_of(scene_of(shape.clone(), inside), f32::INFINITY).iter().all(|v| *v == 0.0));
        // Nothing is as near as that, but in the corners.
        let near = occlusion_of(scene_of(shape, inside), 1e-3);
        assert!(near.iter().filter(|v| **v == 1.0).count() > near.len() * 9 / 10);
    }
}

#[test]
fn a_wall_hides_half_the_sky() {
    // At the foot of a wall without end half the cosine-weighted hemisphere is open, by symmetry; this one is a kilometre high and
    // seen a centimetre away.
    let mut scene = scene_of(
        Shape::Plane,
        Camera::looking_at(Vec3::new(0.0, 1.0, 0.3), Vec3::new(0.0, 0.0, 0.01), Vec3::Z, 1e-3),
    );
    let wall = scene.add_shape(Shape::Mesh(parallelogram(
        Vec3::new(-1e3, -1e3, 0.0),
        Vec3::new(0.0, 2e3, 0.0),
        Vec3::new(2e3, 0.0, 0.0),
    )));
    scene.add_instance(wall, luch_scene::Id::new(0), Affine3A::IDENTITY);
    let open = occlusion_of(scene, f32::INFINITY);
    let mut estimate = luch_sampling::Estimate::new();
    open.iter().for_each(|v| estimate.add(f64::from(*v)));
    let z = estimate.z_score(0.5).unwrap();
    assert!(z.abs() < 4.0 && estimate.standard_error().unwrap() < 0.01, "{:?}, z = {z}", estimate.mean());
}
