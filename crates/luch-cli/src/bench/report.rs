//! What was measured, as tables or as JSON.

use super::agree::Agreement;
use super::sets::RaySet;
use super::trace::{Cost, Kernel};
use crate::terminal::{self, say};
use luch::bvh::simd::Level;
use luch::bvh::{Quality, Statistics};
use serde_json::{Value, json};
use std::path::Path;

/// Trees of one quality.
pub(super) struct Build {
    pub(super) quality: Quality,
    pub(super) statistics: Statistics,
    /// Of each build.
    pub(super) seconds: Vec<f64>,
    /// Processor time of all threads, of each build; empty where the system does not tell.
    pub(super) processor: Vec<f64>,
}

/// A set traced in one way.
pub(super) struct Row {
    set: &'static str,
    rays: usize,
    quality: Quality,
    level: Level,
    pub(super) kernel: Kernel,
    pub(super) threads: usize,
    pub(super) hits: usize,
    /// Rays whose answer is not that of the first way, bit by bit.
    pub(super) other_bits: usize,
    pub(super) agreement: Option<Agreement>,
    /// Millions of rays a second: by mean processor time of the threads, and by elapsed time.
    by_processor: Vec<f64>,
    by_clock: Vec<f64>,
}

impl Row {
    pub(super) fn new(set: &RaySet, quality: Quality, level: Level, kernel: Kernel, threads: usize) -> Self {
        Self {
            set: set.kind.name(),
            rays: set.rays.len(),
            quality,
            level,
            kernel,
            threads,
            hits: 0,
            other_bits: 0,
            agreement: None,
            by_processor: Vec::new(),
            by_clock: Vec::new(),
        }
    }

    pub(super) fn add(&mut self, cost: Cost) {
        let speed = |seconds: f64| self.rays as f64 / seconds.max(1e-9) / 1e6;
        self.by_clock.push(speed(cost.elapsed.as_secs_f64()));
        self.by_processor.extend(cost.processor.map(|time| speed(time.as_secs_f64())));
    }

    fn json(&self, mesh: &str) -> Value {
        let mut object = json!({
            "event": "trace", "mesh": mesh, "set": self.set, "rays": self.rays, "hits": self.hits,
            "quality": quality_name(self.quality), "level": self.level.name(), "kernel": self.kernel.name(),
            "threads": self.threads, "mrays_by_processor": self.by_processor, "mrays_by_clock": self.by_clock,
            "other_bits": self.other_bits,
        });
        if let Some(agreement) = &self.agreement {
            object["reference"] = json!({
                "hit_or_miss": agreement.hit_or_miss, "primitive": agreement.primitive,
                "distance": agreement.distance, "worst": agreement.worst, "examples": agreement.examples,
            });
        }
        object
    }

    fn line(&self) -> String {
        format!(
            "{:<9} {:<9} {:<9} {:<11} {:>3}  {:<22} {:<22} {:>5.1} %  {}",
            self.set,
            quality_name(self.quality),
            self.level.name(),
            self.kernel.name(),
            self.threads,
            spread(&self.by_processor),
            spread(&self.by_clock),
            100.0 * self.hits as f64 / self.rays.max(1) as f64,
            self.verdict(),
        )
        .trim_end()
        .to_owned()
    }

    fn verdict(&self) -> String {
        let mut words = Vec::new();
        if self.other_bits > 0 {
            words.push(format!("{} ANSWERS ARE NOT THOSE OF THE FIRST ROW", self.other_bits));
        }
        if let Some(Agreement { hit_or_miss, primitive, distance, worst, .. }) = &self.agreement {
            let worst = terminal::short(*worst);
            words.push(format!(
                "{hit_or_miss} hit or miss, {primitive} triangle, {distance} distance (worst {worst})"
            ));
        }
        words.join("; ")
    }
}

/// Everything that was measured.
pub(super) struct Report<'a> {
    pub(super) mesh: &'a Path,
    pub(super) triangles: usize,
    pub(super) builds: Vec<&'a Build>,
    pub(super) rows: Vec<Row>,
}

