//! A Delaunay triangulation over points of a grid that tells which triangles each new point changed.
//!
//! Coordinates are whole numbers, so all tests are exact. The algorithm is that of Lawson (1977): split the triangle that
//! holds the point, then flip edges until each is Delaunay.

/// There is no triangle on the other side.
const NONE: u32 = u32::MAX;

/// A triangulation of a rectangle of grid points.
pub(super) struct GridDelaunay {
    width: u32,
    /// Corners as grid points, numbered row by row, counter-clockwise as the image lies.
    pub(super) triangles: Vec<[u32; 3]>,
    /// For each half-edge `3 t + k`, from corner k to the next, the one on its other side.
    twins: Vec<u32>,
    /// Triangles that the last insertion made or changed.
    pub(super) changed: Vec<u32>,
}

/// A grid point by column and height above the last row.
#[derive(Clone, Copy)]
pub(super) struct Cell {
    pub(super) x: i64,
    pub(super) y: i64,
}

impl GridDelaunay {
    /// Two triangles over the whole grid, cut like a cell of the sheet.
    pub(super) fn new(width: u32, height: u32) -> Self {
        let last_row = (height - 1) * width;
        let [a, b, c, d] = [last_row, last_row + width - 1, width - 1, 0];
        let twins = vec![NONE, NONE, 3, 2, NONE, NONE];
        Self { width, triangles: vec![[a, b, c], [a, c, d]], twins, changed: vec![0, 1] }
    }

    /// Where a point lies; rows grow downward, y upward.
    pub(super) fn cell(&self, point: u32) -> Cell {
        Cell { x: i64::from(point % self.width), y: -i64::from(point / self.width) }
    }

    fn turn(&self, [a, b, c]: [u32; 3]) -> i64 {
        let [a, b, c] = [a, b, c].map(|point| self.cell(point));
        (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)
    }

    /// Adds a point, which lies in or on the border of triangle `at`; nothing happens if it is one of its corners.
    pub(super) fn insert(&mut self, point: u32, at: u32) {
        self.changed.clear();
        let corners = self.triangles[at as usize];
        if corners.contains(&point) {
            return;
        }
        let on_edge = (0..3).find(|&k| self.turn([corners[k], corners[(k + 1) % 3], point]) == 0);
        match on_edge {
            None => self.split_inside(point, at),
            Some(k) => self.split_edge(point, at * 3 + k as u32),
        }
    }

