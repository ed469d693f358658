//! Words of the command line as values, with messages that say what is accepted.

mod bench;

pub(crate) use bench::{field_of_view, kernels, levels, point, qualities, sets, thread_counts};

use luch::image::tone::Curve;
use luch::render::Goal;
use luch::sampling::Sequence;
use luch::scene::{Filter, Integrator, Minification, Normals, Property};
use std::fmt;
use std::ops::Range;
use std::str::FromStr;
use std::time::Duration;

/// Nothing has this name; what was perhaps meant, or what there is.
pub(crate) fn unknown<'a>(kind: &str, text: &str, known: impl Iterator<Item = &'a str> + Clone) -> String {
    let distance = |name: &str| strsim::damerau_levenshtein(&text.to_ascii_lowercase(), name);
    match known.clone().min_by_key(|name| distance(name)).filter(|name| distance(name) <= 3) {
        Some(near) => format!("there is no {kind} `{text}`; did you mean `{near}`?"),
        None => format!("there is no {kind} `{text}`; there are {}", known.collect::<Vec<_>>().join(", ")),
    }
}

/// Longest side of a picture.
const LONGEST_SIDE: u32 = 1 << 16;

/// Most scatterings that can be asked for.
const DEEPEST_PATH: u32 = 1 << 20;

/// A picture's width and height in pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Size {
    pub(crate) width: u32,
    pub(crate) height: u32,
}

/// `960x540`
pub(crate) fn size(text: &str) -> Result<Size, String> {
    let wrong = || format!("`{text}` is no size; write width and height in pixels, such as 960x540");
    let (width, height) = text.split_once(['x', 'X', '×']).ok_or_else(wrong)?;
    let side = |text: &str| match text.trim().parse::<u32>() {
        Ok(side) if (1..=LONGEST_SIDE).contains(&side) => Ok(side),
        Ok(side) => Err(format!("a side of {side} pixels; accepted are 1 to {LONGEST_SIDE}")),
        Err(_) => Err(wrong()),
    };
    Ok(Size { width: side(width)?, height: side(height)? })
}

/// An angle between faces in degrees; in radians.
pub(crate) fn crease(text: &str) -> Result<f32, String> {
    let degrees =
        text.trim_end_matches("deg").parse().ok().filter(|angle: &f32| (0.0..=180.0).contains(angle));
    degrees.map(f32::to_radians).ok_or_else(|| format!("`{text}` is no angle from 0 to 180 degrees"))
}

/// A part of something, above 0 and at most 1.
pub(crate) fn part(text: &str) -> Result<f64, String> {
    let part = text.parse().ok().filter(|part: &f64| *part > 0.0 && *part <= 1.0);
    part.ok_or_else(|| format!("`{text}` is no number above 0 and up to 1"))
}

/// The width of a line in pixels.
pub(crate) fn line_width(text: &str) -> Result<f32, String> {
    let width = text.parse().ok().filter(|width: &f32| (0.0..=64.0).contains(width));
    width.ok_or_else(|| format!("`{text}` is no width from 0 to 64 pixels"))
}

/// `30s`, `2m`, `1h30m`, `250ms`; a bare number is in seconds.
pub(crate) fn duration(text: &str) -> Result<Duration, String> {
    let wrong = || format!("`{text}` is no duration; write 30s, 2m, 1h30m or 250ms");
    let mut seconds = 0.0;
    let mut rest = text.trim();
    while !rest.is_empty() {
        let digits = rest.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(rest.len());
        let number: f64 = rest[..digits].parse().map_err(|_| wrong())?;
        rest = &rest[digits..];
        let letters = rest.find(|c: char| !c.is_ascii_alphabetic()).unwrap_or(rest.len());
        let unit = match &rest[..letters] {
            "ms" => 0.001,
            "" | "s" => 1.0,
            "m" | "min" => 60.0,
            "h" => 3600.0,
            "d" => 86400.0,
            _ => return Err(wrong()),
        };
        seconds += number * unit;
        rest = &rest[letters..];
    }
    match Duration::try_from_secs_f64(seconds) {
        Ok(time) if time > Duration::ZERO => Ok(time),
        _ => Err(wrong()),
    }
}

