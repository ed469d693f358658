//! What people call the things of a scene.

use luch::render::LightSource;
use luch::scene::{Id, Light, Material, Scene, Shape};

/// The object of an instance: its name, else its shape and number.
pub fn object_name(scene: &Scene, instance: u32) -> String {
    let Some(instance_of) = scene.instances.get(instance as usize) else {
        return format!("object {instance}");
    };
    if !instance_of.name.is_empty() {
        return instance_of.name.clone();
    }
    let shape = match &*scene.shapes[instance_of.shape.index()] {
        Shape::Mesh(_) => "mesh",
        Shape::Sphere { .. } => "sphere",
        Shape::Disc { .. } => "disc",
        Shape::Plane => "plane",
        Shape::Traced(_) => "form",
    };
    format!("{shape} {instance}")
}

/// A material: its name, else its number.
pub fn material_name(scene: &Scene, material: Id<Material>) -> String {
    match scene.materials.get(material.index()) {
        Some(found) if !found.name.is_empty() => found.name.clone(),
        _ => format!("material {}", material.index()),
    }
}

/// Where light is from.
pub fn light_name(scene: &Scene, source: Option<LightSource>) -> String {
    match source {
        None => "several lights beyond the scene".into(),
        Some(LightSource::Environment) => "environment".into(),
        Some(LightSource::Instance(instance)) => object_name(scene, instance),
        Some(LightSource::Lamp(number)) => match scene.lights.get(number as usize) {
            Some(Light::Point { .. }) => format!("point light {number}"),
            Some(Light::Spot { .. }) => format!("spot light {number}"),
            Some(Light::Sun { .. }) => format!("sun {number}"),
            None => format!("light {number}"),
        },
    }
}
