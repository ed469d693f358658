//! A density on the unit square that is constant in equal cells: environment maps and other pictures.

use super::{DistributionError, Found, MOST_CELLS, accumulate, cell_of, find, mass, position_in};

/// A piecewise constant density on the unit square, proportional to a table of weights.
///
/// Row 0 lies at y in [0, 1/height). A row is drawn first, by its sum, then a cell of it. Only running sums are kept, in
/// double precision: 8 bytes a cell and a row.
#[derive(Clone, Debug)]
pub struct Piecewise2d {
    width: usize,
    height: usize,
    /// Running sums along each row, rows one after another.
    rows: Box<[f64]>,
    /// Running sum of the row sums.
    marginal: Box<[f64]>,
}

/// A point of the unit square and its density.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sampled2d {
    /// In [0, 1)².
    pub position: [f32; 2],
    /// Column and row of the cell it lies in.
    pub cell: [usize; 2],
    /// Density per area of the unit square; positive.
    pub pdf: f32,
}

impl Piecewise2d {
    /// A density from the weights of `width × height` cells, row by row; at most 2²⁴ columns and rows.
    ///
    /// # Errors
    /// When the table is empty or not of that size, all weights are zero, or one is negative, infinite or not a number.
    pub fn new(width: usize, height: usize, weights: &[f32]) -> Result<Self, DistributionError> {
        if width.checked_mul(height) != Some(weights.len()) {
            return Err(DistributionError::WrongSize { width, height, weights: weights.len() });
        }
        if weights.is_empty() {
            return Err(DistributionError::Empty);
        }
        if width.max(height) > MOST_CELLS {
            return Err(DistributionError::TooManyCells { cells: width.max(height) });
        }
        let mut rows = Vec::with_capacity(weights.len());
        let mut marginal = Vec::with_capacity(height);
        let mut total = 0.0f64;
        for (row, weights) in weights.chunks_exact(width).enumerate() {
            let sum = accumulate(weights, row * width, &mut rows)?;
            if sum > 0.0 {
                total = (total + sum).max(total.next_up());
            }
            marginal.push(total);
        }
        if total == 0.0 {
            return Err(DistributionError::AllZero);
        }
        Ok(Self { width, height, rows: rows.into_boxed_slice(), marginal: marginal.into_boxed_slice() })
    }

    /// Columns.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Rows.
    pub fn height(&self) -> usize {
        self.height
    }

    /// Integral of the table over the unit square: the mean weight.
    pub fn integral(&self) -> f64 {
        self.total() / (self.width as f64 * self.height as f64)
    }

    /// A point with this density; `u` in [0, 1)², the second number chooses the row.
    pub fn sample(&self, u: [f32; 2]) -> Sampled2d {
        self.sample_f64(u.map(f64::from))
    }

    /// The same with all bits of doubles, for large tables of very unequal weights.
    pub fn sample_f64(&self, u: [f64; 2]) -> Sampled2d {
        let row = find(&self.marginal, u[1]);
        let Found { cell: column, fraction } = find(self.row(row.cell), u[0]);
        Sampled2d {
            position: [
                position_in(column, fraction, self.width),
                position_in(row.cell, row.fraction, self.height),
            ],
            cell: [column, row.cell],
            pdf: self.cell_pdf(column, row.cell),
        }
    }

    /// Density at a point; zero outside the unit square.
    pub fn pdf(&self, position: [f32; 2]) -> f32 {
        if position.iter().all(|coordinate| (0.0..=1.0).contains(coordinate)) {
            self.cell_pdf(cell_of(position[0], self.width), cell_of(position[1], self.height))
        } else {
            0.0
        }
    }

    fn row(&self, row: usize) -> &[f64] {
        &self.rows[row * self.width..(row + 1) * self.width]
    }

    fn total(&self) -> f64 {
        self.marginal[self.height - 1]
    }

    /// The density that [`sample`](Self::sample) has: that of the row times that of the cell in it.
    fn cell_pdf(&self, column: usize, row: usize) -> f32 {
        let sums = self.row(row);
        let cell_mass = mass(sums, column);
        if cell_mass > 0.0 {
            let in_row = cell_mass / sums[self.width - 1] * self.width as f64;
            let of_row = mass(&self.marginal, row) / self.total() * self.height as f64;
            ((in_row * of_row) as f32).max(f32::MIN_POSITIVE)
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
        let table = Piecewise2d::new(2, 2, &[1.0, 0.0, 3.0, 4.0]).unwrap();
        assert_eq!(table.integral(), 2.0);
        assert_eq!(table.sample([0.5, 0.0]), Sampled2d { position: [0.25, 0.0], cell: [0, 0], pdf: 0.5 });
        let drawn = table.sample([0.75, 0.5]);
        assert_eq!((drawn.cell, drawn.pdf), ([1, 1], 2.0));
        assert_eq!(table.pdf([0.75, 0.25]), 0.0);
        assert_eq!(table.pdf([1.0, 1.0]), 2.0);
        assert_eq!(table.pdf([1.5, 0.0]), 0.0);
    }

    #[test]
    fn bad_tables_are_refused() {
        use DistributionError::*;
        assert_eq!(Piecewise2d::new(0, 5, &[]).unwrap_err(), Empty);
        assert_eq!(Piecewise2d::new(2, 1, &[0.0; 2]).unwrap_err(), AllZero);
        assert_eq!(
            Piecewise2d::new(usize::MAX, 2, &[0.0; 2]).unwrap_err(),
            WrongSize { width: usize::MAX, height: 2, weights: 2 }
        );
        let error = Piecewise2d::new(2, 2, &[1.0, 1.0, 1.0, f32::INFINITY]).unwrap_err();
        assert_eq!(error, BadWeight { index: 3, value: f32::INFINITY });
    }

    #[test]
    fn a_large_map_with_a_sun_keeps_its_dim_cells() {
        // 2048 × 1024 cells of 1e-3 and one of 1e9: all have a positive density, and densities integrate to one.
        let (width, height) = (2048, 1024);
        let mut weights = vec![1e-3f32; width * height];
        weights[700 * width + 33] = 1e9;
        let table = Piecewise2d::new(width, height, &weights).unwrap();
        let mut sum = 0.0;
        for row in 0..height {
            for column in 0..width {
                let pdf = table.cell_pdf(column, row);
                assert!(pdf > 0.0);
                sum += f64::from(pdf) / (width * height) as f64;
            }
        }
        assert!((sum - 1.0).abs() < 1e-6, "{sum}");
        assert_eq!(table.sample([0.5, 0.5]).cell, [33, 700]);
    }

    proptest! {
        #[test]
        fn samples_agree_with_pdf(
            width in 1usize..12, height in 1usize..12,
            pool in prop::collection::vec(prop_oneof![Just(0.0f32), Just(0.0f32), 0.0f32..1.0, Just(1e-38f32), Just(3e38f32)], 144),
            us in prop::collection::vec([0.0f32..1.0, 0.0f32..1.0], 30),
        ) {
            let weights = &pool[..width * height];
            if let Ok(table) = Piecewise2d::new(width, height, weights) {
                for u in us.into_iter().chain([[0.0, 0.0], [1.0, 1.0]]) {
                    let drawn = table.sample(u);
                    prop_assert!(weights[drawn.cell[1] * width + drawn.cell[0]] > 0.0);
                    prop_assert!(drawn.pdf > 0.0);
                    prop_assert_eq!(drawn.pdf, table.pdf(drawn.position));
                    prop_assert!(drawn.position.iter().all(|x| (0.0..1.0).contains(x)));
                }
            }
        }
    }
}
