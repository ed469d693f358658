//! Lights at infinite distance, weighed by the irradiance they would bring if nothing stood in the way.

use glam::Vec3;

/// A light at infinite distance that can be sampled.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DistantLight {
    pub(crate) emitter: u32,
    /// As luminance, of a surface that faces it.
    pub(crate) irradiance: f32,
    /// Where it stands; zero for what surrounds everything.
    pub(crate) direction: Vec3,
    /// Sine and cosine of its angular radius.
    pub(crate) angle: [f32; 2],
}

impl DistantLight {
    /// About the irradiance of a receiver; zero only if no light can arrive.
    #[inline(always)]
    fn importance(&self, normal: Vec3) -> f32 {
        if normal == Vec3::ZERO || self.direction == Vec3::ZERO {
            return self.irradiance;
        }
        let [sine, cosine] = self.angle;
        let up = self.direction.dot(normal);
        let up = if up >= cosine { 1.0 } else { up * cosine + (1.0 - up * up).max(0.0).sqrt() * sine };
        self.irradiance * up.max(0.0)
    }
}

/// All of them.
#[derive(Debug, Default)]
pub(crate) struct DistantLights(pub(crate) Vec<DistantLight>);

/// One that was picked among the distant lights.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PickedDistant {
    pub(crate) emitter: u32,
    pub(crate) probability: f64,
}

impl DistantLights {
    /// About the irradiance of a receiver from all of them.
    #[inline(always)]
    pub(crate) fn irradiance(&self, normal: Vec3) -> f64 {
        self.0.iter().map(|light| f64::from(light.importance(normal))).sum()
    }

    /// Picks one by a number in [0, 1), where `total` is their irradiance.
    #[inline(always)]
    pub(crate) fn pick(&self, total: f64, normal: Vec3, choice: f64) -> Option<PickedDistant> {
        let target = (choice * total).min(total.next_down());
        let mut end = 0.0;
        for light in &self.0 {
            let importance = f64::from(light.importance(normal));
            end += importance;
            if end > target {
                return Some(PickedDistant { emitter: light.emitter, probability: importance / total });
            }
        }
        None
    }

    /// The chance of an emitter; zero if it is not one of these.
    #[inline(always)]
    pub(crate) fn probability(&self, emitter: u32, total: f64, normal: Vec3) -> f64 {
        let light = self.0.iter().find(|light| light.emitter == emitter);
        light.map_or(0.0, |light| f64::from(light.importance(normal)) / total)
    }
}
