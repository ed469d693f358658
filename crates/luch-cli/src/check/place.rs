//! Where cameras stand.

use glam::Vec3;
use luch::bvh::Aabb;
use luch::mesh::{TriangleMesh, measure, weld};
use luch::scene::{NamedCamera, Scene, Shape};

/// What is odd about where cameras are, in sentences.
pub(crate) fn advice(scene: &Scene, bounds: &Aabb) -> Vec<String> {
    scene
        .cameras
        .iter()
        .flat_map(|camera| inside(scene, camera).into_iter().chain(far_away(camera, bounds)))
        .collect()
}

/// Numbers of 24 bits leave little of a scene that is this many times smaller than its distance.
const FARTHEST: f32 = 1e5;

fn far_away(named: &NamedCamera, bounds: &Aabb) -> Option<String> {
    let size = (bounds.max - bounds.min).length();
    let distance = (named.camera.position - bounds.centroid()).length();
    (!bounds.is_empty() && size > 0.0 && distance > FARTHEST * size).then(|| {
        format!(
            "camera \"{}\" is {distance} m away from a scene of {size} m: positions may be too coarse",
            named.name
        )
    })
}

/// Bodies that a camera is in, which is right for rooms and wrong for nearly everything else.
fn inside(scene: &Scene, named: &NamedCamera) -> Vec<String> {
    let bodies = scene.instances.iter().filter(|instance| {
        let eye = instance.placement.inverse().transform_point3(named.camera.position);
        match &*scene.shapes[instance.shape.index()] {
            Shape::Sphere { radius } => eye.length() < *radius,
            Shape::Mesh(mesh) => mesh.bounds().contains(eye) && encloses(mesh, eye),
            Shape::Traced(form) => form.encloses(eye),
            Shape::Disc { .. } | Shape::Plane => false,
        }
    });
    bodies
        .map(|body| {
            format!(
                "camera \"{}\" is inside object \"{}\", which is closed: right only for a room",
                named.name, body.name
            )
        })
        .collect()
}

/// Whether a closed mesh has the point inside: by the majority of three rays that count the triangles they cross, so that one ray
/// through an edge does no harm.
fn encloses(mesh: &TriangleMesh, point: Vec3) -> bool {
    let welded = weld::weld_exact(mesh).mesh;
    let directions =
        [Vec3::new(0.331, 0.927, 0.176), Vec3::new(-0.812, 0.135, 0.568), Vec3::new(0.241, -0.433, -0.869)];
    let odd = |direction: &&Vec3| {
        let crossed = (0..mesh.triangles.len()).filter(|t| crosses(mesh.corners(*t), point, **direction));
        crossed.count() % 2 == 1
    };
    measure::closedness(&welded).is_closed() && directions.iter().filter(odd).count() >= 2
}

/// Möller and Trumbore 1997: whether the ray meets the triangle.
fn crosses([a, b, c]: [Vec3; 3], origin: Vec3, direction: Vec3) -> bool {
    let (ab, ac) = (b - a, c - a);
    let p = direction.cross(ac);
    let determinant = ab.dot(p);
    if determinant == 0.0 {
        return false;
    }
    let s = origin - a;
    let q = s.cross(ab);
    let (u, v, t) = (s.dot(p) / determinant, direction.dot(q) / determinant, ac.dot(q) / determinant);
    u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use luch::mesh::generate;

    #[test]
    fn a_ball_encloses_its_middle_and_nothing_outside() {
        let ball = generate::icosphere(1.0, 3);
        assert!(encloses(&ball, Vec3::new(0.1, 0.2, 0.3)));
        assert!(!encloses(&ball, Vec3::new(0.9, 0.9, 0.0)));
        let plane = generate::plane(glam::Vec2::splat(2.0), [1, 1]);
        assert!(!encloses(&plane, Vec3::ZERO));
    }
}
