//! Texts, places in them, and what is wrong there.

use crate::{Place, Problem};
use std::ops::Range;
use std::path::{Path, PathBuf};

/// Most problems that are told of one scene.
const MOST_PROBLEMS: usize = 100;

/// The text of one file.
#[derive(Debug)]
pub(crate) struct Source {
    pub(crate) path: PathBuf,
    pub(crate) text: String,
}

/// Bytes of one of the texts.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Span {
    /// The place of the text in [`Report::sources`].
    pub(crate) source: usize,
    pub(crate) bytes: Range<usize>,
}

/// The texts of a scene and the problems found so far.
#[derive(Debug, Default)]
pub(crate) struct Report {
    pub(crate) sources: Vec<Source>,
    problems: Vec<Noted>,
    untold: usize,
}

/// A problem and its place in the order of the texts.
#[derive(Debug)]
struct Noted {
    source: usize,
    start: usize,
    problem: Problem,
}

impl Source {
    /// Line and column of a stretch of the text.
    fn place(&self, bytes: &Range<usize>) -> Place {
        let start = bytes.start.min(self.text.len());
        let before = &self.text[..start];
        let line_start = before.rfind('\n').map_or(0, |at| at + 1);
        let rest = &self.text[line_start..];
        let source = rest.split('\n').next().unwrap_or("").trim_end_matches('\r');
        let line_end = line_start + source.len();
        let end = bytes.end.clamp(start, line_end.max(start));
        Place::Text {
            line: before.matches('\n').count() + 1,
            column: self.text[line_start..start].chars().count() + 1,
            source: source.to_owned(),
            length: self.text[start..end].chars().count().max(1),
        }
    }
}

impl Report {
    /// Keeps a text that is read now, and says its place among all of them.
    pub(crate) fn add_source(&mut self, path: &Path, text: &str) -> usize {
        self.sources.push(Source { path: path.to_owned(), text: text.to_owned() });
        self.sources.len() - 1
    }

    /// Notes a problem at a place.
    pub(crate) fn add(&mut self, span: &Span, message: impl Into<String>, help: Option<String>) {
        if self.problems.len() == MOST_PROBLEMS {
            self.untold += 1;
            return;
        }
        let problem = Problem { help, ..self.problem(span, message) };
        self.problems.push(Noted { source: span.source, start: span.bytes.start, problem });
    }

    /// True if further problems are only counted.
    pub(crate) fn is_full(&self) -> bool {
        self.problems.len() == MOST_PROBLEMS
    }

    /// Notes a problem of another file, after that of the place that refers to it.
    pub(crate) fn add_other(&mut self, problem: Problem) {
        if self.problems.len() == MOST_PROBLEMS {
            self.untold += 1;
            return;
        }
        let (source, start) = self.problems.last().map_or((0, 0), |noted| (noted.source, noted.start));
        self.problems.push(Noted { source, start, problem });
    }

    /// A problem at a place, not yet noted.
    pub(crate) fn problem(&self, span: &Span, message: impl Into<String>) -> Problem {
        let source = &self.sources[span.source];
        Problem::new(&source.path, message).at(source.place(&span.bytes))
    }

    /// The line of a place in words, with the file if it is another than that of `from`.
    pub(crate) fn line(&self, span: &Span, from: &Span) -> String {
        let source = &self.sources[span.source];
        let line = source.text[..span.bytes.start].matches('\n').count() + 1;
        if span.source == from.source {
            format!("on line {line}")
        } else {
            format!("at {}:{line}", source.path.display())
        }
    }

    /// How many problems are noted.
    pub(crate) fn count(&self) -> usize {
        self.problems.len()
    }

    /// The problems in the order of the texts, those that found no room as a number.
    pub(crate) fn into_problems(mut self) -> Vec<Problem> {
        self.problems.sort_by_key(|noted| (noted.source, noted.start));
        let mut problems: Vec<Problem> = self.problems.into_iter().map(|noted| noted.problem).collect();
        if self.untold > 0 {
            let file = problems[0].file.clone();
            problems.push(Problem::new(&file, format!("and {} more problems", self.untold)));
        }
        problems
    }
}

/// Advice about a word that is none of those accepted: the nearest, if one is near, and all of them.
pub(crate) fn advice<'a>(
    word: &str,
    accepted: impl IntoIterator<Item = &'a str>,
    kind: &str,
    quote: &str,
) -> String {
    /// More are not listed.
    const MOST_LISTED: usize = 24;
    let mut all: Vec<&str> = accepted.into_iter().collect();
    all.sort_unstable();
    all.dedup();
    if all.is_empty() {
        return format!("{kind}: none");
    }
    let near =
        nearest(word, &all).map(|other| format!("did you mean {quote}{other}{quote}? ")).unwrap_or_default();
    let more = if all.len() > MOST_LISTED {
        format!(", and {} more", all.len() - MOST_LISTED)
    } else {
        String::new()
    };
    let listed: Vec<String> =
        all.iter().take(MOST_LISTED).map(|other| format!("{quote}{}{quote}", clip(other))).collect();
    format!("{near}{kind}: {}{more}", listed.join(", "))
}

/// The word of `all` that `word` may be a slip for.
fn nearest<'a>(word: &str, all: &[&'a str]) -> Option<&'a str> {
    /// Longer words are not compared: the work grows with the product of the lengths.
    const LONGEST: usize = 64;
    // A third of the word may be wrong; swapped letters count as one slip.
    let length = word.chars().count();
    let most = (length.max(3) / 3).min(4);
    let comparable =
        |other: &&&str| length <= LONGEST && other.chars().take(LONGEST + 1).count().abs_diff(length) <= most;
    let word = word.to_lowercase();
    let near = all
        .iter()
        .filter(comparable)
        .map(|&other| (strsim::damerau_levenshtein(&word, &other.to_lowercase()), other));
    near.filter(|(distance, _)| *distance <= most).min().map(|(_, other)| other)
}

/// The beginning of a text, for messages.
pub(crate) fn clip(text: &str) -> String {
    const LONGEST: usize = 40;
    let mut short: String =
        text.chars().take(LONGEST).map(|c| if c.is_control() { ' ' } else { c }).collect();
    if text.chars().nth(LONGEST).is_some() {
        short.push('…');
    }
    short
}
