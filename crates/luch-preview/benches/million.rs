//! How long a million triangles take at 1280 × 720, with one thread and with two.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use luch_mesh::generate;
use luch_preview::{Fill, Size, StandardView, Style, Subject, draw, frame_all};
use std::hint::black_box;
use std::time::Duration;

fn million(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("million triangles at 1280x720");
    group.sample_size(20).warm_up_time(Duration::from_secs(1)).measurement_time(Duration::from_secs(4));
    let mesh = generate::torus(1.0, 0.4, 1000, 500);
    let size = Size { width: 1280, height: 720 };
    let subject = Subject::triangles(&mesh);
    let camera = frame_all(&subject.bounds(), StandardView::ThreeQuarter.direction(), 0.6, 16.0 / 9.0);
    group.throughput(Throughput::Elements(mesh.triangles.len() as u64));
    for threads in [1, 2] {
        let pool =
            rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads can be started");
        for fill in [Fill::Shaded, Fill::Faces] {
            let style = Style::filled(fill);
            let id = BenchmarkId::new(fill.name(), format!("{threads} threads"));
            group.bench_function(id, |bencher| {
                bencher.iter(|| pool.install(|| draw(black_box(&subject), &camera, size, &style)));
            });
        }
        group.bench_function(
            BenchmarkId::new("prepared and shaded", format!("{threads} threads")),
            |bencher| {
                bencher.iter(|| {
                    pool.install(|| {
                        draw(&Subject::triangles(black_box(&mesh)), &camera, size, &Style::default())
                    })
                });
            },
        );
    }
    group.finish();
}

criterion_group!(benches, million);
criterion_main!(benches);
