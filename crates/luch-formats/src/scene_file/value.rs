//! Single values: numbers in a range, words of a list, names.

use super::decoder::Decoder;
use super::fields::{Argument, Field, Fields};
use super::source::advice;
use super::{Spanned, source::Span};
use crate::kdl::Value;
use glam::Vec3;

/// Which numbers are accepted.
#[derive(Clone, Copy)]
pub(super) struct Range {
    pub(super) least: f32,
    pub(super) most: f32,
    /// Whether the least itself is accepted.
    pub(super) with_least: bool,
    /// Whether the most itself is accepted.
    pub(super) with_most: bool,
}

impl Range {
    /// Anything finite that leaves room for sums and products.
    pub(super) const ANY: Self = Self::between(-1e18, 1e18);
    pub(super) const UNIT: Self = Self::between(0.0, 1.0);
    pub(super) const NOT_NEGATIVE: Self = Self::between(0.0, 1e18);
    pub(super) const POSITIVE: Self = Self { least: 0.0, most: 1e18, with_least: false, with_most: true };

    pub(super) const fn between(least: f32, most: f32) -> Self {
        Self { least, most, with_least: true, with_most: true }
    }

    fn holds(&self, value: f64) -> bool {
        // Tested as it will be stored: a tiny positive number must not become zero.
        let stored = value as f32;
        let is_above = if self.with_least { stored >= self.least } else { stored > self.least };
        let is_below = if self.with_most { stored <= self.most } else { stored < self.most };
        is_above && is_below
    }

    fn describe(&self) -> String {
        let Self { least, most, .. } = self;
        match (*least == -1e18, *most == 1e18, self.with_least, self.with_most) {
            (true, true, ..) => "a number".to_owned(),
            (_, true, true, _) => format!("a number of at least {least}"),
            (_, true, false, _) => format!("a number above {least}"),
            (_, _, true, true) => format!("a number from {least} to {most}"),
            (_, _, false, true) => format!("a number above {least}, at most {most}"),
            (_, _, true, false) => format!("a number of at least {least}, below {most}"),
            (_, _, false, false) => format!("a number above {least}, below {most}"),
        }
    }
}

