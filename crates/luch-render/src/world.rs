//! A scene plus what is derived from it.

use crate::bsdf::ConductorFresnel;
use crate::footprint::Pyramids;
use crate::geometry::Geometry;
use crate::lights::Lights;
use crate::material::metals;
use crate::plain::Plain;
use luch_scene::Scene;
use std::sync::Arc;

/// A scene ready to be rendered: the description, trees over it, and a table of its lights.
#[derive(Debug)]
pub struct World {
    /// What is drawn.
    pub scene: Arc<Scene>,
    /// What can be hit.
    pub geometry: Geometry,
    /// What shines.
    pub lights: Lights,
    /// For each material the reflectance of its metal.
    pub(crate) metals: Vec<Option<ConductorFresnel>>,
    /// What can be shaded side by side.
    pub(crate) plain: Plain,
    /// Textures from afar.
    pub(crate) pyramids: Pyramids,
}

impl World {
    /// Builds trees and tables, on the threads of the current pool.
    ///
    /// # Errors
    /// The scene's [`problems`](Scene::problems), if it has any.
    pub fn build(scene: impl Into<Arc<Scene>>) -> Result<Self, UnsoundScene> {
        let scene = scene.into();
        let problems = scene.problems();
        if !problems.is_empty() {
            return Err(UnsoundScene { problems });
        }
        let geometry = Geometry::build(&scene);
        let lights = Lights::build(&scene);
        let metals = metals(&scene);
        let plain = Plain::new(&scene);
        let pyramids = Pyramids::build(&scene);
        Ok(Self { scene, geometry, lights, metals, plain, pyramids })
    }
}

/// A scene that cannot be rendered.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the scene cannot be rendered: {}", .problems.join("; "))]
pub struct UnsoundScene {
    /// What is wrong with it, at least one sentence.
    pub problems: Vec<String>,
}
