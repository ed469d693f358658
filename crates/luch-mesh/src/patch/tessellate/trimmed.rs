//! A patch that is cut by loops: a constrained Delaunay triangulation in its parameter plane.
//!
//! Coordinates there count cells, so that a triangle within a box of one by one keeps the tolerance. Breaks between Bezier
//! pieces are whole numbers; the triangulation is held to them, since a surface may bend sharply there. Half of the tolerance is
//! for the surface, half for the loops.

use std::collections::HashMap;

use glam::DVec2;

use super::super::delaunay::{Outline, Plane};
use super::super::trim::{Keeps, Steps, Trimming};
use super::super::{Fineness, MAX_TRIANGLES, Patch, PatchError};
use super::edges::{EdgeUse, SharedEdges};
use super::{Local, Output, Piece, Pieces, tolerance_at};

/// Between parameters and cells, along one direction.
struct Axis {
    /// The breaks as parameters.
    breaks: Vec<f64>,
    /// The breaks as cells.
    cells: Vec<f64>,
}

impl Axis {
    fn new(breaks: Vec<f64>, counts: impl Iterator<Item = u64>) -> Self {
        let mut cells = vec![0.0];
        for count in counts {
            cells.push(cells[cells.len() - 1] + count as f64);
        }
        Self { breaks, cells }
    }

    fn to_cells(&self, t: f64) -> f64 {
        let k = self.breaks.partition_point(|&b| b <= t).clamp(1, self.breaks.len() - 1);
        let share = (t - self.breaks[k - 1]) / (self.breaks[k] - self.breaks[k - 1]);
        if share >= 1.0 {
            self.cells[k]
        } else {
            self.cells[k - 1] + share * (self.cells[k] - self.cells[k - 1])
        }
    }

    /// The piece around `cell` and how far through it that is.
    fn locate(&self, cell: f64, near: f64) -> (usize, f64) {
        let k = self.cells.partition_point(|&c| c <= near).clamp(1, self.cells.len() - 1);
        let share = (cell - self.cells[k - 1]) / (self.cells[k] - self.cells[k - 1]);
        (k - 1, share.clamp(0.0, 1.0))
    }

    fn end(&self) -> f64 {
        self.cells[self.cells.len() - 1]
    }

    fn is_break(&self, cell: f64) -> bool {
        self.cells.binary_search_by(|known| known.total_cmp(&cell)).is_ok()
    }
}

/// A point of the triangulation.
#[derive(Clone, Copy)]
struct Node {
    cell: DVec2,
    /// Its vertex, if it lies on the border of the patch.
    vertex: Option<u32>,
}

struct Sheet<'a> {
    pieces: &'a Pieces,
    u: Axis,
    v: Axis,
    plane: Plane,
    nodes: Vec<Node>,
}

pub(super) fn fill(
    index: usize,
    patch: &Patch,
    trimming: &Trimming,
    pieces: &Pieces,
    fineness: &Fineness,
    edges: &SharedEdges,
    output: &mut Output,
) -> Result<(), PatchError> {
    let [u, v] = patch.surface.knots().each_ref().map(|knots| knots.breaks());
    let across = pieces.across;
    let u = Axis::new(u, pieces.list[..across].iter().map(|piece| piece.wanted.u));
    let v = Axis::new(v, pieces.list.iter().step_by(across).map(|piece| piece.wanted.v));
    let mut sheet = Sheet { pieces, u, v, plane: Plane::default(), nodes: Vec::new() };
    let borders = sheet.borders(edges);
    let loops = sheet.loops(index, trimming, fineness, &borders)?;
    let crossing = |sheet: &Sheet, cell: DVec2| {
        let range = patch.surface.knots().each_ref().map(|knots| knots.domain());
        let share = cell / DVec2::new(sheet.u.end(), sheet.v.end());
        PatchError::Crossing { patch: index, u: range[0].at(share.x), v: range[1].at(share.y) }
    };
    let ends = |corners: &Vec<Node>, k: usize| [corners[k].cell, corners[(k + 1) % corners.len()].cell];
    let segments: Vec<[DVec2; 2]> =
        loops.iter().flat_map(|corners| (0..corners.len()).map(|k| ends(corners, k))).collect();
    let outline = Outline::new(segments.iter().copied(), sheet.v.end() as usize);
    sheet.add_grid(&segments, &outline);
    // The loops as chains of constrained edges.
    for corners in &loops {
        let numbers: Option<Vec<u32>> = corners.iter().map(|node| sheet.insert(*node)).collect();
        let numbers = numbers.ok_or_else(|| crossing(&sheet, corners[0].cell))?;
        for (k, &from) in numbers.iter().enumerate() {
            if !sheet.plane.constrain(from, numbers[(k + 1) % numbers.len()]) {
                return Err(crossing(&sheet, corners[k].cell));
            }
        }
    }
    sheet.hold_breaks(&outline);
    sheet.refine(&outline)?;
    sheet.emit(&outline, output);
    Ok(())
}

