//! The Mersenne Twister in both sizes, after the authors' definition (Matsumoto and Nishimura 1998, Nishimura 2000).

use super::stream::Source;

/// MT19937: 624 words of 32 bits.
#[derive(Clone, Debug)]
pub(super) struct Twister32 {
    words: [u32; 624],
    next: usize,
}

impl Twister32 {
    /// Seeds of one word as `init_genrand`, longer ones as `init_by_array` of the low and the high word.
    pub(super) fn from_seed(seed: u64) -> Twister32 {
        match u32::try_from(seed) {
            Ok(seed) => Self::from_word(seed),
            Err(_) => Self::from_array(&[seed as u32, (seed >> 32) as u32]),
        }
    }

    fn from_word(seed: u32) -> Twister32 {
        let mut words = [seed; 624];
        for i in 1..624 {
            let before = words[i - 1];
            words[i] = 1_812_433_253u32.wrapping_mul(before ^ before >> 30).wrapping_add(i as u32);
        }
        Twister32 { words, next: 624 }
    }

    pub(super) fn from_array(key: &[u32]) -> Twister32 {
        let mut words = Self::from_word(19_650_218).words;
        let (mut i, mut j) = (1, 0);
        for _ in 0..key.len().max(624) {
            let mixed = (words[i - 1] ^ words[i - 1] >> 30).wrapping_mul(1_664_525);
            words[i] = (words[i] ^ mixed).wrapping_add(key[j]).wrapping_add(j as u32);
            i += 1;
            j = (j + 1) % key.len();
            if i == 624 {
                words[0] = words[623];
                i = 1;
            }
        }
        for _ in 0..623 {
            let mixed = (words[i - 1] ^ words[i - 1] >> 30).wrapping_mul(1_566_083_941);
            words[i] = (words[i] ^ mixed).wrapping_sub(i as u32);
            i += 1;
            if i == 624 {
                words[0] = words[623];
                i = 1;
            }
        }
        words[0] = 0x8000_0000;
        Twister32 { words, next: 624 }
    }

    fn twist(&mut self) {
        for i in 0..624 {
            let joined =
                (self.words[i] & 0x8000_0000) | (self.words[if i == 623 { 0 } else { i + 1 }] & 0x7fff_ffff);
            let partner = self.words[if i < 227 { i + 397 } else { i - 227 }];
            self.words[i] = partner ^ joined >> 1 ^ (0u32.wrapping_sub(joined & 1) & 0x9908_b0df);
        }
        self.next = 0;
    }
}

impl Source for Twister32 {
    #[inline(always)]
    fn next(&mut self) -> u64 {
        if self.next >= 624 {
            self.twist();
        }
        let mut y = self.words[self.next];
        self.next += 1;
        y ^= y >> 11;
        y ^= y << 7 & 0x9d2c_5680;
        y ^= y << 15 & 0xefc6_0000;
        u64::from(y ^ y >> 18)
    }
}

/// MT19937-64: 312 words of 64 bits.
#[derive(Clone, Debug)]
pub(super) struct Twister64 {
    words: [u64; 312],
    next: usize,
}

impl Twister64 {
    pub(super) fn from_seed(seed: u64) -> Twister64 {
        let mut words = [seed; 312];
        for i in 1..312 {
            let before = words[i - 1];
            words[i] =
                6_364_136_223_846_793_005u64.wrapping_mul(before ^ before >> 62).wrapping_add(i as u64);
        }
        Twister64 { words, next: 312 }
    }

    #[cfg(test)]
    pub(super) fn from_array(key: &[u64]) -> Twister64 {
        let mut words = Self::from_seed(19_650_218).words;
        let (mut i, mut j) = (1, 0);
        for _ in 0..key.len().max(312) {
            let mixed = (words[i - 1] ^ words[i - 1] >> 62).wrapping_mul(3_935_559_000_370_003_845);
            words[i] = (words[i] ^ mixed).wrapping_add(key[j]).wrapping_add(j as u64);
            i += 1;
            j = (j + 1) % key.len();
            if i == 312 {
                words[0] = words[311];
                i = 1;
            }
        }
        for _ in 0..311 {
            let mixed = (words[i - 1] ^ words[i - 1] >> 62).wrapping_mul(2_862_933_555_777_941_757);
            words[i] = (words[i] ^ mixed).wrapping_sub(i as u64);
            i += 1;
            if i == 312 {
                words[0] = words[311];
                i = 1;
            }
        }
        words[0] = 1 << 63;
        Twister64 { words, next: 312 }
    }

    fn twist(&mut self) {
        for i in 0..312 {
            let following = self.words[if i == 311 { 0 } else { i + 1 }];
            let joined = (self.words[i] & 0xffff_ffff_8000_0000) | (following & 0x7fff_ffff);
            let partner = self.words[if i < 156 { i + 156 } else { i - 156 }];
            self.words[i] = partner ^ joined >> 1 ^ (0u64.wrapping_sub(joined & 1) & 0xb502_6f5a_a966_19e9);
        }
        self.next = 0;
    }
}

impl Source for Twister64 {
    #[inline(always)]
    fn next(&mut self) -> u64 {
        if self.next >= 312 {
            self.twist();
        }
        let mut x = self.words[self.next];
        self.next += 1;
        x ^= x >> 29 & 0x5555_5555_5555_5555;
        x ^= x << 17 & 0x71d6_7fff_eda6_0000;
        x ^= x << 37 & 0xfff7_eee0_0000_0000;
        x ^ x >> 43
    }
}
