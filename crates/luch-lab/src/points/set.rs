//! A set of points of the unit cube, in one flat list.

/// Points of [0, 1)^d: coordinates of point 0, then of point 1, and so on.
#[derive(Clone, Debug, PartialEq)]
pub struct PointSet {
    dimensions: usize,
    coordinates: Vec<f64>,
}

impl PointSet {
    /// Points from a flat list. `None` if it does not hold whole points or there are no dimensions.
    pub fn from_flat(dimensions: usize, coordinates: Vec<f64>) -> Option<PointSet> {
        (dimensions > 0 && coordinates.len().is_multiple_of(dimensions))
            .then_some(PointSet { dimensions, coordinates })
    }

    /// Number of points.
    pub fn len(&self) -> usize {
        self.coordinates.len() / self.dimensions
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.coordinates.is_empty()
    }

    /// Number of coordinates of each point, at least 1.
    pub fn dimensions(&self) -> usize {
        self.dimensions
    }

    /// The coordinates of one point; panics past the end, as indexing does.
    pub fn point(&self, index: usize) -> &[f64] {
        &self.coordinates[index * self.dimensions..(index + 1) * self.dimensions]
    }

    /// All points in order.
    pub fn iter(&self) -> std::slice::ChunksExact<'_, f64> {
        self.coordinates.chunks_exact(self.dimensions)
    }

    /// All coordinates, point after point.
    pub fn flat(&self) -> &[f64] {
        &self.coordinates
    }

    /// The projection onto two coordinates. `None` if there are not that many dimensions.
    pub fn pair(&self, first: usize, second: usize) -> Option<Vec<[f64; 2]>> {
        (first.max(second) < self.dimensions)
            .then(|| self.iter().map(|point| [point[first], point[second]]).collect())
    }

    /// The first `count` points, or all if there are fewer.
    pub fn prefix(&self, count: usize) -> PointSet {
        let length = count.min(self.len()) * self.dimensions;
        PointSet { dimensions: self.dimensions, coordinates: self.coordinates[..length].to_vec() }
    }
}

impl<'a> IntoIterator for &'a PointSet {
    type Item = &'a [f64];
    type IntoIter = std::slice::ChunksExact<'a, f64>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}
