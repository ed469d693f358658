//! From patches to one mesh without cracks.
//!
//! Every surface falls into Bezier pieces. The sides of all pieces are collected: sides with the same points are one edge,
//! which gets as many segments as the piece that needs most, and its vertices are computed once, in one direction. So
//! neighbours share vertices to the last bit, however much they differ inside.

mod edges;
mod output;
mod trimmed;

use super::bezier::{Bounds, Net};
use super::fineness::{Divisions, divisions};
use super::grid::{self, Sides, Stop};
use super::knots::Interval;
use super::{Fineness, MAX_TRIANGLES, Patch, PatchError, PatchModel, Side};
use crate::TriangleMesh;
use edges::{EdgeUse, SharedEdges};
use glam::{DVec2, DVec3};
use output::Output;

/// A Bezier piece of a patch.
struct Piece {
    net: Net,
    bounds: Bounds,
    /// Its part of the surface, as fractions of the domain.
    u: Interval,
    v: Interval,
    wanted: Divisions,
    sides: [EdgeUse; 4],
}

/// The pieces of one patch, u running fastest.
struct Pieces {
    list: Vec<Piece>,
    across: usize,
}

impl PatchModel {
    /// One mesh of all patches. Uvs are the parameters as fractions of each surface's domain; normals are those of the
    /// surfaces. Sides that are points give no triangles without area. Positions are rounded to `f32`.
    ///
    /// # Errors
    /// If the wish is not sensible or would take more than [`MAX_TRIANGLES`], or a trimming is open or crosses itself.
    pub fn tessellate(&self, fineness: Fineness) -> Result<TriangleMesh, PatchError> {
        let fineness = &fineness;
        check(fineness)?;
        let mut edges = SharedEdges::default();
        let mut total = 0u64;
        let mut patches = Vec::with_capacity(self.patches.len());
        for patch in &self.patches {
            let mut pieces = pieces_of(patch, fineness, &mut edges);
            if patch.trimming.is_some() {
                pieces.align();
            }
            for piece in &pieces.list {
                let Divisions { u, v } = piece.wanted;
                total = total.saturating_add(u.saturating_mul(v).saturating_mul(2));
                for (side, used) in Side::ALL.into_iter().zip(piece.sides) {
                    edges.want(used, if matches!(side, Side::Bottom | Side::Top) { u } else { v });
                }
            }
            patches.push(pieces);
        }
        total = total.saturating_add(edges.segments());
        if total > MAX_TRIANGLES {
            return Err(PatchError::TooFine { count: total });
        }
        let mut output = Output::default();
        edges.place(&mut output);
        for (index, (patch, pieces)) in self.patches.iter().zip(&patches).enumerate() {
            match &patch.trimming {
                None => pieces.list.iter().for_each(|piece| fill(piece, &edges, &mut output)),
                Some(trimming) => {
                    trimmed::fill(index, patch, trimming, pieces, fineness, &edges, &mut output)?;
                }
            }
        }
        Ok(output.into_mesh())
    }
}

fn check(fineness: &Fineness) -> Result<(), PatchError> {
    let sound = |number: f64| number.is_finite() && number > 0.0;
    let bad = match fineness {
        Fineness::Tolerance(tolerance) => Some(*tolerance).filter(|&t| !sound(t)),
        Fineness::Divisions(_) => None,
        Fineness::Screen(screen) => (!screen.is_sound()).then_some(screen.pixels),
    };
    bad.map_or(Ok(()), |tolerance| Err(PatchError::Tolerance { tolerance }))
}

fn pieces_of(patch: &Patch, fineness: &Fineness, edges: &mut SharedEdges) -> Pieces {
    let [u_breaks, v_breaks] = patch.surface.knots().each_ref().map(|knots| {
        let domain = knots.domain();
        let fraction = |t: f64| if t == domain.end { 1.0 } else { (t - domain.start) / domain.length() };
        knots.breaks().into_iter().map(fraction).collect::<Vec<_>>()
    });
    let across = u_breaks.len() - 1;
    let interval = |breaks: &[f64], k: usize| Interval { start: breaks[k], end: breaks[k + 1] };
    let list = patch.surface.nets().into_iter().enumerate().map(|(k, net)| {
        let bounds = net.bounds();
        // A trimmed surface shares the tolerance with its trimming.
        let share = if patch.trimming.is_some() { 0.5 } else { 1.0 };
        let wanted = match fineness {
            Fineness::Divisions(count) => {
                Divisions { u: u64::from((*count).max(1)), v: u64::from((*count).max(1)) }
            }
            _ => divisions(&bounds, tolerance_at(fineness, &net) * share),
        };
        let sides = Side::ALL.map(|side| edges.add(net.side(side)));
        Piece {
            net,
            bounds,
            u: interval(&u_breaks, k % across),
            v: interval(&v_breaks, k / across),
            wanted,
            sides,
        }
    });
    Pieces { list: list.collect(), across }
}

