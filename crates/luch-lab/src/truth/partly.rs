//! Surfaces that are there in part: alpha, masks, sides, mixtures, colours of vertices.

use super::formulas::polygon;
use super::stage::{aimed, aimed_at_floor, black, ceiling, facing_down, floor, gray, lamp, put, surround};
use super::{Case, Family, Way};
use glam::{Affine3A, DVec3, Vec2, Vec3, Vec4};
use luch_image::{Bitmap, Encoding, Pixels, Rgb};
use luch_mesh::{Attribute, TriangleMesh, generate};
use luch_scene::preset::{material_ball, parallelogram};
use luch_scene::{
    Camera, Channel, ColorValue, Emission, Id, Integrator, Material, Opacity, ScalarValue, Scene, Shape,
    Sides, Surface, Texture, TextureFilter, TextureUse, Wrap,
};

const ALL: [Integrator; 3] = [Way::PATH, Way::PLAIN, Way::DIRECT];

fn half() -> Opacity {
    Opacity::Blend { alpha: 0.5.into() }
}

/// What a point at the origin of the floor receives from a part of the lamp of [`lit_floor`], from x = `from` on.
fn received(from: f64) -> f64 {
    let corners = [[from, -1.0], [1.0, -1.0], [1.0, 1.0], [from, 1.0]].map(|[x, z]| DVec3::new(x, 1.0, z));
    4.0 * polygon(DVec3::ZERO, DVec3::Y, &corners)
}

/// A floor of albedo 1 under a lamp of radiance 4 that spans −1 to 1 in x and z at height 1.
fn lit_floor() -> Scene {
    let mut scene = Scene::default();
    floor(&mut scene, 1.0);
    ceiling(&mut scene, [-1.0; 2], [1.0; 2], 1.0, lamp(4.0));
    scene
}

/// Looks at the origin from just above the floor.
fn low() -> Camera {
    aimed_at_floor(0.0, 0.0)
}

/// Looks up at the lamp of [`lit_floor`] from just above the floor.
fn up() -> Camera {
    aimed(Vec3::new(0.2, 0.1, 0.3), Vec3::new(0.25, 1.0, 0.3))
}

/// A horizontal square of side `side` that faces downward, its vertex alpha rising from 0 to 1 along x.
fn rising_alpha(corner: Vec3, side: f32) -> TriangleMesh {
    let mut mesh = parallelogram(corner, Vec3::X * side, Vec3::Z * side);
    let alpha = |p: &Vec3| Vec4::new(1.0, 1.0, 1.0, (p.x - corner.x) / side);
    mesh.colors = Attribute::per_position(mesh.positions.iter().map(alpha).collect());
    mesh
}

fn vertex_alpha() -> ScalarValue {
    ScalarValue { vertex_alpha: true, ..1.0.into() }
}

pub(super) fn alpha() -> Vec<Case> {
    let mut cases = sheets();
    cases.extend(lamps());
    cases.extend(vertices());
    cases.extend(texture());
    let scene = material_ball(Shape::Sphere { radius: 1.0 }, Material { opacity: half(), ..gray(1.0) });
    let camera = scene.cameras[0].camera;
    let ball = Case::new(Family::Alpha, "white ball, half there, in white light", &scene, camera, 1.0);
    cases.push(ball.exactly_by(&[Way::PLAIN]).by(&[Way::PATH]));
    cases
}

/// Each halves what is seen and what arrives.
fn sheets() -> Vec<Case> {
    let mut cases = Vec::new();
    for sheets in 1..=2 {
        let mut scene = lit_floor();
        for i in 0..sheets {
            let sheet = Material { opacity: half(), ..black() };
            let placement = Affine3A::from_translation(Vec3::Y * (0.4 + 0.2 * i as f32));
            put(&mut scene, Shape::Plane, sheet, placement);
        }
        let left = libm::pow(0.5, f64::from(sheets));
        for (name, camera, truth) in [("seen", up(), 4.0 * left), ("received", low(), received(-1.0) * left)]
        {
            let name = format!("{name} through {sheets} half transparent");
            cases.push(Case::new(Family::Alpha, name, &scene, camera, truth).by(&ALL));
        }
    }
    cases
}

