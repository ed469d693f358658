//! What a rendering in its own thread promises. No test asks how long anything takes.

use luch_image::Rgb;
use luch_render::{
    CameraSample, Ending, Film, Goal, Integrator, JobPlan, PathTracer, RenderJob, Stop, Stopped, View, World,
    render_pass,
};
use luch_scene::preset::cornell_box;
use std::ops::Range;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex, mpsc};
use std::time::Duration;

/// A time that no test reaches.
const LONG: Duration = Duration::from_secs(600);

fn plan(size: u32, goal: Goal) -> JobPlan {
    let mut scene = cornell_box();
    (scene.settings.width, scene.settings.height) = (size, size);
    JobPlan {
        view: Arc::new(View::new(&scene.cameras[0].camera, &scene.settings)),
        world: Arc::new(World::build(scene).unwrap()),
        integrator: Box::new(PathTracer::default()),
        film: Film::new(size, size),
        goal,
        threads: Some(2),
        snapshot_every: LONG,
        on_snapshot: Box::new(|_, _| {}),
    }
}

/// The film that a pass over the samples gives.
fn straight(plan: &JobPlan, range: Range<u64>) -> Film {
    let mut film = Film::new(plan.view.width(), plan.view.height());
    let integrator = &PathTracer::default();
    render_pass(&plan.world, &plan.view, integrator, &mut film, range, &Stop::new(), &AtomicU64::new(0))
        .unwrap();
    film
}

/// Paths that count the camera samples and are heard when they are dropped.
struct Counting {
    count: Arc<AtomicU64>,
    dropped: Arc<AtomicBool>,
}

impl Integrator for Counting {
    fn radiance(
        &self,
        world: &World,
        samples: &[CameraSample],
        radiance: &mut [Rgb],
        stop: &Stop,
    ) -> Result<(), Stopped> {
        self.count.fetch_add(samples.len() as u64, Ordering::SeqCst);
        PathTracer::default().radiance(world, samples, radiance, stop)
    }
}

impl Drop for Counting {
    fn drop(&mut self) {
        self.dropped.store(true, Ordering::SeqCst);
    }
}

/// Reports each snapshot's samples through a channel.
fn watched(plan: &mut JobPlan) -> mpsc::Receiver<u64> {
    let (tell, told) = mpsc::channel();
    plan.on_snapshot = Box::new(move |film, _| {
        // Nobody may be listening any more.
        let _ = tell.send(film.min_samples());
    });
    told
}

#[test]
fn a_number_of_samples_is_a_goal() {
    for count in [0, 1, 5, 16] {
        let plan = plan(40, Goal::samples(count));
        let expected = straight(&plan, 0..count);
        let end = RenderJob::start(plan).unwrap().join();
        assert_eq!((end.ending, &end.film), (Ending::Samples, &expected));
        assert_eq!(end.progress.samples, count * 40 * 40);
        assert_eq!(end.progress.samples_per_pixel, count as f64);
        assert_eq!(end.progress.samples_wanted, Some(count));
        assert_eq!(end.progress.error, end.film.error());
    }
}

#[test]
fn any_range_of_samples_is_a_goal() {
    let made = plan(33, Goal { samples: 7..18, ..Goal::default() });
    let expected = straight(&made, 7..18);
    let end = RenderJob::start(made).unwrap().join();
    assert_eq!((end.ending, end.film), (Ending::Samples, expected));
    // One that runs backward is empty.
    let range = Range { start: 18, end: 7 };
    let end = RenderJob::start(plan(8, Goal { samples: range, ..Goal::default() })).unwrap().join();
    assert_eq!((end.ending, end.film.total_samples()), (Ending::Samples, 0));
}

#[test]
fn time_is_a_goal() {
    let end =
        RenderJob::start(plan(32, Goal { time: Some(Duration::ZERO), ..Goal::default() })).unwrap().join();
    assert_eq!((end.ending, end.film.total_samples()), (Ending::Time, 0));
    let time = Duration::from_millis(150);
    let end = RenderJob::start(plan(32, Goal { time: Some(time), ..Goal::default() })).unwrap().join();
    assert_eq!(end.ending, Ending::Time);
    assert!(end.progress.elapsed >= time && end.progress.rate > 0.0);
    assert_eq!(end.progress.samples, end.film.total_samples());
}

#[test]
fn an_error_is_a_goal() {
    let goal = 0.05;
    let made = plan(24, Goal { relative_error: Some(goal), ..Goal::default() });
    let end = RenderJob::start(made).unwrap().join();
    assert_eq!(end.ending, Ending::Error);
    assert!(end.film.error().unwrap().relative <= goal);
    // It ended at the first power of two that was good enough.
    let count = end.film.min_samples();
    assert!(count.is_power_of_two() && count >= 16, "{count}");
    let half = straight(&plan(24, Goal::default()), 0..count / 2);
    assert!(count == 16 || half.error().unwrap().relative > goal);
    // The first goal reached is the end.
    let both = Goal { relative_error: Some(1e-9), ..Goal::samples(32) };
    assert_eq!(RenderJob::start(plan(24, both)).unwrap().join().ending, Ending::Samples);
}

