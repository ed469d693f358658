//! The levels, the choice among them, and the way into code compiled for one.

#[cfg(target_arch = "x86_64")]
use super::{avx2::Avx2, avx512::Avx512};
use super::{lanes::Isa, portable::Portable};
use std::marker::PhantomData;
use std::sync::atomic::{AtomicU8, Ordering};

/// A set of vector instructions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Level {
    /// What every processor of the compiled-for kind has: plain arrays, left to the compiler.
    Portable,
    /// AVX2: eight numbers at a time.
    Avx2,
    /// AVX-512 F, VL, DQ and BW: sixteen numbers at a time, and masks.
    Avx512,
}

/// The level in use plus one; 0 until it was first asked for.
static CURRENT: AtomicU8 = AtomicU8::new(0);

impl Level {
    /// All levels, the least first.
    pub const ALL: [Self; 3] = [Self::Portable, Self::Avx2, Self::Avx512];

    /// The best level this processor has.
    pub fn available() -> Self {
        #[cfg(target_arch = "x86_64")]
        {
            // Exactly what the functions below are compiled for.
            let avx2 = is_x86_feature_detected!("avx2")
                && is_x86_feature_detected!("bmi1")
                && is_x86_feature_detected!("bmi2")
                && is_x86_feature_detected!("popcnt")
                && is_x86_feature_detected!("lzcnt");
            // AVX-512F brings fused multiplication with it as far as the compiler is concerned; nothing here uses it.
            let avx512 = avx2
                && is_x86_feature_detected!("fma")
                && is_x86_feature_detected!("f16c")
                && is_x86_feature_detected!("avx512f")
                && is_x86_feature_detected!("avx512vl")
                && is_x86_feature_detected!("avx512dq")
                && is_x86_feature_detected!("avx512bw");
            if avx512 {
                return Self::Avx512;
            }
            if avx2 {
                return Self::Avx2;
            }
        }
        Self::Portable
    }

    /// The level everything in this process uses: the best available, or what [`Level::limit`] allows.
    #[inline]
    pub fn current() -> Self {
        match CURRENT.load(Ordering::Relaxed) {
            1 => Self::Portable,
            2 => Self::Avx2,
            3 => Self::Avx512,
            _ => Self::limit(Self::Avx512),
        }
    }

    /// From now on this process uses nothing above `self`; returns the level it will use. Changes how long things take,
    /// never a result.
    pub fn limit(self) -> Self {
        let chosen = self.min(Self::available());
        CURRENT.store(chosen as u8 + 1, Ordering::Relaxed);
        chosen
    }

    /// As it is written: `portable`, `avx2`, `avx512`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Portable => "portable",
            Self::Avx2 => "avx2",
            Self::Avx512 => "avx512",
        }
    }
}

/// Something to be done with vector instructions.
pub trait Task {
    /// What comes of it.
    type Output;

    /// Does it. Must be marked `#[inline(always)]`, and so must the functions it spends its time in: code that is not
    /// inlined is compiled once, for all processors.
    fn run(self) -> Self::Output;
}

/// Runs a task compiled for the [current](Level::current) level.
#[inline]
pub fn dispatch<T: Task>(task: T) -> T::Output {
    // SAFETY: the current level is never above what the processor has.
    unsafe { enter(Level::current(), task) }
}

/// Runs a task compiled for the given level, or for the best available one if that is less.
#[inline]
pub fn dispatch_at<T: Task>(level: Level, task: T) -> T::Output {
    // SAFETY: the level is not above what the processor has.
    unsafe { enter(level.min(Level::available()), task) }
}

/// Runs a task compiled for a level.
///
/// # Safety
///
/// The level must be at most [`Level::available`].
#[inline]
unsafe fn enter<T: Task>(level: Level, task: T) -> T::Output {
    match level {
        // SAFETY: the processor has all features the function is compiled for: that is what the level means.
        #[cfg(target_arch = "x86_64")]
        Level::Avx512 => unsafe { run_avx512(task) },
        // SAFETY: as above.
        #[cfg(target_arch = "x86_64")]
        Level::Avx2 => unsafe { run_avx2(task) },
        _ => task.run(),
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512vl,avx512dq,avx512bw,bmi1,bmi2,popcnt,lzcnt")]
#[inline(never)]
pub(super) fn run_avx512<T: Task>(task: T) -> T::Output {
    task.run()
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,bmi1,bmi2,popcnt,lzcnt")]
#[inline(never)]
pub(super) fn run_avx2<T: Task>(task: T) -> T::Output {
    task.run()
}

/// Runs a task in a function of its own.
#[inline(never)]
pub(super) fn run_portable<T: Task>(task: T) -> T::Output {
    task.run()
}

/// A query, written once for all levels.
pub(crate) trait Kernel {
    type Output;

    /// Must be marked `#[inline(always)]`.
    fn run<I: Isa>(self) -> Self::Output;
}

/// Runs a kernel at the current level.
#[inline]
pub(crate) fn launch<K: Kernel>(kernel: K) -> K::Output {
    match Level::current() {
        // SAFETY: the current level is never above what the processor has.
        #[cfg(target_arch = "x86_64")]
        Level::Avx512 => unsafe { run_avx512(At::<Avx512, K>(kernel, PhantomData)) },
        // SAFETY: as above.
        #[cfg(target_arch = "x86_64")]
        Level::Avx2 => unsafe { run_avx2(At::<Avx2, K>(kernel, PhantomData)) },
        _ => kernel.run::<Portable>(),
    }
}

/// A kernel together with its level.
struct At<I, K>(K, PhantomData<I>);

impl<I: Isa, K: Kernel> Task for At<I, K> {
    type Output = K::Output;
    #[inline(always)]
    fn run(self) -> K::Output {
        self.0.run::<I>()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Sum<'a>(&'a [f32]);

    impl Task for Sum<'_> {
        type Output = u32;
        #[inline(always)]
        fn run(self) -> u32 {
            // Sixteen sums side by side; the compiler may not fuse the product into them.
            let mut sums = [0.0_f32; 16];
            for group in self.0.chunks_exact(16) {
                for (sum, value) in sums.iter_mut().zip(group) {
                    *sum += value * value;
                }
            }
            sums.iter().fold(0, |all, sum| all ^ sum.to_bits())
        }
    }

    #[test]
    fn every_level_gives_the_same_bits() {
        let numbers: Vec<f32> = (1..4096).map(|i| 1.0 / i as f32).collect();
        let expected = Sum(&numbers).run();
        for level in Level::ALL {
            assert_eq!(dispatch_at(level, Sum(&numbers)), expected, "{}", level.name());
        }
        assert_eq!(dispatch(Sum(&numbers)), expected);
    }
}
