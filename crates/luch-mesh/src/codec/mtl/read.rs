//! The reader of material files.

use glam::Vec3;

use super::{Field, MtlFile, MtlMaterial, MtlTexture};
use crate::codec::cursor::{Line, Lines};
use crate::codec::error::{DecodeError, ErrorKind, Warnings, quote};
use crate::codec::token::{parse_f32, parse_i64, split_word, words};

/// Reads a material file.
///
/// Errors: a number that is none, a value before the first `newmtl`. Warnings: unknown keywords, colours given as
/// spectra or XYZ. Keywords are taken in either case.
pub fn decode(bytes: &[u8]) -> Result<MtlFile, DecodeError> {
    let mut materials: Vec<MtlMaterial> = Vec::new();
    let mut has_dissolve = false;
    let mut warnings = Warnings::default();
    let mut lines = Lines::new(bytes);
    while let Some(line) = lines.next_joined() {
        let (word, rest) = split_word(&line.text);
        if word.is_empty() || word[0] == b'#' {
            continue;
        }
        let keyword = String::from_utf8_lossy(word).to_ascii_lowercase();
        if keyword == "newmtl" {
            let name = String::from_utf8_lossy(rest.trim_ascii()).into_owned();
            materials.push(MtlMaterial { name, ..MtlMaterial::default() });
            has_dissolve = false;
            continue;
        }
        let Some(material) = materials.last_mut() else {
            let expected = "“newmtl” and a name before anything else";
            return Err(DecodeError::new(ErrorKind::Syntax, line.place_of(word), quote(word), expected));
        };
        match keyword.as_str() {
            "illum" => {
                let number = first_number(&line, rest)?;
                material.illumination_model = Some(number.max(0.0) as u32);
            }
            "tr" => {
                let opacity = 1.0 - first_number(&line, rest)?;
                if !has_dissolve {
                    material.opacity = Some(opacity);
                }
            }
            _ => {
                has_dissolve |= keyword == "d";
                match material.field(&keyword) {
                    Some(Field::Color(color)) => *color = read_color(&line, rest, &mut warnings)?.or(*color),
                    Some(Field::Number(number)) => *number = Some(first_number(&line, rest)?),
                    Some(Field::Map(map)) => {
                        let texture = MtlTexture::parse(&line, rest, &mut warnings)?;
                        if texture.is_none() {
                            warnings.add(Some(line.number), &format!("{} names no file", quote(word)));
                        }
                        *map = texture.or(map.take());
                    }
                    None => {
                        warnings
                            .add(Some(line.number), &format!("unknown keyword {} is skipped", quote(word)));
                    }
                }
            }
        }
    }
    if materials.is_empty() {
        warnings.add(None, "the file has no materials");
    }
    Ok(MtlFile { materials, warnings: warnings.into_list() })
}

/// One number for all three channels, or three.
fn read_color(line: &Line, rest: &[u8], warnings: &mut Warnings) -> Result<Option<Vec3>, DecodeError> {
    if let Some(form @ (b"spectral" | b"xyz")) = words(rest).next() {
        let form = String::from_utf8_lossy(form);
        warnings.add(
            Some(line.number),
            &format!("a colour given as “{form}” is skipped: only RGB is understood"),
        );
        return Ok(None);
    }
    let mut channels = Vec::new();
    for word in words(rest).take(3).take_while(|word| word[0] != b'#') {
        channels.push(number(line, word)?);
    }
    match *channels {
        [gray] => Ok(Some(Vec3::splat(gray))),
        [r, g, b] => Ok(Some(Vec3::new(r, g, b))),
        _ => Err(wrong(line, rest, "one or three numbers")),
    }
}

fn first_number(line: &Line, rest: &[u8]) -> Result<f32, DecodeError> {
    // `d -halo 0.5`: the option changes how, not how much.
    let word = words(rest).find(|word| *word != b"-halo").unwrap_or(&rest[rest.len()..]);
    number(line, word)
}

pub(super) fn number(line: &Line, word: &[u8]) -> Result<f32, DecodeError> {
    parse_f32(word).filter(|number| number.is_finite()).ok_or_else(|| wrong(line, word, "a finite number"))
}

pub(super) fn whole_number(line: &Line, word: &[u8]) -> Result<u32, DecodeError> {
    let number = parse_i64(word).and_then(|number| u32::try_from(number).ok());
    number.ok_or_else(|| wrong(line, word, "a whole number"))
}

pub(super) fn wrong(line: &Line, part: &[u8], expected: &str) -> DecodeError {
    let found = if part.is_empty() { "the end of the line".to_owned() } else { quote(part) };
    DecodeError::new(ErrorKind::Syntax, line.place_of(part), found, expected)
}
