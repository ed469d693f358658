//! Rays from a file through a mesh from a file, timed: millions a second by the time the processor gave this thread.
//!
//! `cargo run --release --example rays -- MESH.tri RAYS.rays [any] [single|incoherent|coherent]... [level=avx2] [rounds=5]`
//!
//! Both files are raw little-endian numbers behind a header of 16 bytes: `TRIS0001`, the number of positions and of triangles
//! (u32), then positions and corners; `RAYS0001`, the number of rays (u64), then origin, t_min, direction, t_max of each.
#![allow(clippy::print_stdout)]

use glam::Vec3;
use luch_bvh::simd::Level;
use luch_bvh::{Coherence, Quality, Ray, TriangleBvh};
use std::time::Instant;

fn words(path: &str) -> Vec<u32> {
    let bytes = std::fs::read(path).unwrap_or_else(|error| panic!("{path}: {error}"));
    bytes.chunks_exact(4).map(|word| u32::from_le_bytes([word[0], word[1], word[2], word[3]])).collect()
}

fn vector(words: &[u32]) -> Vec3 {
    Vec3::new(f32::from_bits(words[0]), f32::from_bits(words[1]), f32::from_bits(words[2]))
}

/// Seconds the processor spent on this thread; where the system does not tell, seconds since the start.
fn seconds(start: Instant) -> f64 {
    let told = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let told = told.and_then(|text| text.split_whitespace().next()?.parse::<f64>().ok());
    told.map_or_else(|| start.elapsed().as_secs_f64(), |nanoseconds| nanoseconds * 1e-9)
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let value = |name: &str| arguments.iter().find_map(|argument| argument.strip_prefix(name));
    let mesh = words(&arguments[0]);
    let (positions, triangles) = (mesh[2] as usize, mesh[3] as usize);
    let (places, corners) = mesh[4..].split_at(3 * positions);
    let places: Vec<Vec3> = places.chunks_exact(3).map(vector).collect();
    let corners: Vec<[u32; 3]> = corners.chunks_exact(3).map(|c| [c[0], c[1], c[2]]).collect();
    assert_eq!(corners.len(), triangles);
    let file = words(&arguments[1]);
    let ray = |words: &[u32]| Ray {
        origin: vector(words),
        t_min: f32::from_bits(words[3]),
        direction: vector(&words[4..]),
        t_max: f32::from_bits(words[7]),
    };
    let rays: Vec<Ray> = file[4..].chunks_exact(8).map(ray).collect();
    if let Some(name) = value("level=") {
        let level = Level::ALL.into_iter().find(|level| level.name() == name).expect("a level");
        assert_eq!(level.limit(), level);
    }
    let quality = match value("quality=") {
        Some("fast") => Quality::Fast,
        Some("best") => Quality::Best,
        _ => Quality::Balanced,
    };
    let start = Instant::now();
    let tree = TriangleBvh::build(&places, &corners, quality);
    let built = start.elapsed();
    let statistics = tree.statistics();
    println!("built in {:.0} ms: {statistics:?}", built.as_secs_f64() * 1e3);
    let rounds: usize = value("rounds=").map_or(5, |text| text.parse().expect("a number"));
    let any = arguments.iter().any(|argument| argument == "any");
    let (mut hits, mut met) = (vec![None; rays.len()], vec![false; rays.len()]);
    let modes: Vec<&str> = ["single", "incoherent", "coherent"]
        .into_iter()
        .filter(|mode| arguments.iter().any(|argument| argument == mode))
        .collect();
    // The modes take turns, so that what else the machine does falls on all of them alike.
    let mut speeds = vec![Vec::new(); modes.len()];
    let mut sums = Vec::new();
    for round in 0..=rounds {
        for (mode, speeds) in modes.iter().zip(&mut speeds) {
            let coherence = if *mode == "coherent" { Coherence::Coherent } else { Coherence::Incoherent };
            let before = seconds(start);
            // Batches as a renderer hands them over.
            for (rays, (hits, met)) in rays.chunks(4096).zip(hits.chunks_mut(4096).zip(met.chunks_mut(4096)))
            {
                match (*mode, any) {
                    ("single", false) => {
                        rays.iter().zip(hits).for_each(|(ray, hit)| *hit = tree.nearest(ray))
                    }
                    ("single", true) => rays.iter().zip(met).for_each(|(ray, met)| *met = tree.any(ray)),
                    (_, false) => tree.nearest_batch(rays, hits, coherence),
                    (_, true) => tree.any_batch(rays, met, coherence),
                }
            }
            if round > 0 {
                speeds.push(rays.len() as f64 / (seconds(start) - before) * 1e-6);
            }
            let count = met.iter().filter(|met| **met).count() + hits.iter().flatten().count();
            let t: f64 = hits.iter().flatten().map(|hit| f64::from(hit.t)).sum();
            sums.push((count, t.to_bits()));
        }
    }
    assert!(sums.iter().all(|sum| *sum == sums[0]), "{sums:?}");
    for (mode, speeds) in modes.iter().zip(&mut speeds) {
        speeds.sort_by(f64::total_cmp);
        let (median, best) = (speeds[speeds.len() / 2], speeds[speeds.len() - 1]);
        println!("{mode:10} {median:7.3} {best:7.3} Mrays/s");
    }
}
