//! The scene: lists of things that point at one another by place.

use crate::{Camera, Environment, Id, Instance, Light, Material, Settings, Shape, Texture};
use luch_image::Bitmap;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// All that is to be drawn, as plain data: no file names, no units other than metres, radians and watts, nothing derived.
///
/// What is large, shapes and pictures, may be shared with other scenes: copies of a scene hold it once.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Scene {
    /// Forms, each in its own coordinates.
    pub shapes: Vec<Arc<Shape>>,
    /// Surfaces.
    pub materials: Vec<Material>,
    /// Patterns and pictures as materials use them.
    pub textures: Vec<Texture>,
    /// Decoded pictures.
    pub images: Vec<Arc<Bitmap>>,
    /// Shapes put into the world.
    pub instances: Vec<Instance>,
    /// Lamps without a surface.
    pub lights: Vec<Light>,
    /// What surrounds everything.
    pub environment: Option<Environment>,
    /// Eyes; the first is used unless another is asked for.
    pub cameras: Vec<NamedCamera>,
    /// How the picture is to be made.
    pub settings: Settings,
}

/// A camera that can be asked for by name.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct NamedCamera {
    /// May be empty.
    pub name: String,
    /// The eye.
    pub camera: Camera,
}

/// Appends to a list and returns the place.
fn push<T>(list: &mut Vec<T>, thing: T) -> Id<T> {
    let id = next(list.len());
    list.push(thing);
    id
}

/// Appends something that is perhaps shared.
fn shared<T>(list: &mut Vec<Arc<T>>, thing: Arc<T>) -> Id<T> {
    let id = next(list.len());
    list.push(thing);
    id
}

/// The id of what is added to a list of `length`.
fn next<T>(length: usize) -> Id<T> {
    Id::new(u32::try_from(length).expect("fewer than 2^32 things in a list"))
}

impl Scene {
    /// Adds a shape.
    pub fn add_shape(&mut self, shape: impl Into<Arc<Shape>>) -> Id<Shape> {
        shared(&mut self.shapes, shape.into())
    }

    /// Adds a material.
    pub fn add_material(&mut self, material: Material) -> Id<Material> {
        push(&mut self.materials, material)
    }

    /// Adds a texture.
    pub fn add_texture(&mut self, texture: Texture) -> Id<Texture> {
        push(&mut self.textures, texture)
    }

    /// Adds a picture.
    pub fn add_image(&mut self, image: impl Into<Arc<Bitmap>>) -> Id<Bitmap> {
        shared(&mut self.images, image.into())
    }

    /// Puts a shape of one material into the world.
    pub fn add_instance(&mut self, shape: Id<Shape>, material: Id<Material>, placement: glam::Affine3A) {
        self.instances.push(Instance { name: String::new(), shape, materials: vec![material], placement });
    }

    /// Adds a camera without a name.
    pub fn add_camera(&mut self, camera: Camera) {
        self.cameras.push(NamedCamera { name: String::new(), camera });
    }

    /// The first camera, or the one called `name`.
    pub fn camera(&self, name: Option<&str>) -> Option<&Camera> {
        let wanted = |named: &&NamedCamera| name.is_none_or(|name| named.name == name);
        self.cameras.iter().find(wanted).map(|named| &named.camera)
    }
}
