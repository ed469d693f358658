//! The spectral test: the exact distance between the planes on which the tuples of a linear congruence lie.
//!
//! All t-tuples of x ← a·x + c mod m lie on a lattice (and its translate). The planes farthest apart that hold all of them belong to
//! the shortest vector of the dual lattice, the integer vectors h with h₁ + a·h₂ + … + a^(t−1)·h_t ≡ 0 mod m; their distance is one
//! over its length ν_t (Coveyou and MacPherson 1967; Knuth, TAOCP 2, 3.3.4).
//!
//! The lattice is kept in whole numbers throughout. Floating point only guides which of them to add, and bounds the final
//! search, with room to spare for its rounding; so the vector found is the shortest.

use crate::generator::Lcg;

/// Result of the spectral test in one dimension.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Spectral {
    /// Dimension t.
    pub dimension: usize,
    /// A shortest vector of the dual lattice: all tuples lie on planes orthogonal to it.
    pub vector: Vec<i128>,
    /// Its squared length ν².
    pub nu_squared: u128,
}

impl Spectral {
    /// ν: one over the distance of the planes.
    pub fn nu(&self) -> f64 {
        (self.nu_squared as f64).sqrt()
    }

    /// Knuth's figure of merit μ = π^(t/2) ν^t / (t/2)! / m: the volume of the ellipsoid, comparable between moduli. Above 0.1 is
    /// acceptable, above 1 very good.
    pub fn merit(&self, modulus: u128) -> f64 {
        let half = self.dimension as f64 / 2.0;
        let log = half * libm::log(std::f64::consts::PI) + half * libm::log(self.nu_squared as f64)
            - libm::lgamma(half + 1.0)
            - libm::log(modulus as f64);
        libm::exp(log)
    }
}

/// Most parallel planes that hold all t-tuples of a congruence modulo m: (t!·m)^(1/t) ("Random numbers fall mainly in the planes",
/// Marsaglia 1968).
pub fn most_planes(modulus: u128, dimension: usize) -> f64 {
    let t = dimension.max(1) as f64;
    libm::exp((libm::lgamma(t + 1.0) + libm::log(modulus as f64)) / t)
}

/// The spectral test in 2 to `most` dimensions, `most` at most 12.
pub fn spectral(lcg: &Lcg, most: usize) -> Vec<Spectral> {
    let modulus = lcg.lattice_modulus.clamp(2, 1 << 64) as i128;
    let multiplier = i128::from(lcg.multiplier) % modulus;
    let mut basis = plane(multiplier, modulus);
    let mut power = multiplier;
    let mut results = Vec::new();
    for dimension in 2..=most.min(12) {
        if dimension > 2 {
            power = times(power, multiplier, modulus);
            for vector in &mut basis {
                vector.push(0);
            }
            let mut last = vec![0; dimension];
            (last[0], last[dimension - 1]) = (centred(-power, modulus), 1);
            basis.push(last);
        }
        reduce(&mut basis);
        let vector = shortest(&basis);
        let nu_squared = norm(&vector);
        results.push(Spectral { dimension, vector, nu_squared });
    }
    results
}

/// The residue nearest to zero.
fn centred(value: i128, modulus: i128) -> i128 {
    let rest = value.rem_euclid(modulus);
    if 2 * rest > modulus { rest - modulus } else { rest }
}

/// A product modulo at most 2⁶⁴.
fn times(a: i128, b: i128, modulus: i128) -> i128 {
    (a.unsigned_abs() * b.unsigned_abs() % modulus.unsigned_abs()) as i128
}

/// A basis in two dimensions whose numbers are small enough to be squared: Euclid's algorithm on the first coordinates.
fn plane(multiplier: i128, modulus: i128) -> Vec<Vec<i128>> {
    let (mut longer, mut shorter) = (vec![modulus, 0], vec![-multiplier, 1]);
    while shorter[0] != 0 && shorter[0].unsigned_abs() > 1 << 34 {
        let factor = longer[0] / shorter[0];
        let next = vec![longer[0] - factor * shorter[0], longer[1] - factor * shorter[1]];
        (longer, shorter) = (shorter, next);
    }
    vec![longer, shorter]
}

