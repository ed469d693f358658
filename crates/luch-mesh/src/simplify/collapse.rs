//! Edge collapses in passes: each vertex chooses where it had best move, then the cheapest moves that do not get in each other's way are
//! done.
//!
//! Choosing is most of the work and goes in parallel: a choice depends on the mesh before the pass alone. Moves are done in sweeps with
//! rising limits of error, within a sweep by number of the vertex: nearly the order of errors, but through memory in one direction.

use std::ops::Range;

use glam::DVec3;
use rayon::prelude::*;

use super::fans::{Fans, GONE, Spoke};
use super::quadric::Quadric;
use super::start::{Freedom, Start, Surface};
use super::wedges::Wedges;
use super::{Settings, Simplified};
use crate::TriangleMesh;

/// So many are never needed but on hostile meshes.
const MOST_PASSES: u16 = 256;
/// Sweeps of a pass, each with a limit that more moves keep.
const SWEEPS: usize = 4;
/// Of fewer vertices than this a quarter moves in a pass at most, of more a half.
const CAREFUL: usize = 1 << 16;
/// Bits of an error that a limit leaves open.
const LIMIT_BITS: u32 = 16;
/// So many vertices are swept together, neighbours mostly: what belongs to them stays in the cache.
const BLOCK: usize = 1 << 12;
/// A vertex tries its cheapest neighbours, so many at most.
const MOST_TRIES: usize = 32;

pub(super) fn run(mesh: &TriangleMesh, wedges: &Wedges, settings: &Settings) -> Simplified {
    let mut collapser = Collapser::new(mesh, wedges, settings.keeps_borders);
    let most_error = if settings.error >= 0.0 { settings.error / collapser.scale } else { 0.0 };
    let most_error = most_error * most_error;
    let mut worst = 0.0f32;
    for pass in 1..=MOST_PASSES {
        if collapser.count <= settings.triangles {
            break;
        }
        let wanted = collapser.count - settings.triangles;
        let done = collapser.pass(pass, wanted, most_error);
        worst = worst.max(done.worst);
        if done.removed == 0 && done.refused == 0 && collapser.asks_all {
            break;
        }
        collapser.asks_all = done.removed < wanted / 16 || done.removed == 0;
        if collapser.count * 3 < collapser.triangles.len() * 2 {
            collapser.close_gaps();
        }
    }
    collapser.close_gaps();
    Simplified { mesh: collapser.rebuilt(mesh, wedges), error: f64::from(worst).sqrt() * collapser.scale }
}

/// What neighbours need to know of a vertex.
#[derive(Clone, Copy)]
pub(super) struct Vertex {
    /// Relative to the middle of the bounds, in units of `scale`.
    pub(super) place: DVec3,
    /// The weighted squared distances to its own planes, and their weight.
    own_error: f64,
    weight: f64,
    /// The last pass in which another moved here.
    taken: u16,
}

/// Where a vertex had best move.
#[derive(Clone, Copy)]
struct Choice {
    /// Infinite if it had best stay.
    error: f32,
    target: u32,
    /// The last pass before which the choice was made, and the last in which a triangle about the vertex changed.
    seen: u16,
    changed: u16,
    freedom: Freedom,
    /// A move was refused: from now on neighbours are looked at more closely.
    is_careful: bool,
}

/// A way to move, and what it costs.
#[derive(Clone, Copy)]
struct Move {
    error: f32,
    target: u32,
}

impl Move {
    /// Cheaper, or to a vertex with a lower number.
    #[inline]
    fn is_before(&self, other: &Self) -> bool {
        self.error < other.error || self.error == other.error && self.target < other.target
    }
}

/// What a pass did.
#[derive(Default)]
struct Done {
    /// Triangles.
    removed: usize,
    /// Moves.
    refused: usize,
    worst: f32,
}

pub(super) struct Collapser {
    scale: f64,
    pub(super) vertices: Vec<Vertex>,
    quadrics: Vec<Quadric>,
    choices: Vec<Choice>,
    /// For each vertex its number in the mesh.
    numbers: Vec<u32>,
    /// Positions of corners, or [`GONE`].
    pub(super) triangles: Vec<[u32; 3]>,
    /// How many are left.
    count: usize,
    /// Wedges of corners; empty if there are no attributes.
    pub(super) wedges: Vec<[u32; 3]>,
    pub(super) fans: Fans,
    /// All void choices are to be renewed, as in the first pass.
    asks_all: bool,
}

