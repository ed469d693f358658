//! How much a file may grow in memory.

use super::json::Json;
use crate::Problem;

/// Bytes that any file may become.
const FREE: u64 = 32 << 20;

/// Bytes that each byte of the file may become: a strip of one-byte indices makes 12 bytes a triangle, and vertices
/// may be used by several meshes.
const GROWTH: u64 = 32;

/// Bytes that may still be made. Lists can be used again and again by a few characters of JSON; this keeps memory and
/// time in proportion to the size of the input.
#[derive(Debug)]
pub(super) struct Budget {
    left: u64,
}

impl Budget {
    /// The allowance of an input of `bytes` bytes.
    pub(super) fn new(bytes: u64) -> Self {
        Self { left: FREE.saturating_add(bytes.saturating_mul(GROWTH)) }
    }

    /// Takes `count` things of `size` bytes, on behalf of `owner`.
    pub(super) fn take(&mut self, count: usize, size: usize, owner: &Json) -> Result<(), Problem> {
        let bytes = (count as u64).saturating_mul(size as u64);
        match self.left.checked_sub(bytes) {
            Some(left) => {
                self.left = left;
                Ok(())
            }
            None => Err(owner.problem(format!(
                "asks for {bytes} more bytes of geometry, which is out of proportion: with what was made before, over \
                 {GROWTH} times the size of the input"
            ))),
        }
    }
}