impl Decoder<'_> {
    /// A number of a range.
    pub(super) fn number(&mut self, owner: &str, argument: &Argument, range: Range) -> Option<f32> {
        let value = match argument.value {
            Value::Integer(value) => Some(*value as f64),
            Value::Float(value) => Some(*value),
            Value::Text(_) | Value::Bool(_) | Value::Null => None,
        };
        if let Some(value) = value.filter(|&value| range.holds(value)) {
            return Some(value as f32);
        }
        self.expected(owner, argument, &range.describe());
        None
    }

    /// A whole number of a range.
    pub(super) fn whole(&mut self, owner: &str, argument: &Argument, least: u64, most: u64) -> Option<u64> {
        if let Value::Integer(value) = argument.value
            && let Ok(value) = u64::try_from(*value)
            && (least..=most).contains(&value)
        {
            return Some(value);
        }
        self.expected(owner, argument, &format!("a whole number from {least} to {most}"));
        None
    }

    /// Notes that a value is not what it should be.
    pub(super) fn expected(&mut self, owner: &str, argument: &Argument, expected: &str) {
        let shown = self.quote(&argument.span);
        self.problem(&argument.span, format!("{owner} is {shown}, expected {expected}"), None);
    }

    /// The only argument of a field that has nothing else.
    pub(super) fn single<'a>(&mut self, field: Field<'a>, expected: &str) -> Option<Argument<'a>> {
        let mut fields = field.fields();
        let argument = fields.argument();
        if argument.is_none() {
            let message = format!("{} lacks its value, expected {expected}", fields.owner);
            self.problem(&fields.span, message, None);
        }
        fields.finish(self, "option");
        argument
    }

    /// A number called `name`, or `default`.
    pub(super) fn number_or(
        &mut self,
        fields: &mut Fields,
        name: &'static str,
        range: Range,
        default: f32,
    ) -> f32 {
        self.optional_number(fields, name, range).unwrap_or(default)
    }

    /// A number called `name`.
    pub(super) fn optional_number(
        &mut self,
        fields: &mut Fields,
        name: &'static str,
        range: Range,
    ) -> Option<f32> {
        let field = fields.take(self, name)?;
        let argument = self.single(field, &range.describe())?;
        self.number(&format!("`{name}`"), &argument, range)
    }

    /// A whole number called `name`, or `default`.
    pub(super) fn whole_or(
        &mut self,
        fields: &mut Fields,
        name: &'static str,
        least: u64,
        most: u64,
        default: u64,
    ) -> u64 {
        let Some(field) = fields.take(self, name) else { return default };
        let argument = self.single(field, &format!("a whole number from {least} to {most}"));
        argument
            .and_then(|argument| self.whole(&format!("`{name}`"), &argument, least, most))
            .unwrap_or(default)
    }

    /// `#true` or `#false` called `name`, or `default`; the bare word means true.
    pub(super) fn flag_or(&mut self, fields: &mut Fields, name: &'static str, default: bool) -> bool {
        let Some(field) = fields.take(self, name) else { return default };
        let mut inner = field.fields();
        let Some(argument) = inner.argument() else {
            inner.finish(self, "option");
            return true;
        };
        inner.finish(self, "option");
        if let Value::Bool(value) = argument.value {
            return *value;
        }
        self.expected(&format!("`{name}`"), &argument, "#true or #false");
        default
    }

    /// One of the words of a list.
    pub(super) fn word<T: Copy>(
        &mut self,
        owner: &str,
        argument: &Argument,
        words: &[(&str, T)],
    ) -> Option<T> {
        let names = || words.iter().map(|(name, _)| *name);
        let Value::Text(text) = argument.value else {
            let list: Vec<String> = names().map(|name| format!("\"{name}\"")).collect();
            self.expected(owner, argument, &format!("one of {}", list.join(", ")));
            return None;
        };
        let found = words.iter().find(|(name, _)| name == text).map(|&(_, value)| value);
        if found.is_none() {
            let help = advice(text, names(), "accepted", "\"");
            let shown = self.quote(&argument.span);
            self.problem(&argument.span, format!("{owner} cannot be {shown}"), Some(help));
        }
        found
    }

    /// One of the words of a list, called `name`, or `default`.
    pub(super) fn word_or<T: Copy>(
        &mut self,
        fields: &mut Fields,
        name: &'static str,
        words: &[(&str, T)],
        default: T,
    ) -> T {
        let Some(field) = fields.take(self, name) else { return default };
        let argument = self.single(field, "a word");
        argument.and_then(|argument| self.word(&format!("`{name}`"), &argument, words)).unwrap_or(default)
    }

    /// A text that is not empty.
    pub(super) fn text(&mut self, owner: &str, argument: &Argument) -> Option<Spanned<String>> {
        match argument.value {
            Value::Text(text) if !text.is_empty() => {
                Some(Spanned { value: text.clone(), span: argument.span.clone() })
            }
            _ => {
                self.expected(owner, argument, "a text in quotes that is not empty");
                None
            }
        }
    }

    /// A text called `name`.
    pub(super) fn optional_text(
        &mut self,
        fields: &mut Fields,
        name: &'static str,
    ) -> Option<Spanned<String>> {
        let field = fields.take(self, name)?;
        let argument = self.single(field, "a text in quotes")?;
        self.text(&format!("`{name}`"), &argument)
    }

    /// As many numbers as the array has; the field has nothing else.
    pub(super) fn numbers<const N: usize>(&mut self, field: Field, range: Range) -> Option<[f32; N]> {
        let mut fields = field.fields();
        let arguments = fields.all_arguments();
        let numbers = self.array(&fields.owner.clone(), &fields.span, &arguments, range);
        fields.finish(self, "option");
        numbers
    }

    /// As many numbers as the array has.
    pub(super) fn array<const N: usize>(
        &mut self,
        owner: &str,
        span: &Span,
        arguments: &[Argument],
        range: Range,
    ) -> Option<[f32; N]> {
        let before = self.report.count();
        let all: Vec<f32> =
            arguments.iter().filter_map(|argument| self.number(owner, argument, range)).collect();
        if self.report.count() > before {
            return None;
        }
        let numbers = <[f32; N]>::try_from(all.as_slice()).ok();
        if numbers.is_none() {
            let have = match arguments.len() {
                0 => "no numbers".to_owned(),
                1 => "1 number".to_owned(),
                count => format!("{count} numbers"),
            };
            self.problem(span, format!("{owner} has {have}, expected {N}"), None);
        }
        numbers
    }

    /// Three numbers called `name`.
    pub(super) fn optional_point(&mut self, fields: &mut Fields, name: &'static str) -> Option<Vec3> {
        let field = fields.take(self, name)?;
        self.numbers(field, Range::ANY).map(Vec3::from_array)
    }

    /// Three numbers called `name` that are not all zero.
    pub(super) fn optional_direction(&mut self, fields: &mut Fields, name: &'static str) -> Option<Vec3> {
        let field = fields.take(self, name)?;
        let span = field.span.clone();
        let vector = self.numbers(field, Range::ANY).map(Vec3::from_array)?;
        let direction = vector.try_normalize();
        if direction.is_none() {
            self.problem(&span, format!("`{name}` has no direction: its length is zero"), None);
        }
        direction
    }

    /// An angle in degrees called `name`, as radians.
    pub(super) fn optional_angle(
        &mut self,
        fields: &mut Fields,
        name: &'static str,
        range: Range,
    ) -> Option<f32> {
        self.optional_number(fields, name, range).map(f32::to_radians)
    }
}
