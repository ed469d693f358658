//! Integrals of densities over rectangles, to an absolute error, narrow peaks and jumps included.

use super::density_fit::Area;

/// Nodes and weights of Lobatto on −1 to 1: the ends are among them, so jumps near a border are seen (Abramowitz and Stegun, table 25.6).
const LOBATTO: [[f64; 2]; 4] = [
    [-1.0, 0.166_666_666_666_666_66],
    [-0.447_213_595_499_957_9, 0.833_333_333_333_333_4],
    [0.447_213_595_499_957_9, 0.833_333_333_333_333_4],
    [1.0, 0.166_666_666_666_666_66],
];
/// Those of Gauss and Legendre (table 25.4): an odd number, so that no jump moves both results alike.
const GAUSS: [[f64; 2]; 5] = [
    [-0.906_179_845_938_664, 0.236_926_885_056_189_08],
    [-0.538_469_310_105_683_1, 0.478_628_670_499_366_47],
    [0.0, 0.568_888_888_888_888_9],
    [0.538_469_310_105_683_1, 0.478_628_670_499_366_47],
    [0.906_179_845_938_664, 0.236_926_885_056_189_08],
];

/// Halvings of both sides, at most.
const DEEPEST: u32 = 12;

/// A density under integration.
pub(super) struct Cubature<'a> {
    pub(super) density: &'a dyn Fn([f64; 2]) -> f64,
    /// Error of a piece that is good enough.
    pub(super) tolerance: f64,
    /// Values that may still be asked for; afterwards the first answer is taken.
    pub(super) budget: u64,
}

/// What a rule found in a rectangle.
struct Glance {
    integral: f64,
    greatest: f64,
    has_zero: bool,
}

impl Cubature<'_> {
    /// The integral over a rectangle, of which the part `crowded` holds nearly all.
    ///
    /// Around that part the rectangle is cut into pieces that grow in equal ratios, so that tails which end soon are not stepped over.
    pub(super) fn graded(&mut self, area: Area, crowded: Area) -> f64 {
        let [xs, ys] = [0, 1]
            .map(|axis| cuts([area.low[axis], area.high[axis]], [crowded.low[axis], crowded.high[axis]]));
        let mut sum = 0.0;
        for y in ys.windows(2) {
            for x in xs.windows(2) {
                let piece = Area { low: [x[0], y[0]], high: [x[1], y[1]] };
                let is_crowded = x[0] >= crowded.low[0]
                    && x[1] <= crowded.high[0]
                    && y[0] >= crowded.low[1]
                    && y[1] <= crowded.high[1];
                sum += self.over(piece, u32::from(is_crowded), DEEPEST);
            }
        }
        sum
    }

    /// The integral over a rectangle, quartered `forced` times and then wherever two rules disagree or the density ends inside.
    pub(super) fn over(&mut self, area: Area, forced: u32, depth: u32) -> f64 {
        if area.size() == 0.0 {
            return 0.0;
        }
        if forced == 0 {
            let coarse = self.glance(area, &LOBATTO);
            let fine = self.glance(area, &GAUSS);
            let greatest = coarse.greatest.max(fine.greatest);
            let is_close = (fine.integral - coarse.integral).abs() <= self.tolerance;
            let ends_inside = (coarse.has_zero || fine.has_zero) && greatest * area.size() > self.tolerance;
            let is_settled = is_close && !ends_inside;
            if is_settled || depth == 0 || self.budget == 0 {
                return fine.integral;
            }
        }
        let quarters = area.quarters();
        quarters.map(|q| self.over(q, forced.saturating_sub(1), depth.saturating_sub(1))).iter().sum()
    }

    fn glance(&mut self, area: Area, rule: &[[f64; 2]]) -> Glance {
        self.budget = self.budget.saturating_sub((rule.len() * rule.len()) as u64);
        let half = [0, 1].map(|axis| 0.5 * (area.high[axis] - area.low[axis]));
        let middle = [0, 1].map(|axis| 0.5 * (area.high[axis] + area.low[axis]));
        let mut found = Glance { integral: 0.0, greatest: 0.0, has_zero: false };
        for [v, down] in rule {
            for [u, across] in rule {
                let value = (self.density)([middle[0] + half[0] * u, middle[1] + half[1] * v]);
                // What is no number is no density: it counts for nothing and the counts will tell.
                let value = if value.is_finite() { value } else { 0.0 };
                found.integral += value * across * down;
                found.greatest = found.greatest.max(value);
                found.has_zero |= value == 0.0;
            }
        }
        found.integral *= half[0] * half[1];
        found
    }
}

/// Places from `low` to `high` with the range `inner` among them, and beyond it steps that treble.
fn cuts([low, high]: [f64; 2], inner: [f64; 2]) -> Vec<f64> {
    let [a, b] = inner.map(|x| x.clamp(low, high));
    let first = (b - a).max(1e-9 * (high - low));
    let steps = |from: f64, to: f64| {
        let reach = (to - from).abs();
        let mut places = Vec::new();
        let (mut step, mut gone) = (first, first);
        while gone < reach {
            places.push(from + (to - from) * (gone / reach));
            step *= 3.0;
            gone += step;
        }
        places.push(to);
        places
    };
    let mut all = steps(a, low);
    all.reverse();
    all.extend([a, b]);
    all.extend(steps(b, high));
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn peaks_rims_and_tails_are_found() {
        let square = Area { low: [0.0; 2], high: [1.0; 2] };
        let over = |density: &dyn Fn([f64; 2]) -> f64, crowded: Area| {
            Cubature { density, tolerance: 1e-7, budget: 1 << 26 }.graded(square, crowded)
        };
        // A peak 10⁻⁵ wide, seen where samples lie.
        let width = 1e-5;
        let peak = |[x, y]: [f64; 2]| {
            let z = ((x - 0.3) / width, (y - 0.7) / width);
            libm::exp(-0.5 * (z.0 * z.0 + z.1 * z.1)) / (std::f64::consts::TAU * width * width)
        };
        let near = Area { low: [0.3 - width, 0.7 - width], high: [0.3 + width, 0.7 + width] };
        assert!((over(&peak, near) - 1.0).abs() < 1e-5, "{}", over(&peak, near));
        let disc = |[x, y]: [f64; 2]| f64::from(u8::from(libm::hypot(x - 0.5, y - 0.5) < 0.4));
        let truth = std::f64::consts::PI * 0.16;
        assert!((over(&disc, square) - truth).abs() < 2e-5, "{}", over(&disc, square));
        assert_eq!(over(&|_| f64::NAN, square), 0.0);
    }
}
