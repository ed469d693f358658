//! Textures of materials: a file name among options.

use glam::Vec3;

use super::read::{number, whole_number, wrong};
use crate::codec::cursor::Line;
use crate::codec::error::{DecodeError, Warnings, quote};
use crate::codec::token::parse_f32;

/// Which channel of a picture is used where one number is wanted (`-imfchan`).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Channel {
    /// `r`.
    Red,
    /// `g`.
    Green,
    /// `b`.
    Blue,
    /// `m`: opacity from the matte channel.
    Matte,
    /// `l`.
    Luminance,
    /// `z`.
    Depth,
}

impl Channel {
    /// Channels and their letters.
    pub const ALL: [(Self, &str); 6] = [
        (Self::Red, "r"),
        (Self::Green, "g"),
        (Self::Blue, "b"),
        (Self::Matte, "m"),
        (Self::Luminance, "l"),
        (Self::Depth, "z"),
    ];
}

/// A picture and how it is laid on.
#[derive(Clone, Debug, PartialEq)]
pub struct MtlTexture {
    /// The name as it stands in the file; may hold spaces and backslashes.
    pub file: String,
    /// `-s`: uv times this. 1 by default, for what is not given too.
    pub scale: Vec3,
    /// `-o`: added to uv.
    pub offset: Vec3,
    /// `-t`: turbulence.
    pub turbulence: Vec3,
    /// `-clamp`: no repetition.
    pub clamp: bool,
    /// `-blendu`, on by default.
    pub blend_u: bool,
    /// `-blendv`, on by default.
    pub blend_v: bool,
    /// `-cc`: colour correction.
    pub color_correction: bool,
    /// `-bm`: bumps times this.
    pub bump_multiplier: f32,
    /// `-mm`, first number: added to every value.
    pub base: f32,
    /// `-mm`, second number: every value times this.
    pub gain: f32,
    /// `-boost`: sharpness.
    pub boost: Option<f32>,
    /// `-texres`.
    pub resolution: Option<u32>,
    /// `-imfchan`.
    pub channel: Option<Channel>,
    /// `-type`: `sphere`, `cube_top`, …
    pub kind: Option<String>,
    /// `-colorspace`: `sRGB`, `linear`, …
    pub color_space: Option<String>,
}

impl MtlTexture {
    /// A file with no options.
    pub fn new(file: impl Into<String>) -> Self {
        Self {
            file: file.into(),
            scale: Vec3::ONE,
            offset: Vec3::ZERO,
            turbulence: Vec3::ZERO,
            clamp: false,
            blend_u: true,
            blend_v: true,
            color_correction: false,
            bump_multiplier: 1.0,
            base: 0.0,
            gain: 1.0,
            boost: None,
            resolution: None,
            channel: None,
            kind: None,
            color_space: None,
        }
    }

    /// Reads options and a file name, in either order; `None` if there is no name.
    pub(super) fn parse(
        line: &Line,
        rest: &[u8],
        warnings: &mut Warnings,
    ) -> Result<Option<Self>, DecodeError> {
        let mut texture = Self::new("");
        let mut words = Words { rest };
        // Where in `rest` the name stands: it may consist of several words.
        let mut name: Option<(usize, usize)> = None;
        while let Some(word) = words.next() {
            if texture.option(line, word, &mut words, warnings)? {
                continue;
            }
            let start = word.as_ptr() as usize - rest.as_ptr() as usize;
            name = Some((name.map_or(start, |(start, _)| start), start + word.len()));
        }
        let Some((start, end)) = name else { return Ok(None) };
        texture.file = String::from_utf8_lossy(&rest[start..end]).trim_matches('"').to_owned();
        Ok(Some(texture))
    }

    /// True if `word` is an option; then it and its values are read.
    fn option(
        &mut self,
        line: &Line,
        word: &[u8],
        words: &mut Words,
        warnings: &mut Warnings,
    ) -> Result<bool, DecodeError> {
        match word {
            b"-s" => self.scale = words.up_to_three(line, word, Vec3::ONE)?,
            b"-o" => self.offset = words.up_to_three(line, word, Vec3::ZERO)?,
            b"-t" => self.turbulence = words.up_to_three(line, word, Vec3::ZERO)?,
            b"-mm" => {
                let both = words.up_to_three(line, word, Vec3::new(0.0, 1.0, 0.0))?;
                (self.base, self.gain) = (both.x, both.y);
            }
            b"-bm" => self.bump_multiplier = number(line, words.value())?,
            b"-boost" => self.boost = Some(number(line, words.value())?),
            b"-texres" => self.resolution = Some(whole_number(line, words.value())?),
            b"-clamp" => self.clamp = switch(line, words.value())?,
            b"-blendu" => self.blend_u = switch(line, words.value())?,
            b"-blendv" => self.blend_v = switch(line, words.value())?,
            b"-cc" => self.color_correction = switch(line, words.value())?,
            b"-type" => self.kind = Some(String::from_utf8_lossy(words.value()).into_owned()),
            b"-colorspace" => self.color_space = Some(String::from_utf8_lossy(words.value()).into_owned()),
            b"-imfchan" => {
                let letter = words.value();
                let known = Channel::ALL.iter().find(|(_, name)| name.as_bytes() == letter);
                let Some((channel, _)) = known else { return Err(wrong(line, letter, "r, g, b, m, l or z")) };
                self.channel = Some(*channel);
            }
            [b'-', b'a'..=b'z', ..] if !word.contains(&b'.') => {
                let message = format!("unknown texture option {} is skipped", quote(word));
                warnings.add(Some(line.number), &message);
            }
            _ => return Ok(false),
        }
        Ok(true)
    }
}

struct Words<'a> {
    rest: &'a [u8],
}

impl<'a> Words<'a> {
    fn next(&mut self) -> Option<&'a [u8]> {
        let (word, rest) = crate::codec::token::split_word(self.rest);
        self.rest = rest;
        (!word.is_empty()).then_some(word)
    }

    /// The value of an option; nothing if the line is over.
    fn value(&mut self) -> &'a [u8] {
        self.next().unwrap_or(&self.rest[self.rest.len()..])
    }

    /// One to three numbers, the others from `default`.
    fn up_to_three(&mut self, line: &Line, option: &[u8], default: Vec3) -> Result<Vec3, DecodeError> {
        let mut numbers = default;
        for axis in 0..3 {
            let (word, rest) = crate::codec::token::split_word(self.rest);
            // A name may begin with digits: only what is a number, and not the last word, belongs here.
            let Some(number) = parse_f32(word).filter(|n| n.is_finite() && !rest.is_empty()) else {
                if axis == 0 {
                    return Err(wrong(line, word, &format!("a number after {}, then a file", quote(option))));
                }
                break;
            };
            numbers[axis] = number;
            self.rest = rest;
        }
        Ok(numbers)
    }
}

fn switch(line: &Line, word: &[u8]) -> Result<bool, DecodeError> {
    match word {
        b"on" => Ok(true),
        b"off" => Ok(false),
        _ => Err(wrong(line, word, "on or off")),
    }
}
