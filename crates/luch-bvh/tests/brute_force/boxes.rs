//! The bare tree, with spheres as leaves the tree knows nothing of, and boxes no sane caller would give.

use crate::random::Random;
use glam::{Vec3, vec3};
use luch_bvh::shape::Sphere;
use luch_bvh::{Aabb, Bvh, Hit, Quality, Ray, SlabRay};

fn leaf(spheres: &[Sphere], primitive: u32, ray: &Ray) -> Option<Hit> {
    let crossing = spheres[primitive as usize].crossings(ray).into_iter().flatten().next()?;
    Some(Hit { t: crossing.t, u: 0.0, v: 0.0, primitive })
}

#[test]
fn spheres_as_the_loop_finds_them() {
    let mut random = Random::new(41);
    let sphere = |random: &mut Random| Sphere { center: random.vector(), radius: random.unit() * 0.2 };
    let mut spheres: Vec<_> = (0..300).map(|_| sphere(&mut random)).collect();
    spheres.extend_from_within(0..50);
    spheres[7].radius = f32::NAN;
    let boxes: Vec<_> = spheres.iter().map(Sphere::bounds).collect();
    for quality in Quality::ALL {
        let tree = Bvh::build(&boxes, quality);
        for _ in 0..2_000 {
            let ray = Ray::new(random.vector() * 2.0, random.vector());
            let slab = SlabRay::new(&ray).unwrap();
            let mut expected: Option<Hit> = None;
            for (primitive, bounds) in (0..).zip(&boxes) {
                let Some(hit) = leaf(&spheres, primitive, &ray) else { continue };
                let Some(t) = slab.clamp(bounds, hit.t) else { continue };
                if expected.is_none_or(|best| t < best.t) {
                    expected = Some(Hit { t, ..hit });
                }
            }
            assert_eq!(tree.nearest(&ray, |primitive, ray| leaf(&spheres, primitive, ray)), expected);
            let any = tree.any(&ray, |primitive, ray| leaf(&spheres, primitive, ray).is_some());
            assert_eq!(any, expected.is_some());

            let point = random.vector() * 2.0;
            let on_sphere =
                |sphere: &Sphere| sphere.center + (point - sphere.center).normalize() * sphere.radius;
            let sound = spheres.iter().filter(|sphere| sphere.radius > 0.0);
            let distance = sound.map(|sphere| (on_sphere(sphere) - point).length()).fold(1.5, f32::min);
            let found =
                tree.nearest_point(point, 1.5, |primitive| Some(on_sphere(&spheres[primitive as usize])));
            // A point inside a sphere is nearer to its box than to its surface, never the other way round.
            assert_eq!(found.map_or(1.5, |found| found.distance), distance);
        }
    }
}

/// A leaf test with errors beyond all measure: any `t` at all, though always the same for the same ray and primitive.
fn unreliable(primitive: u32, ray: &Ray) -> Option<Hit> {
    let mut random = Random::new(u64::from(primitive) ^ (u64::from(ray.direction.x.to_bits()) << 20));
    (random.unit() < 0.7).then(|| Hit { t: random.unit() * 4.0, u: 0.0, v: 0.0, primitive })
}

#[test]
fn clamping_makes_up_for_the_worst_of_leaf_tests() {
    let mut random = Random::new(43);
    let boxes: Vec<_> = (0..400)
        .map(|_| random.vector())
        .map(|corner| Aabb { min: corner, max: corner + Vec3::splat(0.2) })
        .collect();
    for quality in Quality::ALL {
        let tree = Bvh::build(&boxes, quality);
        for _ in 0..2_000 {
            let ray = Ray::new(random.vector() * 2.0, random.vector());
            let slab = SlabRay::new(&ray).unwrap();
            let clamped = |(primitive, bounds): (u32, &Aabb)| {
                let hit = unreliable(primitive, &ray)?;
                Some(Hit { t: slab.clamp(bounds, hit.t)?, ..hit })
            };
            let hits = (0..).zip(&boxes).filter_map(clamped);
            let expected = hits.min_by(|a, b| a.t.total_cmp(&b.t).then(a.primitive.cmp(&b.primitive)));
            assert_eq!(tree.nearest(&ray, unreliable), expected);
        }
    }
}

#[test]
fn any_boxes_at_all() {
    let mut random = Random::new(42);
    let odd = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, f32::MAX, f32::MIN, 0.0, -0.0, 1e-45, 1.0];
    let mut coordinate = |kind: usize| match kind {
        0 => odd[random.below(odd.len())],
        1 => random.signed() * 1e30,
        _ => random.signed(),
    };
    let mut boxes = Vec::new();
    for index in 0..3_000 {
        let kind = if index % 5 == 0 { 0 } else { 1 + index % 2 };
        let mut point = || vec3(coordinate(kind), coordinate(kind), coordinate(kind));
        let (a, b) = (point(), point());
        boxes.push(if index % 7 == 0 {
            Aabb { min: a, max: b }
        } else {
            Aabb { min: a.min(b), max: a.max(b) }
        });
    }
    boxes.extend([Aabb { min: Vec3::ONE, max: Vec3::ONE }; 500]);
    for quality in Quality::ALL {
        let tree = Bvh::build(&boxes, quality);
        assert!(tree.statistics().depth < 64);
        for _ in 0..200 {
            let ray = Ray::new(random.vector() * 3.0, random.vector());
            let slab = SlabRay::new(&ray).unwrap();
            let touched = |primitive: u32| {
                !boxes[primitive as usize].is_empty() && slab.interval(&boxes[primitive as usize]).is_some()
            };
            let mut expected: Vec<u32> =
                (0..boxes.len() as u32).filter(|primitive| touched(*primitive)).collect();
            let mut met = Vec::new();
            tree.any(&ray, |primitive, _| {
                met.push(primitive);
                false
            });
            met.sort_unstable();
            expected.sort_unstable();
            assert_eq!(met, expected, "{quality:?} {ray:?}");
        }
    }
}

#[test]
fn equal_boxes_are_halved() {
    let boxes = [Aabb { min: Vec3::ZERO, max: Vec3::ONE }; 5_000];
    for quality in Quality::ALL {
        let statistics = Bvh::build(&boxes, quality).statistics();
        assert!(statistics.depth <= 13, "{statistics:?}");
    }
}

#[test]
fn a_geometric_row_stays_within_the_depth() {
    // Each box half the size of the one before: the surface area heuristic would peel them off one by one.
    let size = |index: i32| (0..index).fold(1e30_f32, |size, _| size * 0.5);
    let boxes: Vec<_> = (0..200).map(|i| Aabb { min: Vec3::ZERO, max: Vec3::splat(size(i)) }).collect();
    for quality in Quality::ALL {
        let tree = Bvh::build(&boxes, quality);
        assert!(tree.statistics().depth < 64);
        let mut met = 0;
        tree.any(&Ray::new(Vec3::ZERO, Vec3::ONE), |_, _| {
            met += 1;
            false
        });
        assert_eq!(met, 200);
    }
}
