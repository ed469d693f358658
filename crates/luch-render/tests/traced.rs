//! Forms without triangles against the meshes that approach them, and against exact shapes.

use glam::{Affine3A, Vec2, Vec3, vec3};
use luch_bvh::{InstanceHit, Ray};
use luch_formula::Formula;
use luch_image::Rgb;
use luch_mesh::height_map::{self, HeightField, Terrain};
use luch_mesh::{TriangleMesh, generate};
use luch_render::{SurfacePoint, World};
use luch_scene::{Camera, Frustum, Implicit, Material, Scene, Shape, Traced};
use std::sync::Arc;

fn world(shape: Shape) -> World {
    let mut scene = Scene::default();
    let material = scene.add_material(Material::diffuse(Rgb::gray(0.5)));
    let shape = scene.add_shape(shape);
    scene.add_instance(shape, material, Affine3A::IDENTITY);
    scene.add_camera(Camera::looking_at(Vec3::Z * 9.0, Vec3::ZERO, Vec3::Y, 1.0));
    World::build(scene).expect("a sound scene")
}

fn implicit(text: &str, corner: f32, closed: bool) -> World {
    let surface = Implicit::new(Formula::new(text), [Vec3::splat(-corner), Vec3::splat(corner)], closed);
    world(Shape::Traced(Traced::Implicit(surface.expect("a formula"))))
}

/// Rays from a ball around the origin to places near the middle, always the same.
fn rays(count: usize, reach: f32) -> Vec<Ray> {
    let mut state = 1_u64;
    let mut random = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 40) as f32 / (1 << 23) as f32 - 1.0
    };
    let mut vector = || vec3(random(), random(), random());
    (0..count)
        .map(|_| {
            let from = vector().normalize_or(Vec3::X) * 3.0 * reach;
            Ray::new(from, (vector() * reach - from).normalize())
        })
        .collect()
}

fn hit(world: &World, ray: &Ray) -> Option<InstanceHit> {
    world.geometry.nearest_hit(&world.scene, ray, 0)
}

fn point<'a>(world: &'a World, ray: &Ray, hit: InstanceHit) -> SurfacePoint<'a> {
    SurfacePoint::new(&world.scene, &world.geometry, ray, hit)
}

#[test]
fn a_ball_by_formula_is_the_exact_ball() {
    let (formula, exact) =
        (implicit("x^2 + y^2 + z^2 = 1", 1.5, false), world(Shape::Sphere { radius: 1.0 }));
    let mut met = 0;
    for ray in rays(4000, 1.0) {
        let (one, other) = (hit(&formula, &ray), hit(&exact, &ray));
        let Some((one, other)) = one.zip(other) else {
            // Only where the ray all but touches.
            let nearest = ray.origin.cross(ray.direction).length();
            assert!(one.is_some() == other.is_some() || (nearest - 1.0).abs() < 1e-6, "{ray:?}");
            continue;
        };
        met += 1;
        // Near the outline the root moves fast with the rounding of the ray.
        let cosine = point(&exact, &ray, other).geometric_normal.dot(ray.direction).abs();
        assert!((one.hit.t - other.hit.t).abs() * cosine < 4e-6, "{ray:?}: {} {}", one.hit.t, other.hit.t);
        let (one, other) = (point(&formula, &ray, one), point(&exact, &ray, other));
        assert!(one.geometric_normal.dot(other.geometric_normal) > 1.0 - 1e-5);
    }
    assert!(met > 1000);
}

/// From every point of the surface, rays outward are free and rays inward find the other side.
#[test]
fn surfaces_are_left_without_meeting_them_again() {
    let heart = "(x^2+9/4*y^2+z^2-1)^3 - x^2*z^3 - 9/80*y^2*z^3";
    let cone = Frustum { bottom_radius: 1.0, top_radius: 0.25, height: 2.0, capped: true };
    for world in [
        implicit("x^2 + y^2 + z^2 - 1", 1.5, false),
        implicit(heart, 1.5, false),
        implicit("sin(4*x)*cos(4*y) + sin(4*y)*cos(4*z) + sin(4*z)*cos(4*x)", 1.0, true),
        world(Shape::Traced(Traced::Frustum(cone))),
    ] {
        let mut left = 0;
        for ray in rays(2000, 1.0) {
            let Some(found) = hit(&world, &ray) else { continue };
            let from = point(&world, &ray, found);
            let outward = from.geometric_normal;
            if let Some(again) = hit(&world, &from.exit().ray_toward(outward)) {
                assert!(again.hit.t > 1e-4, "{ray:?} meets what it left: {}", again.hit.t);
            }
            let inward = from.exit().ray_toward(-outward);
            let through = hit(&world, &inward).expect("another side");
            assert!(through.hit.t > 1e-6);
            left += 1;
        }
        assert!(left > 300, "{left}");
    }
}

