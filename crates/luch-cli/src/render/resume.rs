//! Going on with a film.

use crate::failure::Failure;
use crate::recipe::Recipe;
use crate::terminal;
use luch::render::{Checkpoint, Fingerprint};
use luch::scene::Scene;
use std::path::Path;

/// The command that continues this one.
pub(crate) fn command() -> String {
    let mut words: Vec<String> =
        std::env::args_os().map(|word| word.to_string_lossy().into_owned()).collect();
    insert_resume(&mut words);
    terminal::command_line(words)
}

/// After `--` there are no options, only files.
fn insert_resume(words: &mut Vec<String>) {
    let end = words.iter().position(|word| word == "--").unwrap_or(words.len());
    if !words[..end].iter().any(|word| word == "--resume" || word.starts_with("--resume=")) {
        words.insert(end, "--resume".to_owned());
    }
}

/// Passes films of this very picture; otherwise says why it is another.
pub(super) fn verify(
    path: &Path,
    film: &Checkpoint,
    now: &Fingerprint,
    recipe: &Recipe,
    scene: &Scene,
) -> Result<(), Failure> {
    if film.fingerprint == *now {
        return Ok(());
    }
    let stored = Recipe::from_json(&film.provenance.options)?;
    let mut as_before = scene.clone();
    let before = stored.apply(&mut as_before).map(|camera| Fingerprint::of(&as_before, &camera));
    let reason = if before.is_ok_and(|before| before == film.fingerprint) {
        let changes = recipe.differences(&stored).join(", ");
        format!("other options are asked for: {changes}; leave them out, or begin anew without --resume")
    } else {
        let version = &film.provenance.version;
        let mut reason = "the scene has changed since".to_owned();
        if version != env!("CARGO_PKG_VERSION") {
            reason += &format!(", or the program has (it was version {version})");
        }
        reason + "; begin anew without --resume"
    };
    Err(Failure::new(format!(
        "{}: cannot be continued: {reason} (fingerprints {} then, {now} now)",
        path.display(),
        film.fingerprint
    )))
}
