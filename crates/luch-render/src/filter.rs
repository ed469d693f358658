//! Pixel filters, importance-sampled: a sample falls where the filter is, and counts fully for its one pixel (Ernst, Stamminger and
//! Greiner, "Filter importance sampling", 2006).

use luch_sampling::Piecewise1d;
use luch_sampling::warp::tent;
use luch_scene::Filter;
use std::f64::consts::PI;

/// Cells of the tables of filters without a closed inverse.
const CELLS: usize = 1024;

/// A filter that can be sampled: offsets are drawn with the filter, divided by its integral, as their density.
#[derive(Debug)]
pub struct FilterSampler {
    kind: Kind,
}

#[derive(Debug)]
enum Kind {
    Box { radius: f32 },
    Tent { radius: f32 },
    Table { radius: f32, table: Piecewise1d },
}

impl FilterSampler {
    /// The sampler of a filter; those without a closed inverse are tabulated in 1024 cells.
    pub fn new(filter: Filter) -> Self {
        let kind = match filter {
            Filter::Box { radius } => Kind::Box { radius },
            Filter::Tent { radius } => Kind::Tent { radius },
            Filter::Gaussian { radius, deviation } => {
                let wide = f64::from(radius / deviation);
                tabulated(radius, |x| libm::exp(-0.5 * x * x * wide * wide))
            }
            Filter::BlackmanHarris { radius } => tabulated(radius, blackman_harris),
        };
        Self { kind }
    }

    /// Offset from the pixel's centre along one axis, in pixels; `u` in [0, 1).
    pub fn offset(&self, u: f32) -> f32 {
        match &self.kind {
            Kind::Box { radius } => (2.0 * u - 1.0) * radius,
            Kind::Tent { radius } => tent(u, *radius),
            Kind::Table { radius, table } => (2.0 * table.sample(u).position - 1.0) * radius,
        }
    }
}

/// A table of `window` over −1 to 1.
fn tabulated(radius: f32, window: impl Fn(f64) -> f64) -> Kind {
    let at = |cell: usize| (window((2 * cell + 1) as f64 / CELLS as f64 - 1.0)) as f32;
    let values: Vec<f32> = (0..CELLS).map(at).collect();
    match Piecewise1d::new(&values) {
        Ok(table) => Kind::Table { radius, table },
        // A Gaussian far narrower than a cell is a point in the middle.
        Err(_) => Kind::Box { radius: radius / CELLS as f32 },
    }
}

/// The Blackman–Harris window of four terms (Harris 1978), over −1 to 1.
fn blackman_harris(x: f64) -> f64 {
    let term = |k: f64| libm::cos(k * PI * (x + 1.0));
    0.35875 - 0.48829 * term(1.0) + 0.14128 * term(2.0) - 0.01168 * term(3.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Variance of a filter by quadrature of its inverse.
    fn variance(filter: Filter) -> f64 {
        let sampler = FilterSampler::new(filter);
        let n = 1 << 20;
        (0..n).map(|i| f64::from(sampler.offset((i as f32 + 0.5) / n as f32))).map(|x| x * x).sum::<f64>()
            / f64::from(n)
    }

    #[test]
    fn second_moments_are_those_of_the_windows() {
        assert!((variance(Filter::Box { radius: 0.5 }) - 1.0 / 12.0).abs() < 1e-6);
        assert!((variance(Filter::Tent { radius: 1.0 }) - 1.0 / 6.0).abs() < 1e-6);
        let gaussian = variance(Filter::Gaussian { radius: 3.0, deviation: 0.5 });
        // Cut at six deviations nothing is lost; a cell of the table adds its own width² / 12.
        let cell = (6.0 / CELLS as f64) * (6.0 / CELLS as f64) / 12.0;
        assert!((gaussian - 0.25 - cell).abs() < 2e-6, "{gaussian}");
        // ∫ x² cos(k π (x + 1)) over −1 to 1 is 4 / (k π)², ∫ x² is 2/3, ∫ w is 2 · 0.35875.
        let exact = (0.35875 * 2.0 / 3.0
            + (-0.48829) * (4.0 / (PI * PI))
            + 0.14128 * (4.0 / (4.0 * PI * PI))
            + (-0.01168) * (4.0 / (9.0 * PI * PI)))
            / (2.0 * 0.35875);
        let measured = variance(Filter::BlackmanHarris { radius: 1.0 });
        assert!((measured - exact).abs() < 1e-5, "{measured} {exact}");
    }
}
