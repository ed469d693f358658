//! Changes of heights: blur, scale, crop, holes.

use super::{HeightError, HeightField};

impl HeightField {
    /// Each height becomes `height · scale + offset`; what overflows becomes a hole.
    pub fn scaled(mut self, scale: f64, offset: f64) -> Self {
        for height in &mut self.heights {
            let value = (f64::from(*height) * scale + offset) as f32;
            *height = if value.is_finite() { value } else { f32::NAN };
        }
        self
    }

    /// Turned upside down: the lowest becomes the highest.
    pub fn inverted(mut self) -> Self {
        if let Some([low, high]) = self.range() {
            for height in &mut self.heights {
                *height = ((f64::from(low) + f64::from(high)) - f64::from(*height)) as f32;
            }
        }
        self
    }

    /// Smoothed by a Gaussian of standard deviation `sigma`, in points, row by row and then column by column.
    ///
    /// At the border the field goes on as its mirror image, the outermost points twice, so a field without holes keeps its
    /// mean. Holes stay holes and take no part: the weights of the others are raised to sum to one.
    ///
    /// # Errors
    /// If `sigma` is not 0 to 1000.
    pub fn blurred(mut self, sigma: f64) -> Result<Self, HeightError> {
        if !(0.0..=1000.0).contains(&sigma) {
            return Err(HeightError::Number { what: "the blur", value: sigma, expected: "0 to 1000 points" });
        }
        if sigma == 0.0 {
            return Ok(self);
        }
        // Beyond four deviations lie 6 parts in 100 000.
        let reach = (4.0 * sigma).ceil() as i64;
        let mut weights: Vec<f64> =
            (-reach..=reach).map(|k| libm::exp(-0.5 * (k as f64 / sigma) * (k as f64 / sigma))).collect();
        let sum: f64 = weights.iter().sum();
        weights.iter_mut().for_each(|weight| *weight /= sum);
        let (width, height) = (self.width as usize, self.height as usize);
        // A hole's weight is 0; both weights and weighted heights are blurred.
        let mut known: Vec<f64> = self.heights.iter().map(|h| f64::from(u8::from(h.is_finite()))).collect();
        let mut sums: Vec<f64> =
            self.heights.iter().map(|h| if h.is_finite() { f64::from(*h) } else { 0.0 }).collect();
        for list in [&mut known, &mut sums] {
            blur_lines(list, &weights, Lines { count: height, length: width, step: 1, next: width });
            blur_lines(list, &weights, Lines { count: width, length: height, step: width, next: 1 });
        }
        for (height, (sum, weight)) in self.heights.iter_mut().zip(sums.into_iter().zip(known)) {
            if height.is_finite() {
                *height = (sum / weight) as f32;
            }
        }
        Ok(self)
    }

    /// A part of the field; points keep their distances.
    ///
    /// # Errors
    /// If the part does not lie in the field or has less than 2 × 2 points.
    pub fn cropped(&self, column: u32, row: u32, width: u32, height: u32) -> Result<Self, HeightError> {
        let fits = |from: u32, count: u32, all: u32| u64::from(from) + u64::from(count) <= u64::from(all);
        if !fits(column, width, self.width) || !fits(row, height, self.height) {
            return Err(HeightError::Crop { column, row, width, height });
        }
        let heights = (row..row + height).flat_map(|row| {
            let start = self.index(column, row);
            self.heights[start..start + width as usize].iter().copied()
        });
        let cells = |count: u32, all: u32| count.saturating_sub(1) as f32 / (all - 1) as f32;
        let size = self.size * glam::Vec2::new(cells(width, self.width), cells(height, self.height));
        if width < 2 || height < 2 {
            return Err(HeightError::Size { width, height });
        }
        Self::new(width, height, heights.collect(), size)
    }

    /// A field in which every point of this one is a cell: one point more each way, at each the mean of the cells around it.
    ///
    /// # Errors
    /// If that would be too many points.
    pub fn cells(&self) -> Result<Self, HeightError> {
        let (width, height) = (self.width.saturating_add(1), self.height.saturating_add(1));
        if u64::from(width) * u64::from(height) > super::MAX_POINTS {
            return Err(HeightError::Size { width, height });
        }
        let mean = |column: u32, row: u32| {
            let columns = column.saturating_sub(1)..=column.min(self.width - 1);
            let rows = row.saturating_sub(1)..=row.min(self.height - 1);
            let known = rows.flat_map(|row| columns.clone().filter_map(move |column| self.at(column, row)));
            let (sum, count) = known.fold((0.0, 0u32), |(sum, count), h| (sum + f64::from(h), count + 1));
            if count == 0 { f32::NAN } else { (sum / f64::from(count)) as f32 }
        };
        let heights = (0..height).flat_map(|row| (0..width).map(move |column| mean(column, row))).collect();
        let wider = |count: u32| count as f32 / (count - 1) as f32;
        Self::new(width, height, heights, self.size * glam::Vec2::new(wider(self.width), wider(self.height)))
    }

