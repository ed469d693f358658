//! Surfaces of samples and of formulas.

use criterion::{Criterion, criterion_group, criterion_main};
use glam::DVec3;
use luch_mesh::implicit::{FunctionField, Method, Region, Sampling, Solid, marching_cubes, sample, surface};

fn surfaces(criterion: &mut Criterion) {
    let sampling = Sampling { region: Region::cube(1.2), resolution: 128, closed: false };
    let ball = sample(&FunctionField(|p: DVec3| p.length() - 1.0), &sampling).expect("a small grid");
    criterion.bench_function("marching cubes, a ball of 128³ samples", |bencher| {
        bencher.iter(|| marching_cubes(&ball, 0.0));
    });
    let gyroid = Solid::Gyroid { period: 0.8, thickness: 0.1 }.field().expect("a gyroid");
    for method in [Method::MarchingCubes, Method::DualContouring] {
        criterion.bench_function(&format!("{method:?}, a gyroid of 128³ cells"), |bencher| {
            bencher.iter(|| surface(&gyroid, &sampling, method));
        });
    }
}

criterion_group! { name = all; config = Criterion::default().sample_size(10); targets = surfaces }
criterion_main!(all);
