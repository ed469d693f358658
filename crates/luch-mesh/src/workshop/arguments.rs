//! The values of one call.

use super::verb::Fallback;
use super::{Files, Value, Verb, WorkshopError, error};
use crate::PolygonMesh;
use crate::screen::OnScreen;
use glam::DVec3;

/// The values that a verb is called with; defaults are filled in.
///
/// The readers below take the name of a parameter of the verb, of their kind; other names are mistakes of the program and
/// panic. The contract suite calls every verb.
#[derive(Clone, Debug, PartialEq)]
pub struct Arguments {
    values: Vec<(&'static str, Value)>,
}

impl Arguments {
    /// Reads what was given: names and texts, in any order. An empty name stands for the first parameter.
    pub fn read(
        verb: &'static Verb,
        given: &[(String, String)],
        files: &mut dyn Files,
    ) -> Result<Self, WorkshopError> {
        for (place, (name, _)) in given.iter().enumerate() {
            let known = verb.parameters.iter().any(|parameter| named(verb, parameter.name, name));
            if !known {
                return Err(unknown(verb, name));
            }
            let same = |other: &str| {
                other == name
                    || (first_of(verb) == other && name.is_empty())
                    || (first_of(verb) == name && other.is_empty())
            };
            if given[..place].iter().any(|(other, _)| same(other)) {
                return Err(WorkshopError::of(name, "is given twice"));
            }
        }
        let mut values = Vec::with_capacity(verb.parameters.len());
        for parameter in verb.parameters {
            let text = given
                .iter()
                .find(|(name, _)| named(verb, parameter.name, name))
                .map(|(_, text)| text.as_str());
            let text = match (text, parameter.default) {
                (Some(text), _) => text,
                (None, Fallback::Value(text)) => text,
                (None, Fallback::Nothing) => continue,
                (None, Fallback::Required) => {
                    let message =
                        format!("must be given: {}, {}", parameter.summary, parameter.kind.accepted());
                    return Err(WorkshopError::of(parameter.name, message));
                }
            };
            let value = parameter
                .kind
                .read(text, files)
                .map_err(|message| WorkshopError::of(parameter.name, message))?;
            values.push((parameter.name, value));
        }
        Ok(Self { values })
    }

    /// The value of a parameter, if it was given or has a default.
    pub fn get(&self, name: &str) -> Option<&Value> {
        self.values.iter().find(|(known, _)| *known == name).map(|(_, value)| value)
    }

    /// A number, or an angle in radians.
    pub fn number(&self, name: &str) -> f64 {
        self.number_if_given(name).unwrap_or_else(|| missing(name))
    }

    /// A number, or an angle in radians, if there is one.
    pub fn number_if_given(&self, name: &str) -> Option<f64> {
        match self.get(name) {
            Some(Value::Number(number)) => Some(*number),
            _ => None,
        }
    }

    /// A number in single precision.
    pub fn length(&self, name: &str) -> f32 {
        self.number(name) as f32
    }

    /// A whole number; those past `u32` are lowered to its most.
    pub fn count(&self, name: &str) -> u32 {
        match self.get(name) {
            Some(Value::Count(count)) => (*count).min(u64::from(u32::MAX)) as u32,
            _ => missing(name),
        }
    }

    /// A whole number, if there is one.
    pub fn count_if_given(&self, name: &str) -> Option<u64> {
        match self.get(name) {
            Some(Value::Count(count)) => Some(*count),
            _ => None,
        }
    }

    /// Pixels on screens, if they were given.
    pub fn on_screen(&self, name: &str) -> Option<&OnScreen> {
        match self.get(name) {
            Some(Value::OnScreen(screen)) => Some(screen),
            _ => None,
        }
    }

    /// Three numbers.
    pub fn vector(&self, name: &str) -> DVec3 {
        self.vector_if_given(name).unwrap_or_else(|| missing(name))
    }

    /// Three numbers, if there are any.
    pub fn vector_if_given(&self, name: &str) -> Option<DVec3> {
        match self.get(name) {
            Some(Value::Vector(vector)) => Some(*vector),
            _ => None,
        }
    }

    /// Any numbers; none if they are not given.
    pub fn numbers(&self, name: &str) -> &[f64] {
        match self.get(name) {
            Some(Value::Numbers(numbers)) => numbers,
            _ => &[],
        }
    }

    /// Yes or no; no if it is not given.
    pub fn flag(&self, name: &str) -> bool {
        matches!(self.get(name), Some(Value::Flag(true)))
    }

    /// The chosen word.
    pub fn choice(&self, name: &str) -> &'static str {
        match self.get(name) {
            Some(Value::Choice(word)) => word,
            _ => missing(name),
        }
    }

    /// Text, if there is any.
    pub fn text(&self, name: &str) -> Option<&str> {
        match self.get(name) {
            Some(Value::Text(text)) => Some(text),
            _ => None,
        }
    }

    /// The bytes of a file, if there is one.
    pub fn file(&self, name: &str) -> Option<&[u8]> {
        match self.get(name) {
            Some(Value::File(bytes)) => Some(bytes),
            _ => None,
        }
    }

    /// A mesh, if there is one.
    pub fn mesh(&self, name: &str) -> Option<&PolygonMesh> {
        match self.get(name) {
            Some(Value::Mesh(mesh)) => Some(mesh),
            _ => None,
        }
    }
}

fn first_of(verb: &Verb) -> &'static str {
    verb.parameters.first().map_or("", |parameter| parameter.name)
}

/// Whether `given` names this parameter of the verb.
fn named(verb: &Verb, parameter: &str, given: &str) -> bool {
    parameter == given || (given.is_empty() && first_of(verb) == parameter)
}

fn unknown(verb: &Verb, name: &str) -> WorkshopError {
    if name.is_empty() {
        return WorkshopError::new(format!("`{}` takes nothing", verb.name));
    }
    let names = || verb.parameters.iter().map(|parameter| parameter.name);
    let message = match error::closest(name, names()) {
        Some(close) => format!("is no parameter of `{}`; did you mean `{close}`?", verb.name),
        None => {
            let list: Vec<_> = names().collect();
            format!("is no parameter of `{}`, which takes: {}", verb.name, list.join(", "))
        }
    };
    WorkshopError::of(name, message)
}

fn missing(name: &str) -> ! {
    unreachable!("the verb has no such parameter of this kind: {name}")
}
