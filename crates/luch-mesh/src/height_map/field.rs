//! Heights over a grid.

use glam::{Vec2, Vec3};
use serde::{Deserialize, Serialize};

/// The most points of a field: 2²⁵, so that a sheet has less than 2²⁶ triangles.
pub const MAX_POINTS: u64 = 1 << 25;

/// Why a height field cannot be.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum HeightError {
    /// Too few or too many points.
    #[error(
        "the field has {width} × {height} points, expected at least 2 × 2 and at most {MAX_POINTS} in all"
    )]
    Size {
        /// Points in a row.
        width: u32,
        /// Rows.
        height: u32,
    },
    /// The list of heights does not fit.
    #[error("there are {found} heights for {expected} points")]
    Count {
        /// How many heights there are.
        found: usize,
        /// How many points there are.
        expected: usize,
    },
    /// A part that does not lie in the field.
    #[error(
        "the part of {width} × {height} points from column {column}, row {row} does not lie in the field"
    )]
    Crop {
        /// First column.
        column: u32,
        /// First row.
        row: u32,
        /// Columns.
        width: u32,
        /// Rows.
        height: u32,
    },
    /// A base that is not below the surface.
    #[error("the base at {base} m is not below the lowest point at {lowest} m")]
    Base {
        /// Where the floor should be.
        base: f32,
        /// The lowest height.
        lowest: f32,
    },
    /// A measure that is not sensible.
    #[error("{what} is {value}, expected {expected}")]
    Number {
        /// Which.
        what: &'static str,
        /// What was given.
        value: f64,
        /// What is accepted.
        expected: &'static str,
    },
}

/// Heights at the points of a grid in the xz plane around the origin, up along +Y.
///
/// The surface is made of two flat triangles for each cell of four points; their common edge runs from the lower left to the
/// upper right corner of the cell as the image lies, which is from (−x, +z) to (+x, −z). So the field and its sheet are the
/// same surface, and a ray can be met with either. A height that is not a number is a hole: the triangles at it are missing.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct HeightField {
    /// Points in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// The heights in metres, row by row; the first row lies at −z and is the upper row of the image.
    pub heights: Vec<f32>,
    /// Extent along x and z, from the first to the last point, in metres.
    pub size: Vec2,
}

impl HeightField {
    /// A field of checked size.
    ///
    /// # Errors
    /// If there are less than 2 × 2 or too many points, the list of heights has another length, or the size is not positive.
    pub fn new(width: u32, height: u32, heights: Vec<f32>, size: Vec2) -> Result<Self, HeightError> {
        let field = Self { width, height, heights, size };
        field.check()?;
        Ok(field)
    }

    /// What [`HeightField::new`] promises, for fields that were made otherwise.
    ///
    /// # Errors
    /// As for [`HeightField::new`].
    pub fn check(&self) -> Result<(), HeightError> {
        let Self { width, height, .. } = *self;
        let count = u64::from(width) * u64::from(height);
        if width < 2 || height < 2 || count > MAX_POINTS {
            return Err(HeightError::Size { width, height });
        }
        if self.heights.len() as u64 != count {
            return Err(HeightError::Count { found: self.heights.len(), expected: count as usize });
        }
        for side in self.size.to_array() {
            if !(side > 0.0 && side.is_finite()) {
                let expected = "a number above 0";
                return Err(HeightError::Number { what: "the size", value: f64::from(side), expected });
            }
        }
        Ok(())
    }

    /// The extent of an image of this many points whose longer side is `longer`.
    pub fn fitting_size(width: u32, height: u32, longer: f32) -> Vec2 {
        let cells = Vec2::new(width.saturating_sub(1) as f32, height.saturating_sub(1) as f32);
        cells * (longer / cells.max_element().max(1.0))
    }

    /// The height at a point, if it is not a hole.
    pub fn at(&self, column: u32, row: u32) -> Option<f32> {
        Some(self.heights[self.index(column, row)]).filter(|height| height.is_finite())
    }

    pub(super) fn index(&self, column: u32, row: u32) -> usize {
        row as usize * self.width as usize + column as usize
    }

    /// The place of a point; a hole lies at height 0.
    pub fn place(&self, column: u32, row: u32) -> Vec3 {
        let across = column as f32 / (self.width - 1) as f32 - 0.5;
        let down = row as f32 / (self.height - 1) as f32 - 0.5;
        Vec3::new(across * self.size.x, self.at(column, row).unwrap_or(0.0), down * self.size.y)
    }

