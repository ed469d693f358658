//! The heart of many points: one at a time, in bulk at every level, with derivatives, and as ranges.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use luch_formula::{Interval, Level, RootFinder, Tape, parse};
use std::hint::black_box;

const HEART: &str = "(x^2+9/4*y^2+z^2-1)^3 - x^2*z^3 - 9/80*y^2*z^3";
const VARIABLES: [&str; 3] = ["x", "y", "z"];
const POINTS: usize = 1 << 16;

fn points() -> [Vec<f64>; 3] {
    // The additive recurrence of the plastic number: even, and the same every time.
    [0.819_172_513_396, 0.671_043_606_704, 0.549_700_477_902]
        .map(|step: f64| (0..POINTS).map(|i| 3.0 * (i as f64 * step).fract() - 1.5).collect())
}

fn tape(text: &str) -> Tape {
    let expression = parse(text, &VARIABLES).expect("a formula");
    Tape::new(&expression, &VARIABLES).expect("its variables")
}

fn heart(criterion: &mut Criterion) {
    let tape = tape(HEART);
    let points = points();
    let inputs: Vec<&[f64]> = points.iter().map(Vec::as_slice).collect();
    let mut values = vec![0.0; POINTS];
    let mut group = criterion.benchmark_group("heart");
    group.throughput(Throughput::Elements(POINTS as u64));
    group.sample_size(20);
    group.bench_function("written in Rust", |bencher| {
        bencher.iter(|| {
            for (i, value) in values.iter_mut().enumerate() {
                let [x, y, z] = [points[0][i], points[1][i], points[2][i]];
                let (xx, yy, z3) = (x * x, y * y, z * z * z);
                let body = xx + 2.25 * yy + z * z - 1.0;
                *value = body * body * body - xx * z3 - 0.1125 * yy * z3;
            }
            black_box(&values);
        });
    });
    group.bench_function("point by point", |bencher| {
        bencher.iter(|| {
            for (i, value) in values.iter_mut().enumerate() {
                *value = tape.value(&[points[0][i], points[1][i], points[2][i]]);
            }
            black_box(&values);
        });
    });
    for level in Level::ALL {
        group.bench_function(format!("in bulk, {level:?}"), |bencher| {
            let mut evaluator = tape.evaluator_at(level);
            bencher.iter(|| {
                evaluator.evaluate(&inputs, &mut values);
                black_box(&values);
            });
        });
    }
    let mut slopes = vec![vec![0.0; POINTS]; 3];
    for level in Level::ALL {
        group.bench_function(format!("with derivatives, {level:?}"), |bencher| {
            let mut evaluator = tape.evaluator_at(level);
            bencher.iter(|| {
                let mut lists: Vec<&mut [f64]> = slopes.iter_mut().map(Vec::as_mut_slice).collect();
                evaluator.gradients(&inputs, &mut values, &mut lists);
                black_box(&values);
            });
        });
    }
    group.finish();

    let mut group = criterion.benchmark_group("heart, one at a time");
    group.bench_function("range over a box", |bencher| {
        let side = black_box(Interval::new(0.25, 0.5));
        bencher.iter(|| tape.interval(&[side; 3]));
    });
    group.bench_function("first root along a ray", |bencher| {
        let mut finder = RootFinder::new(&tape, 1e-9);
        bencher.iter(|| finder.first(black_box(&[0.2, -4.0, 0.3]), &[0.05, 1.0, 0.02], 0.0, 10.0));
    });
    group.finish();
}

fn costly(criterion: &mut Criterion) {
    let points = points();
    let inputs: Vec<&[f64]> = points.iter().map(Vec::as_slice).collect();
    let mut values = vec![0.0; POINTS];
    let mut group = criterion.benchmark_group("functions");
    group.throughput(Throughput::Elements(POINTS as u64));
    group.sample_size(20);
    let texts = [
        "sin(x)",
        "exp(x)",
        "ln(x + 2)",
        "x^2.5",
        "atan2(y, x)",
        "mod(x, 0.3)",
        "noise(4x, 4y, 4z)",
        "sqrt(x*x)",
        "x/y",
        "min(x, y, z)",
        "floor(x) + round(y)",
    ];
    for text in texts {
        let tape = tape(text);
        group.bench_function(text, |bencher| {
            bencher.iter(|| {
                tape.evaluate(&inputs, &mut values);
                black_box(&values);
            });
        });
    }
    group.finish();
}

criterion_group!(benches, heart, costly);
criterion_main!(benches);
