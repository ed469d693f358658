//! Edges cut off at an even width.
//!
//! Around each vertex the bevelled edges part the faces into sectors; each sector gets one new vertex, placed so that it is one
//! width away from the edges on both its sides. A face between the new vertices takes the place of each edge, and of each vertex
//! where three or more bevelled edges meet.

use std::f64::consts::PI;

use glam::{DQuat, DVec3};

use super::{Around, Beveled, Surroundings};
use crate::PolygonMesh;
use crate::edit::builder::{Builder, NewCorner, Origin, Shade};
use crate::edit::error::check_size;
use crate::edit::geometry::{angle_between, unit_normals};
use crate::edit::{EditError, prepared};
use crate::normals::corner_angle;

/// A new vertex: its old one, and how far it goes for each metre of width.
struct Point {
    vertex: u32,
    way: DVec3,
}

/// The points that take the place of vertices.
#[derive(Default)]
struct Plan {
    points: Vec<Point>,
    /// For each corner the points it becomes; none if it stays.
    of_corner: Vec<Vec<u32>>,
    /// Where a bevel ends inside the surface: for the corner from which the edge leaves, the vertex in the middle of the end.
    middles: Vec<Option<u32>>,
    /// Faces in place of vertices, as corners and points.
    vertex_faces: Vec<Vec<(u32, u32)>>,
}

/// Widths at sharp bends go no farther than so many times the width.
const LEAST_SINE: f64 = 0.2;
/// Faces that differ by less, in radians, are as good as one.
const FLAT: f64 = 1e-3;

/// Cuts off the given edges, so that the new faces begin `width` metres from them.
///
/// Where one sector of faces has no flat place for its new vertex, the width is even only as nearly as can be. The width is held below
/// that at which an edge would turn round. Border edges are left alone. A closed mesh stays closed. `edges` are rising, lower
/// end first.
///
/// # Errors
/// [`EditError::NotManifold`] if at one end of an edge there is one that has three faces, or two of the same direction.
pub fn bevel_edges(mesh: &PolygonMesh, edges: &[[u32; 2]], width: f64) -> Result<Beveled, EditError> {
    let mesh = &*prepared(mesh);
    let around = Surroundings::new(mesh);
    let is_beveled = beveled_half_edges(&around, edges)?;
    check_size(mesh.face_count() as u64 + mesh.corners.len() as u64, mesh.corners.len() as u64 * 8)?;
    let plan = Plan::new(&around, &is_beveled);
    let width = width.min(plan.widest(&around) * 0.99);
    let mut builder = Builder::new(mesh);
    let vertices = plan.points.iter().map(|point| {
        let place = mesh.positions[point.vertex as usize].as_dvec3() + point.way * width;
        builder.vertex(place, Origin::Of(point.vertex))
    });
    let vertices: Vec<u32> = vertices.collect();
    let corner_at = |corner: u32, point: u32| {
        let way = plan.points[point as usize].way * width;
        around.near(corner, vertices[point as usize], way)
    };
    for face in 0..mesh.face_count() {
        if mesh.face(face).all(|corner| plan.of_corner[corner].is_empty()) {
            builder.copy_face(face);
            continue;
        }
        let borders = mesh.borders(face).into_iter().map(|border| {
            let corners = border.flat_map(|corner| {
                let (corner, points) = (corner as u32, &plan.of_corner[corner]);
                let stays = points.is_empty().then(|| NewCorner::like(mesh.corners[corner as usize], corner));
                stays.into_iter().chain(points.iter().map(move |&point| corner_at(corner, point)))
            });
            corners.collect()
        });
        builder.face(face, &borders.collect::<Vec<Vec<_>>>(), Shade::Mixed, None);
    }
    for one in 0..mesh.corners.len() as u32 {
        let Some(other) =
            around.opposites[one as usize].filter(|&other| is_beveled[one as usize] && one < other)
        else {
            continue;
        };
        // From the end of the edge to its start along the first face, and back along the other.
        let mut quad = Vec::with_capacity(6);
        for (from, across) in [(one, other), (other, one)] {
            let end = around.next(from);
            let last = |corner: u32| plan.of_corner[corner as usize].last().copied();
            let first = |corner: u32| plan.of_corner[corner as usize].first().copied();
            quad.extend(first(end).map(|point| corner_at(end, point)));
            quad.extend(last(from).map(|point| corner_at(from, point)));
            let middle = plan.middles[from as usize];
            quad.extend(middle.map(|point| corner_at(around.next(across), point)));
        }
        quad.dedup_by_key(|corner| corner.vertex);
        if quad.first().map(|corner| corner.vertex) == quad.last().map(|corner| corner.vertex) {
            quad.pop();
        }
        builder.face(around.half_edges.face(one) as usize, &[quad], Shade::Flat, None);
    }
    for face in &plan.vertex_faces {
        let like = around.half_edges.face(face[0].0) as usize;
        let corners = face.iter().map(|&(corner, point)| corner_at(corner, point)).collect();
        builder.face(like, &[corners], Shade::Flat, None);
    }
    Ok(Beveled { mesh: builder.finish(), width })
}

