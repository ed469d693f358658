//! A study as a page.

use super::study::{Row, Series, Study};
use crate::figure::{Axis, Figure, Ink, Marker};
use crate::report::{Picture, Report, Table};
use luch_image::compare::false_color;
use luch_image::tone::Tone;
use luch_image::{Image, Rgb};
use serde_json::json;

impl Study {
    /// The study under what stands on `page` already: tables, figures, all numbers as data. Times have a table, a figure and data of their own.
    ///
    /// `clock` says in words what time was measured; pictures are shown by `tone` if it is given, and left out otherwise.
    pub fn page(&self, page: Report, clock: &str, tone: Option<&Tone>) -> Report {
        let [width, height] = self.size;
        let repetitions = if self.replicates == 1 {
            "one repetition, without intervals"
        } else {
            "independent repetitions"
        };
        let mut page = page.text(format!("{width}×{height} pixels, {} {repetitions}.", self.replicates));
        for (at, reference) in self.references.iter().enumerate() {
            let floor = match reference.relative_floor() {
                Some(0.0) => String::new(),
                Some(floor) => format!(
                    "; its own noise is {} of the mean and is subtracted from squared errors",
                    percent(floor)
                ),
                None if reference.noise == Some(0.0) => String::new(),
                None => "; its own noise is unknown".to_owned(),
            };
            let letter = if self.references.len() > 1 { format!(" {}", at + 1) } else { String::new() };
            page = page.text(format!("Reference{letter}: {}{floor}.", reference.origin));
        }
        if self.losses.saturated + self.losses.invalid > 0 {
            page = page.text(format!(
                "WARNING: {} numbers of samples were cut and {} were not numbers: means are too small.",
                self.losses.saturated, self.losses.invalid
            ));
        }
        page = page
            .heading("Errors")
            .table(self.convergence())
            .text("RMSE: root mean squared error of pixels and channels, as a part of the mean of the reference. relMSE: as `luch compare` has it. Bias: distance of the mean from the reference's, in standard errors by twin streams; with few samples, where a few pixels carry the noise, 3 is not rare. FLIP: mean of what is seen, 67 pixels a degree; the reference's noise is in it. `<` marks errors below the reference's noise: they are not known well and are left out of fits.")
            .table(self.laws())
            .text("Slope: exponent of the error as a power of samples, ± 95 % by the jackknife over repetitions. Equal error: how many times as many samples the first row of this table takes for the last error of a row.")
            .figure(self.by_samples())
            .heading("Times of this run")
            .text(format!("Measured: {clock}. All else is the same on every machine."))
            .table(self.times())
            .figure(self.by_time());
        if let Some(tone) = tone {
            page = page.heading("Pictures").pictures(self.pictures(tone));
        }
        let measured: Vec<_> = self
            .series
            .iter()
            .map(|one| {
                json!({
                    "sequence": one.sequence,
                    "integrator": one.integrator,
                    "samples": one.rows.iter().map(|row| row.samples).collect::<Vec<_>>(),
                    "seconds": one.seconds,
                    "equal_time_factor": one.equal_time_factor,
                })
            })
            .collect();
        // Plain data with texts as keys: nothing that could fail.
        page.with_data("results", serde_json::to_value(self).unwrap_or_default())
            .with_data("times", json!({ "clock": clock, "series": measured }))
    }

    /// What a series is called where there are others.
    fn name(&self, one: &Series) -> String {
        let alone = self.series.iter().all(|other| other.integrator == one.integrator);
        if alone { one.sequence.clone() } else { format!("{} {}", one.integrator, one.sequence) }
    }

    fn convergence(&self) -> Table {
        let head = ["integrator", "sampler", "samples", "RMSE", "relMSE", "bias z", "FLIP"];
        self.lines().fold(Table::new(head), |table, (one, row)| {
            let mark = if row.is_above_floor || one.is_exact { "" } else { " <" };
            let rmse = if one.is_exact {
                "exact".to_owned()
            } else {
                row.relative_rmse.map_or("–".to_owned(), percent)
            };
            table.row([
                one.integrator.clone(),
                one.sequence.clone(),
                row.samples.to_string(),
                format!("{rmse}{mark}"),
                format!("{:.2e}", row.relative_mse.max(0.0)),
                row.bias_z.map_or("–".to_owned(), |z| format!("{z:+.2}")),
                format!("{:.4}", row.flip),
            ])
        })
    }

    fn lines(&self) -> impl Iterator<Item = (&Series, &Row)> {
        self.series.iter().flat_map(|one| one.rows.iter().map(move |row| (one, row)))
    }

