//! The preview against the renderer: the same outlines, to a pixel.

use glam::{Affine3A, Vec3};
use luch::mesh::Generator;
use luch::prelude::*;
use luch::preview::{NOTHING, Size, Style, Subject, draw};
use luch::scene::{Filter, Frustum, Integrator as Name, Projection, Property, Traced};
use std::sync::atomic::AtomicU64;

const SIZE: Size = Size { width: 160, height: 120 };

/// Forms of every kind, some before others.
fn scene(projection: Projection) -> Scene {
    let mut scene = Scene::default();
    (scene.settings.width, scene.settings.height) = (SIZE.width, SIZE.height);
    scene.settings.filter = Filter::Box { radius: 0.5 };
    scene.settings.integrator = Name::Inspect(Property::Instance);
    let material = scene.add_material(Material::diffuse(Rgb::gray(0.5)));
    let mut shapes: Vec<Shape> =
        Generator::examples().into_iter().step_by(3).map(|generator| Shape::Mesh(generator.mesh())).collect();
    shapes.push(Shape::Sphere { radius: 0.9 });
    shapes.push(Shape::Disc { radius: 0.8 });
    let cone = Frustum { bottom_radius: 0.8, top_radius: 0.2, height: 1.5, capped: true };
    shapes.push(Shape::Traced(Traced::Frustum(cone)));
    for (place, shape) in shapes.into_iter().enumerate() {
        let shape = scene.add_shape(shape);
        let (column, row) = ((place % 5) as f32, (place / 5) as f32);
        let stand = Vec3::new(1.7 * column - 3.4, 0.4 * row, -1.6 * row);
        let placement = Affine3A::from_translation(stand)
            * Affine3A::from_rotation_y(place as f32)
            * Affine3A::from_rotation_x(0.7 * place as f32)
            * Affine3A::from_scale(Vec3::splat(0.6));
        scene.add_instance(shape, material, placement);
    }
    let mut camera = Camera::looking_at(Vec3::new(0.7, 3.0, 6.5), Vec3::new(0.0, 0.4, -1.5), Vec3::Y, 0.9);
    camera.projection = projection;
    scene.add_camera(camera);
    scene
}

/// Points of the preview along a pixel of the rendering.
const FINE: u32 = 8;

/// Every sample of a pixel in which, and up to an eighth of a pixel around which, the preview shows one instance hits that instance.
#[test]
fn outlines_agree_to_a_pixel() {
    let projections =
        [Projection::Perspective { field_of_view_y: 0.9 }, Projection::Orthographic { height: 7.0 }];
    for projection in projections {
        let scene = scene(projection);
        let camera = scene.cameras[0].camera;
        let fine = Size { width: FINE * SIZE.width, height: FINE * SIZE.height };
        let picture = draw(&Subject::scene(&scene), &camera, fine, &Style::default()).unwrap();
        let view = View::new(&camera, &scene.settings);
        let world = World::build(scene).unwrap();
        let integrator = from_settings(world.scene.settings.integrator, &view);
        let mut film = Film::new(SIZE.width, SIZE.height);
        render_pass(&world, &view, &*integrator, &mut film, 0..16, &Stop::new(), &AtomicU64::new(0)).unwrap();
        let rendered = film.to_image();
        // The colour of an instance, learnt where it alone is seen.
        let mut colors: Vec<Option<Rgb>> = vec![None; world.scene.instances.len()];
        let (mut uniform, mut borders) = (0, 0);
        for y in 1..SIZE.height - 1 {
            for x in 1..SIZE.width - 1 {
                let own = *picture.instances.get(FINE * x, FINE * y);
                let side = FINE + 2;
                let is_uniform = (0..side * side).all(|k| {
                    let (x, y) = (FINE * x + k % side - 1, FINE * y + k / side - 1);
                    *picture.instances.get(x, y) == own
                });
                let color = *rendered.get(x, y);
                if !is_uniform {
                    borders += 1;
                    continue;
                }
                uniform += 1;
                let expected = match own {
                    NOTHING => Rgb::gray(0.0),
                    own => *colors[own as usize].get_or_insert(color),
                };
                let near = |a: f32, b: f32| (a - b).abs() < 1e-6;
                assert!(
                    near(color.r, expected.r) && near(color.g, expected.g) && near(color.b, expected.b),
                    "{projection:?} {x} {y}: {color:?} instead of {expected:?} of {own}"
                );
            }
        }
        let seen = colors.iter().flatten().count();
        assert!(seen * 10 >= colors.len() * 7, "{seen} of {}", colors.len());
        assert!(uniform > 4 * borders && borders > 500, "{uniform} {borders}");
    }
}
