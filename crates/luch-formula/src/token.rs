//! The pieces of a formula.

use crate::error::{FormulaError, FormulaErrorKind};
use std::ops::Range;

/// A piece.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Piece {
    Number(f64),
    Name,
    Plus,
    Minus,
    Times,
    Over,
    Power,
    Open,
    Close,
    Comma,
    Semicolon,
    Assign,
    Less,
    LessOrEqual,
    Greater,
    GreaterOrEqual,
    Equal,
    NotEqual,
    End,
}

/// A piece and where it stands.
#[derive(Clone, Debug)]
pub(crate) struct Token {
    pub(crate) piece: Piece,
    pub(crate) span: Range<usize>,
}

/// Cuts a text into pieces; the last is the end.
pub(crate) fn tokens(text: &str) -> Result<Vec<Token>, FormulaError> {
    let mut found = Vec::new();
    let mut at = 0;
    while let Some(character) = text[at..].chars().next() {
        let rest = &text[at..];
        let mut length = character.len_utf8();
        let piece = match character {
            _ if character.is_whitespace() => {
                at += length;
                continue;
            }
            '0'..='9' | '.' => {
                length = number_length(rest);
                let digits = &rest[..length];
                let bad = || {
                    let kind = FormulaErrorKind::BadNumber { text: digits.to_owned() };
                    FormulaError::new(kind, at..at + length, text)
                };
                if digits.matches('.').count() > 1 || !digits.contains(|digit: char| digit.is_ascii_digit()) {
                    return Err(bad());
                }
                Piece::Number(digits.parse().map_err(|_| bad())?)
            }
            _ if character.is_alphabetic() || character == '_' => {
                length = name_length(rest);
                Piece::Name
            }
            '+' => Piece::Plus,
            '-' | '−' => Piece::Minus,
            '*' if rest.starts_with("**") => {
                return Err(unknown(text, at, 2, "write ^ for a power"));
            }
            '*' | '·' | '×' => Piece::Times,
            '/' => Piece::Over,
            '^' => Piece::Power,
            '(' => Piece::Open,
            ')' => Piece::Close,
            ',' => Piece::Comma,
            ';' => Piece::Semicolon,
            '≤' => Piece::LessOrEqual,
            '≥' => Piece::GreaterOrEqual,
            '≠' => Piece::NotEqual,
            '<' | '>' | '=' | '!' if rest[1..].starts_with('=') => {
                length = 2;
                match character {
                    '<' => Piece::LessOrEqual,
                    '>' => Piece::GreaterOrEqual,
                    '=' => Piece::Equal,
                    _ => Piece::NotEqual,
                }
            }
            '<' => Piece::Less,
            '>' => Piece::Greater,
            '=' => Piece::Assign,
            '!' => return Err(unknown(text, at, 1, "write not, or gamma(n + 1) for a factorial")),
            '&' => return Err(unknown(text, at, doubled(rest), "write and")),
            '|' => return Err(unknown(text, at, doubled(rest), "write or, or abs(x)")),
            '%' => return Err(unknown(text, at, 1, "write mod(a, b)")),
            '[' | '{' => return Err(unknown(text, at, 1, "write (")),
            ']' | '}' => return Err(unknown(text, at, 1, "write )")),
            '²' => return Err(unknown(text, at, length, "write ^2")),
            '³' => return Err(unknown(text, at, length, "write ^3")),
            '√' => return Err(unknown(text, at, length, "write sqrt(x)")),
            _ => return Err(unknown(text, at, length, "")),
        };
        found.push(Token { piece, span: at..at + length });
        at += length;
    }
    found.push(Token { piece: Piece::End, span: at..at });
    Ok(found)
}

/// The length of a sign that may stand twice.
fn doubled(rest: &str) -> usize {
    let mut characters = rest.bytes();
    1 + usize::from(characters.next() == characters.next())
}

fn unknown(text: &str, at: usize, length: usize, hint: &str) -> FormulaError {
    let found = text[at..at + length].escape_debug().to_string();
    FormulaError::new(
        FormulaErrorKind::UnknownCharacter { found, hint: hint.to_owned() },
        at..at + length,
        text,
    )
}

/// Digits and points, and an exponent if digits follow it.
fn number_length(text: &str) -> usize {
    let bytes = text.as_bytes();
    let digits = |from: usize, also: &[u8]| {
        bytes[from..].iter().take_while(|byte| byte.is_ascii_digit() || also.contains(byte)).count()
    };
    let mantissa = digits(0, b".");
    if matches!(bytes.get(mantissa), Some(b'e' | b'E')) {
        let sign = usize::from(matches!(bytes.get(mantissa + 1), Some(b'+' | b'-')));
        let exponent = digits((mantissa + 1 + sign).min(bytes.len()), b"");
        if exponent > 0 {
            return mantissa + 1 + sign + exponent;
        }
    }
    mantissa
}

/// The length of the name at the start of a text: letters, digits 0 to 9 and underscores.
fn name_length(text: &str) -> usize {
    text.find(|character: char| {
        !(character.is_alphabetic() || character.is_ascii_digit() || character == '_')
    })
    .unwrap_or(text.len())
}

/// Whether a text is a name from end to end.
pub(crate) fn is_name(text: &str) -> bool {
    text.starts_with(|character: char| character.is_alphabetic() || character == '_')
        && name_length(text) == text.len()
}
