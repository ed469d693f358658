//! Which emitter is picked for a receiver: chances add up, picks follow them, and nothing is lost or counted twice.

use glam::{Affine3A, Mat3, Quat, Vec3};
use luch_bvh::Ray;
use luch_image::{Bitmap, Image, Rgb};
use luch_mesh::TriangleMesh;
use luch_render::{EmitterSample, Receiver, SurfacePoint, World};
use luch_sampling::warp::sphere;
use luch_sampling::{Domain, Estimate, Sampler, Sequence};
use luch_scene::{Camera, Emission, Environment, Id, Light, Material, Scene, Shape, Surface};

fn built(mut scene: Scene) -> World {
    scene.add_camera(Camera::looking_at(Vec3::ZERO, Vec3::X, Vec3::Y, 1.0));
    World::build(scene).expect("the scene is sound")
}

fn glowing(scene: &mut Scene, radiance: f32, two_sided: bool) -> Id<Material> {
    scene.add_material(Material {
        emission: Some(Emission { radiance: Rgb::gray(radiance).into(), two_sided }),
        ..Material::new(Surface::Absorber)
    })
}

/// Four random numbers for thing `index`.
fn random(seed: u64, index: u64, purpose: u32) -> [f32; 4] {
    Sampler::at(Sequence::Independent, seed, [0, 0], index).group(Domain::new(0, purpose))
}

/// A triangle of about the size `size`.
fn small_triangle(seed: u64, index: u64, center: Vec3, size: f32) -> [Vec3; 3] {
    let corner = |i: u32| center + (Vec3::from_slice(&random(seed, index, i + 1)[..3]) - 0.5) * size;
    [corner(0), corner(1), corner(2)]
}

/// `count` lamps of every kind in a box, of powers over four decades.
fn mixed(count: u64) -> Scene {
    let mut scene = Scene::default();
    for i in 0..count {
        let [x, y, z, power] = random(11, i, 0);
        let center = Vec3::new(x, y, z) * 10.0;
        let strength = libm::powf(10.0, 4.0 * power - 2.0);
        let [s, t, turn, sides] = random(11, i, 9);
        let direction = sphere([s, t]);
        let placement =
            Affine3A::from_rotation_translation(Quat::from_rotation_arc(Vec3::Y, direction), center);
        let two_sided = sides < 0.3;
        let intensity = Rgb::gray(strength * 0.1);
        match i % 6 {
            0 => scene.lights.push(Light::Point { position: center, intensity }),
            1 => scene.lights.push(Light::Spot {
                position: center,
                direction,
                intensity,
                inner_angle: turn,
                outer_angle: turn + sides,
            }),
            2 => {
                let material = glowing(&mut scene, strength, false);
                let shape = scene.add_shape(Shape::Sphere { radius: 0.05 + 0.2 * turn });
                scene.add_instance(shape, material, placement);
            }
            3 => {
                let material = glowing(&mut scene, strength, two_sided);
                let shape = scene.add_shape(Shape::Disc { radius: 0.1 + 0.2 * turn });
                scene.add_instance(shape, material, placement);
            }
            _ => {
                let material = glowing(&mut scene, strength, two_sided);
                let corners = small_triangle(12, i, center, 0.6).to_vec();
                let shape = scene.add_shape(Shape::Mesh(TriangleMesh::new(corners, vec![[0, 1, 2]])));
                scene.add_instance(shape, material, Affine3A::IDENTITY);
            }
        }
    }
    scene
}

