//! Functions of space, asked in bulk.

use glam::DVec3;

/// Points, each coordinate in a list of its own; the three lists have one length.
#[derive(Clone, Copy, Debug)]
pub struct Points<'a> {
    /// Along x, in metres.
    pub x: &'a [f64],
    /// Along y.
    pub y: &'a [f64],
    /// Along z.
    pub z: &'a [f64],
}

impl<'a> Points<'a> {
    /// How many there are.
    pub fn len(&self) -> usize {
        self.x.len()
    }

    /// True if there are none.
    pub fn is_empty(&self) -> bool {
        self.x.is_empty()
    }

    /// One of them.
    pub fn at(&self, index: usize) -> DVec3 {
        DVec3::new(self.x[index], self.y[index], self.z[index])
    }

    /// All of them in order.
    pub fn iter(&self) -> impl Iterator<Item = DVec3> + 'a {
        let (x, y, z) = (self.x, self.y, self.z);
        x.iter().zip(y).zip(z).map(|((&x, &y), &z)| DVec3::new(x, y, z))
    }
}

/// Points that are collected before a field is asked.
#[derive(Clone, Debug, Default)]
pub struct PointList {
    x: Vec<f64>,
    y: Vec<f64>,
    z: Vec<f64>,
}

impl PointList {
    /// Adds a point.
    pub fn push(&mut self, point: DVec3) {
        self.x.push(point.x);
        self.y.push(point.y);
        self.z.push(point.z);
    }

    /// Leaves none.
    pub fn clear(&mut self) {
        self.x.clear();
        self.y.clear();
        self.z.clear();
    }

    /// To be handed to a field.
    pub fn points(&self) -> Points<'_> {
        Points { x: &self.x, y: &self.y, z: &self.z }
    }
}

impl FromIterator<DVec3> for PointList {
    fn from_iter<I: IntoIterator<Item = DVec3>>(points: I) -> Self {
        let mut list = Self::default();
        points.into_iter().for_each(|point| list.push(point));
        list
    }
}

/// All numbers from `low` to `high`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// The least.
    pub low: f64,
    /// The greatest.
    pub high: f64,
}

impl Interval {
    /// Nothing is known, not even that values are numbers.
    pub const EVERYTHING: Self = Self { low: f64::NEG_INFINITY, high: f64::INFINITY };

    /// Whether no value can be zero, and all have one sign.
    pub fn excludes_zero(&self) -> bool {
        self.low > 0.0 || self.high < 0.0
    }
}

/// A box in double precision.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Region {
    /// The least coordinates, in metres.
    pub min: DVec3,
    /// The greatest coordinates.
    pub max: DVec3,
}

impl Region {
    /// The box of this half side about the origin.
    pub fn cube(half_side: f64) -> Self {
        Self { min: DVec3::splat(-half_side), max: DVec3::splat(half_side) }
    }

    /// The lengths of its sides.
    pub fn size(&self) -> DVec3 {
        self.max - self.min
    }
}

/// A function of space. The surface is where it is zero, the inside where it is negative; where it is not a number is outside.
pub trait Field: Sync {
    /// The values at all points; `values` has the length of the points.
    fn values(&self, points: Points<'_>, values: &mut [f64]);

    /// The gradients at all points; `gradients` has the length of the points. Not finite where there is none.
    ///
    /// Unless a field knows better, by central differences over the cube root of the rounding unit times the coordinate.
    fn gradients(&self, points: Points<'_>, gradients: &mut [DVec3]) {
        let step = |coordinate: f64| 6e-6 * coordinate.abs().max(1e-3);
        for axis in 0..3 {
            let moved = |sign: f64| {
                let list: PointList = points
                    .iter()
                    .map(|mut point| {
                        point[axis] += sign * step(point[axis]);
                        point
                    })
                    .collect();
                let mut values = vec![0.0; points.len()];
                self.values(list.points(), &mut values);
                (list, values)
            };
            let (ahead, values_ahead) = moved(1.0);
            let (behind, values_behind) = moved(-1.0);
            for (n, gradient) in gradients.iter_mut().enumerate() {
                let width = ahead.points().at(n)[axis] - behind.points().at(n)[axis];
                gradient[axis] = (values_ahead[n] - values_behind[n]) / width;
            }
        }
    }

    /// An interval that holds every value in the region; [`Interval::EVERYTHING`] if nothing is known.
    fn range(&self, region: &Region) -> Interval {
        let _ = region;
        Interval::EVERYTHING
    }
}

/// A field made of a function of one point. Nothing is known about its range.
#[derive(Clone, Copy, Debug)]
pub struct FunctionField<F>(pub F);

impl<F: Fn(DVec3) -> f64 + Sync> Field for FunctionField<F> {
    fn values(&self, points: Points<'_>, values: &mut [f64]) {
        for (value, point) in values.iter_mut().zip(points.iter()) {
            *value = (self.0)(point);
        }
    }
}
