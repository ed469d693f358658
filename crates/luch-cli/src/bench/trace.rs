//! Tracing a set of rays, timed.

use super::agree::Answers;
use super::sets::{RaySet, SetKind};
use crate::processor_time;
use luch::bvh::{Coherence, Hit, Ray, TriangleBvh};
use std::sync::{Barrier, Mutex, PoisonError};
use std::time::{Duration, Instant};

/// Rays that a thread takes at a time, and that go to the tree in one batch.
const BATCH: usize = 4096;

/// Which way of tracing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kernel {
    /// Batches with the hint that suits the set.
    Batch,
    /// Batches said to be coherent.
    Coherent,
    /// Batches said not to be.
    Incoherent,
    /// One ray at a time.
    Single,
}

impl Kernel {
    pub(crate) const ALL: [Self; 4] = [Self::Batch, Self::Coherent, Self::Incoherent, Self::Single];

    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Batch => "batch",
            Self::Coherent => "coherent",
            Self::Incoherent => "incoherent",
            Self::Single => "single",
        }
    }

    /// The hint of its batches; `None` for no batches.
    fn coherence(self, set: SetKind) -> Option<Coherence> {
        match self {
            Self::Batch => Some(set.coherence()),
            Self::Coherent => Some(Coherence::Coherent),
            Self::Incoherent => Some(Coherence::Incoherent),
            Self::Single => None,
        }
    }
}

/// What one round cost.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Cost {
    /// Mean processor time of the threads, where the system tells.
    pub(super) processor: Option<Duration>,
    pub(super) elapsed: Duration,
}

/// A set traced once, and its cost.
pub(super) struct Traced {
    pub(super) answers: Answers,
    pub(super) cost: Cost,
}

/// Traces a set with this many threads.
pub(super) fn trace(tree: &TriangleBvh, set: &RaySet, kernel: Kernel, threads: usize) -> Traced {
    let (rays, hint) = (&set.rays, kernel.coherence(set.kind));
    if set.kind == SetKind::Shadow {
        // Zeros would not be in memory yet when the clock runs.
        let mut met = vec![true; rays.len()];
        let cost = in_parts(rays, &mut met, threads, |rays, met| match hint {
            Some(hint) => tree.any_batch(rays, met, hint),
            None => rays.iter().zip(met).for_each(|(ray, met)| *met = tree.any(ray)),
        });
        Traced { answers: Answers::Any(met), cost }
    } else {
        let mut hits: Vec<Option<Hit>> = vec![None; rays.len()];
        let cost = in_parts(rays, &mut hits, threads, |rays, hits| match hint {
            Some(hint) => tree.nearest_batch(rays, hits, hint),
            None => rays.iter().zip(hits).for_each(|(ray, hit)| *hit = tree.nearest(ray)),
        });
        Traced { answers: Answers::Nearest(hits), cost }
    }
}

/// Has the threads take part after part until none is left. The calling thread is one of them.
fn in_parts<T: Send>(
    rays: &[Ray],
    answers: &mut [T],
    threads: usize,
    work: impl Fn(&[Ray], &mut [T]) + Sync,
) -> Cost {
    let parts = Mutex::new(rays.chunks(BATCH).zip(answers.chunks_mut(BATCH)));
    let start = Barrier::new(threads);
    let next = || parts.lock().unwrap_or_else(PoisonError::into_inner).next();
    let take = || {
        let before = processor_time::of_thread();
        while let Some((rays, answers)) = next() {
            work(rays, answers);
        }
        processor_time::since(before, processor_time::of_thread())
    };
    let mut elapsed = Duration::ZERO;
    let processor: Option<Duration> = std::thread::scope(|scope| {
        let others: Vec<_> = (1..threads)
            .map(|_| {
                scope.spawn(|| {
                    start.wait();
                    take()
                })
            })
            .collect();
        start.wait();
        let started = Instant::now();
        let own = take();
        let spent: Vec<_> = others.into_iter().map(|thread| thread.join().ok().flatten()).collect();
        elapsed = started.elapsed();
        spent.into_iter().chain([own]).sum()
    });
    Cost { processor: processor.map(|sum| sum / threads as u32), elapsed }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    #[test]
    fn every_ray_is_traced_once_by_any_number_of_threads() {
        let rays: Vec<Ray> = (0..3 * BATCH + 7).map(|i| Ray::new(Vec3::X * i as f32, Vec3::Y)).collect();
        for threads in [1, 2, 5] {
            let mut answers = vec![0.0f32; rays.len()];
            let cost = in_parts(&rays, &mut answers, threads, |rays, answers| {
                rays.iter().zip(answers).for_each(|(ray, answer)| *answer += 1.0 + ray.origin.x);
            });
            assert!(answers.iter().zip(&rays).all(|(answer, ray)| *answer == 1.0 + ray.origin.x));
            assert!(cost.elapsed > Duration::ZERO);
        }
    }
}
