//! From XML to the tree of plugins: parameters are put in, included files spliced, old names renewed.

use super::tree::{Document, Plugin, Property, Tag, Value};
use crate::scene_file::{Report, Span, advice, clip};
use crate::{Files, Place, Problem};
use roxmltree::{Node, ParsingOptions};
use std::cell::{Cell, RefCell};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// Most elements, comments and texts of all files together.
const MOST_NODES: u32 = 1 << 22;

/// Most bytes of a text, and of all texts together.
const MOST_TEXT: usize = 1 << 28;

/// Elements inside one another.
const DEEPEST: usize = 64;

/// Elements that describe a value.
const VALUES: [&str; 12] = [
    "integer",
    "float",
    "boolean",
    "string",
    "rgb",
    "srgb",
    "spectrum",
    "blackbody",
    "point",
    "vector",
    "transform",
    "ref",
];

/// Elements that instruct the reader.
const DIRECTIVES: [&str; 4] = ["default", "include", "alias", "path"];

/// A document on its way.
pub(super) struct Reading<'a> {
    pub(super) files: &'a Files,
    pub(super) main: PathBuf,
    pub(super) report: Report,
    pub(super) document: Document,
    /// Values that `$name` stands for.
    pub(super) parameters: BTreeMap<String, String>,
    /// Where ids were first given.
    id_spans: BTreeMap<String, Span>,
    pub(super) used_parameters: BTreeSet<String>,
    /// The source being read.
    pub(super) source: usize,
    /// Names of the source are those of before version 2.
    is_old: bool,
    /// Files that include one another now.
    pub(super) open: Vec<PathBuf>,
    pub(super) includes: usize,
    nodes: u32,
    /// Bytes of all texts read, and of all that parameters were replaced by.
    text: usize,
    pub(super) filled: usize,
}

impl<'a> Reading<'a> {
    /// Reads the file at `path`; `parameters` come before the defaults that the file has for them.
    pub(super) fn read(
        path: &Path,
        files: &'a Files,
        parameters: &BTreeMap<String, String>,
    ) -> Result<Self, Problem> {
        let mut reading = Self {
            files,
            main: path.to_owned(),
            report: Report::default(),
            document: Document { version: 3, ..Document::default() },
            parameters: parameters.clone(),
            id_spans: BTreeMap::new(),
            used_parameters: BTreeSet::new(),
            source: 0,
            is_old: false,
            open: vec![path.to_owned()],
            includes: 0,
            nodes: 0,
            text: 0,
            filled: 0,
        };
        let text = reading.text_of(path)?;
        reading.parse(text, None)?;
        reading.check_references();
        if let Some(name) = parameters.keys().find(|name| !reading.used_parameters.contains(*name)) {
            let known: Vec<&str> =
                reading.parameters.keys().map(String::as_str).filter(|k| k != name).collect();
            let help = advice(name, known, "parameters", "");
            return Err(Problem::new(path, format!("has no parameter \"{}\"", clip(name))).help(help));
        }
        Ok(reading)
    }

    pub(super) fn text_of(&mut self, path: &Path) -> Result<String, Problem> {
        let bytes = self.files.read(path)?;
        self.text += bytes.len();
        if self.text > MOST_TEXT {
            return Err(Problem::new(
                path,
                format!("with this file the scene has over {MOST_TEXT} bytes of XML"),
            ));
        }
        let mut text = String::from_utf8(bytes).map_err(|error| {
            Problem::new(path, "is not UTF-8").at(Place::Byte(error.utf8_error().valid_up_to() as u64))
        })?;
        if text.starts_with('\u{feff}') {
            text.drain(..'\u{feff}'.len_utf8());
        }
        Ok(text)
    }

