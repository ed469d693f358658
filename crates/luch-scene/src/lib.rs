//! What is to be drawn, as plain data.
//!
//! A [`Scene`] is a set of lists whose members point at one another by [`Id`]. Importers produce it, programs build it
//! directly, the renderer reads it. Nothing derived is kept here: no trees, no tables.
//!
//! ```
//! use glam::{Affine3A, Vec3};
//! use luch_image::Rgb;
//! use luch_scene::{Camera, Environment, Material, Scene, Shape};
//!
//! let mut scene = Scene::default();
//! let ball = scene.add_shape(Shape::Sphere { radius: 1.0 });
//! let clay = scene.add_material(Material::diffuse(Rgb::new(0.8, 0.5, 0.3)));
//! scene.add_instance(ball, clay, Affine3A::IDENTITY);
//! scene.environment = Some(Environment::Constant { radiance: Rgb::WHITE });
//! scene.add_camera(Camera::looking_at(Vec3::new(0.0, 0.0, 4.0), Vec3::ZERO, Vec3::Y, 0.6));
//! assert!(scene.problems().is_empty());
//! ```

mod camera;
mod id;
mod light;
mod material;
mod metal;
pub mod preset;
mod scene;
mod settings;
mod shape;
mod texture;
mod traced;
mod validate;

pub use camera::{Camera, Projection};
pub use id::Id;
pub use light::{Environment, Light};
pub use material::{Emission, Material, NormalMap, Opacity, Principled, Reflectance, Sides, Surface};
pub use metal::Metal;
pub use scene::{NamedCamera, Scene};
pub use settings::{Filter, Integrator, Minification, Normals, Property, Settings};
pub use shape::{Instance, Shape};
pub use texture::{Channel, ColorValue, ScalarValue, Texture, TextureFilter, TextureUse, Wrap};
pub use traced::{Frustum, Implicit, Traced};
