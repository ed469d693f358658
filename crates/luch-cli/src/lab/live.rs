//! A figure that grows in the terminal while the work goes on, and is gone when the result is there.

use luch_lab::figure::{Depth, Figure};
use std::io::{IsTerminal, Write};
use std::time::{Duration, Instant};

/// Time between two pictures.
const EVERY: Duration = Duration::from_millis(250);

/// Columns of the figure.
const COLUMNS: usize = 80;

/// The figure on standard error, if people look at it.
pub(super) struct Live {
    is_wanted: bool,
    /// Lines that stand there now.
    lines: usize,
    next: Instant,
}

impl Live {
    /// Nothing is shown in files, pipes and to programs.
    pub(super) fn new(is_json: bool) -> Self {
        let is_seen = std::io::stderr().is_terminal() && std::io::stdout().is_terminal();
        // Short work needs no picture.
        Self { is_wanted: is_seen && !is_json, lines: 0, next: Instant::now() + EVERY }
    }

    /// Shows a figure in the place of the last one, if it is time.
    pub(super) fn show(&mut self, figure: impl FnOnce() -> Figure) {
        if !self.is_wanted || Instant::now() < self.next {
            return;
        }
        let text = figure().to_terminal(COLUMNS, Depth::Letters);
        let _ = write!(std::io::stderr().lock(), "{}{text}", erased(self.lines));
        self.lines = text.lines().count();
        self.next = Instant::now() + EVERY;
    }

    /// Takes the last figure away.
    pub(super) fn end(&mut self) {
        let _ = write!(std::io::stderr().lock(), "{}", erased(self.lines));
        self.lines = 0;
    }
}

/// Back over so many lines, and all below cleared.
fn erased(lines: usize) -> String {
    if lines == 0 { String::new() } else { format!("\x1b[{lines}A\r\x1b[J") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_terminal_goes_back_over_what_was_shown() {
        assert_eq!(erased(0), "");
        assert_eq!(erased(12), "\x1b[12A\r\x1b[J");
        // Tests have no terminal.
        let mut live = Live { is_wanted: false, ..Live::new(false) };
        live.show(|| unreachable!("nobody looks"));
        live.end();
    }
}
