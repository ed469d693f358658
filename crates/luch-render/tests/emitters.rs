//! What every emitter promises, asked through [`Lights`](luch_render::Lights).

use glam::{Affine3A, Mat3, Vec3};
use luch_bvh::Ray;
use luch_image::{Bitmap, Image, Rgb};
use luch_mesh::TriangleMesh;
use luch_render::{SurfacePoint, World, emitted};
use luch_sampling::check::{FitSettings, SphereMap, density_fit, sidak};
use luch_sampling::warp::{Cone, sphere, sphere_pdf};
use luch_sampling::{Domain, Estimate, Frame, Sampler, Sequence, mis};
use luch_scene::{Camera, Emission, Environment, Id, Light, Material, Scene, Shape, Surface};
use std::f32::consts::PI;

/// Replicates of an estimate, and samples of each.
const REPLICATES: u32 = 64;
const SAMPLES: u64 = 2048;

/// One emitter, a place that receives its light, and what is known.
struct Case {
    name: &'static str,
    world: World,
    from: Vec3,
    /// A cone that holds the whole emitter, for sampling without it.
    window: Option<(Vec3, f32)>,
    /// Irradiance on surfaces with these normals.
    known: Vec<(Vec3, f64)>,
    /// How much of the light is left to light sampling.
    sampled: Sampled,
}

/// How much of its light an emitter leaves to light sampling.
#[derive(Clone, Copy, PartialEq)]
enum Sampled {
    /// Light sampling alone gives the irradiance.
    All,
    /// It gives it together with directions that are drawn another way.
    Some,
    /// It draws nothing.
    Nothing,
}

fn glowing(two_sided: bool) -> Material {
    Material {
        emission: Some(Emission { radiance: Rgb::gray(2.0).into(), two_sided }),
        ..Material::new(Surface::Absorber)
    }
}

/// The world of a scene; the camera that scenes must have sees nothing here.
fn built(mut scene: Scene) -> World {
    scene.add_camera(Camera::looking_at(Vec3::ZERO, Vec3::X, Vec3::Y, 1.0));
    World::build(scene).expect("the scene is sound")
}

fn alone(shape: Shape, two_sided: bool, placement: Affine3A) -> World {
    let mut scene = Scene::default();
    let (shape, material) = (scene.add_shape(shape), scene.add_material(glowing(two_sided)));
    scene.add_instance(shape, material, placement);
    built(scene)
}

fn under(environment: impl FnOnce(&mut Scene) -> Environment) -> World {
    let mut scene = Scene::default();
    scene.environment = Some(environment(&mut scene));
    built(scene)
}

fn case(name: &'static str, world: World, from: Vec3) -> Case {
    Case { name, world, from, window: None, known: Vec::new(), sampled: Sampled::All }
}

/// A polygon's vector irradiance: half the sum over edges of angle times unit normal (Lambert), for radiance 2.
fn lambert(from: Vec3, corners: &[Vec3], normal: Vec3) -> f64 {
    let toward: Vec<_> = corners.iter().map(|&c| (c - from).as_dvec3().normalize()).collect();
    let edge = |i: usize| {
        let (a, b) = (toward[i], toward[(i + 1) % toward.len()]);
        let across = a.cross(b);
        across.normalize() * libm::atan2(across.length(), a.dot(b))
    };
    (0..toward.len()).map(edge).sum::<glam::DVec3>().dot(normal.as_dvec3()).abs()
}

/// A flat lamp with these corners.
fn polygon(name: &'static str, shape: Shape, corners: &[Vec3], from: Vec3, two_sided: bool) -> Case {
    let axis = (corners.iter().sum::<Vec3>() / corners.len() as f32 - from).normalize();
    let half_angle = corners.iter().map(|&c| axis.angle_between(c - from)).fold(0.0, f32::max) * 1.05;
    // Wholly above the horizon of a surface that faces it.
    let known = if half_angle < 1.4 { vec![(axis, lambert(from, corners, axis))] } else { vec![] };
    let world = alone(shape, two_sided, Affine3A::IDENTITY);
    assert_eq!(world.lights.count(), 1, "{name}");
    Case { window: Some((axis, half_angle)), known, ..case(name, world, from) }
}

