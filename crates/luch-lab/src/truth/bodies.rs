//! F6 to F8 and F11: bodies and floors in uniform light.

use super::stage::{aimed, black, floor, gray, lamp, put, surround};
use super::{Case, Family, Way};
use glam::{Affine3A, EulerRot, Mat3, Quat, Vec3};
use luch_image::Rgb;
use luch_mesh::{TriangleMesh, generate};
use luch_scene::preset::{material_ball, parallelogram};
use luch_scene::{Camera, Material, Normals, Reflectance, Scene, Shape, Surface};

/// Convex bodies about the origin.
fn convex() -> [(&'static str, Shape); 4] {
    [
        ("sphere", Shape::Sphere { radius: 1.0 }),
        ("cuboid", Shape::Mesh(generate::cuboid(Vec3::new(1.0, 0.7, 1.2), [2, 1, 1]))),
        ("icosphere", Shape::Mesh(generate::icosphere(1.0, 2))),
        ("cone", Shape::Mesh(generate::cone(0.9, 0.0, 1.5, 16, 2, true))),
    ]
}

/// The body alone in light of radiance 1, its triangles flat, and the camera that sees all of it.
fn in_white(shape: Shape, material: Material, turned: Affine3A) -> (Scene, Camera) {
    let mut scene = material_ball(shape, material);
    scene.settings.normals = Normals::Flat;
    scene.instances[0].placement = turned;
    let camera = scene.cameras[0].camera;
    (scene, camera)
}

fn askew() -> Affine3A {
    Affine3A::from_quat(Quat::from_euler(EulerRot::XYZ, 0.5, 0.7, 0.2))
}

pub(super) fn convex_bodies() -> Vec<Case> {
    let mut cases = Vec::new();
    for (name, shape) in convex() {
        let (scene, _) = in_white(shape.clone(), gray(0.6), askew());
        let camera = aimed(Vec3::new(0.0, 0.0, 4.0), Vec3::new(0.21, -0.13, 0.0));
        let case = Case::new(Family::F6, format!("gray {name}"), &scene, camera, 0.6);
        cases.push(case.exactly_by(&[Way::PLAIN]).by(&[Way::PATH, Way::DIRECT]));
        let (scene, camera) = in_white(shape, gray(1.0), askew());
        let case = Case::new(Family::F6, format!("white {name}"), &scene, camera, 1.0);
        cases.push(case.exactly_by(&[Way::PLAIN]));
    }
    cases
}

/// Two sheets that meet at an edge.
fn wedge() -> TriangleMesh {
    let corner = Vec3::new(0.0, -0.8, -1.0);
    let mut mesh = parallelogram(corner, Vec3::new(0.4, 0.0, 2.0), Vec3::Y * 1.6);
    mesh.append(&parallelogram(corner, Vec3::new(-0.4, 0.0, 2.0), Vec3::Y * 1.6), 0);
    mesh
}

/// A cylinder open at one end: the upper cap is left out.
fn cup() -> TriangleMesh {
    let mut mesh = generate::cylinder(0.6, 1.2, 24, 1, true);
    let heights: Vec<f32> = mesh.positions.iter().map(|p| p.y).collect();
    let top = heights.iter().copied().fold(f32::MIN, f32::max);
    mesh.triangles.retain(|corners| !corners.iter().all(|&i| heights[i as usize] >= top - 1e-4));
    TriangleMesh::new(mesh.positions, mesh.triangles)
}

pub(super) fn concave_bodies() -> Vec<Case> {
    let torus = generate::torus(0.7, 0.28, 24, 12);
    let bodies = [("wedge", wedge(), 0.0), ("cup", cup(), 1.3), ("torus", torus, 0.8)];
    let case = |(name, mesh, turned): (&str, TriangleMesh, f32)| {
        let (scene, camera) = in_white(Shape::Mesh(mesh), gray(1.0), Affine3A::from_rotation_x(turned));
        let case = Case::new(Family::F7, name, &scene, camera, 1.0);
        case.exactly_by(&[Way::PLAIN]).by(&[Way::PATH])
    };
    bodies.into_iter().map(case).collect()
}

fn glass(ior: f32, roughness: f32) -> Material {
    Material::new(Surface::Dielectric { ior, roughness: roughness.into(), tint: Rgb::WHITE.into() })
}

fn mirror(roughness: f32) -> Material {
    let reflectance = Reflectance::Color(Rgb::WHITE.into());
    Material::new(Surface::Conductor { reflectance, roughness: roughness.into(), compensated: true })
}

pub(super) fn unabsorbing_bodies() -> Vec<Case> {
    let mut cases = Vec::new();
    for (name, shape) in convex() {
        for ior in [1.33, 1.5, 2.4, 0.7] {
            let (scene, camera) = in_white(shape.clone(), glass(ior, 0.0), askew());
            let case = Case::new(Family::F8, format!("{name} of index {ior}"), &scene, camera, 1.0);
            let case = case.exactly_by(&[Way::PATH]);
            // A plain path plays roulette with radiance as it is inside, which costs variance: one index will do.
            cases.push(if ior == 1.5 { case.by(&[Way::PLAIN]) } else { case });
        }
        let (scene, camera) = in_white(shape, mirror(0.0), askew());
        let case = Case::new(Family::F8, format!("{name} as a mirror"), &scene, camera, 1.0);
        cases.push(case.exactly_by(&[Way::PATH, Way::PLAIN]));
    }
    let sphere = |material| in_white(Shape::Sphere { radius: 1.0 }, material, askew()).0;
    for roughness in [0.25, 0.5, 1.0] {
        for (name, material) in [("mirror", mirror(roughness)), ("glass", glass(1.5, roughness))] {
            let camera = aimed(Vec3::new(0.0, 0.0, 4.0), Vec3::new(0.43, 0.3, 0.0));
            let name = format!("{name} of roughness {roughness}");
            let case = Case::new(Family::F8, name, &sphere(material), camera, 1.0);
            cases.push(case.by(&[Way::PATH, Way::PLAIN]));
        }
    }
    let camera = aimed(Vec3::new(0.0, 0.0, 4.0), Vec3::ZERO);
    let all = [Way::PATH, Way::PLAIN, Way::DIRECT];
    cases.push(Case::new(Family::F8, "black body", &sphere(black()), camera, 0.0).exactly_by(&all));
    cases.push(Case::new(Family::F8, "absorbing lamp", &sphere(lamp(0.25)), camera, 0.25).exactly_by(&all));
    cases
}

pub(super) fn under_the_sky() -> Vec<Case> {
    let mut scene = Scene::default();
    floor(&mut scene, 0.7);
    surround(&mut scene, 2.0);
    let camera = aimed(Vec3::new(1.0, 2.0, 0.5), Vec3::ZERO);
    let open = Case::new(Family::F11, "open sky", &scene, camera, 1.4);
    // An endless black wall hides half of it, wherever one stands.
    let upright =
        Affine3A::from_mat3_translation(Mat3::from_rotation_z(-std::f32::consts::FRAC_PI_2), Vec3::X * -0.01);
    put(&mut scene, Shape::Plane, black(), upright);
    let walled = Case::new(Family::F11, "beside a wall", &scene, camera, 0.7);
    vec![
        open.exactly_by(&[Way::PLAIN]).by(&[Way::PATH, Way::DIRECT]),
        walled.by(&[Way::PATH, Way::PLAIN, Way::DIRECT]),
    ]
}
