//! Polygons to triangles: triangles as they are, quads by a good diagonal, convex faces as fans, all others by ear
//! clipping in the plane of their Newell normal.

use std::ops::Range;

use earcut::Earcut;
use glam::{DVec2, DVec3};

use super::cracks::{close_cracks, use_every_corner};
use super::{CornerAttribute, PolygonMesh};
use crate::{Attribute, TriangleMesh};

/// Triangles made of polygons.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Triangulation {
    /// The triangles, in the order of their faces and with their winding.
    pub mesh: TriangleMesh,
    /// For each triangle the face it comes from.
    pub faces: Vec<u32>,
    /// How many faces gave no triangle: fewer than three different corners, no area, not finite, or with holes and too
    /// much work.
    pub dropped_faces: usize,
    /// How many concave faces were too much work for ear clipping and became fans, which may overlap.
    pub fanned_faces: usize,
}

/// The most corners a concave face may have: ear clipping takes quadratic time at worst.
const MOST_CONCAVE_CORNERS: usize = 1 << 14;
/// The most ear clipping for one mesh, as the sum of the squares of corner counts: some seconds at worst.
const MOST_EAR_CLIPPING: usize = 1 << 31;

impl PolygonMesh {
    /// Cuts every face into triangles, using every corner, so that a closed mesh stays closed.
    ///
    /// Faces that name a position or value that does not exist are dropped too. The result is the same on every
    /// machine. Faces that cross themselves give triangles that overlap.
    pub fn triangulation(&self) -> Triangulation {
        let mut cutter = Cutter {
            mesh: self,
            earcut: Earcut::new(),
            clipped: 0,
            fanned_faces: 0,
            triangles: Vec::with_capacity(self.corners.len()),
        };
        let mut result = Triangulation::default();
        let mut has_holes = vec![false; if self.holes.is_empty() { 0 } else { self.face_count() }];
        for hole in &self.holes {
            if let Some(flag) = has_holes.get_mut(hole.face as usize) {
                *flag = true;
            }
        }
        for face in 0..self.face_count() {
            let corners = self.face(face);
            let before = cutter.triangles.len();
            if self.is_in_range(corners.clone()) {
                if has_holes.get(face).copied().unwrap_or(false) {
                    cutter.cut_with_holes(&self.borders(face));
                } else {
                    cutter.cut(corners);
                }
            }
            let made = cutter.triangles.len() - before;
            result.faces.extend(std::iter::repeat_n(face as u32, made));
            result.dropped_faces += usize::from(made == 0);
        }
        result.fanned_faces = cutter.fanned_faces;
        result.mesh = self.collect(&cutter.triangles, &result.faces);
        result
    }

    fn is_in_range(&self, corners: Range<usize>) -> bool {
        fn holds<T>(attribute: &CornerAttribute<T>, corners: &Range<usize>) -> bool {
            let Some(indices) = attribute.corners.get(corners.clone()) else {
                return attribute.corners.is_empty();
            };
            indices.iter().all(|&i| (i as usize) < attribute.values.len())
        }
        self.corners[corners.clone()].iter().all(|&i| (i as usize) < self.positions.len())
            && holds(&self.normals, &corners)
            && holds(&self.colors, &corners)
            && self.uv_sets.iter().all(|uvs| holds(uvs, &corners))
    }

    fn collect(&self, triangles: &[[u32; 3]], faces: &[u32]) -> TriangleMesh {
        fn attribute<T: Copy>(values: &CornerAttribute<T>, triangles: &[[u32; 3]]) -> Attribute<T> {
            if values.corners.is_empty() {
                return Attribute::per_position(values.values.clone());
            }
            let indices = triangles.iter().map(|t| t.map(|corner| values.corners[corner as usize]));
            Attribute::indexed(values.values.clone(), indices.collect())
        }
        let slots = if self.slots.is_empty() {
            Vec::new()
        } else {
            faces.iter().map(|&face| self.slots.get(face as usize).copied().unwrap_or(0)).collect()
        };
        TriangleMesh {
            positions: self.positions.clone(),
            triangles: triangles.iter().map(|t| t.map(|corner| self.corners[corner as usize])).collect(),
            normals: attribute(&self.normals, triangles),
            uv_sets: self.uv_sets.iter().map(|uvs| attribute(uvs, triangles)).collect(),
            tangents: Attribute::default(),
            colors: attribute(&self.colors, triangles),
            slots,
        }
    }