/// Lists that are used again for each vertex.
#[derive(Default)]
struct Lists {
    spokes: Vec<Spoke>,
    /// Those of the other vertex.
    others: Vec<Spoke>,
    /// Errors and neighbours.
    options: Vec<Move>,
    ends: Vec<u32>,
}

impl Collapser {
    fn new(mesh: &TriangleMesh, wedges: &Wedges, keeps_borders: bool) -> Self {
        let bounds = mesh.bounds();
        let (low, high) = (bounds.min.as_dvec3(), bounds.max.as_dvec3());
        let scale = (high - low).max_element();
        let scale = if scale > 0.0 && scale.is_finite() { scale } else { 1.0 };
        let middle = (low + high) * 0.5;
        let places: Vec<DVec3> = mesh.positions.iter().map(|p| (p.as_dvec3() - middle) / scale).collect();
        let fans = Fans::of(&mesh.triangles, places.len());
        let surface = Surface {
            places: &places,
            triangles: &mesh.triangles,
            wedges: &wedges.triangles,
            fans: &fans,
            keeps_borders,
        };
        let starts = surface.starts();
        let vertex = |(start, &place): (&Start, &DVec3)| Vertex {
            place,
            own_error: start.quadric.sum(place),
            weight: start.quadric.weight,
            taken: 0,
        };
        // All have changed before the first pass.
        let choice = |start: &Start| Choice {
            error: f32::INFINITY,
            target: 0,
            seen: 0,
            changed: 0,
            freedom: start.freedom,
            is_careful: false,
        };
        Self {
            scale,
            vertices: starts.iter().zip(&places).map(vertex).collect(),
            choices: starts.iter().map(choice).collect(),
            quadrics: starts.into_iter().map(|start| start.quadric).collect(),
            numbers: (0..places.len() as u32).collect(),
            triangles: mesh.triangles.clone(),
            count: mesh.triangles.len(),
            wedges: wedges.triangles.clone(),
            fans,
            asks_all: true,
        }
    }

    /// Renews the choices that the last pass has made void, if they may be within a limit.
    fn choose(&mut self, pass: u16, limit: f32, most_error: f64) {
        let mut choices = std::mem::take(&mut self.choices);
        choices.par_iter_mut().enumerate().with_min_len(1 << 12).for_each_init(
            Lists::default,
            |lists, (vertex, choice)| {
                if choice.error == f32::INFINITY && choice.seen > choice.changed
                    || choice.error > limit && choice.error < f32::INFINITY
                {
                    return;
                }
                let is_void = choice.seen <= choice.changed
                    || choice.seen <= self.vertices[choice.target as usize].taken;
                if is_void && matches!(choice.freedom, Freedom::Inner | Freedom::Border) {
                    let best = if choice.is_careful || choice.freedom == Freedom::Border {
                        self.best_allowed(vertex as u32, *choice, lists)
                    } else {
                        self.best(vertex as u32)
                    };
                    choice.error =
                        if f64::from(best.error) <= most_error { best.error } else { f32::INFINITY };
                    (choice.target, choice.seen) = (best.target, pass);
                }
            },
        );
        self.choices = choices;
    }

    /// The mean squared distance to the planes of two vertices after the one has moved onto the other.
    #[inline(always)]
    fn option(&self, quadric: &Quadric, target: u32) -> Move {
        let other = &self.vertices[target as usize];
        let weight = quadric.weight + other.weight;
        let sum = quadric.sum(other.place) + other.own_error;
        // Rounding may give a hair below zero.
        let error = if weight > 0.0 { (sum / weight).max(0.0) } else { 0.0 };
        Move { error: if error.is_finite() { error as f32 } else { f32::INFINITY }, target }
    }

