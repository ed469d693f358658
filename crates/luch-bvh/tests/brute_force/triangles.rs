//! A tree over triangles against the loop over them.

use crate::adversarial::rays;
use crate::files;
use crate::meshes::{self, Mesh};
use crate::random::Random;
use glam::Vec3;
use luch_bvh::triangle::nearest_point;
use luch_bvh::{BruteForce, Coherence, Hit, Quality, Ray, Triangle, TriangleBvh, TriangleTest};

fn bits(hit: Option<Hit>) -> Option<[u32; 4]> {
    hit.map(|hit| [hit.t.to_bits(), hit.u.to_bits(), hit.v.to_bits(), hit.primitive])
}

/// Every third hit or so passes: a pure function of the hit.
fn some(hit: &Hit) -> bool {
    hit.primitive.wrapping_mul(0x9e37_79b9).wrapping_add(hit.u.to_bits()).is_multiple_of(3)
}

/// All queries of all qualities; returns how many rays hit.
fn compare(mesh: &Mesh, rays: &[Ray]) -> usize {
    let loops = BruteForce::new(&mesh.positions, &mesh.triangles, TriangleTest::Watertight);
    let trees = Quality::ALL.map(|quality| TriangleBvh::build(&mesh.positions, &mesh.triangles, quality));
    let mut count = 0;
    for ray in rays {
        let nearest = bits(loops.nearest(ray));
        let culled = bits(loops.nearest_culled(ray));
        let filtered = bits(loops.nearest_where(ray, false, some));
        let (any, any_filtered) = (loops.any(ray), loops.any_where(ray, true, some));
        assert_eq!(nearest.is_some(), any);
        for (tree, quality) in trees.iter().zip(Quality::ALL) {
            let place = || format!("{} {quality:?} {ray:?}", mesh.name);
            assert_eq!(bits(tree.nearest(ray)), nearest, "{}", place());
            assert_eq!(bits(tree.nearest_culled(ray)), culled, "culled {}", place());
            assert_eq!(bits(tree.nearest_where(ray, false, some)), filtered, "filtered {}", place());
            assert_eq!(tree.any(ray), any, "any {}", place());
            assert_eq!(tree.any_where(ray, true, some), any_filtered, "any filtered {}", place());
        }
        count += usize::from(any);
    }
    for (tree, coherence) in
        trees.iter().zip([Coherence::Coherent, Coherence::Incoherent, Coherence::Coherent])
    {
        let (mut hits, mut met) = (vec![None; rays.len()], vec![false; rays.len()]);
        tree.nearest_batch(rays, &mut hits, coherence);
        tree.any_batch(rays, &mut met, coherence);
        for (index, ray) in rays.iter().enumerate() {
            assert_eq!((bits(hits[index]), met[index]), (bits(tree.nearest(ray)), tree.any(ray)));
        }
    }
    count
}

#[test]
fn on_meshes_by_formula() {
    for mesh in meshes::all() {
        let rays = rays(&mesh, 30, 11);
        let hits = compare(&mesh, &rays);
        assert!(hits > rays.len() / 8, "{}: only {hits} of {} rays hit", mesh.name, rays.len());
    }
}

#[test]
fn on_real_meshes() {
    for mesh in files::meshes() {
        let rays = rays(&mesh, 5, 12);
        let hits = compare(&mesh, &rays);
        assert!(hits > rays.len() / 8, "{}: only {hits} of {} rays hit", mesh.name, rays.len());
    }
}

#[test]
fn at_every_scale() {
    for scale in [1e-18, 1e-12, 1e-6, 1e6, 1e12, 1e18] {
        let mesh = meshes::torus(12, 8).mapped(&format!("times {scale}"), |p| p * scale);
        let hits = compare(&mesh, &rays(&mesh, 10, 13));
        assert!(hits > 100, "{}: {hits}", mesh.name);
    }
    // All scales in one scene, and a triangle too large for its box to be finite.
    let mut mesh = Mesh::new("mixed scales", Vec::new(), Vec::new());
    for (index, scale) in [1e-18_f32, 1e-6, 1.0, 1e6, 1e18, 3e38].into_iter().enumerate() {
        let part = meshes::sphere(4, 6);
        let first = mesh.positions.len() as u32;
        mesh.positions.extend(part.positions.iter().map(|p| *p * scale + Vec3::X * index as f32));
        mesh.triangles.extend(part.triangles.iter().map(|t| t.map(|corner| corner + first)));
    }
    assert!(compare(&mesh, &rays(&mesh, 30, 14)) > 100);
}

