//! Samples against their density: the first thing to check of any new warp, lobe or lamp.

use super::bins::Bins;
use super::chi_square::{ChiSquare, chi_square};
use super::cubature::Cubature;
use crate::{Domain, Sampler, Sequence};
use glam::{DVec3, Vec3};
use std::f64::consts::PI;

/// Error of the integral of a density that passes unseen, as a share of all.
const INTEGRAL_ERROR: f64 = 2e-3;

/// A rectangle of two coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Area {
    /// Least coordinates.
    pub low: [f64; 2],
    /// Greatest coordinates.
    pub high: [f64; 2],
}

impl Area {
    /// From 0 to 1 both ways.
    pub const UNIT_SQUARE: Self = Self { low: [0.0; 2], high: [1.0; 2] };

    /// The area.
    pub fn size(&self) -> f64 {
        (self.high[0] - self.low[0]) * (self.high[1] - self.low[1])
    }

    /// Whether a place lies inside or on the border.
    pub fn contains(&self, place: [f64; 2]) -> bool {
        (0..2).all(|axis| (self.low[axis]..=self.high[axis]).contains(&place[axis]))
    }

    /// The least rectangle around places; `None` if there are none.
    pub(super) fn around(places: &[[f64; 2]]) -> Option<Self> {
        let first = *places.first()?;
        Some(places.iter().fold(Self { low: first, high: first }, |area, place| Self {
            low: [0, 1].map(|axis| area.low[axis].min(place[axis])),
            high: [0, 1].map(|axis| area.high[axis].max(place[axis])),
        }))
    }

    pub(super) fn quarters(&self) -> [Self; 4] {
        let Self { low, high } = *self;
        let middle = [0, 1].map(|axis| 0.5 * (low[axis] + high[axis]));
        [
            Self { low, high: middle },
            Self { low: [middle[0], low[1]], high: [high[0], middle[1]] },
            Self { low: [low[0], middle[1]], high: [middle[0], high[1]] },
            Self { low: middle, high },
        ]
    }
}

/// The sphere as a rectangle of equal areas: the azimuth about an axis, and one less the cosine of the angle to it.
///
/// Near the axis the second coordinate keeps its digits, so cones as narrow as a distant star are told apart.
#[derive(Clone, Copy, Debug)]
pub struct SphereMap {
    axes: [DVec3; 3],
}

impl SphereMap {
    /// All directions: azimuth −π to π, 1 − cos from 0 to 2.
    pub const AREA: Area = Area { low: [-PI, 0.0], high: [PI, 2.0] };

    /// The map about an axis of any length; about +Z if it has none.
    pub fn about(axis: Vec3) -> Self {
        let axis = axis.as_dvec3().try_normalize().unwrap_or(DVec3::Z);
        let tangent = if axis == DVec3::Z { DVec3::X } else { axis.any_orthonormal_vector() };
        Self { axes: [tangent, axis.cross(tangent), axis] }
    }

    /// Where a direction lies.
    pub fn place(&self, direction: Vec3) -> [f64; 2] {
        let direction = direction.as_dvec3().normalize_or(self.axes[2]);
        let azimuth = libm::atan2(direction.dot(self.axes[1]), direction.dot(self.axes[0]));
        // Half the squared chord is 1 − cos without cancellation.
        [azimuth, (0.5 * (direction - self.axes[2]).length_squared()).min(2.0)]
    }

    /// The direction of a place.
    pub fn direction(&self, [azimuth, height]: [f64; 2]) -> Vec3 {
        let radius = (height * (2.0 - height)).max(0.0).sqrt();
        let (sine, cosine) = libm::sincos(azimuth);
        let [x, y, z] = self.axes;
        (x * (radius * cosine) + y * (radius * sine) + z * (1.0 - height)).as_vec3()
    }
}

/// How many samples are put into how many bins.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FitSettings {
    /// Samples that are counted.
    pub samples: u64,
    /// Bins, at most; every one is expected to hold about as many samples.
    pub bins: usize,
    /// Any number; another gives other samples.
    pub seed: u64,
}

