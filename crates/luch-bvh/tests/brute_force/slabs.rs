//! The lemma under the theorem: a box inside another has its interval inside the other's, whatever the numbers.

use glam::{Vec3, vec3};
use luch_bvh::{Aabb, Ray, SlabRay};
use proptest::prelude::*;

/// Ordinary numbers, and all that are not: zeroes, subnormal, huge, infinite, no numbers.
fn number() -> impl Strategy<Value = f32> {
    prop_oneof![
        4 => -10.0_f32..10.0,
        1 => (-4_i32..5).prop_map(|n| n as f32),
        1 => any::<f32>(),
        1 => prop::sample::select(vec![0.0, -0.0, 1e-45, -1e-45, 1e-30, 1e30, f32::MAX, f32::INFINITY, f32::NAN]),
    ]
}

fn vector() -> impl Strategy<Value = Vec3> {
    (number(), number(), number()).prop_map(|(x, y, z)| vec3(x, y, z))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 20_000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn nested_boxes_have_nested_intervals(
        origin in vector(), direction in vector(), t_min in number(), t_max in number(),
        corners in [vector(), vector()], more in vector(), on_plane in 0..7_usize,
    ) {
        let inner = Aabb::of_points(corners);
        let outer = inner.union(&Aabb::of_points([more]));
        // Often exactly in a plane of the inner box, where zero times infinity lurks.
        let mut origin = origin;
        if on_plane < 6 {
            origin[on_plane % 3] = corners[on_plane / 3][on_plane % 3];
        }
        if let Some(ray) = SlabRay::new(&Ray { origin, direction, t_min, t_max }) && !inner.is_empty()
            && let Some(inside) = ray.interval(&inner)
        {
            let around = ray.interval(&outer);
            prop_assert!(around.is_some(), "{ray:?} {inner:?} {outer:?}");
            let around = around.unwrap();
            prop_assert!(around.near <= inside.near && inside.far <= around.far);
            prop_assert!(inside.near.is_finite() && inside.far.is_finite() && inside.near >= 0.0);
            let t = ray.clamp(&inner, origin.x).unwrap();
            prop_assert!(t.is_nan() || (inside.near..=inside.far).contains(&t));
        }
    }

    #[test]
    fn a_ray_to_a_point_of_a_box_meets_the_box(
        from in [-10.0_f32..10.0, -10.0..10.0, -10.0..10.0],
        min in [-10.0_f32..10.0, -10.0..10.0, -10.0..10.0],
        size in [0.0_f32..3.0, 0.0..3.0, 0.0..3.0],
        part in [0.0_f32..=1.0, 0.0..=1.0, 0.0..=1.0],
    ) {
        let min = Vec3::from_array(min);
        let bounds = Aabb { min, max: min + Vec3::from_array(size) };
        let target = (min + Vec3::from_array(size) * Vec3::from_array(part)).min(bounds.max);
        let from = Vec3::from_array(from);
        if let Some(ray) = SlabRay::new(&Ray::new(from, target - from)) {
            let interval = ray.interval(&bounds);
            prop_assert!(interval.is_some_and(|interval| interval.near <= 1.0 && 1.0 <= interval.far), "{interval:?}");
        }
    }
}

#[test]
fn along_a_face_the_box_is_met() {
    let bounds = Aabb { min: Vec3::ZERO, max: Vec3::ONE };
    for zero in [0.0, -0.0] {
        for at in [0.0, -0.0, 1.0] {
            let ray = SlabRay::new(&Ray::new(vec3(at, 0.5, -1.0), vec3(zero, zero, 1.0))).unwrap();
            let interval = ray.interval(&bounds).unwrap();
            assert!((interval.near - 1.0).abs() < 2e-6 && (interval.far - 2.0).abs() < 4e-6);
        }
        for at in [-1e-45, 1.0_f32.next_up()] {
            let ray = SlabRay::new(&Ray::new(vec3(at, 0.5, -1.0), vec3(zero, zero, 1.0))).unwrap();
            assert_eq!(ray.interval(&bounds), None);
        }
    }
}

#[test]
fn rays_that_go_nowhere() {
    let sound = Ray::new(Vec3::ONE, Vec3::X);
    assert!(SlabRay::new(&sound).is_some());
    let unsound = [
        Ray { direction: Vec3::ZERO, ..sound },
        Ray { direction: vec3(f32::NAN, 1.0, 0.0), ..sound },
        Ray { direction: vec3(1.0, f32::INFINITY, 0.0), ..sound },
        Ray { origin: vec3(0.0, f32::NEG_INFINITY, 0.0), ..sound },
        Ray { t_min: f32::NAN, ..sound },
        Ray { t_max: f32::NAN, ..sound },
        Ray { t_min: 2.0, t_max: 1.0, ..sound },
        Ray { t_max: -1.0, ..sound },
    ];
    for ray in unsound {
        assert!(SlabRay::new(&ray).is_none(), "{ray:?}");
    }
}
