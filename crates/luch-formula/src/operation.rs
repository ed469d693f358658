//! What can be done with numbers, and what it means: the one place where each function is computed.
//!
//! Evaluators differ in how many numbers they take at once, never in what they compute. Each hands a visitor to [`unary`] or
//! [`binary`], which hands back the function. Everything here is inlined into the code of the evaluator, and so compiled for
//! its vector instructions; no operation is fused, so that all give the same bits.

use crate::noise::noise;
use crate::special::digamma;
use std::f64::consts::{FRAC_2_SQRT_PI, LOG2_E, LOG10_E};

/// A function of one number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Unary {
    Negate,
    Absolute,
    Sign,
    Floor,
    Ceil,
    Round,
    SquareRoot,
    CubeRoot,
    Exp,
    Ln,
    Log2,
    Log10,
    Sin,
    Cos,
    Tan,
    Asin,
    Acos,
    Atan,
    Sinh,
    Cosh,
    Tanh,
    Asinh,
    Acosh,
    Atanh,
    Gamma,
    LnGamma,
    ErrorFunction,
    Not,
}

/// A function of two numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Binary {
    Add,
    Subtract,
    Multiply,
    Divide,
    Power,
    Minimum,
    Maximum,
    Modulo,
    /// The angle of the point whose y comes first.
    Angle,
    Less,
    LessOrEqual,
    Equal,
    NotEqual,
    And,
    Or,
}

/// A step of a calculation. Operands are numbers of earlier steps, or of registers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Operation {
    Unary {
        function: Unary,
        a: u32,
    },
    Binary {
        function: Binary,
        a: u32,
        b: u32,
    },
    /// A power by multiplications; the exponent is at least 2.
    WholePower {
        base: u32,
        exponent: u8,
    },
    Select {
        condition: u32,
        yes: u32,
        no: u32,
    },
    Noise {
        x: u32,
        y: u32,
        z: u32,
    },
}

impl Operation {
    /// The operands; those that are missing repeat the first.
    pub(crate) fn operands(&self) -> [u32; 3] {
        match *self {
            Self::Unary { a, .. } => [a; 3],
            Self::Binary { a, b, .. } => [a, b, a],
            Self::WholePower { base, .. } => [base; 3],
            Self::Select { condition, yes, no } => [condition, yes, no],
            Self::Noise { x, y, z } => [x, y, z],
        }
    }

    /// The same with other operands.
    pub(crate) fn with_operands(&self, mut of: impl FnMut(u32) -> u32) -> Self {
        match *self {
            Self::Unary { function, a } => Self::Unary { function, a: of(a) },
            Self::Binary { function, a, b } => Self::Binary { function, a: of(a), b: of(b) },
            Self::WholePower { base, exponent } => Self::WholePower { base: of(base), exponent },
            Self::Select { condition, yes, no } => {
                Self::Select { condition: of(condition), yes: of(yes), no: of(no) }
            }
            Self::Noise { x, y, z } => Self::Noise { x: of(x), y: of(y), z: of(z) },
        }
    }

    /// Its value for known operands.
    #[inline(always)]
    pub(crate) fn value(&self, mut of: impl FnMut(u32) -> f64) -> f64 {
        match *self {
            Self::Unary { function, a } => unary(function, Once([of(a)])),
            Self::Binary { function, a, b } => binary(function, Once([of(a), of(b)])),
            Self::WholePower { base, exponent } => whole_power(of(base), exponent),
            Self::Select { condition, yes, no } => select(of(condition), of(yes), of(no)),
            Self::Noise { x, y, z } => noise(of(x), of(y), of(z)).value,
        }
    }
}

/// Takes a function of one number.
pub(crate) trait VisitUnary {
    type Output;
    fn visit(self, function: impl Fn(f64) -> f64) -> Self::Output;
}

/// Takes a function of two numbers.
pub(crate) trait VisitBinary {
    type Output;
    fn visit(self, function: impl Fn(f64, f64) -> f64) -> Self::Output;
}

/// Applies the function to what it holds.
pub(crate) struct Once<const N: usize>(pub(crate) [f64; N]);

impl VisitUnary for Once<1> {
    type Output = f64;
    #[inline(always)]
    fn visit(self, function: impl Fn(f64) -> f64) -> f64 {
        function(self.0[0])
    }
}

impl VisitBinary for Once<2> {
    type Output = f64;
    #[inline(always)]
    fn visit(self, function: impl Fn(f64, f64) -> f64) -> f64 {
        function(self.0[0], self.0[1])
    }
}

