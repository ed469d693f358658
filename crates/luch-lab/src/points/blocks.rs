//! Points in blocks: the word of a point is that of its place in the block joined with that of its block.
//!
//! Both Sobol' points (joined by exclusive or) and lattice points (by addition) have this form. The first part is a table made
//! once, the second is constant for a block, so a coordinate costs a few vector instructions.

/// Points of a block.
const BLOCK: usize = 128;

/// Points treated in one inner loop, so that it is long enough in few dimensions too.
pub(super) const RUN: usize = 8;

/// How the words of a run become numbers.
pub(super) trait Kernel {
    /// The word of place `index` of the first block.
    fn place(&self, dimension: usize, index: u32) -> u32;

    /// The word of the block that starts at `index`.
    fn block(&self, dimension: usize, index: u32) -> u32;

    /// Joins words of places with words of blocks and writes the numbers; all three slices run over points and dimensions, and
    /// begin with dimension 0.
    fn finish(&self, places: &[u32], blocks: &[u32], out: &mut [f64]);
}

/// A value for each dimension, repeated for all points of a run.
pub(super) fn repeated(dimensions: usize, value: impl Fn(usize) -> u32) -> Vec<u32> {
    let one: Vec<u32> = (0..dimensions).map(value).collect();
    one.repeat(RUN)
}

/// Writes the points from number `first` on.
pub(super) fn fill(kernel: &impl Kernel, dimensions: usize, first: u64, out: &mut [f64]) {
    let block_length = BLOCK * dimensions;
    let run_length = RUN * dimensions;
    let places: Vec<u32> = (0..BLOCK)
        .flat_map(|i| (0..dimensions).map(move |d| (d, i as u32)))
        .map(|(d, i)| kernel.place(d, i))
        .collect();
    let mut block_words = vec![0u32; run_length];
    let mut whole = Vec::new();
    let (mut index, mut rest) = (first, out);
    while !rest.is_empty() {
        let skipped = (index % BLOCK as u64) as usize * dimensions;
        let start = (index - index % BLOCK as u64) as u32;
        for (f, word) in block_words.iter_mut().enumerate().take(dimensions) {
            *word = kernel.block(f, start);
        }
        for run in 1..RUN {
            block_words.copy_within(0..dimensions, run * dimensions);
        }
        let taken = rest.len().min(block_length - skipped);
        let (target, later) = rest.split_at_mut(taken);
        if taken == block_length {
            let runs = target.chunks_exact_mut(run_length).zip(places.chunks_exact(run_length));
            runs.for_each(|(run, places)| kernel.finish(places, &block_words, run));
        } else {
            whole.resize(block_length, 0.0);
            let runs = whole.chunks_exact_mut(run_length).zip(places.chunks_exact(run_length));
            runs.for_each(|(run, places)| kernel.finish(places, &block_words, run));
            target.copy_from_slice(&whole[skipped..skipped + taken]);
        }
        index += (taken / dimensions) as u64;
        rest = later;
    }
}
