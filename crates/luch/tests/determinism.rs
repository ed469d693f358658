//! The same bits, whatever happens on the way: threads, order, interruptions, machines.

#![expect(
    clippy::single_range_in_vec_init,
    reason = "samples are given as lists of ranges, some of which have one"
)]

mod determinism {
    pub(crate) mod scenes;
}

use determinism::scenes::{Subject, subjects};
use luch::bvh::simd::Level;
use luch::image::Rgb;
use luch::prelude::*;
use luch::render::{BUNDLE, Ending, Provenance, Stopped};
use luch::sampling::{Sequence, hash};
use luch::scene::{Integrator as Name, Property};
use std::ops::Range;
use std::sync::Arc;
use std::sync::atomic::AtomicU64;
use std::time::{Duration, Instant};

/// Digests of 8 samples a pixel of the two scenes of [`subjects`], path traced.
///
/// They say that every machine, processor and compiler makes the same picture. Whoever changes what a sample is (random numbers,
/// order of floating-point operations in scattering, lights or hits, a filter's table) changes them on purpose: raise
/// `GENERATION` in luch-render's `fingerprint.rs`, so that old film files are not mixed with new ones, and put the new digests here,
/// which the failing test prints. If they change without that, a picture depends on something it should not.
const GOLDEN: [(&str, &str); 2] = [
    ("cornell", "d11665c4b67ac57b3b10c11090cefc129a4abf014ea881c7c7b01086f1118529"),
    ("everything", "e3a69ec54722b5da154bfa24a93a6c0bc9767391fd4f3d00543982487d49ef17"),
];

/// A digest of all that can be read from a film: means and variances in full, and the numbers of samples.
fn digest(film: &Film) -> String {
    let mut hasher = blake3::Hasher::new();
    film.read(|estimate, count| {
        let variance = estimate.variance.map_or([-1.0; 3], |variance| variance);
        for value in estimate.mean.into_iter().chain(variance) {
            hasher.update(&value.to_bits().to_le_bytes());
        }
        hasher.update(&count.to_le_bytes());
    });
    hasher.finalize().to_hex().to_string()
}

fn pass(subject: &Subject, film: &mut Film, range: Range<u64>, stop: &Stop) -> Result<(), Stopped> {
    let integrator = from_settings(subject.world.scene.settings.integrator, &subject.view);
    render_pass(&subject.world, &subject.view, &*integrator, film, range, stop, &AtomicU64::new(0))
}

/// A film of the samples of `ranges`, one pass for each.
fn film(subject: &Subject, ranges: impl IntoIterator<Item = Range<u64>>) -> Film {
    let mut film = Film::new(subject.view.width(), subject.view.height());
    for range in ranges {
        pass(subject, &mut film, range, &Stop::new()).expect("nobody stops it");
    }
    film
}

#[test]
fn any_number_of_threads() {
    for subject in subjects() {
        let on = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            // The world too: trees are built in parallel.
            pool.install(|| film(&subject.rebuilt(), [0..8]))
        };
        let one = on(1);
        for threads in [2, 3, 8] {
            let many = on(threads);
            assert_eq!(digest(&many), digest(&one), "{} on {threads} threads", subject.name);
            assert_eq!(many, one);
        }
    }
}

#[test]
fn any_passes_in_any_order() {
    for subject in subjects() {
        let whole = film(&subject, [0..64]);
        let expected = digest(&whole);
        let single = film(&subject, (0..64).map(|index| index..index + 1));
        assert_eq!(digest(&single), expected, "{}: 64 passes of one", subject.name);
        assert_eq!(digest(&film(&subject, [0..32, 32..64])), expected, "{}: halves", subject.name);
        assert_eq!(digest(&film(&subject, [32..64, 0..32])), expected, "{}: halves swapped", subject.name);
        let mut shuffled: Vec<u64> = (0..64).collect();
        shuffled.sort_by_key(|&index| hash::mix64(index));
        let shuffled = film(&subject, shuffled.into_iter().map(|index| index..index + 1));
        assert_eq!(digest(&shuffled), expected, "{}: shuffled", subject.name);
        // Passes that overlap add no sample twice.
        assert_eq!(
            digest(&film(&subject, [10..40, 0..33, 5..64])),
            expected,
            "{}: overlapping",
            subject.name
        );
        assert_eq!(single, whole);
    }
}

