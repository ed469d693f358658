//! From text to [`SceneFile`]: the top level, and the files that are included.

use super::fields::Fields;
use super::source::{Report, Source, Span, clip};
use super::{SceneFile, Spanned};
use crate::kdl::{self, Node};
use crate::{Files, LoadError, Problem};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// The version of the format that is read.
const VERSION: u64 = 1;

/// Largest text of one scene with all its included files, in bytes.
const MOST_TEXT: usize = 64 << 20;

/// Most files inside one another.
const DEEPEST_INCLUDE: usize = 16;

/// What may stand at the top level.
const TOP_LEVEL: [&str; 14] = [
    "settings",
    "camera",
    "texture",
    "material",
    "mesh",
    "object",
    "group",
    "point-light",
    "spot-light",
    "sun",
    "environment",
    "import",
    "include",
    "luch",
];

/// Reads texts and collects what they say and what is wrong with them.
pub(super) struct Decoder<'a> {
    files: &'a Files,
    pub(super) scene: SceneFile,
    pub(super) report: Report,
    /// Every file that has been included.
    included: BTreeSet<PathBuf>,
    /// The files that are being read, one inside the other.
    open: Vec<PathBuf>,
    text_size: usize,
    /// Objects so far, each copy counted.
    pub(super) copies: usize,
}

/// Reads the scene file at `path` and those it includes.
///
/// # Errors
/// All that is wrong in any of them.
pub(crate) fn read(path: &Path, files: &Files) -> Result<(SceneFile, Report), LoadError> {
    let mut decoder = Decoder {
        files,
        scene: SceneFile::default(),
        report: Report::default(),
        included: BTreeSet::new(),
        open: Vec::new(),
        text_size: 0,
        copies: 0,
    };
    decoder.file(path, None);
    if decoder.report.count() == 0 {
        Ok((decoder.scene, decoder.report))
    } else {
        Err(LoadError { problems: decoder.report.into_problems() })
    }
}

