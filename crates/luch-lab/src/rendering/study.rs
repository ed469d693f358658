//! Sequences and integrators on a scene: errors against samples and time.

use super::law::{Exponent, exponent, samples_for};
use super::reference::Reference;
use super::{REPLICATE, RenderingError, Subject, Truth, Work, name_of, seed_of};
use crate::flip::{USUAL_PIXELS_PER_DEGREE, flip, mean_of};
use luch_image::tone::Tone;
use luch_image::{Image, Rgb};
use luch_render::{Film, Losses};
use luch_sampling::Sequence;
use luch_scene::Integrator as Name;
use serde::Serialize;

/// What is compared.
#[derive(Clone, Debug, PartialEq)]
pub struct StudyPlan {
    /// Where points come from.
    pub sequences: Vec<Sequence>,
    /// How light is found; that of the scene if there is none.
    pub integrators: Vec<Name>,
    /// Samples of each pixel, from 1 on; taken in growing order.
    pub samples: Vec<u64>,
    /// Independent repetitions, 1 to 65536; intervals need 3.
    pub replicates: u32,
    /// Chooses all random numbers.
    pub seed: u64,
    /// What estimates are held against.
    pub truth: Truth,
}

impl Default for StudyPlan {
    /// All sequences, the scene's integrator, 1 to 64 samples, four times, against 1024 samples.
    fn default() -> Self {
        Self {
            sequences: Sequence::ALL.to_vec(),
            integrators: Vec::new(),
            samples: (0..=6).map(|exponent| 1 << exponent).collect(),
            replicates: 4,
            seed: 1,
            truth: Truth::Samples(1024),
        }
    }
}

impl StudyPlan {
    fn integrators(&self, subject: &Subject) -> Vec<Name> {
        if self.integrators.is_empty() { vec![subject.settings.integrator] } else { self.integrators.clone() }
    }

    fn sizes(&self) -> Vec<u64> {
        let mut sizes = self.samples.clone();
        sizes.sort_unstable();
        sizes.dedup();
        sizes
    }

    /// How many samples will be made, all in all.
    pub fn work(&self, subject: &Subject) -> u64 {
        let integrators = self.integrators(subject);
        let most = self.samples.iter().copied().max().unwrap_or(0);
        let runs = self.sequences.len() as u64 * integrators.len() as u64 * u64::from(self.replicates);
        let references = limits(&integrators).len() as u64 * self.truth.work(subject.pixels());
        runs.saturating_mul(most).saturating_mul(subject.pixels()).saturating_add(references)
    }
}

/// What was found; nothing in it but times depends on the machine.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Study {
    /// Width and height of the pictures.
    pub size: [u32; 2],
    /// Repetitions.
    pub replicates: u32,
    /// Seeds of the repetitions, as for `luch render --seed`.
    pub seeds: Vec<u64>,
    /// One for each thing that integrators find: `path` and `plain-path` share one, `direct` has its own.
    pub references: Vec<Reference>,
    /// One for each integrator and sequence.
    pub series: Vec<Series>,
    /// What films could not hold; if that is not nothing, there is a bias.
    pub losses: Losses,
}

/// One sequence with one integrator.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Series {
    /// The sequence.
    pub sequence: String,
    /// The integrator with the length of its paths.
    pub integrator: String,
    /// Which reference it is held against.
    pub reference: usize,
    /// One for each number of samples.
    pub rows: Vec<Row>,
    /// How the error falls with samples.
    pub exponent: Option<Exponent>,
    /// Whether every pixel is the reference, to rounding, at all sizes.
    pub is_exact: bool,
    /// How many samples the first series takes for the error of the last row here, as a multiple of the samples here.
    pub equal_error_factor: Option<f64>,
    /// Seconds up to each row, mean of the repetitions: measured, and other in each run.
    #[serde(skip)]
    pub seconds: Vec<f64>,
    /// Squared error × time of the first series over that of this one, in the last row: how many times faster to the same variance.
    #[serde(skip)]
    pub equal_time_factor: Option<f64>,
    /// The picture of the first repetition in the last row.
    #[serde(skip)]
    pub picture: Image<Rgb>,
    /// Its FLIP against the reference.
    #[serde(skip)]
    pub flip: Image<f32>,
}

/// Errors at one number of samples.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Row {
    /// Samples of each pixel.
    pub samples: u64,
    /// Root mean squared error of pixels and channels as a part of the reference's mean, the reference's own noise subtracted; `None` if
    /// nothing is left.
    pub relative_rmse: Option<f64>,
    /// Whether the error is larger than the noise of the reference, so that it is known well.
    pub is_above_floor: bool,
    /// Mean of squared error over (squared reference + 0.01), as `luch compare` has it, the reference's noise subtracted.
    pub relative_mse: f64,
    /// Mean of all pixels, channels and repetitions.
    pub mean: f64,
    /// Distance of that mean from the reference's in standard errors, by twin streams; `None` with one sample, or if the error is zero.
    pub bias_z: Option<f64>,
    /// Mean FLIP of what is shown, 67 pixels a degree; the reference's noise is in it.
    pub flip: f64,
    /// Mean squared errors of the repetitions, as they are: with the noise of the reference.
    pub squared_errors: Vec<f64>,
}