/// Lamps that are there in part.
fn lamps() -> Vec<Case> {
    let mut scene = lit_floor();
    scene.materials[1].opacity = half();
    let case = |name, camera, truth| Case::new(Family::Alpha, name, &scene, camera, truth).by(&ALL);
    let seen = case("half a lamp, seen", up(), 2.0);
    let on_the_floor = case("half a lamp, received", low(), received(-1.0) / 2.0);
    // Alpha rises along x from 0 to 1: the half at x > 0 is there.
    let mut scene = lit_floor();
    scene.shapes[1] = Shape::Mesh(rising_alpha(Vec3::new(-1.0, 1.0, -1.0), 2.0)).into();
    scene.materials[1].opacity = Opacity::Mask { alpha: vertex_alpha(), cutoff: 0.5 };
    let masked = Case::new(Family::Alpha, "masked lamp, received", &scene, low(), received(0.0)).by(&ALL);
    vec![seen, on_the_floor, masked]
}

/// A lamp of radiance 3, seen through a sheet at height 1.
fn behind(mesh: TriangleMesh, opacity: Opacity, placement: Affine3A) -> Scene {
    let mut scene = Scene::default();
    ceiling(&mut scene, [-9.0; 2], [9.0; 2], 2.0, lamp(3.0));
    put(&mut scene, Shape::Mesh(mesh), Material { opacity, ..black() }, placement);
    scene
}

/// Alpha of vertices is interpolated, and cut at the cutoff.
fn vertices() -> Vec<Case> {
    let case = |name: String, opacity: Opacity, x: f32, truth: f64| {
        let scene = behind(rising_alpha(Vec3::new(0.0, 1.0, 0.0), 1.0), opacity, Affine3A::IDENTITY);
        let camera = aimed(Vec3::new(x, 0.0, 0.4), Vec3::new(x, 1.0, 0.4));
        Case::new(Family::Alpha, name, &scene, camera, truth)
    };
    let mut cases = Vec::new();
    for x in [0.2_f32, 0.5, 0.7] {
        let whole = Opacity::Blend { alpha: vertex_alpha() };
        let halved = Opacity::Blend { alpha: ScalarValue { factor: 0.5, ..vertex_alpha() } };
        let left = 3.0 * f64::from(1.0 - x);
        cases.push(case(format!("vertex alpha {x}"), whole, x, left).by(&ALL));
        let left = 3.0 * f64::from(1.0 - 0.5 * x);
        cases.push(case(format!("half of vertex alpha {x}"), halved, x, left).by(&ALL));
    }
    for (x, truth) in [(0.45, 3.0), (0.55, 0.0)] {
        let mask = Opacity::Mask { alpha: vertex_alpha(), cutoff: 0.5 };
        cases.push(case(format!("vertex alpha {x}, cut at 0.5"), mask, x, truth).exactly_by(&ALL));
    }
    cases
}

/// A texture cuts out. Alpha is not a colour: 51 of 255 is one fifth, whatever curve the colours have.
fn texture() -> Vec<Case> {
    let mesh = generate::plane(Vec2::ONE, [1, 1]);
    let uvs = mesh.corner_uvs(0, 0).unwrap_or_default();
    let corners = uvs.iter().zip(mesh.corners(0));
    let low_u = corners.min_by(|a, b| a.0.x.total_cmp(&b.0.x)).map_or(Vec3::X, |(_, corner)| corner);
    let alpha = ScalarValue::textured(TextureUse::new(Id::new(0)), Channel::Alpha);
    let mut scene = behind(mesh, Opacity::Blend { alpha }, Affine3A::from_translation(Vec3::Y));
    let pixels = Pixels::U8(vec![[255, 255, 255, 51], [255, 255, 255, 255]]);
    let image =
        scene.add_image(Bitmap { width: 2, height: 1, pixels, encoding: Encoding::Srgb, has_alpha: true });
    scene.add_texture(Texture::Image {
        image,
        encoding: Encoding::Srgb,
        wrap: [Wrap::Clamp; 2],
        filter: TextureFilter::Nearest,
    });
    let side = low_u.x.signum() * 0.25;
    let look = |x: f32| aimed(Vec3::new(x, 0.0, 0.1), Vec3::new(x, 1.0, 0.1));
    vec![
        Case::new(Family::Alpha, "texture, thin half", &scene, look(side), 3.0 * 0.8).by(&ALL),
        Case::new(Family::Alpha, "texture, whole half", &scene, look(-side), 0.0).exactly_by(&ALL),
    ]
}

