//! Discrepancies with closed forms, in any number of dimensions, in time N²·d.
//!
//! Squared forms as Hickernell defines them ("A generalized discrepancy and quadrature error bound", 1998).

use crate::points::PointSet;

/// Sums a symmetric function over all pairs of points, each pair once and doubled, the pairs of a point with itself once.
fn double_sum(points: &PointSet, factor: impl Fn(f64, f64) -> f64) -> f64 {
    let mut sum = 0.0;
    for (i, p) in points.iter().enumerate() {
        let product = |q: &[f64]| p.iter().zip(q).map(|(&x, &y)| factor(x, y)).product::<f64>();
        // A sum for each point keeps the rounding small.
        let row: f64 = points.iter().take(i).map(product).sum();
        sum += 2.0 * row + product(p);
    }
    sum
}

fn single_sum(points: &PointSet, factor: impl Fn(f64) -> f64) -> f64 {
    points.iter().map(|p| p.iter().map(|&x| factor(x)).product::<f64>()).sum()
}

fn power(base: f64, exponent: usize) -> f64 {
    (0..exponent).fold(1.0, |product, _| product * base)
}

/// Squared L2 star discrepancy (Warnock 1972); 0 for no points.
///
/// 3^−d − (2^(1−d)/N) Σᵢ Πⱼ (1 − xᵢⱼ²) + N^−2 ΣᵢΣₖ Πⱼ (1 − max(xᵢⱼ, xₖⱼ)). For independent points its mean is (2^−d − 3^−d)/N.
pub fn l2_star_squared(points: &PointSet) -> f64 {
    if points.is_empty() {
        return 0.0;
    }
    let (n, d) = (points.len() as f64, points.dimensions());
    let single = single_sum(points, |x| 1.0 - x * x);
    let double = double_sum(points, |x, y| 1.0 - x.max(y));
    (power(1.0 / 3.0, d) - 2.0 * power(0.5, d) / n * single + double / (n * n)).max(0.0)
}

/// L2 star discrepancy: the root of [`l2_star_squared`].
pub fn l2_star(points: &PointSet) -> f64 {
    l2_star_squared(points).sqrt()
}

/// Squared centred L2 discrepancy: boxes from the nearest corner, in all projections; 0 for no points.
pub fn centred_squared(points: &PointSet) -> f64 {
    if points.is_empty() {
        return 0.0;
    }
    let (n, d) = (points.len() as f64, points.dimensions());
    let off = |x: f64| (x - 0.5).abs();
    let single = single_sum(points, |x| 1.0 + 0.5 * off(x) - 0.5 * off(x) * off(x));
    let double = double_sum(points, |x, y| 1.0 + 0.5 * off(x) + 0.5 * off(y) - 0.5 * (x - y).abs());
    (power(13.0 / 12.0, d) - 2.0 / n * single + double / (n * n)).max(0.0)
}

/// Squared wrap-around L2 discrepancy: boxes on the torus, in all projections; 0 for no points.
pub fn wrap_around_squared(points: &PointSet) -> f64 {
    if points.is_empty() {
        return 0.0;
    }
    let (n, d) = (points.len() as f64, points.dimensions());
    let double = double_sum(points, |x, y| {
        let distance = (x - y).abs();
        1.5 - distance * (1.0 - distance)
    });
    (double / (n * n) - power(4.0 / 3.0, d)).max(0.0)
}
