//! How long a tree takes to build, by quality and number of triangles.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use luch_bvh::{Quality, TriangleBvh};
use std::hint::black_box;
use std::time::Duration;

mod scene;

fn build(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("build");
    group.sample_size(10).warm_up_time(Duration::from_millis(300)).measurement_time(Duration::from_secs(2));
    for sides in [50, 160, 500] {
        let mesh = scene::bumpy_torus(sides);
        group.throughput(Throughput::Elements(mesh.triangles.len() as u64));
        for quality in Quality::ALL {
            let id = BenchmarkId::new(format!("{quality:?}"), mesh.triangles.len());
            group.bench_function(id, |bencher| {
                bencher.iter(|| TriangleBvh::build(black_box(&mesh.positions), &mesh.triangles, quality));
            });
        }
    }
    group.finish();
}

criterion_group!(benches, build);
criterion_main!(benches);
