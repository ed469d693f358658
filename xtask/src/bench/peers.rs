//! Pictures beside Mitsuba's: hands over to `bench/peers/peers.py` with our own command.

use super::{Options, command};
use std::ffi::OsString;
use std::path::Path;
use std::process::Command;

pub(super) fn run(root: &Path, words: &[OsString]) -> Result<(), String> {
    let options = Options::read(words, &["python"])?;
    let python = options
        .find("python")
        .cloned()
        .or_else(|| std::env::var_os("PEER_MITSUBA_PYTHON"))
        .ok_or("name a python with numpy in --python or PEER_MITSUBA_PYTHON")?;
    let mut script = Command::new(&python);
    script.arg(root.join("bench/peers/peers.py")).args(&options.rest);
    script.env("LUCH_COMMAND", command(root)?).env("LUCH_PYTHON", &python);
    crate::run(&mut script)
}
