//! Free-form deformation (Sederberg and Parry, "Free-Form Deformation of Solid Geometric Models", 1986).

use glam::DVec3;

use super::EditError;

/// A box of control points; space in the box moves with them, by Bernstein polynomials.
#[derive(Clone, Debug, PartialEq)]
pub struct Lattice {
    low: DVec3,
    high: DVec3,
    counts: [usize; 3],
    /// How far each control point is from its place in the box: x fastest, then y, then z.
    offsets: Vec<DVec3>,
}

/// The most control points along one axis: polynomials of higher degree hardly move with their points.
const MOST_POINTS: u32 = 16;

impl Lattice {
    /// A box that is divided evenly, with so many points along each axis, of which none has moved.
    pub fn new(low: DVec3, high: DVec3, counts: [u32; 3]) -> Result<Self, EditError> {
        if counts.iter().any(|count| !(2..=MOST_POINTS).contains(count)) {
            return Err(EditError::OutOfRange { name: "points along each axis", range: "from 2 to 16" });
        }
        let counts = counts.map(|count| count as usize);
        Ok(Self { low, high, counts, offsets: vec![DVec3::ZERO; counts.iter().product()] })
    }

    /// Moves the control point of this number along each axis by metres.
    pub fn move_point(&mut self, point: [u32; 3], way: DVec3) -> Result<(), EditError> {
        let [x, y, z] = point.map(|number| number as usize);
        let [nx, ny, nz] = self.counts;
        if x >= nx || y >= ny || z >= nz {
            return Err(EditError::OutOfRange { name: "a control point", range: "within the lattice" });
        }
        self.offsets[x + nx * (y + ny * z)] += way;
        Ok(())
    }

    /// Where a point goes; outside the box it moves as the nearest point of the box does.
    pub fn map(&self, point: DVec3) -> DVec3 {
        let size = self.high - self.low;
        let share = |axis: usize| {
            if size[axis] > 0.0 { ((point[axis] - self.low[axis]) / size[axis]).clamp(0.0, 1.0) } else { 0.0 }
        };
        let [x, y, z] = [0, 1, 2].map(|axis| bernstein(self.counts[axis] - 1, share(axis)));
        let mut way = DVec3::ZERO;
        let mut offsets = self.offsets.iter();
        for wz in &z {
            for wy in &y {
                for (wx, offset) in x.iter().zip(&mut offsets) {
                    way += *offset * (wx * wy * wz);
                }
            }
        }
        point + way
    }
}

/// All Bernstein polynomials of a degree at a place, by de Casteljau's triangle.
fn bernstein(degree: usize, t: f64) -> Vec<f64> {
    let mut values = vec![1.0];
    for _ in 0..degree {
        let mut next = vec![0.0; values.len() + 1];
        for (i, value) in values.iter().enumerate() {
            next[i] += value * (1.0 - t);
            next[i + 1] += value * t;
        }
        values = next;
    }
    values
}
