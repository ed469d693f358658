//! Every pixel shows what the ray through its middle meets first.
//!
//! The rays are the renderer's, written down again in `views`; what they meet is found by `luch-bvh`.

use crate::views::{cameras, crumpled, placed, random, ray, soup};
use glam::{Affine3A, Mat3, Vec2, Vec3};
use luch_bvh::{BruteForce, Ray, TriangleTest, shape};
use luch_mesh::{Attribute, TriangleMesh, generate};
use luch_preview::{Fill, NOTHING, Picture, Size, Style, Subject, draw};
use luch_scene::{Camera, Material, Scene, Shape};

const SIZE: Size = Size { width: 75, height: 50 };

/// Twice the raster's steps: how far from an edge a pixel may take the one side for the other.
const STEP: f32 = 1.0 / 512.0;

fn middle(x: u32, y: u32) -> Vec2 {
    Vec2::new(x as f32 + 0.5, y as f32 + 0.5)
}

/// Asserts that pixels agree with rays: the same triangle, or one equally far but for rounding, or one that rays a step beside
/// the middle meet.
fn assert_agrees(
    picture: &Picture,
    camera: &Camera,
    nearest: impl Fn(&Ray) -> Option<(u32, f32)>,
    what: &dyn std::fmt::Debug,
) {
    let mut beside = 0;
    for y in 0..SIZE.height {
        for x in 0..SIZE.width {
            let (face, depth) = (*picture.faces.get(x, y), *picture.depth.get(x, y));
            let agrees = |offset: Vec2| match nearest(&ray(camera, SIZE, middle(x, y) + offset)) {
                None => face == NOTHING,
                // Single precision of rays and placements: some units in the last place of positions near the eye's distance.
                Some((triangle, t)) => {
                    let is_as_far = (t - depth).abs() <= 2e-5 * t.max(1.0) || offset != Vec2::ZERO;
                    (face == triangle && is_as_far) || (t - depth).abs() <= 2e-6 * t.max(1.0)
                }
            };
            if !agrees(Vec2::ZERO) {
                beside += 1;
                let around = (0..16).map(|i| Vec2::from_angle(i as f32 * std::f32::consts::FRAC_PI_8) * STEP);
                let mut around = around.chain([Vec2::ZERO]);
                let met = nearest(&ray(camera, SIZE, middle(x, y)));
                assert!(around.any(agrees), "{what:?}: pixel {x} {y} shows {face} at {depth}, ray {met:?}");
            }
        }
    }
    // By chance a pixel in some hundreds lies within a step of one of a few edges.
    assert!(beside <= SIZE.width * SIZE.height / 50, "{what:?}: {beside} pixels show a neighbour");
}

fn check_mesh(mesh: &TriangleMesh, what: &str) {
    let oracle = BruteForce::new(&mesh.positions, &mesh.triangles, TriangleTest::Watertight);
    let subject = Subject::triangles(mesh);
    for (number, camera) in cameras().iter().enumerate() {
        let picture = draw(&subject, camera, SIZE, &Style::default()).unwrap();
        let nearest = |ray: &Ray| oracle.nearest(ray).map(|hit| (hit.primitive, hit.t));
        assert_agrees(&picture, camera, nearest, &(what, number));
    }
}

#[test]
fn forms_are_seen_as_rays_see_them() {
    check_mesh(&generate::torus(1.0, 0.4, 24, 12), "torus");
    check_mesh(&generate::cuboid(Vec3::ONE, [1, 1, 1]), "cube");
    check_mesh(&crumpled(generate::icosphere(1.0, 2), 5, 0.3), "crumpled ball");
}

/// Many of them reach behind the eye, through the picture's border or through the eye's plane.
#[test]
fn triangles_anywhere_are_seen_as_rays_see_them() {
    check_mesh(&soup(1, 30, 1.5), "small soup");
    check_mesh(&soup(2, 40, 8.0), "large soup");
    check_mesh(&soup(3, 12, 1e4), "huge soup");
    check_mesh(&soup(4, 300, 0.7), "dense soup");
}