#[test]
fn four_machines_merged_in_every_order() {
    for subject in subjects() {
        let expected = film(&subject, [0..24]);
        // Each machine takes its share, with gaps; pixels of a machine's film hold what the others lack.
        let shares = [vec![0..3, 9..12], vec![3..4], vec![12..24], vec![4..9]];
        let films = shares.map(|share| film(&subject.rebuilt(), share));
        let mut orders = 0;
        for order in 0..256_usize {
            let order = [order % 4, order / 4 % 4, order / 16 % 4, order / 64];
            if (0..4).any(|machine| !order.contains(&machine)) {
                continue;
            }
            orders += 1;
            let mut merged = Film::new(subject.view.width(), subject.view.height());
            for machine in order {
                merged.merge(&films[machine]).unwrap();
            }
            assert_eq!(merged, expected, "{} in order {order:?}", subject.name);
        }
        assert_eq!(orders, 24);
    }
}

#[test]
fn stopped_at_any_moment_and_gone_on() {
    for subject in subjects() {
        let expected = film(&subject, [0..24]);
        for seed in 0..3_u64 {
            let mut film = Film::new(subject.view.width(), subject.view.height());
            let mut stops = 0;
            loop {
                // Now by a deadline, now by a request from another thread, later and later so that it ends.
                let time = Duration::from_micros(hash::mix64(seed * 1000 + stops) % (500 + 400 * stops));
                let stop = Stop::new();
                let done = if (seed + stops) % 2 == 0 {
                    pass(&subject, &mut film, 0..24, &stop.with_deadline(Some(Instant::now() + time)))
                } else {
                    std::thread::scope(|scope| {
                        scope.spawn(|| {
                            std::thread::sleep(time);
                            stop.request();
                        });
                        pass(&subject, &mut film, 0..24, &stop)
                    })
                };
                if done.is_ok() {
                    break;
                }
                stops += 1;
            }
            assert!(stops > 0, "the test stopped nothing");
            assert_eq!(digest(&film), digest(&expected), "{} after {stops} stops", subject.name);
            assert_eq!(film, expected);
        }
    }
}

#[test]
fn a_job_interrupted_through_files() {
    for subject in subjects() {
        let expected = film(&subject, [0..16]);
        let camera = subject.world.scene.cameras[0].camera;
        let fingerprint = Fingerprint::of(&subject.world.scene, &camera);
        let empty = Film::new(subject.view.width(), subject.view.height());
        let mut bytes = Checkpoint { fingerprint, provenance: Provenance::default(), film: empty }.encode();
        let mut cancels = 0;
        loop {
            // As another program would: from the file and the scene alone.
            let subject = subject.rebuilt();
            let checkpoint = Checkpoint::decode(&bytes).unwrap();
            assert_eq!(checkpoint.fingerprint, Fingerprint::of(&subject.world.scene, &camera));
            let already = checkpoint.film.total_samples();
            let job = RenderJob::start(JobPlan {
                integrator: from_settings(subject.world.scene.settings.integrator, &subject.view),
                world: Arc::new(subject.world),
                view: Arc::new(subject.view),
                film: checkpoint.film,
                goal: Goal::samples(16),
                threads: Some(1 + cancels % 3),
                snapshot_every: Duration::from_millis(20),
                on_snapshot: Box::new(|_, _| {}),
            })
            .unwrap();
            let pixels = expected.width() * expected.height();
            while job.progress().samples <= already + u64::from(pixels) * 3 && !job.is_finished() {
                std::thread::yield_now();
            }
            job.cancel();
            let end = job.join();
            bytes = Checkpoint { film: end.film, ..Checkpoint::decode(&bytes).unwrap() }.encode();
            cancels += 1;
            if end.ending == Ending::Samples {
                break;
            }
        }
        assert!(cancels > 2, "the test interrupted nothing");
        let end = Checkpoint::decode(&bytes).unwrap();
        assert_eq!(end.film, expected, "{} after {cancels} jobs", subject.name);
        // The file too is the same as that of a rendering without interruption.
        let straight = Checkpoint { fingerprint, provenance: Provenance::default(), film: expected };
        assert_eq!(bytes, straight.encode());
    }
}

