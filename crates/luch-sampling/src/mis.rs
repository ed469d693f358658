//! Multiple importance sampling: how much a sample counts when several techniques could have drawn it.
//!
//! Every function takes the densities that the techniques have *for this sample* (times their sample counts, if these
//! differ) and returns the weight of one of them, in [0, 1]. The weights of all techniques add to one wherever some density
//! is positive. Zero and infinite densities are safe: a technique that cannot draw the sample has weight zero, and infinite
//! ones (a mirror, a point light) share the sample among themselves. Negative and not-a-number densities count as zero.
//! Veach and Guibas, "Optimally combining sampling techniques for Monte Carlo rendering" (1995).

/// The balance heuristic for two techniques: weight of the one with density `pdf`.
#[inline]
pub fn balance(pdf: f32, other_pdf: f32) -> f32 {
    weight(pdf, other_pdf, |ratio| ratio)
}

/// The power heuristic (exponent 2) for two techniques: weight of the one with density `pdf`.
///
/// Better than [`balance`] where one technique is clearly right, as with small lamps and sharp lobes.
#[inline]
pub fn power(pdf: f32, other_pdf: f32) -> f32 {
    weight(pdf, other_pdf, |ratio| ratio * ratio)
}

/// The balance heuristic for any number of techniques: weight of technique `index`; zero when there is no such technique.
pub fn balance_n(index: usize, pdfs: &[f32]) -> f32 {
    weight_n(index, pdfs, |ratio| ratio)
}

/// The power heuristic (exponent 2) for any number of techniques: weight of technique `index`.
pub fn power_n(index: usize, pdfs: &[f32]) -> f32 {
    weight_n(index, pdfs, |ratio| ratio * ratio)
}

/// Whether a technique cannot draw the sample; negative and not-a-number densities count as zero.
#[inline]
fn is_impossible(pdf: f32) -> bool {
    pdf.is_nan() || pdf <= 0.0
}

/// 1 / (1 + shaped ratio): a ratio cannot overflow to a wrong weight, as a square of a density could.
#[inline]
fn weight(pdf: f32, other_pdf: f32, shape: impl Fn(f32) -> f32) -> f32 {
    if is_impossible(pdf) {
        return 0.0;
    }
    if is_impossible(other_pdf) {
        return 1.0;
    }
    if pdf.is_infinite() {
        return if other_pdf.is_infinite() { 0.5 } else { 1.0 };
    }
    1.0 / (1.0 + shape(other_pdf / pdf))
}

fn weight_n(index: usize, pdfs: &[f32], shape: impl Fn(f32) -> f32) -> f32 {
    let Some(&pdf) = pdfs.get(index) else { return 0.0 };
    if is_impossible(pdf) {
        return 0.0;
    }
    if pdf.is_infinite() {
        return 1.0 / pdfs.iter().filter(|&&other| other == f32::INFINITY).count() as f32;
    }
    // The own ratio is exactly one.
    let sum: f32 = pdfs.iter().filter(|&&other| other > 0.0).map(|&other| shape(other / pdf)).sum();
    1.0 / sum
}

#[cfg(test)]
mod tests {
    use super::*;

    const DENSITIES: [f32; 10] =
        [0.0, 1e-44, 1e-30, 0.3, 1.0, 7.0, 1e20, 3e38, f32::INFINITY, f32::MIN_POSITIVE];

    #[test]
    fn weights_add_to_one() {
        for a in DENSITIES {
            for b in DENSITIES {
                let expected = if a == 0.0 && b == 0.0 { 0.0 } else { 1.0 };
                for (name, sum) in [
                    ("balance", balance(a, b) + balance(b, a)),
                    ("power", power(a, b) + power(b, a)),
                    ("balance_n", balance_n(0, &[a, b]) + balance_n(1, &[a, b])),
                    ("power_n", power_n(0, &[a, b]) + power_n(1, &[a, b])),
                ] {
                    assert!((sum - expected).abs() < 4.0 * f32::EPSILON, "{name}({a}, {b}): {sum}");
                }
                for c in DENSITIES {
                    let pdfs = [a, b, c];
                    let sum: f32 = (0..3).map(|i| power_n(i, &pdfs)).sum();
                    let expected = if pdfs == [0.0; 3] { 0.0 } else { 1.0 };
                    assert!((sum - expected).abs() < 8.0 * f32::EPSILON, "{pdfs:?}: {sum}");
                }
            }
        }
    }

    #[test]
    fn known_weights() {
        assert_eq!(balance(1.0, 3.0), 0.25);
        assert_eq!(power(1.0, 3.0), 0.1);
        assert_eq!(power(0.0, 0.0), 0.0);
        assert_eq!(power(f32::INFINITY, 5.0), 1.0);
        assert_eq!(power(5.0, f32::INFINITY), 0.0);
        assert_eq!(power(f32::NAN, 1.0), 0.0);
        assert_eq!(balance(1.0, f32::NAN), 1.0);
        assert_eq!(balance_n(1, &[1.0, 1.0, 2.0]), 0.25);
        assert_eq!(balance_n(7, &[1.0]), 0.0);
        let inf = f32::INFINITY;
        assert_eq!(power_n(2, &[inf, 1.0, inf]), 0.5);
    }
}
