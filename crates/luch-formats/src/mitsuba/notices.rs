//! Warnings, told once for each kind with how often it happened.

use crate::Warning;
use crate::scene_file::{Report, Span};
use std::collections::BTreeMap;

/// What was not honoured so far.
#[derive(Debug, Default)]
pub(super) struct Notices {
    list: Vec<Notice>,
    by_message: BTreeMap<String, usize>,
}

#[derive(Debug)]
struct Notice {
    message: String,
    help: Option<String>,
    first: Span,
    count: usize,
}

impl Notices {
    /// One more case of `message`.
    pub(super) fn add(&mut self, span: &Span, message: impl Into<String>, help: Option<String>) {
        let message = message.into();
        if let Some(&index) = self.by_message.get(&message) {
            self.list[index].count += 1;
        } else {
            self.by_message.insert(message.clone(), self.list.len());
            self.list.push(Notice { message, help, first: span.clone(), count: 1 });
        }
    }

    /// The warnings in the order in which they first arose.
    pub(super) fn into_warnings(self, report: &Report) -> Vec<Warning> {
        let warning = |notice: Notice| {
            let message = match notice.count {
                1 => notice.message,
                count => format!("{} ({count} times; this is the first)", notice.message),
            };
            Warning { help: notice.help, ..report.problem(&notice.first, message) }
        };
        self.list.into_iter().map(warning).collect()
    }
}
