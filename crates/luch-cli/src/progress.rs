//! Telling how far it is.

use crate::args::ProgressStyle;
use crate::terminal;
use luch::render::{Ending, JobEnd, Progress};
use serde_json::{Value, json};
use std::io::IsTerminal;
use std::path::Path;
use std::time::{Duration, Instant};

/// Time between two lines of the bar.
const BAR_EVERY: Duration = Duration::from_millis(200);

/// Time between two JSON objects.
const JSON_EVERY: Duration = Duration::from_millis(500);

/// Cells of the bar, each with eight levels.
const CELLS: usize = 12;

/// What is told before anything else.
pub(crate) struct Start<'a> {
    pub(crate) scene: &'a str,
    pub(crate) fingerprint: String,
    pub(crate) width: u32,
    pub(crate) height: u32,
    pub(crate) samples_in_film: f64,
    pub(crate) outputs: Vec<&'a Path>,
}

/// What rendering alone cost: without reading the scene, building trees and writing files.
pub(crate) struct Alone {
    pub(crate) elapsed: Duration,
    /// Of all threads; `None` where the system does not tell.
    pub(crate) processor: Option<Duration>,
}

/// Tells progress in the style asked for.
pub(crate) struct Reporter {
    style: ProgressStyle,
    endless: bool,
    time: Option<Duration>,
    next: Instant,
}

impl Reporter {
    /// `time` is that of the goal, if it has one.
    pub(crate) fn new(style: ProgressStyle, endless: bool, time: Option<Duration>) -> Self {
        let style = match style {
            ProgressStyle::Auto if std::io::stderr().is_terminal() => ProgressStyle::Bar,
            ProgressStyle::Auto => ProgressStyle::Plain,
            other => other,
        };
        Self { style, endless, time, next: Instant::now() }
    }

    /// Whether a summary is wanted.
    pub(crate) fn tells(&self) -> bool {
        self.style != ProgressStyle::None
    }

    pub(crate) fn start(&self, start: &Start<'_>) {
        if self.style == ProgressStyle::Json {
            say(&json!({
                "event": "start",
                "scene": start.scene,
                "fingerprint": start.fingerprint,
                "width": start.width,
                "height": start.height,
                "samples_in_film": start.samples_in_film,
                "outputs": names(&start.outputs),
            }));
        }
    }

    /// Tells the progress if it is time to.
    pub(crate) fn look(&mut self, progress: &Progress) {
        let now = Instant::now();
        if now < self.next {
            return;
        }
        match self.style {
            ProgressStyle::Bar => {
                terminal::rewrite_line(&self.line(progress));
                self.next = now + BAR_EVERY;
            }
            ProgressStyle::Json => {
                say(&numbers("progress", progress));
                self.next = now + JSON_EVERY;
            }
            ProgressStyle::Auto | ProgressStyle::Plain | ProgressStyle::None => {}
        }
    }

    pub(crate) fn end(&self, end: &JobEnd, alone: &Alone, outputs: Vec<&Path>) {
        match self.style {
            ProgressStyle::Bar => terminal::rewrite_line(""),
            ProgressStyle::Json => {
                let mut object = numbers("end", &end.progress);
                let losses = end.film.losses();
                object["ending"] = json!(ending_name(end.ending));
                object["render_seconds"] = json!(alone.elapsed.as_secs_f64());
                object["processor_seconds"] = json!(alone.processor.map(|time| time.as_secs_f64()));
                object["outputs"] = json!(names(&outputs));
                object["saturated"] = json!(losses.saturated);
                object["invalid"] = json!(losses.invalid);
                say(&object);
            }
            ProgressStyle::Auto | ProgressStyle::Plain | ProgressStyle::None => {}
        }
    }

    /// `12% ▕███▏ 31/256 spp  4.2 M samples/s  0:12 elapsed  0:34 left  error 2.1 %`
    fn line(&self, progress: &Progress) -> String {
        let mut words = Vec::new();
        if let Some(share) = self.share(progress) {
            words.push(format!("{:3.0}% {}", (share * 100.0).floor(), bar(share)));
        }
        let have = terminal::samples(progress.samples_per_pixel);
        words.push(match progress.samples_wanted {
            Some(wanted) => format!("{have}/{wanted} spp"),
            None => format!("{have} spp"),
        });
        words.push(format!("{}samples/s", terminal::metric(progress.rate)));
        words.push(format!("{} elapsed", terminal::clock(progress.elapsed)));
        if let Some(remaining) = progress.remaining {
            words.push(format!("{} left", terminal::clock(remaining)));
        }
        if let Some(error) = progress.error {
            words.push(format!("error {} %", terminal::short(error.relative * 100.0)));
        }
        if self.endless {
            words.push("until Ctrl-C".to_owned());
        }
        words.join("  ")
    }

    /// The part of the work that is done, by the goal that is nearest.
    fn share(&self, progress: &Progress) -> Option<f64> {
        let by_samples = progress.samples_wanted.map(|wanted| progress.samples_per_pixel / wanted as f64);
        let by_time = self.time.map(|time| progress.elapsed.as_secs_f64() / time.as_secs_f64());
        let known = [by_samples, by_time]
            .into_iter()
            .flatten()
            .fold(None, |most: Option<f64>, share| Some(most.map_or(share, |most| most.max(share))));
        let guessed = progress
            .remaining
            .map(|left| progress.elapsed.as_secs_f64() / (progress.elapsed + left).as_secs_f64().max(1e-9));
        known.or(guessed).map(|share| share.clamp(0.0, 1.0))
    }
}

/// Twelve cells, filled from the left.
pub(crate) fn bar(share: f64) -> String {
    const LEVELS: [char; 8] = [' ', '▏', '▎', '▍', '▌', '▋', '▊', '▉'];
    let eighths = (share * (CELLS * 8) as f64) as usize;
    let mut cells: String = "█".repeat(eighths / 8);
    if eighths / 8 < CELLS {
        cells.push(LEVELS[eighths % 8]);
        cells.push_str(&" ".repeat(CELLS - 1 - eighths / 8));
    }
    format!("▕{cells}▏")
}

fn numbers(event: &str, progress: &Progress) -> Value {
    json!({
        "event": event,
        "samples_per_pixel": progress.samples_per_pixel,
        "samples_wanted": progress.samples_wanted,
        "rate": progress.rate,
        "elapsed": progress.elapsed.as_secs_f64(),
        "remaining": progress.remaining.map(|left| left.as_secs_f64()),
        "error": progress.error.map(|error| error.relative),
        "rmse": progress.error.map(|error| error.rmse),
    })
}

fn ending_name(ending: Ending) -> &'static str {
    match ending {
        Ending::Samples => "samples",
        Ending::Time => "time",
        Ending::Error => "error",
        Ending::Cancelled => "interrupted",
    }
}

fn names(paths: &[&Path]) -> Vec<String> {
    paths.iter().map(|path| path.display().to_string()).collect()
}

fn say(object: &Value) {
    terminal::say(&object.to_string());
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bar_keeps_its_length() {
        for step in 0..=100 {
            assert_eq!(bar(f64::from(step) / 100.0).chars().count(), CELLS + 2);
        }
        assert_eq!(bar(0.0), format!("▕{}▏", " ".repeat(CELLS)));
        assert_eq!(bar(1.0), format!("▕{}▏", "█".repeat(CELLS)));
    }
}
