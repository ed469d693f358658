use super::*;
use crate::view::Size;
use glam::Vec3;
use luch_sampling::hash;
use luch_scene::Camera;
use std::sync::atomic::AtomicU32;

fn view(width: u32, height: u32) -> View {
    let camera = Camera::looking_at(Vec3::ZERO, Vec3::NEG_Z, Vec3::Y, 1.0);
    View::new(&camera, Size { width, height }, 1).unwrap()
}

/// How often each sample is covered by triangles of places in the picture.
fn counts(view: &View, triangles: impl Iterator<Item = [DVec2; 3]>) -> Vec<u32> {
    let samples = (view.size.width * view.size.height) as usize;
    let cells: Vec<_> = (0..samples).map(|_| AtomicU64::new(EMPTY)).collect();
    let counts: Vec<_> = (0..samples).map(|_| AtomicU32::new(0)).collect();
    let grid = Grid::new(view, &cells);
    let flat = [DVec3::new(0.0, 0.0, 1.0), DVec3::new(1.0, 0.0, 1.0), DVec3::new(0.0, 1.0, 1.0)];
    for triangle in triangles {
        grid.fill(
            triangle.map(Fine::new),
            0,
            || Slope::new(view, flat, &flat),
            |x, y| {
                counts[(y * view.size.width + x) as usize].fetch_add(1, Ordering::Relaxed);
                true
            },
        );
    }
    counts.into_iter().map(AtomicU32::into_inner).collect()
}

fn random(key: u64, position: u64) -> f64 {
    f64::from(hash::unit_f32(hash::word(key, position) as u32))
}

/// A net of triangles over the whole picture and beyond, its vertices moved at random by less than half a cell.
fn net(size: [f64; 2], cell: f64, seed: u64) -> impl Iterator<Item = [DVec2; 3]> {
    let [columns, rows] = size.map(|side| (side / cell).ceil() as u64 + 2);
    let vertex = move |i: u64, j: u64| {
        let key = hash::combine(hash::combine(seed, i), j);
        let moved = DVec2::new(random(key, 0), random(key, 1)) * 0.48 - 0.24;
        (DVec2::new(i as f64 - 1.0, j as f64 - 1.0) + moved) * cell
    };
    (0..rows).flat_map(move |j| (0..columns).map(move |i| (i, j))).flat_map(move |(i, j)| {
        let [a, b, c, d] = [vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)];
        // Corners in any order and direction.
        if random(seed, i + 7 * j) < 0.5 { [[a, b, c], [d, c, a]] } else { [[b, d, a], [b, c, d]] }
    })
}

#[test]
fn every_sample_of_a_net_is_covered_once() {
    let view = view(96, 64);
    for (seed, cell) in [(1, 0.23), (2, 0.9), (3, 1.0), (4, 5.3), (5, 23.7), (6, 400.0), (7, 30_000.0)] {
        let counts = counts(&view, net([96.0, 64.0], cell, seed));
        assert!(counts.iter().all(|&count| count == 1), "cells of {cell}");
    }
}

/// Vertices exactly on the middles of samples: edges run through many of them.
#[test]
fn every_sample_is_covered_once_where_edges_run_through_their_middles() {
    let view = view(32, 32);
    for steps in [1u32, 2, 3, 8] {
        let at = |i: u32, j: u32| {
            DVec2::new(f64::from(i * steps), f64::from(j * steps)) - f64::from(steps) * 2.0 + 0.5
        };
        let quads = (0..40).flat_map(|j| (0..40).map(move |i| (i, j)));
        let triangles = quads.flat_map(|(i, j)| {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            if (i + j) % 2 == 0 { [[a, b, c], [a, c, d]] } else { [[d, b, a], [b, c, d]] }
        });
        let counts = counts(&view, triangles);
        assert!(counts.iter().all(|&count| count == 1), "steps of {steps}");
    }
}

/// The count of lattice points in a convex figure differs from its area by less than half its perimeter and one
/// (for points on a lattice of unit spacing).
#[test]
fn as_many_samples_as_the_area_says() {
    let view = view(400, 400);
    for seed in 0..200 {
        let corner = |i: u64| DVec2::new(random(seed, 2 * i), random(seed, 2 * i + 1)) * 400.0;
        let triangle = [corner(0), corner(1), corner(2)];
        let [a, b, c] = triangle;
        let area = (b - a).perp_dot(c - a).abs() / 2.0;
        let perimeter = a.distance(b) + b.distance(c) + c.distance(a);
        let count: u32 = counts(&view, [triangle].into_iter()).iter().sum();
        assert!((f64::from(count) - area).abs() <= perimeter / 2.0 + 1.0, "{triangle:?}");
    }
}

#[test]
fn dividing_finds_the_same_spans_as_trying() {
    let brute = |edges: &[EdgeFunction; 3], width: i64| {
        let inside: Vec<i64> =
            (0..=width).filter(|&x| edges.iter().all(|edge| edge.value + edge.per_column * x >= 0)).collect();
        Some([*inside.first()?, *inside.last()?])
    };
    for seed in 0..2000 {
        let word = |i| (hash::word(seed, i) >> 40) as i64 - (1 << 23);
        let edges = [0, 1, 2].map(|i| EdgeFunction {
            value: word(2 * i) * 30,
            per_column: if seed % 7 == i { 0 } else { word(2 * i + 1) },
            per_row: 0,
        });
        assert_eq!(span(&edges, 60), brute(&edges, 60), "{seed}");
        assert_eq!(span(&edges, 5), brute(&edges, 5), "{seed}");
    }
}

#[test]
fn the_nearer_wins_and_of_equally_near_ones_the_lower_number() {
    for camera in [
        Camera::looking_at(Vec3::ZERO, Vec3::NEG_Z, Vec3::Y, 1.0),
        Camera {
            projection: luch_scene::Projection::Orthographic { height: 1.0 },
            ..Camera::looking_at(Vec3::ZERO, Vec3::NEG_Z, Vec3::Y, 1.0)
        },
    ] {
        let view = View::new(&camera, Size { width: 1, height: 1 }, 1).unwrap();
        let cells = [AtomicU64::new(EMPTY)];
        let grid = Grid::new(&view, &cells);
        let shown = || number_of(cells[0].load(Ordering::Relaxed));
        assert_eq!(shown(), None);
        for (depth, number, expected) in [(3.0, 9, 9), (3.0, 10, 9), (3.0, 8, 8), (2.0, 30, 30), (2.5, 0, 30)]
        {
            grid.show(0, view.linear(depth), number);
            assert_eq!(shown(), Some(expected));
        }
        assert_eq!(view.depth(linear_of(&view, cells[0].load(Ordering::Relaxed))), 2.0);
    }
}
