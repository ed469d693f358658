//! Texts that travel with a picture.

use super::{DecodeError, EncodeError, Format};

/// Keys with their texts, in order, each key once.
///
/// So that every format can hold them, keys are 1 to 79 printable ASCII characters without `=` and without spaces at
/// the ends or next to one another, and texts hold no NUL character. Writing checks this.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Metadata {
    entries: Vec<(String, String)>,
}

impl Metadata {
    /// No texts.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a text, or replaces the one of the same key where it stands.
    pub fn set(&mut self, key: impl Into<String>, value: impl Into<String>) {
        let (key, value) = (key.into(), value.into());
        match self.entries.iter_mut().find(|entry| entry.0 == key) {
            Some(entry) => entry.1 = value,
            None => self.entries.push((key, value)),
        }
    }

    /// The text of a key.
    pub fn get(&self, key: &str) -> Option<&str> {
        self.entries.iter().find(|entry| entry.0 == key).map(|entry| entry.1.as_str())
    }

    /// Keys and texts in order.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = (&str, &str)> {
        self.entries.iter().map(|(key, value)| (key.as_str(), value.as_str()))
    }

    /// Number of texts.
    pub fn len(&self) -> usize {
        self.entries.len()
    }

    /// True if there is none.
    pub fn is_empty(&self) -> bool {
        self.entries.is_empty()
    }

    /// Passes texts that every format can hold; `longest` is in bytes.
    pub(super) fn check(&self, format: Format, longest: usize) -> Result<(), EncodeError> {
        for (key, value) in self.iter() {
            let refuse = |reason: String| Err(EncodeError::Metadata { format, key: key.to_owned(), reason });
            if !is_portable_key(key) {
                return refuse(
                    "a key is 1 to 79 printable ASCII characters without '=' and without leading, trailing or double spaces"
                        .to_owned(),
                );
            }
            if value.contains('\0') {
                return refuse("a text holds no NUL character".to_owned());
            }
            if key.len() + value.len() > longest {
                return refuse(format!("key and text together hold at most {longest} bytes"));
            }
        }
        Ok(())
    }
}

/// Texts as they are read from a file that may be hostile.
pub(super) struct Reading {
    format: Format,
    metadata: Metadata,
    bytes: usize,
}

/// Most texts of a file, and most bytes of all of them (compressed texts may grow a thousandfold).
const MOST_TEXTS: usize = 4096;
const MOST_BYTES: usize = 64 << 20;

impl Reading {
    /// Nothing read yet.
    pub(super) fn new(format: Format) -> Self {
        Self { format, metadata: Metadata::new(), bytes: 0 }
    }

    /// One more text; one of a known key replaces it.
    pub(super) fn add(&mut self, key: &str, value: impl Into<String>) -> Result<(), DecodeError> {
        let value = value.into();
        self.bytes += key.len() + value.len();
        self.metadata.set(key, value);
        if self.metadata.len() > MOST_TEXTS || self.bytes > MOST_BYTES {
            let what = format!("metadata of more than {MOST_TEXTS} texts or {} MiB", MOST_BYTES >> 20);
            return Err(DecodeError::unsupported(self.format, what));
        }
        Ok(())
    }

    /// All that was read.
    pub(super) fn finish(self) -> Metadata {
        self.metadata
    }
}

impl<K: Into<String>, V: Into<String>> FromIterator<(K, V)> for Metadata {
    fn from_iter<I: IntoIterator<Item = (K, V)>>(entries: I) -> Self {
        let mut metadata = Self::default();
        for (key, value) in entries {
            metadata.set(key, value);
        }
        metadata
    }
}

impl<K: Into<String>, V: Into<String>, const N: usize> From<[(K, V); N]> for Metadata {
    fn from(entries: [(K, V); N]) -> Self {
        entries.into_iter().collect()
    }
}

fn is_portable_key(key: &str) -> bool {
    (1..=79).contains(&key.len())
        && key.bytes().all(|b| matches!(b, b' '..=b'~') && b != b'=')
        && !key.starts_with(' ')
        && !key.ends_with(' ')
        && !key.contains("  ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_key_stands_once_where_it_first_stood() {
        let metadata = Metadata::from([("a", "1"), ("b", "2"), ("a", "3")]);
        assert_eq!(metadata.iter().collect::<Vec<_>>(), [("a", "3"), ("b", "2")]);
        assert_eq!((metadata.get("b"), metadata.get("c")), (Some("2"), None));
    }

    #[test]
    fn keys_that_some_format_cannot_hold_are_refused() {
        for key in ["", " a", "a ", "a  b", "a=b", "ключ", "a\nb", &"k".repeat(80)] {
            assert!(Metadata::from([(key, "x")]).check(Format::Png, 1000).is_err(), "{key:?}");
        }
        assert!(Metadata::from([("a", "b\0c")]).check(Format::Png, 1000).is_err());
        assert!(Metadata::from([("key", "1234567")]).check(Format::Png, 9).is_err());
        assert!(Metadata::from([("a b", "ключ\n\"x\"")]).check(Format::Png, 1000).is_ok());
    }
}
