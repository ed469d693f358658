//! What is known of each vertex before the first collapse: its planes, and how far it may move.

use glam::DVec3;
use rayon::prelude::*;

use super::fans::{Fans, Spoke};
use super::quadric::Quadric;

/// How much the planes that stand on borders and seams count against the surface.
const BORDER_WEIGHT: f64 = 10.0;
const SEAM_WEIGHT: f64 = 1.0;

/// Where a vertex may move.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Freedom {
    /// Onto any neighbour.
    Inner,
    /// Along the border.
    Border,
    /// Nowhere: the surface is no manifold here, or borders are kept.
    Locked,
    /// It has moved, or no triangle ever used it.
    Gone,
}

/// A vertex at the beginning.
pub(super) struct Start {
    pub(super) freedom: Freedom,
    pub(super) quadric: Quadric,
}

/// The triangles, from which the starts follow.
pub(super) struct Surface<'a> {
    pub(super) places: &'a [DVec3],
    pub(super) triangles: &'a [[u32; 3]],
    /// Wedges of corners; empty if they are the positions.
    pub(super) wedges: &'a [[u32; 3]],
    pub(super) fans: &'a Fans,
    pub(super) keeps_borders: bool,
}

/// The unit normal of a triangle and twice its area.
#[derive(Clone, Copy)]
struct Plane {
    normal: DVec3,
    weight: f64,
}

/// Lists that are used again for each vertex.
#[derive(Default)]
struct Lists {
    spokes: Vec<Spoke>,
    /// Neighbour, place in `spokes`, and whether the edge leads here.
    edges: Vec<u64>,
    /// For each spoke the one that follows counter-clockwise.
    following: Vec<u32>,
}

const NONE: u32 = u32::MAX;
/// Up to so many triangles each is compared with each.
const PLAIN: usize = 16;

impl Surface<'_> {
    pub(super) fn starts(&self) -> Vec<Start> {
        let plane = |triangle: &[u32; 3]| {
            let [a, b, c] = triangle.map(|v| self.places[v as usize]);
            let normal = (b - a).cross(c - a);
            let length = normal.length();
            Plane { normal: if length > 0.0 { normal / length } else { DVec3::ZERO }, weight: length }
        };
        let planes: Vec<Plane> = self.triangles.par_iter().with_min_len(1 << 12).map(plane).collect();
        (0..self.places.len() as u32)
            .into_par_iter()
            .with_min_len(1 << 12)
            .map_init(Lists::default, |lists, vertex| self.start(vertex, &planes, lists))
            .collect()
    }

    fn start(&self, vertex: u32, planes: &[Plane], lists: &mut Lists) -> Start {
        let Lists { spokes, edges, following } = lists;
        self.fans.gather(self.triangles, vertex, spokes);
        let mut start = Start { freedom: Freedom::Inner, quadric: Quadric::default() };
        if spokes.is_empty() {
            start.freedom = Freedom::Gone;
            return start;
        }
        let place = self.places[vertex as usize];
        for spoke in spokes.iter() {
            let plane = planes[spoke.triangle()];
            start.quadric += Quadric::of_plane(plane.normal, place, plane.weight);
        }
        if self.is_plain_fan(&mut start.quadric, spokes) {
            return start;
        }
        edges.clear();
        for (n, spoke) in spokes.iter().enumerate() {
            let key = |end: usize| u64::from(spoke.ends[end]) << 32 | (n as u64) << 1 | end as u64;
            edges.extend([key(0), key(1)]);
        }
        edges.sort_unstable();
        following.clear();
        following.resize(spokes.len(), NONE);
        let mut first = 0;
        for group in edges.chunk_by(|a, b| a >> 32 == b >> 32) {
            let spoke = |key: u64| (key as u32 >> 1) as usize;
            match *group {
                [only] => {
                    self.add_upright(&mut start.quadric, spokes[spoke(only)], only & 1 == 1, BORDER_WEIGHT);
                    if start.freedom == Freedom::Inner {
                        start.freedom = Freedom::Border;
                    }
                    if only & 1 == 0 {
                        first = spoke(only);
                    }
                }
                [one, other] if (one ^ other) & 1 == 1 => {
                    let [out, back] = if one & 1 == 0 { [one, other] } else { [other, one] }.map(spoke);
                    following[back] = out as u32;
                    self.add_seam(&mut start.quadric, spokes[out], spokes[back]);
                }
                _ => start.freedom = Freedom::Locked,
            }
        }
        if start.freedom == Freedom::Border && self.keeps_borders {
            start.freedom = Freedom::Locked;
        }
        // All triangles must be one fan.
        let (mut at, mut seen) = (first as u32, 0);
        while at != NONE && seen < spokes.len() {
            seen += 1;
            at = following[at as usize];
            if at as usize == first {
                break;
            }
        }
        if seen < spokes.len() {
            start.freedom = Freedom::Locked;
        }
        start
    }

    /// Whether few triangles close round a vertex, which most do; then their seams are added.
    fn is_plain_fan(&self, quadric: &mut Quadric, spokes: &[Spoke]) -> bool {
        let mut around = [0; PLAIN];
        if spokes.len() > PLAIN {
            return false;
        }
        for step in 0..spokes.len() {
            let end = spokes[around[step]].ends[1];
            let Some(next) = spokes.iter().position(|spoke| spoke.ends[0] == end) else { return false };
            // Back at the first after all others, and not before.
            if (next == 0) != (step + 1 == spokes.len()) {
                return false;
            }
            if next != 0 {
                around[step + 1] = next;
            }
        }
        if !self.wedges.is_empty() {
            for step in 0..spokes.len() {
                let out = around[(step + 1) % spokes.len()];
                self.add_seam(quadric, spokes[out], spokes[around[step]]);
            }
        }
        true
    }

    /// A seam, where the wedges of two triangles at their common edge differ.
    fn add_seam(&self, quadric: &mut Quadric, out: Spoke, back: Spoke) {
        if self.wedges.is_empty() {
            return;
        }
        let wedge = |[triangle, corner]: [usize; 2]| self.wedges[triangle][corner];
        let is_smooth = wedge(out.corner_after(0)) == wedge(back.corner_after(0))
            && wedge(out.corner_after(1)) == wedge(back.corner_after(2));
        if !is_smooth {
            // Both ends of the edge take the triangle that comes first.
            let is_back = back.corner < out.corner;
            self.add_upright(quadric, if is_back { back } else { out }, is_back, SEAM_WEIGHT);
        }
    }

    /// The plane upright on a triangle along the edge that leaves its corner, or that leads back to it.
    fn add_upright(&self, quadric: &mut Quadric, spoke: Spoke, is_back: bool, weight: f64) {
        let [triangle, corner] = spoke.corner_after(0);
        let corners = self.triangles[triangle].map(|v| self.places[v as usize]);
        let (own, next, previous) = (corners[corner], corners[(corner + 1) % 3], corners[(corner + 2) % 3]);
        let along = if is_back { own - previous } else { next - own };
        if let Some(normal) = along.cross((next - own).cross(previous - own)).try_normalize() {
            *quadric += Quadric::of_plane(normal, own, along.length_squared() * weight);
        }
    }
}
