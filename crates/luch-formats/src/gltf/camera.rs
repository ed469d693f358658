//! Cameras, and the shape of the picture that they ask for.

use super::Import;
use super::json::Json;
use crate::Problem;
use glam::{Affine3A, DAffine3, Mat3, Vec3};
use luch_scene::{Camera, NamedCamera, Projection};

/// Aspect ratios that the picture follows.
const SENSIBLE_ASPECTS: std::ops::RangeInclusive<f64> = 0.1..=10.0;

/// A projection and the width over the height that was meant.
struct View {
    projection: Projection,
    aspect: Option<f64>,
}

impl Import<'_> {
    /// Adds the camera of a node. The first camera's aspect ratio makes the picture's width; its height stays.
    pub(super) fn place_camera(
        &mut self,
        node: &Json,
        reference: &Json,
        world: DAffine3,
    ) -> Result<(), Problem> {
        let json = self.document.cameras.at(reference.reference(&self.document.cameras)?);
        let Some(view) = self.view(&json)? else { return Ok(()) };
        let placement = Affine3A::from_mat3_translation(world.matrix3.as_mat3(), world.translation.as_vec3());
        let camera = Camera {
            position: Vec3::ZERO,
            orientation: Mat3::IDENTITY,
            projection: view.projection,
            lens_radius: 0.0,
            focus_distance: 1.0,
        }
        .placed(&placement);
        if !camera.position.is_finite() || !camera.orientation.is_finite() {
            self.notices.add(node.path(), "a camera whose transform is not finite is left out");
            return Ok(());
        }
        if let (true, Some(aspect)) = (self.scene.cameras.is_empty(), view.aspect) {
            self.set_aspect(&json, aspect);
        }
        // Cameras are asked for by their own name; the node's tells two uses of one camera apart.
        let own = json.name()?;
        let name = if own.is_empty() || !self.camera_names.insert(own.clone()) { node.name()? } else { own };
        self.scene.cameras.push(NamedCamera { name, camera });
        Ok(())
    }

    fn view(&mut self, json: &Json) -> Result<Option<View>, Problem> {
        let kind = json.need("type")?;
        let view = match kind.text()? {
            "perspective" => {
                let perspective = json.need("perspective")?;
                let field_of_view_y = perspective.need("yfov")?.number()? as f32;
                let aspect = perspective.get("aspectRatio")?.map(|aspect| aspect.number()).transpose()?;
                let is_sound = field_of_view_y > 0.0 && field_of_view_y < std::f32::consts::PI;
                is_sound.then_some(View { projection: Projection::Perspective { field_of_view_y }, aspect })
            }
            "orthographic" => {
                let orthographic = json.need("orthographic")?;
                let [x, y] = ["xmag", "ymag"].map(|key| orthographic.need(key)?.number());
                let (x, y) = (x?.abs(), y?.abs());
                let height = 2.0 * y as f32;
                let is_sound = height > 0.0 && height.is_finite();
                is_sound
                    .then_some(View { projection: Projection::Orthographic { height }, aspect: Some(x / y) })
            }
            other => {
                return Err(
                    kind.problem(format!("is \"{other}\", expected \"perspective\" or \"orthographic\""))
                );
            }
        };
        if view.is_none() {
            let message =
                "a camera that sees nothing, or half the world (0 < yfov < π, ymag ≠ 0), is left out";
            self.notices.add(json.path(), message);
        }
        Ok(view)
    }

    fn set_aspect(&mut self, json: &Json, aspect: f64) {
        if !SENSIBLE_ASPECTS.contains(&aspect) {
            let message =
                format!("the aspect ratio {aspect} is not within 0.1 to 10; the picture keeps its shape");
            self.notices.add(json.path(), message);
            return;
        }
        let settings = &mut self.scene.settings;
        settings.width = (f64::from(settings.height) * aspect).round().max(1.0) as u32;
    }
}
