//! An expression as a field.

use glam::DVec3;
use luch_formula::{Expression, Tape};

use super::SolidError;
use crate::implicit::field::{Field, Interval, Points, Region};

/// A calculation of `x`, `y` and `z`, compiled: values and gradients in bulk, and proven intervals.
#[derive(Clone, Debug, PartialEq)]
pub struct SolidField {
    tape: Tape,
}

impl SolidField {
    /// Compiles an expression of `x`, `y` and `z`.
    pub fn new(expression: &Expression) -> Result<Self, SolidError> {
        Ok(Self { tape: Tape::new(expression, &["x", "y", "z"])? })
    }

    /// The compiled calculation; its inputs are x, y and z.
    pub fn tape(&self) -> &Tape {
        &self.tape
    }
}

impl Field for SolidField {
    fn values(&self, points: Points<'_>, values: &mut [f64]) {
        self.tape.evaluate(&[points.x, points.y, points.z], values);
    }

    fn gradients(&self, points: Points<'_>, gradients: &mut [DVec3]) {
        let room = || vec![0.0; points.len()];
        let [mut values, mut by_x, mut by_y, mut by_z] = [room(), room(), room(), room()];
        let slopes: &mut [&mut [f64]] = &mut [&mut by_x, &mut by_y, &mut by_z];
        self.tape.gradients(&[points.x, points.y, points.z], &mut values, slopes);
        for (n, gradient) in gradients.iter_mut().enumerate() {
            *gradient = DVec3::new(by_x[n], by_y[n], by_z[n]);
        }
    }

    fn range(&self, region: &Region) -> Interval {
        let side = |axis: usize| luch_formula::Interval::new(region.min[axis], region.max[axis]);
        let range = self.tape.interval(&[side(0), side(1), side(2)]);
        // Where the function is not defined is outside, as if it were infinite.
        Interval { low: range.low, high: if range.partial { f64::INFINITY } else { range.high } }
    }
}