/// Two triangles that are one lamp.
fn quads() -> Vec<Case> {
    let corner = Vec3::new(-0.5, 1.0, -0.4);
    let placed = |name, edges: [Vec3; 2], from: Vec3, two_sided| {
        let corners = [corner, corner + edges[0], corner + edges[0] + edges[1], corner + edges[1]];
        let shape = Shape::Mesh(TriangleMesh::new(corners.to_vec(), vec![[0, 1, 2], [2, 3, 0]]));
        polygon(name, shape, &corners, from, two_sided)
    };
    let right = [Vec3::new(1.0, 0.25, 0.0), Vec3::new(0.0, 0.0, 0.75)];
    let skew = [Vec3::new(1.0, 0.25, 0.5), Vec3::new(0.25, 0.0, 0.75)];
    let long = [Vec3::new(4.0, 0.0, 0.0), Vec3::new(0.0, 0.0, 0.5)];
    vec![
        placed("rectangle", right, Vec3::new(0.1, 0.0, 0.2), false),
        placed("rectangle, very near", right, Vec3::new(-0.2, 0.95, 0.05), false),
        placed("rectangle, far", right, Vec3::new(3.0, -12.0, 5.0), false),
        placed("rectangle, from behind its two sides", right, Vec3::new(0.2, 2.2, 0.1), true),
        placed("rectangle, long", long, Vec3::new(1.0, -1.0, 0.1), false),
        placed("parallelogram", skew, Vec3::new(0.1, 0.0, 0.2), false),
        placed("parallelogram, far", skew, Vec3::new(3.0, -12.0, 5.0), false),
    ]
}

fn triangles() -> Vec<Case> {
    let corners = [Vec3::new(-0.5, 1.0, -0.4), Vec3::new(0.7, 1.1, -0.3), Vec3::new(-0.1, 0.9, 0.8)];
    let shape = || Shape::Mesh(TriangleMesh::new(corners.to_vec(), vec![[0, 1, 2]]));
    let placed = |name, from, two_sided| polygon(name, shape(), &corners, from, two_sided);
    vec![
        placed("triangle", Vec3::new(0.1, 0.0, 0.2), false),
        placed("triangle, very near", Vec3::new(0.05, 0.95, 0.05), false),
        placed("triangle, far", Vec3::new(3.0, -12.0, 5.0), false),
        placed("triangle, near the change of strategy", Vec3::new(0.0, -4.5, 0.0), false),
        placed("triangle, at a flat angle", Vec3::new(0.8, 0.85, 0.6), false),
        placed("triangle, from behind its two sides", Vec3::new(0.2, 2.2, 0.1), true),
    ]
}

fn balls() -> Vec<Case> {
    let center = Vec3::new(0.2, 0.5, -0.3);
    // A similarity: three times a sphere of radius 0.2.
    let placement =
        Affine3A::from_scale_rotation_translation(Vec3::splat(3.0), glam::Quat::from_rotation_x(1.0), center);
    let outside = |name, distance: f32| {
        let axis = Vec3::new(0.48, 0.6, 0.64);
        let sine = 0.6 / distance;
        let known = vec![(axis, f64::from(2.0 * PI * sine * sine))];
        let world = alone(Shape::Sphere { radius: 0.2 }, false, placement);
        Case {
            window: Some((axis, (libm::asinf(sine) * 1.05).min(PI))),
            known,
            ..case(name, world, center - axis * distance)
        }
    };
    let inside = alone(Shape::Sphere { radius: 0.2 }, true, placement);
    let known = vec![(Vec3::Y, f64::from(2.0 * PI)), (Vec3::X, f64::from(2.0 * PI))];
    vec![
        outside("sphere", 1.2),
        outside("sphere, far", 40.0),
        outside("sphere, very near", 0.61),
        Case { known, ..case("sphere from inside", inside, center + Vec3::new(0.2, 0.1, -0.25)) },
    ]
}

