//! Area, volume, centre, bounds, and whether a mesh is closed. Sums run in `f64`.

mod closedness;

use glam::{DVec3, Vec3};
use luch_bvh::Aabb;

use crate::TriangleMesh;
pub use closedness::{Closedness, EdgeFault, closedness};

/// Total area of the triangles.
pub fn area(mesh: &TriangleMesh) -> f64 {
    triangles(mesh).map(|[a, b, c]| (b - a).cross(c - a).length()).fold(0.0, |sum, part| sum + part) / 2.0
}

/// Signed volume by the divergence theorem: ⅙ Σ A · (B × C). Positive if the triangles face outward.
///
/// Means something for closed meshes only. Corners are taken relative to the middle of the bounds, so that a mesh far
/// from the origin loses no digits.
pub fn volume(mesh: &TriangleMesh) -> f64 {
    let origin = middle(mesh);
    triangles(mesh).map(|corners| six_tetrahedra(corners, origin)).fold(0.0, |sum, part| sum + part) / 6.0
}

/// Centre of mass of the enclosed body if it has a volume, else of the surface; `None` if there is neither.
pub fn centroid(mesh: &TriangleMesh) -> Option<Vec3> {
    let origin = middle(mesh);
    let (mut moment, mut total) = (DVec3::ZERO, 0.0);
    for corners in triangles(mesh) {
        let part = six_tetrahedra(corners, origin);
        // The fourth corner is the origin.
        moment += (corners[0] + corners[1] + corners[2] - 3.0 * origin) / 4.0 * part;
        total += part;
    }
    let flat_scale = area(mesh);
    let closed = total.abs() > 1e-9 * flat_scale * flat_scale.sqrt() && closedness(mesh).is_closed();
    if closed { finite(origin + moment / total) } else { surface_centroid(mesh) }
}

/// Centre of mass of the surface, every piece of area counting alike; `None` if there is no area.
pub fn surface_centroid(mesh: &TriangleMesh) -> Option<Vec3> {
    let (mut moment, mut total) = (DVec3::ZERO, 0.0);
    for [a, b, c] in triangles(mesh) {
        let part = (b - a).cross(c - a).length();
        moment += (a + b + c) / 3.0 * part;
        total += part;
    }
    finite(moment / total)
}

/// The smallest box with sides along the axes around all triangles. Positions that no triangle uses do not count.
pub fn bounds(mesh: &TriangleMesh) -> Aabb {
    Aabb::of_points(mesh.triangles.iter().flatten().map(|&i| mesh.positions[i as usize]))
}

/// A ball around all triangles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoundingSphere {
    /// Its centre.
    pub center: Vec3,
    /// Its radius.
    pub radius: f32,
}

/// A ball that holds all triangles, near the smallest one; `None` if there are none.
///
/// Ritter's method ("An Efficient Bounding Sphere", 1990), started from the widest of thirteen directions
/// (Larsson, "Fast and Tight Fitting Bounding Spheres", 2008) and repeated on shrunken balls, of which the best is kept
/// (Ericson, "Real-Time Collision Detection", 2005, 4.3.4).
pub fn bounding_sphere(mesh: &TriangleMesh) -> Option<BoundingSphere> {
    let corners = || mesh.triangles.iter().flatten().map(|&i| mesh.positions[i as usize].as_dvec3());
    let mut best = grown(widest_pair(corners)?, corners());
    let mut ball = best;
    for round in 0..8 {
        ball.radius *= 0.95;
        // Both directions in turn, or the ball keeps the bias of the order.
        ball = if round % 2 == 0 {
            let backward = mesh.triangles.iter().flatten().rev();
            grown(ball, backward.map(|&i| mesh.positions[i as usize].as_dvec3()))
        } else {
            grown(ball, corners())
        };
        if ball.radius < best.radius {
            best = ball;
        }
    }
    // Rounding the centre to f32 moves it: measure again from there and round outward.
    let center = best.center.as_vec3();
    let radius = corners().map(|corner| corner.distance(center.as_dvec3())).fold(0.0, f64::max);
    Some(BoundingSphere { center, radius: (radius as f32).next_up() })
}

#[derive(Clone, Copy)]
struct Ball {
    center: DVec3,
    radius: f64,
}

/// The ball over the two points farthest apart along one of thirteen directions.
fn widest_pair<I: Iterator<Item = DVec3>>(corners: impl Fn() -> I) -> Option<Ball> {
    let first = corners().next()?;
    let mut widest = [first; 2];
    for direction in directions() {
        let (mut low, mut high) = (first, first);
        for corner in corners() {
            let along = corner.dot(direction);
            if along < low.dot(direction) {
                low = corner;
            } else if along > high.dot(direction) {
                high = corner;
            }
        }
        if low.distance_squared(high) > widest[0].distance_squared(widest[1]) {
            widest = [low, high];
        }
    }
    Some(Ball { center: (widest[0] + widest[1]) / 2.0, radius: widest[0].distance(widest[1]) / 2.0 })
}

