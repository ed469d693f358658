//! The functions of the language as methods, and the operators.

use super::Expression;
use crate::operation::{Binary, Unary};
use std::ops::{Add, Div, Mul, Neg, Sub};

macro_rules! unary {
    ($($(#[$note:meta])* $name:ident $function:ident;)*) => {
        impl Expression {$(
            $(#[$note])*
            pub fn $name(&self) -> Self {
                Self::build(&[self], |graph, ids| graph.unary(Unary::$function, ids[0]))
            }
        )*}
    };
}

unary! {
    /// Without the sign.
    abs Absolute;
    /// −1, 0 or 1.
    sign Sign;
    /// The next whole number below.
    floor Floor;
    /// The next whole number above.
    ceil Ceil;
    /// The nearest whole number, halves away from zero.
    round Round;
    /// The square root.
    sqrt SquareRoot;
    /// The cube root, of negative numbers too.
    cbrt CubeRoot;
    /// e to this power.
    exp Exp;
    /// The natural logarithm.
    ln Ln;
    /// The logarithm to base 2.
    log2 Log2;
    /// The logarithm to base 10.
    log10 Log10;
    /// The sine of radians.
    sin Sin;
    /// The cosine of radians.
    cos Cos;
    /// The tangent of radians.
    tan Tan;
    /// The angle with this sine.
    asin Asin;
    /// The angle with this cosine.
    acos Acos;
    /// The angle with this tangent.
    atan Atan;
    /// The hyperbolic sine.
    sinh Sinh;
    /// The hyperbolic cosine.
    cosh Cosh;
    /// The hyperbolic tangent.
    tanh Tanh;
    /// The inverse of the hyperbolic sine.
    asinh Asinh;
    /// The inverse of the hyperbolic cosine.
    acosh Acosh;
    /// The inverse of the hyperbolic tangent.
    atanh Atanh;
    /// The gamma function.
    gamma Gamma;
    /// The logarithm of the size of the gamma function.
    ln_gamma LnGamma;
    /// The error function.
    erf ErrorFunction;
    /// 1 where this is not true, else 0.
    logical_not Not;
}

macro_rules! binary {
    ($($(#[$note:meta])* $name:ident $function:ident;)*) => {
        impl Expression {$(
            $(#[$note])*
            pub fn $name(&self, other: impl Into<Expression>) -> Self {
                Self::build(&[self, &other.into()], |graph, ids| graph.binary(Binary::$function, ids[0], ids[1]))
            }
        )*}
    };
}

binary! {
    /// The lesser of both; the defined one if one is not.
    min Minimum;
    /// The greater of both; the defined one if one is not.
    max Maximum;
    /// This to a power. Whole powers up to 64 are multiplications.
    pow Power;
    /// The remainder, with the sign of the divisor.
    modulo Modulo;
    /// The angle of the point whose y is this and whose x is the other, −π to π.
    atan2 Angle;
    /// 1 where this is less, else 0.
    is_less Less;
    /// 1 where this is less or equal, else 0.
    is_at_most LessOrEqual;
    /// 1 where both are equal, else 0.
    is_equal Equal;
    /// 1 where both are true, else 0.
    and And;
    /// 1 where one is true, else 0.
    or Or;
}

impl Expression {
    /// This times itself.
    pub fn squared(&self) -> Self {
        self.pow(2.0)
    }

    /// The square root of the sum of squares.
    pub fn length(parts: &[&Self]) -> Self {
        if parts.is_empty() {
            return Self::constant(0.0);
        }
        Self::build(parts, |graph, ids| graph.length(ids))
    }

    /// This, but at least `low` and at most `high`.
    pub fn clamp(&self, low: impl Into<Self>, high: impl Into<Self>) -> Self {
        Self::build(&[self, &low.into(), &high.into()], |graph, ids| graph.clamp(ids[0], ids[1], ids[2]))
    }

    /// From this to the other as `t` goes from 0 to 1.
    pub fn mix(&self, other: impl Into<Self>, t: impl Into<Self>) -> Self {
        Self::build(&[self, &other.into(), &t.into()], |graph, ids| graph.mix(ids[0], ids[1], ids[2]))
    }

    /// 0 where this is below `low`, 1 above `high`, smooth between.
    pub fn smoothstep(&self, low: impl Into<Self>, high: impl Into<Self>) -> Self {
        Self::build(&[&low.into(), &high.into(), self], |graph, ids| graph.smoothstep(ids[0], ids[1], ids[2]))
    }
}

macro_rules! operator {
    ($($operator:ident $method:ident $function:ident,)*) => {$(
        operator!(@for $operator $method $function, &Expression, &Expression);
        operator!(@for $operator $method $function, Expression, &Expression);
        operator!(@for $operator $method $function, &Expression, Expression);
        operator!(@for $operator $method $function, Expression, Expression);
        operator!(@for $operator $method $function, &Expression, f64);
        operator!(@for $operator $method $function, Expression, f64);
        operator!(@for $operator $method $function, f64, &Expression);
        operator!(@for $operator $method $function, f64, Expression);
    )*};
    (@for $operator:ident $method:ident $function:ident, $left:ty, $right:ty) => {
        impl $operator<$right> for $left {
            type Output = Expression;
            fn $method(self, right: $right) -> Expression {
                let (left, right) = (Expression::from(self), Expression::from(right));
                Expression::build(&[&left, &right], |graph, ids| graph.binary(Binary::$function, ids[0], ids[1]))
            }
        }
    };
}
operator!(Add add Add, Sub sub Subtract, Mul mul Multiply, Div div Divide,);

impl Neg for &Expression {
    type Output = Expression;
    fn neg(self) -> Expression {
        Expression::build(&[self], |graph, ids| graph.unary(Unary::Negate, ids[0]))
    }
}

impl Neg for Expression {
    type Output = Expression;
    fn neg(self) -> Expression {
        -&self
    }
}
