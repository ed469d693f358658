//! Closing the cracks that ear clipping leaves at corners on a straight line.
//!
//! Ear clipping drops a corner between two others of the same line. The face is covered all the same, but a neighbour
//! that has the corner no longer fits, and neither may another triangle of the same face. Every triangle edge that has
//! neither a counterpart nor lies on the border is cut at the corners on it.

use std::collections::HashSet;

use glam::DVec2;

/// Cuts triangles until each of their edges is an edge of the face or is shared with another triangle.
pub(super) fn close_cracks(triangles: &mut Vec<[u32; 3]>, loops: &[Vec<u32>], points: &[DVec2]) {
    let mut known: HashSet<[u32; 2]> = HashSet::with_capacity(points.len() * 4);
    let mut start = 0;
    for corners in loops {
        let count = corners.len() as u32;
        for i in 0..count {
            let (one, other) = (start + i, start + (i + 1) % count);
            known.extend([[one, other], [other, one]]);
        }
        start += count;
    }
    // An edge is known to a triangle if it is on the border or another triangle runs along it the other way.
    known.extend(triangles.iter().flat_map(|t| edges(*t).map(|[from, to]| [to, from])));
    let is_loose = |edge: [u32; 2]| !known.contains(&edge);
    let mut is_used = vec![false; points.len()];
    let mut is_candidate = vec![false; points.len()];
    for &triangle in triangles.iter() {
        for edge in edges(triangle) {
            is_used[edge[0] as usize] = true;
            if is_loose(edge) {
                edge.iter().for_each(|&corner| is_candidate[corner as usize] = true);
            }
        }
    }
    let candidates = (0..points.len()).filter(|&i| is_candidate[i] || !is_used[i]);
    let candidates: Vec<u32> = candidates.map(|i| i as u32).collect();
    if candidates.is_empty() {
        return;
    }
    // A face has so many triangles; only one that crosses itself could ask for more.
    let most = points.len() + 2 * loops.len() - 4;
    let mut pending = std::mem::take(triangles);
    pending.reverse();
    while let Some(triangle) = pending.pop() {
        let crack = (0..3).find_map(|k| {
            let [a, b, c] = [0, 1, 2].map(|i| triangle[(k + i) % 3]);
            let is_loose = !known.contains(&[a, b]);
            let between = if is_loose { corners_between(a, b, &candidates, points) } else { Vec::new() };
            let fits = triangles.len() + pending.len() + 1 + between.len() <= most;
            (!between.is_empty() && fits).then_some((a, b, c, between))
        });
        let Some((a, b, c, between)) = crack else {
            triangles.push(triangle);
            continue;
        };
        let mut from = a;
        for &to in between.iter().chain([&b]) {
            pending.push([from, to, c]);
            // Once is enough: corners that all but coincide could be found between one another for ever.
            known.insert([from, to]);
            from = to;
        }
    }
}

/// Adds the corners of the outer border that no triangle uses, as they happen in faces that are not flat or cross
/// themselves: triangles between them and the gap they leave. They may fold over others, but the border is whole.
pub(super) fn use_every_corner(triangles: &mut Vec<[u32; 3]>, outer: usize, total: usize) {
    let mut is_used = vec![false; total];
    triangles.iter().flatten().for_each(|&corner| is_used[corner as usize] = true);
    let Some(first_used) = is_used[..outer].iter().position(|&used| used) else { return };
    let mut last_used = first_used;
    for step in 1..=outer {
        let corner = (first_used + step) % outer;
        if !is_used[corner] {
            continue;
        }
        // A fan over the stretch of unused corners, from the used one before it.
        let skipped = (corner + outer - last_used - 1) % outer;
        for k in 1..=skipped {
            let between = [k, k + 1].map(|k| ((last_used + k) % outer) as u32);
            triangles.push([last_used as u32, between[0], between[1]]);
        }
        last_used = corner;
    }
}

fn edges([a, b, c]: [u32; 3]) -> [[u32; 2]; 3] {
    [[a, b], [b, c], [c, a]]
}

/// The candidates strictly between two corners, in order from `a` to `b`.
fn corners_between(a: u32, b: u32, candidates: &[u32], points: &[DVec2]) -> Vec<u32> {
    let (start, edge) = (points[a as usize], points[b as usize] - points[a as usize]);
    let length_squared = edge.length_squared();
    let mut between: Vec<(f64, u32)> = Vec::new();
    for &candidate in candidates {
        let offset = points[candidate as usize] - start;
        let along = offset.dot(edge) / length_squared;
        let aside = offset.perp_dot(edge) / length_squared;
        if along > 0.0 && along < 1.0 && aside.abs() < 1e-9 {
            between.push((along, candidate));
        }
    }
    between.sort_by(|one, other| one.0.total_cmp(&other.0).then(one.1.cmp(&other.1)));
    between.into_iter().map(|(_, corner)| corner).collect()
}
