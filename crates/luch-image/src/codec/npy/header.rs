//! The dictionary at the start of an array file.

use super::MAGIC;
use crate::codec::{DecodeError, Format};

/// Longest dictionary that is read; NumPy's own stay below 200 bytes for a picture.
const LONGEST: usize = 10_000;

/// Most sides an array may have before it is refused.
const MOST_SIDES: usize = 8;

/// How numbers are stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Number {
    F32Little,
    F32Big,
    F64Little,
    F64Big,
}

impl Number {
    const ALL: [Self; 4] = [Self::F32Little, Self::F32Big, Self::F64Little, Self::F64Big];

    /// As NumPy calls it.
    pub(super) fn descr(self) -> &'static str {
        match self {
            Self::F32Little => "<f4",
            Self::F32Big => ">f4",
            Self::F64Little => "<f8",
            Self::F64Big => ">f8",
        }
    }

    /// Bytes of one number.
    pub(super) fn bytes(self) -> usize {
        match self {
            Self::F32Little | Self::F32Big => 4,
            Self::F64Little | Self::F64Big => 8,
        }
    }

    /// One number of as many bytes; 0 for any other count.
    pub(super) fn read(self, bytes: &[u8]) -> f32 {
        let four = || bytes.try_into().unwrap_or_default();
        let eight = || bytes.try_into().unwrap_or_default();
        match self {
            Self::F32Little => f32::from_le_bytes(four()),
            Self::F32Big => f32::from_be_bytes(four()),
            Self::F64Little => f64::from_le_bytes(eight()) as f32,
            Self::F64Big => f64::from_be_bytes(eight()) as f32,
        }
    }
}

/// What an array file says about its numbers.
#[derive(Debug)]
pub(super) struct Header {
    pub(super) number: Number,
    pub(super) is_column_major: bool,
    pub(super) shape: Vec<u64>,
    /// Where the numbers begin.
    pub(super) end: usize,
}

impl Header {
    pub(super) fn read(bytes: &[u8]) -> Result<Self, DecodeError> {
        let short = || DecodeError::damaged_at(Format::Npy, bytes.len(), "the file ends inside its header");
        let rest = bytes
            .strip_prefix(MAGIC)
            .ok_or_else(|| DecodeError::damaged_at(Format::Npy, 0, "an array file starts with \\x93NUMPY"))?;
        let (start, length) = match rest {
            [1, _, a, b, ..] => (MAGIC.len() + 4, usize::from(u16::from_le_bytes([*a, *b]))),
            [2 | 3, _, a, b, c, d, ..] => (MAGIC.len() + 6, u32::from_le_bytes([*a, *b, *c, *d]) as usize),
            [] | [1..=3, ..] => return Err(short()),
            [version, ..] => {
                let what = format!("version {version} of the format; accepted are 1, 2 and 3");
                return Err(DecodeError::unsupported(Format::Npy, what));
            }
        };
        if length > LONGEST {
            let reason = format!("the header claims {length} bytes; at most {LONGEST} are read");
            return Err(DecodeError::damaged_at(Format::Npy, MAGIC.len() + 2, reason));
        }
        let end = start + length;
        let text = bytes.get(start..end).ok_or_else(short)?;
        Dictionary { text, at: 0, start }.header(end)
    }
}

/// A reader of the one kind of Python dictionary that array files have.
struct Dictionary<'a> {
    text: &'a [u8],
    at: usize,
    /// Where the text begins in the file.
    start: usize,
}