    /// The height of the surface over any point of the xz plane; `None` outside and in holes.
    pub fn height_at(&self, x: f32, z: f32) -> Option<f32> {
        let column = (f64::from(x) / f64::from(self.size.x) + 0.5) * f64::from(self.width - 1);
        let row = (f64::from(z) / f64::from(self.size.y) + 0.5) * f64::from(self.height - 1);
        let inside = |t: f64, count: u32| (0.0..=f64::from(count - 1)).contains(&t);
        if !inside(column, self.width) || !inside(row, self.height) {
            return None;
        }
        let cell = [(column as u32).min(self.width - 2), (row as u32).min(self.height - 2)];
        let (s, t) = (column - f64::from(cell[0]), row - f64::from(cell[1]));
        let corner = |i: u32, j: u32| self.at(cell[0] + i, cell[1] + j).map(f64::from);
        let (low, high) = (corner(0, 1)?, corner(1, 0)?);
        // On the diagonal s + t = 1; above it lies the upper left corner, below it the lower right one.
        let height = if s + t <= 1.0 {
            let upper_left = corner(0, 0)?;
            upper_left + (high - upper_left) * s + (low - upper_left) * t
        } else {
            let lower_right = corner(1, 1)?;
            lower_right + (low - lower_right) * (1.0 - s) + (high - lower_right) * (1.0 - t)
        };
        Some(height as f32)
    }

    /// The lowest and the highest height; `None` if there are only holes.
    pub fn range(&self) -> Option<[f32; 2]> {
        let known = self.heights.iter().copied().filter(|height| height.is_finite());
        known.fold(None, |range, height| match range {
            None => Some([height; 2]),
            Some([low, high]) => Some([height.min(low), height.max(high)]),
        })
    }

    /// How many points are holes.
    pub fn hole_count(&self) -> usize {
        self.heights.iter().filter(|height| !height.is_finite()).count()
    }

    /// The upward normal at a point, from the differences to its neighbours; holes count as level with the point.
    pub fn normal(&self, column: u32, row: u32) -> Vec3 {
        let here = self.at(column, row).unwrap_or(0.0);
        let slope = |before: Option<f32>, after: Option<f32>, step: f32| {
            let (low, high) = (before.unwrap_or(here), after.unwrap_or(here));
            let steps = u8::from(before.is_some()) + u8::from(after.is_some());
            // In double precision: differences of large heights must not overflow.
            if steps == 0 {
                0.0
            } else {
                (f64::from(high) - f64::from(low)) / (f64::from(steps) * f64::from(step))
            }
        };
        let [step_x, step_z] =
            [self.size.x / (self.width - 1) as f32, self.size.y / (self.height - 1) as f32];
        let beside = |column: Option<u32>, row: Option<u32>| {
            let (column, row) = (column.filter(|c| *c < self.width)?, row.filter(|r| *r < self.height)?);
            self.at(column, row)
        };
        let across =
            slope(beside(column.checked_sub(1), Some(row)), beside(column.checked_add(1), Some(row)), step_x);
        let down =
            slope(beside(Some(column), row.checked_sub(1)), beside(Some(column), row.checked_add(1)), step_z);
        let normal = glam::DVec3::new(-across, 1.0, -down).try_normalize();
        normal.map_or(Vec3::Y, |normal| normal.as_vec3())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn heights_between_points_lie_on_two_triangles() {
        // Upper left 1, upper right 2, lower left 4, lower right 16.
        let field = HeightField::new(2, 2, vec![1.0, 2.0, 4.0, 16.0], Vec2::new(2.0, 4.0)).unwrap();
        assert_eq!(field.height_at(-1.0, -2.0), Some(1.0));
        assert_eq!(field.height_at(1.0, 2.0), Some(16.0));
        // The diagonal joins 4 and 2.
        assert_eq!(field.height_at(0.0, 0.0), Some(3.0));
        assert_eq!(field.height_at(-0.5, -1.0), Some(2.0));
        assert_eq!(field.height_at(0.5, 1.0), Some(9.5));
        assert_eq!((field.height_at(1.1, 0.0), field.height_at(f32::NAN, 0.0)), (None, None));
        let holed = HeightField { heights: vec![f32::NAN, 2.0, 4.0, 16.0], ..field };
        assert_eq!((holed.height_at(-0.5, -1.0), holed.height_at(0.5, 1.0)), (None, Some(9.5)));
        assert_eq!((holed.range(), holed.hole_count()), (Some([2.0, 16.0]), 1));
    }

    #[test]
    fn a_slope_has_its_normal_everywhere() {
        let heights = (0..12).map(|k| (k % 4) as f32 * 0.5 - (k / 4) as f32 * 0.25).collect();
        let field = HeightField::new(4, 3, heights, Vec2::new(3.0, 2.0)).unwrap();
        let truth = Vec3::new(-0.5, 1.0, 0.25).normalize();
        for row in 0..3 {
            for column in 0..4 {
                assert!(field.normal(column, row).distance(truth) < 1e-6);
            }
        }
    }

    #[test]
    fn senseless_fields_are_refused() {
        let new = |w, h, count, x| HeightField::new(w, h, vec![0.0; count], Vec2::new(x, 1.0)).is_err();
        assert!(new(1, 5, 5, 1.0) && new(2, 2, 3, 1.0) && new(2, 2, 4, 0.0) && new(2, 2, 4, f32::NAN));
        assert!(HeightField::new(u32::MAX, u32::MAX, Vec::new(), Vec2::ONE).is_err());
    }
}
