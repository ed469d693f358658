//! Five integrands from smooth to torn, with exact means.

use std::f64::consts::{E, PI};

/// Most dimensions in which all integrands have a mean.
pub const MOST_SLOPE_DIMENSIONS: usize = 4;

/// Direction of the oblique planes; no two entries have a rational ratio.
const NORMAL: [f64; MOST_SLOPE_DIMENSIONS] = [1.0, 0.732_050_8, 0.618_033_99, 0.414_213_56];

/// A test integrand on the unit cube.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Integrand {
    /// Mean of e^x over the coordinates: no two of them work together.
    Additive,
    /// Product of e^x/(e − 1).
    Smooth,
    /// max(n·x − 0.45 Σn, 0): continuous, with a kink along an oblique plane.
    Kink,
    /// 1 in the ball of radius ½ about the middle.
    Ball,
    /// 1 where n·x > 0.45 Σn.
    HalfSpace,
}

impl Integrand {
    /// All members, smoothest first.
    pub const ALL: [Integrand; 5] =
        [Integrand::Additive, Integrand::Smooth, Integrand::Kink, Integrand::Ball, Integrand::HalfSpace];

    /// The name used in tables and on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Integrand::Additive => "additive",
            Integrand::Smooth => "smooth",
            Integrand::Kink => "kink",
            Integrand::Ball => "ball",
            Integrand::HalfSpace => "half-space",
        }
    }

    /// The member with this [`name`](Self::name), or `None`.
    pub fn from_name(name: &str) -> Option<Integrand> {
        Self::ALL.into_iter().find(|integrand| integrand.name() == name)
    }

    /// The value at a point. Planes look at the first four coordinates only.
    pub fn value(self, point: &[f64]) -> f64 {
        match self {
            Integrand::Additive => point.iter().map(|x| libm::exp(*x)).sum::<f64>() / point.len() as f64,
            Integrand::Smooth => {
                // One exponential for all factors.
                let over = point.iter().fold(1.0, |product, _| product * (E - 1.0));
                libm::exp(point.iter().sum()) / over
            }
            Integrand::Kink => height(point).max(0.0),
            Integrand::Ball => f64::from(point.iter().map(|x| (x - 0.5) * (x - 0.5)).sum::<f64>() <= 0.25),
            Integrand::HalfSpace => f64::from(height(point) > 0.0),
        }
    }

    /// The mean over the unit cube; `None` where it is not known here: planes in more than four dimensions, and without dimensions.
    pub fn mean(self, dimensions: usize) -> Option<f64> {
        let d = dimensions as f64;
        match self {
            _ if dimensions == 0 => None,
            Integrand::Additive => Some(E - 1.0),
            Integrand::Smooth => Some(1.0),
            // The volume of a ball, π^(d/2) r^d / (d/2)!.
            Integrand::Ball => Some(libm::pow(PI, d / 2.0) * libm::pow(0.5, d) / libm::tgamma(d / 2.0 + 1.0)),
            Integrand::Kink => ramp_mean(dimensions, 1),
            Integrand::HalfSpace => ramp_mean(dimensions, 0),
        }
    }
}

/// n·x less its threshold.
fn height(point: &[f64]) -> f64 {
    point.iter().zip(NORMAL).map(|(x, n)| n * (x - 0.45)).sum()
}

/// ∫ over the unit cube of (n·x − t)₊^p by inclusion and exclusion of corners: Σ ± (n·corner − t)₊^(d+p) / Π n / (d+p)!.
fn ramp_mean(dimensions: usize, power: u32) -> Option<f64> {
    let normal = NORMAL.get(..dimensions)?;
    let threshold = 0.45 * normal.iter().sum::<f64>();
    let mut sum = 0.0;
    for corner in 0..1u32 << dimensions {
        let chosen = normal.iter().enumerate().filter(|(axis, _)| corner >> axis & 1 == 1);
        let height = chosen.map(|(_, n)| n).sum::<f64>() - threshold;
        let sign = if (dimensions as u32 - corner.count_ones()).is_multiple_of(2) { 1.0 } else { -1.0 };
        if height > 0.0 {
            let factors = 0..dimensions as u32 + power;
            sum += sign * factors.fold(1.0, |product, k| product * height / f64::from(k + 1));
        }
    }
    Some(sum / normal.iter().product::<f64>())
}
