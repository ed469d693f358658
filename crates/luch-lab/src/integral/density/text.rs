//! Densities in words.

use super::super::text_error::{constant, parts};
use super::{AxisDensity, Density, Domain, Share, TextError};

/// How densities are written, for messages and help.
pub(super) const FORMS: &str = "uniform, normal(mean, deviation), truncated(mean, deviation), exponential(rate), power(exponent), table(w1, w2, …), or a sum such as 0.1*uniform + 0.9*normal(0, 1)";

/// The most parts of a mixture, and cells of a table.
const MOST: usize = 4096;

impl Density {
    /// Reads a density over a box.
    ///
    /// # Errors
    ///
    /// The text is no density, names an axis that is not there or twice, or the density cannot be sampled on its axis.
    pub fn parse(text: &str, domain: &Domain) -> Result<Self, TextError> {
        if text.len() > 1 << 16 {
            return Err(TextError::new("longer than 65536 bytes", "", 0));
        }
        let pieces = parts(text, ',');
        let mut axes: Vec<Option<AxisDensity>> = vec![None; domain.dimensions()];
        let is_named = pieces.iter().any(|(_, piece)| piece.contains('='));
        if !is_named {
            let axis = axis(text, 0, text)?;
            axes.fill(Some(axis));
        } else {
            for (start, piece) in pieces {
                let Some((name, rest)) = piece.split_once('=') else {
                    return Err(TextError::new("expected axis=density, such as x=uniform", text, start));
                };
                let Some(at) = domain.sides().iter().position(|side| side.name == name.trim()) else {
                    let known = domain.names().join(", ");
                    let message = format!("unknown axis `{}`; known are {known}", name.trim());
                    return Err(TextError::new(message, text, start));
                };
                if axes[at].is_some() {
                    return Err(TextError::new(format!("`{}` is given twice", name.trim()), text, start));
                }
                axes[at] = Some(axis(text, start + name.len() + 1, rest)?);
            }
        }
        let axes: Vec<AxisDensity> =
            axes.into_iter().map(|axis| axis.unwrap_or(AxisDensity::Uniform)).collect();
        for (axis, side) in axes.iter().zip(domain.sides()) {
            if let Some(problem) = axis.problem(side) {
                return Err(TextError::new(problem, text, 0));
            }
        }
        Ok(Self { axes })
    }
}

/// One density, or a sum of shares.
fn axis(whole: &str, start: usize, text: &str) -> Result<AxisDensity, TextError> {
    let terms = parts(text, '+');
    if terms.len() > MOST {
        return Err(TextError::new("more than 4096 parts", whole, start));
    }
    if let [(_, term)] = terms.as_slice()
        && parts(term, '*').len() == 1
    {
        return single(whole, start, term);
    }
    let mut shares = Vec::new();
    for (at, term) in terms {
        let factors = parts(term, '*');
        let Some(((name_at, name), weights)) = factors.split_last() else { continue };
        let share = if weights.is_empty() { 1.0 } else { constant(whole, start + at, &term[..name_at - 1])? };
        shares.push(Share { share, density: single(whole, start + at + name_at, name)? });
    }
    Ok(AxisDensity::Mixture(shares))
}

/// A name with its arguments.
fn single(whole: &str, start: usize, text: &str) -> Result<AxisDensity, TextError> {
    let blank = text.len() - text.trim_start().len();
    let (start, text) = (start + blank, text.trim());
    let (name, arguments) = match text.split_once('(') {
        None => (text, Vec::new()),
        Some((name, rest)) => {
            let Some(inside) = rest.strip_suffix(')') else {
                return Err(TextError::new("expected `)` at the end", whole, start + text.len()));
            };
            let from = start + name.len() + 1;
            let pieces = parts(inside, ',');
            if pieces.len() > MOST {
                return Err(TextError::new("more than 4096 numbers", whole, from));
            }
            let values: Result<Vec<f64>, TextError> =
                pieces.into_iter().map(|(at, piece)| constant(whole, from + at, piece)).collect();
            (name.trim(), values?)
        }
    };
    match (name, arguments.as_slice()) {
        ("uniform", []) => Ok(AxisDensity::Uniform),
        ("normal", &[mean, deviation]) => Ok(AxisDensity::Normal { mean, deviation }),
        ("truncated", &[mean, deviation]) => Ok(AxisDensity::TruncatedNormal { mean, deviation }),
        ("exponential", &[rate]) => Ok(AxisDensity::Exponential { rate }),
        ("power", &[exponent]) => Ok(AxisDensity::Power { exponent }),
        ("table", [_, ..]) => Ok(AxisDensity::Table { weights: arguments }),
        ("uniform" | "normal" | "truncated" | "exponential" | "power" | "table", _) => {
            let message = format!("`{name}` does not take {} numbers; expected {FORMS}", arguments.len());
            Err(TextError::new(message, whole, start))
        }
        _ => Err(TextError::new(format!("unknown density `{name}`; expected {FORMS}"), whole, start)),
    }
}