fn discs() -> Vec<Case> {
    let placed = |name, distance: f32, two_sided, turned: f32| {
        let world = alone(Shape::Disc { radius: 0.5 }, two_sided, Affine3A::from_scale(Vec3::splat(2.0)));
        let from = Vec3::new(0.0, distance * turned, 0.0);
        let toward = Vec3::NEG_Y * turned;
        let factor = 1.0 / (1.0 + f64::from(distance) * f64::from(distance));
        let half_angle = libm::atanf(1.0 / distance) * 1.02;
        let known = vec![(toward, f64::from(2.0 * PI) * factor)];
        Case { window: Some((toward, half_angle)), known, ..case(name, world, from) }
    };
    vec![
        placed("disc", 0.8, false, 1.0),
        placed("disc, near", 0.2, false, 1.0),
        placed("disc, far", 30.0, false, 1.0),
        placed("disc, behind its two sides", 1.0, true, -1.0),
    ]
}

/// A sky of little light with a hot pixel and black ones beside it.
fn hot_sky(scene: &mut Scene) -> Environment {
    let (width, height) = (16, 8);
    let mut pixels = vec![Rgb::gray(0.2); width * height];
    pixels[2 * width + 5] = Rgb::gray(30.0);
    for dark in [2 * width + 4, 2 * width + 6, width + 5, 3 * width + 5, 7 * width] {
        pixels[dark] = Rgb::BLACK;
    }
    scene
        .images
        .push(Bitmap::from_rgb(&Image::from_pixels(width as u32, height as u32, pixels).unwrap()).into());
    let rotation = Mat3::from_euler(glam::EulerRot::XYZ, 0.4, 1.0, 0.2);
    Environment::LatLong { image: Id::new(0), scale: Rgb::gray(1.0), rotation }
}

fn distant() -> Vec<Case> {
    let constant = under(|_| Environment::Constant { radiance: Rgb::gray(2.0) });
    let even = under(|scene| {
        scene.images.push(Bitmap::from_rgb(&Image::filled(8, 4, Rgb::gray(0.5))).into());
        Environment::LatLong { image: Id::new(0), scale: Rgb::gray(4.0), rotation: Mat3::IDENTITY }
    });
    let known = vec![(Vec3::Y, f64::from(2.0 * PI)), (Vec3::new(0.6, 0.0, -0.8), f64::from(2.0 * PI))];
    let mut cases = vec![
        Case {
            known: known.clone(),
            sampled: Sampled::Nothing,
            ..case("constant sky", constant, Vec3::ZERO)
        },
        Case { known, sampled: Sampled::Nothing, ..case("even picture", even, Vec3::ZERO) },
        Case { sampled: Sampled::Some, ..case("hot picture", under(hot_sky), Vec3::ZERO) },
    ];
    for (name, angular_radius) in [("sun", 0.004_65), ("large sun", 0.3), ("tiny sun", 5e-4)] {
        let mut scene = Scene::default();
        let direction = Vec3::new(0.48, -0.6, 0.64);
        scene.lights.push(Light::Sun { direction, irradiance: Rgb::gray(3.0), angular_radius });
        let known = vec![(-direction, 3.0), (Vec3::Y, f64::from(3.0 * 0.6_f32))];
        let window = Some((-direction, angular_radius * 1.05));
        cases.push(Case { window, known, ..case(name, built(scene), Vec3::ZERO) });
    }
    cases
}

fn cases() -> Vec<Case> {
    [triangles(), quads(), balls(), discs(), distant()].into_iter().flatten().collect()
}

/// What a ray finds by itself: light and the density of light sampling for it.
struct Found {
    radiance: f64,
    pdf: f64,
}

fn find(case: &Case, direction: Vec3) -> Found {
    let World { scene, geometry, lights, .. } = &case.world;
    let ray = Ray::new(case.from, direction);
    match geometry.nearest_hit(scene, &ray, 0) {
        Some(hit) => {
            let point = SurfacePoint::new(scene, geometry, &ray, hit);
            Found {
                radiance: emitted(&point).r.into(),
                pdf: lights.pdf_of_hit(case.from, Vec3::ZERO, &point).into(),
            }
        }
        None => {
            let found = lights.beyond(scene, case.from, Vec3::ZERO, direction);
            found.fold(Found { radiance: 0.0, pdf: 0.0 }, |sum, light| Found {
                radiance: sum.radiance + f64::from(light.radiance.r),
                pdf: sum.pdf + f64::from(light.pdf),
            })
        }
    }
}

