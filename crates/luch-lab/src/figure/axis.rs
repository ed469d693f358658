//! Axes: from numbers to places, and the ticks that are said.

use serde::{Deserialize, Serialize};

/// How numbers become lengths.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Scale {
    /// In proportion.
    #[default]
    Linear,
    /// By logarithm, with ticks at powers of ten.
    Log10,
    /// By logarithm, with ticks at powers of two.
    Log2,
}

/// One axis.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Axis {
    /// What the numbers are, with the unit.
    pub label: String,
    /// How they become lengths.
    pub scale: Scale,
    /// The ends; chosen from the numbers if not given.
    pub range: Option<[f64; 2]>,
}

impl Axis {
    /// A linear axis.
    pub fn linear(label: impl Into<String>) -> Self {
        Self { label: label.into(), scale: Scale::Linear, range: None }
    }

    /// A logarithmic axis with powers of ten.
    pub fn log10(label: impl Into<String>) -> Self {
        Self { label: label.into(), scale: Scale::Log10, range: None }
    }

    /// A logarithmic axis with powers of two.
    pub fn log2(label: impl Into<String>) -> Self {
        Self { label: label.into(), scale: Scale::Log2, range: None }
    }

    /// The same with fixed ends; a range that is empty, not finite or not positive where it must be is ignored.
    #[must_use]
    pub fn with_range(mut self, low: f64, high: f64) -> Self {
        self.range = Some([low, high]);
        self
    }
}

/// Numbers beyond this are not drawn: differences of two must not overflow.
const GREATEST: f64 = 1e300;

impl Scale {
    pub(super) fn is_logarithmic(self) -> bool {
        self != Self::Linear
    }

    /// The number as it is measured along the axis; `None` if it has no place.
    pub(super) fn measure(self, value: f64) -> Option<f64> {
        if value.is_nan() || value.abs() > GREATEST {
            return None;
        }
        match self {
            Self::Linear => Some(value),
            _ if value < 1.0 / GREATEST => None,
            Self::Log10 => Some(libm::log10(value)),
            Self::Log2 => Some(libm::log2(value)),
        }
    }
}

/// A mark on an axis.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Tick {
    /// Where, in measured units.
    pub(super) at: f64,
    /// What is said; nothing at lesser ticks.
    pub(super) label: String,
}

/// An axis whose ends are known, in measured units.
#[derive(Clone, Debug)]
pub(super) struct Span {
    pub(super) scale: Scale,
    pub(super) low: f64,
    pub(super) high: f64,
}

