//! Measures luch beside others: rays beside Embree's, pictures beside Mitsuba's. See `bench/README.md`.

mod embree;
mod peers;
mod table;

use std::ffi::OsString;
use std::fs::File;
use std::path::{Path, PathBuf};
use std::process::Command;

const USAGE: &str = "usage: cargo run -p xtask -- bench embree --ebench FILE --library FILE --meshes DIR --rays DIR [--only NAME,…] [--rounds N] [--repeat N] [--quality NAMES] [--threads N]
       cargo run -p xtask -- bench peers run|report --harness DIR --scenes DIR --out DIR [--python FILE] [options of the harness]";

/// Does what `arguments`, the words after `bench`, say.
pub(crate) fn run(root: &Path, arguments: &[OsString]) -> Result<(), String> {
    let (what, rest) = arguments.split_first().ok_or(USAGE)?;
    match what.to_str() {
        Some("embree") => embree::measure(root, rest),
        Some("peers") => peers::run(root, rest),
        _ => Err(USAGE.to_owned()),
    }
}

/// The values of options, each with its name before it; every other word is left over.
struct Options {
    given: Vec<(String, OsString)>,
    rest: Vec<OsString>,
}

impl Options {
    /// Reads the options that are named here.
    fn read(words: &[OsString], names: &[&str]) -> Result<Self, String> {
        let mut options = Self { given: Vec::new(), rest: Vec::new() };
        let mut words = words.iter();
        while let Some(word) = words.next() {
            match word.to_str().and_then(|word| word.strip_prefix("--")).filter(|name| names.contains(name)) {
                Some(name) => {
                    let value = words.next().ok_or(format!("--{name} needs a value\n{USAGE}"))?;
                    options.given.push((name.to_owned(), value.clone()));
                }
                None => options.rest.push(word.clone()),
            }
        }
        Ok(options)
    }

    fn find(&self, name: &str) -> Option<&OsString> {
        self.given.iter().rev().find(|(given, _)| given == name).map(|(_, value)| value)
    }

    fn path(&self, name: &str) -> Result<PathBuf, String> {
        self.find(name).map(PathBuf::from).ok_or(format!("--{name} is missing\n{USAGE}"))
    }

    fn text<'a>(&'a self, name: &str, usual: &'a str) -> Result<&'a str, String> {
        match self.find(name) {
            None => Ok(usual),
            Some(value) => value.to_str().ok_or(format!("--{name} is no text")),
        }
    }
}

/// The command as people get it: `LUCH_COMMAND`, or else built now.
fn command(root: &Path) -> Result<PathBuf, String> {
    if let Some(path) = std::env::var_os("LUCH_COMMAND") {
        return Ok(path.into());
    }
    let mut cargo = Command::new("cargo");
    crate::run(cargo.args(["build", "--release", "--quiet", "-p", "luch-cli"]).current_dir(root))?;
    let target = std::env::var_os("CARGO_TARGET_DIR").map_or(root.join("target"), PathBuf::from);
    Ok(target.join("release").join("luch"))
}

/// The lock of timed runs, `BENCH_LOCK` or `bench.lock` in the temporary folder, as the harness of the peers and flock(1) take it.
/// It is held until the file is dropped.
fn lock() -> Result<File, String> {
    let path =
        std::env::var_os("BENCH_LOCK").map_or_else(|| std::env::temp_dir().join("bench.lock"), PathBuf::from);
    let fail = |error: std::io::Error| format!("{}: {error}", path.display());
    let file = File::options().append(true).create(true).open(&path).map_err(fail)?;
    file.lock().map_err(fail)?;
    Ok(file)
}

/// What a command prints.
fn output(command: &mut Command) -> Result<String, String> {
    let output = command.output().map_err(|error| format!("{command:?}: {error}"))?;
    if !output.status.success() {
        let told = String::from_utf8_lossy(&output.stderr);
        return Err(format!("{command:?} ended with {}\n{told}", output.status));
    }
    String::from_utf8(output.stdout).map_err(|error| format!("{command:?}: {error}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn options_are_told_from_the_rest() {
        let words = ["--only", "a", "run", "--spp", "64", "--only", "b"].map(OsString::from);
        let options = Options::read(&words, &["only"]).unwrap();
        assert_eq!(options.text("only", "c"), Ok("b"));
        assert_eq!(options.text("rounds", "5"), Ok("5"));
        assert_eq!(options.rest, ["run", "--spp", "64"]);
        assert!(options.path("out").is_err() && Options::read(&words[..1], &["only"]).is_err());
    }
}