/// What an integrator finds: those with the same are held against the same.
fn limit(integrator: Name) -> Name {
    match integrator {
        Name::PlainPath { max_depth } => Name::Path { max_depth },
        other => other,
    }
}

fn limits(integrators: &[Name]) -> Vec<Name> {
    integrators.iter().fold(Vec::new(), |mut found, &integrator| {
        if !found.contains(&limit(integrator)) {
            found.push(limit(integrator));
        }
        found
    })
}

/// What is added up over repetitions at one number of samples.
#[derive(Clone, Default)]
struct Gathered {
    squares: Vec<f64>,
    relative: f64,
    flip: f64,
    mean: [f64; 3],
    /// Sum of the squared standard errors of the means; `None` if one is unknown.
    mean_variance: Option<[f64; 3]>,
    seconds: f64,
}

/// Renders everything of a plan.
///
/// # Errors
/// If the plan or its truth cannot be used, or the work was stopped.
pub fn study(subject: &Subject, plan: &StudyPlan, work: &Work<'_>) -> Result<Study, RenderingError> {
    let (sizes, integrators) = (plan.sizes(), plan.integrators(subject));
    if sizes.first().is_none_or(|&least| least == 0) || plan.sequences.is_empty() {
        return Err(RenderingError::Plan("a study needs a sequence, and numbers of samples from 1 on"));
    }
    if !(1..=1 << 16).contains(&plan.replicates) {
        return Err(RenderingError::Plan("a study takes 1 to 65536 repetitions"));
    }
    let known = limits(&integrators);
    let references: Vec<Reference> = match plan.truth {
        Truth::Samples(_) => known
            .iter()
            .map(|&name| plan.truth.reference(subject, name, plan.seed, work))
            .collect::<Result<_, _>>()?,
        // A truth from elsewhere is the same for all.
        _ => vec![plan.truth.reference(subject, known[0], plan.seed, work)?],
    };
    let shown: Vec<Image<Rgb>> =
        references.iter().map(|reference| show(&subject.tone, &reference.picture)).collect();
    let against = |integrator: Name| {
        let place = known.iter().position(|&name| name == limit(integrator)).unwrap_or(0);
        place.min(references.len() - 1)
    };
    let pairs: Vec<(Name, Sequence)> = integrators
        .iter()
        .flat_map(|&integrator| plan.sequences.iter().map(move |&sequence| (integrator, sequence)))
        .collect();

    let seeds: Vec<u64> =
        (0..u64::from(plan.replicates)).map(|number| seed_of(plan.seed, REPLICATE, number)).collect();
    let mut gathered =
        vec![
            vec![Gathered { mean_variance: Some([0.0; 3]), ..Gathered::default() }; sizes.len()];
            pairs.len()
        ];
    let mut pictures = vec![(Image::default(), Image::default()); pairs.len()];
    let mut losses = Losses::default();
    for (number, &seed) in seeds.iter().enumerate() {
        // All of one repetition before the next: whatever disturbs the clock disturbs all alike.
        for (at, &(integrator, sequence)) in pairs.iter().enumerate() {
            let place = against(integrator);
            let reference = &references[place];
            let mut run = subject.start(sequence, integrator, seed);
            let mut seconds = 0.0;
            for (size, sums) in sizes.iter().zip(&mut gathered[at]) {
                let before = (work.clock)();
                run.advance(*size, work)?;
                seconds += (work.clock)().saturating_sub(before).as_secs_f64();
                sums.seconds += seconds;
                let picture = run.film.to_image();
                let map = flip(&show(&subject.tone, &picture), &shown[place], USUAL_PIXELS_PER_DEGREE)
                    .map_err(|sizes| RenderingError::Size { reference: sizes.b, picture: sizes.a })?;
                sums.flip += mean_of(&map);
                sums.add(&run.film, reference);
                if number == 0 && size == sizes.last().unwrap_or(size) {
                    pictures[at] = (picture, map);
                }
            }
            let lost = run.film.losses();
            losses.saturated += lost.saturated;
            losses.invalid += lost.invalid;
        }
    }
    let mut series: Vec<Series> = pairs
        .iter()
        .zip(gathered.iter().zip(pictures))
        .map(|(&(integrator, sequence), (sums, (picture, flip)))| {
            let place = against(integrator);
            let (rows, exponent, is_exact) = summarised(&sizes, sums, &references[place]);
            Series {
                sequence: sequence.name().to_owned(),
                integrator: name_of(integrator),
                reference: place,
                rows,
                exponent,
                is_exact,
                equal_error_factor: None,
                seconds: sums.iter().map(|sum| sum.seconds / f64::from(plan.replicates)).collect(),
                equal_time_factor: None,
                picture,
                flip,
            }
        })
        .collect();
    relate(&mut series);
    Ok(Study { size: subject.size(), replicates: plan.replicates, seeds, references, series, losses })
}

