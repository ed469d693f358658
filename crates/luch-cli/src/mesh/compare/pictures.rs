//! The same picture of a form and of its meshes: one camera, one light, the same random numbers.

use crate::failure::Failure;
use glam::Affine3A;
use luch::image::{Image, Rgb};
use luch::mesh::{TriangleMesh, measure};
use luch::prelude::*;
use luch::preview::{StandardView, frame_all};
use luch::scene::Environment;
use std::sync::atomic::AtomicU64;

/// Pixels of a side.
const SIDE: u32 = 256;

/// Samples of a pixel.
const SAMPLES: u64 = 16;

/// Where things are looked at.
pub(super) struct Stage {
    camera: Camera,
}

impl Stage {
    /// A view of all of a mesh.
    pub(super) fn around(mesh: &TriangleMesh) -> Self {
        let bounds = measure::bounds(mesh);
        Self { camera: frame_all(&bounds, StandardView::ThreeQuarter.direction(), 0.6, 1.0) }
    }

    /// A picture of a shape of clay under the neutral sky.
    pub(super) fn picture(&self, shape: Shape) -> Result<Image<Rgb>, Failure> {
        let mut scene = Scene::default();
        (scene.settings.width, scene.settings.height) = (SIDE, SIDE);
        let shape = scene.add_shape(shape);
        let material = scene.add_material(Material::diffuse(Rgb::gray(0.6)));
        scene.add_instance(shape, material, Affine3A::IDENTITY);
        let image = scene.add_image(luch::formats::neutral_sky());
        let rotation = glam::Mat3::IDENTITY;
        scene.environment = Some(Environment::LatLong { image, scale: Rgb::gray(1.0), rotation });
        scene.add_camera(self.camera);
        let view = View::new(&self.camera, &scene.settings);
        let world = World::build(scene)?;
        let mut film = Film::new(view.width(), view.height());
        let seen = AtomicU64::new(0);
        render_pass(&world, &view, &PathTracer::default(), &mut film, 0..SAMPLES, &Stop::new(), &seen)?;
        Ok(film.to_image())
    }
}

/// The form itself and its meshes in a row, and below them eight times what differs.
pub(super) fn sheet(exact: &Image<Rgb>, meshes: &[Image<Rgb>]) -> Image<Rgb> {
    let columns = meshes.len() as u32 + 1;
    let mut sheet = Image::filled(columns * SIDE, 2 * SIDE, Rgb::gray(0.0));
    let width = sheet.width() as usize;
    let mut put = |column: u32, row: u32, value: &dyn Fn(usize) -> Rgb| {
        for place in 0..(SIDE * SIDE) as usize {
            let (x, y) = (place % SIDE as usize, place / SIDE as usize);
            let at = ((row * SIDE) as usize + y) * width + (column * SIDE) as usize + x;
            sheet.pixels_mut()[at] = value(place);
        }
    };
    put(0, 0, &|place| exact.pixels()[place]);
    for (column, mesh) in (1..).zip(meshes) {
        put(column, 0, &|place| mesh.pixels()[place]);
        put(column, 1, &|place| {
            let (a, b) = (mesh.pixels()[place], exact.pixels()[place]);
            Rgb::new((a.r - b.r).abs(), (a.g - b.g).abs(), (a.b - b.b).abs()) * 8.0
        });
    }
    sheet
}
