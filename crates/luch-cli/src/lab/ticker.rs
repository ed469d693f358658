//! One line about how much is done, while somebody watches.

use crate::terminal::rewrite_line;
use std::io::IsTerminal;
use std::sync::Mutex;
use std::time::{Duration, Instant};

/// Time between two lines.
const EVERY: Duration = Duration::from_millis(100);

/// A line that is rewritten, and cleared at the end.
pub(super) struct Ticker {
    what: &'static str,
    last: Option<Mutex<Instant>>,
}

impl Ticker {
    /// Silent where nobody watches or `is_silent`.
    pub(super) fn new(what: &'static str, is_silent: bool) -> Self {
        let is_shown = !is_silent && std::io::stderr().is_terminal();
        Self { what, last: is_shown.then(|| Mutex::new(Instant::now())) }
    }

    /// So much of so much is done.
    pub(super) fn tell(&self, done: usize, all: usize) {
        if let Some(last) = &self.last
            && let Ok(mut last) = last.try_lock()
            && last.elapsed() >= EVERY
        {
            *last = Instant::now();
            rewrite_line(&format!("{}: {done} of {all}", self.what));
        }
    }
}

impl Drop for Ticker {
    fn drop(&mut self) {
        if self.last.is_some() {
            rewrite_line("");
        }
    }
}
