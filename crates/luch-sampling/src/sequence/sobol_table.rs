//! The generator matrices of the first four Sobol' dimensions, computed while compiling.
//!
//! Primitive polynomials and initial direction numbers as chosen by Joe and Kuo, "Constructing Sobol' sequences with better
//! two-dimensional projections" (2008).

/// One dimension: degree of the primitive polynomial, its inner coefficients, the initial odd numbers m₁, m₂, …
struct Dimension {
    degree: usize,
    coefficients: u32,
    initial: [u32; 3],
}

/// Dimensions two to four; the first is van der Corput's and has no polynomial.
const DIMENSIONS: [Dimension; 3] = [
    Dimension { degree: 1, coefficients: 0, initial: [1, 0, 0] },
    Dimension { degree: 2, coefficients: 1, initial: [1, 3, 0] },
    Dimension { degree: 3, coefficients: 1, initial: [1, 3, 1] },
];

/// `DIRECTIONS[bit][dimension]`: what bit `bit` of the index adds (exclusive or) to the coordinate, as a fraction of 2³².
pub(super) const DIRECTIONS: [[u32; 4]; 32] = directions();

/// `REVERSED[nibble][value][dimension]`: the same, four index bits at once, for the *reversed* index (its lowest nibble
/// holds the four highest bits, mirrored) and with *reversed* coordinates: between two scrambles nothing needs turning.
pub(super) static REVERSED: [[[u32; 4]; 16]; 8] = reversed();

/// `REVERSED_BITS[bit][dimension]`: the same for single bits of the reversed index.
pub(super) static REVERSED_BITS: [[u32; 4]; 32] = reversed_bits();

const fn reversed_bits() -> [[u32; 4]; 32] {
    let mut table = [[0; 4]; 32];
    let mut bit = 0;
    while bit < 32 {
        let mut d = 0;
        while d < 4 {
            table[bit][d] = DIRECTIONS[31 - bit][d].reverse_bits();
            d += 1;
        }
        bit += 1;
    }
    table
}

const fn directions() -> [[u32; 4]; 32] {
    let mut table = [[0; 4]; 32];
    let mut bit = 0;
    while bit < 32 {
        table[bit][0] = 1 << (31 - bit);
        let mut d = 0;
        while d < 3 {
            let Dimension { degree, coefficients, initial } = &DIMENSIONS[d];
            table[bit][d + 1] = if bit < *degree {
                initial[bit] << (31 - bit)
            } else {
                let oldest = table[bit - *degree][d + 1];
                let mut value = oldest ^ (oldest >> *degree);
                let mut k = 1;
                while k < *degree {
                    if (*coefficients >> (*degree - 1 - k)) & 1 == 1 {
                        value ^= table[bit - k][d + 1];
                    }
                    k += 1;
                }
                value
            };
            d += 1;
        }
        bit += 1;
    }
    table
}

const fn reversed() -> [[[u32; 4]; 16]; 8] {
    let mut table = [[[0; 4]; 16]; 8];
    let mut nibble = 0;
    while nibble < 8 {
        let mut value = 0;
        while value < 16 {
            let mut bit = 0;
            while bit < 4 {
                if (value >> bit) & 1 == 1 {
                    let mut d = 0;
                    while d < 4 {
                        table[nibble][value][d] ^= DIRECTIONS[31 - (4 * nibble + bit)][d].reverse_bits();
                        d += 1;
                    }
                }
                bit += 1;
            }
            value += 1;
        }
        nibble += 1;
    }
    table
}
