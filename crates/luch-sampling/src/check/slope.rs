//! How fast an error falls: a straight line through logarithms.

/// The line log₂ y ≈ intercept + slope · log₂ x.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slope {
    /// Exponent s of y ~ x^s.
    pub slope: f64,
    /// log₂ of y at x = 1.
    pub intercept: f64,
    /// Standard error of the slope from the scatter about the line; zero for two points.
    pub standard_error: f64,
}

/// Fits a power law to points [x, y] by least squares of the logarithms.
///
/// Points without positive finite coordinates are left out; `None` if fewer than two different x remain.
pub fn fit_slope(points: &[[f64; 2]]) -> Option<Slope> {
    let logarithms: Vec<[f64; 2]> = points
        .iter()
        .filter(|point| point.iter().all(|&v| v > 0.0 && v.is_finite()))
        .map(|point| point.map(libm::log2))
        .collect();
    let n = logarithms.len() as f64;
    let mean = |axis: usize| logarithms.iter().map(|point| point[axis]).sum::<f64>() / n;
    let (mean_x, mean_y) = (mean(0), mean(1));
    let spread: f64 = logarithms.iter().map(|[x, _]| (x - mean_x) * (x - mean_x)).sum();
    if spread.is_nan() || spread <= 0.0 {
        return None;
    }
    let slope = logarithms.iter().map(|[x, y]| (x - mean_x) * (y - mean_y)).sum::<f64>() / spread;
    let intercept = mean_y - slope * mean_x;
    let residual: f64 =
        logarithms.iter().map(|[x, y]| y - intercept - slope * x).map(|distance| distance * distance).sum();
    let standard_error = if n > 2.0 { (residual / (n - 2.0) / spread).sqrt() } else { 0.0 };
    Some(Slope { slope, intercept, standard_error })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_the_exponent() {
        let fit = fit_slope(&[[1.0, 8.0], [4.0, 1.0], [16.0, 0.125], [0.0, 3.0]]).unwrap();
        assert!((fit.slope + 1.5).abs() < 1e-14 && (fit.intercept - 3.0).abs() < 1e-14);
        assert!(fit.standard_error < 1e-14);
        assert_eq!(fit_slope(&[[2.0, 1.0], [2.0, 3.0]]), None);
        assert_eq!(fit_slope(&[]), None);
    }
}
