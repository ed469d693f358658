//! Fewer points where a picture cannot show them all.

/// The most points of one layer that are drawn.
pub(super) const MOST: usize = 24_000;

/// The most corners of one line that are drawn.
const MOST_CORNERS: usize = 6_000;

/// At most one point in each cell of a grid, the first in their order; cells grow until few enough are left.
///
/// The places of those that are kept.
pub(super) fn points(points: &[[f64; 2]], cell: f64) -> Vec<usize> {
    if points.len() <= MOST {
        return (0..points.len()).collect();
    }
    let mut cell = cell;
    loop {
        let mut seen = std::collections::HashSet::new();
        let key = |point: &[f64; 2]| point.map(|value| (value / cell) as i64);
        let kept: Vec<usize> = points
            .iter()
            .enumerate()
            .filter(|(_, point)| seen.insert(key(point)))
            .map(|(at, _)| at)
            .collect();
        if kept.len() <= MOST {
            return kept;
        }
        cell *= 1.25;
    }
}

/// A line with the first, the least, the greatest and the last point of every half pixel column: it looks the same.
pub(super) fn line(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    if points.len() <= MOST_CORNERS {
        return points.to_vec();
    }
    let mut thin: Vec<[f64; 2]> = Vec::new();
    let mut start = 0;
    let column = |at: usize| (points[at][0] * 2.0).floor();
    while start < points.len() {
        let mut end = start + 1;
        while end < points.len() && column(end) == column(start) {
            end += 1;
        }
        let run = &points[start..end];
        let by_y = |a: &(usize, &[f64; 2]), b: &(usize, &[f64; 2])| a.1[1].total_cmp(&b.1[1]);
        let least = run.iter().enumerate().min_by(by_y).map_or(0, |(at, _)| at);
        let greatest = run.iter().enumerate().max_by(by_y).map_or(0, |(at, _)| at);
        let mut keep = [0, least, greatest, run.len() - 1];
        keep.sort_unstable();
        for at in keep {
            if thin.last() != Some(&run[at]) {
                thin.push(run[at]);
            }
        }
        start = end;
    }
    if thin.len() > MOST {
        // Not a function of x: every so manieth point.
        let stride = thin.len().div_ceil(MOST);
        let last = thin[thin.len() - 1];
        thin = thin.into_iter().step_by(stride).collect();
        thin.push(last);
    }
    thin
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_million_points_become_few() {
        let many: Vec<[f64; 2]> =
            (0..1_000_000).map(|i| [f64::from(i % 1000), f64::from(i / 1000)]).collect();
        let kept = points(&many, 0.5);
        assert!(kept.len() <= MOST && kept.len() > MOST / 3, "{}", kept.len());
        let wave: Vec<[f64; 2]> =
            (0..1_000_000).map(|i| [f64::from(i) * 6e-4, if i == 777_777 { 99.0 } else { 1.0 }]).collect();
        let thin = line(&wave);
        assert!(thin.len() < 6000);
        assert!(thin.contains(&wave[777_777]), "the one peak is still there");
        let chaos: Vec<[f64; 2]> = (0..300_000).map(|i| [f64::from(i % 600), f64::from(i)]).collect();
        assert!(line(&chaos).len() <= MOST + 1);
    }
}