/// For each half-edge whether its edge is to be cut off.
fn beveled_half_edges(around: &Surroundings, edges: &[[u32; 2]]) -> Result<Vec<bool>, EditError> {
    let mut is_beveled = vec![false; around.opposites.len()];
    let mut is_touched = vec![false; around.mesh.positions.len()];
    let is_sound = |edge: &crate::edges::Edge| {
        edge.half_edges.len() == 1 || around.opposites[edge.half_edges[0] as usize].is_some()
    };
    for edge in around.half_edges.edges() {
        if edges.binary_search(&edge.vertices).is_ok() && edge.half_edges.len() > 1 {
            edge.half_edges.iter().for_each(|&half_edge| is_beveled[half_edge as usize] = true);
            edge.vertices.iter().for_each(|&vertex| is_touched[vertex as usize] = true);
        }
    }
    let unsound = around
        .half_edges
        .edges()
        .find(|edge| !is_sound(edge) && edge.vertices.iter().any(|&vertex| is_touched[vertex as usize]));
    match unsound {
        Some(edge) => Err(EditError::NotManifold { vertices: edge.vertices }),
        None => Ok(is_beveled),
    }
}

impl Plan {
    fn new(around: &Surroundings, is_beveled: &[bool]) -> Self {
        let count = around.opposites.len();
        let mut plan =
            Self { of_corner: vec![Vec::new(); count], middles: vec![None; count], ..Default::default() };
        let normals = unit_normals(around.mesh);
        let mut is_done = vec![false; count];
        for start in 0..count as u32 {
            // Each fan once, from an edge that is cut off.
            if is_beveled[start as usize] && !is_done[start as usize] {
                let fan = around.around(start);
                fan.corners.iter().for_each(|&corner| is_done[corner as usize] = true);
                plan.add_fan(around, is_beveled, &normals, &fan);
            }
        }
        plan
    }

    fn point(&mut self, vertex: u32, way: DVec3) -> u32 {
        let way = if way.is_finite() { way } else { DVec3::ZERO };
        self.points.push(Point { vertex, way });
        self.points.len() as u32 - 1
    }

    fn add_fan(&mut self, around: &Surroundings, is_beveled: &[bool], normals: &[DVec3], fan: &Around) {
        // A sector begins at each corner whose outgoing edge is cut off.
        let sectors: Vec<&[u32]> = fan.corners.chunk_by(|_, &corner| !is_beveled[corner as usize]).collect();
        if let (true, [sector]) = (fan.is_closed, sectors.as_slice())
            && sector.len() > 2
        {
            return self.add_end(around, normals, sector);
        }
        let vertex = around.vertex(fan.corners[0]);
        let count = sectors.len();
        let mut ring = Vec::with_capacity(count);
        for (number, sector) in sectors.iter().enumerate() {
            let way = match (fan.is_closed, number) {
                // At a border the point runs along it.
                (false, 0) => around.outgoing(sector[0]) / libm::sin(angles(around, sector)).max(LEAST_SINE),
                (false, number) if number + 1 == count => {
                    let last = sector[sector.len() - 1];
                    around.incoming(last) / libm::sin(angles(around, sector)).max(LEAST_SINE)
                }
                _ => between(around, normals, sector),
            };
            let point = self.point(vertex, way);
            sector.iter().for_each(|&corner| self.of_corner[corner as usize] = vec![point]);
            ring.push((sector[0], point));
        }
        if count > 2 {
            self.vertex_faces.push(ring);
        }
    }

