//! One page of HTML with everything in it: text, tables, figures, and the command that repeats it.
//!
//! ```
//! use luch_lab::report::{Report, Table};
//!
//! let report = Report::new("π by points")
//!     .with_command("luch lab pi --samples 1000")
//!     .text("Points that fall into the disc.")
//!     .table(Table::new(["N", "estimate"]).row(["1000", "3.148"]));
//! assert!(report.to_html().contains("luch lab pi"));
//! ```

use crate::figure::{Depth, Figure, Sheet};
use luch_image::codec::{self, Metadata};
use luch_image::{Image, Rgb, tone::Tone};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::collections::BTreeMap;
use std::fmt::Write;

/// A page: a title, the command that repeats it, and sections.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// The title.
    pub title: String,
    /// What to type to make the page again.
    pub command: String,
    /// What stands on the page.
    pub sections: Vec<Section>,
    /// Numbers for other programs, by name; they stand in the JSON alone.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub data: BTreeMap<String, Value>,
}

/// A part of a page.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Section {
    /// A heading.
    Heading(String),
    /// A paragraph.
    Text(String),
    /// Lines whose spaces and breaks count.
    Preformatted(String),
    /// Rows of numbers.
    Table(Table),
    /// A figure.
    Figure(Figure),
    /// Figures side by side.
    Sheet(Sheet),
    /// Small pictures side by side.
    Pictures(Vec<Picture>),
}

/// A picture of pixels.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Picture {
    /// What it shows.
    pub caption: String,
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// A PNG in the letters of base 64 (RFC 4648).
    pub png: String,
}

impl Picture {
    /// Light as `tone` shows it.
    pub fn new(caption: impl Into<String>, light: &Image<Rgb>, tone: &Tone) -> Self {
        let bytes = codec::encode_png8(&tone.to_u8(light), &Metadata::new()).unwrap_or_default();
        Self { caption: caption.into(), width: light.width(), height: light.height(), png: base64(&bytes) }
    }
}

/// Bytes in the letters of base 64 (RFC 4648).
fn base64(bytes: &[u8]) -> String {
    const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut out = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for group in bytes.chunks(3) {
        let word =
            group.iter().enumerate().fold(0u32, |word, (at, &byte)| word | u32::from(byte) << (16 - 8 * at));
        for place in 0..4 {
            let letter = LETTERS[(word >> (18 - 6 * place) & 63) as usize];
            out.push(if place <= group.len() { char::from(letter) } else { '=' });
        }
    }
    out
}

/// Rows of texts under a heading.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Table {
    /// The names of the columns.
    pub head: Vec<String>,
    /// The rows; missing fields are empty.
    pub rows: Vec<Vec<String>>,
}

impl Table {
    /// A table without rows.
    pub fn new<S: Into<String>>(head: impl IntoIterator<Item = S>) -> Self {
        Self { head: head.into_iter().map(Into::into).collect(), rows: Vec::new() }
    }

    /// The same with one row more.
    #[must_use]
    pub fn row<S: Into<String>>(mut self, row: impl IntoIterator<Item = S>) -> Self {
        self.rows.push(row.into_iter().map(Into::into).collect());
        self
    }

    /// The table as lines of text with columns below each other; numbers stand to the right.
    pub fn to_text(&self) -> String {
        let columns = self.rows.iter().map(Vec::len).chain([self.head.len()]).max().unwrap_or(0);
        let field = |row: &[String], at: usize| row.get(at).cloned().unwrap_or_default();
        let widths: Vec<usize> = (0..columns)
            .map(|at| {
                let rows = self.rows.iter().map(|row| field(row, at).chars().count());
                rows.chain([field(&self.head, at).chars().count()]).max().unwrap_or(0)
            })
            .collect();
        let mut out = String::new();
        for row in std::iter::once(&self.head).chain(&self.rows) {
            let mut line = String::new();
            for (at, width) in widths.iter().enumerate() {
                let text = field(row, at);
                let blank = " ".repeat(width - text.chars().count());
                let is_left = !self.rows.iter().any(|row| is_number(&field(row, at)));
                let _ =
                    if is_left { write!(line, "{text}{blank}  ") } else { write!(line, "{blank}{text}  ") };
            }
            let _ = writeln!(out, "{}", line.trim_end());
        }
        out
    }
}

/// Whether a field is aligned as a number.
fn is_number(text: &str) -> bool {
    text.starts_with(|c: char| c.is_ascii_digit() || matches!(c, '-' | '−' | '+' | '.' | '±'))
}

impl Report {
    /// A page without sections.
    pub fn new(title: impl Into<String>) -> Self {
        Self { title: title.into(), ..Self::default() }
    }