/// Leaves out corners between two steps along one border: there the border's own vertices stand.
fn without_inner_stops(cells: &[DVec2], end: DVec2) -> Vec<DVec2> {
    let count = cells.len();
    let is_inner = |k: usize| {
        let around = [cells[(k + count - 1) % count], cells[k], cells[(k + 1) % count]];
        let on = |axis: usize, value: f64| around.iter().all(|cell| cell[axis] == value);
        on(0, 0.0) || on(1, 0.0) || on(0, end.x) || on(1, end.y)
    };
    (0..count).filter(|&k| !is_inner(k)).map(|k| cells[k]).collect()
}

impl Sheet<'_> {
    /// A number for a node; one that is there keeps what it is, unless it learns that it lies on the border.
    fn insert(&mut self, node: Node) -> Option<u32> {
        let number = self.plane.insert(node.cell)?;
        match self.nodes.get_mut(number as usize) {
            Some(known) => known.vertex = known.vertex.or(node.vertex),
            None => self.nodes.push(node),
        }
        Some(number)
    }

    /// The vertices along the four borders of the patch: bottom and top by u, left and right by v.
    fn borders(&self, edges: &SharedEdges) -> [Vec<Node>; 4] {
        let (across, list) = (self.pieces.across, &self.pieces.list);
        let last_row = list.len() - across;
        let walk = |pieces: &mut dyn Iterator<Item = &Piece>,
                    side: usize,
                    axis: &Axis,
                    place: &dyn Fn(f64) -> DVec2| {
            let mut nodes: Vec<Node> = Vec::new();
            for (k, piece) in pieces.enumerate() {
                let used: EdgeUse = piece.sides[side];
                let (start, end) = (axis.cells[k], axis.cells[k + 1]);
                let count = edges.stops(used, (end - start) as u64);
                for stop in u64::from(!nodes.is_empty())..=count {
                    let along =
                        if stop == count { end } else { start + (end - start) * stop as f64 / count as f64 };
                    nodes.push(Node { cell: place(along), vertex: Some(edges.vertex(used, stop)) });
                }
            }
            nodes
        };
        let (right, top) = (self.u.end(), self.v.end());
        [
            walk(&mut list[..across].iter(), 0, &self.u, &|x| DVec2::new(x, 0.0)),
            walk(&mut list[across - 1..].iter().step_by(across), 1, &self.v, &|y| DVec2::new(right, y)),
            walk(&mut list[last_row..].iter(), 2, &self.u, &|x| DVec2::new(x, top)),
            walk(&mut list.iter().step_by(across), 3, &self.v, &|y| DVec2::new(0.0, y)),
        ]
    }

    /// The loops in cells, cut at all breaks, with the vertices of the border where they run along it.
    fn loops(
        &self,
        index: usize,
        trimming: &Trimming,
        fineness: &Fineness,
        borders: &[Vec<Node>; 4],
    ) -> Result<Vec<Vec<Node>>, PatchError> {
        let end = DVec2::new(self.u.end(), self.v.end());
        let [low, high] = [0, usize::MAX].map(|which| {
            let pick = |axis: &Axis| axis.breaks[which.min(axis.breaks.len() - 1)];
            DVec2::new(pick(&self.u), pick(&self.v))
        });
        let mut loops = Vec::new();
        if trimming.keeps == Keeps::Outside {
            let [bottom, right, top, left] = borders;
            let all = bottom
                .iter()
                .chain(&right[1..])
                .chain(top.iter().rev().skip(1))
                .chain(left.iter().rev().skip(1));
            let mut border: Vec<Node> = all.copied().collect();
            border.pop();
            loops.push(border);
        }
        let steps = self.steps(fineness);
        for (number, trim) in trimming.loops.iter().enumerate() {
            let open = PatchError::OpenLoop { patch: index, index: number };
            let corners = trim.polyline(&steps, [low, high])?.ok_or(open)?;
            let cells: Vec<DVec2> =
                corners.iter().map(|c| DVec2::new(self.u.to_cells(c.x), self.v.to_cells(c.y))).collect();
            let cells = without_inner_stops(&cells, end);
            let mut chain: Vec<Node> = Vec::new();
            for (k, &from) in cells.iter().enumerate() {
                let to = cells[(k + 1) % cells.len()];
                chain.push(Node { cell: from, vertex: None });
                let on = |axis: usize, value: f64| from[axis] == value && to[axis] == value;
                let border = match () {
                    () if on(1, 0.0) => Some((0, 0)),
                    () if on(0, end.x) => Some((1, 1)),
                    () if on(1, end.y) => Some((2, 0)),
                    () if on(0, 0.0) => Some((3, 1)),
                    () => None,
                };
                match border {
                    Some((side, axis)) => {
                        let between = |node: &&Node| {
                            let at = node.cell[axis];
                            from[axis].min(to[axis]) < at && at < from[axis].max(to[axis])
                        };
                        let mut along: Vec<Node> = borders[side].iter().filter(between).copied().collect();
                        if to[axis] < from[axis] {
                            along.reverse();
                        }
                        chain.extend(along);
                    }
                    None => chain.extend(self.breaks_between(from, to)),
                }
            }
            // Ends of runs along a border are its vertices if they are one of them.
            for node in chain.iter_mut().filter(|node| node.vertex.is_none()) {
                if node.cell.cmpeq(DVec2::ZERO).any() || node.cell.cmpeq(end).any() {
                    let known = borders.iter().flatten().find(|border| border.cell == node.cell);
                    node.vertex = known.and_then(|border| border.vertex);
                }
            }
            chain.dedup_by(|one, other| one.cell == other.cell);
            if chain.len() > 2 {
                loops.push(chain);
            }
        }
        Ok(loops)
    }

    fn steps(&self, fineness: &Fineness) -> Steps {
        let mut steps = Steps {
            longest: DVec2::INFINITY,
            speed: DVec2::ZERO,
            tolerance: f64::INFINITY,
            most: MAX_TRIANGLES / 4,
        };
        for (k, piece) in self.pieces.list.iter().enumerate() {
            let (i, j) = (k % self.pieces.across, k / self.pieces.across);
            let size =
                DVec2::new(self.u.breaks[i + 1] - self.u.breaks[i], self.v.breaks[j + 1] - self.v.breaks[j]);
            let cell = size / DVec2::new(piece.wanted.u as f64, piece.wanted.v as f64);
            steps.longest = steps.longest.min(cell / 2.0);
            steps.speed = steps.speed.max(DVec2::new(piece.bounds.u, piece.bounds.v) / size);
            steps.tolerance = steps.tolerance.min(tolerance_at(fineness, &piece.net) / 2.0);
        }
        steps
    }

    /// Where a segment crosses breaks, in order.
    fn breaks_between(&self, from: DVec2, to: DVec2) -> Vec<Node> {
        let mut cuts: Vec<(f64, DVec2)> = Vec::new();
        for (axis, cells) in [(0, &self.u.cells), (1, &self.v.cells)] {
            let (low, high) = (from[axis].min(to[axis]), from[axis].max(to[axis]));
            let first = cells.partition_point(|&line| line <= low);
            for &line in cells[first..].iter().take_while(|&&line| line < high) {
                let share = (line - from[axis]) / (to[axis] - from[axis]);
                let mut cell = from.lerp(to, share);
                cell[axis] = line;
                cuts.push((share, cell));
            }
        }
        cuts.sort_by(|one, other| one.0.total_cmp(&other.0));
        cuts.into_iter().map(|(_, cell)| Node { cell, vertex: None }).collect()
    }

    /// Adds the corners of all cells that lie inside and not too near to a loop.
    fn add_grid(&mut self, segments: &[[DVec2; 2]], outline: &Outline) {
        let (columns, rows) = (self.u.end() as usize, self.v.end() as usize);
        // Corners next to a segment would give slivers.
        let mut near = vec![false; (columns + 1) * (rows + 1)];
        for [a, b] in segments {
            let (low, high) = (a.min(*b).floor(), a.max(*b).ceil());
            for y in low.y.max(0.0) as usize..=(high.y as usize).min(rows) {
                for x in low.x.max(0.0) as usize..=(high.x as usize).min(columns) {
                    let corner = DVec2::new(x as f64, y as f64);
                    let along = ((corner - *a).dot(*b - *a) / (*b - *a).length_squared()).clamp(0.0, 1.0);
                    let distance = corner.distance(a.lerp(*b, along));
                    let is_break = self.u.is_break(corner.x) || self.v.is_break(corner.y);
                    near[y * (columns + 1) + x] |= distance < if is_break { 1e-6 } else { 0.3 };
                }
            }
        }
        // The hull first: whatever comes then lies inside.
        for cell in [(0, 0), (columns, 0), (columns, rows), (0, rows)] {
            self.insert(Node { cell: DVec2::new(cell.0 as f64, cell.1 as f64), vertex: None });
        }
        // From coarse to fine: a point then changes few triangles, while row by row each would change a whole fan.
        let mut step = columns.max(rows).next_power_of_two();
        while step > 0 {
            let is_older = |k: usize| k.is_multiple_of(2 * step);
            for y in (0..=rows).step_by(step) {
                for x in (0..=columns).step_by(step) {
                    let cell = DVec2::new(x as f64, y as f64);
                    let is_new = !(is_older(x) && is_older(y)) || (x, y) == (0, 0);
                    if is_new && !near[y * (columns + 1) + x] && outline.contains(cell) {
                        self.insert(Node { cell, vertex: None });
                    }
                }
            }
            step /= 2;
        }
    }

    /// Holds the triangulation to lines along the inner breaks, from node to node.
    fn hold_breaks(&mut self, outline: &Outline) {
        for axis in [0, 1] {
            let breaks = if axis == 0 { &self.u } else { &self.v };
            let is_inner = |line: f64| line > 0.0 && line < breaks.end() && breaks.is_break(line);
            let mut on: Vec<(DVec2, u32)> = (0..).zip(&self.nodes).map(|(n, node)| (node.cell, n)).collect();
            on.retain(|(cell, _)| is_inner(cell[axis]));
            on.sort_by(|(one, _), (other, _)| {
                one[axis].total_cmp(&other[axis]).then(one[1 - axis].total_cmp(&other[1 - axis]))
            });
            for pair in on.windows(2) {
                let [(one, from), (other, to)] = [pair[0], pair[1]];
                if one[axis] == other[axis] && outline.contains(one.midpoint(other)) {
                    self.plane.constrain(from, to);
                }
            }
        }
    }

    /// Halves edges until no triangle inside is larger than a cell.
    fn refine(&mut self, outline: &Outline) -> Result<(), PatchError> {
        loop {
            let mut points = Vec::new();
            for triangle in self.plane.triangles() {
                let cells = triangle.map(|node| self.nodes[node as usize].cell);
                let extent = cells[0].max(cells[1]).max(cells[2]) - cells[0].min(cells[1]).min(cells[2]);
                // Cells are whole numbers; only breaks that a segment crosses are rounded.
                if extent.max_element() <= 1.0 + 1e-9 || !outline.contains(cells.iter().sum::<DVec2>() / 3.0)
                {
                    continue;
                }
                let edges = [[0, 1], [1, 2], [2, 0]].map(|[a, b]: [usize; 2]| {
                    let length = (cells[b] - cells[a]).abs().max_element();
                    let fixed = self.plane.is_constrained(triangle[a], triangle[b]);
                    (if fixed { -1.0 } else { length }, cells[a].midpoint(cells[b]))
                });
                let longest = edges.iter().max_by(|one, other| one.0.total_cmp(&other.0));
                points.extend(longest.filter(|(length, _)| *length > 0.0).map(|(_, middle)| *middle));
            }
            let before = self.nodes.len();
            for cell in points {
                self.insert(Node { cell, vertex: None });
            }
            if self.nodes.len() == before {
                return Ok(());
            }
            if self.plane.point_count() as u64 > MAX_TRIANGLES / 2 {
                return Err(PatchError::TooFine { count: 2 * self.plane.point_count() as u64 });
            }
        }
    }

    fn emit(&self, outline: &Outline, output: &mut Output) {
        let mut vertices: Vec<Option<u32>> = self.nodes.iter().map(|node| node.vertex).collect();
        // A node on a break has one normal for each piece; looked up only, never walked.
        let mut values: HashMap<(usize, u32), u32> = HashMap::new();
        for triangle in self.plane.triangles() {
            let cells = triangle.map(|node| self.nodes[node as usize].cell);
            let centre = cells.iter().sum::<DVec2>() / 3.0;
            if !outline.contains(centre) {
                continue;
            }
            let corners = triangle.map(|node| {
                let cell = self.nodes[node as usize].cell;
                let (i, u) = self.u.locate(cell.x, centre.x);
                let (j, v) = self.v.locate(cell.y, centre.y);
                let number = j * self.pieces.across + i;
                let piece = &self.pieces.list[number];
                let vertex = *vertices[node as usize]
                    .get_or_insert_with(|| output.add_vertex(piece.net.evaluate(u, v).position));
                let value = *values.entry((number, node)).or_insert_with(|| piece.add_value(u, v, output));
                Local { vertex, value }
            });
            output.add_triangle(corners.map(|c| c.vertex), corners.map(|c| c.value));
        }
    }
}