impl Default for FitSettings {
    fn default() -> Self {
        Self { samples: 1 << 17, bins: 256, seed: 1 }
    }
}

/// How samples and their density agree.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DensityFit {
    /// Counts against the integrated density; tries that were declined are a cell of their own.
    pub chi_square: ChiSquare,
    /// Bins.
    pub bins: usize,
    /// Integral of the density over its domain, by quadrature.
    pub integral: f64,
    /// Samples that were tried.
    pub tried: u64,
    /// Samples that were drawn, of those tried.
    pub drawn: u64,
}

impl DensityFit {
    /// By how much the integral of the density misses the share of tries that gave a sample. Nothing but the error of the
    /// quadrature and of chance, if the density is right.
    pub fn missing(&self) -> f64 {
        self.integral - self.drawn as f64 / self.tried.max(1) as f64
    }

    /// True if counts agree with the density at this level, and its integral with the share of tries that gave a sample: up to 0.2 %
    /// and four standard errors.
    pub fn agrees(&self, level: f64) -> bool {
        let share = self.drawn as f64 / self.tried.max(1) as f64;
        let error = (share * (1.0 - share) / self.tried.max(1) as f64).sqrt();
        self.chi_square.p_value > level && self.missing().abs() <= INTEGRAL_ERROR + 4.0 * error
    }
}

fn numbers(seed: u64, index: u64, purpose: u32) -> [f32; 4] {
    Sampler::at(Sequence::Independent, seed, [0, 0], index).group(Domain::new(0, purpose))
}

/// Draws samples with independent numbers and compares them with their density over a rectangle of two coordinates.
///
/// `sample` may decline with `None`, and places outside the rectangle count as declined: the density is then expected to integrate to
/// less than one by as much. `pdf` is per area of the rectangle. Other samples than those that are counted divide the rectangle into
/// bins of about equal probability, so narrow lobes are seen as sharply as wide ones; the density is integrated over each bin by
/// quadrature that looks closer at peaks and at jumps.
pub fn density_fit(
    area: Area,
    settings: FitSettings,
    mut sample: impl FnMut([f32; 4]) -> Option<[f64; 2]>,
    pdf: impl Fn([f64; 2]) -> f64,
) -> DensityFit {
    let FitSettings { samples, bins, seed } = settings;
    let mut inside = |index, purpose| {
        sample(numbers(seed, index, purpose)).filter(|place: &[f64; 2]| area.contains(*place))
    };
    let mut pilot: Vec<[f64; 2]> = (0..32 * bins as u64).filter_map(|index| inside(index, 1)).collect();
    let bins = Bins::new(area, &mut pilot, bins);

    let mut observed = vec![0u64; bins.bins.len()];
    let mut drawn = 0;
    for index in 0..samples {
        if let Some(place) = inside(index, 0) {
            observed[bins.find(place)] += 1;
            drawn += 1;
        }
    }

    // A hundredth of what chance moves a bin by.
    let each = (samples as f64 / bins.bins.len() as f64).max(1.0);
    let mut cubature =
        Cubature { density: &pdf, tolerance: 0.01 * each.sqrt() / (samples.max(1) as f64), budget: 1 << 26 };
    let masses: Vec<f64> = bins.bins.iter().map(|bin| cubature.graded(bin.area, bin.crowded)).collect();
    let integral: f64 = masses.iter().sum();
    let mut expected: Vec<f64> = masses.iter().map(|mass| mass * samples as f64).collect();
    // Tries that were declined are a cell of their own, unless they are too few to tell from the error of the integral.
    let lost = samples - drawn;
    let few = INTEGRAL_ERROR * samples as f64;
    let expected_lost = (1.0 - integral) * samples as f64;
    if lost as f64 > few || expected_lost > few {
        observed.push(lost);
        expected.push(expected_lost.max(0.0));
    }
    DensityFit {
        chi_square: chi_square(&observed, &expected),
        bins: bins.bins.len(),
        integral,
        tried: samples,
        drawn,
    }
}

