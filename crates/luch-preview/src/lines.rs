//! Edges and vertices over the picture: antialiased, with those behind something left out.
//!
//! How much of a sample a line covers is decided by the sample's distance from it; whether the line is seen there is decided
//! for the line's own nearest point, so a visible line has its full width even along an outline (after Cole and Finkelstein,
//! "Two fast methods for high-quality line visibility", 2010). Strengths are joined by the greatest, whatever the order.

use crate::clip::Frustum;
use crate::outline::{EdgeKind, NO_FACE, OutlineEdge};
use crate::style::{EdgeSet, Hidden, Style};
use crate::subject::{FormKind, Part};
use crate::visibility::Visibility;
use glam::{DVec2, DVec3, Vec3};
use luch_image::Rgb;
use rayon::prelude::*;
use std::sync::atomic::{AtomicU8, Ordering};

/// One colour over the picture.
#[derive(Debug)]
pub(crate) struct Layer {
    pub(crate) color: Rgb,
    /// For each sample how much of it is covered, 0 to 255.
    strengths: Vec<u8>,
}

impl Layer {
    /// A colour seen through the layer.
    #[inline]
    pub(crate) fn over(&self, sample: usize, below: Rgb) -> Rgb {
        match self.strengths[sample] {
            0 => below,
            strength => below.lerp(self.color, f32::from(strength) / 255.0),
        }
    }
}

/// Widest line and largest dot, in pixels.
const WIDEST: f32 = 64.0;
/// How strong hidden lines are that are drawn faintly.
const FAINT: f64 = 0.25;
/// Edges that one thread takes at a time.
const CHUNK: usize = 1 << 9;

/// The layers of a style, lowest first; `factor` samples stand along a side of a pixel.
pub(crate) fn layers(seen: &Visibility, style: &Style, factor: u32) -> Vec<Layer> {
    let mut layers = Vec::new();
    let pen = |width: f32, hidden| Pen::new(seen, width, hidden, factor);
    if let Some(lines) = style.lines {
        let is_drawn = |edge: &OutlineEdge| match lines.edges {
            EdgeSet::All => true,
            EdgeSet::Features { crease_angle } => {
                let angle = crease_angle.clamp(0.0, std::f32::consts::PI);
                edge.kind != EdgeKind::Inner || edge.bend_cosine < libm::cosf(angle)
            }
        };
        layers.push(pen(lines.width, lines.hidden).edges(lines.color, is_drawn));
    }
    if let Some(marks) = style.marks {
        for (kind, color) in [(EdgeKind::Border, marks.border), (EdgeKind::NonManifold, marks.non_manifold)] {
            layers.push(pen(marks.width, marks.hidden).edges(color, |edge| edge.kind == kind));
        }
    }
    if let Some(dots) = style.dots {
        layers.push(pen(dots.diameter, dots.hidden).vertices(dots.color));
    }
    layers
}

/// Draws one layer.
struct Pen<'v> {
    seen: &'v Visibility<'v>,
    hidden: Hidden,
    /// Half the width in samples, at least half a sample.
    radius: f64,
    /// What is left of lines that are thinner.
    strength: f64,
    strengths: Vec<AtomicU8>,
}

/// A point of a line in the picture.
#[derive(Clone, Copy)]
struct Point {
    place: DVec2,
    linear: f64,
}

impl<'v> Pen<'v> {
    fn new(seen: &'v Visibility<'v>, width: f32, hidden: Hidden, factor: u32) -> Self {
        // What is no number is nothing.
        let width = if width > 0.0 { f64::from(width.min(WIDEST)) } else { 0.0 } * f64::from(factor);
        let samples = seen.view.size.width as usize * seen.view.size.height as usize;
        let strengths = (0..samples).into_par_iter().map(|_| AtomicU8::new(0)).collect();
        Self { seen, hidden, radius: width.max(1.0) / 2.0, strength: width.min(1.0), strengths }
    }

    fn layer(self, color: Rgb) -> Layer {
        Layer { color, strengths: self.strengths.into_iter().map(AtomicU8::into_inner).collect() }
    }

    /// All that is nearer than this to the picture's middle may show.
    fn frustum(&self, part: usize) -> Frustum {
        let beyond = DVec2::splat(self.radius + 2.0);
        Frustum::new(&self.seen.view, self.seen.placed[part].near, self.seen.view.middle + beyond)
    }

    fn edges(self, color: Rgb, is_drawn: impl Fn(&OutlineEdge) -> bool + Sync) -> Layer {
        self.seen.subject.parts.par_iter().enumerate().for_each(|(number, part)| {
            let outline = self.seen.subject.forms[part.form].outline();
            let frustum = self.frustum(number);
            outline.edges.par_chunks(CHUNK).for_each(|edges| {
                for edge in edges.iter().filter(|edge| is_drawn(edge)) {
                    let ends = edge.ends.map(|end| self.point(number, part, end));
                    if let [Some(from), Some(to)] = ends
                        && let Some(ends) = frustum.cut_segment([from, to])
                    {
                        self.segment(number, edge, ends.map(|end| self.project(end)));
                    }
                }
            });
        });
        self.layer(color)
    }