    /// The cheapest neighbour of a vertex inside.
    fn best(&self, vertex: u32) -> Move {
        let quadric = &self.quadrics[vertex as usize];
        let mut best = Move { error: f32::INFINITY, target: 0 };
        self.fans.visit(&self.triangles, vertex, usize::MAX, |spoke| {
            let option = self.option(quadric, spoke.ends[0]);
            if option.is_before(&best) {
                best = option;
            }
        });
        best
    }

    /// The cheapest neighbour that nothing speaks against.
    fn best_allowed(&self, vertex: u32, choice: Choice, lists: &mut Lists) -> Move {
        let Lists { spokes, others, options, ends } = lists;
        self.fans.gather(&self.triangles, vertex, spokes);
        let quadric = &self.quadrics[vertex as usize];
        options.clear();
        if choice.freedom == Freedom::Border {
            // The two ends that only one triangle has.
            ends.clear();
            ends.extend(spokes.iter().flat_map(|spoke| spoke.ends));
            ends.sort_unstable();
            let only = ends.chunk_by(|a, b| a == b).filter(|same| same.len() == 1);
            options.extend(only.map(|only| self.option(quadric, only[0])));
        } else {
            options.extend(spokes.iter().map(|spoke| self.option(quadric, spoke.ends[0])));
        }
        for _ in 0..MOST_TRIES {
            let first =
                (0..options.len()).reduce(|a, b| if options[b].is_before(&options[a]) { b } else { a });
            let Some(first) = first else { break };
            let option = options.swap_remove(first);
            if self.allows(spokes, others, vertex, option.target, choice.freedom) {
                return option;
            }
        }
        Move { error: f32::INFINITY, target: 0 }
    }

    /// Limits of error for the sweeps of a pass, rising; the last is for all that is moved in it. To one part in 128.
    fn limits(&self, wanted: usize) -> Option<[f32; SWEEPS]> {
        // Bits of numbers that are not negative are in their order.
        let mut counts = vec![0u32; 1 << (31 - LIMIT_BITS)];
        let mut count = 0;
        for error in self.choices.iter().map(|choice| choice.error).filter(|error| error.is_finite()) {
            counts[(error.to_bits() >> LIMIT_BITS) as usize] += 1;
            count += 1;
        }
        if count == 0 {
            return None;
        }
        // Only the better part: what is dear now may be avoided later. A smaller part where that costs little time.
        let part = if count < CAREFUL { 4 } else { 2 };
        let goal = (wanted / 2).min(count / part);
        let mut limits = [f32::MAX; SWEEPS];
        let (mut sum, mut sweep) = (0, 0);
        for (bin, &more) in counts.iter().enumerate() {
            sum += more as usize;
            while sweep < SWEEPS && sum > goal * (sweep + 1) / SWEEPS {
                limits[sweep] = f32::from_bits(((bin as u32 + 1) << LIMIT_BITS) - 1);
                sweep += 1;
            }
        }
        Some(limits)
    }

    /// Moves vertices, about half of what is wanted at most.
    fn pass(&mut self, pass: u16, wanted: usize, most_error: f64) -> Done {
        let mut done = Done::default();
        // By what was known before, which is not far from what is.
        let before = if self.asks_all { None } else { self.limits(wanted) };
        self.choose(pass, before.map_or(f32::INFINITY, |limits| limits[SWEEPS - 1]), most_error);
        let Some(limits) = self.limits(wanted) else { return done };
        let mut lists = Lists::default();
        let count = self.choices.len();
        for block in (0..count).step_by(BLOCK).map(|start| start..(start + BLOCK).min(count)) {
            for limit in limits {
                self.sweep(pass, block.clone(), wanted, limit, &mut done, &mut lists);
            }
        }
        // Where little of the better part is allowed, the rest has its turn.
        let mut limit = limits[SWEEPS - 1];
        while done.removed < wanted / 16 && limit.is_finite() {
            limit = if limit > f32::MIN_POSITIVE { limit * 2.0 } else { 1e-12 };
            self.sweep(pass, 0..count, wanted, limit, &mut done, &mut lists);
        }
        done
    }

