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
    if let Some(number) = parse_plain(word) {
        return Some(number);
    }
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

/// Powers of ten that a double holds exactly.
const POWERS: [f64; 23] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18,
    1e19, 1e20, 1e21, 1e22,
];

/// A number of up to 15 digits with a small exponent, or `None` if it is anything else or its last bit needs more care.
///
/// Digits and power are exact in double precision, so their product or quotient is rounded once (Clinger, "How to read
/// floating point numbers accurately", 1990). The second rounding, to `f32`, is the right one unless the double lies
/// halfway between two of them.
fn parse_plain(word: &[u8]) -> Option<f32> {
    let (is_negative, mut rest) = match word {
        [b'-', rest @ ..] => (true, rest),
        [b'+', rest @ ..] => (false, rest),
        _ => (false, word),
    };
    if rest.len() > 24 {
        return None;
    }
    let (mut digits, mut count, mut exponent) = (0u64, 0u32, 0i32);
    let mut is_fraction = false;
    while let [byte, after @ ..] = rest {
        let digit = byte.wrapping_sub(b'0');
        if digit < 10 {
            digits = digits.wrapping_mul(10).wrapping_add(u64::from(digit));
            // Leading zeros are no digits.
            count += u32::from(digits != 0);
            exponent -= i32::from(is_fraction);
        } else if *byte == b'.' && !is_fraction {
            is_fraction = true;
        } else {
            break;
        }
        rest = after;
    }
    // A lone sign or point is no number; the slow path says so.
    if count == 0 || count > 15 {
        return None;
    }
    if let [b'e' | b'E', after @ ..] = rest {
        if after.len() > 4 {
            return None;
        }
        exponent += parse_i64(after)? as i32;
    } else if !rest.is_empty() {
        return None;
    }
    let power = *POWERS.get(exponent.unsigned_abs() as usize)?;
    let double = if exponent < 0 { digits as f64 / power } else { digits as f64 * power };
    const HALFWAY: u64 = 1 << 28;
    if double.to_bits() & (2 * HALFWAY - 1) == HALFWAY || double < f64::from(f32::MIN_POSITIVE) {
        return None;
    }
    let number = double as f32;
    Some(if is_negative { -number } else { number })
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
    fn the_short_way_rounds_like_the_long_one() {
        // 16777217 and its like lie halfway between two singles.
        let halfway =
            ["16777217", "33554434.0", "0.000000059604644775390625", "16777217.0000001", "8388608.5"];
        for text in halfway {
            assert_eq!(parse_f32(text.as_bytes()), text.parse().ok(), "{text}");
        }
        let mut state = 1u64;
        for _ in 0..200_000 {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            let number = f32::from_bits((state >> 32) as u32);
            if number.is_finite() {
                for text in [format!("{number}"), format!("{number:e}"), format!("{number:.9e}")] {
                    let read = parse_f32(text.as_bytes()).map(f32::to_bits);
                    assert_eq!(read, text.parse::<f32>().ok().map(f32::to_bits), "{text}");
                }
            }
            let text = format!("{}.{}", state >> 44, (state >> 20) & 0xff_ffff);
            assert_eq!(parse_f32(text.as_bytes()), text.parse().ok(), "{text}");
        }
        assert_eq!(parse_f32(b"-0").map(f32::to_bits), Some((-0.0f32).to_bits()));
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