impl<'a> Dictionary<'a> {
    fn header(mut self, end: usize) -> Result<Header, DecodeError> {
        let (mut number, mut is_column_major, mut shape) = (None, None, None);
        self.expect(b'{')?;
        while !self.takes(b'}') {
            let place = self.place();
            let key = self.string()?;
            self.expect(b':')?;
            let is_new = match key {
                "descr" => number.replace(self.number()?).is_none(),
                "fortran_order" => is_column_major.replace(self.truth()?).is_none(),
                "shape" => shape.replace(self.shape()?).is_none(),
                _ => return Err(DecodeError::damaged_at(Format::Npy, place, format!("unknown key '{key}'"))),
            };
            if !is_new {
                return Err(DecodeError::damaged_at(Format::Npy, place, format!("'{key}' is there twice")));
            }
            if !self.takes(b',') {
                self.expect(b'}')?;
                break;
            }
        }
        self.skip_blanks();
        if self.at < self.text.len() {
            return Err(self.wrong("nothing after the dictionary"));
        }
        let missing = |key: &str| DecodeError::damaged_at(Format::Npy, end, format!("'{key}' is missing"));
        Ok(Header {
            number: number.ok_or_else(|| missing("descr"))?,
            is_column_major: is_column_major.ok_or_else(|| missing("fortran_order"))?,
            shape: shape.ok_or_else(|| missing("shape"))?,
            end,
        })
    }

    fn number(&mut self) -> Result<Number, DecodeError> {
        let name = self.string()?;
        Number::ALL.into_iter().find(|number| number.descr() == name).ok_or_else(|| {
            let accepted = Number::ALL.map(Number::descr).join(", ");
            let what = format!("an array with numbers of type '{name}' (accepted are {accepted})");
            DecodeError::unsupported(Format::Npy, what)
        })
    }

    fn truth(&mut self) -> Result<bool, DecodeError> {
        self.skip_blanks();
        for (word, value) in [("True", true), ("False", false)] {
            if self.text[self.at..].starts_with(word.as_bytes()) {
                self.at += word.len();
                return Ok(value);
            }
        }
        Err(self.wrong("True or False"))
    }

    fn shape(&mut self) -> Result<Vec<u64>, DecodeError> {
        self.expect(b'(')?;
        let mut sides = Vec::new();
        while !self.takes(b')') {
            if sides.len() == MOST_SIDES {
                return Err(self.wrong("at most eight sides"));
            }
            sides.push(self.whole()?);
            if !self.takes(b',') {
                self.expect(b')')?;
                break;
            }
        }
        Ok(sides)
    }

    fn whole(&mut self) -> Result<u64, DecodeError> {
        self.skip_blanks();
        let digits = self.text[self.at..].iter().take_while(|b| b.is_ascii_digit()).count();
        let text = str::from_utf8(&self.text[self.at..self.at + digits]).unwrap_or_default();
        let number = text.parse().map_err(|_| self.wrong("a whole number below 2⁶⁴"))?;
        self.at += digits;
        Ok(number)
    }

    /// What stands between quotes; no escapes.
    fn string(&mut self) -> Result<&'a str, DecodeError> {
        self.skip_blanks();
        let Some(&quote @ (b'\'' | b'"')) = self.text.get(self.at) else {
            return Err(self.wrong("a text in quotes"));
        };
        let rest = &self.text[self.at + 1..];
        let length = rest.iter().take_while(|&&b| b != quote && b.is_ascii_graphic()).count();
        if rest.get(length) != Some(&quote) {
            return Err(self.wrong("a text in quotes"));
        }
        self.at += length + 2;
        Ok(str::from_utf8(&rest[..length]).unwrap_or_default())
    }

    /// Takes a byte if it comes next.
    fn takes(&mut self, byte: u8) -> bool {
        self.skip_blanks();
        let comes = self.text.get(self.at) == Some(&byte);
        self.at += usize::from(comes);
        comes
    }

    fn expect(&mut self, byte: u8) -> Result<(), DecodeError> {
        if self.takes(byte) { Ok(()) } else { Err(self.wrong(&format!("'{}'", char::from(byte)))) }
    }

    fn skip_blanks(&mut self) {
        self.at += self.text[self.at..].iter().take_while(|b| b.is_ascii_whitespace()).count();
    }

    /// The next byte's place in the file.
    fn place(&mut self) -> usize {
        self.skip_blanks();
        self.start + self.at
    }

    fn wrong(&self, expected: &str) -> DecodeError {
        let found = match &self.text[self.at..] {
            [] => "its header ends".to_owned(),
            rest => format!("found \"{}\"", rest[..rest.len().min(12)].escape_ascii()),
        };
        DecodeError::damaged_at(Format::Npy, self.start + self.at, format!("expected {expected}, {found}"))
    }
}
