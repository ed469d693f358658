//! Counts: how much a generator makes, and the same shape finer.

use super::knot::spring_pieces;
use super::teapot::LEAST_TEAPOT_DIVISIONS;
use super::{Generator, MAX_DIVISIONS, MAX_ROUNDING, MAX_SUBDIVISIONS, MAX_TEAPOT_DIVISIONS};

impl Generator {
    /// How many triangles [`Generator::mesh`] makes, or a little more. Takes no memory, and counts as large as they
    /// come do no harm.
    pub fn triangle_count(&self) -> u64 {
        let count = |pieces: u32, least: u32| u64::from(pieces.clamp(least, MAX_DIVISIONS));
        let grid = |columns: u32, rows: u32| 2 * count(columns, 3) * count(rows, 3);
        match *self {
            Self::Sphere { segments, rings, .. }
            | Self::Ellipsoid { segments, rings, .. }
            | Self::Superellipsoid { segments, rings, .. } => grid(segments, rings),
            Self::Icosphere { subdivisions, .. } => 20 << (2 * subdivisions.min(MAX_SUBDIVISIONS)),
            Self::Cuboid { divisions, .. } => {
                let [x, y, z] = divisions.map(|pieces| count(pieces, 1));
                4 * (x * y + y * z + z * x)
            }
            Self::Plane { divisions, .. } => {
                let [x, z] = divisions.map(|pieces| count(pieces, 1));
                2 * x * z
            }
            Self::Cylinder { segments, stacks, .. } | Self::Cone { segments, stacks, .. } => {
                2 * count(segments, 3) * (count(stacks, 1) + 1)
            }
            Self::Torus { segments, sides, .. }
            | Self::TorusKnot { segments, sides, .. }
            | Self::KleinBottle { segments, sides, .. } => grid(segments, sides),
            Self::Capsule { segments, rings, stacks, .. } => {
                2 * count(segments, 3) * (2 * count(rings, 1) + count(stacks, 1))
            }
            Self::Disc { segments, rings, .. } | Self::Annulus { segments, rings, .. } => {
                2 * count(segments, 3) * count(rings, 1)
            }
            Self::Tube { segments, stacks, .. } => 2 * count(segments, 3) * (2 * count(stacks, 1) + 2),
            Self::Polygon { sides, .. } => count(sides, 3),
            Self::Prism { sides, .. } | Self::Pyramid { sides, .. } => 4 * count(sides, 3),
            Self::RoundedCuboid { segments, .. } => {
                let lines = 2 * u64::from(segments.clamp(1, MAX_ROUNDING)) + 1;
                12 * lines * lines
            }
            Self::Polyhedron { .. } => 120,
            Self::Moebius { segments, stacks, .. } => 2 * count(segments, 3) * count(stacks, 1),
            Self::Spring { turns, segments, sides, .. } => {
                2 * count(sides, 3) * (u64::from(spring_pieces(turns, segments)) + 1)
            }
            Self::Teapot { divisions, .. } => {
                let divisions = u64::from(divisions.clamp(LEAST_TEAPOT_DIVISIONS, MAX_TEAPOT_DIVISIONS));
                64 * divisions * divisions
            }
        }
    }

    /// The same shape with every count times `factor` (subdivisions: one more for each doubling). Shapes that are
    /// exact as they are stay so.
    pub fn refined(&self, factor: u32) -> Self {
        let mut finer = *self;
        let refine = |counts: &mut [&mut u32]| {
            for count in counts {
                **count = count.saturating_mul(factor);
            }
        };
        match &mut finer {
            Self::Sphere { segments, rings, .. }
            | Self::Ellipsoid { segments, rings, .. }
            | Self::Superellipsoid { segments, rings, .. }
            | Self::Disc { segments, rings, .. }
            | Self::Annulus { segments, rings, .. } => refine(&mut [segments, rings]),
            Self::Icosphere { subdivisions, .. } => {
                *subdivisions = subdivisions.saturating_add(factor.max(1).ilog2());
            }
            Self::Cuboid { divisions, .. } => divisions.iter_mut().for_each(|count| refine(&mut [count])),
            Self::Plane { divisions, .. } => divisions.iter_mut().for_each(|count| refine(&mut [count])),
            Self::Cylinder { segments, stacks, .. }
            | Self::Cone { segments, stacks, .. }
            | Self::Tube { segments, stacks, .. }
            | Self::Moebius { segments, stacks, .. } => refine(&mut [segments, stacks]),
            Self::Capsule { segments, rings, stacks, .. } => refine(&mut [segments, rings, stacks]),
            Self::Torus { segments, sides, .. }
            | Self::TorusKnot { segments, sides, .. }
            | Self::KleinBottle { segments, sides, .. }
            | Self::Spring { segments, sides, .. } => refine(&mut [segments, sides]),
            Self::RoundedCuboid { segments, .. } => refine(&mut [segments]),
            Self::Teapot { divisions, .. } => refine(&mut [divisions]),
            Self::Polygon { .. } | Self::Prism { .. } | Self::Pyramid { .. } | Self::Polyhedron { .. } => {}
        }
        finer
    }
}
