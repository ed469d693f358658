//! What is known of pictures beyond single radiances: visible parts, edges under filters, placements, shading normals, halves of lamps.

mod analytic {
    pub(crate) mod fractions;
    pub(crate) mod halves;
    pub(crate) mod picture;
    pub(crate) mod placement;
    pub(crate) mod shading;

    use glam::Vec3;
    use luch_render::{PixelEstimate, Stop, World};
    use luch_scene::{Camera, Integrator, Scene, Settings};

    /// The world of a scene. It must have a camera, whichever is used to look.
    pub(crate) fn world(mut scene: Scene) -> World {
        if scene.cameras.is_empty() {
            scene.add_camera(Camera::looking_at(Vec3::ZERO, Vec3::X, Vec3::Y, 1.0));
        }
        World::build(scene).expect("the scene is sound")
    }

    /// Renders a film; its pixels, row by row.
    pub(crate) fn render(
        world: &World,
        camera: &Camera,
        settings: &Settings,
        way: Integrator,
        samples: u64,
    ) -> Vec<PixelEstimate> {
        luch_lab::truth::measure::render(world, camera, settings, way, samples, &Stop::new()).unwrap()
    }
}