/// One mesh of many glowing triangles.
fn glowing_mesh(count: u64) -> Scene {
    let mut scene = Scene::default();
    let corners: Vec<Vec3> = (0..count)
        .flat_map(|i| {
            let [x, y, z, _] = random(21, i, 0);
            small_triangle(22, i, Vec3::new(x * 10.0, y, z * 10.0), 0.05)
        })
        .collect();
    let triangles = (0..count as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    let material = glowing(&mut scene, 2.0, false);
    let shape = scene.add_shape(Shape::Mesh(TriangleMesh::new(corners, triangles)));
    scene.add_instance(shape, material, Affine3A::IDENTITY);
    scene
}

fn under_sky(mut scene: Scene) -> Scene {
    let mut pixels = vec![Rgb::gray(0.1); 16 * 8];
    pixels[37] = Rgb::gray(40.0);
    scene.images.push(Bitmap::from_rgb(&Image::from_pixels(16, 8, pixels).unwrap()).into());
    let image = Id::new(scene.images.len() as u32 - 1);
    scene.environment = Some(Environment::LatLong { image, scale: Rgb::gray(1.0), rotation: Mat3::IDENTITY });
    for (x, angular_radius) in [(0.6, 0.0), (-0.6, 0.1)] {
        let direction = Vec3::new(x, -0.8, 0.0);
        scene.lights.push(Light::Sun { direction, irradiance: Rgb::gray(1.5), angular_radius });
    }
    scene
}

struct Place {
    from: Vec3,
    normal: Vec3,
}

/// Places among the lamps, on them, before and behind all of them, far away and not anywhere.
fn receivers(world: &World) -> Vec<Place> {
    let mut receivers: Vec<Place> = (0..24)
        .map(|i| {
            let [x, y, z, s] = random(31, i, 0);
            let normal = if i % 3 == 0 { Vec3::ZERO } else { sphere([s, random(31, i, 1)[0]]) };
            Place { from: Vec3::new(x, y, z) * 14.0 - 2.0, normal }
        })
        .collect();
    if let Some(lamp) = world.lights.flat_lamps().first() {
        for normal in [lamp.normal, -lamp.normal, Vec3::ZERO] {
            receivers.push(Place { from: lamp.center(), normal });
            receivers.push(Place { from: lamp.corner, normal });
        }
    }
    for instance in world.scene.instances.iter().take(6) {
        receivers.push(Place { from: instance.placement.translation.into(), normal: Vec3::Y });
    }
    for light in &world.scene.lights {
        if let Light::Point { position, .. } | Light::Spot { position, .. } = *light {
            receivers.push(Place { from: position, normal: Vec3::X });
        }
    }
    receivers.truncate(48);
    for far in [1e3, 1e6, 1e18, 3e38] {
        receivers.push(Place { from: Vec3::new(far, -far, far), normal: Vec3::NEG_X });
        receivers.push(Place { from: Vec3::new(far, -far, far), normal: Vec3::ZERO });
    }
    receivers
}

#[test]
fn picks_follow_chances_and_chances_add_to_one_with_that_of_no_light() {
    let sky = || under_sky(Scene::default());
    let scenes =
        [mixed(1), mixed(2), mixed(8), mixed(9), mixed(400), under_sky(mixed(60)), sky(), glowing_mesh(3000)];
    for (number, scene) in scenes.into_iter().enumerate() {
        let world = built(scene);
        let lights = &world.lights;
        for (place, Place { from, normal }) in receivers(&world).into_iter().enumerate() {
            let draws = 1 << 14;
            let mut counts = vec![0i64; lights.count()];
            let mut none = 0i64;
            for i in 0..draws {
                match lights.choose(from, normal, (f64::from(i) + 0.5) / f64::from(draws)) {
                    Some(chosen) => {
                        counts[chosen.emitter as usize] += 1;
                        let told = lights.probability(chosen.emitter, from, normal);
                        assert_eq!(told, chosen.probability, "scene {number}, receiver {place}");
                        assert!(told > 0.0 && told <= 1.0, "scene {number}, receiver {place}");
                    }
                    None => none += 1,
                }
            }
            let mut sum = 0.0;
            for (emitter, count) in counts.iter().enumerate() {
                let probability = f64::from(lights.probability(emitter as u32, from, normal));
                sum += probability;
                // The numbers that pick an emitter are one interval.
                let off = *count as f64 - probability * f64::from(draws);
                assert!(off.abs() <= 1.01, "scene {number}, receiver {place}, emitter {emitter}: {off}");
            }
            assert!(sum <= 1.0 + 1e-5, "scene {number}, receiver {place}: {sum}");
            // What is picked for no light is made of one interval for each node.
            let off = none as f64 - (1.0 - sum) * f64::from(draws);
            assert!(
                off.abs() <= 2.0 + lights.count() as f64 / 8.0,
                "scene {number}, receiver {place}: {none}, {sum}"
            );
        }
    }
}

/// Irradiance through every emitter, each sampled by itself.
fn one_by_one(world: &World, receiver: &Place, samples: u64) -> Estimate {
    let cosine = |direction: Vec3| f64::from(direction.dot(receiver.normal).max(0.0));
    let mut replicate = |pixel: u32| {
        let mut sum = 0.0;
        for emitter in 0..world.lights.count() as u32 {
            for i in 0..samples {
                let [u, v, ..] =
                    Sampler::at(Sequence::Sobol, 41, [pixel, emitter], i).group(Domain::new(0, 0));
                let sample = world.lights.sample_emitter(emitter, &world.scene, receiver.from, [u, v]);
                sum +=
                    sample.map_or(0.0, |s| f64::from(s.radiance.r) * cosine(s.incoming) / f64::from(s.pdf));
            }
        }
        sum / samples as f64
    };
    (0..8).map(&mut replicate).collect()
}

fn by_choice(world: &World, receiver: &Place, samples: u64) -> Estimate {
    let cosine = |direction: Vec3| f64::from(direction.dot(receiver.normal).max(0.0));
    let mut replicate = |pixel: u32| {
        let mut sum = 0.0;
        for i in 0..samples {
            let group = Sampler::at(Sequence::Sobol, 42, [pixel, 0], i).group_words(Domain::new(0, 0));
            let [choice, u, v, _] = group.map(luch_sampling::hash::unit_f64);
            let sample = world.lights.sample(
                &world.scene,
                receiver.from,
                receiver.normal,
                choice,
                [u as f32, v as f32].map(|u| u.min(1f32.next_down())),
            );
            sum += sample.map_or(0.0, |s| f64::from(s.radiance.r) * cosine(s.incoming) / f64::from(s.pdf));
        }
        sum / samples as f64
    };
    (0..32).map(&mut replicate).collect()
}

#[test]
fn the_light_of_many_lamps_is_the_sum_of_the_light_of_each() {
    let cases = [("mixed", mixed(400), 64, 1 << 14, 0.01), ("mesh", glowing_mesh(100_000), 1, 1 << 12, 0.02)];
    for (name, scene, each, samples, tolerance) in cases {
        let world = built(scene);
        let places = [
            (Vec3::new(5.0, -0.5, 5.0), Vec3::Y),
            (Vec3::new(5.0, 1.5, 4.0), Vec3::NEG_Y),
            (Vec3::new(-2.0, 3.0, 12.0), Vec3::new(0.6, 0.0, -0.8)),
        ];
        for (from, normal) in places {
            let receiver = Place { from, normal };
            let truth = one_by_one(&world, &receiver, each);
            let picked = by_choice(&world, &receiver, samples);
            let off = picked.mean().unwrap() - truth.mean().unwrap();
            let error = libm::hypot(picked.standard_error().unwrap(), truth.standard_error().unwrap());
            assert!(off.abs() <= 4.0 * error, "{name} at {from}: {picked:?} is not {truth:?}");
            let relative = error / truth.mean().unwrap();
            assert!(relative <= tolerance, "{name} at {from}: the error {relative} is too large to tell");
        }
    }
}

#[test]
fn lamps_that_face_away_or_lie_below_the_horizon_are_not_picked() {
    let mut scene = Scene::default();
    for i in 0..40 {
        let [x, _, z, radiance] = random(51, i, 0);
        let material = glowing(&mut scene, 0.1 + radiance, false);
        let shape = scene.add_shape(Shape::Disc { radius: 0.1 });
        // Facing up.
        scene.add_instance(shape, material, Affine3A::from_translation(Vec3::new(x, 0.0, z) * 10.0));
    }
    let world = built(scene);
    for (from, normal, lit) in [
        (Vec3::new(5.0, 3.0, 5.0), Vec3::NEG_Y, true),
        (Vec3::new(5.0, 3.0, 5.0), Vec3::ZERO, true),
        (Vec3::new(5.0, 3.0, 5.0), Vec3::Y, false),
        (Vec3::new(5.0, -3.0, 5.0), Vec3::Y, false),
        (Vec3::new(5.0, -3.0, 5.0), Vec3::ZERO, false),
    ] {
        for i in 0..256 {
            let chosen = world.lights.choose(from, normal, f64::from(i) / 256.0);
            assert_eq!(chosen.is_some(), lit, "{from} {normal}");
        }
        let sum: f32 = (0..40).map(|emitter| world.lights.probability(emitter, from, normal)).sum();
        assert!((sum - f32::from(u8::from(lit))).abs() < 1e-5, "{from} {normal}: {sum}");
    }
}

#[test]
fn a_lit_room_and_a_sun_outside_both_get_samples() {
    let mut scene = mixed(12);
    scene.lights.push(Light::Sun { direction: Vec3::NEG_Y, irradiance: Rgb::gray(1e6), angular_radius: 0.0 });
    let world = built(scene);
    let sun = world.lights.count() as u32 - 1;
    let probability = world.lights.probability(sun, Vec3::splat(5.0), Vec3::Y);
    assert_eq!(probability, 0.875);
    assert_eq!(world.lights.probability(sun, Vec3::splat(5.0), Vec3::NEG_Y), 0.0);
}

#[test]
fn halves_of_a_parallelogram_are_one_lamp_with_one_density() {
    let mut scene = Scene::default();
    let material = glowing(&mut scene, 2.0, false);
    let corners = vec![Vec3::ZERO, Vec3::X, Vec3::new(1.5, 0.0, -1.0), Vec3::new(0.5, 0.0, -1.0)];
    let mesh = TriangleMesh::new(corners, vec![[1, 2, 0], [3, 0, 2]]);
    let shape = scene.add_shape(Shape::Mesh(mesh));
    let placement = Affine3A::from_scale_rotation_translation(
        Vec3::new(2.0, 1.0, 3.0),
        Quat::from_rotation_z(0.3),
        Vec3::new(0.1, 0.2, 0.3),
    );
    scene.add_instance(shape, material, placement);
    let world = built(scene);
    assert_eq!(world.lights.count(), 1);
    assert_eq!(world.lights.emitter_at(0, 0), Some(0));
    assert_eq!(world.lights.emitter_at(0, 1), Some(0));
    assert_eq!(world.lights.emitter_at(0, 2), None);
    let lamp = &world.lights.flat_lamps()[0];
    let from = lamp.center() + lamp.normal;
    assert!(lamp.is_near(from));
    let density = |s: f32, t: f32| {
        let ray = Ray::segment(from, lamp.corner + lamp.edges[0] * s + lamp.edges[1] * t);
        let ray = Ray::new(from, ray.direction.normalize());
        let hit = world.geometry.nearest_hit(&world.scene, &ray, 0).expect("the lamp is hit");
        let point = SurfacePoint::new(&world.scene, &world.geometry, &ray, hit);
        (hit.hit.primitive, world.lights.pdf_of_hit(from, lamp.normal * -1.0, &point))
    };
    let (first, second) = (density(0.2, 0.3), density(0.8, 0.7));
    assert_ne!(first.0, second.0);
    assert!(first.1 > 0.0);
    assert_eq!(first.1, second.1);
}

#[test]
fn only_halves_that_shine_alike_are_joined() {
    let corners = vec![Vec3::ZERO, Vec3::X, Vec3::new(1.0, 1.0, 0.0), Vec3::Y];
    let lamps = |mesh: TriangleMesh, radiances: &[f32]| {
        let mut scene = Scene::default();
        let materials: Vec<_> = radiances.iter().map(|&r| glowing(&mut scene, r, false)).collect();
        let shape = scene.add_shape(Shape::Mesh(mesh));
        scene.add_instance(shape, materials[0], Affine3A::IDENTITY);
        scene.instances[0].materials = materials;
        built(scene).lights.count()
    };
    let halves = vec![[0, 1, 2], [0, 2, 3]];
    assert_eq!(lamps(TriangleMesh::new(corners.clone(), halves.clone()), &[1.0]), 1);
    let two_slots = TriangleMesh { slots: vec![0, 1], ..TriangleMesh::new(corners.clone(), halves.clone()) };
    assert_eq!(lamps(two_slots, &[1.0, 2.0]), 2);
    let other_start = TriangleMesh::new(corners.clone(), vec![[0, 1, 2], [3, 0, 2]]);
    assert_eq!(lamps(other_start, &[1.0]), 1);
    let turned_over = TriangleMesh::new(corners.clone(), vec![[0, 1, 2], [0, 3, 2]]);
    assert_eq!(lamps(turned_over, &[1.0]), 2);
    let mut kite = corners.clone();
    kite[3] = Vec3::new(0.0, 1.1, 0.0);
    assert_eq!(lamps(TriangleMesh::new(kite, halves.clone()), &[1.0]), 2);
    let mut folded = corners;
    folded[3].z = 1e-4;
    assert_eq!(lamps(TriangleMesh::new(folded, halves), &[1.0]), 2);
}

#[test]
fn many_at_once_are_picked_as_one_by_one() {
    for scene in [mixed(1), mixed(6), mixed(400), under_sky(mixed(60)), glowing_mesh(3000), Scene::default()]
    {
        let world = built(scene);
        let receivers: Vec<Receiver> = receivers(&world)
            .iter()
            .enumerate()
            .map(|(i, place)| Receiver {
                position: place.from,
                normal: place.normal,
                choice: random(61, i as u64, 0)[0].into(),
            })
            .collect();
        let mut chosen = vec![None; receivers.len()];
        world.lights.choose_many(&receivers, &mut chosen);
        for (receiver, chosen) in receivers.iter().zip(chosen) {
            assert_eq!(chosen, world.lights.choose(receiver.position, receiver.normal, receiver.choice));
        }
    }
}

#[test]
fn candidates_drawn_for_nobody_bring_every_receiver_the_same_light() {
    let mut scene = under_sky(glowing_mesh(30));
    scene.lights.extend(mixed(60).lights);
    let world = built(scene);
    assert!(world.lights.is_shareable());
    let place = Place { from: Vec3::new(5.0, -3.0, 5.0), normal: Vec3::new(0.0, 0.8, 0.6) };
    let cosine = |direction: Vec3| f64::from(direction.dot(place.normal).max(0.0));
    for emitter in 0..world.lights.count() as u32 {
        let (mut shared, mut own) = (Estimate::new(), Estimate::new());
        for pixel in 0..16 {
            let mut sums = [0.0; 2];
            for i in 0..1024 {
                let [u, v, ..] =
                    Sampler::at(Sequence::Sobol, 71, [pixel, emitter], i).group(Domain::new(0, 0));
                let candidate = world.lights.candidate(emitter, &world.scene, [u, v]);
                let samples = [
                    candidate.and_then(|c| world.lights.toward(&c, &world.scene, place.from)),
                    world.lights.sample_emitter(emitter, &world.scene, place.from, [u, v]),
                ];
                for (sum, sample) in sums.iter_mut().zip(samples) {
                    let light =
                        |s: EmitterSample| f64::from(s.radiance.r) * cosine(s.incoming) / f64::from(s.pdf);
                    *sum += sample.map_or(0.0, light) / 1024.0;
                }
            }
            shared.add(sums[0]);
            own.add(sums[1]);
        }
        let (shared, own) = (&shared, &own);
        let off = shared.mean().unwrap() - own.mean().unwrap();
        let error = libm::hypot(shared.standard_error().unwrap(), own.standard_error().unwrap());
        let truth = own.mean().unwrap();
        assert!(off.abs() <= 4.0 * error + 1e-5 * truth, "emitter {emitter}: {shared:?} is not {own:?}");
        assert!(
            error <= 0.02 * truth,
            "emitter {emitter}: the error {error} of {truth} is too large to tell"
        );
    }
}
