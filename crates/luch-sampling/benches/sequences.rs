//! Time of one group of four numbers, for each sequence.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use luch_sampling::{Domain, Sampler, Sequence};

fn groups(criterion: &mut Criterion) {
    for sequence in Sequence::ALL {
        criterion.bench_function(&format!("at + group/{}", sequence.name()), |bencher| {
            let mut index = 0u64;
            bencher.iter(|| {
                index = index.wrapping_add(1);
                Sampler::at(sequence, 1, [3, 4], index).group(Domain::new(0, 1))
            });
        });
        criterion.bench_function(&format!("group/{}", sequence.name()), |bencher| {
            let sampler = Sampler::at(sequence, 1, [3, 4], 12_345);
            let mut bounce = 0u32;
            bencher.iter(|| {
                bounce = (bounce + 1) & 0xffff;
                black_box(&sampler).group(Domain::new(bounce, 1))
            });
        });
    }
}

criterion_group!(benches, groups);
criterion_main!(benches);