/// Hands the function to the visitor.
#[inline(always)]
pub(crate) fn unary<V: VisitUnary>(function: Unary, visitor: V) -> V::Output {
    match function {
        Unary::Negate => visitor.visit(|x| -x),
        Unary::Absolute => visitor.visit(f64::abs),
        Unary::Sign => visitor.visit(sign),
        Unary::Floor => visitor.visit(f64::floor),
        Unary::Ceil => visitor.visit(f64::ceil),
        Unary::Round => visitor.visit(f64::round),
        Unary::SquareRoot => visitor.visit(f64::sqrt),
        Unary::CubeRoot => visitor.visit(libm::cbrt),
        Unary::Exp => visitor.visit(libm::exp),
        Unary::Ln => visitor.visit(libm::log),
        Unary::Log2 => visitor.visit(libm::log2),
        Unary::Log10 => visitor.visit(libm::log10),
        Unary::Sin => visitor.visit(libm::sin),
        Unary::Cos => visitor.visit(libm::cos),
        Unary::Tan => visitor.visit(libm::tan),
        Unary::Asin => visitor.visit(libm::asin),
        Unary::Acos => visitor.visit(libm::acos),
        Unary::Atan => visitor.visit(libm::atan),
        Unary::Sinh => visitor.visit(libm::sinh),
        Unary::Cosh => visitor.visit(libm::cosh),
        Unary::Tanh => visitor.visit(libm::tanh),
        Unary::Asinh => visitor.visit(libm::asinh),
        Unary::Acosh => visitor.visit(libm::acosh),
        Unary::Atanh => visitor.visit(libm::atanh),
        Unary::Gamma => visitor.visit(libm::tgamma),
        Unary::LnGamma => visitor.visit(libm::lgamma),
        Unary::ErrorFunction => visitor.visit(libm::erf),
        Unary::Not => visitor.visit(|x| flag(!is_true(x))),
    }
}

/// Hands the function to the visitor.
#[inline(always)]
pub(crate) fn binary<V: VisitBinary>(function: Binary, visitor: V) -> V::Output {
    match function {
        Binary::Add => visitor.visit(|x, y| x + y),
        Binary::Subtract => visitor.visit(|x, y| x - y),
        Binary::Multiply => visitor.visit(|x, y| x * y),
        Binary::Divide => visitor.visit(|x, y| x / y),
        Binary::Power => visitor.visit(libm::pow),
        Binary::Minimum => visitor.visit(minimum),
        Binary::Maximum => visitor.visit(maximum),
        Binary::Modulo => visitor.visit(modulo),
        Binary::Angle => visitor.visit(libm::atan2),
        Binary::Less => visitor.visit(|x, y| flag(x < y)),
        Binary::LessOrEqual => visitor.visit(|x, y| flag(x <= y)),
        Binary::Equal => visitor.visit(|x, y| flag(x == y)),
        Binary::NotEqual => visitor.visit(|x, y| flag(x != y)),
        Binary::And => visitor.visit(|x, y| flag(is_true(x) & is_true(y))),
        Binary::Or => visitor.visit(|x, y| flag(is_true(x) | is_true(y))),
    }
}

/// Whether a number counts as true: it is neither zero nor undefined.
#[inline(always)]
pub(crate) fn is_true(x: f64) -> bool {
    x.abs() > 0.0
}

#[inline(always)]
fn flag(claim: bool) -> f64 {
    if claim { 1.0 } else { 0.0 }
}

#[inline(always)]
fn sign(x: f64) -> f64 {
    if x > 0.0 {
        1.0
    } else if x < 0.0 {
        -1.0
    } else {
        // Zero keeps its sign, and what is undefined stays so.
        x
    }
}

/// The second if both are equal, the defined one if one is not.
#[inline(always)]
pub(crate) fn minimum(x: f64, y: f64) -> f64 {
    if takes_first_as_minimum(x, y) { x } else { y }
}

#[inline(always)]
fn takes_first_as_minimum(x: f64, y: f64) -> bool {
    (x < y) | y.is_nan()
}

/// The second if both are equal, the defined one if one is not.
#[inline(always)]
pub(crate) fn maximum(x: f64, y: f64) -> f64 {
    if takes_first_as_maximum(x, y) { x } else { y }
}

#[inline(always)]
fn takes_first_as_maximum(x: f64, y: f64) -> bool {
    (x > y) | y.is_nan()
}

/// The remainder that has the sign of the divisor.
#[inline(always)]
fn modulo(x: f64, y: f64) -> f64 {
    let remainder = libm::fmod(x, y);
    if remainder != 0.0 && (remainder < 0.0) != (y < 0.0) { remainder + y } else { remainder }
}

/// By repeated squaring, the lowest bit of the exponent first.
#[inline(always)]
pub(crate) fn whole_power(base: f64, exponent: u8) -> f64 {
    let (mut square, mut rest) = (base, exponent);
    while rest & 1 == 0 && rest != 0 {
        square *= square;
        rest >>= 1;
    }
    let mut power = square;
    rest >>= 1;
    while rest != 0 {
        square *= square;
        if rest & 1 == 1 {
            power *= square;
        }
        rest >>= 1;
    }
    power
}

#[inline(always)]
pub(crate) fn select(condition: f64, yes: f64, no: f64) -> f64 {
    if is_true(condition) { yes } else { no }
}

/// A slope times a derivative. Nothing times anything is nothing: a number that does not change passes no change on, however
/// steep the function.
#[inline(always)]
pub(crate) fn chain(slope: f64, derivative: f64) -> f64 {
    if (slope == 0.0) | (derivative == 0.0) { 0.0 } else { slope * derivative }
}

