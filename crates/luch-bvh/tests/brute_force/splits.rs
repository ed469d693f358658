//! Trees that hold parts of triangles: rays that graze, meet edges and corners, or come from afar find what the loop finds.

use crate::random::Random;
use glam::Vec3;
use luch_bvh::simd::Level;
use luch_bvh::{BruteForce, Coherence, Hit, Quality, Ray, TriangleBvh, TriangleTest};

struct Soup {
    positions: Vec<Vec3>,
    triangles: Vec<[u32; 3]>,
}

impl Soup {
    fn corners(&self, triangle: usize) -> [Vec3; 3] {
        self.triangles[triangle].map(|corner| self.positions[corner as usize])
    }
}

/// Long thin triangles, some needles, some right across, moved and scaled.
fn slivers(random: &mut Random, count: usize, offset: Vec3, scale: f32) -> Soup {
    let mut positions = Vec::new();
    for index in 0..count {
        let a = random.vector();
        let along = random.vector() * if index % 16 == 0 { 1.5 } else { 0.25 };
        let width = [0.1, 1e-2, 1e-4, 1e-7][index % 4];
        let c = a + along * random.unit() + random.vector() * width;
        positions.extend([a, a + along, c].map(|corner| corner * scale + offset));
    }
    let triangles = (0..count as u32).map(|index| [3 * index, 3 * index + 1, 3 * index + 2]).collect();
    Soup { positions, triangles }
}

/// A ray of one of several unkind sorts.
fn ray(random: &mut Random, soup: &Soup, sort: usize) -> Ray {
    let corners = soup.corners(random.below(soup.triangles.len()));
    let inside = |random: &mut Random| {
        let (u, v) = (random.unit(), random.unit());
        let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
        corners[0] * (1.0 - u - v) + corners[1] * u + corners[2] * v
    };
    let size = (corners[1] - corners[0]).length();
    let target = match sort % 3 {
        0 => inside(random),
        1 => corners[0].lerp(corners[1 + random.below(2)], random.unit()),
        _ => corners[random.below(3)],
    };
    let distance = [0.1, 1.0, 30.0, 1e4, 1e6][random.below(5)] * size;
    let in_plane = (inside(random) - target).normalize_or(Vec3::X);
    let direction = match sort / 3 % 4 {
        // Along the plane of the triangle, and very nearly so.
        0 => in_plane,
        1 => (in_plane + random.vector() * [1e-3, 1e-5, 1e-7][random.below(3)]).normalize(),
        2 => {
            [Vec3::X, Vec3::Y, Vec3::Z][random.below(3)]
                + random.vector() * [0.0, 1e-40, 1e-6][random.below(3)]
        }
        _ => random.vector(),
    };
    let length = [1.0, 1e-20, 1e20, 3e-38][random.below(4)];
    Ray::new(target - direction * distance, direction * length)
}

fn compare(soup: &Soup, random: &mut Random, rays: usize) -> usize {
    let loops = BruteForce::new(&soup.positions, &soup.triangles, TriangleTest::Watertight);
    let tree = TriangleBvh::build(&soup.positions, &soup.triangles, Quality::Best);
    let references = tree.statistics().references;
    assert!(references > soup.triangles.len(), "nothing is split");
    let rays: Vec<Ray> = (0..rays).map(|sort| ray(random, soup, sort)).collect();
    let bits =
        |hit: &Option<Hit>| hit.map(|hit| [hit.t.to_bits(), hit.u.to_bits(), hit.v.to_bits(), hit.primitive]);
    let mut expected = vec![None; rays.len()];
    loops.nearest_batch(&rays, &mut expected, Coherence::Incoherent);
    for level in Level::ALL {
        level.limit();
        let mut hits = vec![None; rays.len()];
        tree.nearest_batch(&rays, &mut hits, Coherence::Incoherent);
        let mut packets = vec![None; rays.len()];
        tree.nearest_batch(&rays, &mut packets, Coherence::Coherent);
        let mut met = vec![false; rays.len()];
        tree.any_batch(&rays, &mut met, Coherence::Coherent);
        for (index, ray) in rays.iter().enumerate() {
            assert_eq!(bits(&hits[index]), bits(&expected[index]), "{} {ray:?}", level.name());
            assert_eq!(bits(&packets[index]), bits(&expected[index]), "packet, {} {ray:?}", level.name());
            assert_eq!(met[index], expected[index].is_some(), "{} {ray:?}", level.name());
        }
        for (ray, expected) in rays.iter().zip(&expected).take(2000) {
            assert_eq!(bits(&tree.nearest(ray)), bits(expected), "{} {ray:?}", level.name());
        }
    }
    expected.iter().flatten().count()
}

#[test]
fn parts_of_slivers_are_met_where_the_whole_would_be() {
    let mut random = Random::new(0x5b_5b);
    let cases = [
        (Vec3::ZERO, 1.0),
        (Vec3::new(0.0, 0.0, 300.0), 1.0),
        (Vec3::ZERO, 1e-3),
        (Vec3::splat(-1e7), 1e6),
        (Vec3::ZERO, 1e12),
    ];
    for (offset, scale) in cases {
        let soup = slivers(&mut random, 600, offset, scale);
        let hits = compare(&soup, &mut random, 12_000);
        assert!(hits > 2000, "{hits}");
    }
}

#[test]
fn nearest_points_of_split_triangles() {
    let mut random = Random::new(77);
    let soup = slivers(&mut random, 600, Vec3::ZERO, 1.0);
    let best = TriangleBvh::build(&soup.positions, &soup.triangles, Quality::Best);
    let plain = TriangleBvh::build(&soup.positions, &soup.triangles, Quality::Fast);
    assert!(best.statistics().references > plain.statistics().references);
    for _ in 0..3000 {
        let point = random.vector() * 1.5;
        assert_eq!(best.nearest_point(point, 10.0), plain.nearest_point(point, 10.0));
    }
}
