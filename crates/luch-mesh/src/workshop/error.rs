//! What can be wrong with a step.

/// Why a step cannot be understood or done.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}{message}", .parameter.as_ref().map_or(String::new(), |name| format!("`{name}`: ")))]
pub struct WorkshopError {
    /// The parameter it is about, if any.
    pub parameter: Option<String>,
    /// What is wrong, and what would be right.
    pub message: String,
}

impl WorkshopError {
    /// An error about no parameter in particular.
    pub fn new(message: impl Into<String>) -> Self {
        Self { parameter: None, message: message.into() }
    }

    /// An error about a parameter.
    pub fn of(parameter: &str, message: impl Into<String>) -> Self {
        Self { parameter: Some(parameter.into()), message: message.into() }
    }
}

/// The name most like one that was mistyped.
pub(super) fn closest<'a>(name: &str, known: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    let likeness = |known: &str| strsim::jaro_winkler(name, known);
    known
        .filter(|known| likeness(known) > 0.8)
        .max_by(|one, other| likeness(one).total_cmp(&likeness(other)).then(other.cmp(one)))
}
