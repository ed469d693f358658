//! Which triangle each sample shows: all parts of a subject put through the raster.

use crate::clip::Frustum;
use crate::exact::Exact;
use crate::raster::{EMPTY, Fine, Grid, REACH, Slope, doubled_area, linear_of, number_of};
use crate::subject::{FormKind, Mesh, Part, Subject};
use crate::view::{Rays, Sight, View, wide_affine};
use crate::{PreviewError, surface};
use glam::{DAffine3, DMat3, DVec2, DVec3, Vec3};
use luch_bvh::Aabb;
use luch_scene::{Material, Opacity, Sides};
use rayon::prelude::*;
use std::sync::atomic::AtomicU64;

/// What a subject shows in a view: the nearest triangle of each sample.
#[derive(Debug)]
pub(crate) struct Visibility<'a> {
    pub(crate) subject: &'a Subject<'a>,
    pub(crate) view: View,
    /// In the order of the subject's parts.
    pub(crate) placed: Vec<Placed>,
    cells: Vec<u64>,
}

/// A part as the view has it.
#[derive(Clone, Debug)]
pub(crate) struct Placed {
    pub(crate) to_view: DAffine3,
    pub(crate) from_view: DAffine3,
    /// Takes normals to the world and keeps outside outside, as the renderer does.
    pub(crate) normal_map: DMat3,
    /// Number of its first triangle; those of all parts are counted through.
    pub(crate) first: u32,
    /// Least depth that is shown.
    pub(crate) near: f64,
}

/// A triangle of a part.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Seen {
    pub(crate) part: usize,
    pub(crate) triangle: u32,
}

/// A vertex in view space.
#[derive(Clone, Copy, Debug)]
struct Vertex {
    place: DVec3,
    /// Where in the picture; `None` if the triangles at it must be cut first.
    fine: Option<Fine>,
}

/// Triangles that one thread takes at a time.
const CHUNK: usize = 1 << 12;

/// What is nearer than this part of the farthest depth of a part is cut off: small enough never to be missed, large enough
/// that double precision places what is cut within a thousandth of a sample.
const NEAR: f64 = 1.0 / (1u64 << 40) as f64;

impl<'a> Visibility<'a> {
    /// Looks at the subject. Back faces are passed over if `hides_backs`.
    pub(crate) fn new(subject: &'a Subject<'a>, view: View, hides_backs: bool) -> Result<Self, PreviewError> {
        let mut count = 0u64;
        let placed = subject.parts.iter().map(|part| {
            let to_view = view.place(&part.placement);
            let first = u32::try_from(count).unwrap_or(u32::MAX);
            let form = &subject.forms[part.form];
            count += match &form.kind {
                FormKind::Mesh(mesh) => mesh.triangles.triangles.len() as u64,
                FormKind::Exact(_) => 1,
            };
            Placed {
                to_view,
                from_view: to_view.inverse(),
                normal_map: wide_affine(&part.placement).matrix3.inverse().transpose(),
                first,
                near: near(&to_view, &form.bounds),
            }
        });
        let placed: Vec<Placed> = placed.collect();
        if count >= u64::from(u32::MAX) {
            return Err(PreviewError::TooManyTriangles { count });
        }
        let samples = view.size.width as usize * view.size.height as usize;
        let cells: Vec<AtomicU64> = (0..samples).into_par_iter().map(|_| AtomicU64::new(EMPTY)).collect();
        let mut seen = Self { subject, view, placed, cells: Vec::new() };
        seen.draw(&cells, hides_backs);
        seen.cells = cells.into_iter().map(AtomicU64::into_inner).collect();
        Ok(seen)
    }

    /// Large parts one after another with all threads, so that few vertices are kept; then the small ones side by side.
    fn draw(&self, cells: &[AtomicU64], hides_backs: bool) {
        let is_large = |part: &Part| match &self.subject.forms[part.form].kind {
            FormKind::Mesh(mesh) => mesh.triangles.triangles.len() > CHUNK,
            FormKind::Exact(_) => true,
        };
        let (large, small): (Vec<usize>, Vec<usize>) =
            (0..self.subject.parts.len()).partition(|&part| is_large(&self.subject.parts[part]));
        let draw = |&part: &usize| Drawing::new(self, cells, part, hides_backs).draw();
        large.iter().for_each(draw);
        small.par_iter().for_each(draw);
    }

    /// Word of a sample.
    #[inline]
    pub(crate) fn cell(&self, x: u32, y: u32) -> u64 {
        self.cells[y as usize * self.view.size.width as usize + x as usize]
    }

    /// Whether a sample shows nothing.
    #[inline]
    pub(crate) fn is_empty(&self, x: u32, y: u32) -> bool {
        self.cell(x, y) == EMPTY
    }

    /// What a sample shows.
    #[inline]
    pub(crate) fn seen(&self, x: u32, y: u32) -> Option<Seen> {
        Some(self.seen_by_number(number_of(self.cell(x, y))?))
    }