#[test]
fn a_closed_formula_has_the_sides_of_its_box() {
    let slab = implicit("y", 1.0, true);
    let from_below = hit(&slab, &Ray::new(vec3(0.25, -3.0, 0.5), Vec3::Y)).expect("the floor");
    assert_eq!(from_below.hit.t, 2.0);
    let from_above = hit(&slab, &Ray::new(vec3(0.25, 3.0, 0.5), Vec3::NEG_Y)).expect("the surface");
    assert_eq!(from_above.hit.t, 3.0);
    let open = implicit("y", 1.0, false);
    assert!(hit(&open, &Ray::new(vec3(0.25, -3.0, 0.5), Vec3::new(0.0, 0.5, 0.0))).is_some());
    assert!(hit(&open, &Ray::new(vec3(3.0, -0.5, 0.5), Vec3::NEG_X)).is_none());
}

/// The sheet has the same triangles, so the ray meets the same places to the last bit; textures and normals agree.
#[test]
fn a_height_field_is_its_sheet() {
    let wish = Terrain { columns: 33, rows: 27, size: 2.0, ..Terrain::default() };
    let mut field = height_map::terrain(&wish).expect("land");
    // A hole, and a field that is not square.
    field.heights[200] = f32::NAN;
    let sheet = world(Shape::Mesh(height_map::sheet(&field)));
    let traced = world(Shape::Traced(Traced::HeightField(Arc::new(field))));
    let mut met = 0;
    for ray in rays(6000, 0.8) {
        let (one, other) = (hit(&traced, &ray), hit(&sheet, &ray));
        assert_eq!(one.map(|hit| hit.hit.t), other.map(|hit| hit.hit.t), "{ray:?}");
        let (Some(one), Some(other)) = (one, other) else { continue };
        let (one, other) = (point(&traced, &ray, one), point(&sheet, &ray, other));
        assert!(one.geometric_normal.dot(other.geometric_normal) > 1.0 - 1e-5);
        assert!(one.frame.normal.dot(other.frame.normal) > 1.0 - 1e-5, "{ray:?}");
        assert!(one.position.distance(other.position) < 1e-6);
        met += 1;
    }
    assert!(met > 2000, "{met}");
}

#[test]
fn the_smallest_fields_work() {
    for (width, height) in [(2, 2), (2, 3), (5, 2), (3, 3)] {
        let heights = (0..width * height).map(|i| (i % 3) as f32 * 0.1).collect();
        let field = HeightField::new(width, height, heights, Vec2::new(2.0, 1.0)).expect("a field");
        let sheet = world(Shape::Mesh(height_map::sheet(&field)));
        let traced = world(Shape::Traced(Traced::HeightField(Arc::new(field))));
        for ray in rays(500, 0.7) {
            assert_eq!(
                hit(&traced, &ray).map(|h| h.hit.t),
                hit(&sheet, &ray).map(|h| h.hit.t),
                "{width} × {height}"
            );
        }
    }
}

/// Places on the mesh approach the exact cylinder and cone, with the same texture coordinates.
#[test]
fn cylinders_and_cones_are_what_their_meshes_approach() {
    let forms = [
        (Frustum { bottom_radius: 1.0, top_radius: 1.0, height: 2.0, capped: true }, true),
        (Frustum { bottom_radius: 1.0, top_radius: 0.3, height: 1.5, capped: true }, true),
        (Frustum { bottom_radius: 0.5, top_radius: 1.0, height: 1.0, capped: false }, false),
    ];
    for (frustum, capped) in forms {
        let Frustum { bottom_radius, top_radius, height, .. } = frustum;
        let mesh: TriangleMesh = generate::cone(bottom_radius, top_radius, height, 4096, 1, capped);
        let (exact, mesh) = (world(Shape::Traced(Traced::Frustum(frustum))), world(Shape::Mesh(mesh)));
        let (mut met, mut apart) = (0, 0);
        for ray in rays(2000, 1.0) {
            let (one, other) = (hit(&exact, &ray), hit(&mesh, &ray));
            let (Some(one), Some(other)) = (one, other) else {
                apart += usize::from(one.is_some() != other.is_some());
                continue;
            };
            let (one, other) = (point(&exact, &ray, one), point(&mesh, &ray, other));
            let near = one.position.distance(other.position) < 2e-3;
            apart += usize::from(!near);
            if near && one.geometric_normal.dot(other.geometric_normal) > 0.99 {
                assert!(one.frame.normal.dot(other.frame.normal) > 1.0 - 1e-4, "{ray:?}");
                met += 1;
            }
        }
        // Along the outline a ray may meet one and miss the other.
        assert!(met > 700 && apart < 10, "{frustum:?}: {met} {apart}");
    }
}
