//! Saying things. A reader that went away is no reason to stop working, so failures to write end nothing; results that are lost otherwise, as
//! on a full disk, are told at the end.

use std::io::{ErrorKind, Write};
use std::sync::OnceLock;

/// Why a result was lost, the first time.
static TROUBLE: OnceLock<String> = OnceLock::new();

/// A line of results, on standard output.
pub(crate) fn say(line: &str) {
    let mut out = std::io::stdout().lock();
    if let Err(error) = writeln!(out, "{line}").and_then(|()| out.flush())
        && error.kind() != ErrorKind::BrokenPipe
    {
        TROUBLE.get_or_init(|| error.to_string());
    }
}

/// Why a line of results did not reach anybody who wanted it.
pub(crate) fn trouble() -> Option<&'static str> {
    TROUBLE.get().map(String::as_str)
}

/// A line about the work, on standard error.
pub(crate) fn complain(line: &str) {
    // Standard error may be a closed pipe.
    let _ = writeln!(std::io::stderr().lock(), "{line}");
}

/// Part of a line about the work, on standard error; the caller ends the line.
pub(crate) fn rewrite_line(text: &str) {
    let mut err = std::io::stderr().lock();
    // Back to the first column, clear the line.
    let _ = write!(err, "\r\x1b[2K{text}").and_then(|()| err.flush());
}

/// 3, 1.5, 0.02: three significant digits, without an exponent where people can still read it.
pub(crate) fn short(value: f64) -> String {
    let size = value.abs();
    if size == 0.0 || !size.is_finite() {
        format!("{value}")
    } else if !(1e-4..1e6).contains(&size) {
        format!("{value:.2e}")
    } else {
        let decimals = if size >= 100.0 {
            0
        } else if size >= 10.0 {
            1
        } else if size >= 1.0 {
            2
        } else if size >= 0.1 {
            3
        } else {
            5
        };
        format!("{value:.decimals$}")
    }
}

/// Samples of a pixel: whole numbers as such.
pub(crate) fn samples(mean: f64) -> String {
    if mean.fract() == 0.0 { format!("{mean}") } else { short(mean) }
}

/// `4.2 M`, with a space before whatever unit follows.
pub(crate) fn metric(value: f64) -> String {
    let scales = [(1e9, "G"), (1e6, "M"), (1e3, "k")];
    match scales.iter().find(|(scale, _)| value >= *scale) {
        Some((scale, letter)) => format!("{:.1} {letter}", value / scale),
        None => format!("{value:.0} "),
    }
}

/// Bytes as people say them.
pub(crate) fn bytes(count: u64) -> String {
    let scales = [(1u64 << 30, "GiB"), (1 << 20, "MiB"), (1 << 10, "KiB")];
    match scales.iter().find(|(scale, _)| count >= *scale) {
        Some((scale, unit)) => format!("{:.1} {unit}", count as f64 / *scale as f64),
        None => format!("{count} bytes"),
    }
}

/// `0:07`, `12:34`, `1:02:03`.
pub(crate) fn clock(time: std::time::Duration) -> String {
    let seconds = time.as_secs();
    let (hours, minutes, seconds) = (seconds / 3600, seconds / 60 % 60, seconds % 60);
    if hours > 0 { format!("{hours}:{minutes:02}:{seconds:02}") } else { format!("{minutes}:{seconds:02}") }
}

/// A command line as it could be typed again.
pub(crate) fn command_line(words: impl IntoIterator<Item = String>) -> String {
    let plain = |c: char| c.is_alphanumeric() || "-_./:=,+@%".contains(c);
    let quoted = |word: String| {
        if !word.is_empty() && word.chars().all(plain) {
            word
        } else {
            format!("'{}'", word.replace('\'', r"'\''"))
        }
    };
    words.into_iter().map(quoted).collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Duration;

    #[test]
    fn numbers_are_short() {
        assert_eq!(
            [0.0, 1.2345, 0.01234, 123.4, 1e-9].map(short),
            ["0", "1.23", "0.01234", "123", "1.00e-9"]
        );
        assert_eq!([12.0, 4.21e6].map(metric), ["12 ", "4.2 M"]);
        assert_eq!([7, 754, 3723].map(|s| clock(Duration::from_secs(s))), ["0:07", "12:34", "1:02:03"]);
        assert_eq!([100, 3 << 20].map(bytes), ["100 bytes", "3.0 MiB"]);
    }

    #[test]
    fn a_command_can_be_typed_again() {
        let words = ["luch", "render", "my scene.kdl", "it's"].map(str::to_owned);
        assert_eq!(command_line(words), r"luch render 'my scene.kdl' 'it'\''s'");
    }
}