/// Time between two savings.
///
/// Each ends the work under way, so that too short a time would leave no time for work.
pub(crate) fn interval(text: &str) -> Result<Duration, String> {
    let time = duration(text)?;
    let least = Duration::from_secs(1);
    if time >= least { Ok(time) } else { Err(format!("`{text}` is too short; accepted are 1s and more")) }
}

/// `1%` or `0.01`
pub(crate) fn fraction(text: &str) -> Result<f64, String> {
    let wrong = || format!("`{text}` is no error; write a share of the mean brightness, such as 1% or 0.01");
    let (number, scale) = match text.trim().strip_suffix('%') {
        Some(number) => (number, 0.01),
        None => (text, 1.0),
    };
    let value = number.trim().parse::<f64>().map_err(|_| wrong())? * scale;
    if !(value > 0.0 && value.is_finite()) {
        return Err(wrong());
    }
    if value >= 1.0 {
        let told = format!("`{text}` is an error of all the light or more");
        // Who typed percent means percent.
        return Err(match scale < 1.0 {
            true => format!("{told}; accepted is what is less than 100%"),
            false => format!("{told}; if you mean percent, write {number}%"),
        });
    }
    Ok(value)
}

/// `64..128`: the first index and the one after the last.
pub(crate) fn samples(text: &str) -> Result<Range<u64>, String> {
    let wrong = || {
        format!("`{text}` is no range of samples; write the first and the one after the last, such as 0..64")
    };
    let (start, end) = text.split_once("..").ok_or_else(wrong)?;
    let start: u64 = start.trim().parse().map_err(|_| wrong())?;
    let end: u64 = end.trim().parse().map_err(|_| wrong())?;
    let most = Goal::default().samples.end;
    if start >= end {
        return Err(format!("`{text}` holds no samples: the first number must be smaller than the second"));
    }
    if end > most {
        return Err(format!("`{text}` goes beyond sample {most}, the last there is"));
    }
    Ok(start..end)
}

/// Samples of each pixel.
pub(crate) fn sample_count(text: &str) -> Result<u64, String> {
    let most = Goal::default().samples.end;
    match text.parse() {
        Ok(count) if (1..=most).contains(&count) => Ok(count),
        _ => Err(format!("`{text}` is no number of samples; accepted are whole numbers from 1 to {most}")),
    }
}

/// A display curve.
pub(crate) fn curve(text: &str) -> Result<Curve, String> {
    Curve::from_name(text)
        .ok_or_else(|| format!("`{text}` is no display curve; accepted are {}", Curve::names()))
}

/// A sample sequence.
pub(crate) fn sequence(text: &str) -> Result<Sequence, String> {
    let names = Sequence::ALL.map(Sequence::name).join(", ");
    Sequence::from_name(text).ok_or_else(|| format!("`{text}` is no sequence; accepted are {names}"))
}

/// What becomes of textures finer than the pixels.
pub(crate) fn texture_filter(text: &str) -> Result<Minification, String> {
    let unknown = || format!("`{text}` is no texture filter; accepted are footprint, none");
    Minification::from_name(text).ok_or_else(unknown)
}

/// Which normals are shaded with.
pub(crate) fn normals(text: &str) -> Result<Normals, String> {
    match text {
        "flat" => Ok(Normals::Flat),
        "smooth" => Ok(Normals::Interpolated),
        _ => Err(format!("`{text}` are no normals; accepted are flat, smooth")),
    }
}

/// A largest difference that is accepted.
pub(crate) fn limit(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(limit) if limit >= 0.0 && limit.is_finite() => Ok(limit),
        _ => Err(format!("`{text}` is no limit; accepted are finite numbers from 0 on, such as 0.001")),
    }
}

/// Stops, from −64 to 64, as in scene files.
pub(crate) fn stops(text: &str) -> Result<f32, String> {
    match text.parse::<f32>() {
        Ok(stops) if stops.abs() <= 64.0 => Ok(stops),
        _ => Err(format!("`{text}` is no exposure; write stops from -64 to 64, such as -1.5")),
    }
}

