//! A verb of the workshop as a subcommand.

use super::{MeshOutputArgs, StepArgs};
use clap::error::ErrorKind;
use clap::parser::ValueSource;
use clap::{Arg, ArgMatches, Args, Command, Error, FromArgMatches};
use luch::mesh::workshop::{Action, Fallback, Kind, Parameter, Unread, Verb, find};
use std::path::PathBuf;

/// The mesh that is changed.
const INPUT: &str = "INPUT";

/// The subcommand of a verb.
pub(super) fn command(verb: &'static Verb) -> Command {
    let mut command = MeshOutputArgs::augment_args(Command::new(verb.name).about(verb.summary));
    let changes = matches!(verb.action, Action::Change { .. });
    if changes {
        let input = Arg::new(INPUT).value_name("FILE").value_parser(clap::value_parser!(PathBuf));
        command = command.arg(input.help("The mesh; standard input if there is none"));
    }
    for (place, parameter) in verb.parameters.iter().enumerate() {
        // What must be said first needs no name, unless the mesh stands there.
        let is_positional = place == 0 && !changes && parameter.default == Fallback::Required;
        command = command.arg(argument(parameter, is_positional));
    }
    let input = if changes { " in.obj" } else { "" };
    let example = if verb.example.is_empty() { String::new() } else { format!(" {}", verb.example) };
    command.after_help(format!("Example:\n  luch mesh {}{input}{example} -o out.obj", verb.name))
}

fn argument(parameter: &'static Parameter, is_positional: bool) -> Arg {
    let kind = parameter.kind;
    let note = match parameter.default {
        Fallback::Value(text) if kind != Kind::Flag => format!(" [default: {text}]"),
        Fallback::Value(_) | Fallback::Nothing => String::new(),
        Fallback::Required => " [required]".into(),
    };
    let words = match kind {
        Kind::Choice(words) => format!(": {}", words.join(", ")),
        _ => String::new(),
    };
    // Files are read later: here they only have names.
    let read = move |text: &str| kind.read(text, &mut Unread).map(|_| text.to_owned());
    let argument = Arg::new(parameter.name)
        .help(format!("{}{words}{note}", parameter.summary))
        .value_name(placeholder(kind))
        .value_parser(read)
        .allow_hyphen_values(true)
        .required(parameter.default == Fallback::Required);
    match (is_positional, kind) {
        (true, _) => argument.value_name(parameter.name),
        // A word after a flag would be taken for its value.
        (false, Kind::Flag) => {
            argument.long(parameter.name).num_args(0..=1).require_equals(true).default_missing_value("true")
        }
        (false, _) => argument.long(parameter.name),
    }
}

fn placeholder(kind: Kind) -> &'static str {
    match kind {
        Kind::Number { .. } => "NUMBER",
        Kind::Count { .. } => "N",
        Kind::Angle => "ANGLE",
        Kind::Vector => "X,Y,Z",
        Kind::Size => "SIZE",
        Kind::Numbers => "NUMBERS",
        Kind::Flag => "YES",
        Kind::Choice(_) => "WORD",
        Kind::Pixels => "PIXELS",
        Kind::Text => "TEXT",
        Kind::File | Kind::Mesh => "FILE",
    }
}

/// Reads what was given.
pub(super) fn read(name: &str, matches: &ArgMatches) -> Result<StepArgs, Error> {
    let verb = find(name).map_err(|error| Error::raw(ErrorKind::InvalidSubcommand, error))?;
    let mut given = Vec::new();
    for parameter in verb.parameters {
        if matches.value_source(parameter.name) == Some(ValueSource::CommandLine)
            && let Some(text) = matches.get_one::<String>(parameter.name)
        {
            given.push((parameter.name.to_owned(), text.clone()));
        }
    }
    let input = match verb.action {
        Action::Change { .. } => matches.get_one::<PathBuf>(INPUT).cloned(),
        Action::Make { .. } => None,
    };
    Ok(StepArgs { verb, given, input, output: MeshOutputArgs::from_arg_matches(matches)? })
}