#[test]
fn alone_or_together() {
    for subject in subjects() {
        let expected = film(&subject, [0..6]);
        let integrator = from_settings(subject.world.scene.settings.integrator, &subject.view);
        // Each bundle by itself, added up as numbers beside the film.
        let width = subject.view.width();
        let bundle_width = |x: u32| BUNDLE.min(width - (x - x % BUNDLE));
        let means = expected.read(|estimate, _| estimate.mean);
        for (place, found) in (0..).zip(means.pixels()) {
            let pixel = [place % width, place / width];
            let mut streams = [[0_i128; 3]; 2];
            for index in 0..6 {
                let bundle = subject.view.bundle(pixel, index);
                let mut radiance = vec![Rgb::BLACK; bundle.len()];
                integrator.radiance(&subject.world, &bundle, &mut radiance, &Stop::new()).unwrap();
                let own = radiance[(pixel[1] % BUNDLE * bundle_width(pixel[0]) + pixel[0] % BUNDLE) as usize];
                for (sum, value) in streams[(index % 2) as usize].iter_mut().zip(own.to_array()) {
                    *sum += (f64::from(value) / expected.step()).round_ties_even() as i128;
                }
            }
            let mean = |channel: usize| {
                let [a, b] = streams.map(|sums| sums[channel] as f64 * expected.step() / 3.0);
                (a + b) / 2.0
            };
            assert_eq!(*found, [mean(0), mean(1), mean(2)], "{} at {pixel:?}", subject.name);
        }
    }
}

#[test]
fn every_integrator_and_every_sequence() {
    let mut integrators = vec![
        Name::Path { max_depth: 64 },
        Name::PlainPath { max_depth: 64 },
        Name::Direct,
        Name::Occlusion { distance: 1.0 },
    ];
    integrators.extend(Property::ALL.map(Name::Inspect));
    let mut seen = Vec::new();
    for subject in subjects() {
        for &integrator in &integrators {
            for sequence in Sequence::ALL {
                let subject = subject.with(|settings| {
                    settings.integrator = integrator;
                    settings.sequence = sequence;
                    (settings.width, settings.height) = (settings.width / 2, settings.height / 2);
                });
                let on = |threads: usize, ranges: &[Range<u64>]| {
                    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
                    pool.install(|| film(&subject, ranges.iter().cloned()))
                };
                let (one, many) = (on(1, &[0..6]), on(3, &[5..6, 1..2, 0..1, 2..5]));
                assert_eq!(one, many, "{} by {integrator:?} with {sequence:?}", subject.name);
                assert!(one.losses().is_none(), "{} by {integrator:?}", subject.name);
                seen.push(digest(&one));
            }
        }
    }
    // They are in earnest: what should differ does. The plain scene has no uv, whatever the sequence, and its smooth normals are
    // its true ones.
    let all = seen.len();
    seen.sort();
    seen.dedup();
    assert_eq!(seen.len(), all - 3 - 4);
}

#[test]
fn the_same_bits_on_every_machine() {
    // Other tests run meanwhile; the level of vector instructions is no business of theirs either.
    for level in Level::ALL {
        level.limit();
        let made = subjects().map(|subject| (subject.name, digest(&film(&subject, [0..8]))));
        let made: Vec<(&str, &str)> = made.iter().map(|(name, digest)| (*name, digest.as_str())).collect();
        assert_eq!(made, GOLDEN, "at level {}; see the comment at GOLDEN", level.name());
    }
}
