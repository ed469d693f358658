//! `luch compare`: how far two pictures are apart.

use crate::args::CompareArgs;
use crate::failure::{Failure, Outcome};
use crate::film_file;
use crate::interrupt::Interrupt;
use crate::outputs::{self, Outputs};
use crate::same_file::refuse_replacing;
use crate::terminal;
use luch::formats::{Files, save_image};
use luch::image::codec::{self, Metadata};
use luch::image::compare::{Comparison, compare, false_difference};
use luch::image::tone::Tone;
use luch::image::{Image, Rgb};
use serde_json::json;
use std::path::Path;

pub(crate) fn run(args: &CompareArgs) -> Result<Outcome, Failure> {
    let pen = Interrupt::install()?.pen();
    if let Some(path) = &args.output {
        // A difference is shown in 8 bits a channel.
        if Outputs::new(std::slice::from_ref(path), 8)?.films().next().is_some() {
            let path = path.display();
            return Err(Failure::usage(format!("{path}: a difference is a picture, not a film")));
        }
        refuse_replacing(&[path], &[&args.a, &args.b])?;
        outputs::probe(path)?;
    }
    let (a, b) = (read(&args.a)?, read(&args.b)?);
    let comparison = compare(&a, &b)
        .map_err(|error| Failure::new(format!("{} and {}: {error}", args.a.display(), args.b.display())))?;
    let exceeded = exceeded(args, &comparison);
    if args.json {
        let mut object = serde_json::to_value(comparison)?;
        object["exceeded"] = json!(exceeded);
        terminal::say(&object.to_string());
    } else {
        report(&comparison);
        exceeded.iter().for_each(|limit| terminal::say(&format!("exceeded: {limit}")));
    }
    if let Some(path) = &args.output {
        // White is the largest mean difference of a pixel.
        let differences = luch::image::compare::absolute_difference(&a, &b)?;
        let most =
            differences.pixels().iter().map(|p| p.mean()).filter(|v| v.is_finite()).fold(0.0, f32::max);
        let full = if most > 0.0 { most } else { 1.0 };
        let metadata = Metadata::from([("luch:white", full.to_string())]);
        let _held = pen.hold();
        save_image(path, &false_difference(&a, &b, full)?, &Tone::default(), &metadata)?;
    }
    Ok(if exceeded.is_empty() { Outcome::Done } else { Outcome::Unmet })
}

/// The light of a picture or film.
fn read(path: &Path) -> Result<Image<Rgb>, Failure> {
    if film_file::is_film(path) {
        return Ok(film_file::read(path)?.film.to_image());
    }
    let bytes = Files::disk().read(path).map_err(|problem| Failure::new(problem.to_string()))?;
    let bitmap =
        codec::decode(&bytes, None).map_err(|error| Failure::new(format!("{}: {error}", path.display())))?;
    Ok(bitmap.to_rgb())
}

/// Limits that are exceeded, in words. What is not a number exceeds every limit.
fn exceeded(args: &CompareArgs, comparison: &Comparison) -> Vec<String> {
    let largest = comparison.largest.map_or(f64::INFINITY, |place| place.difference);
    let limits = [
        ("mean squared error", comparison.mse, args.max_mse),
        ("relative squared error", comparison.relative_mse, args.max_rel_mse),
        ("largest difference", largest, args.max_difference),
    ];
    let over = |(name, value, limit): (&str, f64, Option<f64>)| {
        let limit = limit?;
        (value.is_nan() || value > limit || comparison.non_finite > 0)
            .then(|| format!("{name} {value:e} is over {limit:e}, or pixels are not finite"))
    };
    limits.into_iter().filter_map(over).collect()
}

fn report(comparison: &Comparison) {
    let rows = [
        ("mean squared error", comparison.mse),
        ("root of it", comparison.rmse),
        ("mean absolute error", comparison.mae),
        ("relative squared error", comparison.relative_mse),
        ("  without the worst 0.1 %", comparison.relative_mse_trimmed),
        ("PSNR as shown, dB", comparison.psnr),
    ];
    for (name, value) in rows {
        terminal::say(&format!("{name:<26} {}", terminal::short(value)));
    }
    let ssim = comparison.ssim.map_or("—".to_owned(), |ssim| format!("{ssim:.6}"));
    terminal::say(&format!("{:<26} {ssim}", "SSIM"));
    let [a, b] = [comparison.mean_a, comparison.mean_b].map(|mean| mean.map(terminal::short).join(" "));
    terminal::say(&format!("{:<26} {a}", "mean of the first"));
    terminal::say(&format!("{:<26} {b}", "mean of the second"));
    if let Some(place) = comparison.largest {
        let difference = terminal::short(place.difference);
        terminal::say(&format!(
            "{:<26} {difference} at pixel ({}, {})",
            "largest difference", place.x, place.y
        ));
    }
    if comparison.non_finite > 0 {
        terminal::say(&format!("{:<26} {}", "pixels not finite", comparison.non_finite));
    }
}
