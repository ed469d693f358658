//! Batches of rays that go much the same way, which packets take, against the loop over instances: at every level, whatever
//! the hint says.

use crate::instances::{Loop, bits, filter, geometries, instances};
use crate::random::Random;
use glam::{Affine3A, Vec3};
use luch_bvh::simd::Level;
use luch_bvh::{Coherence, Instance, InstanceHit, Quality, Ray, SceneTree};

/// Bundles from one place, to one place, side by side; of sixteen rays, with a last one that is smaller. Some rays are not
/// sound, some end early.
fn bundles(count: usize, seed: u64) -> Vec<Ray> {
    let mut random = Random::new(seed);
    let mut rays = Vec::new();
    for bundle in 0..count {
        let (from, to) = (random.vector() * 6.0, random.vector() * 2.0);
        let spread = [0.02, 0.2, 1.0][random.below(3)];
        for _ in 0..16 {
            let (near, far) = (random.vector() * spread, random.vector() * spread);
            let mut ray = match bundle % 4 {
                0 => Ray::new(from, to + far - from),
                1 => Ray::segment(from + near, to),
                2 => Ray::new(from + near, to - from),
                // Along an axis, some of them exactly.
                _ => {
                    Ray::new(from + near, Vec3::Z + if random.below(2) == 0 { Vec3::ZERO } else { far * 0.1 })
                }
            };
            match random.below(40) {
                0 => ray.direction = Vec3::ZERO,
                1 => ray.origin.x = f32::NAN,
                2 => ray.t_max = random.unit(),
                3 => ray.t_min = 0.4,
                _ => {}
            }
            rays.push(ray);
        }
    }
    rays.truncate(rays.len() - 5);
    rays
}

/// One instance after the other, each of its own kind, then many together.
fn lists() -> Vec<Vec<Instance>> {
    let mut lists = vec![instances(120, 61), instances(12, 62), instances(4, 63)];
    for geometry in 0..8 {
        for (filtered, placement) in
            [(false, Affine3A::from_scale(Vec3::splat(2.0))), (true, Affine3A::IDENTITY)]
        {
            lists.push(vec![Instance { geometry, placement, cull_back: geometry == 1, filtered }]);
        }
    }
    lists
}

#[test]
fn as_the_loop_over_instances_at_every_level() {
    let all = bundles(120, 64);
    let mut found = [0; 2];
    for list in lists() {
        let rays = &all[..if list.len() > 20 { all.len() } else { 600 - 5 }];
        let loops = Loop::new(&list);
        // Whether a hit counts also depends on the ray.
        let counts = |ray: usize, hit: &InstanceHit| filter(hit) || ray.is_multiple_of(3);
        let nearest: Vec<_> = rays.iter().map(|ray| bits(loops.nearest(ray, |_| true))).collect();
        let through: Vec<_> = rays
            .iter()
            .enumerate()
            .map(|(index, ray)| bits(loops.nearest(ray, |hit| counts(index, hit))))
            .collect();
        found[0] += nearest.iter().flatten().count();
        found[1] += nearest.iter().zip(&through).filter(|(nearest, through)| nearest != through).count();
        let met = |hits: &[Option<[u32; 5]>]| hits.iter().map(Option::is_some).collect::<Vec<_>>();
        let tree = SceneTree::build(geometries(), &list, Quality::Balanced);
        for level in Level::ALL {
            level.limit();
            for coherence in [Coherence::Coherent, Coherence::Incoherent] {
                let (mut hits, mut answers) = (vec![None; rays.len()], vec![false; rays.len()]);
                let check = |hits: &[Option<InstanceHit>], expected: &[Option<[u32; 5]>]| {
                    for (index, (hit, expected)) in hits.iter().zip(expected).enumerate() {
                        assert_eq!(bits(*hit), *expected, "{level:?} {coherence:?} {:?}", rays[index]);
                    }
                };
                tree.nearest_batch(rays, &mut hits, coherence);
                check(&hits, &nearest);
                tree.nearest_filtered_batch(rays, &mut hits, coherence, counts);
                check(&hits, &through);
                tree.any_batch(rays, &mut answers, coherence);
                assert_eq!(answers, met(&nearest), "{level:?} {coherence:?}");
                tree.any_filtered_batch(rays, &mut answers, coherence, counts);
                assert_eq!(answers, met(&through), "{level:?} {coherence:?}");
            }
        }
        Level::Avx512.limit();
    }
    assert!(found[0] > 2_000 && found[1] > 200, "{found:?}");
}
