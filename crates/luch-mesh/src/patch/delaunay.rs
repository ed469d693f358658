//! Constrained Delaunay triangulation in the plane (crate `spade`), and inside tests by counting crossings.

use glam::DVec2;
use spade::handles::FixedVertexHandle;
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};

/// A triangulation that grows.
#[derive(Default)]
pub(super) struct Plane {
    triangulation: ConstrainedDelaunayTriangulation<Point2<f64>>,
}

impl Plane {
    /// Adds a point and returns its number; a point that is there already keeps its number.
    pub(super) fn insert(&mut self, point: DVec2) -> Option<u32> {
        // Numbers too small to multiply exactly are refused by the library; they mean zero here.
        let exact = |x: f64| if x.abs() < 1e-30 { 0.0 } else { x };
        let handle = self.triangulation.insert(Point2::new(exact(point.x), exact(point.y))).ok()?;
        Some(handle.index() as u32)
    }

    /// How many points there are.
    pub(super) fn point_count(&self) -> usize {
        self.triangulation.num_vertices()
    }

    /// Makes the line between two points an edge, or a chain of edges over points on it; false if another such line
    /// crosses it.
    pub(super) fn constrain(&mut self, from: u32, to: u32) -> bool {
        let handle = |point: u32| FixedVertexHandle::from_index(point as usize);
        from == to || !self.triangulation.try_add_constraint(handle(from), handle(to)).is_empty()
    }

    /// Whether two points are the ends of a constrained edge.
    pub(super) fn is_constrained(&self, from: u32, to: u32) -> bool {
        let handle = |point: u32| FixedVertexHandle::from_index(point as usize);
        self.triangulation.exists_constraint(handle(from), handle(to))
    }

    /// All triangles, counter-clockwise.
    pub(super) fn triangles(&self) -> impl Iterator<Item = [u32; 3]> {
        self.triangulation.inner_faces().map(|face| face.vertices().map(|vertex| vertex.fix().index() as u32))
    }
}

/// Closed lines, to be asked what is inside.
pub(super) struct Outline {
    /// The segments that touch `row <= y < row + 1`.
    rows: Vec<Vec<[DVec2; 2]>>,
}

impl Outline {
    /// Lines between `y = 0` and `y = height`.
    pub(super) fn new(segments: impl Iterator<Item = [DVec2; 2]>, height: usize) -> Self {
        let mut rows = vec![Vec::new(); height + 1];
        for [a, b] in segments {
            // Conversions from float to integer saturate.
            let row = |y: f64| (y.floor() as usize).min(height);
            for line in &mut rows[row(a.y.min(b.y))..=row(a.y.max(b.y))] {
                line.push([a, b]);
            }
        }
        Self { rows }
    }

    /// Whether an odd number of lines encloses a point.
    pub(super) fn contains(&self, point: DVec2) -> bool {
        let Some(row) = self.rows.get(point.y.floor() as usize) else { return false };
        let crossed = row.iter().filter(|[a, b]| {
            // Half-open in y: a corner on the line counts for one of its two segments.
            (a.y > point.y) != (b.y > point.y) && point.x < a.x + (point.y - a.y) / (b.y - a.y) * (b.x - a.x)
        });
        crossed.count() % 2 == 1
    }
}

/// The triangles of the region that closed lines over `points` enclose an odd number of times, between `y = 0` and
/// `y = height`. Points are neither added nor left out; `None` if two are the same or two lines cross.
pub(crate) fn region_triangles(
    points: &[DVec2],
    segments: &[[u32; 2]],
    height: usize,
) -> Option<Vec<[u32; 3]>> {
    let mut plane = Plane::default();
    for (index, point) in points.iter().enumerate() {
        if plane.insert(*point)? as usize != index {
            return None;
        }
    }
    if !segments.iter().all(|[from, to]| plane.constrain(*from, *to)) {
        return None;
    }
    let outline = Outline::new(segments.iter().map(|ends| ends.map(|end| points[end as usize])), height);
    let centre = |triangle: &[u32; 3]| triangle.iter().map(|&p| points[p as usize]).sum::<DVec2>() / 3.0;
    Some(plane.triangles().filter(|triangle| outline.contains(centre(triangle))).collect())
}
