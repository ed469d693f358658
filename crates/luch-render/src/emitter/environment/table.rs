//! A density on the unit square that is constant in equal cells, drawn from in constant time.

/// Running sums of a row of weights with a guide: for each of as many equal parts of [0, 1) the first cell that reaches into it
/// (Chen and Asau 1974). Even numbers stay even, which an alias table would not keep.
#[derive(Debug)]
pub(super) struct Row {
    /// Shares of the total up to the end of each cell; the last is one.
    ends: Box<[f32]>,
    /// One more than there are cells.
    guide: Box<[u32]>,
}

/// A cell and a place in it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Drawn {
    pub(super) cell: usize,
    /// In [0, 1).
    pub(super) fraction: f32,
    /// Probability of the cell; positive.
    pub(super) probability: f32,
}

impl Row {
    /// A row of weights that are finite and not negative; `None` if all are zero.
    pub(super) fn new(weights: impl ExactSizeIterator<Item = f64> + Clone) -> Option<Self> {
        let total: f64 = weights.clone().sum();
        if !(total > 0.0 && total.is_finite()) {
            return None;
        }
        let mut sum = 0.0;
        let mut ends: Box<[f32]> = weights
            .map(|weight| {
                sum += weight;
                ((sum / total) as f32).min(1.0)
            })
            .collect();
        // Rounding must leave nothing past the last cell that has a weight.
        let last = ends.iter().rposition(|&end| end < ends[ends.len() - 1]).map_or(0, |before| before + 1);
        ends[last..].fill(1.0);
        let cells = ends.len();
        let mut cell = 0;
        let guide = (0..=cells)
            .map(|part| {
                let start = part as f32 / cells as f32;
                while cell + 1 < cells && ends[cell] <= start {
                    cell += 1;
                }
                cell as u32
            })
            .collect();
        Some(Self { ends, guide })
    }

    /// Share of the total before a cell.
    fn start(&self, cell: usize) -> f32 {
        if cell == 0 { 0.0 } else { self.ends[cell - 1] }
    }

    /// The chance of a cell.
    pub(super) fn probability(&self, cell: usize) -> f32 {
        self.ends[cell] - self.start(cell)
    }

    /// The cell that holds the share `u` in [0, 1); never one without a chance.
    pub(super) fn draw(&self, u: f32) -> Drawn {
        let u = u.clamp(0.0, 1f32.next_down());
        let part = ((u * self.ends.len() as f32) as usize).min(self.ends.len() - 1);
        // Rounding may have put the number into the part after its own.
        let low = self.guide[part.saturating_sub(1)] as usize;
        let high = self.guide[part + 1] as usize;
        let cell = low + self.ends[low..high].partition_point(|&end| end <= u);
        let (start, probability) = (self.start(cell), self.probability(cell));
        let fraction = ((u - start) / probability).clamp(0.0, 1f32.next_down());
        Drawn { cell, fraction, probability }
    }
}

/// A table of rows, and a row of their sums.
#[derive(Debug)]
pub(super) struct Table {
    rows: Vec<Option<Row>>,
    sums: Row,
    width: usize,
}

/// A place of the unit square and its density.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Place {
    pub(super) position: [f32; 2],
    /// Per area of the unit square; positive.
    pub(super) pdf: f32,
}

impl Table {
    /// A table of rows of `width` weights each; `None` if all are zero.
    pub(super) fn new(width: usize, weights: &[f32]) -> Option<Self> {
        let rows = || weights.chunks_exact(width).map(|row| row.iter().map(|&weight| f64::from(weight)));
        let sums: Vec<f64> = rows().map(Iterator::sum).collect();
        let sums = Row::new(sums.iter().copied())?;
        Some(Self { rows: rows().map(Row::new).collect(), sums, width })
    }

    /// A place with this density; the second number chooses the row.
    pub(super) fn draw(&self, u: [f32; 2]) -> Option<Place> {
        let row = self.sums.draw(u[1]);
        let column = self.rows[row.cell].as_ref()?.draw(u[0]);
        let cells = [self.width as f32, self.rows.len() as f32];
        let position =
            [(column.cell as f32 + column.fraction) / cells[0], (row.cell as f32 + row.fraction) / cells[1]];
        Some(Place { position, pdf: column.probability * row.probability * (cells[0] * cells[1]) })
    }

    /// The density at a place of the unit square.
    pub(super) fn pdf(&self, position: [f32; 2]) -> f32 {
        let cells = [self.width, self.rows.len()];
        let [column, row] = [0, 1].map(|i| ((position[i] * cells[i] as f32) as usize).min(cells[i] - 1));
        let in_row = self.rows[row].as_ref().map_or(0.0, |r| r.probability(column));
        in_row * self.sums.probability(row) * (cells[0] as f32 * cells[1] as f32)
    }
}
