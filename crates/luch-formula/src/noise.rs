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

/// The lowest 32 bits of a whole coordinate: adding 1.5 · 2⁵² shifts them to the end of the number's bits. Beyond 2⁵¹ they are
/// some bits, the same everywhere.
#[inline(always)]
fn whole(floor: f64) -> u32 {
    const SHIFT: f64 = 6_755_399_441_055_744.0;
    (floor + SHIFT).to_bits() as u32
}

/// The direction at a whole point: one coordinate 0, the others ±1.
#[inline(always)]
fn direction(x: u32, y: u32, z: u32) -> [f64; 3] {
    let bits = hash(x, y, z);
    // The upper half chooses the axis, evenly to one part in 2¹⁶.
    let axis = ((bits >> 16) * 3) >> 16;
    let first = if bits & 1 == 0 { 1.0 } else { -1.0 };
    let second = if bits & 2 == 0 { 1.0 } else { -1.0 };
    let middle = if axis == 0 { first } else { second };
    [
        if axis == 0 { 0.0 } else { first },
        if axis == 1 { 0.0 } else { middle },
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

/// What the corners of a cell need to know about one axis.
#[derive(Clone, Copy)]
pub(crate) struct Axis {
    /// The lattice coordinate below.
    pub(crate) low: u32,
    /// How far above it the point is, 0 to 1.
    pub(crate) t: f64,
    /// The weight of the upper end, and its derivative.
    pub(crate) weight: f64,
    pub(crate) slope: f64,
}

impl Axis {
    #[inline(always)]
    pub(crate) fn new(coordinate: f64) -> Self {
        let floor = coordinate.floor();
        let t = coordinate - floor;
        Self { low: whole(floor), t, weight: blend(t), slope: blend_slope(t) }
    }

    /// The axis as its lower or upper end sees it.
    #[inline(always)]
    fn end(&self, upper: bool) -> End {
        if upper {
            End {
                place: self.low.wrapping_add(1),
                offset: self.t - 1.0,
                weight: self.weight,
                slope: self.slope,
            }
        } else {
            End { place: self.low, offset: self.t, weight: 1.0 - self.weight, slope: -self.slope }
        }
    }
}

struct End {
    place: u32,
    offset: f64,
    weight: f64,
    slope: f64,
}

/// What the corner with the given number adds: bit 0 is set on the upper end of x, bit 1 of y, bit 2 of z.
#[inline(always)]
pub(crate) fn corner<const NUMBER: u32>(x: Axis, y: Axis, z: Axis) -> Noise {
    let [x, y, z] = [x.end(NUMBER & 1 != 0), y.end(NUMBER & 2 != 0), z.end(NUMBER & 4 != 0)];
    let [along_x, along_y, along_z] = direction(x.place, y.place, z.place);
    let dot = along_x * x.offset + along_y * y.offset + along_z * z.offset;
    let weight = x.weight * y.weight * z.weight;
    Noise {
        value: weight * dot,
        gradient: [
            weight * along_x + x.slope * y.weight * z.weight * dot,
            weight * along_y + y.slope * x.weight * z.weight * dot,
            weight * along_z + z.slope * x.weight * y.weight * dot,
        ],
    }
}

/// The noise at a point. Undefined where a coordinate is not finite.
#[inline(always)]
pub(crate) fn noise(x: f64, y: f64, z: f64) -> Noise {
    let [x, y, z] = [x, y, z].map(Axis::new);
    let mut sum = corner::<0>(x, y, z);
    let mut add = |part: Noise| {
        sum.value += part.value;
        for (sum, part) in sum.gradient.iter_mut().zip(part.gradient) {
            *sum += part;
        }
    };
    add(corner::<1>(x, y, z));
    add(corner::<2>(x, y, z));
    add(corner::<3>(x, y, z));
    add(corner::<4>(x, y, z));
    add(corner::<5>(x, y, z));
    add(corner::<6>(x, y, z));
    add(corner::<7>(x, y, z));
    sum
}
