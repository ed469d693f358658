//! What a walk relies on, for every quality and every kind of input.

use super::*;
use crate::Aabb;
use crate::triangle::{Triangle, TriangleClip};
use crate::wide::{EMPTY, LEAF, MAX_WIDE_DEPTH, NO_PRIMITIVE};
use glam::{Vec3, vec3};
use proptest::prelude::*;

fn items_of(boxes: &[Aabb]) -> Vec<Item> {
    items(boxes.len(), |primitive| Item::new(&boxes[primitive], primitive as u32))
}

fn build(boxes: &[Aabb], quality: Quality) -> Wide {
    build_wide(items_of(boxes), quality, None)
}

/// Numbers from 0 to 1, the same each time.
fn numbers(seed: u64) -> impl FnMut() -> f32 {
    let mut state = seed;
    move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 40) as f32 / 16_777_216.0
    }
}

/// Small boxes in the unit cube, thick along one axis more than others.
fn scattered(count: usize, size: f32) -> Vec<Aabb> {
    let mut next = numbers(count as u64);
    let mut point = move || vec3(next(), next(), next());
    (0..count)
        .map(|_| (point(), point() * size))
        .map(|(low, size)| Aabb { min: low, max: low + size })
        .collect()
}

fn slivers(count: usize) -> Vec<Triangle> {
    let mut next = numbers(7 + count as u64);
    let mut point = move || vec3(next(), next(), next());
    (0..count)
        .map(|_| {
            let a = point();
            let along = (point() - 0.5) * 0.2;
            Triangle { a, b: a + along, c: a + along * 0.5 + (point() - 0.5) * 0.004 }
        })
        .collect()
}

fn split(triangles: &[Triangle]) -> Wide {
    let boxes: Vec<Aabb> = triangles.iter().map(Triangle::bounds).collect();
    let clip = TriangleClip(|primitive: u32| triangles[primitive as usize]);
    build_wide(items_of(&boxes), Quality::Best, Some(&clip))
}

/// Checks the tree and returns how often each primitive is in it. Without splits the box of a leaf must be the union of its
/// primitives' boxes; in any case the box of a node that of its children's.
fn check(wide: &Wide, boxes: &[Aabb], whole: bool) -> Vec<u32> {
    let mut seen = vec![0; boxes.len()];
    let mut visited = (0, 0);
    let mut waiting = vec![(wide.root, wide.bounds, 0)];
    while let Some((reference, bounds, depth)) = waiting.pop() {
        if reference == EMPTY {
            assert!(wide.nodes.is_empty() && wide.leaves.is_empty() && bounds.is_empty());
        } else if reference & LEAF != 0 {
            visited.0 += 1;
            let leaf = wide.leaves[(reference & !LEAF) as usize];
            let used = leaf.iter().take_while(|primitive| **primitive != NO_PRIMITIVE).count();
            assert!(used > 0 && leaf[used..].iter().all(|primitive| *primitive == NO_PRIMITIVE), "{leaf:?}");
            let mut union = Aabb::empty();
            for &primitive in &leaf[..used] {
                seen[primitive as usize] += 1;
                union = union.union(&boxes[primitive as usize]);
            }
            if whole {
                assert_eq!(union, bounds);
            }
        } else {
            visited.1 += 1;
            assert!(depth < MAX_WIDE_DEPTH, "too deep");
            let node = &wide.nodes[reference as usize];
            let mut union = Aabb::empty();
            let mut children = 0;
            for (place, &child) in node.children.iter().enumerate() {
                if child == EMPTY {
                    assert!(node.bounds(place).is_empty());
                    continue;
                }
                children += 1;
                assert!(child & LEAF != 0 || child > reference, "a node before its parent");
                union = union.union(&node.bounds(place));
                waiting.push((child, node.bounds(place), depth + 1));
            }
            assert_eq!(union, bounds);
            assert!(children > 1, "a node of one child");
        }
    }
    assert_eq!(visited, (wide.leaves.len(), wide.nodes.len()), "something is not in the tree, or twice");
    seen
}

fn check_whole(boxes: &[Aabb]) {
    for quality in Quality::ALL {
        let seen = check(&build(boxes, quality), boxes, true);
        for (primitive, bounds) in boxes.iter().enumerate() {
            assert_eq!(seen[primitive], u32::from(!bounds.is_empty()), "{quality:?}: {primitive}");
        }
    }
}

#[test]
fn each_primitive_is_in_one_leaf() {
    for count in (0..40).chain([100, 999, 5000, 30_000]) {
        check_whole(&scattered(count, 0.05));
    }
    check_whole(&scattered(2000, 3.0));
}

#[test]
fn odd_boxes_have_a_place_too() {
    let unit = Aabb { min: Vec3::ZERO, max: Vec3::ONE };
    let infinite = Aabb { min: Vec3::NEG_INFINITY, max: Vec3::INFINITY };
    let nan = Aabb { min: Vec3::NAN, max: Vec3::ONE };
    let half = Aabb { min: vec3(f32::NEG_INFINITY, 0.0, 0.0), max: vec3(0.0, 1.0, f32::INFINITY) };
    let huge = Aabb { min: Vec3::splat(-f32::MAX), max: Vec3::splat(f32::MAX) };
    for odd in [infinite, nan, half, huge, Aabb::empty()] {
        for count in [1, 3, 6, 8, 50, 20_000] {
            let mut boxes = scattered(count, 0.1);
            boxes.extend([odd; 7]);
            boxes.push(unit);
            check_whole(&boxes);
        }
        check_whole(&[odd; 3]);
        check_whole(&[odd; 100]);
    }
}