impl Decoder<'_> {
    /// Notes a problem.
    pub(super) fn problem(&mut self, span: &Span, message: impl Into<String>, help: Option<String>) {
        self.report.add(span, message, help);
    }

    /// The text at a place, shortened, in backticks.
    pub(super) fn quote(&self, span: &Span) -> String {
        let text = &self.report.sources[span.source].text;
        format!("`{}`", clip(&text[span.bytes.clone()]))
    }

    /// Reads one file; `included_at` is where it is asked for.
    fn file(&mut self, path: &Path, included_at: Option<&Span>) {
        let Some(text) = self.read_text(path, included_at) else { return };
        let source = self.report.sources.len();
        self.report.sources.push(Source { path: path.to_owned(), text: text.clone() });
        let nodes = match kdl::parse(&text) {
            Ok(nodes) => nodes,
            Err(errors) => {
                for error in errors {
                    self.problem(
                        &Span { source, bytes: error.span },
                        error.message,
                        error.help.map(str::to_owned),
                    );
                }
                return;
            }
        };
        self.open.push(path.to_owned());
        self.nodes(&nodes, source, included_at.is_none());
        self.open.pop();
    }

    /// The text of a file.
    fn read_text(&mut self, path: &Path, included_at: Option<&Span>) -> Option<String> {
        let read = self.files.read(path).and_then(|bytes| {
            self.text_size = self.text_size.saturating_add(bytes.len());
            if self.text_size > MOST_TEXT {
                return Err(Problem::new(
                    path,
                    format!("the scene files have more than {MOST_TEXT} bytes together"),
                ));
            }
            String::from_utf8(bytes).map_err(|error| {
                let at = error.utf8_error().valid_up_to() as u64;
                Problem::new(path, "is no UTF-8 text").at(crate::Place::Byte(at))
            })
        });
        match (read, included_at) {
            (Ok(text), _) => return Some(text),
            (Err(problem), None) => self.report.add_other(problem),
            (Err(problem), Some(span)) => {
                self.problem(span, format!("cannot include {}: {}", path.display(), problem.message), None);
            }
        }
        None
    }

    fn nodes(&mut self, nodes: &[Node], source: usize, is_main: bool) {
        let is_versioned = nodes.first().is_some_and(|node| node.name.text == "luch");
        if is_main && !is_versioned {
            let bytes = nodes.first().map_or(0..0, |node| node.name.span.clone());
            let help =
                format!("write `luch {VERSION}` before everything else: it is the version of the format");
            self.problem(&Span { source, bytes }, "the version of the format is missing", Some(help));
        }
        for (place, node) in nodes.iter().enumerate() {
            self.top_level(Fields::of(node, source), &node.name.text, place);
        }
    }

    fn top_level(&mut self, fields: Fields, name: &str, place: usize) {
        match name {
            "luch" => self.version(fields, place),
            "settings" => self.settings(fields),
            "camera" => self.camera(fields),
            "texture" => self.texture(fields),
            "material" => self.named_material(fields),
            "mesh" => self.named_mesh(fields),
            "environment" => self.environment(fields),
            "include" => self.include(fields),
            "object" | "group" | "point-light" | "spot-light" | "sun" | "import" => {
                self.member(fields, name, &glam::Affine3A::IDENTITY);
            }
            _ => {
                let help = super::source::advice(name, TOP_LEVEL, "accepted", "`");
                self.problem(&fields.span, format!("unknown node `{}`", clip(name)), Some(help));
            }
        }
    }

    /// `luch 1`.
    fn version(&mut self, mut fields: Fields, place: usize) {
        if place > 0 {
            self.problem(&fields.span, "`luch` stands before everything else", None);
        }
        let argument = fields.argument();
        match &argument {
            None => {
                let message = format!("`luch` lacks the version of the format, expected {VERSION}");
                self.problem(&fields.span, message, None);
            }
            Some(argument) => {
                self.whole("the version of the format", argument, VERSION, VERSION);
            }
        }
        fields.finish(self, "option");
    }

    /// `include "materials.kdl"`.
    fn include(&mut self, mut fields: Fields) {
        let name = fields.argument();
        if name.is_none() {
            self.problem(&fields.span, "`include` lacks the name of a file", None);
        }
        let name = name.and_then(|argument| self.text("`include`", &argument));
        fields.finish(self, "option");
        let Some(Spanned { value, span }) = name else { return };
        let path = normal(&Files::beside(&self.report.sources[span.source].path, &value));
        if let Some(first) = self.open.iter().position(|open| normal(open) == path) {
            let cycle: Vec<String> =
                self.open[first..].iter().map(|path| path.display().to_string()).collect();
            let message = format!("this file includes itself: {} → {}", cycle.join(" → "), path.display());
            self.problem(&span, message, None);
        } else if self.open.len() == DEEPEST_INCLUDE {
            self.problem(&span, format!("more than {DEEPEST_INCLUDE} files inside one another"), None);
        } else if self.included.insert(path.clone()) {
            self.file(&path, Some(&span));
        }
    }

    /// The name that a definition must have; a problem if it has none.
    pub(super) fn required_name(&mut self, fields: &mut Fields) -> Option<Spanned<String>> {
        let name = fields.text_argument();
        if name.as_ref().is_none_or(|name| name.value.is_empty()) {
            let message = format!("{} lacks its name", fields.owner);
            let help = format!("write {} \"name\" {{ … }}", fields.owner.trim_matches('`'));
            self.problem(&fields.span, message, Some(help));
            return None;
        }
        name
    }

    /// Notes that a field of which there can be one only is there again.
    pub(super) fn twice(&mut self, field: &Span, first: &Span, what: &str) {
        let help = format!("first {}", self.report.line(first, field));
        self.problem(field, format!("{what} is given twice"), Some(help));
    }
}

/// A path without `.` and with `x/..` taken out, so that one file has one name.
pub(crate) fn normal(path: &Path) -> PathBuf {
    use std::path::Component;
    let mut plain = PathBuf::new();
    for part in path.components() {
        match part {
            Component::CurDir => {}
            Component::ParentDir if matches!(plain.components().next_back(), Some(Component::Normal(_))) => {
                plain.pop();
            }
            _ => plain.push(part),
        }
    }
    plain
}