#[test]
fn a_job_adds_only_what_is_missing() {
    let mut plan = plan(40, Goal::samples(16));
    let (count, dropped) = (Arc::new(AtomicU64::new(0)), Arc::new(AtomicBool::new(false)));
    plan.integrator = Box::new(Counting { count: Arc::clone(&count), dropped });
    plan.film = straight(&plan, 2..11);
    let expected = straight(&plan, 0..16);
    let end = RenderJob::start(plan).unwrap().join();
    assert_eq!((end.ending, &end.film), (Ending::Samples, &expected));
    assert_eq!(count.load(Ordering::SeqCst), 7 * 40 * 40);
    assert_eq!(end.progress.samples, 16 * 40 * 40);

    // Nothing is missing: nothing is done.
    let mut again = self::plan(40, Goal::samples(16));
    again.film = end.film;
    let end = RenderJob::start(again).unwrap().join();
    assert_eq!((end.ending, end.film), (Ending::Samples, expected));
}

#[test]
fn the_first_snapshot_has_a_sample_everywhere_and_more_follow() {
    let mut rare = plan(48, Goal::samples(8));
    let told = watched(&mut rare);
    RenderJob::start(rare).unwrap().join();
    let seen: Vec<u64> = told.iter().collect();
    assert_eq!(seen, [1], "one as soon as every pixel has a sample, the next after a long time");

    let mut often = plan(48, Goal::default());
    often.snapshot_every = Duration::ZERO;
    let told = watched(&mut often);
    let job = RenderJob::start(often).unwrap();
    let seen: Vec<u64> = told.iter().take(20).collect();
    job.cancel();
    let end = job.join();
    assert!(seen.windows(2).all(|pair| pair[0] <= pair[1]), "{seen:?}");
    // However often the film is shown, it grows.
    assert!(end.film.min_samples() > 0 && seen[19] > 0, "{seen:?}");
}

#[test]
fn extreme_times_are_times() {
    let mut plan = plan(8, Goal { time: Some(Duration::MAX), ..Goal::samples(4) });
    plan.snapshot_every = Duration::MAX;
    assert_eq!(RenderJob::start(plan).unwrap().join().ending, Ending::Samples);
}

#[test]
fn a_pause_holds_everything() {
    let mut plan = plan(48, Goal::default());
    let (count, dropped) = (Arc::new(AtomicU64::new(0)), Arc::new(AtomicBool::new(false)));
    plan.integrator = Box::new(Counting { count: Arc::clone(&count), dropped });
    let told = watched(&mut plan);
    let job = RenderJob::start(plan).unwrap();
    told.recv().unwrap();
    job.pause();
    // What is under way ends; then the number of samples begun stands still.
    let settled = || loop {
        let before = count.load(Ordering::SeqCst);
        std::thread::sleep(Duration::from_millis(60));
        if count.load(Ordering::SeqCst) == before {
            break before;
        }
    };
    let (begun, held) = (settled(), job.progress().samples);
    std::thread::sleep(Duration::from_millis(60));
    assert_eq!((count.load(Ordering::SeqCst), job.progress().samples), (begun, held));
    assert!(!job.is_finished());
    job.resume();
    while job.progress().samples == held {
        std::thread::yield_now();
    }
    // A paused job can be cancelled.
    job.pause();
    job.cancel();
    let end = job.join();
    assert_eq!(end.ending, Ending::Cancelled);
    assert_eq!(end.film.total_samples(), end.progress.samples);
}

#[test]
fn what_a_cancelled_job_leaves_can_be_gone_on_with() {
    let expected = straight(&plan(40, Goal::default()), 0..64);
    let mut film = Film::new(40, 40);
    for cancels in 0..12 {
        let mut made = plan(40, Goal::samples(64));
        made.film = film;
        let already = made.film.total_samples();
        let job = RenderJob::start(made).unwrap();
        if cancels < 11 {
            // After some more samples, or at once.
            let more = 40 * 40 * 3 * (cancels % 4);
            while job.progress().samples < already + more && !job.is_finished() {
                std::thread::yield_now();
            }
            job.cancel();
        }
        let end = job.join();
        assert!(matches!(end.ending, Ending::Cancelled | Ending::Samples));
        assert!(end.film.total_samples() >= already);
        film = end.film;
    }
    assert_eq!(film, expected);
}

#[test]
fn a_dropped_job_is_cancelled() {
    let mut plan = plan(48, Goal::default());
    let (count, dropped) = (Arc::new(AtomicU64::new(0)), Arc::new(AtomicBool::new(false)));
    plan.integrator = Box::new(Counting { count, dropped: Arc::clone(&dropped) });
    let job = RenderJob::start(plan).unwrap();
    assert!(!job.is_finished());
    drop(job);
    // The thread is gone with all it had.
    assert!(dropped.load(Ordering::SeqCst));
}

#[test]
fn snapshots_show_progress_that_agrees_with_the_film() {
    let mut plan = plan(40, Goal::samples(32));
    plan.snapshot_every = Duration::from_millis(10);
    let seen = Arc::new(Mutex::new(Vec::new()));
    let log = Arc::clone(&seen);
    plan.on_snapshot = Box::new(move |film, progress| {
        log.lock().unwrap().push((film.total_samples(), *progress, film.error()));
    });
    let end = RenderJob::start(plan).unwrap().join();
    let seen = seen.lock().unwrap();
    assert!(!seen.is_empty());
    for (samples, progress, error) in seen.iter() {
        assert_eq!(progress.samples, *samples);
        // While a stream is still empty somewhere, the last known error is shown.
        assert!(error.is_none() || progress.error == *error);
        assert!(progress.elapsed <= end.progress.elapsed);
        assert!(progress.remaining.is_some() || progress.rate == 0.0);
    }
}
