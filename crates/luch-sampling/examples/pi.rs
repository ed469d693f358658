//! π from the share of points that fall into a disc: the same loop for every sequence.
#![allow(clippy::print_stdout)]

use luch_sampling::{Domain, Sampler, Sequence};

fn main() {
    let count = 1 << 16;
    for sequence in Sequence::ALL {
        let inside = (0..count)
            .map(|index| Sampler::at(sequence, 1, [0, 0], index).group(Domain::new(0, 0)))
            .filter(|u| (u[0] - 0.5) * (u[0] - 0.5) + (u[1] - 0.5) * (u[1] - 0.5) <= 0.25)
            .count();
        println!("{:12} {:.6}", sequence.name(), 4.0 * inside as f64 / count as f64);
    }
}