    /// The same with the command that repeats it.
    #[must_use]
    pub fn with_command(mut self, command: impl Into<String>) -> Self {
        self.command = command.into();
        self
    }

    /// The same with a section more.
    #[must_use]
    pub fn with(mut self, section: Section) -> Self {
        self.sections.push(section);
        self
    }

    /// The same with a heading more.
    #[must_use]
    pub fn heading(self, text: impl Into<String>) -> Self {
        self.with(Section::Heading(text.into()))
    }

    /// The same with a paragraph more.
    #[must_use]
    pub fn text(self, text: impl Into<String>) -> Self {
        self.with(Section::Text(text.into()))
    }

    /// The same with lines more whose spaces and breaks count.
    #[must_use]
    pub fn preformatted(self, text: impl Into<String>) -> Self {
        self.with(Section::Preformatted(text.into()))
    }

    /// The same with a table more.
    #[must_use]
    pub fn table(self, table: Table) -> Self {
        self.with(Section::Table(table))
    }

    /// The same with a figure more.
    #[must_use]
    pub fn figure(self, figure: Figure) -> Self {
        self.with(Section::Figure(figure))
    }

    /// The same with a sheet more.
    #[must_use]
    pub fn sheet(self, sheet: Sheet) -> Self {
        self.with(Section::Sheet(sheet))
    }

    /// The same with a row of pictures more.
    #[must_use]
    pub fn pictures(self, pictures: Vec<Picture>) -> Self {
        self.with(Section::Pictures(pictures))
    }

    /// The same with numbers for other programs.
    #[must_use]
    pub fn with_data(mut self, name: impl Into<String>, data: Value) -> Self {
        self.data.insert(name.into(), data);
        self
    }

    /// The page; it loads nothing from anywhere and follows the reader's light or dark theme.
    pub fn to_html(&self) -> String {
        let title = escaped(&self.title);
        let mut out = format!(
            "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" content=\"width=device-width\"><title>{title}</title>\n<style>{STYLE}</style></head><body>\n<h1>{title}</h1>\n"
        );
        for section in &self.sections {
            let _ = match section {
                Section::Heading(text) => writeln!(out, "<h2>{}</h2>", escaped(text)),
                Section::Text(text) => writeln!(out, "<p>{}</p>", escaped(text)),
                Section::Preformatted(text) => writeln!(out, "<pre>{}</pre>", escaped(text)),
                Section::Table(table) => writeln!(out, "{}", html_of(table)),
                Section::Figure(figure) => writeln!(out, "<figure>{}</figure>", figure.to_svg()),
                Section::Sheet(sheet) => writeln!(out, "<figure class=\"wide\">{}</figure>", sheet.to_svg()),
                Section::Pictures(pictures) => {
                    writeln!(out, "<div class=\"pictures\">{}</div>", html_of_pictures(pictures))
                }
            };
        }
        if !self.command.is_empty() {
            let _ = writeln!(out, "<h2>Again</h2>\n<pre>{}</pre>", escaped(&self.command));
        }
        out.push_str("</body></html>\n");
        out
    }

    /// The page as lines of text.
    pub fn to_terminal(&self, columns: usize, depth: Depth) -> String {
        let mut out = format!("{}\n\n", self.title);
        for section in &self.sections {
            match section {
                Section::Heading(text) => out.push_str(&format!("\n{text}\n")),
                Section::Text(text) => out.push_str(&format!("{text}\n")),
                Section::Preformatted(text) => out.push_str(text),
                Section::Table(table) => out.push_str(&table.to_text()),
                Section::Figure(figure) => out.push_str(&figure.to_terminal(columns, depth)),
                Section::Sheet(sheet) => out.push_str(&sheet.to_terminal(columns, depth)),
                Section::Pictures(pictures) => {
                    out.push_str(&format!("{} pictures: see the page, -o x.html\n", pictures.len()));
                }
            }
            out.push('\n');
        }
        if !self.command.is_empty() {
            out.push_str(&format!("Again: {}\n", self.command));
        }
        out
    }

    /// The page as data: all numbers of all figures.
    pub fn to_json(&self) -> String {
        // Texts, lists and numbers only: nothing that could fail.
        serde_json::to_string(self).unwrap_or_default()
    }
}