    /// Reads one text as the scene, or into the plugin `parent`.
    pub(super) fn parse(&mut self, text: String, parent: Option<usize>) -> Result<(), Problem> {
        let path = self.open.last().cloned().unwrap_or_default();
        let options = ParsingOptions { nodes_limit: MOST_NODES - self.nodes, ..ParsingOptions::default() };
        let before = (self.source, self.is_old);
        self.source = self.report.add_source(&path, &text);
        let xml = roxmltree::Document::parse_with_options(&text, options)
            .map_err(|error| syntax_problem(&path, &text, &error))?;
        self.nodes = (self.nodes + xml.root().descendants().count() as u32).min(MOST_NODES - 1);
        let root = xml.root_element();
        let version =
            root.attribute("version").and_then(|version| version.split('.').next()?.trim().parse().ok());
        let place = match parent {
            Some(parent) => parent,
            None => {
                if root.tag_name().name() != "scene" {
                    let shown = clip(root.tag_name().name());
                    let message = format!("the document is a `{shown}`, expected a `scene` of Mitsuba");
                    return Err(self.report.problem(&self.span(root), message));
                }
                self.add_plugin(Tag::Scene, "scene", root)
            }
        };
        self.is_old = version.is_some_and(|version: u32| version < 2);
        if parent.is_none() {
            self.document.version = version.unwrap_or(3);
        }
        if root.tag_name().name() == "scene" {
            self.children(root, place, 0)?;
        } else {
            // Mitsuba includes single plugins as well.
            self.child(root, place, 0)?;
        }
        (self.source, self.is_old) = before;
        Ok(())
    }

    /// The beginning of an element.
    pub(super) fn span(&self, node: Node) -> Span {
        let start = node.range().start;
        Span { source: self.source, bytes: start..start + 1 + node.tag_name().name().len() }
    }

    fn add_plugin(&mut self, tag: Tag, kind: &str, node: Node) -> usize {
        let plugin = Plugin {
            tag,
            kind: kind.to_owned(),
            id: None,
            span: self.span(node),
            properties: Vec::new(),
            asked: RefCell::default(),
        };
        self.document.plugins.push(plugin);
        self.document.plugins.len() - 1
    }

    fn children(&mut self, node: Node, plugin: usize, depth: usize) -> Result<(), Problem> {
        for child in node.children() {
            if child.is_element() {
                self.child(child, plugin, depth)?;
            } else if child.is_text() && child.text().is_some_and(|text| !text.trim().is_empty()) {
                let text = child.text().unwrap_or("").trim();
                let span = Span { source: self.source, bytes: child.range() };
                let message = format!("the text \"{}\" has no meaning here", clip(text));
                self.report.add(&span, message, None);
            }
        }
        Ok(())
    }

    /// One element inside the plugin `parent`.
    fn child(&mut self, node: Node, parent: usize, depth: usize) -> Result<(), Problem> {
        let span = self.span(node);
        if depth > DEEPEST {
            return Err(self
                .report
                .problem(&span, format!("more than {DEEPEST} elements inside one another")));
        }
        let tag = node.tag_name().name();
        let is_plugin_spectrum = tag == "spectrum" && node.attribute("type").is_some();
        let plugin_tag = Tag::NAMES.iter().find(|(name, _)| *name == tag).map(|&(_, tag)| tag);
        let plugin_tag = if is_plugin_spectrum { Some(Tag::Texture) } else { plugin_tag };
        match (tag, plugin_tag) {
            ("default", _) => self.default(node),
            ("include", _) => return self.include(node, parent),
            ("alias", _) => self.alias(node),
            ("path", _) => {
                if let Some(folder) = self.need(node, "value") {
                    self.document.folders.push(folder);
                }
            }
            (_, Some(Tag::Scene)) => self.report.add(&span, "a `scene` cannot stand inside a scene", None),
            (_, Some(tag)) => return self.plugin(node, tag, parent, depth),
            ("ref", _) => {
                if let Some(id) = self.need(node, "id") {
                    let name = self.name(node);
                    self.add_property(parent, name, span, Value::Reference(id));
                }
            }
            _ if VALUES.contains(&tag) => {
                let before = self.report.count();
                let value = self.value(node, tag);
                let name = self.name(node);
                if let Some(value) = value {
                    if name.is_empty() {
                        self.report.add(&span, format!("this `{tag}` lacks its attribute `name`"), None);
                    }
                    self.add_property(parent, name, span, value);
                } else if self.report.count() == before {
                    self.report.add(&span, format!("this `{tag}` lacks its attribute `value`"), None);
                }
            }
            _ => {
                let known = Tag::NAMES.iter().map(|(name, _)| *name).chain(VALUES).chain(DIRECTIVES);
                let help = advice(tag, known, "elements", "`");
                self.report.add(&span, format!("unknown element `{}`", clip(tag)), Some(help));
            }
        }
        Ok(())
    }