/// An integrator by name, with its number if one was given: `path`, `path:24`, `occlusion:0.5`, `normal`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum IntegratorChoice {
    Path(Option<u32>),
    PlainPath(Option<u32>),
    Direct,
    Occlusion(f32),
    Inspect(Property),
}

impl FromStr for IntegratorChoice {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (name, number) = match text.split_once(':') {
            Some((name, number)) => (name, Some(number)),
            None => (text, None),
        };
        let depth = || match number.map(str::parse) {
            None => Ok(None),
            Some(Ok(depth)) if depth <= DEEPEST_PATH => Ok(Some(depth)),
            _ => Err(format!("`{text}`: after the colon stands the longest path, 0 to {DEEPEST_PATH}")),
        };
        match name {
            "path" => return Ok(Self::Path(depth()?)),
            "plain-path" => return Ok(Self::PlainPath(depth()?)),
            "occlusion" => {
                return match number.map_or(Ok(f32::INFINITY), str::parse) {
                    Ok(distance) if distance > 0.0 => Ok(Self::Occlusion(distance)),
                    _ => Err(format!("`{text}`: after the colon stands a distance in metres, more than 0")),
                };
            }
            _ => {}
        }
        let known = match name {
            "direct" => Some(Self::Direct),
            _ => Property::from_name(name).map(Self::Inspect),
        };
        match (known, number) {
            (Some(known), None) => Ok(known),
            (Some(_), Some(_)) => Err(format!("`{text}`: `{name}` takes no number")),
            (None, _) => {
                let names = Property::ALL.map(Property::name).join(", ");
                Err(format!(
                    "`{text}` is no integrator; accepted are path, plain-path, direct, occlusion, {names}"
                ))
            }
        }
    }
}

impl fmt::Display for IntegratorChoice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Path(None) => f.write_str("path"),
            Self::Path(Some(depth)) => write!(f, "path:{depth}"),
            Self::PlainPath(None) => f.write_str("plain-path"),
            Self::PlainPath(Some(depth)) => write!(f, "plain-path:{depth}"),
            Self::Direct => f.write_str("direct"),
            Self::Occlusion(distance) => write!(f, "occlusion:{distance}"),
            Self::Inspect(property) => f.write_str(property.name()),
        }
    }
}

impl From<Integrator> for IntegratorChoice {
    fn from(integrator: Integrator) -> Self {
        match integrator {
            Integrator::Path { max_depth } => Self::Path(Some(max_depth)),
            Integrator::PlainPath { max_depth } => Self::PlainPath(Some(max_depth)),
            Integrator::Direct => Self::Direct,
            Integrator::Occlusion { distance } => Self::Occlusion(distance),
            Integrator::Inspect(property) => Self::Inspect(property),
        }
    }
}

impl IntegratorChoice {
    /// The integrator; a path without a number takes `depth`.
    pub(crate) fn with_depth(self, depth: u32) -> Integrator {
        match self {
            Self::Path(own) => Integrator::Path { max_depth: own.unwrap_or(depth) },
            Self::PlainPath(own) => Integrator::PlainPath { max_depth: own.unwrap_or(depth) },
            Self::Direct => Integrator::Direct,
            Self::Occlusion(distance) => Integrator::Occlusion { distance },
            Self::Inspect(property) => Integrator::Inspect(property),
        }
    }
}

/// A pixel filter: `box`, `tent:2`, `gaussian:1.5:0.5` (radius, then standard deviation), `blackman-harris`.
pub(crate) fn filter(text: &str) -> Result<Filter, String> {
    let mut words = text.split(':');
    let name = words.next().unwrap_or("");
    let number = |word: Option<&str>, usual: f32| match word.map_or(Ok(usual), str::parse::<f32>) {
        Ok(width) if width > 0.0 && width <= 64.0 => Ok(width),
        _ => Err(format!("`{text}`: after the colon stands a width in pixels, more than 0 and at most 64")),
    };
    let filter = match name {
        "box" => Filter::Box { radius: number(words.next(), 0.5)? },
        "tent" => Filter::Tent { radius: number(words.next(), 1.0)? },
        "gaussian" => {
            let radius = number(words.next(), 1.5)?;
            Filter::Gaussian { radius, deviation: number(words.next(), radius / 3.0)? }
        }
        "blackman-harris" => Filter::BlackmanHarris { radius: number(words.next(), 1.5)? },
        _ => {
            return Err(format!(
                "`{text}` is no filter; accepted are box, tent, gaussian, blackman-harris, with a radius in pixels after a colon if wanted"
            ));
        }
    };
    match words.next() {
        None => Ok(filter),
        Some(more) => Err(format!("`{text}`: `{more}` is one number too many")),
    }
}