    /// Twice the area times the normal of a border (Newell's method: good for faces that are not quite flat).
    pub(super) fn newell_normal(&self, corners: &[u32]) -> DVec3 {
        let place = |corner: u32| self.positions[self.corners[corner as usize] as usize].as_dvec3();
        let Some(&first) = corners.first() else { return DVec3::ZERO };
        // Relative to the first corner: no digits lost far from the origin.
        let origin = place(first);
        let spokes = corners.windows(2).map(|pair| (place(pair[0]) - origin).cross(place(pair[1]) - origin));
        spokes.sum()
    }
}

struct Cutter<'a> {
    mesh: &'a PolygonMesh,
    earcut: Earcut<f64>,
    /// Ear clipping done so far: the sum of the squares of corner counts.
    clipped: usize,
    fanned_faces: usize,
    /// Corner numbers of the triangles so far.
    triangles: Vec<[u32; 3]>,
}

impl Cutter<'_> {
    fn position(&self, corner: u32) -> u32 {
        self.mesh.corners[corner as usize]
    }

    fn point(&self, corner: u32) -> DVec3 {
        self.mesh.positions[self.position(corner) as usize].as_dvec3()
    }

    /// The corners of a border without those that repeat the position index before them.
    fn distinct(&self, border: Range<usize>) -> Vec<u32> {
        let mut corners: Vec<u32> = border.map(|corner| corner as u32).collect();
        corners.dedup_by_key(|corner| self.position(*corner));
        while corners.len() > 1 && self.position(corners[0]) == self.position(corners[corners.len() - 1]) {
            corners.pop();
        }
        corners
    }

    fn cut(&mut self, border: Range<usize>) {
        if border.len() == 3 {
            // A triangle without area stays: its edges may hold two neighbours together.
            let corners = [0, 1, 2].map(|k| (border.start + k) as u32);
            let [a, b, c] = corners.map(|corner| self.position(corner));
            if a != b && b != c && c != a && corners.iter().all(|&corner| self.point(corner).is_finite()) {
                self.triangles.push(corners);
            }
            return;
        }
        let corners = self.distinct(border);
        match *corners {
            [] | [_] | [_, _] => {}
            [a, b, c] if [a, b, c].iter().all(|&corner| self.point(corner).is_finite()) => {
                self.triangles.push([a, b, c]);
            }
            _ => {
                let Some(flat) = Flat::new(self, &[corners.as_slice()]) else { return };
                if let [a, b, c, d] = *corners
                    && let Some(keep_first) = flat.quad_diagonal()
                {
                    let cut = if keep_first { [[a, b, c], [a, c, d]] } else { [[b, c, d], [b, d, a]] };
                    self.triangles.extend(cut);
                } else if flat.is_strictly_convex() {
                    self.triangles.extend(corners[1..].windows(2).map(|pair| [corners[0], pair[0], pair[1]]));
                } else if !self.may_clip(corners.len()) {
                    self.fanned_faces += 1;
                    self.triangles.extend(corners[1..].windows(2).map(|pair| [corners[0], pair[0], pair[1]]));
                } else {
                    self.clip_ears(&[corners], &flat);
                }
            }
        }
    }

    fn cut_with_holes(&mut self, borders: &[Range<usize>]) {
        let mut loops: Vec<Vec<u32>> = borders.iter().map(|border| self.distinct(border.clone())).collect();
        // The outer border stays first; a hole needs three corners to be one.
        let mut is_first = true;
        loops.retain(|corners| std::mem::take(&mut is_first) || corners.len() > 2);
        let total: usize = loops.iter().map(Vec::len).sum();
        if loops[0].len() < 3 || !self.may_clip(total) {
            return;
        }
        let slices: Vec<&[u32]> = loops.iter().map(Vec::as_slice).collect();
        if let Some(flat) = Flat::new(self, &slices) {
            self.clip_ears(&loops, &flat);
        }
    }

    /// True if there is time left for ear clipping of so many corners, and counts it.
    fn may_clip(&mut self, corners: usize) -> bool {
        let work = corners.saturating_mul(corners);
        let allowed = corners <= MOST_CONCAVE_CORNERS && work <= MOST_EAR_CLIPPING - self.clipped;
        self.clipped += if allowed { work } else { 0 };
        allowed
    }

    fn clip_ears(&mut self, loops: &[Vec<u32>], flat: &Flat) {
        let mut hole_starts = Vec::new();
        let mut count = 0;
        for corners in loops {
            if count > 0 {
                hole_starts.push(count as u32);
            }
            count += corners.len();
        }
        let mut cut: Vec<u32> = Vec::new();
        let points = flat.points.iter().map(|p| [p.x, p.y]);
        self.earcut.earcut(points, &hole_starts, &mut cut);
        let mut triangles: Vec<[u32; 3]> = cut.chunks_exact(3).map(|t| [t[0], t[1], t[2]]).collect();
        // The face runs counter-clockwise in its plane; the library's order is its own matter.
        if triangles.iter().map(|&t| flat.doubled_area(t)).sum::<f64>() < 0.0 {
            triangles.iter_mut().for_each(|t| t.swap(1, 2));
        }
        close_cracks(&mut triangles, loops, &flat.points);
        use_every_corner(&mut triangles, loops[0].len(), flat.points.len());
        let all: Vec<u32> = loops.concat();
        for triangle in triangles {
            let corners = triangle.map(|i| all[i as usize]);
            // Bridges to holes and spikes give triangles that are lines from a position to itself.
            let [a, b, c] = corners.map(|corner| self.position(corner));
            if a != b && b != c && c != a {
                self.triangles.push(corners);
            }
        }
    }
}

