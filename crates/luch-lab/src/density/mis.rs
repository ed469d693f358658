//! Two densities at once: weights of the balance, the power and the optimal kind.

use super::quadrature;
use crate::figure::{Axis, Figure, Ink};
use crate::integral::{Density, Integral, IntegralError, Points};
use serde::Serialize;

/// How the samples of two techniques are weighed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum MisWeights {
    /// All by the first.
    First,
    /// All by the second.
    Second,
    /// In proportion to the densities (Veach and Guibas 1995).
    Balance,
    /// In proportion to their squares.
    Power,
    /// Those of least variance (Kondapaneni, Vévoda, Grittmann, Skřivan, Slusallek, Křivánek, "Optimal multiple importance
    /// sampling", 2019).
    Optimal,
}

impl MisWeights {
    /// All kinds.
    pub const ALL: [Self; 5] = [Self::First, Self::Second, Self::Balance, Self::Power, Self::Optimal];

    /// The name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::First => "first alone",
            Self::Second => "second alone",
            Self::Balance => "balance",
            Self::Power => "power",
            Self::Optimal => "optimal",
        }
    }
}

/// What one kind of weights gives.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct MisRow {
    /// Which.
    pub weights: MisWeights,
    /// Exact variance of the estimate from one sample of each technique; of one technique alone, from two of its samples.
    pub variance: f64,
    /// The mean found by sampling.
    pub estimate: f64,
    /// Its standard error, from the scatter of the pairs.
    pub standard_error: f64,
}

/// Two techniques compared.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Mis {
    /// One for each kind of weights.
    pub rows: Vec<MisRow>,
    /// The integral by quadrature.
    pub integral: f64,
    /// Integrand, densities and the weight of the first technique.
    pub figure: Figure,
}

