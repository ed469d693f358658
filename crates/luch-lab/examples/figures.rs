//! Draws one figure of every kind into a folder: `cargo run -p luch-lab --example figures -- FOLDER`.

use luch_lab::density::{CENTERED, dimensions, dimensions_figure, normal_scan, square_sheet};
use luch_lab::figure::*;
use luch_lab::integral::{HashedPoints, Integral, SequencePoints};
use luch_lab::problem::Problem;
use luch_sampling::Sequence;

fn main() -> std::io::Result<()> {
    let folder = std::env::args().nth(1).unwrap_or_else(|| "gallery".into());
    std::fs::create_dir_all(&folder)?;
    let number = |key: u64, i: u64| luch_sampling::hash::word(key, i) as f64 / 18_446_744_073_709_551_616.0;
    let powers = |slope: f64, key: u64| -> Vec<[f64; 2]> {
        (6..=16)
            .map(|k| {
                let n = f64::from(1u32 << k);
                [n, libm::pow(n, slope) * (0.85 + 0.3 * number(key, k as u64))]
            })
            .collect()
    };
    let convergence = Figure::new("Error against the number of samples")
        .with_caption("Root mean square error of 64 replicates of π from a disc in a square. Independent points fall with the root of N; scrambled nets are better by a power of N that grows as the integrand gets smoother.")
        .with_x(Axis::log2("samples N"))
        .with_y(Axis::log10("root mean square error"))
        .band("95 % interval", Ink::Blue, powers(-0.5, 1).iter().map(|[x, y]| Between { x: *x, low: y * 0.8, high: y * 1.25 }).collect())
        .marked("independent", Ink::Blue, Marker::Disc, powers(-0.5, 1))
        .marked("stratified", Ink::Vermilion, Marker::Square, powers(-0.75, 2))
        .marked("Halton", Ink::Green, Marker::Triangle, powers(-0.95, 3))
        .marked("Sobol’, Owen", Ink::Purple, Marker::Diamond, powers(-1.45, 4))
        .reference("N^−1/2", [64.0, 0.2], -0.5)
        .reference("N^−3/2", [64.0, 0.001], -1.5);
    let points: Vec<[f64; 2]> = (0..1000).map(|i| [number(7, i), number(8, i)]).collect();
    let scatter = Figure::unit_square("1000 independent points").points("", Ink::Blue, points.clone(), 3.2);
    let weights: Vec<f64> =
        points.iter().map(|[x, y]| 0.2 + 2.0 * (x - 0.5).abs() + 2.0 * (y - 0.5).abs()).collect();
    let weighted = Figure::unit_square("Weights as areas").with(
        "",
        Ink::Vermilion,
        Mark::Weighted { points, weights, size: 6.0 },
    );
    let heat = Figure::unit_square("A density").heat(
        "",
        Raster::of_function(96, |x, y| {
            libm::exp(-20.0 * ((x - 0.4) * (x - 0.4) + (y - 0.55) * (y - 0.55))) + 0.2 * x
        }),
    );
    let edges: Vec<f64> = (0..=40).map(|i| -2.0 + 0.1 * f64::from(i)).collect();
    let heights: Vec<f64> = edges.windows(2).map(|e| libm::exp(-2.0 * e[0] * e[1])).collect();
    let histogram = Figure::new("Samples and their density")
        .with_x(Axis::linear("x"))
        .with_y(Axis::linear("per unit"))
        .bars("samples", Ink::Sky, edges.clone(), heights)
        .line(
            "density",
            Ink::Vermilion,
            (0..=200).map(|i| -2.0 + 0.02 * f64::from(i)).map(|x| [x, libm::exp(-2.0 * x * x)]).collect(),
        )
        .place("mean", 0.0)
        .errors("estimate", Ink::Text, vec![ErrorBar { x: 0.9, y: 0.5, low: 0.4, high: 0.6 }])
        .note("a note, anywhere", [-1.9, 0.8], Anchor::Left);
    let letters = Figure::new("ABCDEFGHIJKLMNOPQRSTUVWXYZ 0123456789 ∫cos⁷⁷x dx = √π Γ(39)/Γ(39.5)")
        .with_caption("The quick brown fox jumps over the lazy dog; 1.96 ± 0.02 × 10⁻³ ≈ ≤ ≥ → ∞ π σ μ ρ α β γ δ ε θ λ φ ω Δ Σ Ω “quotes” (brackets) [square] {curly} a/b 50% x_i = y² & @ # * ! ? : ; — – - Жълтата дюля беше щастлива, че пухът, който цъфна, замръзна като гьон. АБВГДЕЖЗИЙКЛМНОПРСТУФХЦЧШЩЪЬЮЯ")
        .line("sine", Ink::Blue, (0..400).map(|i| f64::from(i) * 0.02).map(|x| [x, libm::sin(x)]).collect())
        .with_x(Axis::linear("x")).with_y(Axis::linear("sin x"));
    let sheet = Sheet::new(
        "Points side by side",
        2,
        vec![scatter, weighted, heat.clone(), Figure { title: "Logarithmic".into(), ..heat.clone() }],
    )
    .with_caption("Four pictures of the unit square.");
    let write = |name: &str, figure: &Figure| -> std::io::Result<()> {
        std::fs::write(format!("{folder}/{name}.svg"), figure.to_svg())?;
        std::fs::write(format!("{folder}/{name}.txt"), figure.to_terminal(90, Depth::TrueColor))?;
        std::fs::write(format!("{folder}/{name}-plain.txt"), figure.to_terminal(90, Depth::Letters))?;
        std::fs::write(format!("{folder}/{name}.png"), figure.to_png(PngOptions::default()))?;
        std::fs::write(
            format!("{folder}/{name}-dark.png"),
            figure.to_png(PngOptions { theme: Theme::Dark, scale: 2.0 }),
        )
    };
    write("convergence", &convergence)?;
    write("heat", &heat)?;
    write("histogram", &histogram)?;
    write("letters", &letters)?;
    for name in ["pi", "acute", "cos77-normal", "lamp-rectangle", "edge", "glossy"] {
        let Some(problem) = Problem::named(name) else { continue };
        let run = problem.run(1 << 14, &HashedPoints { seed: 1 });
        write(&format!("problem-{name}"), &run.figure)?;
        write(&format!("progress-{name}"), &run.progress)?;
    }
    let points = HashedPoints { seed: 1 };
    let sobol = SequencePoints { sequence: Sequence::Sobol, seed: 1 };
    if let Ok(square) = square_sheet(CENTERED, &sobol, 1000) {
        std::fs::write(format!("{folder}/square.png"), square.to_png(PngOptions::default()))?;
    }
    let sizes: Vec<u64> = (6..=14).map(|k| 1 << k).collect();
    if let Ok(study) = dimensions(&[1, 2, 5, 10, 20], &sizes, 24, &points, &sobol) {
        let sheet = dimensions_figure(&study);
        std::fs::write(
            format!("{folder}/dimensions.png"),
            sheet.to_png(PngOptions { theme: Theme::Dark, scale: 1.5 }),
        )?;
    }
    if let Ok(bell) = Integral::new("cos(x)^77", "x=-pi/2..pi/2")
        && let Some(scan) = normal_scan(&bell, 0.0, 0.07, 0.6, 200)
    {
        write("scan", &scan.figure)?;
    }
    std::fs::write(format!("{folder}/sheet.png"), sheet.to_png(PngOptions::default()))?;
    std::fs::write(format!("{folder}/sheet.svg"), sheet.to_svg())
}
