//! Two scenes: a plain one, and one of everything the renderer knows.

use glam::{Affine3A, Mat3, Vec2, Vec3};
use luch::image::{Bitmap, Encoding, Pixels, Rgb};
use luch::mesh::{Attribute, generate};
use luch::prelude::*;
use luch::scene::preset::{cornell_box, parallelogram};
use luch::scene::{
    Channel, ColorValue, Environment, Filter, Light, Metal, NormalMap, Opacity, Principled, Reflectance,
    ScalarValue, Surface, Texture, TextureFilter, TextureUse, Wrap,
};
use std::sync::Arc;

/// What is rendered.
pub(crate) struct Subject {
    pub(crate) name: &'static str,
    pub(crate) world: World,
    pub(crate) view: View,
}

impl Subject {
    fn new(name: &'static str, scene: impl Into<Arc<Scene>>) -> Self {
        let scene = scene.into();
        let view = View::new(&scene.cameras[0].camera, &scene.settings);
        Self { name, view, world: World::build(scene).expect("a sound scene") }
    }

    /// The same with all that is derived made anew.
    pub(crate) fn rebuilt(&self) -> Self {
        Self::new(self.name, Arc::clone(&self.world.scene))
    }

    /// The same with other settings.
    pub(crate) fn with(&self, change: impl FnOnce(&mut Settings)) -> Self {
        let mut scene = Scene::clone(&self.world.scene);
        change(&mut scene.settings);
        Self::new(self.name, scene)
    }
}

/// Sizes are no multiples of the tile's.
pub(crate) fn subjects() -> [Subject; 2] {
    let mut cornell = cornell_box();
    (cornell.settings.width, cornell.settings.height) = (40, 36);
    [Subject::new("cornell", cornell), Subject::new("everything", everything())]
}

/// A picture of 8 × 8 coloured pixels with a mottled alpha, laid on by uv set 0.
fn picture(scene: &mut Scene, encoding: Encoding, pixel: impl Fn(u8) -> [u8; 4]) -> TextureUse {
    let pixels = Pixels::U8((0..64).map(pixel).collect());
    let image = scene.add_image(Bitmap { width: 8, height: 8, pixels, encoding, has_alpha: true });
    let wrap = [Wrap::Repeat, Wrap::Mirror];
    TextureUse::new(scene.add_texture(Texture::Image {
        image,
        encoding,
        wrap,
        filter: TextureFilter::Bilinear,
    }))
}

/// The materials of [`everything`], by what they are for.
struct Palette {
    floor: luch::scene::Id<Material>,
    glass: luch::scene::Id<Material>,
    gold: luch::scene::Id<Material>,
    leaf: luch::scene::Id<Material>,
    plastic: luch::scene::Id<Material>,
    mixed: luch::scene::Id<Material>,
    lamp: luch::scene::Id<Material>,
}

fn palette(scene: &mut Scene) -> Palette {
    let colors =
        picture(scene, Encoding::Srgb, |i| [i * 4, 255 - i * 3, i.wrapping_mul(53), i.wrapping_mul(37)]);
    let bumps = picture(scene, Encoding::Linear, |i| [100 + i % 8 * 8, 160 - i / 8 * 8, 240, 255]);
    let checker = scene.add_texture(Texture::Checker { even: Rgb::gray(0.8), odd: Rgb::new(0.2, 0.3, 0.6) });
    let mut leaf = Material::diffuse(Rgb::new(0.3, 0.7, 0.2));
    leaf.opacity = Opacity::Blend { alpha: ScalarValue::textured(colors, Channel::Alpha) };
    let mut plastic = Material::new(Surface::Principled(Principled {
        base_color: ColorValue::textured(colors),
        ..Principled::default()
    }));
    plastic.normal_map = Some(NormalMap { texture: bumps, scale: 0.8 });
    let floor = ColorValue::textured(TextureUse::new(checker));
    let tint = Rgb::new(0.9, 1.0, 0.95).into();
    let gold = Reflectance::Metal(Metal::Gold);
    let floor = scene.add_material(Material::new(Surface::Diffuse { color: floor }));
    let glass =
        scene.add_material(Material::new(Surface::Dielectric { ior: 1.5, roughness: 0.0.into(), tint }));
    let gold = scene.add_material(Material::new(Surface::Conductor {
        reflectance: gold,
        roughness: 0.3.into(),
        compensated: true,
    }));
    let (leaf, plastic) = (scene.add_material(leaf), scene.add_material(plastic));
    let mixed = Surface::Mix { first: plastic, second: gold, weight: 0.4.into() };
    let mixed = scene.add_material(Material::new(mixed));
    let lamp = scene.add_material(Material::emitter(Rgb::new(6.0, 5.0, 4.0)));
    Palette { floor, glass, gold, leaf, plastic, mixed, lamp }
}

