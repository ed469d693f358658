//! Fields made of other fields, whatever these are; solids have the same operations as one calculation.

use glam::DVec3;

use super::field::{Field, Interval, Points, Region};

/// How two bodies become one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operation {
    /// All points in either.
    Union,
    /// All points in both.
    Intersection,
    /// All points in the first that are not in the second.
    Difference,
}

/// A field made of others.
#[derive(Clone, Copy)]
pub enum Composite<'a> {
    /// A body grown by a distance, or shrunk by a negative one.
    Offset {
        /// The body.
        field: &'a dyn Field,
        /// How far its surface moves outward, in the field's measure.
        distance: f64,
    },
    /// A wall along a surface, half of it on either side.
    Shell {
        /// The body.
        field: &'a dyn Field,
        /// Of the wall.
        thickness: f64,
    },
    /// Two bodies.
    Pair {
        /// The first and the second.
        fields: [&'a dyn Field; 2],
        /// What is done.
        operation: Operation,
        /// The seam is rounded where the values differ by less than this; 0 for none.
        width: f64,
    },
}

impl Operation {
    /// All operations are the least of two, with some signs: those of the operands and of the result.
    fn signs(self) -> [f64; 3] {
        match self {
            Self::Union => [1.0, 1.0, 1.0],
            Self::Intersection => [-1.0, -1.0, -1.0],
            Self::Difference => [-1.0, 1.0, -1.0],
        }
    }
}

/// The lesser of both, less (width − |a − b|)² / (4 width) where they are near each other. A number wins over none.
fn smooth_least(a: f64, b: f64, width: f64) -> f64 {
    let near = width - (a - b).abs();
    if near > 0.0 { a.min(b) - near * near / (4.0 * width) } else { a.min(b) }
}

/// How much the second counts in the slope of [`smooth_least`].
fn share_of_second(a: f64, b: f64, width: f64) -> f64 {
    let near = width - (a - b).abs();
    let share_of_greater = if near > 0.0 { near / (2.0 * width) } else { 0.0 };
    if b < a || a.is_nan() { 1.0 - share_of_greater } else { share_of_greater }
}

/// An interval times a sign.
fn signed(interval: Interval, sign: f64) -> Interval {
    if sign > 0.0 { interval } else { Interval { low: -interval.high, high: -interval.low } }
}

