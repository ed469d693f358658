//! `luch mesh verbs`: what there is, a line each.

use crate::args::VerbsArgs;
use crate::failure::{Failure, Outcome};
use crate::terminal::say;
use luch::mesh::workshop::{Action, reference, verbs};

pub(super) fn run(args: &VerbsArgs) -> Result<Outcome, Failure> {
    if args.markdown {
        say(reference().trim_end());
        return Ok(Outcome::Done);
    }
    let width = verbs().map(|verb| verb.name.len()).max().unwrap_or(0);
    let mut was_making = None;
    for verb in verbs() {
        let makes = matches!(verb.action, Action::Make { .. });
        if was_making != Some(makes) {
            say(if makes { "Makes a mesh:" } else { "Changes a mesh:" });
            was_making = Some(makes);
        }
        say(&format!("  {:width$}  {}", verb.name, verb.summary));
    }
    Ok(Outcome::Done)
}
