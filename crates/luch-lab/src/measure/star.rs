//! The star discrepancy of points of the square, exactly.

/// The largest difference, over all boxes [0, a) × [0, b) and their closures, between the share of the points inside and the area.
///
/// Exact up to rounding, in time N² (boxes grow along the first axis, one point at a time, and along the second past each point). The
/// coordinates must lie in [0, 1]. No points give 1.
pub fn star_discrepancy_2d(points: &[[f64; 2]]) -> f64 {
    let n = points.len() as f64;
    if points.is_empty() {
        return 1.0;
    }
    let mut by_x = points.to_vec();
    by_x.sort_by(|p, q| p[0].total_cmp(&q[0]));
    // Heights of the points that the strip holds so far, sorted.
    let mut heights: Vec<f64> = Vec::with_capacity(points.len());
    let mut worst = 0.0f64;
    for i in 0..=by_x.len() {
        // The open strip up to the next point holds the first i: boxes that are too empty reach as far as they can.
        let open = by_x.get(i).map_or(1.0, |p| p[0]);
        for (j, height) in heights.iter().copied().chain([1.0]).enumerate() {
            worst = worst.max(open * height - j as f64 / n);
        }
        let Some(&[x, y]) = by_x.get(i) else { break };
        let place = heights.partition_point(|&height| height < y);
        heights.insert(place, y);
        // The closed strip up to this point: boxes that are too full end on points.
        for (j, height) in heights.iter().enumerate() {
            worst = worst.max((j + 1) as f64 / n - x * height);
        }
    }
    worst
}