const STYLE: &str = "\
:root{color-scheme:light dark}\
body{font:16px/1.55 system-ui,-apple-system,'Segoe UI',Roboto,sans-serif;max-width:46rem;margin:2.5rem auto;padding:0 1rem;color:#1b1f24;background:#fff}\
h1{font-size:1.7rem;line-height:1.2}h2{font-size:1.2rem;margin-top:2.2rem}\
figure{margin:1.5rem 0;overflow-x:auto}figure svg{max-width:100%;height:auto}\
table{border-collapse:collapse;font-variant-numeric:tabular-nums;margin:1rem 0;display:block;overflow-x:auto}\
.pictures{display:flex;flex-wrap:wrap;gap:1rem;margin:1rem 0}.pictures figure{margin:0;font-size:.85rem}\
.pictures img{display:block;max-width:100%;image-rendering:pixelated}\
th,td{padding:.25rem .8rem;border-bottom:1px solid #e6e9ed;text-align:left}td.n,th.n{text-align:right}\
pre{background:#f4f6f8;padding:.7rem 1rem;overflow-x:auto;border-radius:4px}\
@media(prefers-color-scheme:dark){body{color:#e8eaed;background:#16181d}th,td{border-color:#2e333b}pre{background:#1c1f25}}";

fn html_of_pictures(pictures: &[Picture]) -> String {
    let html = |picture: &Picture| {
        // Small ones twice as large: single pixels are to be seen.
        let scale = if picture.width <= 192 { 2 } else { 1 };
        let (width, height) = (u64::from(picture.width) * scale, u64::from(picture.height) * scale);
        let (caption, png) = (escaped(&picture.caption), escaped(&picture.png));
        format!(
            "<figure><img width=\"{width}\" height=\"{height}\" alt=\"{caption}\" src=\"data:image/png;base64,{png}\"><figcaption>{caption}</figcaption></figure>"
        )
    };
    pictures.iter().map(html).collect()
}

fn html_of(table: &Table) -> String {
    let class = |at: usize| {
        let holds = table.rows.iter().any(|row| row.get(at).is_some_and(|text| is_number(text)));
        if holds { " class=\"n\"" } else { "" }
    };
    let line = |row: &[String], tag: &str| {
        let fields = row.iter().enumerate();
        let fields = fields.map(|(at, text)| format!("<{tag}{}>{}</{tag}>", class(at), escaped(text)));
        format!("<tr>{}</tr>", fields.collect::<String>())
    };
    let rows: String = table.rows.iter().map(|row| line(row, "td") + "\n").collect();
    format!("<table><thead>{}</thead><tbody>\n{rows}</tbody></table>", line(&table.head, "th"))
}

fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            c if c.is_control() && c != '\n' => out.push('�'),
            c => out.push(c),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figure::Ink;

    #[test]
    fn pages_are_whole_and_safe() {
        let figure = Figure::new("f").line("", Ink::Blue, vec![[0.0, 0.0], [1.0, 1.0]]);
        let table = Table::new(["name", "<N>"]).row(["a", "1"]).row(["b"]);
        assert_eq!(table.to_text(), "name  <N>\na       1\nb\n");
        let report = Report::new("<script>")
            .with_command("luch lab x --density \"a & b\"")
            .heading("h")
            .text("t")
            .preformatted("a\n  <b")
            .table(table)
            .figure(figure.clone())
            .sheet(Sheet::new("s", 2, vec![figure.clone(), figure]));
        let html = report.to_html();
        assert!(!html.contains("<script") && !html.contains("http://") || html.matches("http").count() == 2);
        assert!(html.contains("<pre>a\n  &lt;b</pre>"));
        assert!(html.contains("a &amp; b") && html.contains("<svg") && html.ends_with("</html>\n"));
        assert!(!html.contains("src=") && !html.contains("@import"));
        assert!(report.to_terminal(60, Depth::Letters).contains("Again: luch lab x"));
        let back: Report = serde_json::from_str(&report.to_json()).unwrap();
        assert_eq!(back, report);
    }
    #[test]
    fn pictures_are_in_the_page() {
        assert_eq!(
            ["", "f", "fo", "foo", "foob"].map(|text| base64(text.as_bytes())),
            ["", "Zg==", "Zm8=", "Zm9v", "Zm9vYg=="]
        );
        let picture = Picture::new("a \"b\"", &Image::filled(3, 2, Rgb::WHITE), &Tone::default());
        let report =
            Report::new("p").pictures(vec![picture]).with_data("x", serde_json::json!({ "y": [1.5] }));
        let html = report.to_html();
        assert!(html.contains("src=\"data:image/png;base64,iVBORw0KGgo") && html.contains("a &quot;b&quot;"));
        assert!(report.to_terminal(60, Depth::Letters).contains("1 pictures"));
        assert_eq!(serde_json::from_str::<Report>(&report.to_json()).unwrap(), report);
    }
}