#[test]
fn of_equal_triangles_the_first_is_hit() {
    let mut mesh = meshes::grid(3);
    let single = mesh.triangles.clone();
    for _ in 0..40 {
        mesh.triangles.extend(&single);
    }
    compare(&mesh, &rays(&mesh, 20, 15));
    let tree = TriangleBvh::build(&mesh.positions, &mesh.triangles, Quality::Balanced);
    let hit = tree.nearest(&Ray::new(Vec3::new(1.7, 5.0, 1.2), Vec3::NEG_Y)).unwrap();
    assert!((hit.primitive as usize) < single.len());
}

#[test]
fn nothing_to_hit() {
    for triangles in [vec![], vec![[0, 1, 2]], vec![[0, 0, 0]]] {
        let tree = TriangleBvh::build(&[Vec3::NAN, Vec3::ONE], &triangles, Quality::Best);
        assert_eq!(tree.nearest(&Ray::new(Vec3::ZERO, Vec3::X)), None);
        assert!(!tree.any(&Ray::new(Vec3::ZERO, Vec3::X)));
        assert_eq!(tree.nearest_point(Vec3::ZERO, f32::INFINITY), None);
        assert!(tree.bounds().is_empty());
        assert_eq!(tree.statistics().leaves, 0);
    }
}

#[test]
fn the_outside_is_where_corners_run_counter_clockwise() {
    let mesh = meshes::cube();
    let tree = TriangleBvh::build(&mesh.positions, &mesh.triangles, Quality::Balanced);
    for direction in [Vec3::X, Vec3::Y, Vec3::Z, Vec3::new(0.3, 0.2, 0.5)] {
        for direction in [direction, -direction] {
            let outside = Ray::new(direction * -5.0, direction);
            assert_eq!(tree.nearest_culled(&outside), tree.nearest(&outside));
            assert!(tree.nearest_culled(&outside).is_some());
            assert_eq!(
                tree.nearest_culled(&Ray::new(Vec3::ZERO, direction)),
                None,
                "from inside {direction}"
            );
        }
    }
}

#[test]
fn nearest_points() {
    for mesh in meshes::all() {
        let tree = TriangleBvh::build(&mesh.positions, &mesh.triangles, Quality::Balanced);
        let (bounds, mut random) = (tree.bounds(), Random::new(16));
        for _ in 0..100 {
            let size = (bounds.max - bounds.min).max_element();
            let point = bounds.centroid() + random.vector() * size;
            let limit = if random.unit() < 0.5 { f32::INFINITY } else { size * 0.3 };
            let mut expected: Option<(f32, u32)> = None;
            for (primitive, corners) in (0..).zip(&mesh.triangles) {
                let triangle = Triangle::of_mesh(&mesh.positions, *corners).filter(Triangle::is_finite);
                let Some(triangle) = triangle else { continue };
                let distance = (nearest_point(&triangle, point).point - point).length_squared();
                if distance <= limit * limit && expected.is_none_or(|(least, _)| distance < least) {
                    expected = Some((distance, primitive));
                }
            }
            let found = tree.nearest_point(point, limit).map(|found| (found.distance, found.primitive));
            let expected = expected.map(|(squared, primitive)| (squared.sqrt(), primitive));
            assert_eq!(found, expected, "{} {point}", mesh.name);
        }
    }
}

#[test]
fn the_number_of_threads_does_not_change_the_tree() {
    let mesh = meshes::torus(400, 50);
    let build = |threads: usize, quality: Quality| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let tree = pool.install(|| TriangleBvh::build(&mesh.positions, &mesh.triangles, quality));
        format!("{tree:?}")
    };
    for quality in Quality::ALL {
        assert!(build(1, quality) == build(5, quality), "{quality:?}");
    }
}

#[test]
fn better_quality_costs_less() {
    let mesh = meshes::torus(100, 50);
    let cost = Quality::ALL.map(|quality| {
        let statistics = TriangleBvh::build(&mesh.positions, &mesh.triangles, quality).statistics();
        assert!(statistics.nodes < statistics.leaves, "{statistics:?}");
        assert!(statistics.depth < 40, "{statistics:?}");
        statistics.expected_cost
    });
    assert!(cost[1] < cost[0] && cost[2] <= cost[1] * 1.01, "{cost:?}");
}
