//! Nodes, their entries and blocks.

use super::scanner::{Broken, Scanner, is_identifier_char, is_newline};
use super::{DEEPEST, Entry, Node, SyntaxError, Value, Word};

/// The nodes of a text.
///
/// # Errors
/// All mistakes that were found, at most some dozen.
pub(crate) fn parse(text: &str) -> Result<Vec<Node>, Vec<SyntaxError>> {
    let mut scanner = Scanner { text, at: 0, errors: Vec::new() };
    scanner.take("\u{feff}");
    let mut nodes = Vec::new();
    while scanner.peek().is_some() {
        nodes.append(&mut scanner.nodes(0));
        if scanner.looks_at("}") {
            let span = scanner.here();
            scanner.at += 1;
            // After another mistake braces need not match.
            if scanner.errors.is_empty() {
                scanner.fail(span, "this `}` closes nothing", None);
            }
        }
    }
    if scanner.errors.is_empty() { Ok(nodes) } else { Err(scanner.errors) }
}

/// What follows the name of a node.
enum Part {
    Entry(Entry),
    Children(Vec<Node>),
    /// Commented out by a slash and a dash.
    Nothing,
}

impl Scanner<'_> {
    /// Nodes up to a `}` or the end of the text. After a mistake the next line is tried.
    fn nodes(&mut self, depth: usize) -> Vec<Node> {
        let mut nodes = Vec::new();
        loop {
            let before = self.at;
            match self.next_node(depth) {
                Ok(Some(node)) => nodes.extend(node),
                Ok(None) => return nodes,
                Err(Broken) => {
                    self.take_while(|c| !is_newline(c));
                    // A mistake at the end of a line must not be met again.
                    if self.at == before && !self.newline() {
                        return nodes;
                    }
                }
            }
        }
    }

    /// The next node, empty if it is commented out; `None` if there is none.
    fn next_node(&mut self, depth: usize) -> Result<Option<Option<Node>>, Broken> {
        self.line_space()?;
        let is_comment = self.take("/-");
        if is_comment {
            self.line_space()?;
        }
        if self.peek().is_none() || self.looks_at("}") {
            if is_comment {
                let span = self.at.saturating_sub(2)..self.at;
                return Err(self.fail(span, "`/-` comments out nothing", None));
            }
            return Ok(None);
        }
        let node = self.node(depth)?;
        Ok(Some((!is_comment).then_some(node)))
    }

    fn node(&mut self, depth: usize) -> Result<Node, Broken> {
        self.type_annotation()?;
        if self.looks_at("{") {
            let help = Some(
                "a block belongs to a node: a name stands before it, and no `;` or new line between them",
            );
            return Err(self.fail(self.here(), "a block without a node", help));
        }
        let start = self.at;
        let name = match self.value()? {
            Value::Text(text) => Word { text, span: start..self.at },
            _ => return Err(self.fail(start..self.at, "a node begins with a name, not with a value", None)),
        };
        let mut node = Node { name, entries: Vec::new(), children: Vec::new() };
        let mut has_children = false;
        loop {
            let had_space = self.node_space()?;
            if self.looks_at("}") || self.terminator() {
                return Ok(node);
            }
            let start = self.at;
            match self.part(depth)? {
                Part::Nothing => {}
                Part::Children(children) => {
                    if has_children {
                        return Err(self.fail(start..start + 1, "a node has one block only", None));
                    }
                    has_children = true;
                    node.children = children;
                }
                Part::Entry(entry) => {
                    if has_children {
                        return Err(self.fail(start..self.at, "values stand before the block", None));
                    }
                    if !had_space {
                        return Err(self.fail(start..self.at, "a space is missing before this", None));
                    }
                    node.entries.push(entry);
                }
            }
        }
    }

    fn part(&mut self, depth: usize) -> Result<Part, Broken> {
        let is_comment = self.take("/-");
        if is_comment {
            self.line_space()?;
        }
        let part =
            if self.looks_at("{") { Part::Children(self.block(depth)?) } else { Part::Entry(self.entry()?) };
        Ok(if is_comment { Part::Nothing } else { part })
    }

    fn block(&mut self, depth: usize) -> Result<Vec<Node>, Broken> {
        let open = self.here();
        self.at += 1;
        if depth == DEEPEST {
            let message = format!("more than {DEEPEST} blocks inside one another");
            // Nothing below is worth reading.
            self.at = self.text.len();
            return Err(self.fail(open, message, None));
        }
        let nodes = self.nodes(depth + 1);
        if !self.take("}") {
            if self.errors.is_empty() {
                self.fail(open, "this block is never closed", Some("end it with `}`"));
            }
            return Err(Broken);
        }
        Ok(nodes)
    }

    fn entry(&mut self) -> Result<Entry, Broken> {
        self.type_annotation()?;
        let start = self.at;
        let first = self.value()?;
        let span = start..self.at;
        // A name and `=` make a property; spaces about the sign are allowed.
        let after_name = self.at;
        let is_property = matches!(first, Value::Text(_)) && {
            self.node_space()?;
            self.take("=")
        };
        let Value::Text(text) = first else { return Ok(Entry { name: None, value: first, span }) };
        if !is_property {
            self.at = after_name;
            return Ok(Entry { name: None, value: Value::Text(text), span });
        }
        self.node_space()?;
        if self.peek().is_none_or(|c| is_newline(c) || matches!(c, ';' | '}' | '{')) {
            return Err(self.fail(span, format!("`{text}=` lacks its value"), None));
        }
        self.type_annotation()?;
        let start = self.at;
        let value = self.value()?;
        Ok(Entry { name: Some(Word { text, span }), value, span: start..self.at })
    }

    /// `(name)`, which KDL allows before nodes and values; it says nothing here.
    fn type_annotation(&mut self) -> Result<(), Broken> {
        if !self.looks_at("(") {
            return Ok(());
        }
        let start = self.at;
        self.take_while(|c| c != ')' && !is_newline(c));
        self.take(")");
        Err(self.fail(
            start..self.at,
            "type annotations mean nothing here",
            Some("leave out the parentheses"),
        ))
    }

    /// A string, number or keyword.
    fn value(&mut self) -> Result<Value, Broken> {
        let start = self.at;
        let Some(first) = self.peek() else {
            return Err(self.fail(self.here(), "a name or value is missing", None));
        };
        let value = match first {
            '"' => Value::Text(self.quoted_string()?),
            '#' if self.rest().trim_start_matches('#').starts_with('"') => Value::Text(self.raw_string()?),
            '#' => self.keyword()?,
            c if is_identifier_char(c) => {
                let word = self.take_while(is_identifier_char);
                self.word_or_number(word, start)?
            }
            c => {
                let help =
                    "characters other than letters, digits and signs such as `-` stand in quotes: \"…\"";
                return Err(self.fail(self.here(), format!("unexpected `{}`", c.escape_debug()), Some(help)));
            }
        };
        match self.peek() {
            Some('"' | '#' | '(') => Err(self.fail(self.here(), "a space is missing before this", None)),
            _ => Ok(value),
        }
    }

    fn keyword(&mut self) -> Result<Value, Broken> {
        let start = self.at;
        self.at += 1;
        let value = match self.take_while(is_identifier_char) {
            "true" => Value::Bool(true),
            "false" => Value::Bool(false),
            "null" => Value::Null,
            "inf" => Value::Float(f64::INFINITY),
            "-inf" => Value::Float(f64::NEG_INFINITY),
            "nan" => Value::Float(f64::NAN),
            word => {
                let message = format!("`#{word}` is no keyword");
                let help = "keywords are #true, #false, #null, #inf, #-inf, #nan; a colour stands in quotes: \"#rrggbb\"";
                return Err(self.fail(start..self.at.max(start + 1), message, Some(help)));
            }
        };
        Ok(value)
    }
}