    #[inline]
    fn seen_by_number(&self, number: u32) -> Seen {
        // Parts without triangles have the number of the next one; the last of equals has it.
        let part = self.placed.partition_point(|placed| placed.first <= number) - 1;
        Seen { part, triangle: number - self.placed[part].first }
    }

    /// The linear depth of a sample that shows something, in single precision.
    pub(crate) fn linear(&self, x: u32, y: u32) -> f64 {
        linear_of(&self.view, self.cell(x, y))
    }

    /// Whether linear depths fall with the distance.
    pub(crate) fn nearer_is_greater(&self) -> bool {
        self.view.rays == Rays::Central
    }

    /// The number of the face that a triangle is of.
    pub(crate) fn face(&self, seen: Seen) -> u32 {
        match &self.subject.forms[self.subject.parts[seen.part].form].kind {
            FormKind::Mesh(mesh) => mesh.face(seen.triangle),
            FormKind::Exact(_) => 0,
        }
    }

    /// The linear depth of the plane of a triangle, or of an exact shape, at any place of the picture; not beyond the depths of
    /// the triangle's corners.
    pub(crate) fn extended(&self, seen: Seen, place: DVec2) -> Option<f64> {
        let placed = &self.placed[seen.part];
        match &self.subject.forms[self.subject.parts[seen.part].form].kind {
            FormKind::Mesh(mesh) => {
                let corners = mesh.corners(seen.triangle)?;
                let whole = corners.map(|corner| placed.to_view.transform_point3(corner.as_dvec3()));
                let cut = Frustum::new(&self.view, placed.near, DVec2::splat(REACH)).cut(whole);
                if cut.corners().is_empty() {
                    return None;
                }
                let from_middle = place - self.view.middle;
                Some(Slope::new(&self.view, whole, cut.corners()).at(from_middle.x, from_middle.y))
            }
            FormKind::Exact(exact) => {
                let meeting = exact.meetings(&self.local_sight(seen.part, place)).next()?;
                Some(self.view.linear(meeting.depth))
            }
        }
    }

    /// The line of sight of a place in a part's coordinates.
    pub(crate) fn local_sight(&self, part: usize, place: DVec2) -> Sight {
        self.view.sight(place).through(&self.placed[part].from_view)
    }
}

/// The least depth that is shown of what lies in a box.
fn near(to_view: &DAffine3, bounds: &Aabb) -> f64 {
    let corners = (0..8).map(|corner: usize| {
        let pick = |axis: usize| if corner >> axis & 1 == 0 { bounds.min[axis] } else { bounds.max[axis] };
        to_view.transform_point3(Vec3::new(pick(0), pick(1), pick(2)).as_dvec3()).z.abs()
    });
    let farthest = corners.filter(|depth| depth.is_finite()).fold(0.0, f64::max);
    (farthest * NEAR).max(f64::MIN_POSITIVE)
}

/// One part on its way into the cells.
struct Drawing<'v> {
    seen: &'v Visibility<'v>,
    grid: Grid<'v>,
    part: &'v Part<'v>,
    number: usize,
    placed: &'v Placed,
    frustum: Frustum,
    hides_backs: bool,
}

impl<'v> Drawing<'v> {
    fn new(seen: &'v Visibility<'v>, cells: &'v [AtomicU64], part: usize, hides_backs: bool) -> Self {
        let placed = &seen.placed[part];
        let frustum = Frustum::new(&seen.view, placed.near, DVec2::splat(REACH));
        let grid = Grid::new(&seen.view, cells);
        Self { seen, grid, part: &seen.subject.parts[part], number: part, placed, frustum, hides_backs }
    }

    fn draw(&self) {
        match &self.seen.subject.forms[self.part.form].kind {
            FormKind::Mesh(mesh) => self.draw_mesh(mesh),
            FormKind::Exact(exact) => self.draw_exact(exact),
        }
    }

    fn draw_mesh(&self, mesh: &Mesh) {
        let triangles = &*mesh.triangles;
        let vertex = |position: &Vec3| self.vertex(*position);
        let vertices: Vec<Vertex> = triangles.positions.par_iter().with_min_len(CHUNK).map(vertex).collect();
        let chunks = triangles.triangles.par_chunks(CHUNK).enumerate();
        chunks.for_each(|(chunk, triangles)| {
            for (i, &[a, b, c]) in triangles.iter().enumerate() {
                let at = |index: u32| vertices.get(index as usize);
                if let (Some(a), Some(b), Some(c)) = (at(a), at(b), at(c)) {
                    self.draw_triangle([a, b, c], (chunk * CHUNK + i) as u32);
                }
            }
        });
    }

    #[inline]
    fn vertex(&self, position: Vec3) -> Vertex {
        let view = &self.seen.view;
        let place = self.placed.to_view.transform_point3(position.as_dvec3());
        let fine = self.frustum.contains(place).then(|| self.fine(view, place));
        Vertex { place, fine }
    }