impl Report<'_> {
    /// Whether all ways of tracing gave the same answers.
    pub(super) fn is_sound(&self) -> bool {
        self.rows.iter().all(|row| row.other_bits == 0)
    }

    pub(super) fn tell(&self, as_json: bool) {
        if as_json {
            let mesh = self.mesh.file_stem().unwrap_or_default().to_string_lossy();
            self.builds.iter().for_each(|build| say(&build.json(&mesh, self.triangles).to_string()));
            self.rows.iter().for_each(|row| say(&row.json(&mesh).to_string()));
            return;
        }
        say(&format!("{}: {} triangles", self.mesh.display(), self.triangles));
        say(
            "\nquality    build, ms (least to most)  processor, ms  Mtri/s  bytes/tri     nodes    leaves  depth  expected cost",
        );
        self.builds.iter().for_each(|build| say(&build.line(self.triangles)));
        let heads = "\nset       quality   level     kernel  threads  Mrays/s, processor     Mrays/s, elapsed          hits";
        let compared = self.rows.iter().any(|row| row.agreement.is_some());
        say(&format!("{heads}{}", if compared { "  differences from the files of hits" } else { "" }));
        self.rows.iter().for_each(|row| say(&row.line()));
        let mut examples: Vec<String> = Vec::new();
        for row in &self.rows {
            let of_row = row.agreement.iter().flat_map(|agreement| &agreement.examples);
            examples.extend(of_row.map(|example| format!("{}: {example}", row.set)));
        }
        examples.sort();
        examples.dedup();
        examples.iter().for_each(|example| say(example));
    }
}

impl Build {
    fn json(&self, mesh: &str, triangles: usize) -> Value {
        let Statistics { nodes, leaves, depth, expected_cost, memory_bytes, .. } = self.statistics;
        json!({
            "event": "build", "mesh": mesh, "triangles": triangles, "quality": quality_name(self.quality),
            "seconds": self.seconds, "processor_seconds": self.processor, "nodes": nodes, "leaves": leaves,
            "depth": depth, "expected_cost": expected_cost, "memory_bytes": memory_bytes,
        })
    }

    fn line(&self, triangles: usize) -> String {
        let statistics = &self.statistics;
        let millis = |seconds: &[f64]| seconds.iter().map(|seconds| seconds * 1e3).collect::<Vec<_>>();
        let speed = triangles as f64 / middle(&self.seconds).unwrap_or(f64::NAN) / 1e6;
        let processor = middle(&millis(&self.processor)).map_or("–".to_owned(), |ms| format!("{ms:.1}"));
        format!(
            "{:<10} {:<26} {processor:>13}  {speed:>6.2}  {:>9.1} {:>9} {:>9} {:>6}  {:>13.2}",
            quality_name(self.quality),
            spread(&millis(&self.seconds)),
            statistics.memory_bytes as f64 / triangles.max(1) as f64,
            statistics.nodes,
            statistics.leaves,
            statistics.depth,
            statistics.expected_cost,
        )
    }
}

/// A quality as it is typed.
pub(crate) fn quality_name(quality: Quality) -> &'static str {
    match quality {
        Quality::Fast => "fast",
        Quality::Balanced => "balanced",
        Quality::Best => "best",
    }
}

/// `3.20 (3.11 to 3.40)`
fn spread(values: &[f64]) -> String {
    let Some(middle) = middle(values) else { return "–".to_owned() };
    let least = values.iter().copied().fold(f64::INFINITY, f64::min);
    let most = values.iter().copied().fold(0.0, f64::max);
    format!("{middle:.2} ({least:.2} to {most:.2})")
}

/// The median; of an even number of values the upper one of the middle.
fn middle(values: &[f64]) -> Option<f64> {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted.get(sorted.len() / 2).copied()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spreads_have_a_middle_and_two_ends() {
        assert_eq!(spread(&[3.0, 1.0, 2.0]), "2.00 (1.00 to 3.00)");
        assert_eq!(spread(&[]), "–");
        assert_eq!(middle(&[4.0, 1.0]), Some(4.0));
    }
}
