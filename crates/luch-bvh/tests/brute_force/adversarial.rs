//! Rays chosen to be difficult for a given mesh.

use crate::meshes::Mesh;
use crate::random::Random;
use glam::{Vec3, vec3};
use luch_bvh::{Aabb, Ray};

/// Rays of every kind, `each` of each.
pub(crate) fn rays(mesh: &Mesh, each: usize, seed: u64) -> Vec<Ray> {
    let mut random = Random::new(seed);
    let finite = mesh.positions.iter().copied().filter(|position| position.is_finite());
    let bounds = Aabb::of_points(finite);
    let (middle, size) = (bounds.centroid(), (bounds.max - bounds.min).max_element());
    let mut rays = Vec::new();
    for _ in 0..each {
        let corners = mesh.corners_within(&mut random);
        let [a, b, c] = corners;
        let outside = middle + random.vector() * size * 1.5;
        let inside = middle + random.vector() * size * 0.2;
        let on_edge = a + (b - a) * random.unit();
        let (u, v) = (random.unit() * 0.5, random.unit() * 0.5);
        let on_face = a + (b - a) * u + (c - a) * v;
        let normal = (b - a).cross(c - a);
        let axis = [Vec3::X, Vec3::Y, Vec3::Z, Vec3::NEG_X, Vec3::NEG_Y, Vec3::NEG_Z][random.below(6)];
        let targets = [random.vector() * size + middle, a, on_edge, on_face];
        for target in targets {
            rays.push(Ray::new(outside, target - outside));
            rays.push(Ray::new(inside, target - inside));
            rays.push(Ray::segment(outside, target));
            // Along an axis through the same point, from far away and from the point itself.
            rays.push(Ray::new(target - axis * size * 2.0, axis));
            rays.push(Ray::new(target, axis));
            rays.push(Ray::new(target, random.vector()));
        }
        // Along an edge, within the plane, grazing it.
        rays.push(Ray::new(a - (b - a), b - a));
        rays.push(Ray::new(on_face - (c - b) * 3.0, c - b));
        rays.push(Ray::new(on_face - (c - b) * 3.0, (c - b) + normal * 1e-7));
        // Lengths of the direction far from one, short and reversed intervals, zeroes of both signs.
        let toward = on_face - outside;
        for scale in [1e-18, 1e-6, 1e6, 1e18] {
            rays.push(Ray::new(outside, toward * scale));
        }
        let t = random.unit();
        rays.push(Ray { t_min: t, ..Ray::new(outside, toward) });
        rays.push(Ray { t_min: 1.0, t_max: 1.0, ..Ray::new(outside, toward) });
        rays.push(Ray { t_min: 1.0, t_max: t, ..Ray::new(outside, toward) });
        rays.push(Ray { t_min: -2.0, t_max: 2.0, ..Ray::new(on_face, toward) });
        rays.push(Ray { t_min: f32::NAN, ..Ray::new(outside, toward) });
        rays.push(Ray { t_max: f32::NAN, ..Ray::new(outside, toward) });
        rays.push(Ray { t_min: f32::INFINITY, ..Ray::new(outside, toward) });
        for zero in [0.0, -0.0] {
            rays.push(Ray::new(outside, vec3(zero, toward.y, toward.z)));
            rays.push(Ray::new(vec3(outside.x, outside.y, on_face.z), vec3(toward.x, toward.y, zero)));
            rays.push(Ray::new(outside, vec3(zero, zero, zero)));
        }
        for odd in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, f32::MAX, f32::MIN_POSITIVE, 1e-40] {
            rays.push(Ray::new(outside, vec3(odd, toward.y, toward.z)));
            rays.push(Ray::new(outside, vec3(odd, odd, odd)));
            rays.push(Ray::new(vec3(outside.x, odd, outside.z), toward));
        }
    }
    rays
}

impl Mesh {
    /// The corners of a random triangle that has three finite ones.
    pub(crate) fn corners_within(&self, random: &mut Random) -> [Vec3; 3] {
        for _ in 0..1000 {
            let triangle = random.below(self.triangles.len());
            let known =
                self.triangles[triangle].iter().all(|corner| (*corner as usize) < self.positions.len());
            if known && self.corners(triangle).iter().all(|corner| corner.is_finite()) {
                return self.corners(triangle);
            }
        }
        panic!("{} has no sound triangle", self.name);
    }
}
