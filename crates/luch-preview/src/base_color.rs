//! The one colour that stands for a material.

use crate::surface::Spot;
use luch_image::Rgb;
use luch_scene::{Material, Reflectance, Surface};

/// Of meshes without a material.
const CLAY: Rgb = Rgb::gray(0.6);

/// Mixtures stand after their parts; one that does not is cut off here.
const DEEPEST_MIXTURE: u32 = 8;

impl Spot<'_> {
    /// What is seen of the surface under white light, 0 to 1; of a lamp its own colour.
    pub(crate) fn base_color(&self) -> Rgb {
        let color = match self.material() {
            Some(material) => self.material_color(material),
            None => self.vertex_color().map_or(CLAY, |color| Rgb::new(color.x, color.y, color.z)),
        };
        // Comparisons in this form turn what is no number into black.
        color.map(|v| if v > 0.0 { v.min(1.0) } else { 0.0 })
    }

    fn material_color(&self, material: &Material) -> Rgb {
        if let Some(emission) = &material.emission {
            let light = self.color(&emission.radiance);
            let brightest = light.max_channel();
            if brightest > 0.0 {
                return light / brightest.max(1.0);
            }
        }
        self.surface_color(&material.surface, 0)
    }

    fn surface_color(&self, surface: &Surface, depth: u32) -> Rgb {
        match surface {
            Surface::Absorber => Rgb::BLACK,
            Surface::Diffuse { color } | Surface::Glossy { color, .. } => self.color(color),
            Surface::Conductor { reflectance, .. } => match reflectance {
                Reflectance::Metal(metal) => facing_reflectance(metal.eta(), metal.k()),
                Reflectance::Index { eta, k } => facing_reflectance(*eta, *k),
                Reflectance::Color(color) => self.color(color),
            },
            Surface::Dielectric { tint, .. } => self.color(tint),
            Surface::Principled(principled) => self.color(&principled.base_color),
            Surface::Phong { diffuse, specular, .. } => self.color(diffuse) + self.color(specular),
            Surface::Mix { first, second, weight } => {
                let weight = self.scalar(weight).clamp(0.0, 1.0);
                let part = |id: &luch_scene::Id<Material>| {
                    let material = self.seen.subject.scene?.materials.get(id.index())?;
                    (depth < DEEPEST_MIXTURE).then(|| self.surface_color(&material.surface, depth + 1))
                };
                let [first, second] = [first, second].map(|id| part(id).unwrap_or(CLAY));
                first.lerp(second, weight)
            }
        }
    }
}

/// Fresnel's reflectance at normal incidence, of the index η + i k.
fn facing_reflectance(eta: Rgb, k: Rgb) -> Rgb {
    let one = |eta: f32, k: f32| {
        let (less, more) = (eta - 1.0, eta + 1.0);
        (less * less + k * k) / (more * more + k * k)
    };
    Rgb::new(one(eta.r, k.r), one(eta.g, k.g), one(eta.b, k.b))
}
