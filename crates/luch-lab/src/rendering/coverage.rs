//! How often stated errors hold the truth.

use super::classes::{PixelClass, Traits};
use super::reading::{Measured, Reading, Tally};
use super::reference::Reference;
use super::{PILOT, REPLICATE, RenderingError, Subject, Truth, Work, name_of, seed_of};
use luch_render::{BUNDLE, Film, MeanEstimate, PixelEstimate};
use luch_sampling::Sequence;
use luch_scene::Integrator as Name;
use serde::Serialize;

/// Renders that tell the variances of pixels, by which these are sorted; they are not judged.
const PILOTS: u64 = 16;

/// What is put to the test.
#[derive(Clone, Debug, PartialEq)]
pub struct CoveragePlan {
    /// Where points come from.
    pub sequence: Sequence,
    /// How light is found; the scene's own if not given.
    pub integrator: Option<Name>,
    /// Independent renders, 2 to 2²⁰.
    pub renders: u32,
    /// Samples of each pixel, 2 at least: one of each stream.
    pub samples: u64,
    /// Levels of intervals, between 0 and 1.
    pub levels: Vec<f64>,
    /// Chooses all random numbers.
    pub seed: u64,
    /// What the intervals should hold.
    pub truth: Truth,
}

impl Default for CoveragePlan {
    /// 200 renders of 16 samples, Sobol' points, levels 50, 68, 90, 95 and 99 %, against 1024 samples.
    fn default() -> Self {
        Self {
            sequence: Sequence::Sobol,
            integrator: None,
            renders: 200,
            samples: 16,
            levels: vec![0.5, 0.68, 0.9, 0.95, 0.99],
            seed: 1,
            truth: Truth::Samples(1024),
        }
    }
}

impl CoveragePlan {
    /// How many samples will be made, all in all.
    pub fn work(&self, subject: &Subject) -> u64 {
        let renders = (u64::from(self.renders) + PILOTS).saturating_mul(self.samples);
        renders.saturating_mul(subject.pixels()).saturating_add(self.truth.work(subject.pixels()))
    }
}

/// What was found.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CoverageStudy {
    /// Width and height of the pictures.
    pub size: [u32; 2],
    /// The sequence.
    pub sequence: String,
    /// The integrator with the length of its paths.
    pub integrator: String,
    /// Renders.
    pub renders: u32,
    /// Samples of each pixel in each.
    pub samples: u64,
    /// What the intervals should hold.
    pub reference: Reference,
    /// Pixels by their class; classes without pixels are left out.
    pub classes: Vec<ClassCoverage>,
    /// The mean of the picture.
    pub mean: ClassCoverage,
}

/// Intervals of one kind of estimates.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ClassCoverage {
    /// `all`, `edge`, …, or `mean of the picture`.
    pub name: String,
    /// How many pixels.
    pub pixels: usize,
    /// Degrees of freedom of Student's t.
    pub degrees: f64,
    /// Stated errors read by Student's t.
    pub student: Vec<Measured>,
    /// Stated errors read as if they were known: ± 1.96 for 95 %.
    pub normal: Vec<Measured>,
    /// Root of the mean stated variance over the true root mean squared error: 1 if errors are stated rightly on average. For all pixels this
    /// is about what `luch render` tells as the picture's error.
    pub stated_over_true: f64,
    /// Its standard error, by the scatter of the renders.
    pub stated_over_true_error: f64,
    /// Part of the intervals that have no width and miss the truth: both streams were wrong alike.
    pub blind: f64,
    /// Part of the intervals left out: no width, and the reference exactly; nothing is random there.
    pub certain: f64,
    /// Variance of the reference over that of an estimate; intervals are judged as if the sum were the estimate's.
    pub reference_share: f64,
}

/// What is gathered of one kind of estimates.
struct Gathering {
    student: Tally,
    normal: Tally,
    degrees: f64,
    reference_share: f64,
    /// For each render: sums of stated variances, and of squared distances less the reference's variance.
    sums: Vec<[f64; 2]>,
    blind: f64,
    certain: f64,
}

