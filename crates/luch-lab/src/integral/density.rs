//! Densities along one axis, sampled by inversion, and products of them.

mod text;

use super::domain::Side;
use super::quantile::{normal_cumulative, normal_pdf, normal_quantile};
use super::{Domain, TextError};

/// A density along one axis. Samples may fall outside the domain: there the integrand counts as zero.
#[derive(Clone, Debug, PartialEq)]
pub enum AxisDensity {
    /// The same everywhere between the ends of the domain.
    Uniform,
    /// Normal, with this mean and standard deviation, on the whole line.
    Normal {
        /// Where it is greatest.
        mean: f64,
        /// Standard deviation, positive.
        deviation: f64,
    },
    /// Normal, cut at the ends of the domain and made to integrate to one there.
    TruncatedNormal {
        /// Mean before cutting.
        mean: f64,
        /// Standard deviation before cutting, positive.
        deviation: f64,
    },
    /// `rate · exp(−rate (x − low))` from the lower end of the domain to infinity.
    Exponential {
        /// Positive.
        rate: f64,
    },
    /// In proportion to `((x − low)/(high − low))^exponent`.
    Power {
        /// Above −1.
        exponent: f64,
    },
    /// Constant in cells of equal length.
    Table {
        /// Heights of the cells in proportion; not negative, not all zero.
        weights: Vec<f64>,
    },
    /// A choice of several; the shares add up to one.
    Mixture(Vec<Share>),
}

/// A part of a mixture.
#[derive(Clone, Debug, PartialEq)]
pub struct Share {
    /// How often it is chosen, 0 to 1.
    pub share: f64,
    /// What then is drawn.
    pub density: AxisDensity,
}

/// A place and the density there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drawn {
    /// The place.
    pub x: f64,
    /// The density at it, per unit length.
    pub pdf: f64,
}

impl AxisDensity {
    /// Draws a place from a number between 0 and 1: the place grows with the number, or does so within each part of a mixture.
    pub fn draw(&self, u: f64, side: &Side) -> Drawn {
        let x = self.invert(u.clamp(f64::MIN_POSITIVE, 1.0 - f64::EPSILON / 2.0), side);
        Drawn { x, pdf: self.pdf(x, side) }
    }

    fn invert(&self, u: f64, side: &Side) -> f64 {
        match self {
            Self::Uniform => side.low + u * side.length(),
            Self::Normal { mean, deviation } => mean + deviation * normal_quantile(u),
            Self::TruncatedNormal { mean, deviation } => {
                let ends = [side.low, side.high].map(|end| (end - mean) / deviation);
                // Tails far above the mean are computed as tails far below, where small numbers are exact.
                let flip = if ends[0] > 0.0 { -1.0 } else { 1.0 };
                let [a, b] = ends.map(|end| normal_cumulative(flip * end));
                let x = mean + deviation * flip * normal_quantile(a + u * (b - a));
                x.clamp(side.low, side.high)
            }
            Self::Exponential { rate } => side.low - libm::log1p(-u) / rate,
            Self::Power { exponent } => side.low + side.length() * libm::pow(u, 1.0 / (exponent + 1.0)),
            Self::Table { weights } => {
                let total: f64 = weights.iter().sum();
                let mut rest = u * total;
                let mut cell = weights.len() - 1;
                for (at, &weight) in weights.iter().enumerate() {
                    if rest < weight {
                        cell = at;
                        break;
                    }
                    rest -= weight;
                }
                // Rounding may lead past the last cell that has any weight.
                while cell > 0 && weights[cell] == 0.0 {
                    cell -= 1;
                    rest = weights[cell];
                }
                let inside = (rest / weights[cell]).clamp(0.0, 1.0 - f64::EPSILON);
                side.low + side.length() * (cell as f64 + inside) / weights.len() as f64
            }
            Self::Mixture(parts) => {
                let mut rest = u;
                for (at, part) in parts.iter().enumerate() {
                    if rest < part.share || at + 1 == parts.len() {
                        let inside = (rest / part.share).clamp(f64::MIN_POSITIVE, 1.0 - f64::EPSILON / 2.0);
                        return part.density.invert(inside, side);
                    }
                    rest -= part.share;
                }
                f64::NAN
            }
        }
    }

    /// The density at a place, per unit length.
    pub fn pdf(&self, x: f64, side: &Side) -> f64 {
        let is_inside = side.low <= x && x <= side.high;
        match self {
            Self::Uniform => {
                if is_inside {
                    1.0 / side.length()
                } else {
                    0.0
                }
            }
            Self::Normal { mean, deviation } => normal_pdf((x - mean) / deviation) / deviation,
            Self::TruncatedNormal { mean, deviation } => {
                if !is_inside {
                    return 0.0;
                }
                let ends = [side.low, side.high].map(|end| (end - mean) / deviation);
                let flip = if ends[0] > 0.0 { -1.0 } else { 1.0 };
                let [a, b] = ends.map(|end| normal_cumulative(flip * end));
                normal_pdf((x - mean) / deviation) / (deviation * (b - a).abs())
            }
            Self::Exponential { rate } => {
                if x >= side.low {
                    rate * libm::exp(-rate * (x - side.low))
                } else {
                    0.0
                }
            }
            Self::Power { exponent } => {
                if !is_inside {
                    return 0.0;
                }
                let fraction = (x - side.low) / side.length();
                (exponent + 1.0) * libm::pow(fraction, *exponent) / side.length()
            }
            Self::Table { weights } => {
                if !is_inside {
                    return 0.0;
                }
                let cells = weights.len() as f64;
                let cell = ((x - side.low) / side.length() * cells) as usize;
                let total: f64 = weights.iter().sum();
                weights[cell.min(weights.len() - 1)] / total * cells / side.length()
            }
            Self::Mixture(parts) => parts.iter().map(|part| part.share * part.density.pdf(x, side)).sum(),
        }
    }

