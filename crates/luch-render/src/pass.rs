//! The heart: samples of a range are added to every pixel of a film.

use crate::film::{Film, Tile};
use crate::integrator::Integrator;
use crate::stop::{Stop, Stopped};
use crate::view::View;
use crate::world::World;
use luch_image::Rgb;
use rayon::prelude::*;
use std::ops::Range;
use std::sync::atomic::{AtomicU64, Ordering};

/// Camera samples that travel together: enough to fill batches of rays, few enough to stay in the cache.
const WAVE: u64 = 4096;

/// Adds to every pixel the samples of `range` that it does not have yet, on the threads of the current pool.
///
/// `done` counts the samples as they are added. The film is valid at any moment, and what it holds depends only on which
/// samples it has. A request to stop is heard within a batch, whose samples are then lost; a deadline only between batches, so
/// that however often one comes, the work goes on.
///
/// # Panics
/// If film and view differ in size.
///
/// # Errors
/// [`Stopped`] if `stop` came due before all were added; the film keeps what was.
pub fn render_pass(
    world: &World,
    view: &View,
    integrator: &dyn Integrator,
    film: &mut Film,
    range: Range<u64>,
    stop: &Stop,
    done: &AtomicU64,
) -> Result<(), Stopped> {
    let (seen, held) = ([view.width(), view.height()], [film.width(), film.height()]);
    assert_eq!(seen, held, "the view and the film have different sizes");
    let step = film.step;
    let on_request = stop.with_deadline(None);
    film.tiles.par_iter_mut().with_max_len(1).try_for_each(|tile| {
        let longest = (WAVE / tile.sums.len() as u64).max(1);
        while let Some(run) = tile.done.first_missing(&range, longest) {
            stop.check()?;
            let samples: Vec<_> = tile
                .pixels()
                .flat_map(|pixel| run.clone().map(move |index| view.start(pixel, index)))
                .collect();
            let mut radiance = vec![Rgb::BLACK; samples.len()];
            integrator.radiance(world, &samples, &mut radiance, &on_request)?;
            add_run(tile, step, &run, &radiance);
            done.fetch_add(samples.len() as u64, Ordering::Relaxed);
        }
        Ok(())
    })
}

/// Adds the samples of a finished run, all at once.
fn add_run(tile: &mut Tile, step: crate::exact::Step, run: &Range<u64>, radiance: &[Rgb]) {
    let length = (run.end - run.start) as usize;
    for (pixel, samples) in radiance.chunks(length).enumerate() {
        for (index, sample) in run.clone().zip(samples) {
            tile.add(step, pixel, index, *sample);
        }
    }
    tile.done.insert(run.clone());
}