    /// The end of a single cut inside the surface: both sides run along the next sharp edges, and the vertex moves
    /// to the middle between them.
    fn add_end(&mut self, around: &Surroundings, normals: &[DVec3], sector: &[u32]) {
        let vertex = around.vertex(sector[0]);
        let normal = |corner: u32| normals[around.half_edges.face(corner) as usize];
        let is_sharp = |pair: &[u32]| angle_between(normal(pair[0]), normal(pair[1])) > FLAT;
        // Faces in one plane with that beside the cut go along with it.
        let mut left_end = sector.windows(2).position(is_sharp).unwrap_or(0) + 1;
        let mut right_start = sector.windows(2).rposition(is_sharp).unwrap_or(sector.len() - 2) + 1;
        if left_end >= right_start {
            (left_end, right_start) = (1, sector.len() - 1);
        }
        let (left_part, right_part) = (&sector[..left_end], &sector[right_start..]);
        let inner = &sector[left_end..right_start];
        let along = |way: DVec3, part: &[u32]| way / libm::sin(angles(around, part)).max(LEAST_SINE);
        let left_way = along(around.incoming(left_part[left_part.len() - 1]), left_part);
        let right_way = along(around.outgoing(right_part[0]), right_part);
        let (left, right) = (self.point(vertex, left_way), self.point(vertex, right_way));
        left_part.iter().for_each(|&corner| self.of_corner[corner as usize] = vec![left]);
        right_part.iter().for_each(|&corner| self.of_corner[corner as usize] = vec![right]);
        // Around more than half a turn the vertex is the tip of the new face and stays; else it would fold over.
        let is_tip = angles(around, inner) >= PI;
        if let (&[only], false) = (inner, is_tip) {
            self.of_corner[only as usize] = vec![right, left];
            return;
        }
        let middle = self.point(vertex, if is_tip { DVec3::ZERO } else { (left_way + right_way) / 2.0 });
        inner.iter().for_each(|&corner| self.of_corner[corner as usize] = vec![middle]);
        self.of_corner[inner[0] as usize].push(left);
        self.of_corner[inner[inner.len() - 1] as usize].insert(0, right);
        self.middles[sector[0] as usize] = Some(middle);
    }

    /// The widest cut at which no edge of a face turns round.
    fn widest(&self, around: &Surroundings) -> f64 {
        let way = |point: Option<&u32>| point.map_or(DVec3::ZERO, |&point| self.points[point as usize].way);
        let mut widest = f64::INFINITY;
        for corner in 0..around.opposites.len() as u32 {
            let next = around.next(corner);
            let (from, to) = (&self.of_corner[corner as usize], &self.of_corner[next as usize]);
            let along = around.place(next) - around.place(corner);
            let shrinking = -(way(to.first()) - way(from.last())).dot(along) / along.length_squared();
            if shrinking > 0.0 {
                widest = widest.min(1.0 / shrinking);
            }
        }
        widest
    }
}

/// The sum of the angles of corners side by side.
fn angles(around: &Surroundings, sector: &[u32]) -> f64 {
    let angle = |&corner: &u32| {
        let before = around.place(around.previous[corner as usize]);
        corner_angle(before, around.place(corner), around.place(around.next(corner)))
    };
    sector.iter().map(angle).sum()
}

/// The way to the point of a sector between two edges that are cut off.
fn between(around: &Surroundings, normals: &[DVec3], sector: &[u32]) -> DVec3 {
    let normal = |corner: u32| normals[around.half_edges.face(corner) as usize];
    // A single sharp edge inside the sector is kept: the point runs along it.
    let mut sharp = sector
        .windows(2)
        .enumerate()
        .filter(|(_, pair)| angle_between(normal(pair[0]), normal(pair[1])) > FLAT);
    if let (Some((place, pair)), None) = (sharp.next(), sharp.next()) {
        let (one, other) = (angles(around, &sector[..=place]), angles(around, &sector[place + 1..]));
        let sine = (libm::sin(one) + libm::sin(other)) / 2.0;
        return around.incoming(pair[0]) / sine.max(LEAST_SINE);
    }
    // Halfway through the faces laid flat, in the face where that is.
    let half = angles(around, sector) / 2.0;
    let mut passed = 0.0;
    for &corner in sector {
        let angle = angles(around, &[corner]);
        if passed + angle >= half || corner == sector[sector.len() - 1] {
            let turn = half - passed;
            let direction = turned(around.outgoing(corner), normal(corner), turn);
            return direction / libm::sin(half.min(PI)).max(LEAST_SINE);
        }
        passed += angle;
    }
    DVec3::ZERO
}

/// A vector turned about a unit vector.
fn turned(vector: DVec3, axis: DVec3, angle: f64) -> DVec3 {
    let half = angle / 2.0;
    let spin = axis * libm::sin(half);
    DQuat::from_xyzw(spin.x, spin.y, spin.z, libm::cos(half)) * vector
}
