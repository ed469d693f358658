//! Loops compiled for the vector instructions of the processor at hand.
//!
//! One program holds the code for every [`Level`]; the best one the processor has is found at run time. No level fuses
//! operations, so all give the same bits. All `unsafe` code of the crate stands here, and rests on one fact: code for a level is
//! entered only after the processor was asked for it.
#![allow(unsafe_code)]

/// A set of vector instructions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Level {
    /// What every processor of the compiled-for kind has.
    Portable,
    /// AVX2: four numbers at a time.
    Avx2,
    /// AVX-512 F, VL and DQ: eight numbers at a time.
    Avx512,
}

impl Level {
    /// All levels, the least first.
    pub const ALL: [Self; 3] = [Self::Portable, Self::Avx2, Self::Avx512];

    /// The best level this processor has.
    pub fn available() -> Self {
        #[cfg(target_arch = "x86_64")]
        {
            // Exactly what the functions below are compiled for; the compiler counts FMA and F16C as parts of AVX-512.
            if is_x86_feature_detected!("avx2") {
                let avx512 = is_x86_feature_detected!("fma")
                    && is_x86_feature_detected!("f16c")
                    && is_x86_feature_detected!("avx512f")
                    && is_x86_feature_detected!("avx512vl")
                    && is_x86_feature_detected!("avx512dq");
                return if avx512 { Self::Avx512 } else { Self::Avx2 };
            }
        }
        Self::Portable
    }
}

/// Something to be done with vector instructions. `run` must be marked `#[inline(always)]`, and so must the functions it
/// spends its time in: code that is not inlined is compiled once, for all processors.
pub(crate) trait Task {
    fn run(self);
}

/// Runs a task compiled for a level, or for the best available one if that is less.
#[inline]
pub(crate) fn dispatch<T: Task>(level: Level, task: T) {
    match level.min(Level::available()) {
        // SAFETY: the processor has all features of the level, see `available`.
        #[cfg(target_arch = "x86_64")]
        Level::Avx512 => unsafe { run_avx512(task) },
        // SAFETY: as above.
        #[cfg(target_arch = "x86_64")]
        Level::Avx2 => unsafe { run_avx2(task) },
        _ => task.run(),
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512vl,avx512dq")]
#[inline(never)]
fn run_avx512<T: Task>(task: T) {
    task.run();
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
#[inline(never)]
fn run_avx2<T: Task>(task: T) {
    task.run();
}
