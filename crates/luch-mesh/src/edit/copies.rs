//! Meshes joined, and copies in rows and rings.

use glam::{DAffine3, DVec3, Vec2, Vec4};

use super::error::check_size;
use super::{EditError, flat_normals, prepared, rotation_about, transform};
use crate::PolygonMesh;
use crate::polygon_mesh::{CornerAttribute, Hole};

/// All faces of two meshes, the slots of the second shifted up.
///
/// What only one of them has is filled in for the other: flat normals, uv zero, white, slot and group 0.
pub fn append(first: &PolygonMesh, second: &PolygonMesh, slot_offset: u16) -> Result<PolygonMesh, EditError> {
    let (first, second) = (&*prepared(first), &*prepared(second));
    let (corners, shift) = (first.corners.len() as u32, first.positions.len() as u32);
    check_size(
        (first.face_count() + second.face_count()) as u64,
        (first.corners.len() + second.corners.len()) as u64,
    )?;
    let faces = first.face_count() as u32;
    let mut mesh = first.clone();
    mesh.positions.extend_from_slice(&second.positions);
    mesh.corners.extend(second.corners.iter().map(|vertex| vertex + shift));
    mesh.face_ends.extend(second.face_ends.iter().map(|end| end + corners));
    mesh.holes.extend(
        second.holes.iter().map(|hole| Hole { face: hole.face + faces, start: hole.start + corners }),
    );
    mesh.normals =
        joined(&first.normals, &second.normals, |of| flat_normals(if of { second } else { first }));
    let white = |of: bool| constant(if of { second } else { first }, Vec4::ONE);
    mesh.colors = joined(&first.colors, &second.colors, white);
    let origin = |of: bool| constant(if of { second } else { first }, Vec2::ZERO);
    let none = CornerAttribute::default();
    let sets = first.uv_sets.len().max(second.uv_sets.len());
    let sets = (0..sets).map(|set| {
        let [mine, theirs] = [first, second].map(|mesh| mesh.uv_sets.get(set).unwrap_or(&none));
        joined(mine, theirs, origin)
    });
    mesh.uv_sets = sets.collect();
    if !first.slots.is_empty() || !second.slots.is_empty() || slot_offset > 0 {
        mesh.slots.resize(first.face_count(), 0);
        let slot = |face: usize| second.slots.get(face).copied().unwrap_or(0u16).saturating_add(slot_offset);
        mesh.slots.extend((0..second.face_count()).map(slot));
    }
    if !first.smoothing_groups.is_empty() || !second.smoothing_groups.is_empty() {
        mesh.smoothing_groups.resize(first.face_count(), 0);
        let group = |face: usize| second.smoothing_groups.get(face).copied().unwrap_or(0);
        mesh.smoothing_groups.extend((0..second.face_count()).map(group));
    }
    mesh.creases.extend(second.creases.iter().map(|crease| {
        let mut crease = *crease;
        crease.vertices = crease.vertices.map(|vertex| vertex + shift);
        crease
    }));
    mesh.sharp_vertices.extend(second.sharp_vertices.iter().map(|sharp| {
        let mut sharp = *sharp;
        sharp.vertex += shift;
        sharp
    }));
    Ok(mesh)
}

fn constant<T: Copy>(mesh: &PolygonMesh, value: T) -> CornerAttribute<T> {
    CornerAttribute::indexed(vec![value], vec![0; mesh.corners.len()])
}

/// Both lists, with what `otherwise` gives for the one that is missing; nothing if both are.
fn joined<T: Copy>(
    first: &CornerAttribute<T>,
    second: &CornerAttribute<T>,
    otherwise: impl Fn(bool) -> CornerAttribute<T>,
) -> CornerAttribute<T> {
    if first.is_empty() && second.is_empty() {
        return CornerAttribute::default();
    }
    let filled = |attribute: &CornerAttribute<T>, of| {
        if attribute.is_empty() { otherwise(of) } else { attribute.clone() }
    };
    let (first, second) = (filled(first, false), filled(second, true));
    let shift = first.values.len() as u32;
    let corners = first.corners.iter().copied().chain(second.corners.iter().map(|number| number + shift));
    CornerAttribute::indexed([first.values.as_slice(), second.values.as_slice()].concat(), corners.collect())
}

/// `count` copies in a row, each moved by `step` metres from the one before; the first stays where it is.
pub fn array(mesh: &PolygonMesh, count: u32, step: DVec3) -> Result<PolygonMesh, EditError> {
    copies(mesh, count, |number| DAffine3::from_translation(step * f64::from(number)))
}

/// `count` copies around an axis through a centre, spread evenly over an angle in radians.
///
/// Over a full turn the last copy stands one step short of the first; over less, the last stands at the end.
pub fn radial_array(
    mesh: &PolygonMesh,
    count: u32,
    axis: DVec3,
    center: DVec3,
    angle: f64,
) -> Result<PolygonMesh, EditError> {
    let axis = axis.try_normalize().ok_or(EditError::NoDirection("axis"))?;
    let is_full = angle.abs() > std::f64::consts::TAU * (1.0 - 1e-9);
    let steps = if is_full { count } else { count.saturating_sub(1) }.max(1);
    copies(mesh, count, |number| rotation_about(center, axis, angle * f64::from(number) / f64::from(steps)))
}

fn copies(mesh: &PolygonMesh, count: u32, map: impl Fn(u32) -> DAffine3) -> Result<PolygonMesh, EditError> {
    let mesh = &*prepared(mesh);
    let total = |part: usize| part as u64 * u64::from(count);
    check_size(total(mesh.face_count()), total(mesh.corners.len().max(mesh.positions.len())))?;
    let all = vec![true; mesh.positions.len()];
    let mut parts: Vec<PolygonMesh> = (0..count).map(|number| transform(mesh, &all, &map(number))).collect();
    // In pairs, so that the time goes with the size and not with its square.
    while parts.len() > 1 {
        let pairs = parts.chunks(2).map(|pair| match pair {
            [one, other] => append(one, other, 0),
            _ => Ok(pair[0].clone()),
        });
        parts = pairs.collect::<Result<_, _>>()?;
    }
    Ok(parts.pop().unwrap_or_default())
}
