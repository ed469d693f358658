//! A triangle as seen from a point, sampled uniformly by solid angle.

use glam::{DVec3, Vec3};

/// A triangle projected on the unit sphere about a point.
///
/// Arvo, "Stratified sampling of spherical triangles" (1995), with the solid angle after Van Oosterom and Strackee (1983)
/// and every cosine difference replaced by a form that does not cancel (half-angle tangents along the edge, heights instead
/// of cosines). It is computed in double precision and holds from solid angles of 10⁻¹⁸ sr to nearly the half sphere.
#[derive(Clone, Copy, Debug)]
pub struct SphericalTriangle {
    /// Corners relative to the point.
    corners: [DVec3; 3],
    /// Unit vectors to the first two corners.
    towards: [DVec3; 2],
    /// Unit tangent at the first corner towards the third, on the sphere.
    tangent: DVec3,
    /// Sine and cosine of the angle at the first corner.
    sin_angle: f64,
    cos_angle: f64,
    /// Tangent of half the edge from the first to the second corner.
    half_edge: f64,
    solid_angle: f64,
}

/// A direction towards a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SphericalTriangleSample {
    /// From the point to the triangle; unit length.
    pub direction: Vec3,
    /// Weights of the three corners at the place the direction meets; not negative, adding to one.
    pub barycentrics: Vec3,
    /// Density per solid angle: one over the solid angle.
    pub pdf: f32,
}

impl SphericalTriangle {
    /// Below this, in steradians, rounding of the corners matters; sampling by area is then as good.
    const SMALLEST: f64 = 1e-18;

    /// The triangle with these corners as seen from `point`, from either side.
    ///
    /// `None` when there is nothing to see: no area, the point in its plane or at a corner, coordinates that are not
    /// finite, or a solid angle below 10⁻¹⁸ sr. Then sample the triangle by area (or not at all).
    pub fn new(point: Vec3, corners: [Vec3; 3]) -> Option<Self> {
        let corners = corners.map(|corner| corner.as_dvec3() - point.as_dvec3());
        let [Some(a), Some(b), Some(c)] = corners.map(DVec3::try_normalize) else { return None };
        // Products of small differences keep their digits where products of unit vectors would not.
        let (edge_b, edge_c) = (b - a, c - a);
        let across_b = a.cross(edge_b);
        let across_c = a.cross(edge_c);
        let volume = a.dot(edge_b.cross(edge_c)).abs();
        let solid_angle = 2.0 * libm::atan2(volume, 1.0 + a.dot(b) + b.dot(c) + c.dot(a));
        let (sin_angle, cos_angle) = (volume, across_b.dot(across_c));
        let scale = (sin_angle * sin_angle + cos_angle * cos_angle).sqrt();
        let tangent = across_c.cross(a).try_normalize()?;
        let half_edge = (edge_b.length_squared() / (a + b).length_squared()).sqrt();
        let usable = solid_angle >= Self::SMALLEST && solid_angle.is_finite() && half_edge.is_finite();
        (usable && scale > 0.0).then(|| Self {
            corners,
            towards: [a, b],
            tangent,
            sin_angle: sin_angle / scale,
            cos_angle: cos_angle / scale,
            half_edge,
            solid_angle,
        })
    }

    /// Solid angle in steradians, in (0, 2π).
    #[inline]
    pub fn solid_angle(&self) -> f32 {
        self.solid_angle as f32
    }

    /// Density per solid angle of every direction that meets the triangle.
    #[inline]
    pub fn pdf(&self) -> f32 {
        (1.0 / self.solid_angle) as f32
    }

    /// A direction uniform by solid angle, and where it meets the triangle.
    pub fn sample(&self, u: [f32; 2]) -> SphericalTriangleSample {
        let [a, b] = self.towards;
        // Cut off the sub-triangle a, b, third with the share u₀ of the area. The half-angle formula
        // tan(area/2) = tan(b/2)·tan(c/2)·sin α / (1 + tan(b/2)·tan(c/2)·cos α) gives the tangent of half its edge.
        let half_area = 0.5 * f64::from(u[0]) * self.solid_angle;
        let (sin_area, cos_area) = libm::sincos(half_area);
        let rise = sin_area;
        let run = (self.sin_angle * cos_area - self.cos_angle * sin_area).max(0.0) * self.half_edge;
        let scale = 1.0 / (rise * rise + run * run);
        let third = a * ((run * run - rise * rise) * scale) + self.tangent * (2.0 * rise * run * scale);
        // A point of the arc from b to the third corner, uniform in height above b.
        let height = f64::from(u[1]) * 0.5 * (third - b).length_squared();
        let tangent = b.cross(third - b).cross(b).normalize_or_zero();
        let direction = b * (1.0 - height) + tangent * (height * (2.0 - height)).max(0.0).sqrt();
        SphericalTriangleSample {
            direction: direction.as_vec3().normalize_or(b.as_vec3()),
            barycentrics: self.barycentrics(direction),
            pdf: self.pdf(),
        }
    }

    /// Where a direction meets the plane of the triangle, kept inside.
    fn barycentrics(&self, direction: DVec3) -> Vec3 {
        let [a, b, c] = self.corners;
        let (edge_b, edge_c) = (b - a, c - a);
        let p = direction.cross(edge_c);
        let determinant = edge_b.dot(p);
        let second = share(-a.dot(p) / determinant, 1.0);
        let third = share(direction.dot((-a).cross(edge_b)) / determinant, 1.0 - second);
        Vec3::new((1.0 - second - third) as f32, second as f32, third as f32).max(Vec3::ZERO)
    }
}

/// A quotient kept between zero and `most`; zero when it is not a number.
fn share(quotient: f64, most: f64) -> f64 {
    if quotient.is_nan() { 0.0 } else { quotient.clamp(0.0, most) }
}
