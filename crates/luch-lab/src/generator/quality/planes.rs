//! The planes on which the points of a congruence lie, and from where one sees them.

use super::lattice::spectral;
use crate::generator::Lcg;

/// The family of parallel planes, farthest apart, that holds all points of successive numbers in the unit cube.
#[derive(Clone, Debug, PartialEq)]
pub struct Planes {
    /// A whole-number vector across the planes: on each of them its product with x is one whole number plus `offset`.
    pub vector: Vec<i128>,
    /// The same of unit length.
    pub normal: Vec<f64>,
    /// A unit vector within the planes: who looks along it sees each plane as a line.
    pub view: Vec<f64>,
    /// Distance of neighbouring planes.
    pub distance: f64,
    /// What the addend of the congruence adds to all products, in [0, 1).
    pub offset: f64,
    /// Planes that meet the open unit cube.
    pub count: u128,
}

impl Planes {
    /// The planes of a congruence in 2 to 12 dimensions; `None` outside.
    pub fn of(lcg: &Lcg, dimension: usize) -> Option<Planes> {
        if !(2..=12).contains(&dimension) {
            return None;
        }
        let mut vector = spectral(lcg, dimension).pop()?.vector;
        // Of the two opposite vectors the one whose first coordinate is positive.
        if vector.iter().find(|&&x| x != 0).is_some_and(|&x| x < 0) {
            vector.iter_mut().for_each(|x| *x = -*x);
        }
        let length = vector.iter().map(|&x| x as f64 * x as f64).sum::<f64>().sqrt();
        let normal: Vec<f64> = vector.iter().map(|&x| x as f64 / length).collect();
        let offset = offset(lcg, &vector);
        let low: i128 = vector.iter().filter(|&&x| x < 0).sum();
        let high: i128 = vector.iter().filter(|&&x| x > 0).sum();
        // Whole numbers k with low < k + offset < high.
        let count = (high - low) as u128 - u128::from(offset == 0.0);
        Some(Planes { view: within(&normal), vector, normal, distance: 1.0 / length, offset, count })
    }
}

/// Σ h_j x_j / m for the orbit of 0, modulo 1.
fn offset(lcg: &Lcg, vector: &[i128]) -> f64 {
    let (modulus, mut state, mut sum) = (lcg.modulus as i128, 0i128, 0i128);
    for &h in vector {
        // Both factors are below 2⁶⁴, so half of one is taken at a time.
        let h = h.rem_euclid(modulus);
        let product = ((h >> 32) * state % modulus * (1 << 32) + (h & 0xffff_ffff) * state) % modulus;
        sum = (sum + product) % modulus;
        let product = (state.unsigned_abs() * u128::from(lcg.multiplier)) % lcg.modulus;
        state = ((product + u128::from(lcg.increment)) % lcg.modulus) as i128;
    }
    sum as f64 / modulus as f64
}

/// A unit vector orthogonal to a normal: of the axis that is farthest from it, what is left after projection.
fn within(normal: &[f64]) -> Vec<f64> {
    let axis = (0..normal.len()).min_by(|&a, &b| normal[a].abs().total_cmp(&normal[b].abs())).unwrap_or(0);
    let along = normal[axis];
    let left: Vec<f64> =
        normal.iter().enumerate().map(|(i, n)| f64::from(u8::from(i == axis)) - along * n).collect();
    let length = left.iter().map(|x| x * x).sum::<f64>().sqrt();
    left.iter().map(|x| x / length).collect()
}
