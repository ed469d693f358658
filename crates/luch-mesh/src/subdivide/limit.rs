//! Where vertices end after infinitely many levels, and how the surface is turned there, in closed form.
//!
//! Places: the left eigenvectors of eigenvalue 1 (Loop 1987; Halstead, Kass and DeRose 1993, "Efficient, fair interpolation using
//! Catmull–Clark surfaces"); on curves those of the cubic B-spline. Normals: the cross product of the left eigenvectors of
//! the two largest eigenvalues below 1. On a curve one of them runs along it, the other into each of the two sides: with k faces
//! on the side, weights sin(iπ/k) for the inner edges; those of the vertex and the curve follow from the rows of
//! the subdivision matrix that belong to them.
//!
//! Where a single sharp edge ends (a dart) there is no such form: the ring about the vertex is subdivided on its own until
//! it has shrunk to a point.
//!
//! What is still sharp for a finite number of levels counts as sharp for ever.

use std::f64::consts::{PI, TAU};

use glam::{DVec3, Vec3};

use super::dart::dart_ring;
use super::masks::{Feature, Rule, feature, loop_beta};
use super::topology::{Topology, list};
use crate::polygon_mesh::CornerAttribute;

/// The places in the limit of the first `count` vertices. For Catmull–Clark all faces must be quads.
pub(super) fn positions(topology: &Topology, places: &[DVec3], rule: Rule, count: u32) -> Vec<DVec3> {
    list(count as usize, |vertex| {
        let own = places[vertex as usize];
        let edges = topology.edges_at(vertex);
        match feature(topology, vertex, |sharpness| sharpness) {
            _ if rule == Rule::Linear || edges.is_empty() => own,
            Feature::Corner => own,
            Feature::Crease([a, b]) => (own * 4.0 + places[a as usize] + places[b as usize]) / 6.0,
            Feature::Smooth => {
                // Halved this often, the ring is smaller than the last digit.
                if let Some(ring) = dart_ring(topology, places, rule, vertex, 64) {
                    return ring.vertex;
                }
                let valence = edges.len() as f64;
                let neighbours =
                    edges.iter().map(|&edge| places[topology.across(edge, vertex) as usize]).sum::<DVec3>();
                if rule == Rule::Loop {
                    let weight = 1.0 / (0.375 / loop_beta(valence) + valence);
                    return own * (1.0 - valence * weight) + neighbours * weight;
                }
                let corners = topology.corners_at(vertex);
                let opposite = corners.iter().map(|&c| places[opposite(topology, c) as usize]).sum::<DVec3>();
                let total = valence * (valence + 4.0) + corners.len() as f64;
                (own * valence * valence + neighbours * 4.0 + opposite) / total
            }
        }
    })
}

/// The vertex across a quad.
pub(super) fn opposite(topology: &Topology, corner: u32) -> u32 {
    topology.corners[topology.next(topology.next(corner)) as usize]
}

/// The normals in the limit: one for each of the first `count` vertices, more where sharp edges part its faces.
pub(super) fn normals(
    topology: &Topology,
    places: &[DVec3],
    rule: Rule,
    count: u32,
) -> CornerAttribute<Vec3> {
    let maker = Maker { topology, places, rule, circle: Circle::new() };
    let at_vertices = list(count as usize, |vertex| maker.normals_at(vertex));
    let mut values: Vec<Vec3> = at_vertices.iter().map(|at| unit(at.first)).collect();
    if at_vertices.iter().all(|at| at.others.is_empty()) {
        return CornerAttribute::per_position(values);
    }
    let mut corners = topology.corners.clone();
    for side in at_vertices.iter().flat_map(|at| &at.others) {
        for &corner in &side.corners {
            corners[corner as usize] = values.len() as u32;
        }
        values.push(unit(side.normal));
    }
    CornerAttribute::indexed(values, corners)
}

fn unit(normal: DVec3) -> Vec3 {
    crate::normals::unit_or_z(normal)
}