    /// With all holes at one height.
    pub fn filled(mut self, height: f32) -> Self {
        self.heights.iter_mut().filter(|h| !h.is_finite()).for_each(|h| *h = height);
        self
    }
}

/// Lines in a list: `count` of them, each `length` values `step` apart, starting `next` apart.
#[derive(Clone, Copy)]
struct Lines {
    count: usize,
    length: usize,
    step: usize,
    next: usize,
}

fn blur_lines(list: &mut [f64], weights: &[f64], lines: Lines) {
    let reach = (weights.len() / 2) as i64;
    let length = lines.length as i64;
    let mut line = vec![0.0; lines.length];
    for number in 0..lines.count {
        let start = number * lines.next;
        for (k, value) in line.iter_mut().enumerate() {
            *value = list[start + k * lines.step];
        }
        for k in 0..length {
            let term = |(j, weight): (usize, &f64)| {
                // Mirrored at both ends, as often as it takes.
                let place = (k + j as i64 - reach).rem_euclid(2 * length);
                weight * line[if place < length { place } else { 2 * length - 1 - place } as usize]
            };
            list[start + k as usize * lines.step] = weights.iter().enumerate().map(term).sum();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec2;

    fn odd(width: u32, height: u32) -> HeightField {
        let noise =
            |k: u32| luch_sampling::hash::unit_f32((luch_sampling::hash::word(3, u64::from(k)) >> 32) as u32);
        HeightField::new(width, height, (0..width * height).map(noise).collect(), Vec2::ONE).unwrap()
    }

    fn mean(field: &HeightField) -> f64 {
        field.heights.iter().map(|h| f64::from(*h)).sum::<f64>() / field.heights.len() as f64
    }

    #[test]
    fn blur_keeps_the_mean_and_flattens() {
        for sigma in [0.3, 1.0, 2.5, 40.0] {
            let field = odd(23, 11);
            let blurred = field.clone().blurred(sigma).unwrap();
            // Each height is rounded to f32.
            assert!((mean(&blurred) - mean(&field)).abs() < 1e-7, "{sigma}");
            let spread = |field: &HeightField| field.range().map(|[low, high]| high - low).unwrap();
            assert!(spread(&blurred) < spread(&field));
        }
        // Far wider than the field, everything is the mean.
        assert!(
            odd(5, 4)
                .blurred(100.0)
                .unwrap()
                .heights
                .iter()
                .all(|h| (f64::from(*h) - mean(&odd(5, 4))).abs() < 1e-6)
        );
        assert!(odd(3, 3).blurred(f64::NAN).is_err() && odd(3, 3).blurred(-1.0).is_err());
        assert_eq!(odd(3, 3).blurred(0.0).unwrap(), odd(3, 3));
    }

    #[test]
    fn blur_leaves_a_level_with_holes_level() {
        let mut field = HeightField::new(9, 9, vec![2.5; 81], Vec2::ONE).unwrap();
        field.heights[40] = f32::NAN;
        field.heights[0] = f32::NAN;
        let blurred = field.blurred(2.0).unwrap();
        assert_eq!(blurred.hole_count(), 2);
        assert!(blurred.heights.iter().filter(|h| h.is_finite()).all(|h| (h - 2.5).abs() < 1e-6));
    }

    #[test]
    fn parts_and_cells_keep_distances() {
        let field = odd(7, 5);
        let part = field.cropped(2, 1, 4, 3).unwrap();
        assert_eq!(part.at(0, 0), field.at(2, 1));
        assert_eq!(part.at(3, 2), field.at(5, 3));
        assert_eq!(part.size, Vec2::new(0.5, 0.5));
        assert!(field.cropped(4, 0, 4, 3).is_err() && field.cropped(0, 0, 1, 3).is_err());
        assert!(field.cropped(u32::MAX, 0, u32::MAX, 2).is_err());
        let cells = field.cells().unwrap();
        assert_eq!((cells.width, cells.height), (8, 6));
        assert_eq!(cells.at(0, 0), field.at(0, 0));
        let around = [field.at(2, 1), field.at(3, 1), field.at(2, 2), field.at(3, 2)].map(Option::unwrap);
        assert!((cells.at(3, 2).unwrap() - around.iter().sum::<f32>() / 4.0).abs() < 1e-6);
    }

    #[test]
    fn turned_over_and_scaled() {
        let field = odd(4, 4).scaled(2.0, -1.0).inverted();
        let twice = field.clone().inverted();
        assert_eq!(field.range(), twice.range());
        let holes = odd(4, 4).scaled(f64::MAX, 0.0);
        assert!(holes.range().is_none_or(|[_, high]| high.is_finite()));
        assert_eq!(holes.filled(3.0).hole_count(), 0);
    }
}
