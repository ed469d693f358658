//! Blue noise by best candidates: each new point is the one of many random candidates that is farthest from all points before it.
//!
//! Mitchell, "Spectrally optimal sampling for distribution ray tracing" (1991), on the torus. The number of candidates grows with the
//! points, up to a bound, so that the set stays as even as it began.

use crate::generator::{Generator, Stream};

/// Candidates for each point already there, and how many at most.
const CANDIDATES_PER_POINT: usize = 4;
const MOST_CANDIDATES: usize = 512;

/// Buckets along an axis for each root of a point.
struct Buckets {
    side: usize,
    points: Vec<Vec<[f64; 2]>>,
}

impl Buckets {
    fn new(count: usize) -> Buckets {
        let side = (count as f64).sqrt().ceil().max(1.0) as usize;
        Buckets { side, points: vec![Vec::new(); side * side] }
    }

    fn cell(&self, coordinate: f64) -> usize {
        ((coordinate * self.side as f64) as usize).min(self.side - 1)
    }

    fn insert(&mut self, point: [f64; 2]) {
        let cell = self.cell(point[1]) * self.side + self.cell(point[0]);
        self.points[cell].push(point);
    }

    /// Squared distance on the torus to the nearest point; gives up once it is certain to be below `enough`.
    fn nearest(&self, from: [f64; 2], enough: f64) -> f64 {
        let [x, y] = from.map(|v| self.cell(v));
        let mut nearest = f64::INFINITY;
        for ring in 0..=self.side / 2 + 1 {
            let edge = 2 * ring + 1;
            for step in 0..edge * edge {
                let (dx, dy) = (step % edge, step / edge);
                if ring > 0 && dx > 0 && dx + 1 < edge && dy > 0 && dy + 1 < edge {
                    continue;
                }
                let around =
                    |centre: usize, offset: usize| (centre + offset + 2 * self.side - ring) % self.side;
                for point in &self.points[around(y, dy) * self.side + around(x, dx)] {
                    nearest = nearest.min(distance_squared(from, *point));
                }
            }
            if nearest <= enough {
                return nearest;
            }
            // Everything in further rings is at least `ring` cells away.
            let reach = ring as f64 / self.side as f64;
            if nearest <= reach * reach {
                return nearest;
            }
        }
        nearest
    }
}

/// Squared distance on the torus.
pub(super) fn distance_squared(a: [f64; 2], b: [f64; 2]) -> f64 {
    let along = |axis: usize| {
        let d = (a[axis] - b[axis]).abs();
        d.min(1.0 - d)
    };
    along(0) * along(0) + along(1) * along(1)
}

/// Fills pairs of coordinates. Buckets are refined as points come, so the points do not depend on how many follow.
pub(super) fn fill(key: u64, out: &mut [f64]) {
    let mut stream = Generator::DEFAULT.start(key);
    let mut buckets = Buckets::new(1);
    let mut done: Vec<[f64; 2]> = Vec::new();
    for point in out.chunks_exact_mut(2) {
        if done.len() > buckets.side * buckets.side {
            buckets = Buckets::new(4 * done.len());
            done.iter().for_each(|&point| buckets.insert(point));
        }
        let candidates = (CANDIDATES_PER_POINT * done.len()).clamp(1, MOST_CANDIDATES);
        let best = best_of(&mut stream, &buckets, candidates);
        point.copy_from_slice(&best);
        buckets.insert(best);
        done.push(best);
    }
}

fn best_of(stream: &mut Stream, buckets: &Buckets, candidates: usize) -> [f64; 2] {
    let (mut best, mut best_distance) = ([0.0; 2], -1.0);
    for _ in 0..candidates {
        let candidate = [stream.unit_f64(), stream.unit_f64()];
        let distance = buckets.nearest(candidate, best_distance);
        if distance > best_distance {
            (best, best_distance) = (candidate, distance);
        }
    }
    best
}