    fn laws(&self) -> Table {
        let head = ["integrator", "sampler", "slope", "95 %", "equal error"];
        self.series.iter().fold(Table::new(head), |table, one| {
            let interval = one.exponent.and_then(|found| found.interval);
            table.row([
                one.integrator.clone(),
                one.sequence.clone(),
                match one.exponent {
                    Some(found) => format!("{:.3}", found.value),
                    None if one.is_exact => "exact".to_owned(),
                    None => "–".to_owned(),
                },
                interval.map_or(String::new(), |[low, high]| format!("{low:.3} … {high:.3}")),
                factor(one.equal_error_factor),
            ])
        })
    }

    fn times(&self) -> Table {
        let head = ["integrator", "sampler", "samples", "seconds", "equal time"];
        self.series.iter().fold(Table::new(head), |table, one| {
            table.row([
                one.integrator.clone(),
                one.sequence.clone(),
                one.rows.last().map_or(String::new(), |row| row.samples.to_string()),
                one.seconds.last().map_or(String::new(), |seconds| format!("{seconds:.4}")),
                factor(one.equal_time_factor),
            ])
        })
    }

    fn by_samples(&self) -> Figure {
        let start = Figure::new("Error against samples").with_x(Axis::log2("samples of a pixel"));
        let mut figure = self.curves(start, |one| one.rows.iter().map(|row| row.samples as f64).collect());
        let rows = self.lines().map(|(_, row)| row);
        let highest = rows.filter_map(|row| Some([row.samples as f64, 1.6 * row.relative_rmse?]));
        if let Some(through) = highest.max_by(|a, b| a[1].total_cmp(&b[1])) {
            figure = figure.reference("slope −1/2", through, -0.5);
        }
        figure.with_caption("Fitted slopes stand in brackets.")
    }

    fn by_time(&self) -> Figure {
        let start = Figure::new("Error against time").with_x(Axis::log10("seconds"));
        self.curves(start, |one| one.seconds.clone())
            .with_caption("Measured in one run: other machines and other days differ.")
    }

    fn curves(&self, start: Figure, places: impl Fn(&Series) -> Vec<f64>) -> Figure {
        let start = start.with_y(Axis::log10("relative RMSE"));
        let figure = self.series.iter().enumerate().fold(start, |figure, (at, one)| {
            let errors = one.rows.iter().map(|row| row.relative_rmse.unwrap_or(f64::NAN));
            let points = places(one).into_iter().zip(errors).map(|(x, y)| [x, y]).collect();
            let name = match one.exponent {
                Some(found) => {
                    format!("{} ({})", self.name(one), format!("{:.2}", found.value).replace('-', "−"))
                }
                None => self.name(one),
            };
            figure.marked(name, Ink::of(at), Marker::of(at), points)
        });
        let floors = self.references.iter().filter_map(|reference| reference.relative_floor());
        floors
            .filter(|floor| *floor > 0.0)
            .fold(figure, |figure, floor| figure.level("noise of the reference", floor))
    }

    fn pictures(&self, tone: &Tone) -> Vec<Picture> {
        let mut pictures: Vec<Picture> = self
            .references
            .iter()
            .map(|one| Picture::new(format!("reference: {}", one.origin), &one.picture, tone))
            .collect();
        // One scale for all, so that they can be compared.
        let most =
            self.series.iter().flat_map(|one| one.flip.pixels()).fold(0.0f32, |most, &value| most.max(value));
        let white = if most > 0.0 { most } else { 1.0 };
        for one in &self.series {
            let Some(row) = one.rows.last() else { continue };
            let name = format!("{} {}, {} samples", one.integrator, one.sequence, row.samples);
            let map: Image<Rgb> = one.flip.map(|&value| false_color(value / white));
            let caption = format!("its FLIP, black 0 to white {white:.2}: mean {:.4}", row.flip);
            pictures.push(Picture::new(name, &one.picture, tone));
            pictures.push(Picture::new(caption, &map, &Tone::default()));
        }
        pictures
    }
}

fn factor(value: Option<f64>) -> String {
    value.map_or("–".to_owned(), |value| format!("{value:.2}"))
}

/// `1.23 %`, of three digits.
pub(super) fn percent(share: f64) -> String {
    let percent = share * 100.0;
    if percent == 0.0 {
        "0 %".to_owned()
    } else if percent >= 10.0 {
        format!("{percent:.1} %")
    } else if percent >= 0.01 {
        format!("{percent:.3} %")
    } else {
        format!("{percent:.2e} %")
    }
}
