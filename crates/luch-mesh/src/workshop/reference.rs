//! All verbs as a text for people.

use super::verb::{Action, Fallback};
use super::{Keeps, Kind, Parameter, Verb, verbs};
use std::fmt::Write;

/// A reference of all verbs in Markdown: what each does, what it takes, what it keeps, an example.
pub fn reference() -> String {
    let mut text = String::new();
    for (title, making) in [("Verbs that make meshes", true), ("Verbs that change meshes", false)] {
        // Writing to a string cannot fail.
        let _ = write!(text, "## {title}\n\n");
        let group = verbs().filter(|verb| matches!(verb.action, Action::Make { .. }) == making);
        for verb in group {
            describe(verb, &mut text);
        }
    }
    text
}

fn describe(verb: &Verb, text: &mut String) {
    let _ = write!(text, "### {}\n\n{}.", verb.name, verb.summary);
    if let Action::Change { keeps, .. } = verb.action {
        let kept = kept(keeps);
        if !kept.is_empty() {
            let _ = write!(text, " Keeps {}.", kept.join(", "));
        }
    }
    text.push_str("\n\n");
    if !verb.parameters.is_empty() {
        text.push_str("| parameter | what | default |\n|---|---|---|\n");
        for parameter in verb.parameters {
            row(parameter, text);
        }
        text.push('\n');
    }
    let space = if verb.example.is_empty() { "" } else { " " };
    let _ = write!(text, "```sh\nluch mesh {}{space}{}\n```\n\n", verb.name, verb.example);
}

fn row(parameter: &Parameter, text: &mut String) {
    let words = match parameter.kind {
        Kind::Choice(words) => format!(": {}", words.join(", ")),
        Kind::Number { .. } | Kind::Count { .. } | Kind::Angle => format!("; {}", parameter.kind.accepted()),
        _ => String::new(),
    };
    let default = match parameter.default {
        Fallback::Value(value) => format!("`{value}`"),
        Fallback::Nothing => "none".into(),
        Fallback::Required => "must be given".into(),
    };
    let line = format!("| `{}` | {}{words} | {default} |", parameter.name, parameter.summary);
    // A bar would end the cell.
    let _ = writeln!(text, "{}", escaped(&line));
}

/// Bars within a cell; those at its ends stay.
fn escaped(line: &str) -> String {
    let cells: Vec<&str> = line.trim_matches('|').split(" | ").collect();
    let cells: Vec<String> = cells.iter().map(|cell| cell.replace('|', "\\|")).collect();
    format!("|{}|", cells.join(" | "))
}

fn kept(keeps: Keeps) -> Vec<&'static str> {
    let all = [
        (keeps.closed, "closedness"),
        (keeps.uvs, "uvs"),
        (keeps.creases, "creases"),
        (keeps.faces, "the number of faces"),
        (keeps.positions, "the number of positions"),
    ];
    all.into_iter().filter_map(|(kept, name)| kept.then_some(name)).collect()
}
