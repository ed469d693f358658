//! A section through a solid, drawn with letters: `cargo run --example section -- "hypot(x, y) - 1"`.
//!
//! Without a formula it shows the heart, cut through the middle. Ranges over boxes tell which parts of the picture are surely
//! inside or outside; only the rest is evaluated point by point, with a tape made shorter for the box.
#![allow(clippy::print_stdout)]

use luch_formula::{Formula, Interval, Tape};

const WIDTH: usize = 72;
const HEIGHT: usize = 36;
/// Characters along a side of a box.
const BOX: usize = 6;
const HALF: f64 = 1.4;

fn main() {
    let text = std::env::args().nth(1);
    let formula = Formula::new(text.as_deref().unwrap_or("(x^2+9/4*y^2+z^2-1)^3 - x^2*z^3 - 9/80*y^2*z^3"));
    // The section lies in the plane y = 0, z upward.
    let variables = ["x", "y", "z"];
    let solid = match formula.parse_equation(&variables) {
        Ok(solid) => solid,
        Err(error) => return println!("{error}"),
    };
    let tape = Tape::new(&solid, &variables).expect("no other variables can be in it");

    let x = |column: usize| HALF * (2.0 * column as f64 / WIDTH as f64 - 1.0);
    let z = |row: usize| HALF * (1.0 - 2.0 * row as f64 / HEIGHT as f64);
    let mut picture = vec![[' '; WIDTH]; HEIGHT];
    let mut decided = 0;
    for top in (0..HEIGHT).step_by(BOX) {
        for left in (0..WIDTH).step_by(BOX) {
            let sides = [
                Interval::new(x(left), x(left + BOX)),
                Interval::point(0.0),
                Interval::new(z(top), z(top + BOX)),
            ];
            let traced = tape.trace(&sides);
            let shorter = tape.simplify(&traced.choices);
            let known = !traced.value.contains_zero() && !traced.value.partial;
            decided += usize::from(known);
            for (row, line) in picture.iter_mut().enumerate().skip(top).take(BOX) {
                let columns: Vec<f64> =
                    (left..left + BOX).map(|column| x(column) + HALF / WIDTH as f64).collect();
                let rows = [z(row) - HALF / HEIGHT as f64; BOX];
                let mut values = [traced.value.low; BOX];
                if !known {
                    shorter.evaluate(&[&columns, &[0.0; BOX], &rows], &mut values);
                }
                for (place, value) in line[left..].iter_mut().zip(values) {
                    *place = if value < 0.0 { '#' } else { '.' };
                }
            }
        }
    }
    for row in picture {
        println!("{}", row.iter().collect::<String>());
    }
    let boxes = WIDTH / BOX * HEIGHT / BOX;
    println!("{decided} of {boxes} boxes were decided as a whole; {} operations a point", tape.operations());
}