    /// Does moves whose error is within a limit.
    fn sweep(
        &mut self,
        pass: u16,
        block: Range<usize>,
        wanted: usize,
        limit: f32,
        done: &mut Done,
        lists: &mut Lists,
    ) {
        for vertex in block {
            let choice = self.choices[vertex];
            if choice.error > limit || choice.error == f32::INFINITY {
                continue;
            }
            if done.removed >= wanted {
                break;
            }
            if choice.seen <= choice.changed || choice.seen <= self.vertices[choice.target as usize].taken {
                continue;
            }
            match self.collapse(pass, vertex as u32, choice, lists) {
                0 => {
                    // The next pass has another idea.
                    done.refused += 1;
                    self.choices[vertex].is_careful = true;
                    self.choices[vertex].changed = pass;
                }
                gone => {
                    done.removed += gone;
                    done.worst = done.worst.max(choice.error);
                }
            }
        }
    }

    /// Moves a vertex onto its target if the topology stays, and tells how many triangles go.
    fn collapse(&mut self, pass: u16, from: u32, choice: Choice, lists: &mut Lists) -> usize {
        let to = choice.target;
        let Lists { spokes, others, .. } = lists;
        self.fans.gather(&self.triangles, from, spokes);
        if !self.allows(spokes, others, from, to, choice.freedom) {
            return 0;
        }
        let links = self.links(spokes, to);
        let mut removed = 0;
        for &spoke in spokes.iter() {
            let [triangle, corner] = spoke.corner_after(0);
            if spoke.ends.contains(&to) {
                removed += 1;
            } else {
                self.triangles[triangle][corner] = to;
                if let Some(link) = links.iter().flatten().find(|l| l[0] == self.wedges[triangle][corner]) {
                    self.wedges[triangle][corner] = link[1];
                }
            }
            spoke.ends.iter().for_each(|&end| self.choices[end as usize].changed = pass);
        }
        for spoke in spokes.iter().filter(|spoke| spoke.ends.contains(&to)) {
            self.triangles[spoke.triangle()] = GONE;
        }
        self.count -= removed;
        self.choices[from as usize] = Choice { error: f32::INFINITY, freedom: Freedom::Gone, ..choice };
        self.fans.hand_over(from, to);
        let moved = self.quadrics[from as usize];
        let quadric = &mut self.quadrics[to as usize];
        *quadric += moved;
        let target = &mut self.vertices[to as usize];
        target.own_error = quadric.sum(target.place);
        target.weight = quadric.weight;
        target.taken = pass;
        removed
    }

    /// Leaves out vertices and triangles that are gone.
    fn close_gaps(&mut self) {
        let mut number = vec![u32::MAX; self.choices.len()];
        let mut kept = 0;
        for (vertex, number) in number.iter_mut().enumerate() {
            if self.choices[vertex].freedom != Freedom::Gone {
                *number = kept as u32;
                self.vertices[kept] = self.vertices[vertex];
                self.quadrics[kept] = self.quadrics[vertex];
                self.choices[kept] = self.choices[vertex];
                self.numbers[kept] = self.numbers[vertex];
                kept += 1;
            }
        }
        self.vertices.truncate(kept);
        self.quadrics.truncate(kept);
        self.choices.truncate(kept);
        self.numbers.truncate(kept);
        for choice in &mut self.choices {
            // What moved away has changed all about it: such a choice is void.
            choice.target = number[choice.target as usize].min(kept as u32 - 1);
        }
        let is_left = |triangle: &[u32; 3]| *triangle != GONE;
        if !self.wedges.is_empty() {
            let mut triangles = self.triangles.iter();
            self.wedges.retain(|_| triangles.next().is_some_and(is_left));
        }
        self.triangles.retain(is_left);
        self.triangles.as_flattened_mut().iter_mut().for_each(|v| *v = number[*v as usize]);
        self.fans = Fans::of(&self.triangles, kept);
    }

    /// The mesh of what is left; attributes from a corner of each wedge.
    fn rebuilt(&self, mesh: &TriangleMesh, wedges: &Wedges) -> TriangleMesh {
        let triangles = self.triangles.iter().map(|t| t.map(|v| self.numbers[v as usize])).collect();
        wedges.mesh(mesh, triangles, &self.wedges)
    }
}
