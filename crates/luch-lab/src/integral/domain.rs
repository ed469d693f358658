//! The box over which is integrated.

use super::text_error::{TextError, constant, parts};

/// One axis of a box: a variable and its range.
#[derive(Clone, Debug, PartialEq)]
pub struct Side {
    /// The variable.
    pub name: String,
    /// Lower end; may be minus infinite.
    pub low: f64,
    /// Upper end; may be infinite.
    pub high: f64,
}

impl Side {
    /// Its length; may be infinite.
    pub fn length(&self) -> f64 {
        self.high - self.low
    }
}

/// A box in 1 to 32 dimensions: `x=-pi/2..pi/2, y=0..1`, or `x1..x8 = 0..1` for many alike.
#[derive(Clone, Debug, PartialEq)]
pub struct Domain {
    sides: Vec<Side>,
}

/// The most dimensions.
pub const MOST_DIMENSIONS: usize = 32;

impl Domain {
    /// Reads a box. Ends are formulas without variables.
    ///
    /// # Errors
    ///
    /// A side is not written as `name=low..high`, an end has no value, the lower end is not below the upper one, a name is given
    /// twice, or there are more than 32 sides.
    ///
    /// ```
    /// use luch_lab::integral::Domain;
    /// let domain = Domain::parse("x = -pi/2..pi/2, y1..y3 = 0..2").unwrap();
    /// assert_eq!(domain.dimensions(), 4);
    /// let error = Domain::parse("x=0..1,y=2..1").unwrap_err();
    /// assert_eq!(error.column(), 10);
    /// ```
    pub fn parse(text: &str) -> Result<Self, TextError> {
        if text.len() > 1 << 16 {
            return Err(TextError::new("longer than 65536 bytes", "", 0));
        }
        let mut sides: Vec<Side> = Vec::new();
        for (start, part) in parts(text, ',') {
            let expected = "expected name=low..high, such as x=0..1";
            let Some(equals) = part.find('=') else {
                return Err(TextError::new(expected, text, start));
            };
            let range = &part[equals + 1..];
            let from = start + equals + 1;
            let Some(dots) = range.find("..") else {
                return Err(TextError::new(expected, text, from));
            };
            let low = constant(text, from, &range[..dots])?;
            let high = constant(text, from + dots + 2, &range[dots + 2..])?;
            if low >= high {
                let message = format!("the lower end {low} is not below the upper end {high}");
                return Err(TextError::new(message, text, from));
            }
            for name in names(&part[..equals]).map_err(|message| TextError::new(message, text, start))? {
                if sides.iter().any(|side| side.name == name) {
                    return Err(TextError::new(format!("`{name}` is given twice"), text, start));
                }
                sides.push(Side { name, low, high });
                if sides.len() > MOST_DIMENSIONS {
                    return Err(TextError::new("more than 32 dimensions", text, start));
                }
            }
        }
        Ok(Self { sides })
    }

    /// The sides in order.
    pub fn sides(&self) -> &[Side] {
        &self.sides
    }

    /// How many.
    pub fn dimensions(&self) -> usize {
        self.sides.len()
    }

    /// The names of the variables in order.
    pub fn names(&self) -> Vec<&str> {
        self.sides.iter().map(|side| side.name.as_str()).collect()
    }

    /// The product of the lengths; may be infinite.
    pub fn volume(&self) -> f64 {
        self.sides.iter().map(Side::length).product()
    }

    /// Whether a point lies in the box, ends included.
    pub fn contains(&self, point: &[f64]) -> bool {
        self.sides.iter().zip(point).all(|(side, &x)| side.low <= x && x <= side.high)
    }
}

/// A name, or a row of names `x1..x8`.
fn names(text: &str) -> Result<Vec<String>, String> {
    let check = |name: &str| {
        let mut characters = name.chars();
        let starts = characters.next().is_some_and(|c| c.is_ascii_alphabetic() || c == '_');
        let is_name = starts && name.len() <= 64 && characters.all(|c| c.is_ascii_alphanumeric() || c == '_');
        if is_name {
            Ok(())
        } else {
            Err(format!("`{name}` is no name: expected letters and digits, such as x1"))
        }
    };
    let text = text.trim();
    let Some((first, last)) = text.split_once("..") else {
        check(text)?;
        return Ok(vec![text.to_owned()]);
    };
    let (first, last) = (first.trim(), last.trim());
    check(first)?;
    check(last)?;
    let split = |name: &str| {
        let digits = name.len() - name.trim_end_matches(|c: char| c.is_ascii_digit()).len();
        let (stem, number) = name.split_at(name.len() - digits);
        number.parse::<u32>().ok().map(|number| (stem.to_owned(), number))
    };
    match (split(first), split(last)) {
        (Some((stem, from)), Some((other, to))) if stem == other && from <= to && to - from < 32 => {
            Ok((from..=to).map(|number| format!("{stem}{number}")).collect())
        }
        _ => Err(format!("`{text}` is no row of names: expected such as x1..x8, at most 32")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn boxes_are_read() {
        let domain = Domain::parse("x=-pi/2..pi/2,y=0..max(1,2), t = -inf..inf").unwrap();
        assert_eq!(domain.names(), ["x", "y", "t"]);
        assert_eq!(domain.sides()[0].length(), std::f64::consts::PI);
        assert_eq!(domain.sides()[1].high, 2.0);
        assert_eq!(domain.volume(), f64::INFINITY);
        assert_eq!(Domain::parse("x1..x32=0..1").unwrap().dimensions(), 32);
    }

    #[test]
    fn errors_name_the_place() {
        for (text, column, message) in [
            ("", 1, "expected name"),
            ("x=0..1,", 8, "expected name"),
            ("x=0..1,x=0..1", 8, "twice"),
            ("x=0..foo", 6, "unknown name"),
            ("x=0..1,y=1/0-1/0..1", 10, "no value"),
            ("x=5", 3, "expected name"),
            ("3=0..1", 1, "no name"),
            ("x1..y8=0..1", 1, "row of names"),
            ("x1..x40=0..1", 1, "row of names"),
            ("x1..x30=0..1,y1..y3=0..1", 14, "more than 32"),
            ("x=1..1", 3, "not below"),
        ] {
            let error = Domain::parse(text).unwrap_err();
            assert!(error.message().contains(message), "{text}: {error}");
            assert_eq!(error.column(), column, "{text}: {error}");
        }
    }
}
