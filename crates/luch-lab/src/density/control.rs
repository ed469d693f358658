//! Control variates: take away something similar whose integral is known.

use crate::figure::{Axis, Figure, Ink};
use crate::integral::{Integral, Points};
use serde::Serialize;

/// An integral with the help of another.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ControlVariate {
    /// How much of the control is taken away: covariance over its variance, from the first tenth of the points, which are not used
    /// again, so that the estimate has no bias.
    pub factor: f64,
    /// Correlation of both.
    pub correlation: f64,
    /// Variance of a sample without control.
    pub plain_variance: f64,
    /// Variance of a sample with it.
    pub variance: f64,
    /// The estimate with control.
    pub estimate: f64,
    /// Its standard error, for independent points.
    pub standard_error: f64,
}

/// The integral of f by f − factor·(g − known), where g has the same domain and density and a known integral (its truth). `None`
/// if g's is not known, dimensions differ, or there are fewer than 100 points.
pub fn control_variate(
    f: &Integral,
    g: &Integral,
    points: &dyn Points,
    count: usize,
) -> Option<ControlVariate> {
    let known = g.truth?;
    if f.dimensions() != g.dimensions() || f.density != g.density || count < 100 {
        return None;
    }
    let count = count.min(1 << 24);
    let (fs, gs) = (f.samples(points, 0, count), g.samples(points, 0, count));
    let pilot = count / 10;
    let (mean_f, mean_g) = (mean(&fs[..pilot]), mean(&gs[..pilot]));
    let moment = |a: &[f64], am: f64, b: &[f64], bm: f64| {
        a.iter().zip(b).map(|(a, b)| (a - am) * (b - bm)).sum::<f64>() / (a.len() - 1) as f64
    };
    let (ff, gg) = (
        moment(&fs[..pilot], mean_f, &fs[..pilot], mean_f),
        moment(&gs[..pilot], mean_g, &gs[..pilot], mean_g),
    );
    let fg = moment(&fs[..pilot], mean_f, &gs[..pilot], mean_g);
    let factor = if gg > 0.0 { fg / gg } else { 0.0 };
    let correlation = if ff * gg > 0.0 { fg / (ff * gg).sqrt() } else { 0.0 };
    let rest: luch_sampling::Estimate =
        fs[pilot..].iter().zip(&gs[pilot..]).map(|(f, g)| f - factor * (g - known)).collect();
    let plain: luch_sampling::Estimate = fs[pilot..].iter().copied().collect();
    Some(ControlVariate {
        factor,
        correlation,
        plain_variance: plain.variance()?,
        variance: rest.variance()?,
        estimate: rest.mean()?,
        standard_error: rest.standard_error()?,
    })
}

/// Integrand, control, and what is left of the integrand when the control is taken away. `None` but for one dimension with finite ends.
pub fn control_figure(f: &Integral, g: &Integral, found: &ControlVariate) -> Option<Figure> {
    let [side] = f.domain.sides() else { return None };
    let known = g.truth?;
    if !side.length().is_finite() {
        return None;
    }
    let xs: Vec<f64> = (0..=400).map(|i| side.low + side.length() * f64::from(i) / 400.0).collect();
    let mean = known / side.length();
    let curve = |of: &dyn Fn(f64) -> f64| xs.iter().map(|&x| [x, of(x)]).collect::<Vec<_>>();
    let left = |x: f64| f.value(&[x]) - found.factor * (g.value(&[x]) - mean);
    Some(
        Figure::new("A control variate takes away what is known")
            .with_caption("What is left has the integral of the integrand; the flatter it is, the less error has its mean.")
            .with_x(Axis::linear(&*side.name))
            .with_y(Axis::linear(""))
            .line("integrand", Ink::Text, curve(&|x| f.value(&[x])))
            .dashed("control", Ink::Blue, curve(&|x| g.value(&[x])))
            .line("what is left", Ink::Vermilion, curve(&left)),
    )
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len().max(1) as f64
}
