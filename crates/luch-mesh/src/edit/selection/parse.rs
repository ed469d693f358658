//! Rules from text.

use glam::DVec3;

use super::Selection;
use crate::edit::Field;

/// What is wrong with the text of a rule, and where.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("column {column}: {message}")]
pub struct SelectionError {
    /// The character it is about, counted from 1.
    pub column: usize,
    /// What is wrong, and what would be right.
    pub message: String,
}

/// How deep rules may stand in one another.
const MOST_DEPTH: usize = 64;

const NAMES: &str = "all, none, faces, vertices, edges, box, sphere, normal, component, material, border, sharp, creased, \
                     corners, where, grow, shrink, not or (";

pub(super) fn parse(text: &str) -> Result<Selection, SelectionError> {
    let letters: Vec<char> = text.chars().collect();
    let mut reader = Reader { letters: &letters, at: 0, depth: 0 };
    let rule = reader.any_of()?;
    reader.skip_space();
    if reader.at < letters.len() {
        return Err(reader.wrong("`and`, `or` or the end"));
    }
    Ok(rule)
}

struct Reader<'a> {
    letters: &'a [char],
    at: usize,
    depth: usize,
}

impl Reader<'_> {
    fn any_of(&mut self) -> Result<Selection, SelectionError> {
        self.joined("or", Self::all_of, Selection::Or)
    }

    fn all_of(&mut self) -> Result<Selection, SelectionError> {
        self.joined("and", Self::one, Selection::And)
    }

    fn joined(
        &mut self,
        word: &str,
        part: fn(&mut Self) -> Result<Selection, SelectionError>,
        join: fn(Vec<Selection>) -> Selection,
    ) -> Result<Selection, SelectionError> {
        let first = part(self)?;
        let mut rest = Vec::new();
        while self.take_word(word) {
            rest.push(part(self)?);
        }
        if rest.is_empty() {
            return Ok(first);
        }
        rest.insert(0, first);
        Ok(join(rest))
    }

    fn one(&mut self) -> Result<Selection, SelectionError> {
        self.depth += 1;
        if self.depth > MOST_DEPTH {
            return Err(
                self.error(self.at, format!("rules stand more than {MOST_DEPTH} deep in one another"))
            );
        }
        let rule = self.shallow();
        self.depth -= 1;
        rule
    }

    fn shallow(&mut self) -> Result<Selection, SelectionError> {
        if self.take('(') {
            let rule = self.any_of()?;
            self.expect(')')?;
            return Ok(rule);
        }
        let start = self.at;
        let word = self.word();
        match word.as_str() {
            "not" => return Ok(Selection::Not(Box::new(self.one()?))),
            "all" => return Ok(Selection::All),
            "none" => return Ok(Selection::None),
            "border" => return Ok(Selection::Border),
            "creased" => return Ok(Selection::Creased),
            "faces" | "vertices" | "edges" | "box" | "sphere" | "normal" | "component" | "material"
            | "sharp" | "corners" | "where" | "grow" | "shrink" => {}
            _ => {
                self.at = start;
                return Err(self.wrong(NAMES));
            }
        }
        self.expect('(')?;
        let rule = match word.as_str() {
            "faces" => Selection::Faces(self.ranges(false)?),
            "vertices" => Selection::Vertices(self.ranges(false)?),
            "edges" => Selection::Edges(self.ranges(true)?),
            "corners" => Selection::Corners(self.range(false)?),
            "box" => {
                let one = self.vector()?;
                self.expect(',')?;
                let other = self.vector()?;
                Selection::Box { low: one.min(other), high: one.max(other) }
            }
            "sphere" => {
                let center = self.vector()?;
                self.expect(',')?;
                Selection::Sphere { center, radius: self.number()? }
            }
            "normal" => {
                let direction = self.vector()?;
                self.expect(',')?;
                Selection::Normal { direction, angle: self.angle()? }
            }
            "component" => Selection::Component(self.count()?),
            "material" => {
                let at = self.at;
                let slot = self.count()?;
                let slot = u16::try_from(slot);
                Selection::Material(slot.map_err(|_| self.error(at, "slots go up to 65535".into()))?)
            }
            "where" => Selection::Where(self.formula()?),
            "sharp" => Selection::Sharp(self.angle()?),
            word => {
                let rule = Box::new(self.any_of()?);
                self.expect(',')?;
                let times = self.count()?;
                if word == "grow" { Selection::Grow(rule, times) } else { Selection::Shrink(rule, times) }
            }
        };
        self.expect(')')?;
        Ok(rule)
    }

    /// Numbers and ranges, by commas; none at all before a `)`.
    fn ranges(&mut self, pairs: bool) -> Result<Vec<[u32; 2]>, SelectionError> {
        let mut ranges = Vec::new();
        if self.peek() == Some(')') {
            return Ok(ranges);
        }
        loop {
            ranges.push(self.range(pairs)?);
            if !self.take(',') {
                return Ok(ranges);
            }
        }
    }

    fn range(&mut self, pair: bool) -> Result<[u32; 2], SelectionError> {
        let first = self.count()?;
        if pair {
            self.expect('-')?;
        } else if !self.take('-') {
            return Ok([first; 2]);
        }
        Ok([first, self.count()?])
    }

    /// All up to the parenthesis that closes the rule.
    fn formula(&mut self) -> Result<Field, SelectionError> {
        let (start, mut depth) = (self.at, 0);
        while let Some(&letter) = self.letters.get(self.at) {
            match letter {
                '(' => depth += 1,
                ')' if depth == 0 => break,
                ')' => depth -= 1,
                _ => {}
            }
            self.at += 1;
        }
        let text: String = self.letters[start..self.at].iter().collect();
        Field::parse(&text).map_err(|error| {
            // Characters before the place that is meant; a formula may have several lines.
            let before = text[..error.span().start].chars().count();
            self.error(start + before, error.message())
        })
    }

    fn vector(&mut self) -> Result<DVec3, SelectionError> {
        let x = self.number()?;
        self.expect(',')?;
        let y = self.number()?;
        self.expect(',')?;
        Ok(DVec3::new(x, y, self.number()?))
    }

    fn count(&mut self) -> Result<u32, SelectionError> {
        self.skip_space();
        let start = self.at;
        while self.letters.get(self.at).is_some_and(char::is_ascii_digit) {
            self.at += 1;
        }
        let digits: String = self.letters[start..self.at].iter().collect();
        digits.parse().map_err(|_| {
            self.at = start;
            self.wrong("a whole number")
        })
    }

    fn number(&mut self) -> Result<f64, SelectionError> {
        self.skip_space();
        let start = self.at;
        let mut previous = ' ';
        while let Some(&letter) = self.letters.get(self.at) {
            let is_sign = matches!(letter, '+' | '-') && (self.at == start || matches!(previous, 'e' | 'E'));
            // An exponent has digits or a sign behind it; other letters are units.
            let is_exponent = matches!(letter, 'e' | 'E')
                && self.at > start
                && self
                    .letters
                    .get(self.at + 1)
                    .is_some_and(|c| c.is_ascii_digit() || matches!(c, '+' | '-'));
            if !(letter.is_ascii_digit() || letter == '.' || is_sign || is_exponent) {
                break;
            }
            previous = letter;
            self.at += 1;
        }
        let digits: String = self.letters[start..self.at].iter().collect();
        digits.parse().ok().filter(|number: &f64| number.is_finite()).ok_or_else(|| {
            self.at = start;
            self.wrong("a number")
        })
    }

    fn angle(&mut self) -> Result<f64, SelectionError> {
        let number = self.number()?;
        let at = self.at;
        let degree = std::f64::consts::PI / 180.0;
        let unit = if self.take('°') { "deg".into() } else { self.word() };
        match unit.as_str() {
            "" | "deg" => Ok(number * degree),
            "rad" => Ok(number),
            "turn" => Ok(number * std::f64::consts::TAU),
            _ => {
                self.at = at;
                Err(self.wrong("`deg`, `rad` or `turn`"))
            }
        }
    }

    fn skip_space(&mut self) {
        while self.letters.get(self.at).is_some_and(|letter| letter.is_whitespace()) {
            self.at += 1;
        }
    }

    fn peek(&mut self) -> Option<char> {
        self.skip_space();
        self.letters.get(self.at).copied()
    }

    fn take(&mut self, letter: char) -> bool {
        let found = self.peek() == Some(letter);
        self.at += usize::from(found);
        found
    }

    fn expect(&mut self, letter: char) -> Result<(), SelectionError> {
        if self.take(letter) { Ok(()) } else { Err(self.wrong(&format!("`{letter}`"))) }
    }

    /// Letters only.
    fn word(&mut self) -> String {
        self.skip_space();
        let rest = &self.letters[self.at..];
        let word: String = rest.iter().take_while(|letter| letter.is_ascii_alphabetic()).collect();
        self.at += word.len();
        word
    }

    fn take_word(&mut self, word: &str) -> bool {
        let start = self.at;
        let found = self.word() == word;
        if !found {
            self.at = start;
        }
        found
    }

    fn error(&self, at: usize, message: String) -> SelectionError {
        SelectionError { column: at + 1, message }
    }

    fn wrong(&mut self, expected: &str) -> SelectionError {
        self.skip_space();
        let rest = &self.letters[self.at..];
        let length = rest.iter().take_while(|letter| letter.is_alphanumeric()).count().clamp(1, 20);
        let found: String = rest.iter().take(length).collect();
        let found = if found.is_empty() { "the end".into() } else { format!("“{found}”") };
        self.error(self.at, format!("found {found}, expected {expected}"))
    }
}
