//! The functions of the language, by name.

use crate::graph::{Graph, Id, MOST_OCTAVES};
use crate::operation::{Binary, Unary};

/// A function of the language.
pub(crate) struct Function {
    pub(crate) name: &'static str,
    /// How its arguments are written.
    pub(crate) arguments: &'static str,
    pub(crate) meaning: &'static str,
    least: usize,
    most: usize,
    pub(crate) build: fn(&mut Graph, &[Id]) -> Result<Id, String>,
}

impl Function {
    pub(crate) fn accepts(&self, count: usize) -> bool {
        (self.least..=self.most).contains(&count)
    }

    /// How many arguments it takes, in words.
    pub(crate) fn accepted(&self) -> String {
        let plural = |count| if count == 1 { "" } else { "s" };
        match (self.least, self.most) {
            (least, most) if least == most => format!("{least} argument{}", plural(least)),
            (least, ANY) => format!("{least} or more arguments"),
            (least, most) => format!("{least} to {most} arguments"),
        }
    }
}

/// How a function is written.
pub(crate) fn usage(function: &Function) -> String {
    format!("{}({})", function.name, function.arguments)
}

const ANY: usize = usize::MAX;

macro_rules! functions {
    ($($name:literal ($arguments:literal, $least:literal..$most:expr) $meaning:literal $build:expr;)*) => {
        /// All functions, by kind.
        pub(crate) const FUNCTIONS: &[Function] = &[$(Function {
            name: $name, arguments: $arguments, meaning: $meaning, least: $least, most: $most, build: $build,
        },)*];
    };
}

macro_rules! one {
    ($function:ident) => {
        |graph, a| Ok(graph.unary(Unary::$function, a[0]))
    };
}

macro_rules! two {
    ($function:ident) => {
        |graph, a| Ok(graph.binary(Binary::$function, a[0], a[1]))
    };
}

functions! {
    "if" ("condition, then, else", 3..3) "the second where the first is true, else the third" |graph, a| Ok(graph.select(a[0], a[1], a[2]));
    "min" ("a, b, …", 1..ANY) "the least" |graph, a| Ok(graph.reduce(Binary::Minimum, a, f64::INFINITY));
    "max" ("a, b, …", 1..ANY) "the greatest" |graph, a| Ok(graph.reduce(Binary::Maximum, a, f64::NEG_INFINITY));
    "clamp" ("x, low, high", 3..3) "x, but at least low and at most high" |graph, a| Ok(graph.clamp(a[0], a[1], a[2]));
    "mix" ("a, b, t", 3..3) "a + (b - a)*t" |graph, a| Ok(graph.mix(a[0], a[1], a[2]));
    "step" ("edge, x", 2..2) "0 where x is below the edge, else 1" |graph, a| Ok(graph.binary(Binary::LessOrEqual, a[0], a[1]));
    "smoothstep" ("low, high, x", 3..3) "0 below low, 1 above high, smooth between" |graph, a| Ok(graph.smoothstep(a[0], a[1], a[2]));
    "abs" ("x", 1..1) "without the sign" one!(Absolute);
    "sign" ("x", 1..1) "-1, 0 or 1" one!(Sign);
    "floor" ("x", 1..1) "the next whole number below" one!(Floor);
    "ceil" ("x", 1..1) "the next whole number above" one!(Ceil);
    "round" ("x", 1..1) "the nearest whole number, halves away from zero" one!(Round);
    "mod" ("a, b", 2..2) "the remainder, with the sign of b" two!(Modulo);
    "sqrt" ("x", 1..1) "the square root" one!(SquareRoot);
    "cbrt" ("x", 1..1) "the cube root, of negative numbers too" one!(CubeRoot);
    "hypot" ("a, b, …", 1..ANY) "the square root of the sum of squares" |graph, a| Ok(graph.length(a));
    "length" ("x, y, z", 1..ANY) "the same as hypot" |graph, a| Ok(graph.length(a));
    "exp" ("x", 1..1) "e^x" one!(Exp);
    "ln" ("x", 1..1) "the natural logarithm" one!(Ln);
    "log" ("x [, base]", 1..2) "the natural logarithm, or that of a base" |graph, a| {
        let log = graph.unary(Unary::Ln, a[0]);
        Ok(match a.get(1) {
            None => log,
            Some(&base) => {
                let scale = graph.unary(Unary::Ln, base);
                graph.binary(Binary::Divide, log, scale)
            }
        })
    };
    "log2" ("x", 1..1) "the logarithm to base 2" one!(Log2);
    "log10" ("x", 1..1) "the logarithm to base 10" one!(Log10);
    "pow" ("a, b", 2..2) "a^b" two!(Power);
    "sin" ("x", 1..1) "the sine of radians" one!(Sin);
    "cos" ("x", 1..1) "the cosine of radians" one!(Cos);
    "tan" ("x", 1..1) "the tangent of radians" one!(Tan);
    "asin" ("x", 1..1) "the angle with that sine" one!(Asin);
    "acos" ("x", 1..1) "the angle with that cosine" one!(Acos);
    "atan" ("x", 1..1) "the angle with that tangent" one!(Atan);
    "atan2" ("y, x", 2..2) "the angle of the point (x, y), -pi to pi" two!(Angle);
    "sinh" ("x", 1..1) "the hyperbolic sine" one!(Sinh);
    "cosh" ("x", 1..1) "the hyperbolic cosine" one!(Cosh);
    "tanh" ("x", 1..1) "the hyperbolic tangent" one!(Tanh);
    "asinh" ("x", 1..1) "the inverse of sinh" one!(Asinh);
    "acosh" ("x", 1..1) "the inverse of cosh" one!(Acosh);
    "atanh" ("x", 1..1) "the inverse of tanh" one!(Atanh);
    "gamma" ("x", 1..1) "the gamma function: gamma(n + 1) = n!" one!(Gamma);
    "lgamma" ("x", 1..1) "the logarithm of the size of gamma(x)" one!(LnGamma);
    "erf" ("x", 1..1) "the error function" one!(ErrorFunction);
    "normal" ("x [, mean, deviation]", 1..3) "the density of the normal distribution" |graph, a| match *a {
        [x] => Ok(graph.normal_density(x)),
        [x, mean, deviation] => {
            let from = graph.binary(Binary::Subtract, x, mean);
            let scaled = graph.binary(Binary::Divide, from, deviation);
            let density = graph.normal_density(scaled);
            Ok(graph.binary(Binary::Divide, density, deviation))
        }
        _ => Err("normal needs the deviation beside the mean: write normal(x, mean, deviation)".into()),
    };
    "noise" ("x, y, z", 1..3) "smooth noise between -1 and 1, about one wave a unit" |graph, a| {
        let place = place(graph, a);
        Ok(graph.noise(place))
    };
    "fbm" ("x, y, z, octaves", 4..4) "noise with finer and lower noise added, 1 to 16 octaves" |graph, a| {
        let octaves = graph.constant_of(a[3]).filter(|octaves| (1.0..=f64::from(MOST_OCTAVES)).contains(octaves) && octaves.fract() == 0.0);
        let octaves = octaves.ok_or(format!("the octaves of fbm are a constant whole number, 1 to {MOST_OCTAVES}"))?;
        let place = place(graph, a);
        Ok(graph.fractal_noise(place, octaves as u32))
    };
}

/// Three coordinates; missing ones are zero.
fn place(graph: &mut Graph, given: &[Id]) -> [Id; 3] {
    let zero = graph.constant(0.0);
    [0, 1, 2].map(|axis| given.get(axis).copied().unwrap_or(zero))
}
