//! A value in a JSON document that knows its place, and says it in every complaint.

use crate::{Place, Problem};
use serde_json::Value;
use std::path::Path;

/// A value and the JSON pointer to it.
#[derive(Clone, Debug)]
pub(super) struct Json<'a> {
    value: &'a Value,
    path: String,
    file: &'a Path,
}

/// An array, or nothing where one may stand.
#[derive(Clone, Debug)]
pub(super) struct List<'a> {
    items: &'a [Value],
    path: String,
    file: &'a Path,
}

impl<'a> Json<'a> {
    /// The whole document.
    pub(super) fn root(value: &'a Value, file: &'a Path) -> Self {
        Self { value, path: String::new(), file }
    }

    /// The JSON pointer.
    pub(super) fn path(&self) -> &str {
        if self.path.is_empty() { "/" } else { &self.path }
    }

    /// A complaint about this value.
    pub(super) fn problem(&self, message: impl Into<String>) -> Problem {
        Problem::new(self.file, message).at(Place::Path(self.path().to_owned()))
    }

    fn wrong_type(&self, expected: &str) -> Problem {
        self.problem(format!("is {}, expected {expected}", describe(self.value)))
    }

    fn object(&self) -> Result<&'a serde_json::Map<String, Value>, Problem> {
        self.value.as_object().ok_or_else(|| self.wrong_type("an object"))
    }

    /// A property; `None` if it is absent, an error if this is no object.
    pub(super) fn get(&self, key: &str) -> Result<Option<Json<'a>>, Problem> {
        Ok(self.object()?.get(key).map(|value| self.child(key, value)))
    }

    /// A property that must be there.
    pub(super) fn need(&self, key: &str) -> Result<Json<'a>, Problem> {
        self.get(key)?.ok_or_else(|| self.problem(format!("has no \"{key}\"")))
    }

    /// All properties by name.
    pub(super) fn entries(&self) -> Result<impl Iterator<Item = (&'a str, Json<'a>)> + use<'a, '_>, Problem> {
        Ok(self.object()?.iter().map(|(key, value)| (key.as_str(), self.child(key, value))))
    }

    fn child(&self, key: &str, value: &'a Value) -> Json<'a> {
        // RFC 6901, section 3: "~" and "/" are escaped.
        let key = key.replace('~', "~0").replace('/', "~1");
        Json { value, path: format!("{}/{key}", self.path), file: self.file }
    }

    /// An extension of this object.
    pub(super) fn extension(&self, name: &str) -> Result<Option<Json<'a>>, Problem> {
        match self.get("extensions")? {
            Some(extensions) => extensions.get(name),
            None => Ok(None),
        }
    }

    /// An array property; an absent one is empty.
    pub(super) fn list(&self, key: &str) -> Result<List<'a>, Problem> {
        let Some(child) = self.get(key)? else {
            return Ok(List { items: &[], path: format!("{}/{key}", self.path), file: self.file });
        };
        child.as_list()
    }

    /// This value as an array.
    pub(super) fn as_list(&self) -> Result<List<'a>, Problem> {
        let items = self.value.as_array().ok_or_else(|| self.wrong_type("an array"))?;
        Ok(List { items, path: self.path.clone(), file: self.file })
    }

    /// A string.
    pub(super) fn text(&self) -> Result<&'a str, Problem> {
        self.value.as_str().ok_or_else(|| self.wrong_type("a string"))
    }

    /// True or false.
    pub(super) fn boolean(&self) -> Result<bool, Problem> {
        self.value.as_bool().ok_or_else(|| self.wrong_type("true or false"))
    }

    /// A whole number that is not negative; `3.0` counts as whole.
    pub(super) fn whole(&self) -> Result<u64, Problem> {
        let from_float = |number: f64| {
            // 2^53: up to here every whole f64 is the number that was written.
            ((0.0..=9_007_199_254_740_992.0).contains(&number) && number.floor() == number)
                .then_some(number as u64)
        };
        let whole = self.value.as_u64().or_else(|| self.value.as_f64().and_then(from_float));
        whole.ok_or_else(|| self.wrong_type("a whole number, at least 0"))
    }

    /// A whole number that fits memory.
    pub(super) fn size(&self) -> Result<usize, Problem> {
        let number = self.whole()?;
        usize::try_from(number).map_err(|_| self.problem(format!("is {number}, which is too large")))
    }

    /// A number within the range of `f32`.
    pub(super) fn number(&self) -> Result<f64, Problem> {
        let number = self.value.as_f64().ok_or_else(|| self.wrong_type("a number"))?;
        if number.abs() <= f64::from(f32::MAX) {
            Ok(number)
        } else {
            Err(self.problem(format!("is {number}, which is too large")))
        }
    }

    /// An array of exactly `N` numbers.
    pub(super) fn numbers<const N: usize>(&self) -> Result<[f64; N], Problem> {
        let list = self.as_list()?;
        if list.len() != N {
            return Err(self.problem(format!("has {} entries, expected {N}", list.len())));
        }
        let mut numbers = [0.0; N];
        for (number, entry) in numbers.iter_mut().zip(list.iter()) {
            *number = entry.number()?;
        }
        Ok(numbers)
    }

    /// A number property or its default.
    pub(super) fn number_or(&self, key: &str, default: f64) -> Result<f64, Problem> {
        self.get(key)?.map_or(Ok(default), |value| value.number())
    }

    /// A property of `N` numbers or its default.
    pub(super) fn numbers_or<const N: usize>(
        &self,
        key: &str,
        default: [f64; N],
    ) -> Result<[f64; N], Problem> {
        self.get(key)?.map_or(Ok(default), |value| value.numbers())
    }

    /// The "name", shortened to 200 characters; empty if there is none.
    pub(super) fn name(&self) -> Result<String, Problem> {
        const LONGEST: usize = 200;
        match self.get("name")? {
            Some(name) => Ok(name.text()?.chars().take(LONGEST).collect()),
            None => Ok(String::new()),
        }
    }

    /// The place of something in `list` that this number names.
    pub(super) fn reference(&self, list: &List) -> Result<usize, Problem> {
        self.reference_within(list.len(), &list.path)
    }

    /// As [`Json::reference`] for a list of known length.
    pub(super) fn reference_within(&self, count: usize, list: &str) -> Result<usize, Problem> {
        let index = self.size()?;
        if index < count {
            Ok(index)
        } else {
            Err(self.problem(format!(
                "refers to {list}/{index}, which does not exist; {list} has {count} entries"
            )))
        }
    }
}

