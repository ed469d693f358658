//! Points a second: `points_speed COUNT DIMENSIONS REPEATS [RULE …]`, one thread.
//!
//! Prints for each rule its name and millions of coordinates a second (median of the repeats), then the same of the crate `sobol_burley`.
//! `bench/peers/points.py` runs it beside other programs.

use luch_lab::points::Rule;
use std::error::Error;
use std::io::Write;
use std::time::Instant;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [count, dimensions, repeats, names @ ..] = arguments.as_slice() else {
        return Err("usage: points_speed COUNT DIMENSIONS REPEATS [RULE …]".into());
    };
    let (count, dimensions): (usize, usize) = (count.parse()?, dimensions.parse()?);
    let repeats: usize = repeats.parse()?;
    let mut out = vec![0.0; count * dimensions];
    for name in names {
        let rule = Rule::from_name(name).ok_or("no such rule")?;
        tell(name, repeats, &mut out, |out| Ok(rule.points_into(dimensions, 1, 0, out)?))?;
    }
    // Four dimensions at a time is its fast way.
    tell("sobol_burley", repeats, &mut out, |out| {
        for (index, point) in out.chunks_exact_mut(dimensions).enumerate() {
            for (set, four) in point.chunks_mut(4).enumerate() {
                let numbers = sobol_burley::sample_4d(index as u32, set as u32, 1);
                four.iter_mut().zip(numbers).for_each(|(out, number)| *out = f64::from(number));
            }
        }
        Ok(())
    })
}

fn tell(
    name: &str,
    repeats: usize,
    out: &mut [f64],
    mut work: impl FnMut(&mut [f64]) -> Result<(), Box<dyn Error>>,
) -> Result<(), Box<dyn Error>> {
    let mut rates = Vec::new();
    for _ in 0..repeats {
        let start = Instant::now();
        work(out)?;
        rates.push(out.len() as f64 / start.elapsed().as_secs_f64() / 1e6);
    }
    rates.sort_by(f64::total_cmp);
    Ok(writeln!(std::io::stdout(), "{name}\t{:.2}", rates[rates.len() / 2])?)
}