/// A face seen along the axis nearest to its normal, its border counter-clockwise.
///
/// Leaving out a coordinate stretches the face but keeps the numbers as they are: what lies on a line stays on it
/// exactly, which a rotation into the plane could not promise.
struct Flat {
    points: Vec<DVec2>,
    places: Vec<DVec3>,
}

impl Flat {
    /// Projects along the normal of the outer border; `None` if it has none.
    fn new(cutter: &Cutter, loops: &[&[u32]]) -> Option<Self> {
        let normal = cutter.mesh.newell_normal(loops[0]);
        normal.try_normalize()?;
        let axis = normal.abs().max_position();
        let (right, up) = ((axis + 1) % 3, (axis + 2) % 3);
        let (right, up) = if normal[axis] > 0.0 { (right, up) } else { (up, right) };
        let places: Vec<DVec3> =
            loops.iter().copied().flatten().map(|&corner| cutter.point(corner)).collect();
        let points = places.iter().map(|p| DVec2::new(p[right], p[up])).collect();
        places.iter().all(|p| p.is_finite()).then_some(Self { points, places })
    }

    fn doubled_area(&self, triangle: [u32; 3]) -> f64 {
        let [a, b, c] = triangle.map(|i| self.points[i as usize]);
        (b - a).perp_dot(c - a)
    }

    /// True to cut a quad from corner 0 to 2, false from 1 to 3: the shorter of those that lie inside, on a tie the
    /// first. `None` if the face crosses itself or has a straight corner.
    fn quad_diagonal(&self) -> Option<bool> {
        let turns_left = |a, b, c| self.doubled_area([a, b, c]) > 0.0;
        let first_inside = turns_left(0, 1, 2) && turns_left(0, 2, 3);
        let second_inside = turns_left(1, 2, 3) && turns_left(1, 3, 0);
        let length = |a: usize, b: usize| self.places[a].distance_squared(self.places[b]);
        match (first_inside, second_inside) {
            // A hair's breadth must not decide: neighbouring squares should be cut alike.
            (true, true) => Some(length(0, 2) <= length(1, 3) * 1.0001),
            (true, false) => Some(true),
            (false, true) => Some(false),
            (false, false) => None,
        }
    }

    /// True if every corner turns left and the border goes around once.
    fn is_strictly_convex(&self) -> bool {
        let count = self.points.len();
        let edge = |i: usize| self.points[(i + 1) % count] - self.points[i % count];
        let turns_left = (0..count).all(|i| edge(i).perp_dot(edge(i + 1)) > 0.0);
        // Edges pass from leftward to rightward once per turn.
        let is_rightward = |i: usize| {
            let DVec2 { x, y } = edge(i);
            x > 0.0 || (x == 0.0 && y > 0.0)
        };
        turns_left && (0..count).filter(|&i| !is_rightward(i) && is_rightward(i + 1)).count() == 1
    }
}