    fn vertices(self, color: Rgb) -> Layer {
        self.seen.subject.parts.par_iter().enumerate().for_each(|(number, part)| {
            let FormKind::Mesh(mesh) = &self.seen.subject.forms[part.form].kind else { return };
            let frustum = self.frustum(number);
            // A vertex that nothing uses is no part of the surface.
            let mut is_used = vec![false; mesh.triangles.positions.len()];
            for corner in mesh.triangles.triangles.iter().flatten() {
                if let Some(flag) = is_used.get_mut(*corner as usize) {
                    *flag = true;
                }
            }
            is_used.par_chunks(CHUNK).enumerate().for_each(|(chunk, used)| {
                for (i, _) in used.iter().enumerate().filter(|(_, is_used)| **is_used) {
                    let point = self.point(number, part, (chunk * CHUNK + i) as u32);
                    if let Some(point) = point.filter(|&point| frustum.contains(point)) {
                        let point = self.project(point);
                        let none = OutlineEdge {
                            ends: [0; 2],
                            faces: [NO_FACE; 2],
                            kind: EdgeKind::Inner,
                            bend_cosine: 1.0,
                        };
                        self.segment(number, &none, [point, point]);
                    }
                }
            });
        });
        self.layer(color)
    }

    /// A point of a part's outline in view space.
    fn point(&self, number: usize, part: &Part, index: u32) -> Option<DVec3> {
        let form = &self.seen.subject.forms[part.form];
        let points: &[Vec3] = match &form.kind {
            FormKind::Mesh(mesh) => match &mesh.polygons {
                Some(polygons) => &polygons.mesh.positions,
                None => &mesh.triangles.positions,
            },
            FormKind::Exact(_) => &form.outline().points,
        };
        let point = points.get(index as usize)?.as_dvec3();
        Some(self.seen.placed[number].to_view.transform_point3(point))
    }

    fn project(&self, point: DVec3) -> Point {
        let view = &self.seen.view;
        Point { place: point.truncate() / view.divisor(point.z) + view.middle, linear: view.linear(point.z) }
    }

    /// Covers the samples within the radius of a segment.
    fn segment(&self, part: usize, edge: &OutlineEdge, [from, to]: [Point; 2]) {
        let size = self.seen.view.size;
        let along = to.place - from.place;
        let squared = along.length_squared();
        let reach = self.radius + 0.5;
        // Line by line across the longer axis: columns of a flat line, rows of a steep one.
        let is_flat = along.x.abs() >= along.y.abs();
        let turned = |place: DVec2| if is_flat { place } else { DVec2::new(place.y, place.x) };
        let (start, end) = (turned(from.place), turned(to.place));
        let (count, across) = if is_flat { (size.width, size.height) } else { (size.height, size.width) };
        let slope = if end.x == start.x { 0.0 } else { (end.y - start.y) / (end.x - start.x) };
        let half = reach * (1.0 + slope * slope).sqrt();
        let (low, high) = (start.y.min(end.y) - reach, start.y.max(end.y) + reach);
        for i in samples(start.x.min(end.x) - reach, start.x.max(end.x) + reach, count) {
            let middle = start.y + slope * (f64::from(i) + 0.5 - start.x);
            for j in samples((middle - half).max(low), (middle + half).min(high), across) {
                let [x, y] = if is_flat { [i, j] } else { [j, i] };
                let sample = DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5);
                let at = if squared > 0.0 {
                    ((sample - from.place).dot(along) / squared).clamp(0.0, 1.0)
                } else {
                    0.0
                };
                let nearest = from.place + along * at;
                let covered = (reach - sample.distance(nearest)).clamp(0.0, 1.0) * self.strength;
                let cell = &self.strengths[y as usize * size.width as usize + x as usize];
                let stored = |covered: f64| (covered * 255.0 + 0.5) as u8;
                if stored(covered) <= cell.load(Ordering::Relaxed) {
                    continue;
                }
                let linear = from.linear + (to.linear - from.linear) * at;
                let is_seen = self.hidden == Hidden::Shown
                    || self.is_visible(part, edge.faces, Point { place: nearest, linear });
                let covered = match (is_seen, self.hidden) {
                    (false, Hidden::Removed) => 0.0,
                    (false, Hidden::Faint) => covered * FAINT,
                    _ => covered,
                };
                cell.fetch_max(stored(covered), Ordering::Relaxed);
            }
        }
    }

    /// Whether no surface hides a point of an edge: one of the four samples about it shows nothing, a face of the edge, or a
    /// surface that passes the point less than a sample's width before it.
    fn is_visible(&self, part: usize, faces: [u32; 2], point: Point) -> bool {
        let view = &self.seen.view;
        let depth = view.depth(point.linear);
        let corner = (point.place - 0.5).floor();
        let mut is_outside = true;
        for offset in [DVec2::ZERO, DVec2::X, DVec2::Y, DVec2::ONE] {
            let sample = corner + offset;
            let is_inside = sample.cmpge(DVec2::ZERO).all()
                && sample.x < f64::from(view.size.width)
                && sample.y < f64::from(view.size.height);
            if !is_inside {
                continue;
            }
            is_outside = false;
            let [x, y] = [sample.x as u32, sample.y as u32];
            let Some(seen) = self.seen.seen(x, y) else { return true };
            if seen.part == part && faces.contains(&self.seen.face(seen)) {
                return true;
            }
            let linear = self.seen.extended(seen, point.place).unwrap_or_else(|| self.seen.linear(x, y));
            if view.depth(linear) + view.footprint(depth) >= depth {
                return true;
            }
        }
        is_outside
    }
}

/// Samples whose middles lie between two places, as far as there are any.
fn samples(least: f64, most: f64, count: u32) -> std::ops::Range<u32> {
    // Casting to an unsigned number cuts off at both ends.
    ((least - 0.5).ceil() as u32)..(((most - 0.5).floor() + 1.0) as u32).min(count)
}
