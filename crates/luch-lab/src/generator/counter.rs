//! Generators that hash a counter: Philox and ChaCha.

use super::stream::Source;

/// Philox4x32-10: four words at a time.
#[derive(Clone, Debug)]
pub(super) struct Philox {
    key: [u32; 2],
    counter: u128,
    block: [u32; 4],
    next: usize,
}

impl Philox {
    pub(super) fn new(key: [u32; 2]) -> Philox {
        Philox { key, counter: 0, block: [0; 4], next: 4 }
    }

    /// The ten rounds.
    pub(super) fn block(counter: [u32; 4], key: [u32; 2]) -> [u32; 4] {
        let (mut c, mut k) = (counter, key);
        for _ in 0..10 {
            let first = u64::from(c[0]) * 0xd251_1f53;
            let second = u64::from(c[2]) * 0xcd9e_8d57;
            c = [
                (second >> 32) as u32 ^ c[1] ^ k[0],
                second as u32,
                (first >> 32) as u32 ^ c[3] ^ k[1],
                first as u32,
            ];
            k = [k[0].wrapping_add(0x9e37_79b9), k[1].wrapping_add(0xbb67_ae85)];
        }
        c
    }
}

impl Source for Philox {
    #[inline(always)]
    fn next(&mut self) -> u64 {
        if self.next == 4 {
            let c = self.counter;
            let words = [c as u32, (c >> 32) as u32, (c >> 64) as u32, (c >> 96) as u32];
            self.block = Self::block(words, self.key);
            self.counter = c.wrapping_add(1);
            self.next = 0;
        }
        self.next += 1;
        u64::from(self.block[self.next - 1])
    }
}

/// ChaCha with `DOUBLE_ROUNDS` times two rounds, a counter of 64 bits and a nonce of zero.
#[derive(Clone, Debug)]
pub(super) struct ChaCha<const DOUBLE_ROUNDS: usize> {
    key: [u32; 8],
    counter: u64,
    block: [u32; 16],
    next: usize,
}

impl<const DOUBLE_ROUNDS: usize> ChaCha<DOUBLE_ROUNDS> {
    pub(super) fn new(key: [u64; 4]) -> Self {
        let words = std::array::from_fn(|i| (key[i / 2] >> (32 * (i % 2))) as u32);
        ChaCha { key: words, counter: 0, block: [0; 16], next: 16 }
    }

    fn refill(&mut self) {
        let mut start = [0u32; 16];
        // "expand 32-byte k" in four little-endian words.
        start[..4].copy_from_slice(&[0x6170_7865, 0x3320_646e, 0x7962_2d32, 0x6b20_6574]);
        start[4..12].copy_from_slice(&self.key);
        start[12] = self.counter as u32;
        start[13] = (self.counter >> 32) as u32;
        let mut x = start;
        for _ in 0..DOUBLE_ROUNDS {
            for [a, b, c, d] in [[0, 4, 8, 12], [1, 5, 9, 13], [2, 6, 10, 14], [3, 7, 11, 15]] {
                quarter_round(&mut x, a, b, c, d);
            }
            for [a, b, c, d] in [[0, 5, 10, 15], [1, 6, 11, 12], [2, 7, 8, 13], [3, 4, 9, 14]] {
                quarter_round(&mut x, a, b, c, d);
            }
        }
        for (word, start) in x.iter_mut().zip(start) {
            *word = word.wrapping_add(start);
        }
        self.block = x;
        self.counter = self.counter.wrapping_add(1);
        self.next = 0;
    }
}

#[inline(always)]
fn quarter_round(x: &mut [u32; 16], a: usize, b: usize, c: usize, d: usize) {
    x[a] = x[a].wrapping_add(x[b]);
    x[d] = (x[d] ^ x[a]).rotate_left(16);
    x[c] = x[c].wrapping_add(x[d]);
    x[b] = (x[b] ^ x[c]).rotate_left(12);
    x[a] = x[a].wrapping_add(x[b]);
    x[d] = (x[d] ^ x[a]).rotate_left(8);
    x[c] = x[c].wrapping_add(x[d]);
    x[b] = (x[b] ^ x[c]).rotate_left(7);
}

impl<const DOUBLE_ROUNDS: usize> Source for ChaCha<DOUBLE_ROUNDS> {
    #[inline(always)]
    fn next(&mut self) -> u64 {
        if self.next == 16 {
            self.refill();
        }
        self.next += 1;
        u64::from(self.block[self.next - 1])
    }
}
