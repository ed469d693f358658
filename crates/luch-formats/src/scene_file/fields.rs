//! What a node says, by name. `key=value` after a node and a node `key value` in its block mean the same.

use super::source::{Span, advice, clip};
use super::{Spanned, decoder::Decoder};
use crate::kdl::{Entry, Node, Value};

/// What one node says.
pub(super) struct Fields<'a> {
    /// What the node is called in messages, in backticks.
    pub(super) owner: String,
    /// The name of the node.
    pub(super) span: Span,
    /// Arguments that have not been taken yet.
    arguments: std::collections::VecDeque<Argument<'a>>,
    fields: Vec<Option<Field<'a>>>,
    /// All names that were asked for: what is accepted.
    asked: Vec<&'static str>,
}

/// A value with its place.
#[derive(Clone, Debug)]
pub(super) struct Argument<'a> {
    pub(super) value: &'a Value,
    pub(super) span: Span,
}

/// One named thing that a node says.
pub(super) struct Field<'a> {
    pub(super) name: &'a str,
    pub(super) span: Span,
    content: Content<'a>,
}

enum Content<'a> {
    Property(Argument<'a>),
    Child(&'a Node),
}

impl<'a> Field<'a> {
    /// The node, unless it is a property.
    pub(super) fn node(&self) -> Option<&'a Node> {
        match self.content {
            Content::Property(_) => None,
            Content::Child(node) => Some(node),
        }
    }

    /// What this field says in turn; a property has one argument and nothing else.
    pub(super) fn fields(self) -> Fields<'a> {
        match self.content {
            Content::Child(node) => Fields::of(node, self.span.source),
            Content::Property(argument) => Fields {
                owner: format!("`{}`", self.name),
                span: self.span,
                arguments: [argument].into(),
                fields: Vec::new(),
                asked: Vec::new(),
            },
        }
    }
}

impl<'a> Fields<'a> {
    /// What `node` of the text `source` says.
    pub(super) fn of(node: &'a Node, source: usize) -> Self {
        let span = |bytes: &std::ops::Range<usize>| Span { source, bytes: bytes.clone() };
        let argument = |entry: &'a Entry| Argument { value: &entry.value, span: span(&entry.span) };
        let mut fields = Fields {
            owner: format!("`{}`", node.name.text),
            span: span(&node.name.span),
            arguments: Default::default(),
            fields: Vec::new(),
            asked: Vec::new(),
        };
        for entry in &node.entries {
            match &entry.name {
                None => fields.arguments.push_back(argument(entry)),
                Some(name) => fields.fields.push(Some(Field {
                    name: &name.text,
                    span: span(&name.span),
                    content: Content::Property(argument(entry)),
                })),
            }
        }
        for child in &node.children {
            fields.fields.push(Some(Field {
                name: &child.name.text,
                span: span(&child.name.span),
                content: Content::Child(child),
            }));
        }
        fields
    }

    /// True if anything is said besides arguments.
    pub(super) fn has_fields(&self) -> bool {
        !self.fields.is_empty()
    }

    /// True if there is a field called `name`.
    pub(super) fn has(&self, name: &str) -> bool {
        self.fields.iter().flatten().any(|field| field.name == name)
    }

    /// The next argument.
    pub(super) fn argument(&mut self) -> Option<Argument<'a>> {
        self.arguments.pop_front()
    }

    /// All arguments.
    pub(super) fn all_arguments(&mut self) -> Vec<Argument<'a>> {
        self.arguments.drain(..).collect()
    }

    /// The next argument if it is a text.
    pub(super) fn text_argument(&mut self) -> Option<Spanned<String>> {
        let Value::Text(text) = self.arguments.front()?.value else { return None };
        let span = self.arguments.pop_front()?.span;
        Some(Spanned { value: text.clone(), span })
    }

    /// The field called `name`; a second one is a problem.
    pub(super) fn take(&mut self, decoder: &mut Decoder, name: &'static str) -> Option<Field<'a>> {
        self.asked.push(name);
        let mut found: Option<Field<'a>> = None;
        for slot in &mut self.fields {
            let Some(field) = slot.take_if(|field| field.name == name) else { continue };
            match &found {
                None => found = Some(field),
                Some(first) => {
                    let help = format!("first {}", decoder.report.line(&first.span, &field.span));
                    decoder.problem(&field.span, format!("{} has `{name}` twice", self.owner), Some(help));
                }
            }
        }
        found
    }

    /// All child nodes that have one of the names, in order; a property of such a name is a problem.
    pub(super) fn take_nodes(&mut self, decoder: &mut Decoder, names: &[&'static str]) -> Vec<Field<'a>> {
        self.asked.extend_from_slice(names);
        let mut found = Vec::new();
        for slot in &mut self.fields {
            let Some(field) = slot.take_if(|field| names.contains(&field.name)) else { continue };
            if field.node().is_some() {
                found.push(field);
            } else {
                let help = format!("write `{{ {} … }}`", field.name);
                let message =
                    format!("`{}` stands in the block of {}, not beside its name", field.name, self.owner);
                decoder.problem(&field.span, message, Some(help));
            }
        }
        found
    }

    /// Fields left of which a name is expected to be one of `names`: exactly one is wanted.
    pub(super) fn take_one_of(&mut self, decoder: &mut Decoder, names: &[&'static str]) -> Option<Field<'a>> {
        self.asked.extend_from_slice(names);
        let mut found: Option<Field<'a>> = None;
        for slot in &mut self.fields {
            let Some(field) = slot.take_if(|field| names.contains(&field.name)) else { continue };
            match &found {
                None => found = Some(field),
                Some(first) => {
                    let message = format!("{} has both `{}` and `{}`", self.owner, first.name, field.name);
                    decoder.problem(&field.span, message, Some("only one of them can be".into()));
                }
            }
        }
        found
    }

    /// True if nothing that was not asked for is left, so that something missing cannot be a slip of the pen.
    pub(super) fn nothing_left(&self) -> bool {
        self.fields.iter().all(Option::is_none)
    }

    /// Notes all that was not asked for; `kind` says what was: `option`, `node`.
    pub(super) fn finish(&mut self, decoder: &mut Decoder, kind: &str) {
        for argument in self.arguments.drain(..) {
            let shown = decoder.quote(&argument.span);
            decoder.problem(&argument.span, format!("{} has no use for the value {shown}", self.owner), None);
        }
        for field in self.fields.drain(..).flatten() {
            if decoder.report.is_full() {
                decoder.problem(&field.span, "", None);
                continue;
            }
            let help = advice(field.name, self.asked.iter().copied(), "accepted", "`");
            let name = clip(field.name);
            decoder.problem(&field.span, format!("unknown {kind} `{name}` in {}", self.owner), Some(help));
        }
    }
}
