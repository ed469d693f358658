//! What an "uri" means: data inside the text, or a file beside the document.

use super::json::{Json, short};
use crate::{Files, Problem};
use std::path::{Path, PathBuf};

/// Where the bytes are.
#[derive(Debug, PartialEq)]
pub(super) enum Target {
    /// In the text itself, decoded.
    Data(Vec<u8>),
    /// In files beside the document: the name with its percent escapes decoded, then the name as it stands.
    File([PathBuf; 2]),
}

/// Resolves an "uri" of the document in `file`.
pub(super) fn resolve(uri: &Json, file: &Path) -> Result<Target, Problem> {
    let text = uri.text()?;
    if let Some(data) = text.strip_prefix("data:") {
        return decode_data(data).map(Target::Data).map_err(|message| uri.problem(message));
    }
    let scheme = text.split(['/', '\\', '?', '#']).next().filter(|first| first.contains(':'));
    if scheme.is_some() || text.starts_with(['/', '\\']) {
        let message = format!("\"{}\" is no relative path; relative paths and data: are read", short(text));
        return Err(uri.problem(message));
    }
    if text.is_empty() || text.contains('\0') {
        return Err(uri.problem(format!("\"{}\" is no file name", short(text))));
    }
    let decoded = String::from_utf8(percent_decode(text)).unwrap_or_else(|_| text.to_owned());
    Ok(Target::File([decoded.as_str(), text].map(|name| Files::beside(file, name))))
}

/// The first of the two names that exists; the decoded one if none does.
pub(super) fn existing<'a>([decoded, plain]: &'a [PathBuf; 2], files: &Files) -> &'a Path {
    if !files.has(decoded) && files.has(plain) { plain } else { decoded }
}

/// RFC 2397: `[media type][;base64],data`, without the leading `data:`.
fn decode_data(text: &str) -> Result<Vec<u8>, String> {
    let (head, data) = text.split_once(',').ok_or("a data: URI without a comma")?;
    if head.ends_with(";base64") { decode_base64(data.as_bytes()) } else { Ok(percent_decode(data)) }
}

/// RFC 4648, sections 4 and 5: both alphabets, padding optional.
fn decode_base64(text: &[u8]) -> Result<Vec<u8>, String> {
    let padding = text.iter().rev().take(2).take_while(|&&byte| byte == b'=').count();
    let digits = &text[..text.len() - padding];
    let mut bytes = Vec::with_capacity(digits.len() / 4 * 3 + 2);
    let (mut bits, mut held) = (0_u32, 0);
    for (place, &byte) in digits.iter().enumerate() {
        let digit = match byte {
            b'A'..=b'Z' => byte - b'A',
            b'a'..=b'z' => byte - b'a' + 26,
            b'0'..=b'9' => byte - b'0' + 52,
            b'+' | b'-' => 62,
            b'/' | b'_' => 63,
            _ => return Err(format!("character {place} of the base64 data is '{}'", byte.escape_ascii())),
        };
        bits = bits << 6 | u32::from(digit);
        held += 6;
        if held >= 8 {
            held -= 8;
            bytes.push((bits >> held) as u8);
            bits &= (1 << held) - 1;
        }
    }
    // Six bits left over are a lone digit, which codes nothing.
    if held == 6 { Err("the base64 data is cut short".into()) } else { Ok(bytes) }
}

/// RFC 3986, section 2.1; a percent sign without two digits stands for itself.
fn percent_decode(text: &str) -> Vec<u8> {
    let bytes = text.as_bytes();
    let digit = |at: usize| bytes.get(at).and_then(|&byte| (byte as char).to_digit(16));
    let mut decoded = Vec::with_capacity(bytes.len());
    let mut at = 0;
    while at < bytes.len() {
        match (bytes[at], digit(at + 1), digit(at + 2)) {
            (b'%', Some(high), Some(low)) => {
                decoded.push((high * 16 + low) as u8);
                at += 3;
            }
            (byte, ..) => {
                decoded.push(byte);
                at += 1;
            }
        }
    }
    decoded
}

#[cfg(test)]
mod tests {
    use super::{decode_base64, decode_data, percent_decode};

    #[test]
    fn rfc_4648_vectors() {
        let vectors = [("", ""), ("Zg==", "f"), ("Zm8=", "fo"), ("Zm9v", "foo"), ("Zm9vYg==", "foob")];
        for (text, bytes) in vectors.into_iter().chain([("Zm9vYmE=", "fooba"), ("Zm9vYmFy", "foobar")]) {
            assert_eq!(decode_base64(text.as_bytes()), Ok(bytes.as_bytes().to_vec()));
            assert_eq!(decode_base64(text.trim_end_matches('=').as_bytes()), Ok(bytes.as_bytes().to_vec()));
        }
        assert_eq!(decode_base64(b"-_-_"), Ok(vec![0xfb, 0xff, 0xbf]));
        assert!(decode_base64(b"Zm9vY").is_err());
        assert!(decode_base64(b"Zm9v Yg==").is_err());
        assert!(decode_base64(b"====").is_err());
    }

    #[test]
    fn data_and_percent() {
        assert_eq!(decode_data("text/plain;base64,Zm8="), Ok(b"fo".to_vec()));
        assert_eq!(decode_data(",a%20b%2"), Ok(b"a b%2".to_vec()));
        assert!(decode_data("no comma").is_err());
        assert_eq!(percent_decode("%E2%82%ac"), "€".as_bytes());
    }
}