    /// What speaks against it on a side, if anything does.
    fn problem(&self, side: &Side) -> Option<String> {
        let is_finite = side.length().is_finite();
        let needs_ends = |name: &str| {
            (!is_finite).then(|| {
                format!("{name} needs finite ends; {} has not: use normal(mean, deviation)", side.name)
            })
        };
        let positive = |value: f64, name: &str| {
            (!(value > 0.0 && value.is_finite())).then(|| format!("{name} must be positive, not {value}"))
        };
        match self {
            Self::Uniform => needs_ends("uniform"),
            Self::Normal { mean, deviation } => positive(*deviation, "the standard deviation")
                .or_else(|| (!mean.is_finite()).then(|| format!("the mean must be finite, not {mean}"))),
            Self::TruncatedNormal { mean, deviation } => positive(*deviation, "the standard deviation")
                .or_else(|| {
                    let ends = [side.low, side.high].map(|end| (end - mean) / deviation);
                    let flip = if ends[0] > 0.0 { -1.0 } else { 1.0 };
                    let [a, b] = ends.map(|end| normal_cumulative(flip * end));
                    let share = (b - a).abs();
                    (share.is_nan() || share <= 1e-290)
                        .then(|| "the normal distribution has no weight in the domain".into())
                }),
            Self::Exponential { rate } => positive(*rate, "the rate").or_else(|| {
                (!side.low.is_finite()).then(|| "exponential needs a finite lower end".to_owned())
            }),
            Self::Power { exponent } => needs_ends("power").or_else(|| {
                (!(*exponent > -1.0 && exponent.is_finite()))
                    .then(|| format!("the exponent must be above −1, not {exponent}"))
            }),
            Self::Table { weights } => needs_ends("table").or_else(|| {
                let fine = weights.iter().all(|w| *w >= 0.0 && w.is_finite());
                let total: f64 = weights.iter().sum();
                (!(fine && total > 0.0 && total.is_finite()))
                    .then(|| "a table needs numbers that are not negative and not all zero".to_owned())
            }),
            Self::Mixture(parts) => {
                let total: f64 = parts.iter().map(|part| part.share).sum();
                if let Some(part) = parts.iter().find(|part| part.share.is_nan() || part.share <= 0.0) {
                    return Some(format!("the shares of a mixture must be positive, not {}", part.share));
                }
                if total.is_nan() || (total - 1.0).abs() >= 1e-9 {
                    return Some(format!("the shares of a mixture must add up to 1, not {total}"));
                }
                parts.iter().find_map(|part| part.density.problem(side))
            }
        }
    }
}

/// A density over a box: the product of one for each axis.
///
/// As text: `normal(0, 0.15)` for all axes, or `x=0.1*uniform + 0.9*normal(0, 0.15), y=power(2)`; axes that are not named are
/// uniform.
#[derive(Clone, Debug, PartialEq)]
pub struct Density {
    axes: Vec<AxisDensity>,
}

impl Density {
    /// Uniform over a box.
    pub fn uniform(domain: &Domain) -> Self {
        Self { axes: vec![AxisDensity::Uniform; domain.dimensions()] }
    }

    /// A product of densities, one for each side of the box.
    ///
    /// # Errors
    ///
    /// There is not one for each side, or one cannot be sampled there.
    pub fn product(axes: Vec<AxisDensity>, domain: &Domain) -> Result<Self, TextError> {
        if axes.len() != domain.dimensions() {
            let message = format!("{} densities for {} dimensions", axes.len(), domain.dimensions());
            return Err(TextError::new(message, "", 0));
        }
        match axes.iter().zip(domain.sides()).find_map(|(axis, side)| axis.problem(side)) {
            Some(problem) => Err(TextError::new(problem, "", 0)),
            None => Ok(Self { axes }),
        }
    }

    /// The densities of the axes.
    pub fn axes(&self) -> &[AxisDensity] {
        &self.axes
    }

    /// Draws a point from a uniform one, both with one number for each side; returns the density there.
    pub fn draw(&self, uniform: &[f64], domain: &Domain, point: &mut [f64]) -> f64 {
        let mut pdf = 1.0;
        for (((axis, side), &u), x) in self.axes.iter().zip(domain.sides()).zip(uniform).zip(point) {
            let drawn = axis.draw(u, side);
            *x = drawn.x;
            pdf *= drawn.pdf;
        }
        pdf
    }

    /// The density at a point.
    pub fn pdf(&self, point: &[f64], domain: &Domain) -> f64 {
        self.axes.iter().zip(domain.sides()).zip(point).map(|((axis, side), &x)| axis.pdf(x, side)).product()
    }

    /// Whether it is uniform on all axes.
    pub fn is_uniform(&self) -> bool {
        self.axes.iter().all(|axis| *axis == AxisDensity::Uniform)
    }
}

#[cfg(test)]
mod tests;
