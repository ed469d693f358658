//! Where figures and numbers go.

use crate::args::LabOutputArgs;
use crate::failure::{Failure, Outcome};
use crate::outputs::probe;
use crate::terminal::{command_line, complain, say};
use luch::formats::write_atomically;
use luch_lab::figure::{Depth, PngOptions};
use luch_lab::report::{Report, Section};
use std::io::IsTerminal;
use std::path::{Path, PathBuf};

/// Columns of figures in the terminal.
const COLUMNS: usize = 80;

/// A page that says how it was made.
pub(super) fn report(title: impl Into<String>) -> Report {
    let words = std::env::args().skip(1);
    Report::new(title).with_command(command_line(std::iter::once("luch".to_owned()).chain(words)))
}

/// Refuses files that no page can be written to, before the work is done.
pub(super) fn check(args: &LabOutputArgs) -> Result<(), Failure> {
    args.output.iter().try_for_each(|path| {
        format_of(path)?;
        probe(path)
    })
}

/// The extension of a file, if it is one of ours.
fn format_of(path: &Path) -> Result<String, Failure> {
    let extension = path.extension().and_then(|e| e.to_str()).unwrap_or("").to_ascii_lowercase();
    if ["svg", "png", "csv", "json", "html"].contains(&extension.as_str()) {
        return Ok(extension);
    }
    Err(Failure::usage(format!(
        "{}: cannot tell the format from the extension; accepted are .svg, .png, .csv, .json, .html",
        path.display()
    )))
}

/// Prints a page, or writes it to the files that were asked for.
pub(super) fn give(report: &Report, args: &LabOutputArgs) -> Result<Outcome, Failure> {
    if args.json {
        say(&report.to_json());
    } else {
        let depth = match std::io::stdout().is_terminal() && std::env::var_os("NO_COLOR").is_none() {
            true => Depth::TrueColor,
            false => Depth::Letters,
        };
        say(report.to_terminal(COLUMNS, depth).trim_end());
    }
    for path in &args.output {
        for file in write(report, path, args)? {
            complain(&format!("wrote {}", file.display()));
        }
    }
    Ok(Outcome::Done)
}

/// The files of a page: one, or one for each figure.
fn write(report: &Report, path: &Path, args: &LabOutputArgs) -> Result<Vec<PathBuf>, Failure> {
    let extension = format_of(path)?;
    let whole = match extension.as_str() {
        "html" => Some(report.to_html()),
        "json" => Some(report.to_json()),
        _ => None,
    };
    if let Some(text) = whole {
        write_atomically(path, text.as_bytes())?;
        return Ok(vec![path.to_owned()]);
    }
    let options = PngOptions { theme: args.theme, ..PngOptions::default() };
    let figures: Vec<Vec<u8>> = report
        .sections
        .iter()
        .filter_map(|section| match (section, extension.as_str()) {
            (Section::Figure(figure), "svg") => Some(figure.to_svg().into_bytes()),
            (Section::Figure(figure), "png") => Some(figure.to_png(options)),
            (Section::Figure(figure), _) => Some(figure.to_csv().into_bytes()),
            (Section::Sheet(sheet), "svg") => Some(sheet.to_svg().into_bytes()),
            (Section::Sheet(sheet), "png") => Some(sheet.to_png(options)),
            (Section::Sheet(sheet), _) => Some(sheet.to_csv().into_bytes()),
            _ => None,
        })
        .collect();
    let mut files = Vec::new();
    for (place, bytes) in figures.iter().enumerate() {
        let file = if place == 0 { path.to_owned() } else { numbered(path, place + 1) };
        write_atomically(&file, bytes)?;
        files.push(file);
    }
    Ok(files)
}

/// `figure-2.svg` for `figure.svg`.
fn numbered(path: &Path, number: usize) -> PathBuf {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let extension = path.extension().unwrap_or_default().to_string_lossy();
    path.with_file_name(format!("{stem}-{number}.{extension}"))
}