/// The tolerance for a piece, in metres.
fn tolerance_at(fineness: &Fineness, net: &Net) -> f64 {
    match fineness {
        Fineness::Tolerance(tolerance) => *tolerance,
        Fineness::Divisions(_) => f64::INFINITY,
        Fineness::Screen(screen) => {
            let centre = net.places().sum::<DVec3>() / net.points.len() as f64;
            let radius = net.places().map(|place| place.distance(centre)).fold(0.0, f64::max);
            screen.length(centre, radius)
        }
    }
}

impl Pieces {
    /// Gives all pieces of a column the same cells along u, and of a row along v.
    fn align(&mut self) {
        let across = self.across;
        let up = self.list.len() / across;
        for column in 0..across {
            let most = (0..up).map(|row| self.list[row * across + column].wanted.u).max().unwrap_or(1);
            (0..up).for_each(|row| self.list[row * across + column].wanted.u = most);
        }
        for row in self.list.chunks_mut(across) {
            let most = row.iter().map(|piece| piece.wanted.v).max().unwrap_or(1);
            row.iter_mut().for_each(|piece| piece.wanted.v = most);
        }
    }
}

impl Piece {
    fn uv(&self, u: f64, v: f64) -> DVec2 {
        DVec2::new(self.u.at(u), self.v.at(v))
    }

    fn add_value(&self, u: f64, v: f64, output: &mut Output) -> u32 {
        output.add_value(self.uv(u, v), self.net.normal(u, v))
    }
}

/// A vertex with its uv and normal.
#[derive(Clone, Copy)]
struct Local {
    vertex: u32,
    value: u32,
}

/// The triangles of a whole piece.
fn fill(piece: &Piece, edges: &SharedEdges, output: &mut Output) {
    let [bottom, right, top, left] = piece.sides;
    let segments = |one: EdgeUse, other: EdgeUse| edges.inner_segments(one).max(edges.inner_segments(other));
    let cells = grid::fitting(piece.wanted, segments(bottom, top), segments(left, right));
    let mut locals: Vec<Local> = Vec::new();
    // Corners first, so that two sides share them.
    let corners: [u32; 4] = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(u, v)| {
        let (side, last) = if v == 0.0 { (bottom, u == 1.0) } else { (top, u == 1.0) };
        let vertex = if last { edges.last(side) } else { edges.first(side) };
        locals.push(Local { vertex, value: piece.add_value(u, v, output) });
        locals.len() as u32 - 1
    });
    let mut side =
        |used: EdgeUse, ends: [u32; 2], cells: u64, at: &dyn Fn(f64) -> DVec2, output: &mut Output| {
            let count = edges.stops(used, cells);
            let mut stops = vec![Stop { fraction: 0.0, place: ends[0] }];
            for k in 1..count {
                let fraction = k as f64 / count as f64;
                let place = at(fraction);
                stops.push(Stop { fraction, place: locals.len() as u32 });
                let value = piece.add_value(place.x, place.y, output);
                locals.push(Local { vertex: edges.vertex(used, k), value });
            }
            stops.push(Stop { fraction: 1.0, place: ends[1] });
            stops
        };
    let [a, b, c, d] = corners;
    let sides = Sides {
        bottom: side(bottom, [a, b], cells.u, &|t| DVec2::new(t, 0.0), output),
        right: side(right, [b, c], cells.v, &|t| DVec2::new(1.0, t), output),
        top: side(top, [d, c], cells.u, &|t| DVec2::new(t, 1.0), output),
        left: side(left, [a, d], cells.v, &|t| DVec2::new(0.0, t), output),
    };
    let first_inner = locals.len() as u64;
    for j in 1..cells.v {
        for i in 1..cells.u {
            let (u, v) = (i as f64 / cells.u as f64, j as f64 / cells.v as f64);
            let vertex = output.add_vertex(piece.net.evaluate(u, v).position);
            locals.push(Local { vertex, value: piece.add_value(u, v, output) });
        }
    }
    let inner = |i: u64, j: u64| (first_inner + (j - 1) * (cells.u - 1) + (i - 1)) as u32;
    let mut triangles = Vec::new();
    grid::triangles(cells, &sides, inner, &mut triangles);
    for triangle in triangles {
        let corners = triangle.map(|place| locals[place as usize]);
        output.add_triangle(corners.map(|c| c.vertex), corners.map(|c| c.value));
    }
}

#[cfg(test)]
mod tests;