/// The same for directions with a density per solid angle; `count` of them are counted.
pub fn directions_match_pdf(
    count: u64,
    seed: u64,
    mut sample: impl FnMut([f32; 4]) -> Option<Vec3>,
    pdf: impl Fn(Vec3) -> f32,
) -> DensityFit {
    let map = SphereMap::about(Vec3::Z);
    let settings = FitSettings { samples: count, seed, ..FitSettings::default() };
    density_fit(
        SphereMap::AREA,
        settings,
        |u| sample(u).map(|direction| map.place(direction)),
        |place| f64::from(pdf(map.direction(place))),
    )
}

/// The same for points of the unit square with a density per area; `count` of them are counted.
pub fn square_matches_pdf(
    count: u64,
    seed: u64,
    mut sample: impl FnMut([f32; 4]) -> Option<[f32; 2]>,
    pdf: impl Fn([f32; 2]) -> f32,
) -> DensityFit {
    let settings = FitSettings { samples: count, seed, ..FitSettings::default() };
    density_fit(
        Area::UNIT_SQUARE,
        settings,
        |u| sample(u).map(|place| place.map(f64::from)),
        |[x, y]| f64::from(pdf([x as f32, y as f32])),
    )
}

/// Samples and density on an even grid, to be looked at.
#[derive(Clone, Debug, PartialEq)]
pub struct DensityGrid {
    /// What the grid covers: where samples lie, a few in a thousand on each side left out.
    pub area: Area,
    /// Cells a side.
    pub side: usize,
    /// Samples in each cell, row by row from the least second coordinate.
    pub observed: Vec<u64>,
    /// The density integrated over each cell, times the samples that were tried.
    pub expected: Vec<f64>,
}

/// The grid of a routine; arguments as of [`density_fit`], of whose settings `bins` does not matter. `None` if nothing is drawn.
pub fn density_grid(
    area: Area,
    side: usize,
    settings: FitSettings,
    mut sample: impl FnMut([f32; 4]) -> Option<[f64; 2]>,
    pdf: impl Fn([f64; 2]) -> f64,
) -> Option<DensityGrid> {
    let FitSettings { samples, seed, .. } = settings;
    let side = side.clamp(1, 1024);
    let mut inside = |index, purpose| {
        sample(numbers(seed, index, purpose)).filter(|place: &[f64; 2]| area.contains(*place))
    };
    let pilot: Vec<[f64; 2]> = (0..1 << 13).filter_map(|index| inside(index, 1)).collect();
    let area = zoomed(area, &pilot)?;
    let mut observed = vec![0u64; side * side];
    let cell = |place: [f64; 2], axis: usize| {
        let part = (place[axis] - area.low[axis]) / (area.high[axis] - area.low[axis]);
        ((part * side as f64) as usize).min(side - 1)
    };
    for index in 0..samples {
        if let Some(place) = inside(index, 0).filter(|place| area.contains(*place)) {
            observed[cell(place, 1) * side + cell(place, 0)] += 1;
        }
    }
    let tolerance = 0.01 * (samples as f64).sqrt() / (side as f64 * samples.max(1) as f64);
    let mut cubature = Cubature { density: &pdf, tolerance, budget: 1 << 26 };
    let border = |axis: usize, at: usize| {
        area.low[axis] + (area.high[axis] - area.low[axis]) * at as f64 / side as f64
    };
    let expected = (0..side * side)
        .map(|at| {
            let (column, row) = (at % side, at / side);
            let low = [border(0, column), border(1, row)];
            let high = [border(0, column + 1), border(1, row + 1)];
            cubature.over(Area { low, high }, 0, 6) * samples as f64
        })
        .collect();
    Some(DensityGrid { area, side, observed, expected })
}

