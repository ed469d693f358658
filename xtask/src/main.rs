//! Chores of the workspace. `cargo run -p xtask -- layers` is part of every check.
#![expect(clippy::print_stdout, clippy::print_stderr, reason = "a command speaks to people")]

mod bench;
mod figures;
mod gallery;
mod layers;

use std::path::PathBuf;
use std::process::{Command, ExitCode};

fn main() -> ExitCode {
    let task = std::env::args().nth(1).unwrap_or_default();
    let result = match task.as_str() {
        "layers" => layers::check(&root()),
        "gallery" => gallery::render(&root()),
        "figures" => figures::render(&root()),
        "check" => check(),
        "bench" => bench::run(&root(), &std::env::args_os().skip(2).collect::<Vec<_>>()),
        _ => Err("usage: cargo run -p xtask -- check | layers | gallery | figures | bench".to_owned()),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("error: {message}");
            ExitCode::FAILURE
        }
    }
}

/// The folder of the workspace.
fn root() -> PathBuf {
    let xtask = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
    xtask.parent().map_or(xtask.clone(), PathBuf::from)
}

/// What CI runs, line for line.
fn check() -> Result<(), String> {
    run(Command::new("bash").arg(".ci/run").current_dir(root()))
}

/// Runs a command to its end.
fn run(command: &mut Command) -> Result<(), String> {
    let status = command.status().map_err(|error| format!("{command:?}: {error}"))?;
    if status.success() { Ok(()) } else { Err(format!("{command:?} ended with {status}")) }
}
