//! The vertices of a mesh: only those that triangles use, in the order of the file.

use super::accessor::Form;
use super::budget::Budget;
use super::document::Document;
use super::json::Json;
use super::notices::Notices;
use super::primitive::{Attributes, MOST_UV_SETS};
use crate::Problem;
use glam::{Vec2, Vec3, Vec4};
use luch_mesh::normals::{Weight, smooth};
use luch_mesh::{Attribute, TriangleMesh};

/// Bytes of a vertex with every attribute of the core format.
const VERTEX_SIZE: usize = 64;

/// Renumbers `triangles` so that every vertex below the largest is used; the old numbers of the new vertices.
fn compact(triangles: &mut [[u32; 3]], count: usize) -> Vec<u32> {
    let mut used: Vec<u32> = triangles.as_flattened().to_vec();
    used.sort_unstable();
    used.dedup();
    if used.len() < count {
        for corner in triangles.as_flattened_mut() {
            *corner = used.partition_point(|&old| old < *corner) as u32;
        }
    }
    used
}

/// A mesh of `triangles` over the vertices of `attributes`; `owner` is the primitive that named them first.
pub(super) fn build(
    document: &Document,
    attributes: &Attributes,
    mut triangles: Vec<[u32; 3]>,
    owner: &Json,
    budget: &mut Budget,
    notices: &mut Notices,
) -> Result<TriangleMesh, Problem> {
    let used = compact(&mut triangles, document.accessors[attributes.positions].count);
    budget.take(used.len(), VERTEX_SIZE, owner)?;
    let source = Source { document, used: &used };
    let mut mesh = TriangleMesh::new(source.read(attributes.positions, Vec3::from_array)?, triangles);
    let last_set = (0..MOST_UV_SETS).rev().find(|&set| attributes.uv_sets[set].is_some());
    for accessor in &attributes.uv_sets[..last_set.map_or(0, |set| set + 1)] {
        // glTF's v runs down from the upper edge, ours up from the lower one.
        let flip = |[u, v]: [f32; 2]| Vec2::new(u, 1.0 - v);
        mesh.uv_sets.push(match accessor {
            Some(accessor) => Attribute::per_position(source.read(*accessor, flip)?),
            None => Attribute::default(),
        });
    }
    if let Some(accessor) = attributes.colors {
        let has_alpha = document.accessors[accessor].form == Form::vector(4);
        let color = |[r, g, b, a]: [f32; 4]| {
            // The specification clamps vertex colours (section 3.7.2.1).
            Vec4::new(r, g, b, if has_alpha { a } else { 1.0 }).clamp(Vec4::ZERO, Vec4::ONE)
        };
        mesh.colors = Attribute::per_position(source.read(accessor, color)?);
    }
    if let Some(accessor) = attributes.normals {
        let normals = source.read(accessor, |n| unit(Vec3::from_array(n)))?;
        let place = document.accessor_list.at(accessor);
        mesh.normals = Attribute::per_position(whole_normals(&mesh, normals, place.path(), notices));
    }
    if let Some(accessor) = attributes.tangents {
        let tangents = source.read(accessor, |[x, y, z, w]: [f32; 4]| {
            unit(Vec3::new(x, y, z)).map(|unit| unit.extend(if w < 0.0 { -1.0 } else { 1.0 }))
        })?;
        match tangents.into_iter().collect::<Option<Vec<Vec4>>>() {
            Some(tangents) => mesh.tangents = Attribute::per_position(tangents),
            None => {
                let place = document.accessor_list.at(accessor);
                notices.add(place.path(), "tangents of length 0; they are derived from uv set 0 instead");
            }
        }
    }
    Ok(mesh)
}

/// Vectors shorter than 10^-20 have no direction in single precision.
fn unit(vector: Vec3) -> Option<Vec3> {
    let wide = vector.as_dvec3();
    let length = wide.length();
    (length > 1e-20).then(|| (wide / length).as_vec3())
}

/// The file's normals; where one has no length, the mean of those of the triangles about it.
fn whole_normals(
    mesh: &TriangleMesh,
    normals: Vec<Option<Vec3>>,
    path: &str,
    notices: &mut Notices,
) -> Vec<Vec3> {
    if normals.iter().all(Option::is_some) {
        return normals.into_iter().flatten().collect();
    }
    notices.add(path, "normals of length 0; the mean of the triangles about them takes their place");
    let means = smooth(mesh, Weight::Angle).values;
    normals.into_iter().zip(means).map(|(normal, mean)| normal.unwrap_or(mean)).collect()
}

struct Source<'d> {
    document: &'d Document<'d>,
    used: &'d [u32],
}

impl Source<'_> {
    /// The used elements of an accessor, which must be finite.
    fn read<const N: usize, T>(
        &self,
        accessor: usize,
        make: impl Fn([f32; N]) -> T,
    ) -> Result<Vec<T>, Problem> {
        let place = self.document.accessor_list.at(accessor);
        let reader = self.document.accessors[accessor].reader(&self.document.buffers, &place)?;
        let element = |&index: &u32| {
            let numbers: [f32; N] = reader.numbers(index as usize);
            if numbers.iter().all(|number| number.is_finite()) {
                Ok(make(numbers))
            } else {
                Err(place.problem(format!("element {index} is {numbers:?}, which is not finite")))
            }
        };
        self.used.iter().map(element).collect()
    }
}
