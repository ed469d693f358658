//! How wide a ray is: what a texture may be averaged over.

/// A cone about a ray (Akenine-Möller et al., "Improved Shader and Texture Level of Detail Using Ray Cones", 2021). It never
/// changes where a ray goes, only how finely textures are read where it arrives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cone {
    /// Diameter where the ray starts, metres.
    pub width: f32,
    /// By how much the diameter grows with each metre; 0 or more.
    pub spread: f32,
}

impl Cone {
    /// The cone of light that was scattered by a surface that is no mirror: the lobe is far wider than this.
    pub const SCATTERED: Self = Self { width: 0.0, spread: 0.05 };

    /// The diameter at a distance.
    pub fn at(&self, distance: f32) -> f32 {
        self.width + self.spread * distance
    }

    /// The cone past a flat mirror or window at a distance.
    pub(crate) fn passed_on(&self, distance: f32) -> Self {
        Self { width: self.at(distance), ..*self }
    }
}