/// One number with its stated and its reference's variance.
#[derive(Clone, Copy)]
struct Estimate {
    distance: f64,
    variance: f64,
    reference_variance: f64,
}

impl Gathering {
    fn new(degrees: f64, levels: &[f64], reference_share: f64) -> Self {
        Self {
            student: Tally::new(Reading::Student(degrees), levels),
            normal: Tally::new(Reading::Normal, levels),
            degrees,
            reference_share,
            sums: Vec::new(),
            blind: 0.0,
            certain: 0.0,
        }
    }

    fn add(&mut self, estimates: impl Iterator<Item = Estimate>) {
        // The distance from a reference scatters more than that from the truth, by this.
        let scale = 1.0 / (1.0 + self.reference_share).sqrt();
        let (mut judged, mut stated, mut squared) = (Vec::new(), 0.0, 0.0);
        for Estimate { distance, variance, reference_variance } in estimates {
            if variance == 0.0 && distance == 0.0 {
                self.certain += 1.0;
                continue;
            }
            self.blind += f64::from(u8::from(variance == 0.0));
            stated += variance;
            squared += distance * distance - reference_variance;
            judged.push([scale * distance, variance.sqrt()]);
        }
        self.sums.push([stated, squared]);
        self.student.add(judged.iter().copied());
        self.normal.add(judged);
    }

    fn found(&self, name: &str, pixels: usize) -> ClassCoverage {
        let judged = self.student.trials();
        let [stated_over_true, stated_over_true_error] = root_of_ratio(&self.sums);
        ClassCoverage {
            name: name.to_owned(),
            pixels,
            degrees: self.degrees,
            student: self.student.measured(),
            normal: self.normal.measured(),
            stated_over_true,
            stated_over_true_error,
            blind: self.blind / judged.max(1.0),
            certain: self.certain / (self.certain + judged).max(1.0),
            reference_share: self.reference_share,
        }
    }
}

/// Renders again and again, and counts.
///
/// # Errors
/// If the plan or its truth cannot be used, or the work was stopped.
pub fn coverage(
    subject: &Subject,
    plan: &CoveragePlan,
    work: &Work<'_>,
) -> Result<CoverageStudy, RenderingError> {
    if plan.samples < 2 {
        return Err(RenderingError::Plan("an error is stated from 2 samples on: one of each stream"));
    }
    if !(2..=1 << 20).contains(&plan.renders) {
        return Err(RenderingError::Plan("coverage takes 2 to 1048576 renders"));
    }
    if plan.levels.is_empty() || plan.levels.iter().any(|level| !(*level > 0.0 && *level < 1.0)) {
        return Err(RenderingError::Plan("levels lie between 0 and 1"));
    }
    let integrator = plan.integrator.unwrap_or(subject.settings.integrator);
    let reference = plan.truth.reference(subject, integrator, plan.seed, work)?;
    let Some(reference_variance) = reference.variance.clone() else {
        return Err(RenderingError::Plan(
            "a picture that does not state its own errors cannot judge others; give a film, an EXR with the layer stderr, or samples",
        ));
    };
    let render = |purpose: u64, number: u64| -> Result<Film, RenderingError> {
        let mut run = subject.start(plan.sequence, integrator, seed_of(plan.seed, purpose, number));
        run.advance(plan.samples, work)?;
        Ok(run.film)
    };

    let pilots = Pilots::new(PILOTS, |number| render(PILOT, number), reference.values.len())?;
    let traits = Traits::new(&reference, pilots.variance.iter().map(|pixel| pixel.iter().sum()).collect());
    let sum_over = |members: &[usize], values: &[[f64; 3]]| -> f64 {
        members.iter().map(|&at| values[at].iter().sum::<f64>()).sum()
    };
    let mut classes: Vec<(PixelClass, Vec<usize>, Gathering)> = PixelClass::ALL
        .into_iter()
        .map(|class| (class, class.members(&traits)))
        .filter(|(_, members)| !members.is_empty())
        .map(|(class, members)| {
            let share = share(sum_over(&members, &reference_variance), sum_over(&members, &pilots.variance));
            (class, members, Gathering::new(1.0, &plan.levels, share))
        })
        .collect();
    let [width, height] = subject.size();
    let bundles = f64::from(width.div_ceil(BUNDLE) * height.div_ceil(BUNDLE));
    let reference_mean_variance =
        reference.mean_error_by_channel.unwrap_or_default().map(|error| error * error);
    let mut mean = Gathering::new(
        bundles,
        &plan.levels,
        share(reference_mean_variance.iter().sum(), pilots.mean_variance),
    );

    for number in 0..u64::from(plan.renders) {
        let film = render(REPLICATE, number)?;
        let estimates = film.read(|estimate, _| estimate);
        for (_, members, gathering) in &mut classes {
            let of = |&at: &usize| {
                estimates_of(&estimates.pixels()[at], reference.values[at], reference_variance[at])
            };
            gathering.add(members.iter().flat_map(of));
        }
        if let Some(MeanEstimate { mean: own, standard_error }) = film.mean() {
            let estimate =
                PixelEstimate { mean: own, variance: Some(standard_error.map(|error| error * error)) };
            mean.add(estimates_of(&estimate, reference.mean_by_channel, reference_mean_variance).into_iter());
        }
    }
    Ok(CoverageStudy {
        size: subject.size(),
        sequence: plan.sequence.name().to_owned(),
        integrator: name_of(integrator),
        renders: plan.renders,
        samples: plan.samples,
        classes: classes
            .iter()
            .map(|(class, members, found)| found.found(class.name(), members.len()))
            .collect(),
        mean: mean.found("mean of the picture", reference.values.len()),
        reference,
    })
}

