//! How often the stopping rule's interval held the truth: `cargo run --release -p luch-lab --example coverage`.
#![allow(clippy::print_stdout)]

use luch_lab::integral::{Points, SequencePoints, Target, coverage};
use luch_sampling::Sequence;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let points =
        |run| -> Box<dyn Points> { Box::new(SequencePoints { sequence: Sequence::Sobol, seed: 5000 + run }) };
    for text in ["rel 0.02 @ 90%", "rel 0.01 @ 95%"] {
        println!("{text}");
        for one in coverage(&points, Target::parse(text)?, 1 << 22, 100) {
            let share = one.error_over_half_width;
            println!(
                "  {:14} held {:4} of {:4}, {:9.0} points, error/half width {share:.2}",
                one.name, one.held, one.runs, one.samples
            );
        }
    }
    Ok(())
}