    #[inline]
    fn fine(&self, view: &View, place: DVec3) -> Fine {
        Fine::new(place.truncate() / view.divisor(place.z) + view.middle)
    }

    #[inline]
    fn draw_triangle(&self, corners: [&Vertex; 3], triangle: u32) {
        let places = corners.map(|corner| corner.place);
        if let [Some(a), Some(b), Some(c)] = corners.map(|corner| corner.fine) {
            return self.fill([a, b, c], places, &places, triangle);
        }
        let cut = self.frustum.cut(places);
        let Some((&first, rest)) = cut.corners().split_first() else { return };
        let fine = |place| self.fine(&self.seen.view, place);
        for pair in rest.windows(2) {
            let piece = [first, pair[0], pair[1]];
            self.fill(piece.map(fine), places, &piece, triangle);
        }
    }

    /// Fills a piece of a triangle that is wholly in front.
    #[inline]
    fn fill(&self, fine: [Fine; 3], whole: [DVec3; 3], piece: &[DVec3], triangle: u32) {
        let number = self.placed.first + triangle;
        let slope = || Slope::new(&self.seen.view, whole, piece);
        if !self.hides_backs && !self.part.has_gaps {
            return self.grid.fill(fine, number, slope, |_, _| true);
        }
        // Clockwise in the picture is counter-clockwise with y upward, seen from behind.
        let is_front = (doubled_area(fine) < 0) != self.part.is_mirrored;
        if self.hides_backs && !is_front {
            return;
        }
        let Some(material) = self.material(triangle).filter(|_| self.part.has_gaps) else {
            return self.grid.fill(fine, number, slope, |_, _| true);
        };
        if material.sides == Sides::Front && !is_front {
            return;
        }
        self.grid.fill(fine, number, slope, |x, y| self.is_there(material, triangle, x, y));
    }

    fn material(&self, triangle: u32) -> Option<&'v Material> {
        let slot = match &self.seen.subject.forms[self.part.form].kind {
            FormKind::Mesh(mesh) => mesh.triangles.slot(triangle as usize),
            FormKind::Exact(_) => 0,
        };
        self.seen.subject.material(self.part, slot)
    }

    /// Whether a material is there at all where a sample meets a triangle.
    fn is_there(&self, material: &Material, triangle: u32, x: u32, y: u32) -> bool {
        if matches!(material.opacity, Opacity::Opaque) {
            return true;
        }
        let place = DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5);
        let seen = Seen { part: self.number, triangle };
        surface::Spot::of_triangle(self.seen, seen, place).is_none_or(|spot| spot.is_there(material))
    }

    fn draw_exact(&self, exact: &Exact) {
        let Some(window) = self.window(exact) else { return };
        let view = &self.seen.view;
        let material = self.material(0).filter(|_| self.part.has_gaps);
        let [[left, right], [top, bottom]] = window;
        (top..bottom).into_par_iter().for_each(|y| {
            for x in left..right {
                let place = DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5);
                let sight = self.seen.local_sight(self.number, place);
                let hit = exact.meetings(&sight).find(|meeting| {
                    (meeting.is_front || !self.hides_backs)
                        && material.is_none_or(|material| {
                            let spot = surface::Spot::on_exact(self.seen, self.number, &sight, meeting);
                            (meeting.is_front || material.sides == Sides::Both) && spot.is_there(material)
                        })
                });
                if let Some(meeting) = hit {
                    let cell = y as usize * view.size.width as usize + x as usize;
                    let linear = view.linear(meeting.depth);
                    let least = f64::from(f32::MIN_POSITIVE);
                    self.grid.show(cell, linear.clamp(least, f64::from(f32::MAX)), self.placed.first);
                }
            }
        });
    }

    /// Columns and rows that may show an exact shape.
    fn window(&self, exact: &Exact) -> Option<[[u32; 2]; 2]> {
        let view = &self.seen.view;
        let whole = [[0, view.size.width], [0, view.size.height]];
        let bounds = exact.bounds();
        if bounds.is_empty() {
            return (*exact == Exact::Plane).then_some(whole);
        }
        let (mut least, mut most) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        for corner in 0..8 {
            let pick =
                |axis: usize| if corner >> axis & 1 == 0 { bounds.min[axis] } else { bounds.max[axis] };
            let corner = Vec3::new(pick(0), pick(1), pick(2)).as_dvec3();
            let place = self.placed.to_view.transform_point3(corner);
            if !self.frustum.contains(place) {
                return Some(whole);
            }
            let place = place.truncate() / view.divisor(place.z) + view.middle;
            (least, most) = (least.min(place), most.max(place));
        }
        // Casting to an unsigned number cuts off at both ends; one sample more on each side covers rounding.
        let range = |least: f64, most: f64, count: u32| {
            [((least - 1.0) as u32).min(count), ((most + 2.0) as u32).min(count)]
        };
        Some([range(least.x, most.x, view.size.width), range(least.y, most.y, view.size.height)])
    }
}
