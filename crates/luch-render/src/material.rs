//! A material at a point of a surface becomes a small BSDF.

use crate::bsdf::{
    Bsdf, Conductor, ConductorFresnel, Dielectric, Diffuse, Glossy, Phong, Principled, PrincipledParameters,
};
use crate::place::Place;
use crate::purpose;
use crate::surface::SurfacePoint;
use crate::world::World;
use luch_image::Rgb;
use luch_sampling::Sampler;
use luch_scene::{Id, Material, Reflectance, Scene, Surface};

/// How the surface scatters light at `point`. A mixture is decided here, by the numbers of `bounce`.
pub fn bsdf_at(world: &World, point: &SurfacePoint, sampler: &Sampler, bounce: u32) -> Bsdf {
    let place = &point.seen(&world.pyramids);
    let id = unmixed(place, point.material, sampler, bounce);
    match &world.scene.materials[id.index()].surface {
        Surface::Absorber | Surface::Mix { .. } => Bsdf::Absorber,
        Surface::Diffuse { color } => Bsdf::Diffuse(Diffuse::new(bounded(place.color(color)))),
        Surface::Conductor { reflectance, roughness, compensated } => {
            let fresnel = match reflectance {
                Reflectance::Color(color) => ConductorFresnel::from_color(bounded(place.color(color))),
                Reflectance::Metal(_) | Reflectance::Index { .. } => {
                    world.metals[id.index()].expect("a world holds the reflectance of every metal")
                }
            };
            let conductor = Conductor::new(fresnel, unit(place.scalar(roughness)));
            Bsdf::Conductor(if *compensated { conductor } else { conductor.uncompensated() })
        }
        Surface::Dielectric { ior, roughness, tint } => {
            let tint = bounded(place.color(tint));
            Bsdf::Dielectric(Dielectric::new(*ior, unit(place.scalar(roughness)), tint))
        }
        Surface::Principled(principled) => Bsdf::Principled(Principled::new(PrincipledParameters {
            base_color: bounded(place.color(&principled.base_color)),
            metallic: unit(place.scalar(&principled.metallic)),
            roughness: unit(place.scalar(&principled.roughness)),
            ior: principled.ior,
            transmission: unit(place.scalar(&principled.transmission)),
            thin_walled: principled.thin_walled,
            specular: unit(place.scalar(&principled.specular)),
            specular_color: place.color(&principled.specular_color).map(|v| v.max(0.0)),
        })),
        Surface::Phong { diffuse, specular, exponent } => {
            let (diffuse, specular) = (bounded(place.color(diffuse)), bounded(place.color(specular)));
            // Textures may add up to more than all the light there is.
            let sum = (diffuse + specular).max_channel().max(1.0);
            Bsdf::Phong(Phong::new(diffuse / sum, specular / sum, place.scalar(exponent).max(0.0)))
        }
        Surface::Glossy { color, glossiness } => {
            Bsdf::Glossy(Glossy::new(bounded(place.color(color)), unit(place.scalar(glossiness))))
        }
    }
}

/// The material whose surface counts: of a mixture, one of its parts at random.
fn unmixed(place: &Place, material: Id<Material>, sampler: &Sampler, bounce: u32) -> Id<Material> {
    let scene = place.scene;
    let mut id = material;
    let mut depth = 0;
    let mut chances = sampler.group(purpose::mix(bounce));
    // Parts stand before their mixture, so this ends.
    while let Surface::Mix { first, second, weight } = &scene.materials[id.index()].surface {
        // What is left of a number after a decision is uniform again: deeper mixtures go on with it.
        let chance = &mut chances[depth & 3];
        let weight = unit(place.scalar(weight));
        if *chance < weight {
            *chance /= weight;
            id = *second;
        } else {
            *chance = (*chance - weight) / (1.0 - weight);
            id = *first;
        }
        depth += 1;
    }
    id
}

/// The radiance that the point sends toward the viewer by itself.
pub fn emitted(point: &SurfacePoint) -> Rgb {
    let scene = point.place.scene;
    match &scene.materials[point.material.index()].emission {
        Some(emission) if emission.two_sided || point.is_front() => {
            point.place.color(&emission.radiance).map(|v| v.max(0.0))
        }
        _ => Rgb::BLACK,
    }
}

/// For each material the reflectance of its metal, if it is one with an index of refraction.
pub(crate) fn metals(scene: &Scene) -> Vec<Option<ConductorFresnel>> {
    let metal = |material: &Material| match &material.surface {
        Surface::Conductor { reflectance: Reflectance::Metal(metal), .. } => {
            Some(ConductorFresnel::from_index(metal.eta(), metal.k()))
        }
        Surface::Conductor { reflectance: Reflectance::Index { eta, k }, .. } => {
            Some(ConductorFresnel::from_index(*eta, *k))
        }
        _ => None,
    };
    scene.materials.iter().map(metal).collect()
}

/// A number from a texture, kept between 0 and 1; NaN is 0.
fn unit(value: f32) -> f32 {
    if value > 0.0 { value.min(1.0) } else { 0.0 }
}

/// A colour from a texture, kept between 0 and 1.
fn bounded(color: Rgb) -> Rgb {
    color.map(unit)
}
