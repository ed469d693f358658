//! The GGX distribution of facet normals, Smith's masking, and sampling of the visible normals.
//!
//! Walter et al. 2007; Heitz, *Understanding the masking-shadowing function*, 2014; Dupuy and Benyoub, *Sampling visible GGX normals
//! with spherical caps*, 2023. All directions are on the upper side.

use glam::{Vec2, Vec3};
use std::f32::consts::{FRAC_1_PI, TAU};

/// Widths below this are taken as perfectly smooth.
pub(super) const SMALLEST_ALPHA: f32 = 1e-3;

/// Isotropic GGX distribution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ggx {
    alpha: f32,
}

impl Ggx {
    /// A distribution of width `alpha`, kept in 10⁻³ to 1.
    pub fn new(alpha: f32) -> Self {
        Self { alpha: alpha.clamp(SMALLEST_ALPHA, 1.0) }
    }

    /// The distribution of a perceptual roughness 0 to 1 (alpha = roughness²); `None` where it is smooth. Not a number is smooth.
    pub fn from_roughness(roughness: f32) -> Option<Self> {
        let alpha = roughness * roughness;
        (alpha >= SMALLEST_ALPHA).then(|| Self::new(alpha))
    }

    /// The width.
    pub fn alpha(&self) -> f32 {
        self.alpha
    }

    /// D(normal): area of facets per solid angle of normals and area of surface; ∫ D cos = 1.
    pub fn density(&self, normal: Vec3) -> f32 {
        let alpha2 = self.alpha * self.alpha;
        // sin² from x and y: 1 − z² has no digits left for small alpha.
        let sine2 = normal.x * normal.x + normal.y * normal.y;
        let stretched = alpha2 * normal.z * normal.z + sine2;
        FRAC_1_PI * alpha2 / (stretched * stretched)
    }

    /// cos θ (1 + 2 Λ): the stretched length that every masking term is made of; finite at grazing, where Λ is not.
    fn stretched_length(&self, direction: Vec3) -> f32 {
        let sine2 = direction.x * direction.x + direction.y * direction.y;
        (direction.z * direction.z + self.alpha * self.alpha * sine2).sqrt()
    }

    /// G₁: the visible fraction of facets seen from `direction`.
    pub fn masking(&self, direction: Vec3) -> f32 {
        2.0 * direction.z / (direction.z + self.stretched_length(direction))
    }

    /// G₂ / (cos o · cos i) with height-correlated masking 1 / (1 + Λ(o) + Λ(i)).
    pub(super) fn visibility(&self, outgoing: Vec3, incoming: Vec3) -> f32 {
        let lengths =
            incoming.z * self.stretched_length(outgoing) + outgoing.z * self.stretched_length(incoming);
        2.0 / lengths
    }

    /// G₂ / G₁(outgoing), at most 1: what a sample of the visible normals weighs at reflectance 1.
    pub fn shadowing_given_masking(&self, outgoing: Vec3, incoming: Vec3) -> f32 {
        let outgoing_length = self.stretched_length(outgoing);
        let incoming_length = self.stretched_length(incoming);
        incoming.z * (outgoing.z + outgoing_length)
            / (incoming.z * outgoing_length + outgoing.z * incoming_length)
    }

    /// D_v / (o·normal) = G₁ D / cos o: the density of visible normals, less its projection factor.
    pub(super) fn visible_density(&self, outgoing: Vec3, normal: Vec3) -> f32 {
        2.0 * self.density(normal) / (outgoing.z + self.stretched_length(outgoing))
    }

    /// Density of [`Ggx::sample_visible`] per solid angle of normals: D_v(normal).
    pub fn visible_pdf(&self, outgoing: Vec3, normal: Vec3) -> f32 {
        self.visible_density(outgoing, normal) * outgoing.dot(normal).max(0.0)
    }

    /// A normal, seen from `outgoing` (upper side), with density D_v.
    pub fn sample_visible(&self, outgoing: Vec3, u: [f32; 2]) -> Vec3 {
        let (sine, cosine) = libm::sincosf(TAU * u[0]);
        self.visible_normal(outgoing, Vec2::new(cosine, sine), u[1])
    }

    /// The visible normal at a place of the spherical cap: `around` on the unit circle, `place` from its top (0) to its rim (1).
    pub(super) fn visible_normal(&self, outgoing: Vec3, around: Vec2, place: f32) -> Vec3 {
        let stretched =
            Vec3::new(outgoing.x * self.alpha, outgoing.y * self.alpha, outgoing.z).normalize_or_zero();
        // Light reflected off the unit hemisphere is uniform on the cap above −stretched.z.
        let height = (1.0 - place) * (1.0 + stretched.z) - stretched.z;
        let radius = (1.0 - height * height).max(0.0).sqrt();
        let half = Vec3::new(radius * around.x, radius * around.y, height) + stretched;
        Vec3::new(half.x * self.alpha, half.y * self.alpha, half.z.max(0.0)).normalize_or_zero()
    }
}

#[cfg(test)]
mod tests;
