//! Normals of polygons: flat, smooth, by crease angle; and anew after a change of form.

use std::collections::HashMap;

use glam::{DVec3, Vec3};

use super::fans::Fans;
use super::geometry::{angle_between, corner_place, previous_corners, unit_normals};
use super::prepared;
use super::raise::even_outward;
use crate::PolygonMesh;
use crate::normals::{corner_angle, unit_or_z};
use crate::polygon_mesh::{CornerAttribute, HalfEdges};

/// Every face its own normal.
pub fn flat_normals(mesh: &PolygonMesh) -> CornerAttribute<Vec3> {
    gathered(mesh, |face, _| [face, 0])
}

/// One normal for each vertex, weighted by the angles of its faces.
pub fn smooth_normals(mesh: &PolygonMesh) -> CornerAttribute<Vec3> {
    gathered(mesh, |_, corner| [mesh.corners[corner], 0])
}

/// Smooth across edges whose faces differ by no more than an angle, in radians; sharp across others and across creases.
pub fn creased_normals(mesh: &PolygonMesh, angle: f64) -> CornerAttribute<Vec3> {
    let half_edges = HalfEdges::new(mesh);
    let opposites = half_edges.opposites();
    let normals = unit_normals(mesh);
    let normal = |half_edge: u32| normals[half_edges.face(half_edge) as usize];
    let mut fans =
        Fans::new(&half_edges, &opposites, |one, other| angle_between(normal(one), normal(other)) <= angle);
    let roots: Vec<u32> = (0..mesh.corners.len() as u32).map(|corner| fans.of(corner)).collect();
    gathered(mesh, |_, corner| [roots[corner], 0])
}

/// Normals anew for a form that has changed: corners of a vertex that had one normal get one again. Corners for which `keeps`
/// says so stay as they are. For prepared meshes.
pub fn refresh_normals(mesh: &mut PolygonMesh, keeps: impl Fn(usize) -> bool) {
    if mesh.normals.corners.len() != mesh.corners.len() || mesh.normals.is_empty() {
        return;
    }
    let old = std::mem::take(&mut mesh.normals);
    let fresh = gathered(mesh, |_, corner| [mesh.corners[corner], old.corners[corner]]);
    let shift = old.values.len() as u32;
    let kept = old.corners.iter().zip(&fresh.corners).enumerate();
    let corners: Vec<u32> =
        kept.map(|(corner, (&old, &fresh))| if keeps(corner) { old } else { fresh + shift }).collect();
    mesh.normals = CornerAttribute { values: [old.values, fresh.values].concat(), corners };
    mesh.normals = shared(std::mem::take(&mut mesh.normals));
}

/// One normal for each key of a corner, weighted by angles.
fn gathered(mesh: &PolygonMesh, key: impl Fn(u32, usize) -> [u32; 2]) -> CornerAttribute<Vec3> {
    let half_edges = HalfEdges::new(mesh);
    let previous = previous_corners(&half_edges, mesh.corners.len());
    let normals = unit_normals(mesh);
    let mut numbers: HashMap<[u32; 2], u32> = HashMap::new();
    let mut sums: Vec<DVec3> = Vec::new();
    let mut corners = Vec::with_capacity(mesh.corners.len());
    for (corner, &before) in previous.iter().enumerate() {
        let face = half_edges.face(corner as u32);
        let number = *numbers.entry(key(face, corner)).or_insert_with(|| {
            sums.push(DVec3::ZERO);
            sums.len() as u32 - 1
        });
        let [before, after] =
            [before, half_edges.next(corner as u32)].map(|corner| corner_place(mesh, corner as usize));
        let part = normals[face as usize] * corner_angle(before, corner_place(mesh, corner), after);
        if part.is_finite() {
            sums[number as usize] += part;
        }
        corners.push(number);
    }
    shared(CornerAttribute { values: sums.into_iter().map(unit_or_z).collect(), corners })
}

/// Equal values once, in the order in which corners name them.
fn shared(attribute: CornerAttribute<Vec3>) -> CornerAttribute<Vec3> {
    let mut numbers: HashMap<[u32; 3], u32> = HashMap::new();
    let mut values = Vec::new();
    let corners = attribute.corners.iter().map(|&number| {
        let value = attribute.values[number as usize];
        *numbers.entry(value.to_array().map(f32::to_bits)).or_insert_with(|| {
            values.push(value);
            values.len() as u32 - 1
        })
    });
    let corners = corners.collect();
    CornerAttribute { values, corners }
}

/// For each vertex how far to go so that its faces end up one metre outward, as nearly as one vector can; zero where there are no
/// faces with area.
pub fn vertex_normals(mesh: &PolygonMesh) -> Vec<DVec3> {
    let mesh = &*prepared(mesh);
    let half_edges = HalfEdges::new(mesh);
    let previous = previous_corners(&half_edges, mesh.corners.len());
    let normals = unit_normals(mesh);
    let mut sums = vec![(DVec3::ZERO, 0.0); mesh.positions.len()];
    for (corner, &before) in previous.iter().enumerate() {
        let normal = normals[half_edges.face(corner as u32) as usize];
        let [before, after] =
            [before, half_edges.next(corner as u32)].map(|corner| corner_place(mesh, corner as usize));
        let angle = corner_angle(before, corner_place(mesh, corner), after);
        if normal != DVec3::ZERO && angle.is_finite() {
            let (sum, weight) = &mut sums[mesh.corners[corner] as usize];
            *sum += normal * angle;
            *weight += angle;
        }
    }
    sums.into_iter().map(|(sum, weight)| even_outward(sum, weight)).collect()
}
