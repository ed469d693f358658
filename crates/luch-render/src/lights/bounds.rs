//! What the choice of light knows of an emitter or of a group of them: a ball that holds it, a cone of normals, its strength.

use super::build::Leaf;
use glam::Vec3;

/// A bounded emitter as the choice of light sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct LightBounds {
    /// Ball that holds it.
    pub(crate) center: Vec3,
    pub(crate) radius: f32,
    /// Unit length: axis of the cone of normals.
    pub(crate) axis: Vec3,
    /// Cosine of the cone's half-angle; −1 for all directions.
    pub(crate) cos_normals: f32,
    /// Cosine of the angle past the cone at which no light leaves any more; not negative.
    pub(crate) cos_falloff: f32,
    /// Most luminous intensity, as luminance of W·sr⁻¹: irradiance of a facing surface times squared distance.
    pub(crate) intensity: f32,
    /// True if what leaves along a direction leaves against it as well.
    pub(crate) two_sided: bool,
}

impl LightBounds {
    /// Bounds of what shines alike into all directions.
    pub(crate) fn round(center: Vec3, radius: f32, intensity: f32) -> Self {
        Self {
            center,
            radius,
            axis: Vec3::Y,
            cos_normals: -1.0,
            cos_falloff: 0.0,
            intensity,
            two_sided: false,
        }
    }

    /// Bounds of a flat lamp.
    pub(crate) fn flat(center: Vec3, radius: f32, normal: Vec3, intensity: f32, two_sided: bool) -> Self {
        Self { center, radius, axis: normal, cos_normals: 1.0, cos_falloff: 0.0, intensity, two_sided }
    }

    /// True if the emitter can be weighed at all.
    pub(crate) fn is_usable(&self) -> bool {
        self.intensity > 0.0 && self.center.is_finite() && self.radius.is_finite() && self.axis.is_finite()
    }
}

/// Cosine of the sum of two angles in [0, π] given by their cosines; −1 if the sum is more than π.
fn cos_of_sum(a: f32, b: f32) -> f32 {
    if a < -b {
        return -1.0;
    }
    let sines = ((1.0 - a * a) * (1.0 - b * b)).max(0.0).sqrt();
    (a * b - sines).clamp(-1.0, 1.0)
}

/// Bounds of a group that is not empty.
pub(crate) fn union(leaves: &[Leaf]) -> LightBounds {
    let members = || leaves.iter().map(|leaf| &leaf.bounds);
    let (mut low, mut high) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    let (mut sum, mut intensity, mut cos_falloff) = (Vec3::ZERO, 0.0, 1.0f32);
    let two_sided = members().any(|member| member.two_sided);
    let reference = leaves[0].bounds.axis;
    // Of lamps that shine to both sides, either normal will do.
    let turned = |axis: Vec3| if two_sided && axis.dot(reference) < 0.0 { -axis } else { axis };
    for member in members() {
        low = low.min(member.center - member.radius);
        high = high.max(member.center + member.radius);
        sum += turned(member.axis) * member.intensity;
        intensity += member.intensity;
        cos_falloff = cos_falloff.min(member.cos_falloff);
    }
    let center = (low + high) / 2.0;
    let axis = sum.try_normalize().unwrap_or(reference);
    let (mut radius, mut cos_normals) = (0.0f32, 1.0f32);
    for member in members() {
        radius = radius.max(center.distance(member.center) + member.radius);
        let tilt = axis.dot(member.axis);
        let tilt = if two_sided { tilt.abs() } else { tilt };
        let reach = if member.cos_normals >= 1.0 {
            tilt
        } else {
            cos_of_sum(tilt.clamp(-1.0, 1.0), member.cos_normals)
        };
        cos_normals = cos_normals.min(reach);
    }
    LightBounds { center, radius, axis, cos_normals, cos_falloff, intensity, two_sided }
}
