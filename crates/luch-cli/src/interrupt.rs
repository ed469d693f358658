//! Ctrl-C and requests to terminate.
//!
//! The first one asks for the end if there is work to save, and ends the process otherwise. The second ends it at once, but never while a
//! file is being written: whoever writes holds the pen. The third does not wait for the pen either.

use crate::failure::{Failure, INTERRUPTED};
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// Where wishes to end arrive.
pub(crate) struct Interrupt {
    arrivals: Receiver<()>,
    shared: Arc<Shared>,
}

#[derive(Default)]
struct Shared {
    count: AtomicU32,
    /// Whether somebody saves the work when asked to end.
    at_work: AtomicBool,
    pen: Mutex<()>,
}

/// The right to write files; clones share it.
#[derive(Clone)]
pub(crate) struct Pen(Arc<Shared>);

impl Pen {
    /// Nobody ends the process while this is held, short of insisting twice.
    pub(crate) fn hold(&self) -> MutexGuard<'_, ()> {
        self.0.pen.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Whether the end has been asked for.
    pub(crate) fn is_interrupted(&self) -> bool {
        self.0.count.load(Ordering::SeqCst) > 0
    }
}

impl Interrupt {
    /// Starts to listen; once in a process.
    pub(crate) fn install() -> Result<Self, Failure> {
        let shared = Arc::new(Shared::default());
        let (sender, arrivals) = channel();
        let handler = Arc::clone(&shared);
        ctrlc::set_handler(move || handler.arrived(&sender))?;
        Ok(Self { arrivals, shared })
    }

    /// The pen of this process.
    pub(crate) fn pen(&self) -> Pen {
        Pen(Arc::clone(&self.shared))
    }

    /// From now on a first wish is heard by [`Interrupt::wait`] instead of ending the process.
    pub(crate) fn work_begins(&self) {
        self.shared.at_work.store(true, Ordering::SeqCst);
    }

    /// Waits for a wish to end, at most `time`; true if one came.
    pub(crate) fn wait(&self, time: Duration) -> bool {
        match self.arrivals.recv_timeout(time) {
            Ok(()) => true,
            Err(RecvTimeoutError::Timeout) => false,
            // The handler lives as long as the process.
            Err(RecvTimeoutError::Disconnected) => {
                std::thread::sleep(time);
                false
            }
        }
    }
}

impl Shared {
    fn arrived(&self, sender: &Sender<()>) {
        let earlier = self.count.fetch_add(1, Ordering::SeqCst);
        if earlier == 0 && self.at_work.load(Ordering::SeqCst) {
            // The receiver may be gone if the work ended just now; then nothing is left to save.
            let _ = sender.send(());
            return;
        }
        let _pen = (earlier < 2).then(|| self.pen.lock().unwrap_or_else(PoisonError::into_inner));
        std::process::exit(i32::from(INTERRUPTED));
    }
}