/// One variance as a part of another; nothing of nothing.
fn share(reference: f64, own: f64) -> f64 {
    if own > 0.0 { reference / own } else { 0.0 }
}

/// The channels of a pixel, or of the mean.
fn estimates_of(estimate: &PixelEstimate, truth: [f64; 3], reference_variance: [f64; 3]) -> [Estimate; 3] {
    let variance = estimate.variance.unwrap_or_default();
    [0, 1, 2].map(|c| Estimate {
        distance: estimate.mean[c] - truth[c],
        variance: variance[c],
        reference_variance: reference_variance[c],
    })
}

/// Root of the ratio of two sums, and its standard error to first order; renders are independent.
fn root_of_ratio(sums: &[[f64; 2]]) -> [f64; 2] {
    let count = sums.len() as f64;
    let [above, below] = [0, 1].map(|side| sums.iter().map(|sum| sum[side]).sum::<f64>());
    let ratio = above / below;
    let scatter: f64 = sums.iter().map(|sum| sum[0] - ratio * sum[1]).map(|d| d * d).sum();
    let error = (scatter * count / (count - 1.0)).sqrt() / below.abs();
    [ratio.sqrt(), error / (2.0 * ratio.sqrt())]
}

/// Variances of estimates by their scatter.
struct Pilots {
    variance: Vec<[f64; 3]>,
    /// Of the picture's mean, sum of the channels; as stated.
    mean_variance: f64,
}

impl Pilots {
    fn new(
        count: u64,
        render: impl Fn(u64) -> Result<Film, RenderingError>,
        pixels: usize,
    ) -> Result<Self, RenderingError> {
        let (mut mean, mut squares, mut mean_variance) =
            (vec![[0.0; 3]; pixels], vec![[0.0; 3]; pixels], 0.0);
        for number in 0..count {
            let film = render(number)?;
            let stated = film.mean().map_or([0.0; 3], |found| found.standard_error);
            mean_variance += stated.iter().map(|error| error * error).sum::<f64>() / count as f64;
            let estimates = film.read(|estimate, _| estimate.mean);
            for (own, (mean, square)) in estimates.pixels().iter().zip(mean.iter_mut().zip(&mut squares)) {
                for channel in 0..3 {
                    // Welford's running sums: nothing cancels.
                    let before = own[channel] - mean[channel];
                    mean[channel] += before / (number + 1) as f64;
                    square[channel] += before * (own[channel] - mean[channel]);
                }
            }
        }
        let variance = squares.into_iter().map(|pixel| pixel.map(|sum| sum / (count - 1) as f64)).collect();
        Ok(Self { variance, mean_variance })
    }
}