    fn plugin(&mut self, node: Node, tag: Tag, parent: usize, depth: usize) -> Result<(), Problem> {
        let kind = match self.attribute(node, "type") {
            Some(kind) => kind,
            None => {
                let shown = node.tag_name().name();
                self.report.add(&self.span(node), format!("this `{shown}` lacks its attribute `type`"), None);
                String::new()
            }
        };
        let name = self.name(node);
        let place = self.add_plugin(tag, &kind, node);
        if let Some(id) = self.attribute(node, "id").filter(|id| !id.is_empty()) {
            self.name_plugin(&id, place, &self.span(node));
            self.document.plugins[place].id = Some(id);
        }
        self.add_property(parent, name, self.span(node), Value::Plugin(place));
        self.children(node, place, depth + 1)
    }

    pub(super) fn name_plugin(&mut self, id: &str, place: usize, span: &Span) {
        if let Some(first) = self.id_spans.get(id) {
            let help = format!("first {}", self.report.line(first, span));
            self.report.add(span, format!("the id \"{}\" is given twice", clip(id)), Some(help));
            return;
        }
        self.id_spans.insert(id.to_owned(), span.clone());
        self.document.ids.insert(id.to_owned(), place);
    }

    fn add_property(&mut self, parent: usize, name: String, span: Span, value: Value) {
        let used = Cell::new(false);
        self.document.plugins[parent].properties.push(Property { name, span, value, used });
    }

    /// The name of a property, as today's version writes it.
    fn name(&mut self, node: Node) -> String {
        let name = self.attribute(node, "name").unwrap_or_default();
        if self.is_old { renewed(&name) } else { name }
    }

    /// Every reference must refer to something.
    fn check_references(&mut self) {
        for plugin in &self.document.plugins {
            for property in &plugin.properties {
                if let Value::Reference(id) = &property.value
                    && !self.document.ids.contains_key(id)
                {
                    if self.report.is_full() {
                        return;
                    }
                    let help = advice(id, self.document.ids.keys().map(String::as_str), "defined", "\"");
                    self.report.add(
                        &property.span,
                        format!("nothing has the id \"{}\"", clip(id)),
                        Some(help),
                    );
                }
            }
        }
    }
}

/// A name in camel case as versions from 2 on write it: `intIOR` is `int_ior`.
fn renewed(name: &str) -> String {
    let mut new = String::with_capacity(name.len() + 4);
    let mut after_lower = false;
    let mut in_capitals = false;
    for c in name.chars() {
        if c.is_ascii_uppercase() && after_lower {
            new.push('_');
            in_capitals = true;
        } else if !c.is_ascii_uppercase() {
            in_capitals = false;
        }
        after_lower = c.is_ascii_lowercase();
        new.push(if in_capitals { c.to_ascii_lowercase() } else { c });
    }
    new
}

/// What the XML parser says, with its place.
fn syntax_problem(path: &Path, text: &str, error: &roxmltree::Error) -> Problem {
    let position = error.pos();
    let message = error.to_string();
    let message = message.rsplit_once(" at ").map_or(message.as_str(), |(message, _)| message);
    let line = position.row.max(1) as usize;
    let source = text.split('\n').nth(line - 1).unwrap_or("").trim_end_matches('\r').to_owned();
    let place = Place::Text { line, column: position.col.max(1) as usize, source, length: 1 };
    Problem::new(path, format!("is no well-formed XML: {message}")).at(place)
}

#[cfg(test)]
mod tests {
    use super::renewed;

    #[test]
    fn old_names_are_renewed() {
        for (old, new) in [
            ("intIOR", "int_ior"),
            ("toWorld", "to_world"),
            ("diffuseReflectance", "diffuse_reflectance"),
            ("alphaU", "alpha_u"),
            ("maxDepth", "max_depth"),
            ("fov", "fov"),
            ("BSDF", "BSDF"),
            ("flipTexCoords", "flip_tex_coords"),
        ] {
            assert_eq!(renewed(old), new);
        }
    }
}
