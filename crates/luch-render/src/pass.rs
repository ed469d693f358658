//! The heart: samples of a range are added to every pixel of a film.

use crate::film::{BUNDLE, Film, Tile};
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
            let order = bundled(tile, &run);
            let samples: Vec<_> = order
                .iter()
                .map(|member| {
                    let place = |pixel: u32| [tile.x + pixel % tile.width, tile.y + pixel / tile.width];
                    let Member { bundle, corner, lane, size, pixel, index } = *member;
                    view.start_bundled(place(pixel), index, bundle, place(corner), [lane, size])
                })
                .collect();
            let mut radiance = vec![Rgb::BLACK; samples.len()];
            integrator.radiance(world, &samples, &mut radiance, &on_request)?;
            add_run(tile, step, &run, &order, &radiance);
            done.fetch_add(samples.len() as u64, Ordering::Relaxed);
        }
        Ok(())
    })
}

/// A sample of a run and its bundle; pixels are counted within the tile.
struct Member {
    bundle: u32,
    /// First pixel of the bundle.
    corner: u32,
    lane: u32,
    size: u32,
    pixel: u32,
    index: u64,
}

/// Every sample of a run: index by index, block by block.
fn bundled(tile: &Tile, run: &Range<u64>) -> Vec<Member> {
    let mut order = Vec::with_capacity(tile.sums.len() * (run.end - run.start) as usize);
    let mut bundle = 0;
    for index in run.clone() {
        for top in (0..tile.height).step_by(BUNDLE as usize) {
            for left in (0..tile.width).step_by(BUNDLE as usize) {
                let (bottom, right) = ((top + BUNDLE).min(tile.height), (left + BUNDLE).min(tile.width));
                let (corner, size) = (top * tile.width + left, (bottom - top) * (right - left));
                let mut lane = 0;
                for y in top..bottom {
                    for x in left..right {
                        order.push(Member { bundle, corner, lane, size, pixel: y * tile.width + x, index });
                        lane += 1;
                    }
                }
                bundle += 1;
            }
        }
    }
    order
}

/// Adds the samples of a finished run, all at once.
fn add_run(tile: &mut Tile, step: crate::exact::Step, run: &Range<u64>, order: &[Member], radiance: &[Rgb]) {
    for (member, sample) in order.iter().zip(radiance) {
        tile.add(step, member.pixel as usize, member.index, *sample);
    }
    tile.done.insert(run.clone());
}
