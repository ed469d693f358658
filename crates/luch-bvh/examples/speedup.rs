//! How many tests a ray costs: the loop over all triangles, the same behind a sphere or a box around the whole mesh, the
//! tree. Counted, not timed, so the figures are the same everywhere.
#![allow(clippy::print_stdout)]

use glam::{Vec2, Vec3, vec3};
use luch_bvh::shape::Sphere;
use luch_bvh::triangle::ShearedRay;
use luch_bvh::{Aabb, Bvh, Hit, Quality, Ray, SlabRay, Triangle};
use std::f32::consts::{PI, TAU};

/// A sphere of `8 · fineness²` triangles, drawn out to an egg.
fn egg(fineness: u32) -> Vec<Triangle> {
    let (rings, sectors) = (2 * fineness, 2 * fineness);
    let point = |ring: u32, sector: u32| {
        let polar = Vec2::from_angle(PI * ring as f32 / rings as f32);
        let around = Vec2::from_angle(TAU * sector as f32 / sectors as f32);
        vec3(polar.y * around.x, 2.0 * polar.x, -polar.y * around.y)
    };
    let cell = |index: u32| {
        let (ring, sector) = (index / sectors, index % sectors);
        let [a, b] = [point(ring, sector), point(ring + 1, sector)];
        let [c, d] = [point(ring + 1, sector + 1), point(ring, sector + 1)];
        [Triangle { a, b, c }, Triangle { a, b: c, c: d }]
    };
    (0..rings * sectors).flat_map(cell).collect()
}

/// How often each kind of test ran.
#[derive(Default)]
struct Count {
    bounds: usize,
    triangles: usize,
}

fn main() {
    let rays: Vec<Ray> = (0..64 * 64)
        .map(|i| {
            Ray::new(
                vec3(0.0, 0.0, 9.0),
                vec3((i % 64) as f32 / 8.0 - 4.0, (i / 64) as f32 / 8.0 - 4.0, -9.0),
            )
        })
        .collect();
    println!("tests per ray       loop     sphere, loop        box, loop       tree: triangles, hits");
    for fineness in [4, 16, 64] {
        let triangles = egg(fineness);
        let boxes: Vec<Aabb> = triangles.iter().map(Triangle::bounds).collect();
        let tree = Bvh::build(&boxes, Quality::Balanced);
        let whole = tree.bounds();
        let radius = triangles.iter().map(|triangle| triangle.a.length()).fold(0.0, f32::max);
        let sphere = Sphere { center: Vec3::ZERO, radius: radius * 1.000_01 };
        let [mut in_sphere, mut in_box, mut in_tree] = [(); 3].map(|()| Count::default());
        let mut hits = 0;
        for ray in &rays {
            let (Some(slab), Some(sheared)) = (SlabRay::new(ray), ShearedRay::new(ray)) else { continue };
            in_sphere.bounds += 1;
            if sphere.crossings(ray).iter().any(Option::is_some) {
                in_sphere.triangles += triangles.len();
            }
            in_box.bounds += 1;
            if slab.interval(&whole).is_some() {
                in_box.triangles += triangles.len();
            }
            let leaf = |primitive: u32, _: &Ray| {
                in_tree.triangles += 1;
                let crossing = sheared.hit(&triangles[primitive as usize])?;
                Some(Hit { t: crossing.t, u: crossing.u, v: crossing.v, primitive })
            };
            hits += usize::from(tree.nearest(ray, leaf).is_some());
        }
        let per_ray = |count: usize| count as f64 / rays.len() as f64;
        println!(
            "{:6} triangles {:8} {:4.0} + {:11.1} {:4.0} + {:11.1} {:15.2} {:13.2}",
            triangles.len(),
            triangles.len(),
            per_ray(in_sphere.bounds),
            per_ray(in_sphere.triangles),
            per_ray(in_box.bounds),
            per_ray(in_box.triangles),
            per_ray(in_tree.triangles),
            per_ray(hits),
        );
    }
}