/// Replicates of a mean over points of the unit cube.
fn mean(seed: u64, mut value: impl FnMut([f32; 4]) -> f64) -> Estimate {
    let mut replicate = |pixel: u32| {
        let points =
            (0..SAMPLES).map(|i| Sampler::at(Sequence::Sobol, seed, [pixel, 0], i).group(Domain::new(0, 0)));
        points.map(&mut value).sum::<f64>() / SAMPLES as f64
    };
    (0..REPLICATES).map(&mut replicate).collect()
}

/// Mean over the directions of the case's window of a function, times the window's solid angle.
fn integral(case: &Case, seed: u64, mut value: impl FnMut(Vec3) -> f64) -> Estimate {
    let window =
        case.window.and_then(|(axis, angle)| Some((Frame::from_normal(axis), Cone::from_half_angle(angle)?)));
    mean(seed, |[u, v, ..]| match &window {
        Some((frame, cone)) => value(frame.to_world(cone.sample([u, v]))) * f64::from(cone.solid_angle()),
        None => value(sphere([u, v])) / f64::from(sphere_pdf()),
    })
}

fn within(estimate: &Estimate, truth: f64, what: &str) {
    let (mean, error) = (estimate.mean().unwrap(), estimate.standard_error().unwrap());
    // Rounding of single precision counts only where the variance vanishes.
    assert!((mean - truth).abs() <= 4.0 * error + 1e-5 * truth, "{what}: {mean} ± {error}, expected {truth}");
    assert!(error <= 0.01 * truth, "{what}: the error {error} of {truth} is too large to tell");
}

#[test]
fn drawn_directions_are_of_unit_length_lead_to_the_light_and_have_the_density_that_hits_report() {
    for case in cases() {
        let World { scene, lights, .. } = &case.world;
        let (mut drawn, mut off) = (0, 0);
        for i in 0..20_000 {
            let [u, v, choice, _] = Sampler::at(Sequence::Independent, 3, [0, 0], i).group(Domain::new(0, 0));
            let Some(sample) = lights.sample(scene, case.from, Vec3::ZERO, f64::from(choice), [u, v]) else {
                continue;
            };
            drawn += 1;
            assert!((sample.incoming.length() - 1.0).abs() < 1e-5, "{}", case.name);
            assert!(!sample.delta && sample.pdf > 0.0, "{}", case.name);
            if let Some(target) = sample.target {
                let aside = (target - case.from).normalize().distance(sample.incoming);
                // It is put before the surface, by 32 roundings of numbers of its own size; no lamp here is larger than two.
                let moved = 32.0 * f32::EPSILON * (target.abs().max_element() + 2.0);
                let allowed = 1e-5 + moved / target.distance(case.from);
                assert!(aside < allowed, "{}: the target lies {aside} beside the direction", case.name);
            }
            // At a rim or between two cells rounding decides: a neighbouring direction will do.
            let frame = Frame::from_normal(sample.incoming);
            let step = 4e-7;
            let nearby = [
                Vec3::Z,
                Vec3::new(step, 0.0, 1.0),
                Vec3::new(-step, 0.0, 1.0),
                Vec3::new(0.0, step, 1.0),
                Vec3::new(0.0, -step, 1.0),
            ];
            let agrees = |local: Vec3| {
                let found = find(&case, frame.to_world(local).normalize());
                let close = |a: f64, b: f64| (a - b).abs() <= 2e-3 * b;
                close(found.pdf, sample.pdf.into()) && close(found.radiance, sample.radiance.r.into())
            };
            off += u32::from(!nearby.into_iter().any(agrees));
        }
        match case.sampled {
            Sampled::Nothing => assert_eq!(drawn, 0, "{}", case.name),
            _ => assert!(drawn > 10_000, "{}: only {drawn} were drawn", case.name),
        }
        assert!(off * 2000 <= drawn, "{}: {off} of {drawn} disagree", case.name);
    }
}