/// Hands over the derivative of a function of one number, as a function of its argument and its value. Zero where the function
/// jumps, and in the kink of the absolute value.
#[inline(always)]
pub(crate) fn unary_slope<V: VisitBinary>(function: Unary, visitor: V) -> V::Output {
    match function {
        Unary::Negate => visitor.visit(|_, _| -1.0),
        Unary::Absolute => visitor.visit(|x, _| sign(x)),
        Unary::Sign | Unary::Floor | Unary::Ceil | Unary::Round | Unary::Not => visitor.visit(|_, _| 0.0),
        Unary::SquareRoot => visitor.visit(|_, value| 0.5 / value),
        Unary::CubeRoot => visitor.visit(|_, value| 1.0 / (3.0 * (value * value))),
        Unary::Exp => visitor.visit(|_, value| value),
        Unary::Ln => visitor.visit(|x, _| 1.0 / x),
        Unary::Log2 => visitor.visit(|x, _| LOG2_E / x),
        Unary::Log10 => visitor.visit(|x, _| LOG10_E / x),
        Unary::Sin => visitor.visit(|x, _| libm::cos(x)),
        Unary::Cos => visitor.visit(|x, _| -libm::sin(x)),
        Unary::Tan => visitor.visit(|_, value| 1.0 + value * value),
        Unary::Asin => visitor.visit(|x, _| 1.0 / ((1.0 - x) * (1.0 + x)).sqrt()),
        Unary::Acos => visitor.visit(|x, _| -1.0 / ((1.0 - x) * (1.0 + x)).sqrt()),
        Unary::Atan => visitor.visit(|x, _| 1.0 / (1.0 + x * x)),
        Unary::Sinh => visitor.visit(|x, _| libm::cosh(x)),
        Unary::Cosh => visitor.visit(|x, _| libm::sinh(x)),
        Unary::Tanh => visitor.visit(|_, value| 1.0 - value * value),
        Unary::Asinh => visitor.visit(|x, _| 1.0 / (1.0 + x * x).sqrt()),
        Unary::Acosh => visitor.visit(|x, _| 1.0 / ((x - 1.0) * (1.0 + x)).sqrt()),
        Unary::Atanh => visitor.visit(|x, _| 1.0 / ((1.0 - x) * (1.0 + x))),
        Unary::Gamma => visitor.visit(|x, value| value * digamma(x)),
        Unary::LnGamma => visitor.visit(|x, _| digamma(x)),
        Unary::ErrorFunction => visitor.visit(|x, _| FRAC_2_SQRT_PI * libm::exp(-(x * x))),
    }
}

/// Takes the partial derivatives of a function of two numbers, as functions of both and the value.
pub(crate) trait VisitSlopes {
    type Output;
    fn visit(self, slopes: impl Fn(f64, f64, f64) -> [f64; 2]) -> Self::Output;
}

impl VisitSlopes for Once<3> {
    type Output = [f64; 2];
    #[inline(always)]
    fn visit(self, slopes: impl Fn(f64, f64, f64) -> [f64; 2]) -> [f64; 2] {
        slopes(self.0[0], self.0[1], self.0[2])
    }
}

/// Hands over the partial derivatives of a function of two numbers.
#[inline(always)]
pub(crate) fn binary_slopes<V: VisitSlopes>(function: Binary, visitor: V) -> V::Output {
    match function {
        Binary::Add => visitor.visit(|_, _, _| [1.0, 1.0]),
        Binary::Subtract => visitor.visit(|_, _, _| [1.0, -1.0]),
        Binary::Multiply => visitor.visit(|x, y, _| [y, x]),
        Binary::Divide => visitor.visit(|_, y, value| [1.0 / y, -(value / y)]),
        Binary::Power => visitor.visit(|x, y, value| {
            // A power of zero does not change with its exponent.
            let by_exponent = if value == 0.0 { 0.0 } else { value * libm::log(x) };
            [y * libm::pow(x, y - 1.0), by_exponent]
        }),
        Binary::Minimum => visitor.visit(|x, y, _| one_of(takes_first_as_minimum(x, y))),
        Binary::Maximum => visitor.visit(|x, y, _| one_of(takes_first_as_maximum(x, y))),
        Binary::Modulo => visitor.visit(|x, y, _| [1.0, -(x / y).floor()]),
        Binary::Angle => visitor.visit(|x, y, _| {
            let square = x * x + y * y;
            [y / square, -(x / square)]
        }),
        Binary::Less | Binary::LessOrEqual | Binary::Equal | Binary::NotEqual | Binary::And | Binary::Or => {
            visitor.visit(|_, _, _| [0.0, 0.0])
        }
    }
}

#[inline(always)]
fn one_of(first: bool) -> [f64; 2] {
    if first { [1.0, 0.0] } else { [0.0, 1.0] }
}

/// The derivative of a power with a whole exponent of at least 2.
#[inline(always)]
pub(crate) fn whole_power_slope(base: f64, exponent: u8) -> f64 {
    f64::from(exponent) * if exponent == 2 { base } else { whole_power(base, exponent - 1) }
}
