//! Points that keep apart: blue noise.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use super::grid::{Grid, squared_distance};
use super::{Areas, MOST_POINTS, Scattered, uniform};
use crate::TriangleMesh;

/// Points no two of which are closer than `distance` in space, as many as fit by throwing: points are tried in the order of
/// [`uniform`] and kept if there is room, until some twenty for each that could fit have been tried.
///
/// At most `most` points, and no points if `distance` is not above zero.
pub fn apart(mesh: &TriangleMesh, distance: f32, most: usize, seed: u64) -> Vec<Scattered> {
    let areas = Areas::new(mesh, |_| 1.0);
    let Some(areas) = areas.filter(|_| distance > 0.0 && distance.is_finite()) else { return Vec::new() };
    let squared = f64::from(distance) * f64::from(distance);
    // Discs of half the distance do not overlap; at best they cover π/√12 of the surface.
    let fitting = areas.total() / (squared * (3f64.sqrt() / 2.0));
    let tried = (20.0 * fitting).ceil().clamp(1024.0, MOST_POINTS as f64) as u64;
    let mut grid = Grid::new(f64::from(distance));
    let mut kept: Vec<Scattered> = Vec::new();
    for index in 0..tried {
        if kept.len() >= most.min(MOST_POINTS) {
            break;
        }
        let Some(point) = areas.point(mesh, seed, index) else { continue };
        let mut is_free = true;
        grid.about(point.position, |number| {
            is_free = squared_distance(kept[number as usize].position, point.position) >= squared;
            is_free
        });
        if is_free {
            grid.add(kept.len() as u32, point.position);
            kept.push(point);
        }
    }
    kept
}

/// Five times as many points are thrown as are kept, as the paper has it.
const SURPLUS: usize = 5;
/// Neighbours of a point: a surface that folds onto itself must not take quadratic time.
const MOST_NEIGHBOURS: usize = 512;

/// Exactly `count` points, well apart from one another: of five times as many, the most crowded go one by one (Yuksel,
/// "Sample elimination for generating Poisson disk sample sets", 2015). At most a fifth of [`MOST_POINTS`].
pub fn even(mesh: &TriangleMesh, count: usize, seed: u64) -> Vec<Scattered> {
    let Some(areas) = Areas::new(mesh, |_| 1.0) else { return Vec::new() };
    let count = count.min(MOST_POINTS / SURPLUS);
    if count == 0 {
        return Vec::new();
    }
    let points = uniform(mesh, count * SURPLUS, seed);
    // The greatest distance that so many points could keep, on a plane; twice that is the reach.
    let reach = 2.0 * (areas.total() / (2.0 * 3f64.sqrt() * count as f64)).sqrt();
    if reach <= 0.0 || !reach.is_finite() || points.len() <= count {
        return points.into_iter().take(count).collect();
    }
    let mut grid = Grid::new(reach);
    points.iter().enumerate().for_each(|(number, point)| grid.add(number as u32, point.position));
    let weight = |squared: f64| {
        let rest = 1.0 - squared.sqrt() / reach;
        let square = rest * rest;
        let fourth = square * square;
        fourth * fourth
    };
    let neighbours = |number: u32| {
        let mut list: Vec<(u32, f64)> = Vec::new();
        let own = points[number as usize].position;
        grid.about(own, |other| {
            let squared = squared_distance(own, points[other as usize].position);
            if other != number && squared < reach * reach {
                list.push((other, weight(squared)));
            }
            list.len() < MOST_NEIGHBOURS
        });
        list
    };
    let mut weights: Vec<f64> =
        (0..points.len() as u32).map(|number| neighbours(number).iter().map(|(_, w)| w).sum()).collect();
    let mut heap: BinaryHeap<Crowded> = weights
        .iter()
        .enumerate()
        .map(|(number, &weight)| Crowded { weight, number: number as u32 })
        .collect();
    let mut is_gone = vec![false; points.len()];
    let mut left = points.len();
    while left > count {
        let Some(Crowded { weight, number }) = heap.pop() else { break };
        // Entries are made anew when a weight falls; old ones are passed over.
        if is_gone[number as usize] || weight != weights[number as usize] {
            continue;
        }
        is_gone[number as usize] = true;
        left -= 1;
        for (other, part) in neighbours(number) {
            if !is_gone[other as usize] {
                weights[other as usize] -= part;
                heap.push(Crowded { weight: weights[other as usize], number: other });
            }
        }
    }
    points.into_iter().zip(is_gone).filter(|(_, is_gone)| !is_gone).map(|(point, _)| point).collect()
}

/// A point and how crowded it is; the most crowded comes first, of equal ones the later.
struct Crowded {
    weight: f64,
    number: u32,
}

impl Ord for Crowded {
    fn cmp(&self, other: &Self) -> Ordering {
        self.weight.total_cmp(&other.weight).then(self.number.cmp(&other.number))
    }
}

impl PartialOrd for Crowded {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Crowded {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Crowded {}
