//! How many rays a second one core traces: from a camera, after a diffuse bounce, toward a lamp; and the plain loop.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use glam::{Vec2, Vec3, vec3};
use luch_bvh::{BruteForce, Coherence, Quality, Ray, TriangleBvh, TriangleTest};
use std::time::Duration;

mod scene;

/// A grid of rays that sees the whole torus.
fn camera_rays(width: u32) -> Vec<Ray> {
    let eye = vec3(0.0, 2.2, 2.6);
    let forward = (-eye).normalize();
    let right = forward.cross(Vec3::Y).normalize();
    let up = right.cross(forward);
    let at = |index: u32| ((index as f32 + 0.5) / width as f32 - 0.5) * 0.9;
    let ray = |index: u32| Ray::new(eye, forward + right * at(index % width) - up * at(index / width));
    (0..width * width).map(ray).collect()
}

/// One ray from each place the given rays meet, in all directions of the upper half space alike.
fn bounced(tree: &TriangleBvh, mesh: &scene::Mesh, rays: &[Ray]) -> Vec<Ray> {
    let mut state = 1_u64;
    let mut random = move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 40) as f32 / 16_777_216.0
    };
    let bounce = |ray: &Ray| {
        let hit = tree.nearest(ray)?;
        let [a, b, c] = mesh.triangles[hit.primitive as usize].map(|corner| mesh.positions[corner as usize]);
        let normal = (b - a).cross(c - a).normalize();
        let normal = if normal.dot(ray.direction) > 0.0 { -normal } else { normal };
        let z = 2.0 * random() - 1.0;
        let around = Vec2::from_angle(random() * std::f32::consts::TAU) * (1.0 - z * z).sqrt();
        let direction = normal + vec3(around.x, around.y, z) * 0.999;
        Some(Ray::new(ray.at(hit.t) + normal * 1e-4, direction))
    };
    rays.iter().filter_map(bounce).collect()
}

fn traverse(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("traverse");
    group.sample_size(10).warm_up_time(Duration::from_millis(300)).measurement_time(Duration::from_secs(2));
    let mesh = scene::bumpy_torus(160);
    for quality in Quality::ALL {
        let tree = TriangleBvh::build(&mesh.positions, &mesh.triangles, quality);
        let camera = camera_rays(256);
        let diffuse = bounced(&tree, &mesh, &camera);
        for (name, rays) in [("camera", &camera), ("diffuse", &diffuse)] {
            group.throughput(Throughput::Elements(rays.len() as u64));
            let mut hits = vec![None; rays.len()];
            group.bench_function(
                BenchmarkId::new(format!("nearest {name}"), format!("{quality:?}")),
                |bencher| {
                    bencher.iter(|| tree.nearest_batch(rays, &mut hits, Coherence::Incoherent));
                },
            );
            let mut met = vec![false; rays.len()];
            group.bench_function(
                BenchmarkId::new(format!("any {name}"), format!("{quality:?}")),
                |bencher| {
                    bencher.iter(|| tree.any_batch(rays, &mut met, Coherence::Incoherent));
                },
            );
        }
    }
    let loops = BruteForce::new(&mesh.positions, &mesh.triangles, TriangleTest::Watertight);
    let few = camera_rays(6);
    group.throughput(Throughput::Elements(few.len() as u64));
    group.bench_function(BenchmarkId::new("nearest camera", "brute force"), |bencher| {
        bencher.iter(|| few.iter().filter(|ray| loops.nearest(ray).is_some()).count());
    });
    group.finish();
}

criterion_group!(benches, traverse);
criterion_main!(benches);
