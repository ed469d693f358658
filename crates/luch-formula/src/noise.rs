//! Smooth noise over space, with its derivatives.
//!
//! Gradient noise (Perlin 1985) with the fifth-degree blend of Perlin (2002): at each whole point stands one of the twelve
//! directions toward the edges of a cube, chosen by a hash of the point. Values lie in −1..1 and are zero at whole points;
//! second derivatives are continuous. The hash is made of whole numbers alone, so the noise is the same everywhere. It repeats
//! after 2³² along each axis.

/// Noise at a point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Noise {
    pub(crate) value: f64,
    pub(crate) gradient: [f64; 3],
}

/// Bound of each partial derivative. Each is Σ w·g + Σ w′·(g·d): weights sum to 1 and |g| ≤ 1, |w′| ≤ 15/8, and the mean of
/// |g·d| over both ends of an axis is at most (t + 1) + (1 − t + 1) = 3 altogether: 1 + 45/8.
pub(crate) const STEEPEST: f64 = 6.625;

/// Bound of each second partial derivative. Along one axis s″ ≤ 10/√3: 3 · 5.78 + 2 · 2 · 15/8 < 25. Mixed: the four ends of two
/// axes have Σ|g·d| ≤ 6, times (15/8)², and twice 2 · 15/8: below 28.7.
pub(crate) const MOST_CURVED: f64 = 28.7;

/// A whole point's random bits: two rounds of multiply and shift over the mixed coordinates.
#[inline(always)]
fn hash(x: u32, y: u32, z: u32) -> u32 {
    let mut bits = x
        .wrapping_mul(0x9e37_79b1)
        .wrapping_add(y.wrapping_mul(0x85eb_ca77))
        .wrapping_add(z.wrapping_mul(0xc2b2_ae3d));
    bits ^= bits >> 15;
    bits = bits.wrapping_mul(0x2c1b_3c6d);
    bits ^= bits >> 12;
    bits = bits.wrapping_mul(0x297a_2d39);
    bits ^ bits >> 15
}

/// A whole coordinate, wrapped into 32 bits.
#[inline(always)]
fn whole(floor: f64) -> u32 {
    const PERIOD: f64 = 4_294_967_296.0;
    (floor - PERIOD * (floor / PERIOD).floor()) as u32
}

/// The direction at a whole point: one coordinate 0, the others ±1.
#[inline(always)]
fn direction(x: u32, y: u32, z: u32) -> [f64; 3] {
    let bits = hash(x, y, z);
    // The upper bits choose the axis, evenly to one part in 2²⁸.
    let axis = ((u64::from(bits >> 2) * 3) >> 30) as u32;
    let first = if bits & 1 == 0 { 1.0 } else { -1.0 };
    let second = if bits & 2 == 0 { 1.0 } else { -1.0 };
    [
        if axis == 0 { 0.0 } else { first },
        if axis == 1 {
            0.0
        } else if axis == 0 {
            first
        } else {
            second
        },
        if axis == 2 { 0.0 } else { second },
    ]
}

#[inline(always)]
fn blend(t: f64) -> f64 {
    t * t * t * (t * (t * 6.0 - 15.0) + 10.0)
}

#[inline(always)]
fn blend_slope(t: f64) -> f64 {
    let product = t * (1.0 - t);
    30.0 * (product * product)
}

/// The noise at a point. Undefined where a coordinate is not finite.
#[inline(always)]
pub(crate) fn noise(x: f64, y: f64, z: f64) -> Noise {
    let floor = [x.floor(), y.floor(), z.floor()];
    let t = [x - floor[0], y - floor[1], z - floor[2]];
    let low = floor.map(whole);
    let high = low.map(|coordinate| coordinate.wrapping_add(1));
    let weight = t.map(blend);
    let slope = t.map(blend_slope);
    let mut result = Noise { value: 0.0, gradient: [0.0; 3] };
    for corner in 0..8_usize {
        let up = [corner & 1, corner >> 1 & 1, corner >> 2];
        let pick = |axis: usize| if up[axis] == 1 { high[axis] } else { low[axis] };
        let direction = direction(pick(0), pick(1), pick(2));
        let mut w = [0.0; 3];
        let mut s = [0.0; 3];
        let mut dot = 0.0;
        for axis in 0..3 {
            let upper = up[axis] == 1;
            w[axis] = if upper { weight[axis] } else { 1.0 - weight[axis] };
            s[axis] = if upper { slope[axis] } else { -slope[axis] };
            dot += direction[axis] * (t[axis] - if upper { 1.0 } else { 0.0 });
        }
        let whole = w[0] * w[1] * w[2];
        result.value += whole * dot;
        result.gradient[0] += whole * direction[0] + s[0] * w[1] * w[2] * dot;
        result.gradient[1] += whole * direction[1] + s[1] * w[0] * w[2] * dot;
        result.gradient[2] += whole * direction[2] + s[2] * w[0] * w[1] * dot;
    }
    result
}
