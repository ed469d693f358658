//! What the contract suite runs over.

use glam::{Vec2, Vec3};

use super::{Generator, KleinForm, Solid};

impl Generator {
    /// One of each kind and the odd cases: what the contract suite runs over.
    pub fn examples() -> Vec<Self> {
        let cone = |bottom_radius, top_radius, capped| Self::Cone {
            bottom_radius,
            top_radius,
            height: 1.5,
            segments: 12,
            stacks: 2,
            capped,
        };
        let superellipsoid = |around, upright| Self::Superellipsoid {
            radii: Vec3::new(1.0, 1.5, 2.0),
            around,
            upright,
            segments: 24,
            rings: 16,
        };
        let mut examples = vec![
            Self::Sphere { radius: 1.5, segments: 12, rings: 6 },
            Self::Sphere { radius: 1.0, segments: 3, rings: 2 },
            Self::Icosphere { radius: 0.5, subdivisions: 0 },
            Self::Icosphere { radius: 2.0, subdivisions: 2 },
            Self::Cuboid { size: Vec3::new(1.0, 2.0, 3.0), divisions: [1, 1, 1] },
            Self::Cuboid { size: Vec3::new(3.0, 0.5, 1.0), divisions: [3, 1, 2] },
            Self::Plane { size: Vec2::new(2.0, 3.0), divisions: [4, 2] },
            Self::Cylinder { radius: 1.0, height: 2.0, segments: 12, stacks: 3, capped: true },
            Self::Cylinder { radius: 0.25, height: 1.0, segments: 3, stacks: 1, capped: false },
            cone(1.0, 0.0, true),
            cone(1.0, 0.5, true),
            cone(0.0, 1.0, true),
            cone(1.0, 0.0, false),
            cone(0.5, 1.0, false),
            Self::Torus { major_radius: 2.0, minor_radius: 0.5, segments: 16, sides: 8 },
            Self::Ellipsoid { radii: Vec3::new(1.0, 2.0, 1.5), segments: 16, rings: 10 },
            superellipsoid(0.5, 0.8),
            superellipsoid(1.0, 1.0),
            superellipsoid(1.5, 0.4),
            Self::Capsule { radius: 0.5, height: 2.0, segments: 12, rings: 4, stacks: 3 },
            Self::Capsule { radius: 0.5, height: 0.0, segments: 12, rings: 4, stacks: 3 },
            Self::Disc { radius: 1.5, segments: 12, rings: 1 },
            Self::Disc { radius: 0.5, segments: 5, rings: 3 },
            Self::Annulus { outer_radius: 2.0, inner_radius: 0.5, segments: 12, rings: 2 },
            Self::Tube { outer_radius: 1.0, inner_radius: 0.75, height: 2.0, segments: 12, stacks: 1 },
            Self::Tube { outer_radius: 2.0, inner_radius: 0.5, height: 0.5, segments: 7, stacks: 3 },
            Self::Polygon { sides: 7, radius: 1.0 },
            Self::Prism { sides: 3, radius: 1.0, height: 2.0 },
            Self::Prism { sides: 6, radius: 0.5, height: 1.0 },
            Self::Pyramid { sides: 4, radius: 1.0, top_radius: 0.0, height: 1.5 },
            Self::Pyramid { sides: 5, radius: 0.0, top_radius: 1.0, height: 1.5 },
            Self::Pyramid { sides: 6, radius: 1.0, top_radius: 0.5, height: 0.5 },
            Self::RoundedCuboid { size: Vec3::new(1.0, 2.0, 3.0), radius: 0.25, segments: 3 },
            Self::RoundedCuboid { size: Vec3::new(1.0, 2.0, 1.0), radius: 0.5, segments: 2 },
            Self::RoundedCuboid { size: Vec3::splat(2.0), radius: 7.0, segments: 4 },
            Self::RoundedCuboid { size: Vec3::new(1.0, 2.0, 3.0), radius: 0.0, segments: 2 },
            Self::Moebius { radius: 2.0, width: 1.0, half_twists: 1, segments: 24, stacks: 3 },
            Self::Moebius { radius: 2.0, width: 0.5, half_twists: 2, segments: 24, stacks: 2 },
            Self::Moebius { radius: 2.0, width: 0.5, half_twists: 3, segments: 36, stacks: 1 },
            Self::Moebius { radius: 1.0, width: 0.5, half_twists: 0, segments: 12, stacks: 1 },
            Self::KleinBottle { form: KleinForm::Bottle, size: 3.0, segments: 48, sides: 16 },
            Self::KleinBottle { form: KleinForm::Bottle, size: 3.0, segments: 40, sides: 15 },
            Self::KleinBottle { form: KleinForm::FigureEight, size: 2.0, segments: 32, sides: 24 },
            Self::TorusKnot {
                around_axis: 2,
                around_tube: 3,
                major_radius: 1.0,
                minor_radius: 0.5,
                tube_radius: 0.125,
                segments: 64,
                sides: 8,
            },
            Self::TorusKnot {
                around_axis: 3,
                around_tube: 5,
                major_radius: 2.0,
                minor_radius: 0.5,
                tube_radius: 0.1,
                segments: 120,
                sides: 6,
            },
            Self::Spring { radius: 1.0, tube_radius: 0.1, pitch: 0.5, turns: 2.5, segments: 16, sides: 8 },
            Self::Spring { radius: 0.5, tube_radius: 0.25, pitch: -0.75, turns: 1.0, segments: 12, sides: 6 },
            Self::Teapot { size: 1.0, divisions: 10 },
        ];
        examples.extend(Solid::ALL.map(|solid| Self::Polyhedron { solid, radius: 1.5 }));
        examples
    }
}
