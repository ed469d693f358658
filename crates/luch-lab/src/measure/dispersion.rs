//! Dispersion: the largest ball or box without a point.

use crate::points::PointSet;

/// A ball that holds no point inside, with its centre in the unit cube.
#[derive(Clone, Debug, PartialEq)]
pub struct EmptyBall {
    /// Its centre.
    pub centre: Vec<f64>,
    /// Its radius.
    pub radius: f64,
    /// No empty ball has a radius above this.
    pub bound: f64,
}

/// The largest empty ball whose centre lies in the unit cube, up to a relative `tolerance` (at least 10⁻⁹): its radius is the dispersion.
///
/// Branch and bound: the distance to the nearest point changes by no more than the way, so a box whose centre is `r` from it has
/// nothing beyond `r` plus half its diagonal. Meant for up to three dimensions. `None` for no points, and in more than four dimensions.
pub fn largest_empty_ball(points: &PointSet, tolerance: f64) -> Option<EmptyBall> {
    let d = points.dimensions();
    if points.is_empty() || d > 4 {
        return None;
    }
    let tolerance = tolerance.max(1e-9);
    let all: Vec<u32> = (0..points.len() as u32).collect();
    let mut best = EmptyBall { centre: vec![0.5; d], radius: 0.0, bound: 0.0 };
    // Each box keeps the points that can be nearest to anything in it.
    let mut open = vec![(vec![0.5; d], 0.5, all)];
    while let Some((centre, half, near)) = open.pop() {
        let reach = half * (d as f64).sqrt();
        let distances: Vec<f64> = near.iter().map(|&i| distance(points.point(i as usize), &centre)).collect();
        let nearest = distances.iter().copied().fold(f64::INFINITY, f64::min);
        if nearest > best.radius {
            best.radius = nearest;
            best.centre.clone_from(&centre);
        }
        if nearest + reach <= best.radius * (1.0 + tolerance) {
            continue;
        }
        let kept: Vec<u32> = near
            .iter()
            .zip(&distances)
            .filter(|(_, distance)| **distance <= nearest + 2.0 * reach)
            .map(|(&i, _)| i)
            .collect();
        for corner in 0..1u32 << d {
            let child = centre
                .iter()
                .enumerate()
                .map(|(axis, x)| if corner >> axis & 1 == 1 { x + half / 2.0 } else { x - half / 2.0 })
                .collect();
            open.push((child, half / 2.0, kept.clone()));
        }
    }
    best.bound = best.radius * (1.0 + tolerance);
    Some(best)
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| (x - y) * (x - y)).sum::<f64>().sqrt()
}

/// The least distance between two points, on the torus if `torus`; infinite for fewer than two.
pub fn least_distance(points: &PointSet, torus: bool) -> f64 {
    let along = |x: f64, y: f64| {
        let d = (x - y).abs();
        if torus { d.min(1.0 - d) } else { d }
    };
    let mut least = f64::INFINITY;
    for (i, p) in points.iter().enumerate() {
        for q in points.iter().take(i) {
            least = least.min(p.iter().zip(q).map(|(&x, &y)| along(x, y) * along(x, y)).sum());
        }
    }
    least.sqrt()
}

/// A box along the axes that holds no point inside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EmptyBox {
    /// Its lower left corner.
    pub low: [f64; 2],
    /// Its upper right corner.
    pub high: [f64; 2],
}

impl EmptyBox {
    /// Its area.
    pub fn area(&self) -> f64 {
        (self.high[0] - self.low[0]) * (self.high[1] - self.low[1])
    }
}

/// The empty box of largest area in the unit square, exactly, in time N² (Naamad, Lee, Hsu 1984).
pub fn largest_empty_box_2d(points: &[[f64; 2]]) -> EmptyBox {
    let mut by_x = points.to_vec();
    by_x.sort_by(|p, q| p[0].total_cmp(&q[0]));
    let mut best = EmptyBox { low: [0.0; 2], high: [0.0; 2] };
    let mut take = |low: [f64; 2], high: [f64; 2]| {
        let candidate = EmptyBox { low, high };
        if candidate.area() > best.area() {
            best = candidate;
        }
    };
    // Boxes from the left edge of the square, and boxes whose left side leans on a point: the window narrows with each point passed.
    let mut sweep = |left: f64, height: Option<f64>, rest: &[[f64; 2]]| {
        let mut window = [0.0f64, 1.0];
        for &[x, y] in rest {
            if y <= window[0] || y >= window[1] {
                continue;
            }
            take([left, window[0]], [x, window[1]]);
            match height {
                Some(height) if y > height => window[1] = y,
                Some(height) if y < height => window[0] = y,
                _ => return,
            }
        }
        take([left, window[0]], [1.0, window[1]]);
    };
    for (i, &[x, y]) in by_x.iter().enumerate() {
        sweep(x, Some(y), &by_x[i + 1..]);
    }
    // From the left edge: for each point that ends a box on the right, its window is set by the points before it.
    for (i, &[x, y]) in by_x.iter().enumerate() {
        let mut window = [0.0f64, 1.0];
        for &[_, height] in &by_x[..i] {
            if height <= window[0] || height >= window[1] {
                continue;
            }
            if height > y {
                window[1] = height;
            } else if height < y {
                window[0] = height;
            } else {
                window = [y, y];
            }
        }
        take([0.0, window[0]], [x, window[1]]);
    }
    // The whole width between neighbouring heights.
    let mut heights: Vec<f64> = by_x.iter().map(|p| p[1]).chain([0.0, 1.0]).collect();
    heights.sort_by(f64::total_cmp);
    for pair in heights.windows(2) {
        take([0.0, pair[0]], [1.0, pair[1]]);
    }
    best
}
