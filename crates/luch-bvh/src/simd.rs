//! Which vector instructions run, and code compiled for each kind.
//!
//! One binary holds everything for every [`Level`]; the best the processor has is found once, at run time. All levels give
//! the same bits: no operation is fused, and minimum and maximum treat what is not a number alike.
//!
//! All `unsafe` code of the crate lives in this module. It rests on two facts: instructions of a level are reached only after
//! the processor was asked for them, and indices inside a tree were checked when it was built.
//!
//! [`dispatch`] lends the levels to other crates: plain loops over arrays, compiled for the best level.
//!
//! ```
//! use luch_bvh::simd::{Task, dispatch};
//!
//! /// The squares of sixteen numbers at a time.
//! struct Squares<'a>(&'a mut [[f32; 16]]);
//!
//! impl Task for Squares<'_> {
//!     type Output = ();
//!     #[inline(always)]
//!     fn run(self) {
//!         for group in self.0 {
//!             for value in group {
//!                 *value *= *value;
//!             }
//!         }
//!     }
//! }
//!
//! let mut numbers = [[3.0; 16]; 4];
//! dispatch(Squares(&mut numbers));
//! assert_eq!(numbers, [[9.0; 16]; 4]);
//! ```
#![allow(unsafe_code)]

#[cfg(target_arch = "x86_64")]
mod avx2;
#[cfg(target_arch = "x86_64")]
mod avx512;
mod batch;
mod block;
mod coherent;
mod frustum;
mod lanes;
mod level;
mod mesh;
mod packet;
mod portable;
mod queue;
mod ray;
mod walk;

pub use level::{Level, Task, dispatch, dispatch_at};

pub(crate) use batch::{FEW, any_in_mesh, nearest_in_mesh};
pub(crate) use block::Block;
pub(crate) use coherent::{PACKET, Stacks as PacketStacks, trace_world};
pub(crate) use lanes::Isa;
pub(crate) use level::{Kernel, launch};
pub(crate) use mesh::Mesh;
pub(crate) use queue::{World, trace};
pub(crate) use ray::Prepared;
pub(crate) use walk::{Stack, walk};
