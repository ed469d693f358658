//! What is under the mouse? A picture of letters: which face of an octahedron each character cell shows.
#![allow(clippy::print_stdout)]

use glam::{Vec3, vec3};
use luch_bvh::{Quality, Ray, TriangleBvh};

fn main() {
    let positions = [Vec3::X, Vec3::NEG_X, Vec3::Y, Vec3::NEG_Y, Vec3::Z, Vec3::NEG_Z];
    let mut triangles = Vec::new();
    for (y, ring) in [(2, [0, 5, 1, 4]), (3, [0, 4, 1, 5])] {
        triangles.extend((0..4).map(|side| [y, ring[(side + 1) % 4], ring[side]]));
    }
    let tree = TriangleBvh::build(&positions, &triangles, Quality::Balanced);

    let eye = vec3(1.0, 0.8, 3.0);
    let forward = -eye;
    let right = forward.cross(Vec3::Y).normalize();
    let up = right.cross(forward).normalize();
    for row in 0..24 {
        let cell = |column: u32| {
            let (x, y) = (column as f32 / 24.0 - 1.0, 1.0 - row as f32 / 12.0);
            let ray = Ray::new(eye, forward + (right * x + up * y) * 1.2);
            tree.nearest(&ray).map_or('.', |hit| char::from(b'a' + hit.primitive as u8))
        };
        println!("{}", (0..48).map(cell).collect::<String>());
    }
}
