//! Ready-made meshes: what there is, and what each promises.
//!
//! All stand upright along +Y around the origin, wound counter-clockwise seen from outside, with uv origin at the
//! lower left of the unrolled surface. Hard edges and uv seams have normals and uvs of their own; positions are never
//! split, so a closed shape is closed. Curved shapes have their vertices on the true surface: area and volume approach
//! those of the shape with the square of the resolution.
//!
//! Counts that are too small are raised to the least that gives a body, counts above [`MAX_DIVISIONS`] are lowered to it.

mod cone;
mod cuboid;
mod icosphere;
mod plane;
mod sphere;
mod torus;

use std::f64::consts::PI;

use glam::{DVec2, DVec3, Vec2, Vec3};

use crate::TriangleMesh;
pub use cone::{cone, cylinder};
pub use cuboid::cuboid;
pub use icosphere::{MAX_SUBDIVISIONS, icosphere};
pub use plane::plane;
pub use sphere::sphere;
pub use torus::torus;

/// The most pieces along one direction.
pub const MAX_DIVISIONS: u32 = 4096;

/// A shape with its measures and resolution.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Generator {
    /// See [`sphere`].
    Sphere {
        /// Distance of the surface from the centre.
        radius: f32,
        /// Pieces around the axis.
        segments: u32,
        /// Pieces from pole to pole.
        rings: u32,
    },
    /// See [`icosphere`].
    Icosphere {
        /// Distance of the surface from the centre.
        radius: f32,
        /// How often each triangle is cut into four.
        subdivisions: u32,
    },
    /// See [`cuboid`].
    Cuboid {
        /// Lengths of the sides.
        size: Vec3,
        /// Pieces of each side.
        divisions: [u32; 3],
    },
    /// See [`plane`].
    Plane {
        /// Lengths along x and z.
        size: Vec2,
        /// Pieces along x and z.
        divisions: [u32; 2],
    },
    /// See [`cylinder`].
    Cylinder {
        /// Radius.
        radius: f32,
        /// Length along y.
        height: f32,
        /// Pieces around the axis.
        segments: u32,
        /// Pieces along the axis.
        stacks: u32,
        /// With a disc at both ends.
        capped: bool,
    },
    /// See [`cone`].
    Cone {
        /// Radius at the lower end.
        bottom_radius: f32,
        /// Radius at the upper end; zero for a point.
        top_radius: f32,
        /// Length along y.
        height: f32,
        /// Pieces around the axis.
        segments: u32,
        /// Pieces along the axis.
        stacks: u32,
        /// With a disc at every end that is not a point.
        capped: bool,
    },
    /// See [`torus`].
    Torus {
        /// From the centre to the middle of the tube.
        major_radius: f32,
        /// Radius of the tube.
        minor_radius: f32,
        /// Pieces around the axis.
        segments: u32,
        /// Pieces around the tube.
        sides: u32,
    },
}

impl Generator {
    /// Makes the mesh.
    pub fn mesh(&self) -> TriangleMesh {
        match *self {
            Self::Sphere { radius, segments, rings } => sphere(radius, segments, rings),
            Self::Icosphere { radius, subdivisions } => icosphere(radius, subdivisions),
            Self::Cuboid { size, divisions } => cuboid(size, divisions),
            Self::Plane { size, divisions } => plane(size, divisions),
            Self::Cylinder { radius, height, segments, stacks, capped } => {
                cylinder(radius, height, segments, stacks, capped)
            }
            Self::Cone { bottom_radius, top_radius, height, segments, stacks, capped } => {
                cone(bottom_radius, top_radius, height, segments, stacks, capped)
            }
            Self::Torus { major_radius, minor_radius, segments, sides } => {
                torus(major_radius, minor_radius, segments, sides)
            }
        }
    }

    /// True if the mesh encloses a body.
    pub fn is_closed(&self) -> bool {
        match *self {
            Self::Plane { .. } => false,
            Self::Cylinder { capped, .. } | Self::Cone { capped, .. } => capped,
            _ => true,
        }
    }

    /// Vertices − edges + triangles.
    pub fn euler_characteristic(&self) -> i64 {
        match *self {
            Self::Torus { .. } => 0,
            Self::Plane { .. } => 1,
            Self::Cylinder { capped: false, .. } => 0,
            // An open cone is a disc, an open frustum a ring.
            Self::Cone { bottom_radius, top_radius, capped: false, .. } => {
                i64::from(bottom_radius == 0.0 || top_radius == 0.0)
            }
            _ => 2,
        }
    }

