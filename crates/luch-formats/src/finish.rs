//! The last step of every import: what the file is silent about is chosen, and the scene is checked.

use crate::{LoadError, Loaded, Problem, framing_camera, neutral_sky};
use luch_image::tone::{Curve, Tone};
use luch_scene::{Environment, NamedCamera, Scene, Shape};
use std::path::Path;

/// Adds a camera and light where there are none; fails if the scene or one of its meshes has problems.
pub(crate) fn finish(path: &Path, mut loaded: Loaded) -> Result<Loaded, LoadError> {
    let scene = &mut loaded.scene;
    if scene.cameras.is_empty() {
        let (camera, bounds) = framing_camera(scene);
        scene.cameras.push(NamedCamera { name: String::new(), camera });
        loaded.notes.push(format!(
            "no camera is given: one shows everything, from above and the right (a ball of radius {} about {})",
            bounds.radius, bounds.center
        ));
    }
    if !has_light(scene) {
        let image = scene.add_image(neutral_sky());
        let scale = luch_image::Rgb::WHITE;
        scene.environment = Some(Environment::LatLong { image, scale, rotation: glam::Mat3::IDENTITY });
        // White things under it are nearly white in the picture: the curve keeps their shading.
        loaded.wishes.tone = Tone { exposure: -0.5, curve: Curve::PbrNeutral };
        loaded.notes.push("no light is given: a neutral sky lights everything".to_owned());
    }
    let mut problems = loaded.scene.problems();
    for (place, shape) in loaded.scene.shapes.iter().enumerate() {
        if let Shape::Mesh(mesh) = &**shape {
            problems.extend(mesh.validate().iter().map(|problem| format!("mesh {place}: {problem}")));
        }
    }
    if problems.is_empty() {
        Ok(loaded)
    } else {
        Err(LoadError {
            problems: problems.into_iter().map(|sentence| Problem::new(path, sentence)).collect(),
        })
    }
}

/// True if anything in the scene sends out light.
fn has_light(scene: &Scene) -> bool {
    let emits = |id: &luch_scene::Id<luch_scene::Material>| {
        scene.materials.get(id.index()).is_some_and(|material| material.emission.is_some())
    };
    scene.environment.is_some()
        || !scene.lights.is_empty()
        || scene.instances.iter().any(|instance| instance.materials.iter().any(emits))
}
