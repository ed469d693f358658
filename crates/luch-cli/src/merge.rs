//! `luch merge`: films of disjoint samples become one.

use crate::args::MergeArgs;
use crate::failure::{Failure, Outcome};
use crate::film_file;
use crate::interrupt::Interrupt;
use crate::outputs;
use crate::terminal;
use luch::formats::write_atomically;
use luch::render::{Checkpoint, CheckpointError};
use std::path::{Path, PathBuf};

pub(crate) fn run(args: &MergeArgs) -> Result<Outcome, Failure> {
    if !film_file::is_film(&args.output) {
        return Err(Failure::usage(format!(
            "{}: a merged film is a film: let it end in .luch",
            args.output.display()
        )));
    }
    let pen = Interrupt::install()?.pen();
    outputs::probe(&args.output)?;
    let (first, rest) = args.films.split_first().ok_or_else(|| Failure::usage("name the films to join"))?;
    let mut whole = film_file::read(first)?;
    let mut joined: Vec<&Path> = vec![first];
    for path in rest {
        let part = film_file::read(path)?;
        whole.merge(&part).map_err(|error| explain(&error, &part, path, &joined))?;
        joined.push(path);
    }
    let gaps = whole.film.gaps();
    if !gaps.is_empty() {
        let told = format!("samples {gaps} are in none of the films, or not in all of their tiles");
        if !args.allow_gaps {
            return Err(Failure::new(format!("{told}; --allow-gaps joins them all the same")));
        }
        terminal::complain(&format!("warning: {told}"));
    }
    whole.provenance.command = command(&args.films, &args.output);
    let bytes = whole.encode();
    let held = pen.hold();
    write_atomically(&args.output, &bytes)?;
    drop(held);
    let mean = terminal::samples(whole.film.mean_samples());
    terminal::say(&format!(
        "{}: {} films, {mean} samples per pixel",
        args.output.display(),
        args.films.len()
    ));
    Ok(Outcome::Done)
}

fn command(films: &[PathBuf], output: &Path) -> String {
    let word = |path: &Path| path.to_string_lossy().into_owned();
    let films = films.iter().map(|film| word(film));
    let start = ["luch", "merge"].map(str::to_owned).into_iter();
    terminal::command_line(start.chain(films).chain(["-o".to_owned(), word(output)]))
}

/// The films that quarrel by name: for an overlap the one among those joined before that holds the same samples.
fn explain(error: &CheckpointError, part: &Checkpoint, path: &Path, joined: &[&Path]) -> Failure {
    let culprit = joined
        .iter()
        .find(|earlier| film_file::read(earlier).is_ok_and(|mut earlier| earlier.merge(part).is_err()));
    let other = culprit.unwrap_or(&joined[0]);
    Failure::new(format!("{} and {} cannot be joined: {error}", other.display(), path.display()))
}
