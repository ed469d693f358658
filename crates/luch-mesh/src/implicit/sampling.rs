//! From a field to samples; where intervals prove that the surface is absent nothing is evaluated.

use glam::DVec3;
use rayon::prelude::*;

use super::field::{Field, PointList, Region};
use super::{Grid, ImplicitError, MOST_SAMPLES};

/// Cells along the side of a block, the least part that an interval is asked about.
const BLOCK: usize = 8;

/// Where and how finely a field is sampled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sampling {
    /// The box that is looked at.
    pub region: Region,
    /// Cells along its longest side; along the others as many as make the cells nearest to cubes.
    pub resolution: u32,
    /// Whether the surface is closed where it meets the side of the box.
    pub closed: bool,
}

impl Sampling {
    /// An empty grid over the region: the same number of cells as asked for, at least one along each axis.
    fn lattice(&self) -> Result<Lattice, ImplicitError> {
        let Region { min, max } = self.region;
        let size = self.region.size();
        let resolution = f64::from(self.resolution.max(1));
        let cells = (size / size.max_element() * resolution).round().max(DVec3::ONE);
        let spacing = size / cells;
        let samples = (cells + 3.0).element_product();
        if samples > MOST_SAMPLES as f64 {
            return Err(ImplicitError::TooManySamples { samples, most: MOST_SAMPLES });
        }
        // Positions become single precision in the end.
        let reach = min.abs().max(max.abs()).max_element();
        let sound = spacing.cmpgt(DVec3::splat(reach * f64::from(f32::EPSILON))).all()
            && reach <= f64::from(f32::MAX)
            && size.min_element() > 0.0;
        if !sound {
            return Err(ImplicitError::Region { min, max });
        }
        Ok(Lattice { origin: min, spacing, cells: [0, 1, 2].map(|axis| cells[axis] as usize) })
    }
}

/// The samples of a field.
///
/// Points go to the field by blocks of a few hundred.
pub fn sample(field: &dyn Field, sampling: &Sampling) -> Result<Grid, ImplicitError> {
    let lattice = sampling.lattice()?;
    let blocks = Blocks::all_evaluated(&lattice);
    let grid = blocks.fill(field, &lattice)?;
    if sampling.closed { grid.closed() } else { Ok(grid) }
}

/// The samples of all cells that the surface may run through; elsewhere infinities of the right sign.
pub(super) fn sample_near_surface(field: &dyn Field, sampling: &Sampling) -> Result<Grid, ImplicitError> {
    let lattice = sampling.lattice()?;
    let blocks = Blocks::near_surface(field, &lattice);
    let grid = blocks.fill(field, &lattice)?;
    if sampling.closed { grid.closed() } else { Ok(grid) }
}

/// The samples before they have values.
struct Lattice {
    origin: DVec3,
    spacing: DVec3,
    cells: [usize; 3],
}

impl Lattice {
    fn coordinate(&self, axis: usize, sample: usize) -> f64 {
        self.origin[axis] + self.spacing[axis] * sample as f64
    }

    fn position(&self, sample: [usize; 3]) -> DVec3 {
        DVec3::from([0, 1, 2].map(|axis| self.coordinate(axis, sample[axis])))
    }
}

/// What is known about a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Mark {
    Evaluate,
    Inside,
    Outside,
}

/// The lattice in blocks.
struct Blocks {
    counts: [usize; 3],
    marks: Vec<Mark>,
}

/// A cube of blocks about which one thing is known.
struct Leaf {
    first: [usize; 3],
    side: usize,
    mark: Mark,
}

impl Blocks {
    fn all_evaluated(lattice: &Lattice) -> Self {
        let counts = lattice.cells.map(|cells| cells.div_ceil(BLOCK));
        Self { counts, marks: vec![Mark::Evaluate; counts.iter().product()] }
    }

    /// Descends an octree of blocks.
    fn near_surface(field: &dyn Field, lattice: &Lattice) -> Self {
        let mut blocks = Self::all_evaluated(lattice);
        let longest = blocks.counts.into_iter().max().unwrap_or(1);
        for leaf in blocks.descend(field, lattice, [0; 3], longest.next_power_of_two()) {
            let last = [0, 1, 2].map(|axis| (leaf.first[axis] + leaf.side).min(blocks.counts[axis]));
            for z in leaf.first[2]..last[2] {
                for y in leaf.first[1]..last[1] {
                    let start = (z * blocks.counts[1] + y) * blocks.counts[0];
                    blocks.marks[start + leaf.first[0]..start + last[0]].fill(leaf.mark);
                }
            }
        }
        blocks
    }

