//! Scenes at the edges of what is allowed, and one of nearly everything.

use glam::{Affine2, Affine3A, Mat3, Vec2, Vec3};
use luch_image::{Bitmap, Encoding, Pixels, Rgb};
use luch_mesh::{Attribute, TriangleMesh, generate};
use luch_scene::preset::{cornell_box, parallelogram};
use luch_scene::{
    Camera, Channel, ColorValue, Emission, Environment, Light, Material, Metal, NormalMap, Opacity,
    Principled, Reflectance, ScalarValue, Scene, Shape, Sides, Surface, Texture, TextureFilter, TextureUse,
    Wrap,
};

fn sized(mut scene: Scene, size: u32) -> Scene {
    (scene.settings.width, scene.settings.height) = (size, size);
    scene
}

pub(crate) fn small_cornell() -> Scene {
    sized(cornell_box(), 12)
}

/// The Cornell box with all lengths multiplied.
pub(crate) fn cornell_of_scale(scale: f32, seed: u64) -> Scene {
    let mut scene = sized(cornell_box(), 16);
    for instance in &mut scene.instances {
        instance.placement = Affine3A::from_scale(Vec3::splat(scale));
    }
    let camera = &mut scene.cameras[0].camera;
    camera.position *= scale;
    camera.focus_distance *= scale;
    scene.settings.seed = seed;
    scene
}

fn camera_at(position: Vec3, target: Vec3) -> Camera {
    Camera::looking_at(position, target, Vec3::Y, 0.8)
}

/// A grey thing of a mesh under a white sky.
fn under_sky(mesh: TriangleMesh) -> Scene {
    let mut scene = Scene::default();
    let gray = scene.add_material(Material::diffuse(Rgb::gray(0.5)));
    let shape = scene.add_shape(Shape::Mesh(mesh));
    scene.add_instance(shape, gray, Affine3A::IDENTITY);
    scene.environment = Some(Environment::Constant { radiance: Rgb::WHITE });
    scene.add_camera(camera_at(Vec3::new(0.0, 0.5, 3.0), Vec3::ZERO));
    sized(scene, 8)
}

fn empty(environment: Option<Environment>) -> Scene {
    let mut scene = Scene { environment, ..Scene::default() };
    scene.add_camera(camera_at(Vec3::Z, Vec3::ZERO));
    sized(scene, 8)
}

/// Triangles without area: points, lines, needles, beside one that is sound.
fn degenerate() -> TriangleMesh {
    let p = [
        Vec3::new(-1.0, -1.0, 0.0),
        Vec3::new(1.0, -1.0, 0.0),
        Vec3::new(0.0, 1.0, 0.0),
        Vec3::new(0.0, 0.0, 0.0),
        Vec3::new(1e-30, 0.0, 1e-30),
        Vec3::new(0.5, -1.0, 0.0),
    ];
    let triangles = vec![[0, 1, 2], [0, 0, 0], [0, 1, 1], [0, 5, 1], [3, 4, 0], [2, 1, 2]];
    TriangleMesh::new(p.to_vec(), triangles)
}

/// Lamps that have no extent, or hardly any.
fn zero_size_emitters() -> Scene {
    let mut scene = under_sky(parallelogram(Vec3::new(-1.0, 0.0, 1.0), 2.0 * Vec3::X, -2.0 * Vec3::Z));
    scene.environment = None;
    let lamp = scene.add_material(Material::emitter(Rgb::gray(1e6)));
    for side in [0.0, 1e-25, 1e-12, 1e-6] {
        let up = 0.5 * Vec3::Y;
        let mesh = parallelogram(up, side * Vec3::X, side * Vec3::Z);
        let shape = scene.add_shape(Shape::Mesh(mesh));
        scene.add_instance(shape, lamp, Affine3A::IDENTITY);
        let ball = scene.add_shape(Shape::Sphere { radius: 1e-20_f32.max(side) });
        scene.add_instance(ball, lamp, Affine3A::from_translation(up));
        let disc = scene.add_shape(Shape::Disc { radius: 1e-20_f32.max(side) });
        scene.add_instance(disc, lamp, Affine3A::from_translation(up));
    }
    scene.lights.push(Light::Point { position: Vec3::new(0.0, 0.0, 0.0), intensity: Rgb::WHITE });
    scene
}

