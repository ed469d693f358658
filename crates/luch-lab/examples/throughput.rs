//! Evaluations a second of simple formulas: `cargo run --release -p luch-lab --example throughput`.

#![allow(clippy::print_stdout)]

use luch_lab::integral::{HashedPoints, Integral, RulePoints};
use luch_lab::points::Rule;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let cases = [
        ("x*y", "x=0..1,y=0..1"),
        ("x^2+y^2 <= 1", "x=0..1,y=0..1"),
        ("exp(-x^2)", "x=0..1"),
        ("cos(x)^8", "x=-pi/2..pi/2"),
        ("cos(x)^77", "x=-pi/2..pi/2"),
    ];
    for (formula, domain) in cases {
        let integral = Integral::new(formula, domain)?;
        let count = 1u64 << 25;
        let sobol = RulePoints { rule: Rule::SobolHashed, seed: 1 };
        let independent = HashedPoints { seed: 1 };
        let sources: [(&str, &dyn luch_lab::integral::Points); 2] =
            [("independent", &independent), ("sobol-hashed", &sobol)];
        for (name, points) in sources {
            let start = std::time::Instant::now();
            let sums = integral.estimate(points, 0, count);
            let rate = count as f64 / start.elapsed().as_secs_f64() / 1e6;
            println!("{formula:16} {name:12} {rate:7.1} million a second, mean {:?}", sums.mean());
        }
    }
    Ok(())
}
