//! What instructs the reader: parameters, aliases, included files.

use super::read::Reading;
use crate::scene_file::{Span, advice, clip};
use crate::{Files, Problem};
use roxmltree::Node;
use std::path::PathBuf;

/// Longest text that parameters may make, and all such texts together, bytes.
const LONGEST_FILLED: usize = 1 << 16;
const MOST_FILLED: usize = 1 << 26;

/// Most files that are included, counted as often as they are.
const MOST_INCLUDES: usize = 256;

/// Includes inside one another.
const DEEPEST_INCLUDE: usize = 15;

impl Reading<'_> {
    /// The value of an attribute with its parameters put in.
    pub(super) fn attribute(&mut self, node: Node, name: &str) -> Option<String> {
        let attribute = node.attribute_node(name)?;
        let span = Span { source: self.source, bytes: attribute.range_value() };
        Some(self.filled(attribute.value(), &span))
    }

    /// An attribute that must be there.
    pub(super) fn need(&mut self, node: Node, name: &str) -> Option<String> {
        let value = self.attribute(node, name);
        if value.is_none() {
            let tag = node.tag_name().name();
            self.report.add(&self.span(node), format!("this `{tag}` lacks its attribute `{name}`"), None);
        }
        value
    }

    /// A text with each `$name` replaced by its parameter: the longest name that fits.
    fn filled(&mut self, text: &str, span: &Span) -> String {
        let mut filled = String::new();
        let mut rest = text;
        while let Some(at) = rest.find('$') {
            filled.push_str(&rest[..at]);
            let tail = &rest[at + 1..];
            let fits = |name: &&String| !name.is_empty() && tail.starts_with(name.as_str());
            match self.parameters.keys().filter(fits).max_by_key(|name| name.len()).cloned() {
                Some(name) => {
                    let value = &self.parameters[&name];
                    self.filled += value.len();
                    if filled.len() + value.len() > LONGEST_FILLED || self.filled > MOST_FILLED {
                        self.report.add(span, "parameters make too long a text of this", None);
                        return String::new();
                    }
                    filled.push_str(value);
                    rest = &tail[name.len()..];
                    self.used_parameters.insert(name);
                }
                None => {
                    let end = tail.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(tail.len());
                    let help =
                        advice(&tail[..end], self.parameters.keys().map(String::as_str), "parameters", "$");
                    let message = format!("the parameter \"${}\" has no value", clip(&tail[..end]));
                    self.report.add(span, message, Some(help));
                    rest = &tail[end..];
                }
            }
        }
        filled.push_str(rest);
        filled
    }

    pub(super) fn default(&mut self, node: Node) {
        let (Some(name), Some(value)) = (self.need(node, "name"), self.need(node, "value")) else { return };
        if name.is_empty() {
            self.report.add(&self.span(node), "this `default` has an empty name", None);
        }
        self.used_parameters.insert(name.clone());
        self.parameters.entry(name).or_insert(value);
    }

    pub(super) fn alias(&mut self, node: Node) {
        let (Some(id), Some(new)) = (self.need(node, "id"), self.need(node, "as")) else { return };
        let span = self.span(node);
        match self.document.ids.get(&id).copied() {
            Some(place) => self.name_plugin(&new, place, &span),
            None => {
                let help = advice(&id, self.document.ids.keys().map(String::as_str), "defined above", "\"");
                self.report.add(&span, format!("nothing above has the id \"{}\"", clip(&id)), Some(help));
            }
        }
    }

    pub(super) fn include(&mut self, node: Node, parent: usize) -> Result<(), Problem> {
        let Some(name) = self.need(node, "filename") else { return Ok(()) };
        let span = self.span(node);
        let beside_this = Files::beside(&self.open[self.open.len() - 1], &name);
        let candidates = [Files::beside(&self.main, &name), beside_this];
        let path = candidates.iter().find(|path| self.files.has(path)).unwrap_or(&candidates[0]).clone();
        let same = |open: &PathBuf| crate::scene_file::normal(open) == crate::scene_file::normal(&path);
        if self.open.iter().any(same) {
            return Err(self.report.problem(&span, "this file includes itself"));
        }
        self.includes += 1;
        if self.open.len() > DEEPEST_INCLUDE {
            return Err(self
                .report
                .problem(&span, format!("more than {DEEPEST_INCLUDE} files inside one another")));
        }
        if self.includes > MOST_INCLUDES {
            return Err(self.report.problem(&span, format!("more than {MOST_INCLUDES} files are included")));
        }
        let text = match self.text_of(&path) {
            Ok(text) => text,
            Err(problem) => {
                self.report.add(&span, format!("cannot include this file: {}", problem.message), None);
                return Ok(());
            }
        };
        self.open.push(path);
        let read = self.parse(text, Some(parent));
        self.open.pop();
        read
    }
}
