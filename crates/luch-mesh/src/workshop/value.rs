//! What parameters can be, and how it is read from text.

use super::Files;
use crate::PolygonMesh;
use crate::screen::{OnScreen, ScreenView};
use glam::DVec3;

/// What may be given for a parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// A number from `least` to `most`.
    Number {
        /// The least.
        least: f64,
        /// The most.
        most: f64,
    },
    /// A whole number from `least` to `most`.
    Count {
        /// The least.
        least: u64,
        /// The most.
        most: u64,
    },
    /// An angle: degrees, or with a unit `deg`, `rad`, `turn`. Kept in radians.
    Angle,
    /// Three numbers: `1,2,3`; or `x`, `-y`, `z` for an axis.
    Vector,
    /// One positive number for all three sides, or three: `2` or `1,2,3`.
    Size,
    /// Any numbers: `1,2,3.5`.
    Numbers,
    /// `true` or `false`; naming it alone means true.
    Flag,
    /// One of these words.
    Choice(&'static [&'static str]),
    /// Any text. Formulas, selections and outlines are given so; the verb reads them.
    Text,
    /// The name of a file; the verb gets its bytes.
    File,
    /// The name of a mesh file; the verb gets the mesh.
    Mesh,
    /// A number of pixels on the screens of the cameras that see the mesh.
    Pixels,
}

impl Kind {
    /// Any number.
    pub const NUMBER: Self = Self::Number { least: f64::MIN, most: f64::MAX };
    /// A number above zero.
    pub const POSITIVE: Self = Self::Number { least: f64::MIN_POSITIVE, most: f64::MAX };
    /// A number that is not negative.
    pub const NOT_NEGATIVE: Self = Self::Number { least: 0.0, most: f64::MAX };
    /// A number from 0 to 1.
    pub const FRACTION: Self = Self::Number { least: 0.0, most: 1.0 };

    /// What is accepted, in words.
    pub fn accepted(&self) -> String {
        match self {
            Self::Number { least: f64::MIN, .. } => "a number".into(),
            Self::Number { least, most: f64::MAX } if *least == f64::MIN_POSITIVE => {
                "a number above 0".into()
            }
            // Bounds that only keep reckoning in range are not worth telling.
            Self::Number { least, most } if *least > 0.0 && *least < 1e-9 && *most > 1e9 => {
                "a number above 0".into()
            }
            Self::Number { least, most: f64::MAX } => format!("a number from {least}"),
            Self::Number { least, most } => format!("a number from {least} to {most}"),
            Self::Count { least, most: u64::MAX } => format!("a whole number from {least}"),
            Self::Count { least, most } => format!("a whole number from {least} to {most}"),
            Self::Angle => "an angle such as 90, 90deg, 1.57rad or 0.25turn".into(),
            Self::Vector => "three numbers such as 0,1,0, or x, y, z, -x, -y, -z".into(),
            Self::Size => "a positive number, or three such as 1,2,3".into(),
            Self::Numbers => "numbers such as 1,2,3.5".into(),
            Self::Flag => "true or false".into(),
            Self::Choice(words) => words.join(", "),
            Self::Text => "text".into(),
            Self::File => "the name of a file".into(),
            Self::Mesh => "the name of a mesh file".into(),
            Self::Pixels => "a number of pixels from 0.1 to 1000".into(),
        }
    }

    /// Reads a value; the message says what would be right.
    pub fn read(&self, text: &str, files: &mut dyn Files) -> Result<Value, String> {
        let wrong = || format!("found “{text}”, expected {}", self.accepted());
        Ok(match *self {
            Self::Number { least, most } => match number(text).ok_or_else(wrong)? {
                number if (least..=most).contains(&number) => Value::Number(number),
                // The wide bounds are told to who went past them.
                number if number > 1e9 && number > most => {
                    return Err(format!("found “{text}”, expected a number from {least:e} to {most:e}"));
                }
                _ => return Err(wrong()),
            },
            Self::Count { least, most } => {
                let count = text.trim().parse().ok().filter(|n| (least..=most).contains(n));
                Value::Count(count.ok_or_else(wrong)?)
            }
            Self::Angle => Value::Number(angle(text).ok_or_else(wrong)?),
            Self::Vector => Value::Vector(vector(text).ok_or_else(wrong)?),
            Self::Size => {
                let size = match numbers(text).as_deref() {
                    Some(&[side]) => DVec3::splat(side),
                    Some(&[x, y, z]) => DVec3::new(x, y, z),
                    _ => return Err(wrong()),
                };
                if size.min_element() <= 0.0 {
                    return Err(wrong());
                }
                Value::Vector(size)
            }
            Self::Numbers => Value::Numbers(numbers(text).ok_or_else(wrong)?),
            Self::Flag => match text.trim() {
                "" | "true" | "yes" | "#true" => Value::Flag(true),
                "false" | "no" | "#false" => Value::Flag(false),
                _ => return Err(wrong()),
            },
            Self::Choice(words) => {
                let place = words.iter().position(|word| *word == text.trim());
                Value::Choice(words[place.ok_or_else(wrong)?])
            }
            Self::Text => Value::Text(text.into()),
            Self::File => Value::File(files.bytes(text)?),
            Self::Mesh => Value::Mesh(Box::new(files.mesh(text)?)),
            Self::Pixels => {
                let pixels = number(text).filter(|n| (0.1..=1000.0).contains(n)).ok_or_else(wrong)?;
                let views: Vec<ScreenView> = files.views()?;
                Value::OnScreen(OnScreen { views, pixels })
            }
        })
    }
}

/// A value that was read.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A number, or an angle in radians.
    Number(f64),
    /// A whole number.
    Count(u64),
    /// Three numbers.
    Vector(DVec3),
    /// Any numbers.
    Numbers(Vec<f64>),
    /// Yes or no.
    Flag(bool),
    /// One of the words of [`Kind::Choice`].
    Choice(&'static str),
    /// Text.
    Text(String),
    /// The bytes of a file.
    File(Vec<u8>),
    /// A mesh.
    Mesh(Box<PolygonMesh>),
    /// Pixels and who sees them.
    OnScreen(OnScreen),
}

fn number(text: &str) -> Option<f64> {
    text.trim().parse().ok().filter(|n: &f64| n.is_finite())
}

fn numbers(text: &str) -> Option<Vec<f64>> {
    text.split([',', ' ']).filter(|part| !part.is_empty()).map(number).collect()
}

fn angle(text: &str) -> Option<f64> {
    let text = text.trim();
    let units = [
        ("deg", std::f64::consts::PI / 180.0),
        ("°", std::f64::consts::PI / 180.0),
        ("rad", 1.0),
        ("turn", std::f64::consts::TAU),
    ];
    let (digits, unit) = units
        .into_iter()
        .find_map(|(name, unit)| Some((text.strip_suffix(name)?, unit)))
        .unwrap_or((text, std::f64::consts::PI / 180.0));
    Some(number(digits)? * unit)
}

fn vector(text: &str) -> Option<DVec3> {
    match text.trim() {
        "x" | "+x" => Some(DVec3::X),
        "y" | "+y" => Some(DVec3::Y),
        "z" | "+z" => Some(DVec3::Z),
        "-x" => Some(DVec3::NEG_X),
        "-y" => Some(DVec3::NEG_Y),
        "-z" => Some(DVec3::NEG_Z),
        other => match numbers(other)?.as_slice() {
            &[x, y, z] => Some(DVec3::new(x, y, z)),
            _ => None,
        },
    }
}
