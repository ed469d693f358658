//! What others ask of a job.

use crate::stop::Stop;
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Instant;

/// Wishes of those who hold a job, seen by its thread.
#[derive(Debug, Default)]
pub(super) struct Control {
    wishes: Mutex<Wishes>,
    changed: Condvar,
    /// Ends the pass under way so that wishes are looked at.
    stop: Stop,
}

#[derive(Debug, Default)]
struct Wishes {
    cancelled: bool,
    paused: bool,
}

impl Control {
    fn wishes(&self) -> MutexGuard<'_, Wishes> {
        self.wishes.lock().unwrap_or_else(PoisonError::into_inner)
    }

    pub(super) fn cancel(&self) {
        self.wishes().cancelled = true;
        self.stop.request();
        self.changed.notify_all();
    }

    pub(super) fn pause(&self) {
        self.wishes().paused = true;
        self.stop.request();
    }

    pub(super) fn resume(&self) {
        self.wishes().paused = false;
        self.changed.notify_all();
    }

    pub(super) fn is_cancelled(&self) -> bool {
        self.wishes().cancelled
    }

    /// Blocks while paused and not cancelled.
    pub(super) fn wait_while_paused(&self) {
        let wishes = self.wishes();
        let held = |wishes: &mut Wishes| wishes.paused && !wishes.cancelled;
        let wishes = self.changed.wait_while(wishes, held).unwrap_or_else(PoisonError::into_inner);
        // Under the lock, so that no later wish is lost.
        if !wishes.cancelled {
            self.stop.withdraw();
        }
    }

    /// What a pass is given to stop it.
    pub(super) fn stop(&self, deadline: Option<Instant>) -> Stop {
        self.stop.with_deadline(deadline)
    }
}
