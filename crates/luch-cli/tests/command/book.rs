//! The book in `docs/montecarlo`: its commands run, its figures are those that they draw, its links lead somewhere.

use crate::workplace::{Said, Workplace};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// Where the book stands, seen from the root of the repository.
const BOOK: &str = "docs/montecarlo";
/// The remark behind a command of the book that refuses an interval, which is its lesson, and ends with status 1.
const REFUSES: &str = "no interval";

struct Page {
    name: String,
    text: String,
}

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(BOOK)
}

fn pages() -> Vec<Page> {
    let entries = std::fs::read_dir(folder()).unwrap().map(|entry| entry.unwrap().path());
    let mut files: Vec<_> = entries.filter(|path| path.extension().is_some_and(|end| end == "md")).collect();
    files.sort();
    let page = |path: &PathBuf| Page {
        name: path.file_name().unwrap().to_str().unwrap().to_owned(),
        text: std::fs::read_to_string(path).unwrap(),
    };
    files.iter().map(page).collect()
}

impl Page {
    /// The lines of all blocks that are marked as `sh`.
    fn commands(&self) -> Vec<&str> {
        let mut lines = Vec::new();
        let mut block = None;
        for line in self.text.lines().map(str::trim) {
            match (line.strip_prefix("```"), block) {
                (Some(language), None) => block = Some(language),
                (Some(_), Some(_)) => block = None,
                (None, Some("sh")) if !line.is_empty() => lines.push(line),
                (None, _) => (),
            }
        }
        assert_eq!(block, None, "{}: a block is not closed", self.name);
        lines
    }

    /// Where the links and pictures of the page point to.
    fn links(&self) -> impl Iterator<Item = &str> {
        self.text.split("](").skip(1).filter_map(|rest| rest.split_once(')')).map(|(target, _)| target)
    }
}

/// The words of a command as a shell would see them, with nothing but single quotes around whole words.
fn words(line: &str) -> Vec<&str> {
    let parts = line.split('\'').enumerate();
    parts
        .flat_map(|(index, part)| match index % 2 {
            0 => part.split_whitespace().collect(),
            _ => vec![part],
        })
        .collect()
}

fn run(place: &Workplace, line: &str) -> Said {
    let words = words(line);
    assert_eq!(
        &words[..2],
        &["luch", "lab"],
        "a block of `sh` holds commands of the laboratory only: {line}"
    );
    let mut command = Command::new(env!("CARGO_BIN_EXE_luch"));
    command.current_dir(place.path("")).args(&words[1..]).stdin(Stdio::null());
    Said::of(command.output().unwrap())
}

#[test]
fn every_command_of_the_book_runs_and_draws_its_figures() {
    // The commands write below the root of the repository; here the root is an empty folder.
    let place = Workplace::empty();
    let figures = format!("{BOOK}/figures");
    std::fs::create_dir_all(place.path(&figures)).unwrap();
    let pages = pages();
    let lines: BTreeSet<&str> = pages.iter().flat_map(Page::commands).collect();
    assert!(lines.len() > 40, "{} commands", lines.len());
    for line in lines {
        let (command, remark) = line.split_once(" # ").unwrap_or((line, ""));
        let said = run(&place, command);
        assert_eq!(said.code, Some(i32::from(remark == REFUSES)), "{line}\n{}{}", said.out, said.err);
    }
    for page in &pages {
        for figure in page.links().filter(|target| target.starts_with("figures/")) {
            let made = place.path(&format!("{BOOK}/{figure}"));
            assert!(made.is_file(), "{}: no command of the book draws {figure}", page.name);
        }
    }
    // Nothing lies there that no command draws any more.
    let drawn: BTreeSet<_> = names(&place.path(&figures));
    assert_eq!(names(&folder().join("figures")), drawn);
}

fn names(folder: &Path) -> BTreeSet<String> {
    let entries = std::fs::read_dir(folder).unwrap();
    entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect()
}

#[test]
fn every_link_of_the_book_leads_somewhere() {
    let pages = pages();
    for page in &pages {
        for target in page.links().filter(|target| !target.starts_with("https://")) {
            let file = target.split('#').next().unwrap();
            assert!(folder().join(file).is_file(), "{}: {target}", page.name);
        }
    }
    let contents: BTreeSet<&str> =
        pages.iter().find(|page| page.name == "README.md").unwrap().links().collect();
    for page in pages.iter().filter(|page| page.name != "README.md") {
        assert!(contents.contains(page.name.as_str()), "{} is not in the contents", page.name);
        assert!(page.links().any(|target| target == "README.md"), "{} does not lead back", page.name);
    }
}