fn inside_a_closed_box(emits: bool) -> Scene {
    let mut scene = Scene::default();
    let mut white = Material::diffuse(Rgb::WHITE);
    white.emission = emits.then_some(Emission { radiance: Rgb::WHITE.into(), two_sided: true });
    // No light is lost in a white box, so paths have no natural end.
    let white = scene.add_material(white);
    let shape = scene.add_shape(Shape::Mesh(generate::cuboid(Vec3::splat(2.0), [1, 1, 1])));
    scene.add_instance(shape, white, Affine3A::IDENTITY);
    scene.add_camera(camera_at(Vec3::new(0.1, 0.2, 0.3), Vec3::X));
    sized(scene, 8)
}

pub(crate) fn all() -> Vec<(&'static str, Scene)> {
    let black = Environment::Constant { radiance: Rgb::BLACK };
    let mut dark = empty(None);
    let image = dark.add_image(Bitmap {
        width: 2,
        height: 1,
        pixels: Pixels::F32(vec![[0.0; 4], [f32::NAN, -1.0, f32::INFINITY, 1.0]]),
        encoding: Encoding::Linear,
        has_alpha: false,
    });
    dark.environment = Some(Environment::LatLong { image, scale: Rgb::WHITE, rotation: Mat3::IDENTITY });
    let eye_on_surface = {
        let mut scene = under_sky(parallelogram(Vec3::new(-1.0, 0.0, 1.0), 2.0 * Vec3::X, -2.0 * Vec3::Z));
        scene.cameras[0].camera = camera_at(Vec3::ZERO, Vec3::new(0.0, 0.0, -1.0));
        scene
    };
    vec![
        ("an empty scene", empty(None)),
        ("an empty scene under a white sky", empty(Some(Environment::Constant { radiance: Rgb::WHITE }))),
        ("an empty scene under a black sky", empty(Some(black))),
        ("a black picture of a sky", dark),
        ("a mesh without triangles", under_sky(TriangleMesh::default())),
        ("degenerate triangles", under_sky(degenerate())),
        ("zero-size emitters", zero_size_emitters()),
        ("the inside of a closed box", inside_a_closed_box(false)),
        ("the inside of a closed box that glows", inside_a_closed_box(true)),
        ("an eye on a surface", eye_on_surface),
        ("a tiny Cornell box", sized(cornell_of_scale(1e-12, 0), 8)),
        ("a huge Cornell box", sized(cornell_of_scale(1e12, 0), 8)),
        ("a little of everything", everything()),
    ]
}

/// A picture of 4 × 4 noisy pixels.
fn picture(scene: &mut Scene, encoding: Encoding, pixel: impl Fn(u8) -> [u8; 4]) -> TextureUse {
    let pixels = Pixels::U8((0..16).map(pixel).collect());
    let image = scene.add_image(Bitmap { width: 4, height: 4, pixels, encoding, has_alpha: true });
    let wrap = [Wrap::Repeat, Wrap::Mirror];
    let texture =
        scene.add_texture(Texture::Image { image, encoding, wrap, filter: TextureFilter::Bilinear });
    TextureUse { transform: Affine2::from_scale(Vec2::splat(2.0)), ..TextureUse::new(texture) }
}

