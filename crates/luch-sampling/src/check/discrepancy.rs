//! How uneven a set of points is.

/// The L2 star discrepancy of points of the unit cube; zero for no points.
///
/// Warnock's formula (1972): (L2*)² = 3^−d − 2^(1−d)/N · Σ Π(1 − x²) + N⁻² · ΣΣ Π(1 − max(x, y)). Time grows with N².
pub fn l2_star_discrepancy<const D: usize>(points: &[[f64; D]]) -> f64 {
    if points.is_empty() {
        return 0.0;
    }
    let n = points.len() as f64;
    let power = |base: f64| (0..D).fold(1.0, |product, _| product * base);
    let single: f64 = points.iter().map(|p| p.iter().map(|x| 1.0 - x * x).product::<f64>()).sum();
    let mut double = 0.0;
    for (i, p) in points.iter().enumerate() {
        double += p.iter().map(|x| 1.0 - x).product::<f64>();
        for q in &points[..i] {
            double += 2.0 * p.iter().zip(q).map(|(x, y)| 1.0 - x.max(*y)).product::<f64>();
        }
    }
    (power(1.0 / 3.0) - 2.0 * power(0.5) / n * single + double / (n * n)).max(0.0).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn midpoints_have_the_least() {
        for n in [1, 7, 100] {
            let points: Vec<[f64; 1]> = (0..n).map(|i| [(f64::from(i) + 0.5) / f64::from(n)]).collect();
            let expected = (1.0 / (12.0 * f64::from(n * n))).sqrt();
            assert!((l2_star_discrepancy(&points) - expected).abs() < 1e-9, "{n}");
        }
        assert_eq!(l2_star_discrepancy::<2>(&[]), 0.0);
    }
}
