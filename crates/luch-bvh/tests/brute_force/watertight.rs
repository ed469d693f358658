//! No ray leaves a closed convex mesh through an edge or a vertex.

use crate::meshes::{self, Mesh};
use crate::random::Random;
use glam::{Quat, Vec3, vec3};
use luch_bvh::{Geometry, Instance, Quality, Ray, SceneTree, TriangleBvh};
use std::sync::Arc;

/// Rays from inside through points of edges and vertices; every one has to hit. With `reach` below one everything happens
/// that close to an edge, in sizes of the triangle.
fn leaks(mesh: &Mesh, rays: usize, reach: f32, blocked: impl Fn(&Ray) -> bool) -> usize {
    let mut random = Random::new(21);
    let middle = mesh.positions.iter().sum::<Vec3>() / mesh.positions.len() as f32;
    let leaking = (0..rays).filter(|index| {
        let corners = mesh.corners(random.below(mesh.triangles.len()));
        let [a, b] = [corners[index % 3], corners[(index + 1) % 3]];
        let edge = if index % 4 == 0 { a } else { a + (b - a) * random.unit() };
        // Through the edge, or past it by some digit.
        let aside = [0.0, 0.0, 1e-6, 1e-5, 1e-4, 1e-3][random.below(6)];
        let along = if reach < 1.0 { (b - a) * random.signed() * reach } else { Vec3::ZERO };
        let target = edge + along + random.vector() * (b - a).length() * reach * aside;
        let vertex = |random: &mut Random| mesh.corners(random.below(mesh.triangles.len()))[0];
        let near = if reach < 1.0 { edge } else { vertex(&mut random) };
        let toward = middle + (vertex(&mut random) - middle) * 0.7;
        let origin = near + (toward - near) * (0.05 + 0.95 * random.unit()) * reach;
        let length = [1e-3, 1.0, 1e3][index % 3];
        !blocked(&Ray::new(origin, (target - origin) * length))
    });
    leaking.count()
}

#[test]
fn a_million_rays_through_edges_and_vertices() {
    let turned = Quat::from_euler(glam::EulerRot::XYZ, 0.3, 1.1, -0.7);
    let places = [
        meshes::sphere(24, 48),
        meshes::sphere(24, 48).mapped("turned", |p| turned * p),
        meshes::sphere(16, 24).mapped("far away", |p| turned * p + vec3(1e4, -3e5, 2e3)),
        meshes::sphere(16, 24).mapped("stretched", |p| turned * (p * vec3(1e3, 1.0, 1e-2))),
        meshes::cube().mapped("turned", |p| turned * p),
        meshes::cube(),
        meshes::sphere(12, 16).mapped("tiny", |p| p * 1e-18),
        meshes::sphere(12, 16).mapped("huge", |p| p * 1e18),
    ];
    for mesh in places {
        let tree = TriangleBvh::build(&mesh.positions, &mesh.triangles, Quality::Balanced);
        assert_eq!(leaks(&mesh, 150_000, 1.0, |ray| tree.any(ray)), 0, "{}", mesh.name);
    }
}

#[test]
fn not_even_close_to_an_edge_of_large_triangles() {
    let turned = Quat::from_euler(glam::EulerRot::XYZ, 0.3, 1.1, -0.7);
    for mesh in [meshes::cube(), meshes::cube().mapped("turned", |p| turned * p)] {
        let mesh = mesh.mapped("large", |p| p * 1e3);
        let tree = TriangleBvh::build(&mesh.positions, &mesh.triangles, Quality::Balanced);
        for reach in [0.5, 0.1, 1e-2, 1e-3] {
            assert_eq!(leaks(&mesh, 100_000, reach, |ray| tree.any(ray)), 0, "{} {reach}", mesh.name);
        }
    }
}

#[test]
fn nor_through_an_instance() {
    let sphere = meshes::sphere(16, 24);
    let tree = Arc::new(TriangleBvh::build(&sphere.positions, &sphere.triangles, Quality::Balanced));
    let placement = glam::Affine3A::from_scale_rotation_translation(
        vec3(2.0, -0.5, 30.0),
        Quat::from_euler(glam::EulerRot::XYZ, 0.3, 1.1, -0.7),
        vec3(100.0, -20.0, 3.0),
    );
    let instance = Instance { geometry: 0, placement, cull_back: false, filtered: false };
    let scene = SceneTree::build(vec![Geometry::Triangles(tree)], &[instance], Quality::Balanced);
    let world = sphere.mapped("placed", |p| placement.transform_point3(p));
    assert_eq!(leaks(&world, 300_000, 1.0, |ray| scene.any(ray)), 0);
}