impl<'a> List<'a> {
    /// How many entries there are.
    pub(super) fn len(&self) -> usize {
        self.items.len()
    }

    /// True if nothing is in it.
    pub(super) fn is_empty(&self) -> bool {
        self.items.is_empty()
    }

    /// The JSON pointer.
    pub(super) fn path(&self) -> &str {
        &self.path
    }

    /// The entry at a place that was checked before.
    pub(super) fn at(&self, index: usize) -> Json<'a> {
        Json { value: &self.items[index], path: format!("{}/{index}", self.path), file: self.file }
    }

    /// The entries in order.
    pub(super) fn iter(&self) -> impl Iterator<Item = Json<'a>> + use<'a, '_> {
        (0..self.items.len()).map(|index| self.at(index))
    }
}

/// What a value is, quoting short ones.
fn describe(value: &Value) -> String {
    match value {
        Value::Null => "null".into(),
        Value::Bool(value) => value.to_string(),
        Value::Number(number) => format!("the number {number}"),
        Value::String(text) => format!("the string \"{}\"", short(text)),
        Value::Array(_) => "an array".into(),
        Value::Object(_) => "an object".into(),
    }
}

/// A text of the file for a message: at most 40 characters, control characters escaped.
pub(super) fn short(text: &str) -> String {
    let mut shown: String = text.chars().take(40).flat_map(char::escape_debug).collect();
    if text.chars().nth(40).is_some() {
        shown.push('…');
    }
    shown
}
