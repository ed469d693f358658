//! What can be summed over the triangles: area, volume, moments, histograms.
//!
//! Blocks of a fixed size are summed on all threads, then the sums in order: the same bits for any number of threads.

use glam::{DMat3, DVec3, Vec3};
use rayon::prelude::*;
use serde::Serialize;

/// Triangles of a block.
const BLOCK: usize = 1 << 14;
/// Where the classes of [`Measures::aspects`] end; the last has no end.
const ASPECT_ENDS: [f64; 7] = [1.25, 1.5, 2.0, 3.0, 5.0, 10.0, 100.0];

/// How many things are between two bounds.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Class {
    /// The lower bound.
    pub from: f64,
    /// The upper bound; none if there is no limit.
    pub to: Option<f64>,
    /// How many.
    pub count: u64,
}

/// The sums.
#[derive(Clone)]
pub(super) struct Measures {
    pub(super) area: f64,
    pub(super) six_volumes: f64,
    /// Σ volume · middle · 24.
    moment: DVec3,
    /// Σ ∫ x xᵀ · 120.
    second: DMat3,
    pub(super) degenerate: usize,
    /// By the power of two of the squared length; biased by 1100.
    lengths: Vec<u64>,
    aspects: [u64; ASPECT_ENDS.len() + 1],
    pub(super) shortest: f64,
    pub(super) longest: f64,
}

impl Default for Measures {
    fn default() -> Self {
        Self {
            area: 0.0,
            six_volumes: 0.0,
            moment: DVec3::ZERO,
            second: DMat3::ZERO,
            degenerate: 0,
            lengths: vec![0; 2200],
            aspects: Default::default(),
            shortest: f64::INFINITY,
            longest: 0.0,
        }
    }
}

impl Measures {
    /// Sums over all triangles; lengths and volumes are taken from `origin`, near the mesh.
    pub(super) fn new(positions: &[Vec3], triangles: &[[u32; 3]], origin: DVec3) -> Self {
        let parts: Vec<Self> = (triangles.par_chunks(BLOCK))
            .map(|block| {
                let mut part = Self::default();
                for corners in block {
                    part.add(corners.map(|i| positions[i as usize].as_dvec3() - origin));
                }
                part
            })
            .collect();
        parts.iter().fold(Self::default(), Self::joined)
    }

    fn joined(mut self, part: &Self) -> Self {
        self.area += part.area;
        self.six_volumes += part.six_volumes;
        self.moment += part.moment;
        self.second += part.second;
        self.degenerate += part.degenerate;
        self.lengths.iter_mut().zip(&part.lengths).for_each(|(sum, count)| *sum += count);
        self.aspects.iter_mut().zip(&part.aspects).for_each(|(sum, count)| *sum += count);
        self.shortest = self.shortest.min(part.shortest);
        self.longest = self.longest.max(part.longest);
        self
    }

    fn add(&mut self, [a, b, c]: [DVec3; 3]) {
        let double_area = (b - a).cross(c - a).length();
        self.area += double_area / 2.0;
        let part = a.dot(b.cross(c));
        let sum = a + b + c;
        self.six_volumes += part;
        self.moment += sum * part;
        // ∫ x xᵀ over a tetrahedron with a corner at the origin is V/20 (Σ p pᵀ + s sᵀ), with s the sum of the corners p.
        let outer = |v: DVec3| DMat3::from_cols(v * v.x, v * v.y, v * v.z);
        self.second += (outer(a) + outer(b) + outer(c) + outer(sum)) * part;
        let squares = [(b - a).length_squared(), (c - b).length_squared(), (a - c).length_squared()];
        for square in squares {
            let exponent = (square.to_bits() >> 52) as i64 - 1023;
            if square > 0.0 {
                self.lengths[(exponent + 1100).clamp(0, 2199) as usize] += 1;
            }
        }
        let longest = squares[0].max(squares[1]).max(squares[2]);
        self.shortest = self.shortest.min(squares[0].min(squares[1]).min(squares[2]));
        self.longest = self.longest.max(longest);
        if double_area == 0.0 {
            self.degenerate += 1;
            self.aspects[ASPECT_ENDS.len()] += 1;
            return;
        }
        // The longest side over the height that an equilateral triangle of this inner circle would have: 1 at best.
        let perimeter = squares[0].sqrt() + squares[1].sqrt() + squares[2].sqrt();
        let aspect = longest.sqrt() * perimeter / (2.0 * 3f64.sqrt() * double_area);
        self.aspects[ASPECT_ENDS.iter().take_while(|end| aspect >= **end).count()] += 1;
    }

    /// Middle of the enclosed mass, relative to the origin of the sums.
    pub(super) fn center(&self) -> DVec3 {
        self.moment / (4.0 * self.six_volumes)
    }

    /// Tensor of inertia about the middle for density 1.
    pub(super) fn inertia(&self) -> DMat3 {
        let volume = self.six_volumes / 6.0;
        let center = self.center();
        let outer = DMat3::from_cols(center * center.x, center * center.y, center * center.z);
        let spread = self.second * (1.0 / 120.0) - outer * volume;
        let trace = spread.x_axis.x + spread.y_axis.y + spread.z_axis.z;
        DMat3::from_diagonal(DVec3::splat(trace)) - spread
    }

    /// Sides of triangles by their length, in classes of a factor of √2; those without length are not counted.
    pub(super) fn lengths(&self) -> Vec<Class> {
        let bound = |place: usize| libm::exp2((place as f64 - 1100.0) / 2.0);
        let used = self.lengths.iter().enumerate().filter(|(_, count)| **count > 0);
        used.map(|(place, &count)| Class { from: bound(place), to: Some(bound(place + 1)), count }).collect()
    }

    /// Triangles by their aspect: 1 for equilateral ones; triangles without area in the last class.
    pub(super) fn aspects(&self) -> Vec<Class> {
        let from = |place: usize| place.checked_sub(1).map_or(1.0, |before| ASPECT_ENDS[before]);
        let classes = self.aspects.iter().enumerate();
        classes
            .map(|(place, &count)| Class { from: from(place), to: ASPECT_ENDS.get(place).copied(), count })
            .collect()
    }
}
