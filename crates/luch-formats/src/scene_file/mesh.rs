//! `mesh "name" { … }`: a file or a form, then what is done to it, line by line. Forms and most operations are the verbs of the
//! mesh workshop: their names, parameters and defaults are told there alone.

use super::decoder::Decoder;
use super::fields::{Argument, Field, Fields};
use super::transform::TRANSFORMS;
use super::value::Range;
use super::{MeshOperation, MeshOrigin, MeshSource, Named, WorkshopStep};
use crate::kdl::Value;
use luch_mesh::workshop::{Action, Arguments, Step, Unread, Verb, verbs};

/// What can be done to a mesh besides verbs and transforms.
const OPERATIONS: [&str; 4] = ["normals", "crease", "weld", "flip"];

impl Decoder<'_> {
    /// A definition at the top level.
    pub(super) fn named_mesh(&mut self, mut fields: Fields) {
        let name = self.required_name(&mut fields);
        let mesh = self.mesh(fields);
        if let (Some(name), Some(value)) = (name, mesh) {
            self.scene.meshes.push(Named { name: Some(name), value });
        }
    }

    /// A mesh written where it is used: its place in the list.
    pub(super) fn inline_mesh(&mut self, fields: Fields) -> Option<usize> {
        let value = self.mesh(fields)?;
        self.scene.meshes.push(Named { name: None, value });
        Some(self.scene.meshes.len() - 1)
    }

    fn mesh(&mut self, mut fields: Fields) -> Option<MeshSource> {
        let origins: Vec<&'static str> = std::iter::once("file").chain(names(true)).collect();
        let origin = fields.take_one_of(self, &origins);
        let lacks_origin = origin.is_none();
        let origin = origin.and_then(|field| match field.name {
            "file" => {
                let argument = self.single(field, "the name of a file")?;
                self.text("`file`", &argument).map(MeshOrigin::File)
            }
            _ => self.step(field).map(MeshOrigin::Form),
        });
        let operations: Vec<&'static str> =
            OPERATIONS.into_iter().chain(TRANSFORMS).chain(names(false)).collect();
        let nodes = fields.take_nodes(self, &operations);
        let operations = nodes.into_iter().filter_map(|field| self.operation(field)).collect();
        if lacks_origin && fields.nothing_left() {
            let help = super::source::advice("", origins, "write one of these in its block", "`");
            self.problem(&fields.span, "`mesh` lacks its origin", Some(help));
        }
        let span = fields.span.clone();
        fields.finish(self, "origin or operation");
        Some(MeshSource { span, origin: origin?, operations })
    }

    fn operation(&mut self, field: Field) -> Option<MeshOperation> {
        Some(match field.name {
            "normals" => {
                let argument = self.single(field, "\"flat\" or \"smooth\"")?;
                let is_flat = self.word("`normals`", &argument, &[("flat", true), ("smooth", false)])?;
                if is_flat { MeshOperation::FlatNormals } else { MeshOperation::SmoothNormals }
            }
            "crease" => {
                let [degrees] = self.numbers(field, Range::between(0.0, 180.0))?;
                MeshOperation::CreasedNormals(degrees.to_radians())
            }
            "weld" => {
                let [distance] = self.numbers(field, Range::NOT_NEGATIVE)?;
                MeshOperation::Weld(distance)
            }
            "flip" => {
                field.fields().finish(self, "option");
                MeshOperation::Flip
            }
            name if TRANSFORMS.contains(&name) => MeshOperation::Transform(self.transform(field)),
            _ => MeshOperation::Workshop(self.step(field)?),
        })
    }

    /// A verb with its parameters: `torus radius=2 tube=0.5`, `twist angle=90 axis="y"`, `subdivide { levels 3 }`.
    pub(super) fn step(&mut self, field: Field) -> Option<WorkshopStep> {
        let verb: &'static Verb = verbs().find(|verb| verb.name == field.name)?;
        let mut fields = field.fields();
        let mut given = Vec::new();
        let mut sound = true;
        let first = verb.parameters.first();
        let unnamed = fields.all_arguments();
        if let (Some(parameter), false) = (first, unnamed.is_empty()) {
            let text = self.joined(&unnamed);
            sound &= self.accepts(verb, parameter.name, &text, &unnamed);
            given.push((parameter.name.to_owned(), text));
        } else if let Some(argument) = unnamed.first() {
            let shown = self.quote(&argument.span);
            self.problem(&argument.span, format!("`{}` has no use for the value {shown}", verb.name), None);
            sound = false;
        }
        for parameter in verb.parameters {
            let Some(field) = fields.take(self, parameter.name) else { continue };
            let mut inner = field.fields();
            let arguments = inner.all_arguments();
            inner.finish(self, "option");
            let text = self.joined(&arguments);
            sound &= self.accepts(verb, parameter.name, &text, &arguments);
            given.push((parameter.name.to_owned(), text));
        }
        let span = fields.span.clone();
        fields.finish(self, "parameter");
        // What is missing or said twice.
        if sound && let Err(error) = Arguments::read(verb, &given, &mut Unread) {
            self.problem(&span, error.to_string(), None);
            return None;
        }
        sound.then_some(WorkshopStep { span, step: Step { verb, given } })
    }

    /// The values of one parameter as one text.
    fn joined(&mut self, arguments: &[Argument]) -> String {
        let texts: Vec<String> = arguments
            .iter()
            .map(|argument| match argument.value {
                Value::Integer(number) => number.to_string(),
                Value::Float(number) => number.to_string(),
                Value::Text(text) => text.clone(),
                Value::Bool(flag) => flag.to_string(),
                Value::Null => "null".into(),
            })
            .collect();
        texts.join(",")
    }

    /// Whether a parameter may be this; files are not read yet.
    fn accepts(&mut self, verb: &Verb, name: &str, text: &str, arguments: &[Argument]) -> bool {
        let Some(parameter) = verb.parameters.iter().find(|parameter| parameter.name == name) else {
            return false;
        };
        if parameter.kind.read(text, &mut Unread).is_ok() {
            return true;
        }
        if let (Some(first), Some(last)) = (arguments.first(), arguments.last()) {
            let mut span = first.span.clone();
            span.bytes.end = last.span.bytes.end;
            let shown = self.quote(&span);
            self.problem(&span, format!("`{name}` is {shown}, expected {}", parameter.kind.accepted()), None);
        }
        false
    }
}

/// Names of the verbs that make meshes, or of those that change them.
fn names(making: bool) -> impl Iterator<Item = &'static str> {
    verbs().filter(move |verb| matches!(verb.action, Action::Make { .. }) == making).map(|verb| verb.name)
}