impl Span {
    /// The ends for some numbers.
    pub(super) fn new(axis: &Axis, values: impl Iterator<Item = f64>, padding: f64) -> Self {
        let scale = axis.scale;
        if let Some([low, high]) = axis.range.map(|range| range.map(|end| scale.measure(end)))
            && let (Some(low), Some(high)) = (low, high)
            && high - low > 1e-12 * low.abs().max(high.abs()).max(1e-280)
        {
            return Self { scale, low, high };
        }
        let measured = values.filter_map(|value| scale.measure(value));
        let (low, high) = measured
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(value), high.max(value)));
        if low > high {
            return Self { scale, low: 0.0, high: 1.0 };
        }
        // Closer together than numbers of 13 digits can tell: a window about the one number.
        let least = if scale.is_logarithmic() { 0.5 } else { (1e-9 * low.abs().max(high.abs())).max(1e-280) };
        if high - low < 1e-3 * least {
            let reach = if scale.is_logarithmic() || low == 0.0 { 1.0 } else { 0.5 * low.abs() };
            return Self { scale, low: low - reach, high: high + reach };
        }
        let pad = padding * (high - low);
        // Zero stays an end where it is one.
        let (keeps_low, keeps_high) =
            (scale == Scale::Linear && low == 0.0, scale == Scale::Linear && high == 0.0);
        Self {
            scale,
            low: if keeps_low { low } else { low - pad },
            high: if keeps_high { high } else { high + pad },
        }
    }

    /// Where a number lies between the ends, 0 to 1 inside.
    pub(super) fn fraction(&self, value: f64) -> Option<f64> {
        self.scale.measure(value).map(|measured| self.fraction_of_measured(measured))
    }

    pub(super) fn fraction_of_measured(&self, measured: f64) -> f64 {
        (measured - self.low) / (self.high - self.low)
    }

    /// Ticks, about `wanted` of them with labels.
    pub(super) fn ticks(&self, wanted: usize) -> Vec<Tick> {
        match self.scale {
            Scale::Linear => self.linear_ticks(wanted),
            Scale::Log10 if self.high - self.low < 1.2 => self.ticks_within_decade(),
            Scale::Log10 => self.power_ticks(wanted, 10),
            Scale::Log2 => self.power_ticks(wanted, 2),
        }
    }

    fn linear_ticks(&self, wanted: usize) -> Vec<Tick> {
        let rough = (self.high - self.low) / wanted.max(1) as f64;
        let exponent = libm::floor(libm::log10(rough));
        let power = libm::pow(10.0, exponent);
        let factor = [1.0, 2.0, 2.5, 5.0, 10.0].into_iter().find(|factor| factor * power >= rough * 0.999);
        let step = factor.unwrap_or(10.0) * power;
        if !(step > 0.0 && step.is_finite()) {
            return Vec::new();
        }
        let (first, last) = ((self.low / step - 1e-6).ceil(), (self.high / step + 1e-6).floor());
        // Not more than a screen can show, whatever rounding did.
        let count = (last - first).clamp(-1.0, 100.0);
        let at = (0..=count as i64).take_while(|_| count >= 0.0).map(|i| (first + i as f64) * step);
        let at: Vec<f64> = at.collect();
        let greatest = at.iter().fold(0.0f64, |greatest, value| greatest.max(value.abs()));
        at.into_iter().map(|at| Tick { at, label: number(at, step, greatest) }).collect()
    }

    /// Powers of ten or two, with lesser ticks between if there is room.
    fn power_ticks(&self, wanted: usize, base: u32) -> Vec<Tick> {
        let (first, last) = ((self.low - 1e-6).ceil() as i64, (self.high + 1e-6).floor() as i64);
        let count = (last - first + 1).max(0) as usize;
        let stride = count.div_ceil(wanted.max(1)).max(1) as i64;
        let mut ticks = Vec::new();
        for exponent in first..=last {
            let label = if exponent.rem_euclid(stride) == 0 { power(base, exponent) } else { String::new() };
            ticks.push(Tick { at: exponent as f64, label });
        }
        if base == 10 && count <= 8 {
            for exponent in first - 1..=last {
                let between = (2..10).map(|digit| exponent as f64 + libm::log10(f64::from(digit)));
                let inside = between.filter(|at| (self.low..=self.high).contains(at));
                ticks.extend(inside.map(|at| Tick { at, label: String::new() }));
            }
        }
        ticks
    }

    /// About one power of ten: plain numbers, at 1, 2 and 5 of each power or, over less, at equal steps.
    fn ticks_within_decade(&self) -> Vec<Tick> {
        let (low, high) = (libm::pow(10.0, self.low), libm::pow(10.0, self.high));
        if self.high - self.low > 0.6 {
            let powers = libm::floor(self.low) as i64..=libm::floor(self.high) as i64;
            let ticks = powers.flat_map(|exponent| {
                let unit = libm::pow(10.0, exponent as f64);
                (1..10).map(move |digit| {
                    let value = f64::from(digit) * unit;
                    let said = matches!(digit, 1 | 2 | 5);
                    let label = if said { number(value, unit, value) } else { String::new() };
                    Tick { at: libm::log10(value), label }
                })
            });
            return ticks.filter(|tick| (self.low..=self.high).contains(&tick.at)).collect();
        }
        let plain = Self { scale: Scale::Linear, low, high };
        let ticks = plain.linear_ticks(5).into_iter().filter(|tick| tick.at > 0.0);
        ticks.map(|tick| Tick { at: libm::log10(tick.at), label: tick.label }).collect()
    }
}

