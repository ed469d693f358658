//! Integrals with known values: what rules are measured on.

use super::{Integral, IntegralError};

/// An integral of the suite.
#[derive(Clone, Debug)]
pub struct SuiteMember {
    /// A short name.
    pub name: &'static str,
    /// The integral; its truth is known.
    pub integral: Integral,
}

/// Name, formula, domain, density, truth: smooth, kinked, jumping, peaked, oscillating, in 1 to 8 dimensions.
const MEMBERS: [[&str; 5]; 14] = [
    ["pi", "4*((x-0.5)^2+(y-0.5)^2 <= 0.25)", "x=0..1,y=0..1", "uniform", "pi"],
    ["bell", "cos(x)^77", "x=-pi/2..pi/2", "uniform", "sqrt(pi)*gamma(39)/gamma(39.5)"],
    ["bell-normal", "cos(x)^77", "x=-pi/2..pi/2", "normal(0,0.15)", "sqrt(pi)*gamma(39)/gamma(39.5)"],
    ["exponential-1", "exp(x)", "x=0..1", "uniform", "e-1"],
    ["product-2", "exp(x+y)", "x=0..1,y=0..1", "uniform", "(e-1)^2"],
    ["product-4", "exp(a+b+c+d)", "a=0..1,b=0..1,c=0..1,d=0..1", "uniform", "(e-1)^4"],
    ["kink-1", "abs(x-1/3)", "x=0..1", "uniform", "5/18"],
    ["kink-2", "max(x+y-1,0)", "x=0..1,y=0..1", "uniform", "1/6"],
    ["ball-3", "x^2+y^2+z^2 <= 1", "x=-1..1,y=-1..1,z=-1..1", "uniform", "4*pi/3"],
    ["half-space-4", "a+b+c+d < 1", "a=0..1,b=0..1,c=0..1,d=0..1", "uniform", "1/24"],
    ["wave-2", "cos(7*x+3*y)", "x=0..1,y=0..1", "uniform", "(cos(7)+cos(3)-cos(10)-1)/21"],
    ["peak-2", "1/((0.01+(x-0.5)^2)*(0.01+(y-0.5)^2))", "x=0..1,y=0..1", "uniform", "(20*atan(5))^2"],
    [
        "gauss-5",
        "exp(-a^2-b^2-c^2-d^2-f^2)",
        "a=-inf..inf,b=-inf..inf,c=-inf..inf,d=-inf..inf,f=-inf..inf",
        "normal(0,1)",
        "pi^2.5",
    ],
    ["sum-8", "(x1+x2+x3+x4+x5+x6+x7+x8)^2", "x1..x8=0..1", "uniform", "16+2/3"],
];

/// The suite on which the stopping rule is measured.
///
/// # Errors
///
/// None: every member is read in the tests.
pub fn suite() -> Result<Vec<SuiteMember>, IntegralError> {
    MEMBERS
        .iter()
        .map(|[name, formula, domain, density, truth]| {
            let integral = Integral::new(formula, domain)?.with_density(density)?.with_truth(truth)?;
            Ok(SuiteMember { name, integral })
        })
        .collect()
}