impl Field for Composite<'_> {
    fn values(&self, points: Points<'_>, values: &mut [f64]) {
        match *self {
            Self::Offset { field, distance } => {
                field.values(points, values);
                values.iter_mut().for_each(|value| *value -= distance);
            }
            Self::Shell { field, thickness } => {
                field.values(points, values);
                values.iter_mut().for_each(|value| *value = value.abs() - 0.5 * thickness);
            }
            Self::Pair { fields, operation, width } => {
                let [first, second, result] = operation.signs();
                let mut others = vec![0.0; points.len()];
                fields[0].values(points, values);
                fields[1].values(points, &mut others);
                for (value, other) in values.iter_mut().zip(others) {
                    *value = result * smooth_least(first * *value, second * other, width);
                }
            }
        }
    }

    fn gradients(&self, points: Points<'_>, gradients: &mut [DVec3]) {
        match *self {
            Self::Offset { field, .. } => field.gradients(points, gradients),
            Self::Shell { field, .. } => {
                let mut values = vec![0.0; points.len()];
                field.values(points, &mut values);
                field.gradients(points, gradients);
                for (gradient, value) in gradients.iter_mut().zip(values) {
                    *gradient *= value.signum();
                }
            }
            Self::Pair { fields, operation, width } => {
                let [first, second, result] = operation.signs();
                let mut values = [vec![0.0; points.len()], vec![0.0; points.len()]];
                let mut others = vec![DVec3::ZERO; points.len()];
                for (field, values) in fields.iter().zip(&mut values) {
                    field.values(points, values);
                }
                fields[0].gradients(points, gradients);
                fields[1].gradients(points, &mut others);
                for n in 0..points.len() {
                    let share = share_of_second(first * values[0][n], second * values[1][n], width);
                    // A slope that does not count may be none.
                    gradients[n] = result
                        * match share {
                            0.0 => first * gradients[n],
                            1.0 => second * others[n],
                            share => first * gradients[n] * (1.0 - share) + second * others[n] * share,
                        };
                }
            }
        }
    }

    fn range(&self, region: &Region) -> Interval {
        match *self {
            Self::Offset { field, distance } => {
                let Interval { low, high } = field.range(region);
                Interval { low: low - distance, high: high - distance }
            }
            Self::Shell { field, thickness } => {
                let Interval { low, high } = field.range(region);
                let least = if low > 0.0 { low } else { (-high).max(0.0) };
                Interval { low: least - 0.5 * thickness, high: high.max(-low) - 0.5 * thickness }
            }
            Self::Pair { fields, operation, width } => {
                let [first, second, result] = operation.signs();
                let (a, b) =
                    (signed(fields[0].range(region), first), signed(fields[1].range(region), second));
                // The blend takes off a quarter of its width at most.
                let least = Interval { low: a.low.min(b.low) - 0.25 * width, high: a.high.min(b.high) };
                signed(least, result)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::implicit::{PointList, Solid};

    /// Two ways to the same: fields put together, and solids put together.
    #[test]
    fn composites_agree_with_solids() {
        let ball = Solid::Sphere { radius: 1.0 };
        let ring = Solid::Torus { major_radius: 0.9, minor_radius: 0.3 };
        let fields = [ball.field().unwrap(), ring.field().unwrap()];
        let [one, other]: [&dyn Field; 2] = [&fields[0], &fields[1]];
        let parts = || vec![ball.clone(), ring.clone()];
        let mut cases: Vec<(Composite<'_>, Solid)> = vec![
            (
                Composite::Offset { field: one, distance: 0.2 },
                Solid::Offset { solid: Box::new(ball.clone()), distance: 0.2 },
            ),
            (
                Composite::Shell { field: other, thickness: 0.2 },
                Solid::Shell { solid: Box::new(ring.clone()), thickness: 0.2 },
            ),
        ];
        for blend in [0.0, 0.3] {
            let pair = |operation| Composite::Pair { fields: [one, other], operation, width: blend };
            cases.push((pair(Operation::Union), Solid::Union { parts: parts(), blend }));
            cases.push((pair(Operation::Intersection), Solid::Intersection { parts: parts(), blend }));
            let from = Box::new(ball.clone());
            cases.push((
                pair(Operation::Difference),
                Solid::Difference { from, parts: vec![ring.clone()], blend },
            ));
        }
        let place = |n: usize| DVec3::new(0.13, -0.27, 0.41) * (n as f64 - 3.4) + DVec3::new(0.4, 0.1, -0.2);
        let list: PointList = (0..12).map(place).collect();
        for (composite, solid) in cases {
            let field = solid.field().unwrap();
            let (mut values, mut truth) = ([0.0; 12], [0.0; 12]);
            composite.values(list.points(), &mut values);
            field.values(list.points(), &mut truth);
            let (mut gradients, mut slopes) = ([DVec3::ZERO; 12], [DVec3::ZERO; 12]);
            composite.gradients(list.points(), &mut gradients);
            field.gradients(list.points(), &mut slopes);
            for n in 0..12 {
                assert!((values[n] - truth[n]).abs() < 1e-12, "{solid:?}");
                assert!((gradients[n] - slopes[n]).length() < 1e-9, "{solid:?}");
                let range = composite.range(&Region { min: place(n) - 0.1, max: place(n) + 0.1 });
                assert!(range.low <= values[n] && values[n] <= range.high, "{solid:?}");
            }
        }
    }
}
