//! Warnings, told once for each kind with how often it happened.

use crate::{Place, Warning};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// What was not honoured so far.
#[derive(Debug)]
pub(super) struct Notices {
    file: PathBuf,
    list: Vec<Notice>,
    by_message: BTreeMap<String, usize>,
}

#[derive(Debug)]
struct Notice {
    message: String,
    first: String,
    count: usize,
}

impl Notices {
    /// None yet, about `file`.
    pub(super) fn new(file: &Path) -> Self {
        Self { file: file.to_owned(), list: Vec::new(), by_message: BTreeMap::new() }
    }

    /// One more case of `message`, at a JSON pointer.
    pub(super) fn add(&mut self, path: &str, message: impl Into<String>) {
        let message = message.into();
        if let Some(&index) = self.by_message.get(&message) {
            self.list[index].count += 1;
        } else {
            self.by_message.insert(message.clone(), self.list.len());
            self.list.push(Notice { message, first: path.to_owned(), count: 1 });
        }
    }

    /// The warnings in the order in which they first arose.
    pub(super) fn into_warnings(self) -> Vec<Warning> {
        let file = self.file;
        let warning = |notice: Notice| {
            let message = match notice.count {
                1 => notice.message,
                count => format!("{} ({count} times; this is the first)", notice.message),
            };
            Warning::new(&file, message).at(Place::Path(notice.first))
        };
        self.list.into_iter().map(warning).collect()
    }
}