/// The ball moved and enlarged by each point that stands out.
fn grown(ball: Ball, corners: impl Iterator<Item = DVec3>) -> Ball {
    let Ball { mut center, mut radius } = ball;
    for corner in corners {
        let distance = corner.distance(center);
        if distance > radius {
            let larger = (radius + distance) / 2.0;
            center += (corner - center) * ((distance - larger) / distance);
            radius = larger;
        }
    }
    Ball { center, radius }
}

/// Axes, edges and diagonals of a cube, one of each opposite pair.
fn directions() -> impl Iterator<Item = DVec3> {
    let steps = [-1.0, 0.0, 1.0];
    let all = steps.into_iter().flat_map(move |x| {
        steps.into_iter().flat_map(move |y| steps.into_iter().map(move |z| DVec3::new(x, y, z)))
    });
    all.skip(14)
}

fn triangles(mesh: &TriangleMesh) -> impl Iterator<Item = [DVec3; 3]> {
    mesh.triangles.iter().map(|corners| corners.map(|i| mesh.positions[i as usize].as_dvec3()))
}

fn middle(mesh: &TriangleMesh) -> DVec3 {
    let Aabb { min, max } = bounds(mesh);
    let middle = (min.as_dvec3() + max.as_dvec3()) / 2.0;
    if middle.is_finite() { middle } else { DVec3::ZERO }
}

/// Six times the signed volume between a triangle and `origin`.
fn six_tetrahedra(corners: [DVec3; 3], origin: DVec3) -> f64 {
    let [a, b, c] = corners.map(|v| v - origin);
    a.dot(b.cross(c))
}

fn finite(point: DVec3) -> Option<Vec3> {
    let point = point.as_vec3();
    point.is_finite().then_some(point)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate;
    use glam::Affine3A;

    #[test]
    fn a_box_far_away_by_hand() {
        let mut mesh = generate::cuboid(Vec3::new(1.0, 2.0, 3.0), [2, 1, 1]);
        mesh.transform(&Affine3A::from_translation(Vec3::new(4096.0, 0.0, -8192.0)));
        assert_eq!(area(&mesh), 22.0);
        assert_eq!(volume(&mesh), 6.0);
        assert_eq!(centroid(&mesh), Some(Vec3::new(4096.0, 0.0, -8192.0)));
        let Aabb { min, max } = bounds(&mesh);
        assert_eq!(max - min, Vec3::new(1.0, 2.0, 3.0));
    }

    #[test]
    fn the_centre_of_a_cone_is_a_quarter_up() {
        let cone = generate::cone(1.0, 0.0, 4.0, 64, 1, true);
        let centre = centroid(&cone).unwrap();
        assert!((centre - Vec3::new(0.0, -1.0, 0.0)).length() < 1e-6, "{centre}");
        let open = generate::plane(glam::Vec2::ONE, [3, 2]);
        assert!(centroid(&open).unwrap().length() < 1e-7);
        assert_eq!(centroid(&TriangleMesh::default()), None);
    }

    #[test]
    fn bounding_spheres_hold_everything_and_are_not_much_too_large() {
        for generator in crate::generate::Generator::examples() {
            let points: Vec<DVec3> = generator.mesh().positions.iter().map(|p| p.as_dvec3()).collect();
            let ball = bounding_sphere(&generator.mesh()).unwrap();
            let center = ball.center.as_dvec3();
            assert!(points.iter().all(|p| p.distance(center) <= f64::from(ball.radius)), "{generator:?}");
            // Jung's theorem: the smallest ball has a radius of at most √(3/8) times the largest distance. Bodies for which
            // that is reached, such as the tetrahedron, show what Ritter's ball is larger: some per cent, as he says.
            let distances = points.iter().flat_map(|a| points.iter().map(|b| a.distance(*b)));
            let most = 1.06 * distances.fold(0.0, f64::max) * (3.0f64 / 8.0).sqrt();
            assert!(f64::from(ball.radius) <= most, "{generator:?}: {} of {most}", ball.radius);
        }
        let ball = bounding_sphere(&generate::sphere(3.0, 32, 16)).unwrap();
        assert!((ball.radius - 3.0).abs() < 1e-5 && ball.center.length() < 1e-5, "{ball:?}");
    }
}
