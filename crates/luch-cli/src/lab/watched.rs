//! Long work in the laboratory: told how far it is, and ended by Ctrl-C.

use crate::args::LabOutputArgs;
use crate::failure::Failure;
use crate::interrupt::Interrupt;
use crate::terminal::{clock, rewrite_line};
use crate::{processor_time, terminal};
use luch::render::Stop;
use luch_lab::rendering::{RenderingError, Work};
use std::io::IsTerminal;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

/// Time between two looks at the work.
const LOOK: Duration = Duration::from_millis(20);

/// Time between two lines.
const TELL: Duration = Duration::from_millis(200);

/// What [`time`] measures.
pub(super) fn what_time() -> &'static str {
    if processor_time::of_process().is_some() {
        "seconds of processor time, all threads together"
    } else {
        "seconds on the clock"
    }
}

/// Time spent by this process so far, or on the clock where the system does not tell.
fn time(start: Instant) -> Duration {
    processor_time::of_process().unwrap_or_else(|| start.elapsed())
}

/// Does work of so many samples; `None` if somebody ended it.
pub(super) fn watched<T: Send>(
    total: u64,
    args: &LabOutputArgs,
    work: impl FnOnce(&Work<'_>) -> Result<T, RenderingError> + Send,
) -> Result<Option<T>, Failure> {
    let interrupt = Interrupt::install()?;
    let (stop, done, start) = (Stop::new(), AtomicU64::new(0), Instant::now());
    let tells = !args.json && std::io::stderr().is_terminal();
    interrupt.work_begins();
    let found = std::thread::scope(|scope| {
        let (stop, done) = (&stop, &done);
        let worker = scope.spawn(move || work(&Work { stop, done, clock: &move || time(start) }));
        let mut next = start + TELL;
        while !worker.is_finished() {
            if interrupt.wait(LOOK) {
                stop.request();
            }
            if tells && Instant::now() >= next {
                let share = done.load(Ordering::Relaxed) as f64 / total.max(1) as f64;
                let left = start.elapsed().div_f64(share.max(1e-9)).saturating_sub(start.elapsed());
                let left = if share > 0.01 { format!("  {} left", clock(left)) } else { String::new() };
                rewrite_line(&format!(
                    "{:3.0}%  {} elapsed{left}",
                    (100.0 * share).floor(),
                    clock(start.elapsed())
                ));
                next = Instant::now() + TELL;
            }
        }
        worker.join()
    });
    if tells {
        rewrite_line("");
    }
    match found {
        Ok(Ok(found)) => Ok(Some(found)),
        Ok(Err(RenderingError::Stopped(_))) => {
            terminal::complain("interrupted: nothing is written");
            Ok(None)
        }
        Ok(Err(error)) => Err(error.into()),
        Err(panic) => std::panic::resume_unwind(panic),
    }
}
