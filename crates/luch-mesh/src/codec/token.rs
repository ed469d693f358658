//! Words and numbers of text formats.

/// Splits off the first word of a line: what stands before the next white space, and the rest without leading space.
pub(crate) fn split_word(line: &[u8]) -> (&[u8], &[u8]) {
    let line = line.trim_ascii_start();
    let end = line.iter().position(u8::is_ascii_whitespace).unwrap_or(line.len());
    let (word, rest) = line.split_at(end);
    (word, rest.trim_ascii_start())
}

/// The words of a line.
pub(crate) fn words(line: &[u8]) -> impl Iterator<Item = &[u8]> {
    line.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty())
}

/// A number in any of the usual forms, correctly rounded: `1`, `-.5`, `+3.e-007`, `nan`, `inf`, and the spellings
/// `1.#IND`, `1.#QNAN` and `1.#INF` of older C libraries.
pub(crate) fn parse_f32(word: &[u8]) -> Option<f32> {
    let text = std::str::from_utf8(word).ok()?;
    if let Ok(number) = text.parse() {
        return Some(number);
    }
    let magnitude = text.trim_start_matches(['+', '-']);
    let (digits, name) = magnitude.split_once('#')?;
    if !digits.starts_with("1.") || text.len() > magnitude.len() + 1 {
        return None;
    }
    let sign = if text.starts_with('-') { -1.0 } else { 1.0 };
    match name.trim_end_matches('0') {
        "INF" => Some(sign * f32::INFINITY),
        "IND" | "QNAN" | "SNAN" | "NAN" => Some(f32::NAN),
        _ => None,
    }
}

/// A whole number, with or without sign.
pub(crate) fn parse_i64(word: &[u8]) -> Option<i64> {
    let (digits, negative) = match word {
        [b'-', digits @ ..] => (digits, true),
        [b'+', digits @ ..] => (digits, false),
        _ => (word, false),
    };
    if digits.is_empty() || digits.len() > 18 {
        return None;
    }
    let mut value = 0i64;
    for digit in digits {
        if !digit.is_ascii_digit() {
            return None;
        }
        value = value * 10 + i64::from(digit - b'0');
    }
    Some(if negative { -value } else { value })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_in_every_spelling() {
        let good: [(&str, f32); 9] = [
            ("1", 1.0),
            ("-.5", -0.5),
            ("+3.", 3.0),
            (".8e-001", 0.08),
            ("-.7E+02", -70.0),
            ("inf", f32::INFINITY),
            ("-1.#INF", f32::NEG_INFINITY),
            ("1.#INF00", f32::INFINITY),
            ("1e99", f32::INFINITY),
        ];
        for (text, value) in good {
            assert_eq!(parse_f32(text.as_bytes()), Some(value), "{text}");
        }
        for text in ["nan", "-nan", "1.#IND", "-1.#IND", "1.#QNAN"] {
            assert!(parse_f32(text.as_bytes()).is_some_and(f32::is_nan), "{text}");
        }
        for text in ["", "a", "1,5", "--1", "1.0.0", "0x10", "1.#", "#INF", "--1.#INF"] {
            assert_eq!(parse_f32(text.as_bytes()), None, "{text}");
        }
    }

    #[test]
    fn whole_numbers_do_not_overflow() {
        assert_eq!(parse_i64(b"-12"), Some(-12));
        assert_eq!(parse_i64(b"+007"), Some(7));
        assert_eq!(parse_i64(b"999999999999999999"), Some(999_999_999_999_999_999));
        for text in ["", "-", "1.5", "1234567890123456789", "12a"] {
            assert_eq!(parse_i64(text.as_bytes()), None, "{text}");
        }
    }
}
