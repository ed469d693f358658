//! First roots along the rays of a picture: polynomials, the same by ranges alone, and other formulas. A bench is one ray.

use criterion::{Criterion, criterion_group, criterion_main};
use luch_formula::{RootFinder, Tape, parse};
use std::hint::black_box;

const VARIABLES: [&str; 3] = ["x", "y", "z"];

/// A name, a formula, and half the side of its box.
const SURFACES: [(&str, &str, f64); 6] = [
    ("heart", "(x^2+9/4*y^2+z^2-1)^3 - x^2*z^3 - 9/80*y^2*z^3", 1.5),
    ("torus", "(x^2 + y^2 + z^2 + 0.75)^2 - 4*(x^2 + y^2)", 1.5),
    ("torus by a root", "(hypot(x, y) - 1)^2 + z^2 - 0.0625", 1.5),
    (
        "gyroid in a ball",
        "max(sin(5x)*cos(5y) + sin(5y)*cos(5z) + sin(5z)*cos(5x), x^2 + y^2 + z^2 - 1)",
        1.0,
    ),
    (
        "two balls less one",
        "max(min(hypot(x, y, z) - 1, hypot(x - 0.5, y, z) - 0.8), 0.6 - hypot(x, y, z - 1))",
        1.5,
    ),
    ("noise on a ball", "hypot(x, y, z) - 1 + 0.2*noise(3x, 3y, 3z)", 1.5),
];

struct Ray {
    origin: [f64; 3],
    direction: [f64; 3],
}

/// From one point before the box to points of the plane through its middle, cut to the box's reach.
fn rays(half: f64) -> Vec<Ray> {
    let eye = [0.4 * half, -4.0 * half, 0.7 * half];
    (0..4096)
        .map(|i| {
            let [x, z] = [0.754_877_666, 0.569_840_291]
                .map(|step: f64| half * (2.0 * (f64::from(i) * step).fract() - 1.0));
            Ray { origin: eye, direction: [x - eye[0], -eye[1], z - eye[2]] }
        })
        .collect()
}

fn roots(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("first root");
    for (name, text, half) in SURFACES {
        let tape =
            Tape::new(&parse(text, &VARIABLES).expect("a formula"), &VARIABLES).expect("its variables");
        let rays = rays(half);
        for (way, intervals_only) in [("", false), (", by ranges alone", true)] {
            group.bench_function(format!("{name}{way}"), |bencher| {
                let mut next = rays.iter().cycle();
                bencher.iter(|| {
                    let ray = next.next().expect("a circle");
                    let finder = RootFinder::new(&tape, 1e-9);
                    let mut finder = if intervals_only { finder.intervals_only() } else { finder };
                    finder.first(black_box(&ray.origin), &ray.direction, 0.74, 1.26)
                });
            });
        }
    }
    group.finish();
}

criterion_group!(benches, roots);
criterion_main!(benches);