fn norm(vector: &[i128]) -> u128 {
    vector.iter().map(|x| x.unsigned_abs() * x.unsigned_abs()).sum()
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// Gram and Schmidt: squared lengths of the orthogonal parts, and the coefficients of the rest.
struct Orthogonal {
    squares: Vec<f64>,
    coefficients: Vec<Vec<f64>>,
}

fn orthogonal(basis: &[Vec<i128>]) -> Orthogonal {
    let mut parts: Vec<Vec<f64>> = Vec::with_capacity(basis.len());
    let (mut squares, mut coefficients) = (Vec::new(), Vec::new());
    for vector in basis {
        let mut part: Vec<f64> = vector.iter().map(|&x| x as f64).collect();
        let mut row = Vec::with_capacity(parts.len());
        for (earlier, square) in parts.iter().zip(&squares) {
            // From what is left, not from the whole: rounding then does not add up.
            let coefficient = dot(&part, earlier) / square;
            part.iter_mut().zip(earlier).for_each(|(x, y)| *x -= coefficient * y);
            row.push(coefficient);
        }
        squares.push(dot(&part, &part));
        parts.push(part);
        coefficients.push(row);
    }
    Orthogonal { squares, coefficients }
}

/// Reduction after Lenstra, Lenstra and Lovász (1982) with factor 0.99.
fn reduce(basis: &mut [Vec<i128>]) {
    let mut k = 1;
    // Far more than it takes: each exchange shortens a product of lengths by a percent.
    for _ in 0..1_000_000 {
        if k >= basis.len() {
            break;
        }
        // Subtracting large multiples loses digits, so the coefficients are taken anew until nothing changes.
        loop {
            let mut changed = false;
            for j in (0..k).rev() {
                let coefficient = orthogonal(&basis[..=k]).coefficients[k][j];
                if coefficient.abs() > 0.51 {
                    let factor = libm::rint(coefficient) as i128;
                    let (earlier, later) = basis.split_at_mut(k);
                    later[0].iter_mut().zip(&earlier[j]).for_each(|(x, y)| *x -= factor * y);
                    changed = true;
                }
            }
            if !changed {
                break;
            }
        }
        let Orthogonal { squares, coefficients } = orthogonal(&basis[..=k]);
        let along = coefficients[k][k - 1];
        if squares[k] < (0.99 - along * along) * squares[k - 1] {
            basis.swap(k, k - 1);
            k = (k - 1).max(1);
        } else {
            k += 1;
        }
    }
}

/// The shortest vector of a reduced basis: all combinations that could be shorter than the shortest so far (Fincke and Pohst 1985).
fn shortest(basis: &[Vec<i128>]) -> Vec<i128> {
    let frame = orthogonal(basis);
    let mut best = basis.iter().min_by_key(|vector| norm(vector)).cloned().unwrap_or_default();
    let mut factors = vec![0i128; basis.len()];
    search(basis, &frame, basis.len(), 0.0, &mut factors, &mut best);
    best
}

fn search(
    basis: &[Vec<i128>],
    frame: &Orthogonal,
    level: usize,
    length: f64,
    factors: &mut Vec<i128>,
    best: &mut Vec<i128>,
) {
    let Some(level) = level.checked_sub(1) else {
        let mut vector = vec![0i128; best.len()];
        for (factor, row) in factors.iter().zip(basis) {
            vector.iter_mut().zip(row).for_each(|(x, y)| *x += factor * y);
        }
        if vector.iter().any(|&x| x != 0) && norm(&vector) < norm(best) {
            *best = vector;
        }
        return;
    };
    // Room for rounding: a part in a million, where errors are a part in 10¹².
    let room = norm(best) as f64 * (1.0 + 1e-6) - length;
    if room < 0.0 {
        return;
    }
    let centre: f64 =
        -(level + 1..basis.len()).map(|j| factors[j] as f64 * frame.coefficients[j][level]).sum::<f64>();
    let reach = (room / frame.squares[level]).sqrt() + 1e-6;
    let (low, high) = ((centre - reach).ceil() as i128, (centre + reach).floor() as i128);
    for factor in low..=high {
        let off = factor as f64 - centre;
        factors[level] = factor;
        search(basis, frame, level, length + off * off * frame.squares[level], factors, best);
    }
    factors[level] = 0;
}