#[test]
fn any_scale_and_any_flatness() {
    let scaled = |boxes: &[Aabb], scale: Vec3, offset: Vec3| -> Vec<Aabb> {
        boxes.iter().map(|b| Aabb { min: b.min * scale + offset, max: b.max * scale + offset }).collect()
    };
    let boxes = scattered(3000, 0.02);
    for scale in [1e-44, 1e-38, 1e-20, 1e20, 1e30, 3e38] {
        check_whole(&scaled(&boxes, Vec3::splat(scale), Vec3::ZERO));
    }
    check_whole(&scaled(&boxes, vec3(1.0, 0.0, 1.0), Vec3::ZERO));
    check_whole(&scaled(&boxes, vec3(0.0, 1.0, 0.0), Vec3::ZERO));
    check_whole(&scaled(&boxes, Vec3::splat(1e-3), Vec3::splat(1e6)));
    // The shape of the tree is that of the same boxes at scale 1: scaling by powers of two changes nothing.
    for quality in Quality::ALL {
        let same = build(&boxes, quality);
        for exponent in [-60, 60] {
            let scale = Vec3::splat(if exponent < 0 { 2.0_f32.recip() } else { 2.0 });
            let mut moved = boxes.clone();
            for _ in 0..60 {
                moved = scaled(&moved, scale, Vec3::ZERO);
            }
            assert_eq!(build(&moved, quality).leaves, same.leaves);
        }
    }
}

#[test]
fn a_million_equal_boxes_take_no_time_and_no_depth() {
    let boxes = vec![Aabb { min: Vec3::ZERO, max: Vec3::ONE }; 1_000_000];
    for quality in Quality::ALL {
        let wide = build(&boxes, quality);
        assert_eq!(wide.leaves.len(), 250_000, "{quality:?}");
        check(&wide, &boxes, true);
    }
}

#[test]
fn boxes_each_half_of_the_last_make_no_deep_tree() {
    let mut boxes = Vec::new();
    for count in [0, 1, 3, 40] {
        let mut size = 1e30_f32;
        while size > 1e-40 {
            boxes.extend(vec![Aabb { min: Vec3::splat(size), max: Vec3::splat(size * 1.5) }; 1 + count]);
            size *= 0.5;
        }
    }
    check_whole(&boxes);
    let nested: Vec<Aabb> = boxes.iter().map(|b| Aabb { min: -b.max, max: b.max }).collect();
    check_whole(&nested);
}

#[test]
fn the_number_of_threads_is_never_seen() {
    let boxes = scattered(70_000, 0.02);
    let triangles = slivers(3000);
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| (Quality::ALL.map(|quality| build(&boxes, quality)), split(&triangles)))
    };
    let one = on(1);
    for threads in [2, 3] {
        assert!(on(threads) == one, "{threads} threads");
    }
}

#[test]
fn splits_cover_their_triangles() {
    let triangles = slivers(4000);
    let boxes: Vec<Aabb> = triangles.iter().map(Triangle::bounds).collect();
    let wide = split(&triangles);
    let seen = check(&wide, &boxes, false);
    assert!(seen.iter().all(|count| *count > 0));
    let references: u32 = seen.iter().sum();
    let budget = triangles.len() as u32 / 5;
    assert!((4100..=4000 + budget).contains(&references), "{references}");
    // Each point of each triangle is in the box of a leaf that has the triangle.
    let mut parts = vec![Vec::new(); triangles.len()];
    for node in &wide.nodes {
        for (place, child) in node.children.iter().enumerate() {
            if child & LEAF != 0 {
                for &primitive in &wide.leaves[(child & !LEAF) as usize] {
                    if primitive != NO_PRIMITIVE {
                        parts[primitive as usize].push(node.bounds(place));
                    }
                }
            }
        }
    }
    let mut next = numbers(3);
    for (triangle, parts) in triangles.iter().zip(&parts) {
        for _ in 0..100 {
            let (u, v) = (next(), next());
            let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
            let point = triangle.at(u, v);
            assert!(parts.iter().any(|part| part.contains(point)));
        }
    }
}

#[test]
fn more_time_makes_better_trees() {
    let cost = |wide: &Wide| -> f64 {
        let mut areas: Vec<f64> = Vec::new();
        for node in &wide.nodes {
            areas.extend((0..8).map(|place| node.bounds(place).half_area()));
        }
        areas.sort_by(f64::total_cmp);
        areas.iter().sum::<f64>() / wide.bounds.half_area()
    };
    let triangles = slivers(5000);
    let boxes: Vec<Aabb> = triangles.iter().map(Triangle::bounds).collect();
    let [fast, balanced] = [Quality::Fast, Quality::Balanced].map(|quality| cost(&build(&boxes, quality)));
    let best = cost(&split(&triangles));
    assert!(best < balanced && balanced < fast, "{best} {balanced} {fast}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(128))]

    #[test]
    fn whatever_the_boxes(
        corners in prop::collection::vec((prop::array::uniform3(-4_i8..4), prop::array::uniform3(0_i8..3)), 0..300),
        exponent in -120_i32..120,
    ) {
        let scale = f32::from_bits(((127 + exponent) as u32) << 23);
        let boxes: Vec<Aabb> = corners
            .into_iter()
            .map(|(low, size)| {
                let low = Vec3::from_array(low.map(f32::from));
                Aabb { min: low * scale, max: (low + Vec3::from_array(size.map(f32::from))) * scale }
            })
            .collect();
        check_whole(&boxes);
    }
}