/// Compares weights for an integral in one dimension with finite ends, sampled by its own density and by another.
///
/// With one sample of each, the estimate is w₁f/p₁ + w₂f/p₂. The optimal one is (f − αp₁ − βp₂)/(p₁ + p₂) at both samples plus
/// α + β, where α and β solve Σⱼ aᵢⱼ αⱼ = bᵢ with aᵢⱼ = ∫pᵢpⱼ/(p₁ + p₂) and bᵢ = ∫f pᵢ/(p₁ + p₂).
///
/// # Errors
///
/// The text is no density. `Ok(None)` if the integral has another dimension or infinite ends.
pub fn mis(
    integral: &Integral,
    second: &str,
    points: &dyn Points,
    pairs: usize,
) -> Result<Option<Mis>, IntegralError> {
    let other = Density::parse(second, &integral.domain).map_err(IntegralError::Density)?;
    let [side] = integral.domain.sides() else { return Ok(None) };
    if !side.length().is_finite() {
        return Ok(None);
    }
    let (first, second) = (&integral.density.axes()[0], &other.axes()[0]);
    let inside = |x: f64| side.low <= x && x <= side.high;
    let f = |x: f64| if inside(x) { integral.value(&[x]) } else { 0.0 };
    let p = |x: f64| [first.pdf(x, side), second.pdf(x, side)];
    let over = |function: &dyn Fn(f64) -> f64| quadrature(side.low, side.high, 800, function);
    let truth = over(&f);
    let shares = |x: f64| {
        let [a, b] = p(x);
        if a + b > 0.0 { [a / (a + b), b / (a + b)] } else { [0.0; 2] }
    };
    // Densities that reach beyond the domain leave the rest of a₁₁ there, where f is zero: taken from ∫pᵢ = 1.
    let beyond = [0, 1].map(|i| 1.0 - over(&|x| p(x)[i]));
    let cross = over(&|x| p(x)[0] * shares(x)[1]);
    let a = [[over(&|x| p(x)[0] * shares(x)[0]), cross], [cross, over(&|x| p(x)[1] * shares(x)[1])]];
    let is_cut = beyond.iter().all(|rest| rest.abs() < 1e-6);
    let b = [over(&|x| f(x) * shares(x)[0]), over(&|x| f(x) * shares(x)[1])];
    let determinant = a[0][0] * a[1][1] - a[0][1] * a[1][0];
    // Equal densities leave nothing to choose: then the balance is optimal. So too where densities reach far outside.
    let [alpha, beta] = if determinant.abs() > 1e-12 && is_cut {
        [(b[0] * a[1][1] - b[1] * a[0][1]) / determinant, (b[1] * a[0][0] - b[0] * a[1][0]) / determinant]
    } else {
        [0.0; 2]
    };
    // What technique i adds at x, for each kind.
    let term = |kind: MisWeights, i: usize, x: f64| -> f64 {
        let [p1, p2] = p(x);
        let own = [p1, p2][i];
        let value = f(x);
        match kind {
            MisWeights::First => {
                if i == 0 && value != 0.0 {
                    value / p1
                } else {
                    0.0
                }
            }
            MisWeights::Second => {
                if i == 1 && value != 0.0 {
                    value / p2
                } else {
                    0.0
                }
            }
            MisWeights::Balance => {
                if value == 0.0 {
                    0.0
                } else {
                    value / (p1 + p2)
                }
            }
            MisWeights::Power => {
                if value == 0.0 {
                    0.0
                } else {
                    own / (p1 * p1 + p2 * p2) * value
                }
            }
            MisWeights::Optimal => {
                if p1 + p2 > 0.0 {
                    (value - alpha * p1 - beta * p2) / (p1 + p2)
                } else {
                    0.0
                }
            }
        }
    };
    let variance = |kind: MisWeights| -> f64 {
        let of = |i: usize| {
            let mean = over(&|x| {
                let own = p(x)[i];
                if own > 0.0 { own * term(kind, i, x) } else { 0.0 }
            });
            let square = over(&|x| {
                let own = p(x)[i];
                if own > 0.0 { own * term(kind, i, x) * term(kind, i, x) } else { 0.0 }
            });
            square - mean * mean
        };
        let variance = match kind {
            // Two samples of the one technique, for as much work. What overflows stands for no bound at all.
            MisWeights::First => of(0) / 2.0,
            MisWeights::Second => of(1) / 2.0,
            _ => of(0) + of(1),
        };
        if variance.is_nan() { f64::INFINITY } else { variance }
    };
    let pairs = pairs.clamp(2, 1 << 24);
    let mut numbers = vec![0.0; 2 * pairs];
    points.fill(0, 0, 2, &mut numbers);
    let rows = MisWeights::ALL.into_iter().map(|kind| {
        let found: luch_sampling::Estimate = numbers
            .chunks(2)
            .map(|u| {
                let [x, y] = match kind {
                    MisWeights::First => [first.draw(u[0], side).x, first.draw(u[1], side).x],
                    MisWeights::Second => [second.draw(u[0], side).x, second.draw(u[1], side).x],
                    _ => [first.draw(u[0], side).x, second.draw(u[1], side).x],
                };
                match kind {
                    MisWeights::First => 0.5 * (term(kind, 0, x) + term(kind, 0, y)),
                    MisWeights::Second => 0.5 * (term(kind, 1, x) + term(kind, 1, y)),
                    MisWeights::Optimal => term(kind, 0, x) + term(kind, 1, y) + alpha + beta,
                    _ => term(kind, 0, x) + term(kind, 1, y),
                }
            })
            .collect();
        MisRow {
            weights: kind,
            variance: variance(kind),
            estimate: found.mean().unwrap_or(0.0),
            standard_error: found.standard_error().unwrap_or(0.0),
        }
    });
    let rows: Vec<MisRow> = rows.collect();
    let xs: Vec<f64> = (0..=400).map(|i| side.low + side.length() * f64::from(i) / 400.0).collect();
    let curve = |of: &dyn Fn(f64) -> f64| xs.iter().map(|&x| [x, of(x)]).collect::<Vec<_>>();
    let figure = Figure::new("Two densities, one integrand")
        .with_x(Axis::linear(&*side.name))
        .with_y(Axis::linear(""))
        .line("integrand over integral", Ink::Text, curve(&|x| f(x) / truth))
        .line("first density", Ink::Blue, curve(&|x| p(x)[0]))
        .line("second density", Ink::Vermilion, curve(&|x| p(x)[1]))
        .dashed("weight of the first (balance)", Ink::Green, curve(&|x| shares(x)[0]));
    Ok(Some(Mis { rows, integral: truth, figure }))
}
