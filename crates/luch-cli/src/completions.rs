//! `luch completions`: what a shell needs to complete the command.

use crate::args::{Command, CompletionsArgs};
use crate::failure::{Failure, Outcome};
use crate::terminal;
use clap::CommandFactory;

pub(crate) fn run(args: &CompletionsArgs) -> Result<Outcome, Failure> {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut Command::command(), "luch", &mut script);
    terminal::say(String::from_utf8_lossy(&script).trim_end());
    Ok(Outcome::Done)
}
