//! A density on the unit segment that is constant in equal cells.

use super::{DistributionError, Found, MOST_CELLS, accumulate, cell_of, find, mass, position_in};

/// A piecewise constant density on [0, 1], proportional to a table of weights.
#[derive(Clone, Debug)]
pub struct Piecewise1d {
    /// Running sum of the weights; the last is the total.
    cumulative: Box<[f64]>,
}

/// A position and its density.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sampled1d {
    /// In [0, 1).
    pub position: f32,
    /// The cell it lies in.
    pub cell: usize,
    /// Density per length of the unit segment; positive. Divide by the number of cells for the probability of the cell.
    pub pdf: f32,
}

impl Piecewise1d {
    /// A density from the weights of equal cells, at most 2²⁴ of them.
    ///
    /// # Errors
    /// When there are no weights or too many, all are zero, or one is negative, infinite or not a number.
    pub fn new(weights: &[f32]) -> Result<Self, DistributionError> {
        match weights.len() {
            0 => return Err(DistributionError::Empty),
            cells if cells > MOST_CELLS => return Err(DistributionError::TooManyCells { cells }),
            _ => {}
        }
        let mut cumulative = Vec::with_capacity(weights.len());
        if accumulate(weights, 0, &mut cumulative)? == 0.0 {
            return Err(DistributionError::AllZero);
        }
        Ok(Self { cumulative: cumulative.into_boxed_slice() })
    }

    /// Number of cells.
    pub fn cells(&self) -> usize {
        self.cumulative.len()
    }

    /// Integral of the table over the unit segment: the mean weight.
    pub fn integral(&self) -> f64 {
        self.total() / self.cells() as f64
    }

    /// A position with this density; monotone in `u`, which lies in [0, 1).
    pub fn sample(&self, u: f32) -> Sampled1d {
        self.sample_f64(f64::from(u))
    }

    /// The same with all bits of a double, for tables of very unequal weights.
    pub fn sample_f64(&self, u: f64) -> Sampled1d {
        let Found { cell, fraction } = find(&self.cumulative, u);
        Sampled1d { position: position_in(cell, fraction, self.cells()), cell, pdf: self.cell_pdf(cell) }
    }

    /// Density at a position; zero outside [0, 1].
    pub fn pdf(&self, position: f32) -> f32 {
        if (0.0..=1.0).contains(&position) { self.cell_pdf(cell_of(position, self.cells())) } else { 0.0 }
    }

    fn total(&self) -> f64 {
        self.cumulative[self.cells() - 1]
    }

    fn cell_pdf(&self, cell: usize) -> f32 {
        let mass = mass(&self.cumulative, cell);
        // A cell that can be drawn keeps a positive density where single precision ends.
        if mass > 0.0 {
            ((mass / self.total() * self.cells() as f64) as f32).max(f32::MIN_POSITIVE)
        } else {
            0.0
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn follows_its_weights() {
        let table = Piecewise1d::new(&[0.0, 1.0, 0.0, 3.0, 0.0]).unwrap();
        assert_eq!(table.integral(), 0.8);
        assert_eq!(table.sample(0.0), Sampled1d { position: 0.2, cell: 1, pdf: 1.25 });
        assert_eq!(table.sample(0.625), Sampled1d { position: 0.7, cell: 3, pdf: 3.75 });
        assert_eq!([table.pdf(0.1), table.pdf(0.3), table.pdf(1.0), table.pdf(-0.1)], [0.0, 1.25, 0.0, 0.0]);
        assert_eq!(table.pdf(f32::NAN), 0.0);
    }

    #[test]
    fn bad_weights_are_refused() {
        assert_eq!(Piecewise1d::new(&[]).unwrap_err(), DistributionError::Empty);
        assert_eq!(Piecewise1d::new(&[0.0]).unwrap_err(), DistributionError::AllZero);
        let error = Piecewise1d::new(&[1.0, 2.0, -3.0]).unwrap_err();
        assert_eq!(error.to_string(), "weight 2 is -3; weights must be finite and not negative");
    }

    proptest! {
        #[test]
        fn samples_agree_with_pdf(
            weights in prop::collection::vec(prop_oneof![Just(0.0f32), 0.0f32..1.0, Just(1e-38f32), Just(3e38f32)], 1..300),
            us in prop::collection::vec(0.0f32..1.0, 50),
        ) {
            if let Ok(table) = Piecewise1d::new(&weights) {
                for u in us.into_iter().chain([0.0, 1f32.next_down(), 1.0, f32::NAN, -1.0, f32::INFINITY]) {
                    let drawn = table.sample(u);
                    prop_assert!(weights[drawn.cell] > 0.0);
                    prop_assert!(drawn.pdf > 0.0 && drawn.pdf.is_finite());
                    prop_assert!((0.0..1.0).contains(&drawn.position));
                    prop_assert_eq!(drawn.pdf, table.pdf(drawn.position));
                }
                let sum: f64 = (0..weights.len()).map(|cell| f64::from(table.cell_pdf(cell))).sum();
                prop_assert!((sum / weights.len() as f64 - 1.0).abs() < 1e-5);
            }
        }
    }
}