/// Turned, stretched, sheared and mirrored instances of one mesh, against the same triangles in one list.
#[test]
fn instances_are_seen_where_they_are_put() {
    let mesh = generate::torus(0.6, 0.2, 16, 8);
    let shear = Affine3A::from_mat3(Mat3::from_cols_array(&[1.0, 0.4, 0.0, 0.0, 0.7, 0.2, 0.3, 0.0, 1.2]));
    let placements = [
        Affine3A::from_translation(Vec3::new(0.5, 0.3, 0.0)) * Affine3A::from_rotation_x(1.1),
        Affine3A::from_scale(Vec3::new(-1.0, 0.5, 2.0)),
        shear,
    ];
    let mut scene = Scene::default();
    let shape = scene.add_shape(Shape::Mesh(mesh.clone()));
    let material = scene.add_material(Material::diffuse(luch_image::Rgb::WHITE));
    let mut all = TriangleMesh::default();
    for placement in &placements {
        scene.add_instance(shape, material, *placement);
        let first = all.positions.len() as u32;
        let moved = placed(&mesh, placement);
        all.positions.extend(moved.positions);
        all.triangles.extend(moved.triangles.iter().map(|corners| corners.map(|corner| corner + first)));
    }
    let oracle = BruteForce::new(&all.positions, &all.triangles, TriangleTest::Watertight);
    let count = mesh.triangles.len() as u32;
    let subject = Subject::scene(&scene);
    for (number, camera) in cameras().iter().enumerate() {
        let mut picture = draw(&subject, camera, SIZE, &Style::default()).unwrap();
        for (face, &instance) in picture.faces.pixels_mut().iter_mut().zip(picture.instances.pixels()) {
            assert_eq!(*face == NOTHING, instance == NOTHING);
            if *face != NOTHING {
                *face += count * instance;
            }
        }
        let nearest = |ray: &Ray| oracle.nearest(ray).map(|hit| (hit.primitive, hit.t));
        assert_agrees(&picture, camera, nearest, &number);
    }
}

#[test]
fn exact_shapes_are_seen_as_rays_see_them() {
    let sphere = shape::Sphere { center: Vec3::ZERO, radius: 0.9 };
    let disc = shape::Disc { center: Vec3::ZERO, normal: Vec3::Y, radius: 1.2 };
    let plane = shape::Plane { point: Vec3::ZERO, normal: Vec3::Y };
    let shapes = [Shape::Sphere { radius: 0.9 }, Shape::Disc { radius: 1.2 }, Shape::Plane];
    for (kind, shape) in shapes.into_iter().enumerate() {
        let mut scene = Scene::default();
        let shape = scene.add_shape(shape);
        let material = scene.add_material(Material::diffuse(luch_image::Rgb::WHITE));
        let placement =
            Affine3A::from_translation(Vec3::new(0.2, -0.1, 0.0)) * Affine3A::from_rotation_z(0.3);
        scene.add_instance(shape, material, placement);
        let subject = Subject::scene(&scene);
        let back = placement.inverse();
        for (number, camera) in cameras().iter().enumerate() {
            let picture = draw(&subject, camera, SIZE, &Style::default()).unwrap();
            let nearest = |ray: &Ray| {
                let local =
                    Ray::new(back.transform_point3(ray.origin), back.transform_vector3(ray.direction));
                let met = match kind {
                    0 => sphere.crossings(&local).into_iter().flatten().next(),
                    1 => disc.crossing(&local),
                    _ => plane.crossing(&local),
                };
                met.map(|crossing| (0, crossing.t))
            };
            // Planes meet rays near the horizon at any distance: there the face alone is compared.
            let mut picture = picture;
            if kind == 2 {
                for (pixel, depth) in picture.depth.pixels_mut().iter_mut().enumerate() {
                    let (x, y) = (pixel as u32 % SIZE.width, pixel as u32 / SIZE.width);
                    if let Some((_, t)) = nearest(&ray(camera, SIZE, middle(x, y)))
                        && depth.is_finite()
                        && (*depth - t).abs() <= 1e-4 * t * t.max(1.0)
                    {
                        *depth = t;
                    }
                }
            }
            assert_agrees(&picture, camera, nearest, &(kind, number));
        }
    }
}

/// Texture coordinates at the pixel's middle are those at the ray's hit, in perspective.
#[test]
fn texture_coordinates_are_those_of_rays() {
    let mut mesh = soup(11, 20, 2.0);
    let uv = |i: usize| Vec2::new(random(77, 2 * i as u64), random(77, 2 * i as u64 + 1)) * 0.9 + 0.05;
    mesh.uv_sets.push(Attribute::per_position((0..mesh.positions.len()).map(uv).collect()));
    let oracle = BruteForce::new(&mesh.positions, &mesh.triangles, TriangleTest::Watertight);
    let subject = Subject::triangles(&mesh);
    let mut compared = 0;
    for camera in cameras() {
        let picture = draw(&subject, &camera, SIZE, &Style::filled(Fill::Uv)).unwrap();
        for y in 0..SIZE.height {
            for x in 0..SIZE.width {
                let Some(hit) = oracle.nearest(&ray(&camera, SIZE, middle(x, y))) else { continue };
                if hit.primitive != *picture.faces.get(x, y) {
                    continue;
                }
                let [a, b, c] = mesh.corner_uvs(hit.primitive as usize, 0).unwrap();
                let expected = a * (1.0 - hit.u - hit.v) + b * hit.u + c * hit.v;
                let color = picture.color.get(x, y);
                let shown =
                    [color.r, color.g].map(|light| f32::from(luch_image::srgb::encode_u8(light)) / 255.0);
                // Half a byte, and what single-precision weights lose on slivers.
                let error = (Vec2::from(shown) - expected).abs().max_element();
                assert!(error <= 0.5 / 255.0 + 1e-3, "{x} {y}: {shown:?} instead of {expected}");
                compared += 1;
            }
        }
    }
    assert!(compared > 5000, "{compared}");
}
