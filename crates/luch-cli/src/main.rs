//! The `luch` command: what was typed, then one function for each verb.
//!
//! | exit status | meaning |
//! |---|---|
//! | 0 | done; `reproduce`: equal; `compare`: within the limits; `bench`: all answers the same |
//! | 1 | failed; `reproduce`: different; `compare`: a limit is exceeded; `check`: cannot be rendered; `bench`: answers differ; `lab truth`: rejected |
//! | 2 | the command line cannot be understood |
//! | 130 | stopped by Ctrl-C or a request to end; what was rendered is saved |

mod args;
mod bench;
mod check;
mod compare;
mod completions;
mod develop;
mod display;
mod failure;
mod film_file;
mod interrupt;
mod lab;
mod layers;
mod merge;
mod mesh;
mod outputs;
mod parse;
mod preview;
mod processor_time;
mod progress;
mod provenance;
mod recipe;
mod render;
mod reproduce;
mod same_file;
mod terminal;

use args::{Command, Verb};
use clap::Parser;
use std::process::ExitCode;

fn main() -> ExitCode {
    let result = match Command::parse().verb {
        Verb::Render(args) => render::run(&args),
        Verb::Reproduce(args) => reproduce::run(&args),
        Verb::Merge(args) => merge::run(&args),
        Verb::Develop(args) => develop::run(&args),
        Verb::Compare(args) => compare::run(&args),
        Verb::Check(args) => check::run(&args),
        Verb::Mesh(args) => mesh::run(&args),
        Verb::Preview(args) => preview::run(&args),
        Verb::Lab(args) => lab::run(&args),
        Verb::Bench(args) => bench::run(&args),
        Verb::Completions(args) => completions::run(&args),
    };
    match result {
        Ok(outcome) => match terminal::trouble() {
            None => outcome.into(),
            Some(trouble) => {
                terminal::complain(&format!("error: standard output cannot be written: {trouble}"));
                ExitCode::FAILURE
            }
        },
        Err(failure) => {
            terminal::complain(&format!("error: {failure}"));
            failure.exit_code()
        }
    }
}
