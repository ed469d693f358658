//! Integrators that need no scene: what a sample returns is known, so sums can be computed beside the film.

use luch_image::Rgb;
use luch_render::{CameraSample, Film, Integrator, Losses, Stop, Stopped, View, World, render_pass};
use luch_sampling::{Domain, Sampler, Sequence};
use luch_scene::{Filter, Settings};
use std::ops::Range;
use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering};

/// A value for each sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Pattern {
    /// All kinds of numbers: tiny, huge, negative, infinite, none.
    Wild,
    /// Uniform in [0, 1).
    Uniform,
    /// 1 in half a disc of the first two numbers, else 0: a function with edges.
    Step,
    /// Always the same.
    Constant(f32),
    /// 1 for stream A, 3 for stream B.
    Parity,
}

impl Pattern {
    /// The area of a quarter of the unit disc.
    pub(crate) const STEP_MEAN: f64 = std::f64::consts::FRAC_PI_4;

    pub(crate) fn value(self, sampler: &Sampler) -> Rgb {
        let domain = Domain::new(3, 1);
        match self {
            Pattern::Wild => {
                let [a, b, c, _] = sampler.group_words(domain);
                // Every bit pattern is a number or none.
                Rgb::new(f32::from_bits(a), f32::from_bits(b), (c as f32 - 2e9) * 1e-3)
            }
            Pattern::Uniform => Rgb::gray(sampler.group(domain)[0]),
            Pattern::Step => {
                let [x, y, ..] = sampler.group(domain);
                Rgb::gray(f32::from(u8::from(x * x + y * y < 1.0)))
            }
            Pattern::Constant(value) => Rgb::gray(value),
            Pattern::Parity => Rgb::gray(1.0 + 2.0 * sampler.stream() as f32),
        }
    }
}

impl Integrator for Pattern {
    fn radiance(
        &self,
        _: &World,
        samples: &[CameraSample],
        radiance: &mut [Rgb],
        stop: &Stop,
    ) -> Result<(), Stopped> {
        for (sample, radiance) in samples.iter().zip(radiance) {
            *radiance = self.value(&sample.sampler);
        }
        if stop.is_due() { Err(Stopped) } else { Ok(()) }
    }
}

/// Requests a stop once it has done a number of batches.
#[derive(Debug)]
pub(crate) struct StopAfter {
    pattern: Pattern,
    left: AtomicUsize,
    stop: Stop,
}

impl StopAfter {
    pub(crate) fn new(pattern: Pattern, batches: usize, stop: &Stop) -> Self {
        Self { pattern, left: AtomicUsize::new(batches), stop: stop.clone() }
    }
}

impl Integrator for StopAfter {
    fn radiance(
        &self,
        world: &World,
        samples: &[CameraSample],
        radiance: &mut [Rgb],
        stop: &Stop,
    ) -> Result<(), Stopped> {
        self.pattern.radiance(world, samples, radiance, stop)?;
        if self.left.fetch_sub(1, Ordering::Relaxed) == 1 {
            self.stop.request();
        }
        Ok(())
    }
}

pub(crate) fn small_view(width: u32, height: u32, sequence: Sequence) -> View {
    let camera = luch_scene::preset::cornell_box().cameras[0].camera;
    let filter = Filter::Box { radius: 0.5 };
    View::new(&camera, &Settings { width, height, sequence, filter, ..Settings::default() })
}

/// Adds samples of a pattern, or of anything that looks at no scene.
pub(crate) fn render(film: &mut Film, view: &View, integrator: &dyn Integrator, range: Range<u64>) {
    let mut scene = luch_scene::Scene::default();
    scene.add_camera(*view.camera());
    let world = World::build(scene).expect("an empty scene is sound");
    render_pass(&world, view, integrator, film, range, &Stop::new(), &AtomicU64::new(0))
        .expect("nobody stops it");
}

/// The mean of a pixel by integers wide enough for anything, in steps of 2⁻³⁶, cut at 2⁶² steps.
pub(crate) fn expected_mean(
    view: &View,
    pattern: Pattern,
    pixel: [u32; 2],
    range: Range<u64>,
    losses: &mut Losses,
) -> [f64; 3] {
    let (mut sums, mut counts) = ([[0_i128; 3]; 2], [0_u32; 2]);
    for index in range {
        let stream = (index % 2) as usize;
        counts[stream] += 1;
        for (sum, value) in
            sums[stream].iter_mut().zip(pattern.value(&view.start(pixel, index).sampler).to_array())
        {
            match units(value) {
                None => losses.invalid += 1,
                Some(units) if units.abs() > 1 << 62 => {
                    losses.saturated += 1;
                    *sum += units.signum() << 62;
                }
                Some(units) => *sum += units,
            }
        }
    }
    let unit = 1.0 / (1_u64 << 36) as f64;
    let mean =
        |stream: usize, channel: usize| sums[stream][channel] as f64 * unit / f64::from(counts[stream]);
    [0, 1, 2].map(|channel| (mean(0, channel) + mean(1, channel)) / 2.0)
}

/// A number in steps of 2⁻³⁶ from its bits, the nearest, ties to even; past 2¹⁰⁰ steps just large.
fn units(value: f32) -> Option<i128> {
    let bits = value.to_bits();
    let (exponent, fraction) = ((bits >> 23 & 255) as i32, i128::from(bits & 0x7f_ffff));
    if exponent == 255 {
        return None;
    }
    let mantissa = if exponent == 0 { fraction } else { fraction | 1 << 23 };
    let shift = exponent.max(1) - 127 - 23 + 36;
    let magnitude = if shift >= 0 {
        mantissa << shift.min(100)
    } else if shift < -30 {
        0
    } else {
        let (whole, rest) = (mantissa >> -shift, mantissa & ((1 << -shift) - 1));
        let half = 1_i128 << (-shift - 1);
        whole + i128::from(rest > half || (rest == half && whole & 1 == 1))
    };
    Some(if value.is_sign_negative() { -magnitude } else { magnitude })
}