    /// The area of the true shape, which the mesh approaches.
    pub fn area_of_shape(&self) -> f64 {
        match *self {
            Self::Sphere { radius, .. } | Self::Icosphere { radius, .. } => 4.0 * PI * squared(radius),
            Self::Cuboid { size, .. } => {
                let DVec3 { x, y, z } = size.as_dvec3();
                2.0 * (x * y + y * z + z * x)
            }
            Self::Plane { size, .. } => {
                let DVec2 { x, y } = size.as_dvec2();
                x * y
            }
            Self::Cylinder { radius, height, capped, .. } => frustum_area(radius, radius, height, capped),
            Self::Cone { bottom_radius, top_radius, height, capped, .. } => {
                frustum_area(bottom_radius, top_radius, height, capped)
            }
            Self::Torus { major_radius, minor_radius, .. } => {
                4.0 * PI * PI * f64::from(major_radius) * f64::from(minor_radius)
            }
        }
    }

    /// The volume of the true shape, which the mesh approaches; `None` if it is open.
    pub fn volume_of_shape(&self) -> Option<f64> {
        let volume = match *self {
            Self::Sphere { radius, .. } | Self::Icosphere { radius, .. } => {
                4.0 / 3.0 * PI * squared(radius) * f64::from(radius)
            }
            Self::Cuboid { size, .. } => size.as_dvec3().element_product(),
            Self::Plane { .. } => 0.0,
            Self::Cylinder { radius, height, .. } => PI * squared(radius) * f64::from(height),
            Self::Cone { bottom_radius, top_radius, height, .. } => {
                let product = f64::from(bottom_radius) * f64::from(top_radius);
                PI / 3.0 * f64::from(height) * (squared(bottom_radius) + product + squared(top_radius))
            }
            Self::Torus { major_radius, minor_radius, .. } => {
                2.0 * PI * PI * f64::from(major_radius) * squared(minor_radius)
            }
        };
        self.is_closed().then_some(volume)
    }

    /// The same shape with every count times `factor` (subdivisions: one more for each doubling).
    pub fn refined(&self, factor: u32) -> Self {
        let mut finer = *self;
        match &mut finer {
            Self::Sphere { segments, rings, .. } => {
                (*segments, *rings) = (*segments * factor, *rings * factor)
            }
            Self::Icosphere { subdivisions, .. } => *subdivisions += factor.ilog2(),
            Self::Cuboid { divisions, .. } => *divisions = divisions.map(|n| n * factor),
            Self::Plane { divisions, .. } => *divisions = divisions.map(|n| n * factor),
            Self::Cylinder { segments, stacks, .. } | Self::Cone { segments, stacks, .. } => {
                (*segments, *stacks) = (*segments * factor, *stacks * factor);
            }
            Self::Torus { segments, sides, .. } => {
                (*segments, *sides) = (*segments * factor, *sides * factor)
            }
        }
        finer
    }

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
        vec![
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
        ]
    }
}

fn squared(length: f32) -> f64 {
    f64::from(length) * f64::from(length)
}

fn frustum_area(bottom: f32, top: f32, height: f32, capped: bool) -> f64 {
    let slant = (squared(height) + squared(bottom - top)).sqrt();
    let discs = if capped { PI * (squared(bottom) + squared(top)) } else { 0.0 };
    PI * (f64::from(bottom) + f64::from(top)) * slant + discs
}

/// The point of the unit circle `part / whole` of a turn around: (cos, sin), exact at the quarters.
fn on_circle(part: u32, whole: u32) -> DVec2 {
    // Count quarters in integers: the point at a quarter must not depend on how π is rounded.
    let quarters = 4 * u64::from(part % whole);
    let rest = (quarters % u64::from(whole)) as f64 / f64::from(whole) * (PI / 2.0);
    let (sin, cos) = (libm::sin(rest), libm::cos(rest));
    match quarters / u64::from(whole) {
        0 => DVec2::new(cos, sin),
        1 => DVec2::new(-sin, cos),
        2 => DVec2::new(-cos, -sin),
        _ => DVec2::new(sin, -cos),
    }
}

/// Two triangles of a cell of a grid, from its corner indices: lower left, lower right, upper right, upper left.
fn quad(corners: [u32; 4]) -> [[u32; 3]; 2] {
    let [a, b, c, d] = corners;
    [[a, b, c], [a, c, d]]
}