/// The normals of a vertex; most have one.
struct VertexNormals {
    first: DVec3,
    others: Vec<Side>,
}

/// Corners of a vertex between two sharp edges.
struct Side {
    normal: DVec3,
    corners: Vec<u32>,
}

struct Maker<'a> {
    topology: &'a Topology,
    places: &'a [DVec3],
    rule: Rule,
    circle: Circle,
}

impl Maker<'_> {
    fn place(&self, vertex: u32) -> DVec3 {
        self.places[vertex as usize]
    }

    fn normals_at(&self, vertex: u32) -> VertexNormals {
        let corners = self.topology.corners_at(vertex);
        let only = |first| VertexNormals { first, others: Vec::new() };
        let Some(&start) = corners.first() else { return only(DVec3::ZERO) };
        let feature = feature(self.topology, vertex, |sharpness| sharpness);
        if feature == Feature::Smooth {
            // The ring is a thousandth of its size then, but still far above rounding.
            if let Some(ring) = dart_ring(self.topology, self.places, self.rule, vertex, 10) {
                return only(ring.normal());
            }
            let closes = self.around(start, |_| false).count() == corners.len()
                && self.around(start, |_| false).last().and_then(|last| self.topology.next_around(last))
                    == Some(start);
            let normal = closes.then(|| self.smooth(vertex, start, corners.len()));
            return only(normal.filter(|n| is_direction(*n)).unwrap_or_else(|| self.facets(corners)));
        }
        let is_sharp = |edge: u32| self.topology.edge_sharpness[edge as usize] > 0.0;
        let mut sides = Vec::new();
        let mut covered = 0;
        for &corner in corners {
            if is_sharp(self.topology.corner_edges[corner as usize]) {
                let own: Vec<u32> = self.around(corner, is_sharp).collect();
                covered += own.len();
                sides.push(Side { normal: self.side(vertex, &own, feature), corners: own });
            }
        }
        // Faces wound against each other, or a sharp vertex on a smooth surface.
        if covered != corners.len() || sides.is_empty() {
            return only(self.facets(corners));
        }
        let first = sides.swap_remove(0).normal;
        VertexNormals { first, others: sides }
    }

    /// Corners counter-clockwise until a sharp edge, an end, or the first again.
    fn around(&self, start: u32, is_sharp: impl Fn(u32) -> bool) -> impl Iterator<Item = u32> {
        std::iter::successors(Some(start), move |&corner| {
            let incoming = self.topology.corner_edges[self.topology.previous(corner) as usize];
            let next = if is_sharp(incoming) { None } else { self.topology.next_around(corner) };
            next.filter(|next| *next != start)
        })
    }

    fn facets(&self, corners: &[u32]) -> DVec3 {
        let [next, previous] = [Topology::next, Topology::previous].map(|step| {
            move |corner| self.place(self.topology.corners[step(self.topology, corner) as usize])
        });
        let own = |corner: u32| self.place(self.topology.corners[corner as usize]);
        corners.iter().map(|&c| (next(c) - own(c)).cross(previous(c) - own(c))).sum()
    }

    fn smooth(&self, vertex: u32, start: u32, valence: usize) -> DVec3 {
        let own = self.place(vertex);
        let factor = face_ratio(self.circle.at(1, valence)[0], libm::cos(PI / valence as f64));
        let mut tangents = [DVec3::ZERO; 2];
        for (i, corner) in self.around(start, |_| false).enumerate() {
            let here = self.circle.at(i, valence);
            let edge = self.place(self.topology.corners[self.topology.next(corner) as usize]) - own;
            match self.rule {
                Rule::CatmullClark => {
                    let there = self.circle.at(i + 1, valence);
                    let face = self.place(opposite(self.topology, corner)) - own;
                    for k in 0..2 {
                        tangents[k] += edge * (factor * here[k]) + face * (here[k] + there[k]);
                    }
                }
                _ => (0..2).for_each(|k| tangents[k] += edge * here[k]),
            }
        }
        tangents[0].cross(tangents[1])
    }

    /// The normal of the faces between two sharp edges.
    fn side(&self, vertex: u32, corners: &[u32], feature: Feature) -> DVec3 {
        let own = self.place(vertex);
        let facets = self.facets(corners);
        let end_of = |corner: u32| self.place(self.topology.corners[corner as usize]) - own;
        let first = end_of(self.topology.next(corners[0]));
        let last = end_of(self.topology.previous(corners[corners.len() - 1]));
        let normal = if matches!(feature, Feature::Crease(_)) {
            (first - last).cross(self.toward_side(own, corners, first, last))
        } else {
            first.cross(last)
        };
        if is_direction(normal) && normal.dot(facets) > 0.0 { normal } else { facets }
    }

    /// The tangent away from a curve; all places relative to the vertex, whose own weight is therefore not needed.
    fn toward_side(&self, own: DVec3, corners: &[u32], first: DVec3, last: DVec3) -> DVec3 {
        let count = corners.len();
        if count == 1 {
            return first + last;
        }
        let angle = PI / count as f64;
        let (sine, sum) = (libm::sin(angle), 1.0 / libm::tan(angle / 2.0));
        let end_of = |corner: u32| self.place(self.topology.corners[corner as usize]) - own;
        // Eigenvalue, and what inner edges and faces give to the rows of the curve and the vertex.
        let is_quads = self.rule == Rule::CatmullClark;
        let cosine = libm::cos(angle);
        let factor = if is_quads { face_ratio(cosine, libm::cos(angle / 2.0)) } else { 1.0 };
        let (eigenvalue, to_curve, to_vertex) = if is_quads {
            let eigenvalue = (4.0 + factor) / 16.0;
            (eigenvalue, eigenvalue * sine, (0.375 * factor + 0.5) * sum)
        } else {
            (0.375 + 0.25 * cosine, sine / 8.0, 0.375 * sum)
        };
        let vertex_weight =
            (to_curve + to_vertex * (eigenvalue - 0.5)) / ((eigenvalue - 1.0) * (eigenvalue - 0.25));
        let curve_weight = vertex_weight * (eigenvalue - 0.75) - to_vertex;
        let mut tangent = (first + last) * curve_weight;
        for (i, &corner) in corners.iter().enumerate() {
            let [here, there] = [i, i + 1].map(|i| self.circle.at(i, 2 * count)[1]);
            if i > 0 {
                tangent += end_of(self.topology.next(corner)) * (factor * here);
            }
            if is_quads {
                tangent += (self.place(opposite(self.topology, corner)) - own) * (here + there);
            }
        }
        tangent
    }
}

/// How much more an edge counts than a face in a tangent of Catmull–Clark, by the cosine of the angle between two
/// edges and that of its half.
fn face_ratio(cosine: f64, half_cosine: f64) -> f64 {
    1.0 + cosine + half_cosine * (2.0 * (9.0 + cosine)).sqrt()
}

fn is_direction(vector: DVec3) -> bool {
    vector.try_normalize().is_some()
}

/// Cosine and sine of i / n turns; those of small n are kept.
struct Circle {
    kept: Vec<Vec<[f64; 2]>>,
}

impl Circle {
    const KEPT: usize = 24;

    fn new() -> Self {
        let row = |count: usize| (0..=count).map(|i| Self::computed(i, count)).collect();
        Self { kept: (0..Self::KEPT).map(row).collect() }
    }

    fn computed(i: usize, count: usize) -> [f64; 2] {
        let angle = TAU * i as f64 / count.max(1) as f64;
        [libm::cos(angle), libm::sin(angle)]
    }

    fn at(&self, i: usize, count: usize) -> [f64; 2] {
        match self.kept.get(count).and_then(|row| row.get(i)) {
            Some(kept) => *kept,
            None => Self::computed(i, count),
        }
    }
}