#[test]
fn sampling_gives_the_irradiance_of_plain_sampling_and_of_the_formula() {
    for case in cases() {
        let World { scene, lights, .. } = &case.world;
        let normals = case.window.map_or([Vec3::Y, Vec3::new(0.6, 0.0, -0.8)], |(axis, _)| {
            [axis, (axis + Frame::from_normal(axis).tangent * 0.8).normalize()]
        });
        let cosine = |direction: Vec3, normal: Vec3| f64::from(direction.dot(normal).max(0.0));
        let by_light = |normal: Vec3| {
            // What light sampling leaves out, directions drawn evenly find.
            let alone = case.sampled == Sampled::All;
            let weight = |pdf: f32, other: f32| if alone { 1.0 } else { f64::from(mis::power(pdf, other)) };
            mean(6, |[u, v, choice, _]| {
                let drawn = lights.sample(scene, case.from, Vec3::ZERO, f64::from(choice), [u, v]);
                let drawn = drawn.map_or(0.0, |sample| {
                    let arriving = f64::from(sample.radiance.r) * cosine(sample.incoming, normal);
                    arriving / f64::from(sample.pdf) * weight(sample.pdf, sphere_pdf())
                });
                if alone {
                    return drawn;
                }
                let direction = sphere([u, v]);
                let Found { radiance, pdf } = find(&case, direction);
                let arriving = radiance * cosine(direction, normal) / f64::from(sphere_pdf());
                drawn + arriving * weight(sphere_pdf(), pdf as f32)
            })
        };
        for normal in normals {
            let (light, plain) = (
                by_light(normal),
                integral(&case, 7, |direction| find(&case, direction).radiance * cosine(direction, normal)),
            );
            let off = light.mean().unwrap() - plain.mean().unwrap();
            let error = libm::hypot(light.standard_error().unwrap(), plain.standard_error().unwrap());
            let truth = plain.mean().unwrap();
            assert!(off.abs() <= 4.0 * error + 1e-5 * truth, "{}: {light:?} and {plain:?} differ", case.name);
            assert!(
                error <= 0.01 * truth,
                "{}: the error {error} of {truth} is too large to tell",
                case.name
            );
        }
        for &(normal, truth) in &case.known {
            within(&by_light(normal), truth, case.name);
        }
    }
}

#[test]
fn histograms_of_drawn_directions_follow_the_density() {
    let cases = cases();
    for case in &cases {
        let World { scene, lights, .. } = &case.world;
        let map = SphereMap::about(case.window.map_or(Vec3::Y, |(axis, _)| axis));
        let fit = density_fit(
            SphereMap::AREA,
            FitSettings::default(),
            |[u, v, choice, _]| {
                let sample = lights.sample(scene, case.from, Vec3::ZERO, f64::from(choice), [u, v])?;
                Some(map.place(sample.incoming))
            },
            |place| find(case, map.direction(place)).pdf,
        );
        assert_eq!(fit.drawn == 0, case.sampled == Sampled::Nothing, "{}: {fit:?}", case.name);
        assert!(fit.agrees(sidak(0.01, cases.len() as u32)), "{}: {fit:?}", case.name);
    }
}

#[test]
fn one_sided_emitters_are_dark_from_behind_and_inside() {
    let disc = alone(Shape::Disc { radius: 1.0 }, false, Affine3A::IDENTITY);
    let ball = alone(Shape::Sphere { radius: 1.0 }, false, Affine3A::IDENTITY);
    let corners = vec![Vec3::X, Vec3::NEG_X, Vec3::Z];
    let triangle = alone(Shape::Mesh(TriangleMesh::new(corners, vec![[0, 1, 2]])), false, Affine3A::IDENTITY);
    let behind_triangle = Vec3::new(0.0, 0.5, 0.2) * -triangle_side();
    for (name, world, from) in [
        ("disc", disc, Vec3::NEG_Y),
        ("ball", ball, Vec3::new(0.1, 0.2, 0.3)),
        ("triangle", triangle, behind_triangle),
    ] {
        for i in 0..256 {
            let [u, v, choice, _] = Sampler::at(Sequence::Sobol, 1, [0, 0], i).group(Domain::new(0, 0));
            let sample = world.lights.sample(&world.scene, from, Vec3::ZERO, f64::from(choice), [u, v]);
            assert_eq!(sample, None, "{name}");
        }
    }
}

/// +1 if the triangle X, −X, Z faces +Y.
fn triangle_side() -> f32 {
    (Vec3::NEG_X - Vec3::X).cross(Vec3::Z - Vec3::X).y.signum()
}