/// As a screen shows it, linear.
pub(super) fn show(tone: &Tone, picture: &Image<Rgb>) -> Image<Rgb> {
    picture.map(|&light| tone.apply(light))
}

impl Gathered {
    /// Takes in a picture as it is now.
    fn add(&mut self, film: &Film, reference: &Reference) {
        let estimates = film.read(|estimate, _| estimate.mean);
        let (mut square, mut relative, mut mean) = (0.0, 0.0, [0.0; 3]);
        for (pixel, truth) in estimates.pixels().iter().zip(&reference.values) {
            for channel in 0..3 {
                let error = pixel[channel] - truth[channel];
                square += error * error;
                relative +=
                    error * error / (truth[channel] * truth[channel] + luch_image::compare::RELATIVE_EPSILON);
                mean[channel] += pixel[channel];
            }
        }
        let pixels = reference.values.len().max(1) as f64;
        self.squares.push(square / (3.0 * pixels));
        self.relative += relative / (3.0 * pixels);
        (0..3).for_each(|channel| self.mean[channel] += mean[channel] / pixels);
        self.mean_variance = match (self.mean_variance, film.mean()) {
            (Some(sum), Some(found)) => {
                Some([0, 1, 2].map(|c| sum[c] + found.standard_error[c] * found.standard_error[c]))
            }
            _ => None,
        };
    }
}

/// Rounding of pictures and sums, as a part of their values: errors below that are none.
const ROUNDING: f64 = 1e-7;

fn summarised(sizes: &[u64], sums: &[Gathered], reference: &Reference) -> (Vec<Row>, Option<Exponent>, bool) {
    let noise = reference.noise.unwrap_or(0.0);
    let rounding = ROUNDING * ROUNDING * reference.mean * reference.mean;
    // What the reference's noise adds to the relative error.
    let relative_noise = reference.variance.as_ref().map_or(0.0, |variance| {
        let terms = variance.iter().zip(&reference.values).flat_map(|(variance, truth)| {
            (0..3).map(|c| variance[c] / (truth[c] * truth[c] + luch_image::compare::RELATIVE_EPSILON))
        });
        terms.sum::<f64>() / (3.0 * variance.len().max(1) as f64)
    });
    let rows: Vec<Row> = sizes
        .iter()
        .zip(sums)
        .map(|(&samples, sum)| {
            let count = sum.squares.len().max(1) as f64;
            let rest = sum.squares.iter().sum::<f64>() / count - noise;
            let mean = sum.mean.map(|channel| channel / count);
            Row {
                samples,
                relative_rmse: (rest > 0.0 && reference.mean != 0.0)
                    .then(|| rest.sqrt() / reference.mean.abs()),
                is_above_floor: rest > noise.max(rounding),
                relative_mse: sum.relative / count - relative_noise,
                mean: mean.iter().sum::<f64>() / 3.0,
                bias_z: sum.mean_variance.and_then(|variance| {
                    let own = variance.map(|sum| sum / (count * count));
                    bias(mean, own, reference)
                }),
                flip: sum.flip / count,
                squared_errors: sum.squares.clone(),
            }
        })
        .collect();
    let is_exact = sums.iter().all(|sum| sum.squares.iter().all(|&square| square <= rounding));
    let by_replicate: Vec<Vec<f64>> = (0..sums.first().map_or(0, |sum| sum.squares.len()))
        .map(|replicate| sums.iter().map(|sum| sum.squares[replicate]).collect())
        .collect();
    let fitted = exponent(sizes, &by_replicate, noise, noise.max(rounding));
    (rows, fitted.filter(|_| !is_exact), is_exact)
}

/// Standard errors between two means. Channels count as if they erred together, so that it is rather too small than too large.
fn bias(mean: [f64; 3], variance: [f64; 3], reference: &Reference) -> Option<f64> {
    let other = reference.mean_error_by_channel.unwrap_or_default();
    let error: f64 = (0..3).map(|c| (variance[c] + other[c] * other[c]).sqrt()).sum();
    let distance: f64 = (0..3).map(|c| mean[c] - reference.mean_by_channel[c]).sum();
    (error > 0.0).then(|| distance / error)
}

/// Factors against the first series.
fn relate(series: &mut [Series]) {
    let Some(first) = series.first().cloned() else { return };
    let curve: Vec<[f64; 2]> = first
        .rows
        .iter()
        .filter(|row| row.is_above_floor)
        .filter_map(|row| Some([row.samples as f64, row.relative_rmse?]))
        .collect();
    let cost = |one: &Series| {
        let last = one.rows.last().filter(|row| row.is_above_floor)?;
        Some(last.relative_rmse? * last.relative_rmse? * one.seconds.last().filter(|time| **time > 0.0)?)
    };
    for one in series.iter_mut().filter(|one| one.reference == first.reference) {
        one.equal_time_factor = cost(&first).zip(cost(one)).map(|(first, own)| first / own);
        let last = one.rows.last().filter(|row| row.is_above_floor);
        one.equal_error_factor = last.zip(first.exponent).and_then(|(row, exponent)| {
            Some(samples_for(&curve, exponent.value, row.relative_rmse?)? / row.samples as f64)
        });
    }
}
