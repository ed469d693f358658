//! A wish to stop, seen by whoever works.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

/// Tells work in progress to end soon: on request, or when a moment has come. Clones share the request.
#[derive(Clone, Debug, Default)]
pub struct Stop {
    requested: Arc<AtomicBool>,
    deadline: Option<Instant>,
}

/// Work that ended before it was done. What was finished is kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("stopped on request")]
pub struct Stopped;

impl Stop {
    /// Only when requested.
    pub fn new() -> Self {
        Self::default()
    }

    /// When requested, of this one or the one it came from, or at `deadline`.
    pub fn with_deadline(&self, deadline: Option<Instant>) -> Self {
        Self { requested: Arc::clone(&self.requested), deadline }
    }

    /// Asks to stop.
    pub fn request(&self) {
        self.requested.store(true, Ordering::Relaxed);
    }

    /// Takes the request back.
    pub(crate) fn withdraw(&self) {
        self.requested.store(false, Ordering::Relaxed);
    }

    /// Whether it is time to stop.
    pub fn is_due(&self) -> bool {
        self.requested.load(Ordering::Relaxed)
            || self.deadline.is_some_and(|deadline| Instant::now() >= deadline)
    }

    /// Passes on unless it is time to stop.
    pub(crate) fn check(&self) -> Result<(), Stopped> {
        if self.is_due() { Err(Stopped) } else { Ok(()) }
    }
}