pub(super) fn sides() -> Vec<Case> {
    let sheet = Material { sides: Sides::Front, ..black() };
    // Rays from the floor to the lamp come from below: a sheet that faces up is not there for them, one that faces down is.
    let under = |placement| {
        let mut scene = lit_floor();
        put(&mut scene, Shape::Plane, sheet.clone(), placement);
        scene
    };
    let (passed, hidden) =
        (under(Affine3A::from_translation(Vec3::Y * 0.5)), under(facing_down(Vec3::Y * 0.5)));
    let mut back = lit_floor();
    back.materials[1].sides = Sides::Front;
    back.materials[1].emission = Some(Emission { radiance: Rgb::gray(4.0).into(), two_sided: true });
    // Turned over, its back looks at the floor.
    back.instances[1].placement = Affine3A::from_translation(Vec3::Y) * facing_down(Vec3::Y);
    let case = |name, scene, camera, truth| Case::new(Family::Sides, name, scene, camera, truth);
    vec![
        case("lamp seen through a back", &passed, up(), 4.0).exactly_by(&ALL),
        case("light received through a back", &passed, low(), received(-1.0)).by(&ALL),
        case("lamp seen through a front", &hidden, up(), 0.0).exactly_by(&ALL),
        case("light received through a front", &hidden, low(), 0.0).exactly_by(&ALL),
        case("back of a lamp", &back, low(), 0.0).exactly_by(&ALL),
    ]
}

/// A floor of the last material under light of radiance `radiance`.
fn under_light(mut scene: Scene, material: Material, radiance: f32) -> Scene {
    put(&mut scene, Shape::Plane, material, Affine3A::IDENTITY);
    surround(&mut scene, radiance);
    scene
}

pub(super) fn mixtures() -> Vec<Case> {
    let mut cases = Vec::new();
    for weight in [0.0_f32, 0.3, 1.0] {
        let mut scene = Scene::default();
        let first = scene.add_material(gray(0.2));
        let second = scene.add_material(gray(0.9));
        let mixed = Material::new(Surface::Mix { first, second, weight: weight.into() });
        let truth = 2.0 * f64::from(0.2 + weight * 0.7);
        let name = format!("{weight} of the second");
        let scene = under_light(scene, mixed, 2.0);
        cases.push(Case::new(Family::Mixture, name, &scene, low(), truth).by(&ALL));
    }
    let mut scene = Scene::default();
    let first = scene.add_material(gray(0.0));
    let second = scene.add_material(gray(0.8));
    let inner = scene.add_material(Material::new(Surface::Mix { first, second, weight: 0.5.into() }));
    let outer = Material::new(Surface::Mix { first, second: inner, weight: 0.5.into() });
    let scene = under_light(scene, outer, 1.0);
    cases.push(Case::new(Family::Mixture, "half of a half", &scene, low(), 0.2).by(&ALL));
    cases
}

pub(super) fn colors() -> Vec<Case> {
    let mut scene = Scene::default();
    let mut mesh = parallelogram(Vec3::new(-1.0, 0.0, -1.0), Vec3::Z * 2.0, Vec3::X * 2.0);
    mesh.colors =
        Attribute::per_position(mesh.positions.iter().map(|p| Vec4::splat((p.x + 1.0) / 2.0)).collect());
    let color = ColorValue { vertex_color: true, ..Rgb::gray(0.8).into() };
    put(&mut scene, Shape::Mesh(mesh), Material::new(Surface::Diffuse { color }), Affine3A::IDENTITY);
    surround(&mut scene, 1.0);
    let case = |x: f32| {
        let camera = aimed(Vec3::new(x, 1.0, 0.2), Vec3::new(x, 0.0, 0.2));
        let truth = f64::from(0.8 * (x + 1.0) / 2.0);
        Case::new(Family::Color, format!("at {x}"), &scene, camera, truth).by(&ALL)
    };
    [-0.5, 0.0, 0.6].map(case).into()
}