/// Textures, cut-outs, instances, glass, metal, a normal map and a picture of a sky; no lamp without surface, which the plain path
/// tracer would not see.
pub(crate) fn everything() -> Scene {
    let mut scene = Scene::default();
    let colors = picture(&mut scene, Encoding::Srgb, |i| [i * 16, 255 - i * 12, i.wrapping_mul(53), i * 17]);
    let bumps = picture(&mut scene, Encoding::Linear, |i| [96 + i * 4, 160 - i * 4, 240, 255]);
    let checker = scene.add_texture(Texture::Checker { even: Rgb::gray(0.8), odd: Rgb::new(0.2, 0.3, 0.6) });

    let floor = scene.add_material(Material::diffuse(Rgb::WHITE));
    scene.materials[floor.index()].surface =
        Surface::Diffuse { color: ColorValue::textured(TextureUse::new(checker)) };
    let glass = scene.add_material(Material::new(Surface::Dielectric {
        ior: 1.5,
        roughness: 0.3.into(),
        tint: Rgb::new(0.9, 1.0, 0.95).into(),
    }));
    let gold = scene.add_material(Material::new(Surface::Conductor {
        reflectance: Reflectance::Metal(Metal::Gold),
        roughness: ScalarValue { factor: 0.6, ..ScalarValue::textured(colors, Channel::Green) },
        compensated: true,
    }));
    let mut leaf = Material::diffuse(Rgb::new(0.3, 0.7, 0.2));
    leaf.opacity = Opacity::Blend { alpha: ScalarValue::textured(colors, Channel::Alpha) };
    let leaf = scene.add_material(leaf);
    let mut grid = Material::diffuse(Rgb::gray(0.6));
    grid.opacity = Opacity::Mask { alpha: ScalarValue::textured(colors, Channel::Alpha), cutoff: 0.5 };
    grid.sides = Sides::Front;
    let grid = scene.add_material(grid);
    let mut plastic = Material::new(Surface::Principled(Principled {
        base_color: ColorValue::textured(colors),
        roughness: 0.4.into(),
        ..Principled::default()
    }));
    plastic.normal_map = Some(NormalMap { texture: bumps, scale: 0.8 });
    let plastic = scene.add_material(plastic);
    let mixed =
        scene.add_material(Material::new(Surface::Mix { first: plastic, second: gold, weight: 0.5.into() }));
    let lamp = scene.add_material(Material::emitter(Rgb::new(6.0, 5.0, 4.0)));

    let plane = scene.add_shape(Shape::Plane);
    scene.add_instance(plane, floor, Affine3A::IDENTITY);
    let torus = scene.add_shape(Shape::Mesh(generate::torus(0.5, 0.2, 24, 12)));
    let mut sheet = parallelogram(Vec3::new(-0.5, 0.0, 0.0), Vec3::X, Vec3::Y);
    sheet.uv_sets = vec![Attribute::per_position(vec![Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y])];
    let sheet = scene.add_shape(Shape::Mesh(sheet));
    let ball = scene.add_shape(Shape::Sphere { radius: 0.4 });
    let at = |x: f32, y: f32, z: f32| Affine3A::from_translation(Vec3::new(x, y, z));
    scene.add_instance(torus, mixed, at(-0.7, 0.4, 0.0) * Affine3A::from_rotation_x(1.0));
    scene.add_instance(torus, plastic, at(0.6, 0.3, -0.8) * Affine3A::from_scale(Vec3::new(1.0, -0.7, 0.9)));
    scene.add_instance(ball, glass, at(0.4, 0.4, 0.5));
    scene.add_instance(ball, gold, at(-0.3, 0.4, 0.9) * Affine3A::from_scale(Vec3::new(0.5, 1.0, 0.5)));
    scene.add_instance(sheet, leaf, at(0.9, 0.0, 0.9));
    scene.add_instance(sheet, grid, at(-1.1, 0.0, 0.7));
    scene.add_instance(sheet, lamp, at(0.0, 2.2, 0.0) * Affine3A::from_rotation_x(1.5));

    let sky = (0..8).map(|i| [0.2 + 0.1 * (i % 4) as f32, 0.4, 0.8 - 0.1 * (i / 4) as f32, 1.0]).collect();
    let image = scene.add_image(Bitmap {
        width: 4,
        height: 2,
        pixels: Pixels::F32(sky),
        encoding: Encoding::Linear,
        has_alpha: false,
    });
    scene.environment =
        Some(Environment::LatLong { image, scale: Rgb::gray(0.8), rotation: Mat3::from_rotation_y(0.7) });
    let mut camera = camera_at(Vec3::new(0.3, 1.2, 3.6), Vec3::new(0.0, 0.5, 0.0));
    camera.lens_radius = 0.02;
    scene.add_camera(camera);
    sized(scene, 14)
}
