//! Coverage as a page.

use super::coverage::{ClassCoverage, CoverageStudy};
use super::page::percent;
use super::reading::{Measured, Reading};
use crate::figure::{Axis, ErrorBar, Figure, Ink, Marker, Sheet};
use crate::report::{Report, Table};

/// A reference this noisy against an estimate makes the correction for it the larger part of what is found.
const LOUD: f64 = 0.1;

/// One of the two readings of a class.
type Of = fn(&ClassCoverage) -> &Vec<Measured>;

impl CoverageStudy {
    /// What was found under what stands on `page` already.
    pub fn page(&self, page: Report) -> Report {
        let [width, height] = self.size;
        let mut page = page
            .text(format!(
                "{} renders of {width}×{height} pixels with {} samples each, {} by {}, every one with a seed of its own.",
                self.renders, self.samples, self.integrator, self.sequence
            ))
            .text(format!("Reference: {}. It counts by its own variance.", self.reference.origin));
        if let Some(worst) =
            self.all().map(|class| class.reference_share).reduce(f64::max).filter(|share| *share > LOUD)
        {
            page = page.text(format!(
                "WARNING: the reference has up to {} of the variance of the estimates: what follows is rough. Give it more samples.",
                percent(worst)
            ));
        }
        page = page
            .heading("How often the interval held the truth")
            .text("Read by Student's t. A pixel states its error by the difference of two streams, one number: one degree of freedom.")
            .table(self.table(|class| &class.student))
            .text("Read as if the stated error were known, ± 1.96 of it for 95 %.")
            .table(self.table(|class| &class.normal))
            .text("In brackets the binomial interval at 95 %; only renders count as independent.")
            .heading("How right stated errors are")
            .table(self.errors())
            .text("Stated/true: root of the mean stated variance over the true root mean square error, 1 if right. Blind: intervals without width beside the truth. Certain: pixels where nothing is random, left out. Reference: its variance as a part of the estimates'.");
        for sentence in self.verdicts() {
            page = page.text(sentence);
        }
        let figures = vec![
            self.figure("Read by Student's t", |class| &class.student, Reading::Student(1.0)),
            self.figure("Read as normal", |class| &class.normal, Reading::Normal),
        ];
        let caption = "On the dashed line intervals hold as often as they say. The dotted line in the second figure is that of normal noise.";
        // Plain data with texts as keys: nothing that could fail.
        page.sheet(Sheet::new("Coverage", 2, figures).with_caption(caption))
            .with_data("results", serde_json::to_value(self).unwrap_or_default())
    }

    fn all(&self) -> impl Iterator<Item = &ClassCoverage> {
        self.classes.iter().chain([&self.mean])
    }

    fn table(&self, of: impl Fn(&ClassCoverage) -> &Vec<Measured>) -> Table {
        let levels =
            self.all().find_map(|class| of(class).first().map(|_| of(class).clone())).unwrap_or_default();
        let head = ["pixels".to_owned(), "count".to_owned()].into_iter();
        let head = head.chain(levels.iter().map(|found| percent_of_level(found.level)));
        self.all().fold(Table::new(head), |table, class| {
            let fields = of(class).iter().map(|found| {
                let [low, high] = found.interval.map(|end| 100.0 * end);
                format!("{:.1} ({low:.1} … {high:.1})", 100.0 * found.coverage)
            });
            table.row([class.name.clone(), class.pixels.to_string()].into_iter().chain(fields))
        })
    }

    fn errors(&self) -> Table {
        let head = ["pixels", "stated/true", "±", "blind", "certain", "reference"];
        self.all().fold(Table::new(head), |table, class| {
            table.row([
                class.name.clone(),
                format!("{:.3}", class.stated_over_true),
                format!("{:.3}", class.stated_over_true_error),
                percent(class.blind),
                percent(class.certain),
                percent(class.reference_share),
            ])
        })
    }

    /// What the numbers say: for each reading, the classes it is too narrow or too wide for, with the level that is farthest off.
    fn verdicts(&self) -> Vec<String> {
        let readings: [(&str, Of); 2] =
            [("Student's t", |class| &class.student), ("normal noise", |class| &class.normal)];
        let verdict = |(name, of): (&str, Of)| {
            let mut kinds =
                [("too narrow for", Vec::new()), ("too wide for", Vec::new()), ("as stated for", Vec::new())];
            for class in self.all().filter(|class| !of(class).is_empty()) {
                let missed = of(class).iter().filter(|one| one.is_missed());
                let worst = missed
                    .max_by(|a, b| (a.coverage - a.level).abs().total_cmp(&(b.coverage - b.level).abs()));
                let (kind, said) = match worst {
                    None => (2, class.name.clone()),
                    Some(one) => {
                        let said = format!(
                            "{} ({} hold {:.1} %)",
                            class.name,
                            percent_of_level(one.level),
                            100.0 * one.coverage
                        );
                        (usize::from(one.coverage > one.level), said)
                    }
                };
                kinds[kind].1.push(said);
            }
            let kinds = kinds.iter().filter(|(_, classes)| !classes.is_empty());
            let said: Vec<String> =
                kinds.map(|(kind, classes)| format!("{kind} {}", classes.join(", "))).collect();
            (!said.is_empty()).then(|| format!("Read by {name}, intervals are {}.", said.join("; ")))
        };
        let mut sentences: Vec<String> = readings.into_iter().filter_map(verdict).collect();
        if sentences.is_empty() {
            sentences.push("Nothing is random here: there is nothing to judge.".to_owned());
        }
        sentences
    }

    fn figure(&self, title: &str, of: impl Fn(&ClassCoverage) -> &Vec<Measured>, reading: Reading) -> Figure {
        let start = Figure::new(title)
            .with_x(Axis::linear("stated level").with_range(0.4, 1.0))
            .with_y(Axis::linear("held the truth").with_range(0.2, 1.0))
            .dashed("", Ink::Muted, vec![[0.4, 0.4], [1.0, 1.0]]);
        let start = if reading == Reading::Normal {
            let curve = (40..=99)
                .map(|percent| f64::from(percent) / 100.0)
                .map(|level| [level, reading.expected(level)]);
            let dash = crate::figure::Mark::Line {
                points: curve.collect(),
                dash: crate::figure::Dash::Dotted,
                width: 1.4,
            };
            start.with("", Ink::Muted, dash)
        } else {
            start
        };
        self.all().enumerate().fold(start, |figure, (at, class)| {
            let points = of(class).iter().map(|found| [found.level, found.coverage]).collect();
            let bars = of(class).iter().map(|found| {
                let [low, high] = found.interval;
                ErrorBar { x: found.level, y: found.coverage, low, high }
            });
            let bars = bars.collect();
            figure.errors("", Ink::of(at), bars).marked(
                class.name.clone(),
                Ink::of(at),
                Marker::of(at),
                points,
            )
        })
    }
}

/// `95 %`, `99.5 %`.
fn percent_of_level(level: f64) -> String {
    format!("{} %", (level * 1e6).round() / 1e4)
}
