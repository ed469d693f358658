//! Random numbers for one sample: a pure function of sequence, seed, pixel, index and purpose.

use crate::hash;
use crate::sequence::Sequence;

/// What a group of four numbers is for: the bounce and a purpose within it.
///
/// Each domain has its own scramble and its own order of the points, so a branch that draws more, or not at all, never
/// shifts the numbers of another.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Domain(u32);

impl Domain {
    /// The domain of `purpose` (0 to 15) at `bounce` (below 2²⁸); higher bits of either are ignored.
    #[inline]
    pub const fn new(bounce: u32, purpose: u32) -> Self {
        debug_assert!(purpose < 16, "a purpose is a number below 16");
        Domain(bounce << 4 | purpose & 15)
    }
}

/// The random numbers of one sample of one pixel.
///
/// Sample `index` belongs to stream A or B by its lowest bit; the streams are independent randomisations, so the half
/// difference of their means is an honest error estimate. Within a stream the points number `index / 2`, and any prefix
/// may be the last one: quality is best when it is a power of two.
///
/// A pixel has 2³³ samples of one randomisation (2³² in each stream). Past that the sampler goes on with a fresh
/// randomisation for every further 2³³, so numbers never repeat; the mean of the parts is as unbiased as each.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sampler {
    /// Hash of seed, pixel and stream.
    key: u64,
    /// Index within the stream.
    index: u32,
    sequence: Sequence,
    stream: u8,
}

impl Sampler {
    /// The numbers of sample `index` of `pixel`.
    #[inline]
    pub fn at(sequence: Sequence, seed: u64, pixel: [u32; 2], index: u64) -> Sampler {
        let place = u64::from(pixel[1]) << 32 | u64::from(pixel[0]);
        // The stream and, past 2³³ samples, the round choose the randomisation.
        let part = (index >> 33) << 1 | (index & 1);
        let key = hash::combine(hash::combine(seed, place), part);
        Sampler { key, index: (index >> 1) as u32, sequence, stream: (index & 1) as u8 }
    }

    /// Four numbers in [0, 1), multiples of 2⁻²⁴: one point of the four-dimensional sequence of this domain.
    ///
    /// Take what belongs together from one group: the four coordinates are even jointly, different groups only on average.
    #[inline]
    pub fn group(&self, domain: Domain) -> [f32; 4] {
        self.group_words(domain).map(hash::unit_f32)
    }

    /// The same four numbers as fractions of 2³²: 32 bits each, for those who need more than an `f32` holds.
    #[inline]
    pub fn group_words(&self, domain: Domain) -> [u32; 4] {
        self.sequence.words(self.domain_key(domain), self.index)
    }

    /// The randomisation of a domain.
    #[inline(always)]
    pub(crate) fn domain_key(&self, domain: Domain) -> u64 {
        hash::mix64(self.key ^ u64::from(domain.0).wrapping_add(1).wrapping_mul(hash::GOLDEN))
    }

    #[inline(always)]
    pub(crate) fn index_in_stream(&self) -> u32 {
        self.index
    }

    /// Where the numbers come from.
    #[inline(always)]
    pub fn sequence(&self) -> Sequence {
        self.sequence
    }

    /// The stream this sample belongs to: 0 (A) or 1 (B), the lowest bit of its index.
    #[inline]
    pub fn stream(&self) -> u32 {
        u32::from(self.stream)
    }
}