/// Where samples lie, but for two in a thousand at each end; the whole where that is not much more.
fn zoomed(area: Area, pilot: &[[f64; 2]]) -> Option<Area> {
    let mut found = area;
    for axis in 0..2 {
        let mut along: Vec<f64> = pilot.iter().map(|place| place[axis]).collect();
        along.sort_unstable_by(f64::total_cmp);
        let cut = along.len() / 500;
        let (low, high) = (*along.get(cut)?, *along.get(along.len() - 1 - cut)?);
        let (size, whole) = (high - low, area.high[axis] - area.low[axis]);
        if size < 0.8 * whole {
            let room = if size > 0.0 { 0.05 * size } else { 1e-6 * whole };
            found.low[axis] = (low - room).max(area.low[axis]);
            found.high[axis] = (high + room).min(area.high[axis]);
        }
    }
    Some(found)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::warp;

    #[test]
    fn a_wrong_density_is_found_a_right_one_is_not() {
        let settings = FitSettings::default();
        let map = SphereMap::about(Vec3::new(1.0, -2.0, 0.3));
        let cone = warp::Cone::from_half_angle(1e-3).unwrap();
        let frame = crate::Frame::from_normal(Vec3::new(1.0, -2.0, 0.3).normalize());
        let sample = |u: [f32; 4]| Some(map.place(frame.to_world(cone.sample([u[0], u[1]]))));
        // Of a thousandth of a radian single precision leaves some ten thousand steps.
        let right = |place| f64::from(cone.pdf(frame.to_local(map.direction(place))));
        let fit = density_fit(SphereMap::AREA, settings, sample, right);
        assert!(fit.agrees(0.001), "{fit:?}");
        let wrong = |place: [f64; 2]| right(place) * (0.92 + 0.16 * place[1] / 5e-7);
        let fit = density_fit(SphereMap::AREA, settings, sample, wrong);
        assert!(!fit.agrees(0.001), "{fit:?}");
        // A density that is right but for its size.
        let fit = density_fit(SphereMap::AREA, settings, sample, |place| 0.99 * right(place));
        assert!(!fit.agrees(1e-9) && (fit.missing() + 0.01).abs() < 2e-3, "{fit:?}");
    }

    #[test]
    fn what_is_declined_is_a_cell() {
        let settings = FitSettings::default();
        let half = |u: [f32; 4]| (u[2] < 0.5).then(|| [f64::from(u[0]), f64::from(u[1])]);
        assert!(density_fit(Area::UNIT_SQUARE, settings, half, |_| 0.5).agrees(0.001));
        assert!(!density_fit(Area::UNIT_SQUARE, settings, half, |_| 0.48).agrees(0.001));
        // Nothing drawn, nothing promised: nothing to say.
        let nothing = density_fit(Area::UNIT_SQUARE, settings, |_| None, |_| 0.0);
        assert!(nothing.agrees(0.001) && nothing.drawn == 0, "{nothing:?}");
        assert!(!density_fit(Area::UNIT_SQUARE, settings, half, |_| f64::NAN).agrees(1e-9));
    }

    #[test]
    fn grids_hold_what_is_to_be_seen() {
        let sample = |u: [f32; 4]| Some([0.4 + 0.1 * f64::from(u[0]), f64::from(u[1])]);
        let pdf = |[x, _]: [f64; 2]| if (0.4..0.5).contains(&x) { 10.0 } else { 0.0 };
        let settings = FitSettings { samples: 1 << 16, ..FitSettings::default() };
        let grid = density_grid(Area::UNIT_SQUARE, 16, settings, sample, pdf).unwrap();
        assert!(grid.area.low[0] > 0.39 && grid.area.high[0] < 0.51 && grid.area.high[1] == 1.0);
        assert!((grid.expected.iter().sum::<f64>() / 65536.0 - 1.0).abs() < 0.01);
        assert!(super::super::chi_square(&grid.observed, &grid.expected).p_value > 1e-3);
        assert!(density_grid(Area::UNIT_SQUARE, 4, settings, |_| None, pdf).is_none());
    }

    #[test]
    fn sphere_maps_lead_back() {
        for axis in [Vec3::Z, Vec3::Y, -Vec3::Z, Vec3::new(0.3, 0.4, -0.2), Vec3::ZERO] {
            let map = SphereMap::about(axis);
            for index in 0..100 {
                let direction = warp::sphere([numbers(3, index, 0)[0], numbers(3, index, 0)[1]]);
                let back = map.direction(map.place(direction));
                assert!((back - direction).length() < 1e-6, "{axis} {direction} {back}");
            }
        }
    }
}