    fn descend(&self, field: &dyn Field, lattice: &Lattice, first: [usize; 3], side: usize) -> Vec<Leaf> {
        if (0..3).any(|axis| first[axis] >= self.counts[axis]) {
            return Vec::new();
        }
        let last = [0, 1, 2].map(|axis| ((first[axis] + side) * BLOCK).min(lattice.cells[axis]));
        let region =
            Region { min: lattice.position(first.map(|block| block * BLOCK)), max: lattice.position(last) };
        let range = field.range(&region);
        if range.low > 0.0 {
            return vec![Leaf { first, side, mark: Mark::Outside }];
        }
        if range.high < 0.0 {
            return vec![Leaf { first, side, mark: Mark::Inside }];
        }
        if side == 1 {
            return Vec::new();
        }
        let half = side / 2;
        let child = |n: usize| {
            let first = [0, 1, 2].map(|axis| first[axis] + (n >> axis & 1) * half);
            self.descend(field, lattice, first, half)
        };
        if side >= 4 {
            (0..8).into_par_iter().flat_map_iter(child).collect()
        } else {
            (0..8).flat_map(child).collect()
        }
    }

    /// What is known about the samples of a block; those past the last cells belong to its last block.
    fn mark(&self, block: [usize; 3]) -> Mark {
        let [x, y, z] = [0, 1, 2].map(|axis| block[axis].min(self.counts[axis] - 1));
        self.marks[(z * self.counts[1] + y) * self.counts[0] + x]
    }

    fn fill(&self, field: &dyn Field, lattice: &Lattice) -> Result<Grid, ImplicitError> {
        let counts = lattice.cells.map(|cells| cells + 1);
        let mut values = vec![f32::INFINITY; counts.iter().product()];
        values.par_chunks_mut(counts[0] * counts[1] * BLOCK).enumerate().for_each(|(z, slab)| {
            let mut filler =
                Filler { field, lattice, counts, z, slab, points: PointList::default(), values: Vec::new() };
            for y in 0..counts[1].div_ceil(BLOCK) {
                for x in 0..counts[0].div_ceil(BLOCK) {
                    self.fill_block([x, y, z], &mut filler);
                }
            }
        });
        let mut grid = Grid::new(counts, values)?;
        grid.origin = lattice.origin;
        grid.spacing = lattice.spacing;
        Ok(grid)
    }

    fn fill_block(&self, block: [usize; 3], filler: &mut Filler<'_>) {
        let mark = self.mark(block);
        if mark == Mark::Evaluate {
            filler.evaluate(block, [BLOCK; 3]);
            return;
        }
        if mark == Mark::Inside {
            filler.set_inside(block);
        }
        // The cells of evaluated blocks before this one end at its first samples.
        for towards in 1..8 {
            let on_side = [0, 1, 2].map(|axis| towards >> axis & 1);
            if (0..3).any(|axis| block[axis] < on_side[axis]) {
                continue;
            }
            if self.mark([0, 1, 2].map(|axis| block[axis] - on_side[axis])) == Mark::Evaluate {
                filler.evaluate(block, on_side.map(|on_side| if on_side == 1 { 1 } else { BLOCK }));
            }
        }
    }
}

/// Puts values into a slab of blocks.
struct Filler<'a> {
    field: &'a dyn Field,
    lattice: &'a Lattice,
    counts: [usize; 3],
    /// The slab.
    z: usize,
    slab: &'a mut [f32],
    points: PointList,
    values: Vec<f64>,
}

impl Filler<'_> {
    /// Calls with the first sample of each row of a part of a block, its place in the slab and its length.
    fn rows(&self, block: [usize; 3], extent: [usize; 3]) -> Vec<Row> {
        let first = block.map(|block| block * BLOCK);
        let last = [0, 1, 2].map(|axis| (first[axis] + extent[axis]).min(self.counts[axis]));
        let mut rows = Vec::with_capacity(BLOCK * BLOCK);
        for z in first[2]..last[2] {
            for y in first[1]..last[1] {
                let place = ((z - self.z * BLOCK) * self.counts[1] + y) * self.counts[0] + first[0];
                rows.push(Row { start: [first[0], y, z], place, length: last[0] - first[0] });
            }
        }
        rows
    }

    fn evaluate(&mut self, block: [usize; 3], extent: [usize; 3]) {
        let rows = self.rows(block, extent);
        self.points.clear();
        for row in &rows {
            let [x, y, z] = row.start;
            for n in 0..row.length {
                self.points.push(self.lattice.position([x + n, y, z]));
            }
        }
        let points = self.points.points();
        self.values.resize(points.len(), 0.0);
        self.field.values(points, &mut self.values);
        let mut next = self.values.iter();
        for row in &rows {
            for (value, &found) in self.slab[row.place..row.place + row.length].iter_mut().zip(&mut next) {
                *value = found as f32;
            }
        }
    }

    fn set_inside(&mut self, block: [usize; 3]) {
        for row in self.rows(block, [BLOCK; 3]) {
            self.slab[row.place..row.place + row.length].fill(f32::NEG_INFINITY);
        }
    }
}

/// Samples side by side.
struct Row {
    start: [usize; 3],
    place: usize,
    length: usize,
}
