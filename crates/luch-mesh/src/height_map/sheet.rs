//! A sheet with a vertex for every point.

use glam::Vec2;

use super::HeightField;
use crate::{Attribute, TriangleMesh};

/// Two triangles for each cell, with normals from height differences; uv 0 to 1 over the image, origin at its lower left.
///
/// Holes get no vertices; the triangles at them are missing. The field must be sound ([`HeightField::check`]); for one that
/// is not, the sheet is empty.
pub fn sheet(field: &HeightField) -> TriangleMesh {
    if field.check().is_err() {
        return TriangleMesh::default();
    }
    let triangles = (0..field.height - 1).flat_map(|row| {
        (0..field.width - 1).flat_map(move |column| {
            let [left, right] = [column, column + 1];
            // Lower left, lower right, upper right, upper left.
            let [a, b, c, d] = [(left, row + 1), (right, row + 1), (right, row), (left, row)]
                .map(|(c, r)| field.index(c, r) as u32);
            [[a, b, c], [a, c, d]]
        })
    });
    let whole = triangles.filter(|corners| corners.iter().all(|&p| field.heights[p as usize].is_finite()));
    over_points(field, whole.collect())
}

/// The mesh of triangles over points of the field, which are numbered row by row; points that are not used are left out.
pub(super) fn over_points(field: &HeightField, mut triangles: Vec<[u32; 3]>) -> TriangleMesh {
    const UNUSED: u32 = u32::MAX;
    let mut number_of = vec![UNUSED; field.heights.len()];
    triangles.iter().flatten().for_each(|&point| number_of[point as usize] = 0);
    let (mut positions, mut normals, mut uvs) = (Vec::new(), Vec::new(), Vec::new());
    let last = Vec2::new((field.width - 1) as f32, (field.height - 1) as f32);
    for row in 0..field.height {
        for column in 0..field.width {
            let number = &mut number_of[field.index(column, row)];
            if *number == UNUSED {
                continue;
            }
            *number = positions.len() as u32;
            positions.push(field.place(column, row));
            normals.push(field.normal(column, row));
            let place = Vec2::new(column as f32, row as f32) / last;
            uvs.push(Vec2::new(place.x, 1.0 - place.y));
        }
    }
    for corner in triangles.as_flattened_mut() {
        *corner = number_of[*corner as usize];
    }
    TriangleMesh {
        positions,
        triangles,
        normals: Attribute::per_position(normals),
        uv_sets: vec![Attribute::per_position(uvs)],
        ..TriangleMesh::default()
    }
}
