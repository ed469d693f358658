//! What slopes are known.
//!
//! Measured with 48 replicates over N = 2⁶ … 2¹⁴ (jittered: k^d) by another program, and in agreement with theory: "Monte Carlo
//! variance of scrambled net quadrature" (Owen 1997), "On the convergence rate of randomized quasi-Monte Carlo for discontinuous
//! functions" (He, Wang 2015), "Consequences of stratified sampling in graphics" (Mitchell 1996), "Obtaining O(N^(−2+ε)) convergence for
//! lattice quadrature rules" (Hickernell 2002).

use super::Integrand;
use crate::generator::Generator;
use crate::points::Rule;

/// The known slopes of a rule in a dimension.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Expected {
    /// The rule.
    pub rule: Rule,
    /// Dimensions.
    pub dimensions: usize,
    /// Slopes in the order of [`Integrand::ALL`]; `None` where nothing is known.
    pub slopes: [Option<f64>; 5],
}

/// How far a slope measured with at least 48 replicates over eight octaves may be off: 0.08, and 0.12 for kinks and jumps under nets.
pub fn tolerance(rule: Rule, integrand: Integrand) -> f64 {
    let plain = matches!(rule, Rule::Independent(_) | Rule::Jittered | Rule::LatinHypercube);
    if plain || matches!(integrand, Integrand::Additive | Integrand::Smooth) { 0.08 } else { 0.12 }
}

const fn row(dimensions: usize, rule: Rule, slopes: [f64; 5]) -> Expected {
    let [a, b, c, d, e] = slopes;
    Expected { rule, dimensions, slopes: [Some(a), Some(b), Some(c), Some(d), Some(e)] }
}

/// One dimension has no oblique planes.
const fn line(rule: Rule, slopes: [f64; 3]) -> Expected {
    let [a, b, c] = slopes;
    Expected { rule, dimensions: 1, slopes: [Some(a), Some(b), Some(c), None, None] }
}

const INDEPENDENT: Rule = Rule::Independent(Generator::DEFAULT);

/// The table.
#[rustfmt::skip]
pub const EXPECTED: [Expected; 27] = [
    line(INDEPENDENT, [-0.54, -0.54, -0.54]),
    line(Rule::Jittered, [-1.5, -1.5, -1.5]),
    line(Rule::LatinHypercube, [-1.5, -1.5, -1.5]),
    line(Rule::SobolOwen, [-1.5, -1.5, -1.5]),
    line(Rule::HaltonScrambled, [-1.5, -1.5, -1.5]),
    line(Rule::SobolShifted, [-1.0, -1.0, -1.0]),
    line(Rule::HaltonShifted, [-1.0, -1.0, -1.0]),
    line(Rule::LatticeShifted, [-1.0, -1.0, -1.0]),
    line(Rule::LatticeTent, [-1.99, -1.99, -1.99]),
    row(2, Rule::Jittered, [-1.00, -1.00, -1.01, -0.75, -0.77]),
    row(2, Rule::LatinHypercube, [-1.51, -0.53, -0.53, -0.49, -0.50]),
    row(2, Rule::HaltonShifted, [-0.96, -0.90, -0.86, -0.70, -0.75]),
    row(2, Rule::HaltonScrambled, [-1.01, -1.02, -1.01, -0.72, -0.74]),
    row(2, Rule::SobolShifted, [-1.00, -1.00, -1.01, -0.79, -0.77]),
    row(2, Rule::SobolOwen, [-1.48, -1.45, -1.25, -0.73, -0.77]),
    row(2, Rule::LatticeShifted, [-1.00, -1.00, -0.99, -0.74, -0.89]),
    row(2, Rule::LatticeTent, [-1.99, -1.88, -1.29, -0.68, -0.84]),
    row(3, Rule::Jittered, [-0.85, -0.86, -0.88, -0.65, -0.64]),
    row(3, Rule::LatinHypercube, [-1.47, -0.50, -0.52, -0.49, -0.47]),
    row(3, Rule::HaltonShifted, [-0.89, -0.85, -0.84, -0.65, -0.67]),
    row(3, Rule::SobolShifted, [-1.00, -1.00, -0.97, -0.62, -0.69]),
    row(3, Rule::SobolOwen, [-1.51, -1.39, -1.00, -0.64, -0.67]),
    row(4, Rule::Jittered, [-0.72, -0.73, -0.74, -0.65, -0.61]),
    row(4, Rule::LatinHypercube, [-1.49, -0.51, -0.51, -0.50, -0.49]),
    row(4, Rule::HaltonShifted, [-0.94, -0.83, -0.81, -0.60, -0.66]),
    row(4, Rule::SobolShifted, [-0.97, -1.02, -0.83, -0.64, -0.58]),
    row(4, Rule::SobolOwen, [-1.49, -1.33, -0.89, -0.62, -0.61]),
];
