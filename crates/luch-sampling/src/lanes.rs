//! Many samples' numbers at once, for loops that the compiler turns into vector code.

use crate::hash;
use crate::sampler::{Domain, Sampler};
use crate::sequence::{Sequence, sobol};

/// [`Sampler::group_words`] of sixteen samples: `[number][sample]`, the same bits.
///
/// All samples must be of one sequence, that of the first. Meant to be inlined into code compiled for vector instructions.
#[inline(always)]
pub fn group_words_16(samplers: &[Sampler; 16], domain: Domain) -> [[u32; 16]; 4] {
    let mut keys = [0; 16];
    let mut indices = [0; 16];
    for lane in 0..16 {
        keys[lane] = samplers[lane].domain_key(domain);
        indices[lane] = samplers[lane].index_in_stream();
    }
    match samplers[0].sequence() {
        Sequence::Sobol => sobol::words_16(&keys, &indices),
        other => {
            let mut words = [[0; 16]; 4];
            for lane in 0..16 {
                let group = other.words(keys[lane], indices[lane]);
                for number in 0..4 {
                    words[number][lane] = group[number];
                }
            }
            words
        }
    }
}

/// The same words as numbers in [0, 1): see [`hash::unit_f32`].
#[inline(always)]
pub fn unit_16(words: &[u32; 16]) -> [f32; 16] {
    let mut numbers = [0.0; 16];
    for lane in 0..16 {
        numbers[lane] = hash::unit_f32(words[lane]);
    }
    numbers
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lanes_agree_with_single_samples() {
        for sequence in Sequence::ALL {
            for turn in 0..200u64 {
                let samplers: [Sampler; 16] = std::array::from_fn(|lane| {
                    let index = hash::mix64(turn * 16 + lane as u64) >> (turn % 40);
                    Sampler::at(sequence, turn, [lane as u32, turn as u32], index)
                });
                let domain = Domain::new(turn as u32 % 5, 2);
                let words = group_words_16(&samplers, domain);
                for lane in 0..16 {
                    let expected = samplers[lane].group_words(domain);
                    assert_eq!(std::array::from_fn(|number| words[number][lane]), expected, "{sequence:?}");
                }
            }
        }
    }
}