/// The text that [`filter`] reads back.
pub(crate) fn filter_text(filter: Filter) -> String {
    match filter {
        Filter::Box { radius } => format!("box:{radius}"),
        Filter::Tent { radius } => format!("tent:{radius}"),
        Filter::Gaussian { radius, deviation } => format!("gaussian:{radius}:{deviation}"),
        Filter::BlackmanHarris { radius } => format!("blackman-harris:{radius}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_become_values() {
        assert_eq!(size("960x540"), Ok(Size { width: 960, height: 540 }));
        assert_eq!(duration("1h30m"), Ok(Duration::from_secs(5400)));
        assert_eq!(duration("1.5"), Ok(Duration::from_millis(1500)));
        assert_eq!(duration("250ms"), Ok(Duration::from_millis(250)));
        assert_eq!(fraction("2%"), Ok(0.02));
        assert_eq!(fraction("0.5"), Ok(0.5));
        assert_eq!(samples("64..128"), Ok(64..128));
    }

    #[test]
    fn what_is_no_value_is_refused_with_its_text() {
        for text in ["", "960", "0x5", "axb", "960x", "99999x1", "9x9x9"] {
            assert!(size(text).is_err(), "{text}");
        }
        for text in ["", "s", "-3s", "0", "3 fortnights", "1e99h", "9999999999999999999999d", "1..2s"] {
            assert!(duration(text).is_err(), "{text}");
        }
        assert!(interval("0.5s").is_err() && interval("1s").is_ok());
        for text in ["", "%", "0", "-1%", "nan", "inf", "x"] {
            assert!(fraction(text).is_err(), "{text}");
        }
        assert!(fraction("5").unwrap_err().contains("5%"));
        assert!(!fraction("200%").unwrap_err().contains("if you mean"));
        for text in ["", "nan", "inf", "-1", "x"] {
            assert!(limit(text).is_err(), "{text}");
        }
        assert!(limit("0").is_ok() && stops("64").is_ok() && stops("65").is_err());
        for text in ["", "5", "5..5", "9..3", "..", "0..99999999999", "-1..4", "a..b"] {
            assert!(samples(text).is_err(), "{text}");
        }
        assert!(filter("bx").unwrap_err().contains("blackman-harris"));
        assert!(filter("box:1:2").is_err() && filter("box:0").is_err() && filter("tent:x").is_err());
        for text in ["pth", "path:x", "path:-1", "direct:3", "normal:1", "occlusion:0"] {
            assert!(text.parse::<IntegratorChoice>().is_err(), "{text}");
        }
    }

    #[test]
    fn integrators_and_filters_survive_their_text() {
        let mut choices = vec![
            IntegratorChoice::Path(Some(7)),
            IntegratorChoice::PlainPath(Some(0)),
            IntegratorChoice::Direct,
            IntegratorChoice::Occlusion(f32::INFINITY),
            IntegratorChoice::Occlusion(0.1),
        ];
        choices.extend(Property::ALL.map(IntegratorChoice::Inspect));
        for choice in choices {
            assert_eq!(choice.to_string().parse(), Ok(choice));
        }
        for value in [
            Filter::Box { radius: 0.5 },
            Filter::Tent { radius: 0.1 },
            Filter::Gaussian { radius: 1.5, deviation: 0.3 },
            Filter::BlackmanHarris { radius: 1.7 },
        ] {
            assert_eq!(filter(&filter_text(value)), Ok(value));
        }
    }
}