    /// The triangle that holds a point, found by walking from triangle `from`.
    pub(super) fn locate(&self, point: u32, from: u32) -> u32 {
        let mut at = from;
        // A walk through a Delaunay triangulation never comes back to a triangle (De Floriani et al. 1991).
        'walk: loop {
            let corners = self.triangles[at as usize];
            for k in 0..3 {
                let twin = self.twins[at as usize * 3 + k];
                if twin != NONE && self.turn([corners[k], corners[(k + 1) % 3], point]) < 0 {
                    at = twin / 3;
                    continue 'walk;
                }
            }
            return at;
        }
    }

    fn add(&mut self, corners: [u32; 3]) -> u32 {
        self.triangles.push(corners);
        self.twins.extend([NONE; 3]);
        self.triangles.len() as u32 - 1
    }

    fn join(&mut self, half_edge: u32, twin: u32) {
        self.twins[half_edge as usize] = twin;
        if twin != NONE {
            self.twins[twin as usize] = half_edge;
        }
    }

    fn split_inside(&mut self, point: u32, at: u32) {
        let [a, b, c] = self.triangles[at as usize];
        let outside = [0, 1, 2].map(|k| self.twins[(at * 3 + k) as usize]);
        self.triangles[at as usize] = [a, b, point];
        let [second, third] = [self.add([b, c, point]), self.add([c, a, point])];
        let parts = [at, second, third];
        for k in 0..3 {
            self.join(parts[k] * 3, outside[k]);
            self.join(parts[k] * 3 + 1, parts[(k + 1) % 3] * 3 + 2);
        }
        self.settle(point, &parts);
    }

    /// Splits both triangles at a half-edge.
    fn split_edge(&mut self, point: u32, half_edge: u32) {
        let twin = self.twins[half_edge as usize];
        let (one, two) = self.halve(point, half_edge);
        if twin == NONE {
            self.settle(point, &[one, two]);
            return;
        }
        let (three, four) = self.halve(point, twin);
        // Part one runs from the edge's start to the point, part four back.
        self.join(one * 3, four * 3);
        self.join(two * 3, three * 3);
        self.settle(point, &[one, two, three, four]);
    }

    /// Cuts the triangle of a half-edge in two at a point on it; edge 0 of both parts lies on the half-edge.
    fn halve(&mut self, point: u32, half_edge: u32) -> (u32, u32) {
        let (at, k) = (half_edge / 3, half_edge % 3);
        let corner = |i: u32| self.triangles[at as usize][((k + i) % 3) as usize];
        let [from, to, top] = [corner(0), corner(1), corner(2)];
        let [right, left] = [1, 2].map(|i| self.twins[(at * 3 + (k + i) % 3) as usize]);
        self.triangles[at as usize] = [from, point, top];
        let other = self.add([point, to, top]);
        self.twins[(at * 3) as usize] = NONE;
        self.join(at * 3 + 2, left);
        self.join(other * 3 + 1, right);
        self.join(at * 3 + 1, other * 3 + 2);
        (at, other)
    }

    /// Flips edges across from the new point, which is a corner of all `parts`, until all are Delaunay.
    fn settle(&mut self, point: u32, parts: &[u32]) {
        self.changed.extend_from_slice(parts);
        let mut stack: Vec<u32> = parts.to_vec();
        while let Some(at) = stack.pop() {
            let corners = self.triangles[at as usize];
            let Some(k) = (0..3).find(|&k| corners[k] == point) else { continue };
            let across = at * 3 + (k as u32 + 1) % 3;
            let twin = self.twins[across as usize];
            if twin == NONE {
                continue;
            }
            let (other, j) = (twin / 3, twin % 3);
            let far = self.triangles[other as usize][((j + 2) % 3) as usize];
            if self.in_circle(corners, far) > 0 {
                self.flip(across);
                if !self.changed.contains(&other) {
                    self.changed.push(other);
                }
                stack.extend([at, other]);
            }
        }
    }

    /// Puts the other diagonal into the two triangles at a half-edge; both keep their numbers.
    fn flip(&mut self, half_edge: u32) {
        let twin = self.twins[half_edge as usize];
        let (one, two) = (half_edge / 3, twin / 3);
        let place = |edge: u32, i: u32| edge / 3 * 3 + (edge % 3 + i) % 3;
        let corner = |mesh: &Self, edge: u32| mesh.triangles[edge as usize / 3][edge as usize % 3];
        let [a, b] = [corner(self, half_edge), corner(self, twin)];
        let [c, d] = [corner(self, place(half_edge, 2)), corner(self, place(twin, 2))];
        let [bc, ca, ad, db] = [place(half_edge, 1), place(half_edge, 2), place(twin, 1), place(twin, 2)]
            .map(|e| self.twins[e as usize]);
        self.triangles[one as usize] = [c, a, d];
        self.triangles[two as usize] = [d, b, c];
        self.join(one * 3, ca);
        self.join(one * 3 + 1, ad);
        self.join(two * 3, db);
        self.join(two * 3 + 1, bc);
        self.join(one * 3 + 2, two * 3 + 2);
    }

    /// Above zero if `point` lies inside the circle through the corners.
    fn in_circle(&self, corners: [u32; 3], point: u32) -> i128 {
        let p = self.cell(point);
        let [a, b, c] = corners.map(|corner| {
            let q = self.cell(corner);
            let (x, y) = (i128::from(q.x - p.x), i128::from(q.y - p.y));
            [x, y, x * x + y * y]
        });
        let minor = |p: [i128; 3], q: [i128; 3]| p[0] * q[1] - p[1] * q[0];
        a[2] * minor(b, c) + b[2] * minor(c, a) + c[2] * minor(a, b)
    }

    /// Gives every cell of four neighbouring points the diagonal that the sheet has.
    pub(super) fn align_cells(&mut self) {
        for half_edge in 0..self.twins.len() as u32 {
            let twin = self.twins[half_edge as usize];
            if twin == NONE {
                continue;
            }
            let corners = self.triangles[half_edge as usize / 3];
            let k = half_edge as usize % 3;
            let [from, to, top] = [0, 1, 2].map(|i| self.cell(corners[(k + i) % 3]));
            let far = self.cell(self.triangles[twin as usize / 3][(twin as usize + 2) % 3]);
            // From the upper left to the lower right of a unit cell whose other corners are there.
            let is_wrong = to.x - from.x == 1 && to.y - from.y == -1;
            let is_cell = top.x + far.x == from.x + to.x
                && top.y + far.y == from.y + to.y
                && (top.x - far.x).abs() == 1
                && (top.y - far.y).abs() == 1;
            if is_wrong && is_cell {
                self.flip(half_edge);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every point of a small grid in a scattered order: always Delaunay, of the right area, with sound neighbours.
    #[test]
    fn stays_delaunay_while_points_come() {
        let (width, height) = (9u32, 7u32);
        let mut mesh = GridDelaunay::new(width, height);
        for k in 0..width * height {
            let point = k * 29 % (width * height);
            let at = mesh.locate(point, 0);
            mesh.insert(point, at);
            let mut area = 0;
            for (t, corners) in mesh.triangles.iter().enumerate() {
                assert!(mesh.turn(*corners) > 0, "{corners:?}");
                area += mesh.turn(*corners);
                for k in 0..3 {
                    let twin = mesh.twins[t * 3 + k];
                    if twin == NONE {
                        continue;
                    }
                    assert_eq!(mesh.twins[twin as usize], (t * 3 + k) as u32);
                    let other = mesh.triangles[twin as usize / 3];
                    let j = twin as usize % 3;
                    assert_eq!([other[j], other[(j + 1) % 3]], [corners[(k + 1) % 3], corners[k]]);
                    assert!(mesh.in_circle(*corners, other[(j + 2) % 3]) <= 0);
                }
            }
            assert_eq!(area, i64::from(2 * (width - 1) * (height - 1)));
        }
        mesh.align_cells();
        assert_eq!(mesh.triangles.len() as u32, 2 * (width - 1) * (height - 1));
        for corners in &mesh.triangles {
            let cells = corners.map(|c| mesh.cell(c));
            let rises = (0..3).any(|k| {
                let (a, b) = (cells[k], cells[(k + 1) % 3]);
                (b.x - a.x, b.y - a.y) == (1, 1) || (b.x - a.x, b.y - a.y) == (-1, -1)
            });
            assert!(rises && mesh.turn(*corners) == 1);
        }
    }
}