fn everything() -> Scene {
    let mut scene = Scene::default();
    let use_of = palette(&mut scene);
    let plane = scene.add_shape(Shape::Plane);
    let torus = scene.add_shape(Shape::Mesh(generate::torus(0.5, 0.2, 32, 16)));
    let ball = scene.add_shape(Shape::Sphere { radius: 0.4 });
    let mut sheet = parallelogram(Vec3::new(-0.5, 0.0, 0.0), Vec3::X, Vec3::Y);
    sheet.uv_sets = vec![Attribute::per_position(vec![Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y])];
    let sheet = scene.add_shape(Shape::Mesh(sheet));
    let at = |x: f32, y: f32, z: f32| Affine3A::from_translation(Vec3::new(x, y, z));
    scene.add_instance(plane, use_of.floor, Affine3A::IDENTITY);
    scene.add_instance(torus, use_of.mixed, at(-0.7, 0.4, 0.0) * Affine3A::from_rotation_x(1.0));
    scene.add_instance(
        torus,
        use_of.plastic,
        at(0.6, 0.3, -0.8) * Affine3A::from_scale(Vec3::new(1.0, -0.7, 0.9)),
    );
    scene.add_instance(ball, use_of.glass, at(0.4, 0.4, 0.5));
    scene.add_instance(
        ball,
        use_of.gold,
        at(-0.3, 0.4, 0.9) * Affine3A::from_scale(Vec3::new(0.5, 1.0, 0.5)),
    );
    scene.add_instance(sheet, use_of.leaf, at(0.9, 0.0, 0.9));
    scene.add_instance(sheet, use_of.lamp, at(0.0, 2.2, 0.0) * Affine3A::from_rotation_x(1.5));
    scene.lights = vec![
        Light::Point { position: Vec3::new(1.5, 1.0, 1.0), intensity: Rgb::new(0.4, 0.3, 0.2) },
        Light::Spot {
            position: Vec3::new(-2.0, 2.0, 1.0),
            direction: Vec3::new(0.6, -0.8, 0.0),
            intensity: Rgb::gray(2.0),
            inner_angle: 0.2,
            outer_angle: 0.5,
        },
        Light::Sun {
            direction: Vec3::new(0.0, -0.8, -0.6),
            irradiance: Rgb::gray(0.5),
            angular_radius: 0.02,
        },
    ];
    let pixel = |i: u8| [0.2 + 0.1 * f32::from(i % 4), 0.4, 0.8 - 0.1 * f32::from(i / 4), 1.0];
    let pixels = Pixels::F32((0..8).map(pixel).collect());
    let sky = Bitmap { width: 4, height: 2, pixels, encoding: Encoding::Linear, has_alpha: false };
    let rotation = Mat3::from_rotation_y(0.7);
    let image = scene.add_image(sky);
    scene.environment = Some(Environment::LatLong { image, scale: Rgb::gray(0.8), rotation });
    let mut camera = Camera::looking_at(Vec3::new(0.3, 1.2, 3.6), Vec3::new(0.0, 0.5, 0.0), Vec3::Y, 0.7);
    camera.lens_radius = 0.02;
    scene.add_camera(camera);
    (scene.settings.width, scene.settings.height, scene.settings.seed) = (44, 34, 5);
    scene.settings.filter = Filter::Gaussian { radius: 1.5, deviation: 0.5 };
    scene
}