/// A number at a tick, with as many digits as the step needs.
fn number(value: f64, step: f64, greatest: f64) -> String {
    if value.abs() < step * 1e-6 {
        return "0".into();
    }
    let text = if !(1e-4..1e5).contains(&greatest) {
        let exponent = libm::floor(libm::log10(greatest) + 1e-9);
        let scale = libm::pow(10.0, exponent);
        let digits = (exponent - libm::floor(libm::log10(step) + 1e-9)).clamp(0.0, 12.0) as usize;
        let digits = if needs_half(step) { digits + 1 } else { digits };
        format!("{}×{}", trimmed(format!("{:.digits$}", value / scale)), power(10, exponent as i64))
    } else {
        let half = if needs_half(step) { 1.0 } else { 0.0 };
        let digits = (half - libm::floor(libm::log10(step) + 1e-9)).clamp(0.0, 12.0) as usize;
        format!("{value:.digits$}")
    };
    text.replace('-', "−")
}

/// Whether the step is 2.5 of some power.
fn needs_half(step: f64) -> bool {
    let mantissa = step / libm::pow(10.0, libm::floor(libm::log10(step) + 1e-9));
    (mantissa - 2.5).abs() < 1e-6
}

fn trimmed(text: String) -> String {
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

/// A power in print: 10⁻³.
pub(super) fn power(base: u32, exponent: i64) -> String {
    if exponent == 0 {
        return "1".into();
    }
    if exponent == 1 {
        return base.to_string();
    }
    let raised = |digit: char| match digit {
        '-' => '⁻',
        '0' => '⁰',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        '4' => '⁴',
        '5' => '⁵',
        '6' => '⁶',
        '7' => '⁷',
        '8' => '⁸',
        _ => '⁹',
    };
    format!("{base}{}", exponent.to_string().chars().map(raised).collect::<String>())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(low: f64, high: f64, scale: Scale) -> Vec<String> {
        let said = Span { scale, low, high }.ticks(5).into_iter().map(|tick| tick.label);
        said.filter(|label| !label.is_empty()).collect()
    }

    #[test]
    fn ticks_are_round_numbers() {
        assert_eq!(labels(0.0, 1.0, Scale::Linear), ["0", "0.2", "0.4", "0.6", "0.8", "1.0"]);
        assert_eq!(labels(-3.0, 7.1, Scale::Linear), ["−2.5", "0", "2.5", "5.0"]);
        assert_eq!(labels(-60.0, 50.0, Scale::Linear), ["−50", "−25", "0", "25", "50"]);
        assert_eq!(labels(0.0, 2e7, Scale::Linear), ["0", "0.5×10⁷", "1×10⁷", "1.5×10⁷", "2×10⁷"]);
        assert_eq!(labels(-3.0, 1.0, Scale::Log10), ["10⁻³", "10⁻²", "10⁻¹", "1", "10"]);
        assert_eq!(labels(-1.2, -0.2, Scale::Log10), ["0.1", "0.2", "0.5"]);
        assert_eq!(labels(6.0, 20.0, Scale::Log2), ["2⁶", "2⁹", "2¹²", "2¹⁵", "2¹⁸"]);
    }

    #[test]
    fn ends_hold_all_numbers() {
        let span = Span::new(&Axis::log10(""), [1e-3, f64::NAN, 0.0, -1.0, 10.0].into_iter(), 0.0);
        assert_eq!((span.low, span.high), (-3.0, 1.0));
        for values in [vec![], vec![5.0], vec![f64::INFINITY], vec![-1e300, 1e300], vec![1e-320]] {
            let span = Span::new(&Axis::linear(""), values.into_iter(), 0.04);
            assert!(span.high > span.low && span.high - span.low < f64::INFINITY);
            assert!(span.ticks(5).len() < 30);
        }
    }
}
