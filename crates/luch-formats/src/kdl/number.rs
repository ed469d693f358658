//! Numbers, and words that are none.

use super::Value;
use super::scanner::{Broken, Scanner};

impl Scanner<'_> {
    /// What a run of identifier characters means.
    pub(super) fn word_or_number(&mut self, word: &str, start: usize) -> Result<Value, Broken> {
        let unsigned = word.strip_prefix(['+', '-']).unwrap_or(word);
        let digits = unsigned.strip_prefix('.').unwrap_or(unsigned);
        if digits.starts_with(|c: char| c.is_ascii_digit()) {
            let span = start..start + word.len();
            let help = "numbers look like 1, -2.5, 6.02e23 or 0xff; a name that begins with a digit stands in quotes";
            return number(word).ok_or_else(|| self.fail(span, format!("`{word}` is no number"), Some(help)));
        }
        if matches!(word, "true" | "false" | "null" | "inf" | "-inf" | "nan") {
            let span = start..start + word.len();
            return Err(self.fail(
                span,
                format!("`{word}` is written `#{word}`"),
                Some("or \"…\" if the word itself is meant"),
            ));
        }
        Ok(Value::Text(word.to_owned()))
    }
}

/// The value of a number as KDL writes it; integers too large for `i128` become floating point.
fn number(word: &str) -> Option<Value> {
    let (is_negative, unsigned) = match word.as_bytes().first()? {
        b'-' => (true, &word[1..]),
        b'+' => (false, &word[1..]),
        _ => (false, word),
    };
    for (mark, radix) in [("0x", 16), ("0o", 8), ("0b", 2)] {
        if let Some(digits) = unsigned.strip_prefix(mark) {
            return integer(digits, radix, is_negative);
        }
    }
    if let Some(value) = integer(unsigned, 10, is_negative) {
        return Some(value);
    }
    let (mantissa, exponent) = match unsigned.split_once(['e', 'E']) {
        Some((mantissa, exponent)) => (mantissa, Some(exponent.strip_prefix(['+', '-']).unwrap_or(exponent))),
        None => (unsigned, None),
    };
    let (whole, fraction) = match mantissa.split_once('.') {
        Some((whole, fraction)) => (whole, Some(fraction)),
        None => (mantissa, None),
    };
    let parts = [Some(whole), fraction, exponent];
    if !parts.into_iter().flatten().all(|digits| are_digits(digits, 10)) {
        return None;
    }
    word.replace('_', "").parse().ok().map(Value::Float)
}

fn integer(digits: &str, radix: u32, is_negative: bool) -> Option<Value> {
    if !are_digits(digits, radix) {
        return None;
    }
    let plain = digits.replace('_', "");
    match i128::from_str_radix(&plain, radix) {
        Ok(value) => Some(Value::Integer(if is_negative { -value } else { value })),
        Err(_) if radix == 10 => {
            plain.parse().ok().map(|v: f64| Value::Float(if is_negative { -v } else { v }))
        }
        Err(_) => None,
    }
}

/// Digits and, after the first of them, underscores.
fn are_digits(text: &str, radix: u32) -> bool {
    text.starts_with(|c: char| c.is_digit(radix)) && text.chars().all(|c| c == '_' || c.is_digit(radix))
}
