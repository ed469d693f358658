//! Shading normals change shades, never shapes: silhouettes, closed rooms, the edge of the shadow.

use super::{render, world};
use glam::{Affine3A, Vec2, Vec3, Vec3Swizzles};
use luch_bvh::Ray;
use luch_image::{Bitmap, Encoding, Pixels, Rgb};
use luch_lab::truth::Way;
use luch_lab::truth::measure::settings;
use luch_lab::truth::stage::{gray, lamp, put, surround};
use luch_mesh::normals::{Weight, smooth};
use luch_mesh::{TriangleMesh, generate};
use luch_render::SurfacePoint;
use luch_sampling::Sequence;
use luch_scene::{
    Camera, Id, Integrator as Name, Light, NormalMap, Normals, Property, Scene, Settings, Shape, Texture,
    TextureFilter, TextureUse, Wrap,
};

fn smoothed(mut mesh: TriangleMesh) -> TriangleMesh {
    mesh.normals = smooth(&mesh, Weight::Angle);
    mesh
}

fn ball(normals: Normals) -> Scene {
    let mut scene = Scene::default();
    put(&mut scene, Shape::Mesh(smoothed(generate::sphere(1.0, 12, 6))), gray(0.8), Affine3A::IDENTITY);
    scene.settings.normals = normals;
    scene
}

fn front() -> Camera {
    Camera::looking_at(Vec3::new(0.0, 0.5, 4.0), Vec3::ZERO, Vec3::Y, 0.6)
}

#[test]
fn flat_and_interpolated_normals_differ_in_shade_and_agree_in_outline() {
    let show = |normals, property| {
        let like = Settings { normals, ..settings(24, 24, Sequence::Sobol, 4) };
        render(&world(ball(normals)), &front(), &like, Name::Inspect(property), 8)
    };
    for property in [Property::Material, Property::Primitive, Property::Depth, Property::GeometricNormal] {
        assert_eq!(show(Normals::Flat, property), show(Normals::Interpolated, property), "{property:?}");
    }
    assert_eq!(show(Normals::Flat, Property::Normal), show(Normals::Flat, Property::GeometricNormal));
    assert_ne!(show(Normals::Flat, Property::Normal), show(Normals::Interpolated, Property::Normal));
}

/// A normal map that tilts wildly, pixel by pixel.
fn wild_map(scene: &mut Scene) -> NormalMap {
    let mut state = 1u64;
    let mut byte = || {
        state = luch_sampling::hash::mix64(state);
        (state >> 40) as u8
    };
    let pixels = (0..64).map(|_| [byte(), byte(), 128 + byte() / 2, 255]).collect();
    scene.add_image(Bitmap {
        width: 8,
        height: 8,
        pixels: Pixels::U8(pixels),
        encoding: Encoding::Linear,
        has_alpha: false,
    });
    let texture = scene.add_texture(Texture::Image {
        image: Id::new(0),
        encoding: Encoding::Linear,
        wrap: [Wrap::Repeat; 2],
        filter: TextureFilter::Nearest,
    });
    NormalMap { texture: TextureUse::new(texture), scale: 3.0 }
}

#[test]
fn no_light_leaks_into_a_closed_room() {
    let rooms = [
        ("box", smoothed(generate::cuboid(Vec3::splat(2.0), [1, 1, 1]))),
        ("ball", smoothed(generate::sphere(1.0, 8, 4))),
        ("tetrahedral", smoothed(generate::cone(1.4, 0.0, 2.4, 3, 1, true))),
    ];
    for (name, mesh) in rooms {
        for mapped in [false, true] {
            let mut scene = Scene::default();
            let mut material = gray(0.9);
            if mapped {
                material.normal_map = Some(wild_map(&mut scene));
            }
            put(&mut scene, Shape::Mesh(mesh.clone()), material, Affine3A::IDENTITY);
            surround(&mut scene, 1.0);
            let irradiance = Rgb::gray(100.0);
            scene.lights.push(Light::Sun {
                direction: Vec3::new(0.48, -0.64, 0.6),
                irradiance,
                angular_radius: 0.01,
            });
            scene.lights.push(Light::Point { position: Vec3::new(1.5, 1.2, 1.1), intensity: irradiance });
            put(
                &mut scene,
                Shape::Sphere { radius: 0.5 },
                lamp(100.0),
                Affine3A::from_translation(Vec3::new(-1.7, 1.2, 0.9)),
            );
            let world = world(scene);
            // Toward a corner, an edge and a face.
            for target in [Vec3::ONE, Vec3::new(-1.0, 1.0, 0.1), Vec3::new(0.2, -1.0, 0.3)] {
                let camera = Camera::looking_at(Vec3::new(0.05, -0.2, 0.07), target, Vec3::X, 1.5);
                for way in [Way::PATH, Way::PLAIN, Way::DIRECT] {
                    for pixel in render(&world, &camera, &settings(8, 8, Sequence::Sobol, 6), way, 64) {
                        assert_eq!(pixel.mean, [0.0; 3], "{name}, mapped: {mapped}, {way:?} toward {target}");
                    }
                }
            }
        }
    }
}

/// Looks at a lit body from all around: of the places whose smooth normal faces the sun, which part is in shadow though the
/// triangle faces the sun as well?
fn wrongly_dark(mesh: TriangleMesh, toward_sun: Vec3) -> f64 {
    let mut scene = Scene::default();
    put(&mut scene, Shape::Mesh(smoothed(mesh)), gray(0.8), Affine3A::IDENTITY);
    let world = world(scene);
    let (mut lit, mut dark) = (0, 0);
    let grid = 160;
    for i in 0..grid * grid {
        let place = Vec2::new((i % grid) as f32 + 0.5, (i / grid) as f32 + 0.5) / grid as f32 * 2.4 - 1.2;
        let side = if i % 2 == 0 { Vec3::Z } else { Vec3::X };
        let across = side.yzx();
        let ray = Ray::new(side * 5.0 + across * place.x + side.cross(across) * place.y, -side);
        let Some(hit) = world.geometry.nearest_hit(&world.scene, &ray, 0) else { continue };
        let point = SurfacePoint::new(&world.scene, &world.geometry, &ray, hit);
        if point.frame.normal.dot(toward_sun) > 0.01 && point.geometric_normal.dot(toward_sun) > 0.001 {
            lit += 1;
            dark += u32::from(
                world.geometry.nearest_hit(&world.scene, &point.exit().ray_toward(toward_sun), 0).is_some(),
            );
        }
    }
    assert!(lit > 2000, "only {lit} places were lit");
    f64::from(dark) / f64::from(lit)
}

#[test]
fn no_triangle_of_a_coarse_convex_body_that_faces_the_sun_is_in_shadow() {
    let toward_sun = Vec3::new(0.48, 0.6, 0.64);
    for (name, mesh) in [
        ("sphere", generate::sphere(1.0, 12, 6)),
        ("icosphere", generate::icosphere(1.0, 1)),
        ("cylinder", generate::cylinder(0.8, 1.6, 10, 1, true)),
    ] {
        assert_eq!(wrongly_dark(mesh, toward_sun), 0.0, "{name}");
    }
}
