//! A rectangle as seen from a point, sampled uniformly by solid angle.

use std::f64::consts::TAU;

use glam::{DVec3, Vec3};

/// A rectangle projected on the unit sphere about a point.
///
/// Ureña, Fajardo and King, "An area-preserving parametrization for spherical rectangles" (2013), in double precision; the
/// solid angle itself is the sum of two spherical triangles, which does not cancel.
#[derive(Clone, Copy, Debug)]
pub struct SphericalRectangle {
    /// Unit vectors along the edges, and the normal that points back to the point's side.
    axes: [DVec3; 3],
    /// Extent along both edges and (negative) height, in the frame of `axes` about the point.
    low: [f64; 2],
    high: [f64; 2],
    height: f64,
    /// Heights of the unit normals of the planes through the point and the two edges along x.
    low_slope: f64,
    high_slope: f64,
    /// The angle where the area starts.
    start: f64,
    solid_angle: f64,
}

/// A direction towards a rectangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SphericalRectangleSample {
    /// From the point to the rectangle; unit length.
    pub direction: Vec3,
    /// Fractions along the two edges of the place the direction meets, in [0, 1].
    pub position: [f32; 2],
    /// Density per solid angle: one over the solid angle.
    pub pdf: f32,
}

impl SphericalRectangle {
    /// Below this, in steradians, the angles of the construction cancel; by area is then as good.
    const SMALLEST: f64 = 1e-9;

    /// The rectangle `corner + s·edge_u + t·edge_v`, s and t in [0, 1], as seen from `point`, from either side.
    ///
    /// The edges must be perpendicular (to about 10⁻⁴). `None` when they are not, when there is nothing to see (no area,
    /// the point in the plane, coordinates not finite), or below 10⁻⁹ sr. Then sample by area, or as two
    /// [`SphericalTriangle`](super::SphericalTriangle)s.
    pub fn new(point: Vec3, corner: Vec3, edge_u: Vec3, edge_v: Vec3) -> Option<Self> {
        let (edge_u, edge_v) = (edge_u.as_dvec3(), edge_v.as_dvec3());
        let offset = corner.as_dvec3() - point.as_dvec3();
        let (x, y) = (edge_u.try_normalize()?, edge_v.try_normalize()?);
        let z = x.cross(y);
        if x.dot(y).abs() > 1e-4 {
            return None;
        }
        let (low_x, low_y, flat_height) = (offset.dot(x), offset.dot(y), offset.dot(z));
        // The rectangle lies below the point, at negative height.
        let (z, height) = if flat_height > 0.0 { (-z, -flat_height) } else { (z, flat_height) };
        let (low, high) = ([low_x, low_y], [low_x + edge_u.length(), low_y + edge_v.length()]);

        // Normals of three of the planes through the point and an edge: low y, high y, low x. The area starts at the low x
        // side, with the angles at its two corners.
        let bottom = DVec3::new(0.0, height, -low[1]).try_normalize()?;
        let top = DVec3::new(0.0, -height, high[1]).try_normalize()?;
        let side = DVec3::new(height, 0.0, -low[0]).try_normalize()?;
        let angle = |cosine: f64| libm::acos(cosine.clamp(-1.0, 1.0));
        let start = TAU - angle(-top.dot(side)) - angle(-side.dot(bottom));

        let solid_angle = solid_angle(low, high, height);
        let usable = height < 0.0 && solid_angle >= Self::SMALLEST && start.is_finite();
        usable.then_some(Self {
            axes: [x, y, z],
            low,
            high,
            height,
            low_slope: bottom.z,
            high_slope: top.z,
            start,
            solid_angle,
        })
    }

    /// Solid angle in steradians, in (0, 2π).
    #[inline]
    pub fn solid_angle(&self) -> f32 {
        self.solid_angle as f32
    }

    /// Density per solid angle of every direction that meets the rectangle.
    #[inline]
    pub fn pdf(&self) -> f32 {
        (1.0 / self.solid_angle) as f32
    }

    /// A direction uniform by solid angle, and where it meets the rectangle.
    pub fn sample(&self, u: [f32; 2]) -> SphericalRectangleSample {
        let Self { axes, low, high, height, .. } = *self;
        // First the column x that has the share u₀ of the area to its low side.
        let (sin, cos) = libm::sincos(f64::from(u[0]) * self.solid_angle + self.start);
        let slope = (cos * self.low_slope - self.high_slope) / sin;
        let cosine = (1.0f64.copysign(slope) / (slope * slope + self.low_slope * self.low_slope).sqrt())
            .clamp(-1.0, 1.0);
        let x = (-(cosine * height) / (1.0 - cosine * cosine).sqrt()).max(low[0]).min(high[0]);
        // Then y along it, uniform in the sine of the elevation.
        let distance = (x * x + height * height).sqrt();
        let sine = |y: f64| y / (distance * distance + y * y).sqrt();
        let h = sine(low[1]) + f64::from(u[1]) * (sine(high[1]) - sine(low[1]));
        let y = (h * distance / (1.0 - h * h).sqrt()).max(low[1]).min(high[1]);

        let direction = axes[0] * x + axes[1] * y + axes[2] * height;
        SphericalRectangleSample {
            direction: direction.normalize().as_vec3(),
            position: [
                ((x - low[0]) / (high[0] - low[0])) as f32,
                ((y - low[1]) / (high[1] - low[1])) as f32,
            ],
            pdf: self.pdf(),
        }
    }
}

/// Two spherical triangles after Van Oosterom and Strackee (1983), with the triple products written out: each equals
/// height × area over the lengths.
fn solid_angle(low: [f64; 2], high: [f64; 2], height: f64) -> f64 {
    let corner = |x: f64, y: f64| DVec3::new(x, y, height);
    let [a, b, c, d] =
        [corner(low[0], low[1]), corner(high[0], low[1]), corner(high[0], high[1]), corner(low[0], high[1])];
    let volume = -height * (high[0] - low[0]) * (high[1] - low[1]);
    let triangle = |p: DVec3, q: DVec3, r: DVec3| {
        let (lp, lq, lr) = (p.length(), q.length(), r.length());
        2.0 * libm::atan2(volume, lp * lq * lr + p.dot(q) * lr + q.dot(r) * lp + r.dot(p) * lq)
    };
    triangle(a, b, c) + triangle(a, c, d)
}
