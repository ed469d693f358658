//! One primitive of a mesh: which accessors it takes, and its triangles.

use super::accessor::{Accessor, Component, Form};
use super::budget::Budget;
use super::document::Document;
use super::json::{Json, short};
use super::notices::Notices;
use crate::Problem;

/// Most uv sets that are read.
pub(super) const MOST_UV_SETS: usize = 16;

const VECTOR_2: Form = Form::vector(2);
const VECTOR_3: Form = Form::vector(3);
const VECTOR_4: Form = Form::vector(4);

/// An accessor by its place in the document's list.
pub(super) type AccessorIndex = usize;

/// The accessors of the vertices. Primitives that agree in all of them share their vertices.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Attributes {
    pub(super) positions: AccessorIndex,
    pub(super) normals: Option<AccessorIndex>,
    pub(super) tangents: Option<AccessorIndex>,
    pub(super) colors: Option<AccessorIndex>,
    pub(super) uv_sets: [Option<AccessorIndex>; MOST_UV_SETS],
}

impl Attributes {
    /// Which attributes there are; meshes of one layout can be joined.
    pub(super) fn layout(&self) -> Layout {
        Layout {
            normals: self.normals.is_some(),
            tangents: self.tangents.is_some(),
            colors: self.colors.is_some(),
            uv_sets: (0..MOST_UV_SETS)
                .filter(|&set| self.uv_sets[set].is_some())
                .fold(0, |sets, set| sets | 1 << set),
        }
    }

    /// Reads the "attributes" of a primitive; `None` without positions.
    fn parse(document: &Document, json: &Json, notices: &mut Notices) -> Result<Option<Self>, Problem> {
        let index = |json: &Json, forms: &[Form]| {
            let (accessor, _) = document.accessor(json, forms)?;
            if accessor.component == Component::U32 {
                return Err(
                    json.problem("refers to an accessor of component type 5125, which no attribute may have")
                );
            }
            json.reference(&document.accessor_list)
        };
        let (mut positions, mut normals, mut tangents, mut colors) = (None, None, None, None);
        let mut uv_sets = [None; MOST_UV_SETS];
        for (name, json) in json.entries()? {
            let set =
                |prefix: &str| name.strip_prefix(prefix).and_then(|number| number.parse::<usize>().ok());
            match name {
                "POSITION" => positions = Some(index(&json, &[VECTOR_3])?),
                "NORMAL" => normals = Some(index(&json, &[VECTOR_3])?),
                "TANGENT" => tangents = Some(index(&json, &[VECTOR_4])?),
                "COLOR_0" => colors = Some(index(&json, &[VECTOR_3, VECTOR_4])?),
                // Weights of skins are told where the skin is used; further colours have no meaning in the core format.
                _ if ["JOINTS_", "WEIGHTS_", "COLOR_", "_"].iter().any(|prefix| name.starts_with(prefix)) => {
                }
                _ => match set("TEXCOORD_") {
                    Some(set) if set < MOST_UV_SETS => uv_sets[set] = Some(index(&json, &[VECTOR_2])?),
                    _ => notices.add(json.path(), format!("the attribute \"{}\" is not read", short(name))),
                },
            }
        }
        // Without normals tangents mean nothing (section 3.7.2.1).
        let tangents = tangents.filter(|_| normals.is_some());
        Ok(positions.map(|positions| Self { positions, normals, tangents, colors, uv_sets }))
    }
}

/// Which attributes vertices have; bit n of `uv_sets` stands for set n.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Layout {
    pub(super) normals: bool,
    pub(super) tangents: bool,
    pub(super) colors: bool,
    pub(super) uv_sets: u32,
}

/// A primitive whose triangles refer to existing vertices.
#[derive(Debug)]
pub(super) struct Primitive {
    pub(super) attributes: Attributes,
    pub(super) triangles: Vec<[u32; 3]>,
    pub(super) material: Option<usize>,
}

impl Primitive {
    /// Reads a primitive; `None` if it has no triangles.
    pub(super) fn parse(
        document: &Document,
        json: &Json,
        budget: &mut Budget,
        notices: &mut Notices,
    ) -> Result<Option<Self>, Problem> {
        let mode = json.get("mode")?.map_or(Ok(4), |mode| mode.whole())?;
        let material =
            json.get("material")?.map(|material| material.reference(&document.materials)).transpose()?;
        if let Some(targets) = json.get("targets")? {
            targets.as_list()?;
            notices.add(targets.path(), "morph targets are not applied: the mesh is in its rest pose");
        }
        match mode {
            0 => notices.add(json.path(), "points are left out; only triangles are rendered"),
            1..=3 => notices.add(json.path(), "lines are left out; only triangles are rendered"),
            4..=6 => {}
            _ => return Err(json.need("mode")?.problem(format!("is {mode}, expected 0 to 6"))),
        }
        let Some(attributes) = Attributes::parse(document, &json.need("attributes")?, notices)? else {
            notices.add(json.path(), "a primitive without positions is left out");
            return Ok(None);
        };
        if mode < 4 {
            return Ok(None);
        }
        let count = vertex_count(document, json, &attributes)?;
        let corners = read_corners(document, json, count, budget)?;
        if mode == 4 && corners.len() % 3 != 0 {
            let message =
                format!("{} corners are no whole number of triangles; the last are left out", corners.len());
            notices.add(json.path(), message);
        }
        budget.take(triangle_count(mode, corners.len()), size_of::<[u32; 3]>(), json)?;
        let triangles = assemble(mode, &corners);
        Ok((!triangles.is_empty()).then_some(Self { attributes, triangles, material }))
    }
}

/// The number of vertices, on which all attributes must agree.
fn vertex_count(document: &Document, json: &Json, attributes: &Attributes) -> Result<usize, Problem> {
    let positions = document.accessors[attributes.positions];
    if !positions.has_bytes() && json.extension("KHR_draco_mesh_compression")?.is_some() {
        let message = "the geometry is stored by KHR_draco_mesh_compression only, which is not decoded";
        return Err(json.problem(message).help("save the file without mesh compression"));
    }
    let single = [Some(attributes.positions), attributes.normals, attributes.tangents, attributes.colors];
    for index in single.into_iter().chain(attributes.uv_sets).flatten() {
        let Accessor { count, .. } = document.accessors[index];
        if count != positions.count {
            return Err(json.need("attributes")?.problem(format!(
                "/accessors/{} has {} elements, /accessors/{index} has {count}; all attributes must have the same number",
                attributes.positions, positions.count
            )));
        }
    }
    u32::try_from(positions.count)
        .map_err(|_| json.problem(format!("has {} vertices, at most 2^32 - 1 are read", positions.count)))?;
    Ok(positions.count)
}

/// The vertices in drawing order, each below `count`.
fn read_corners(
    document: &Document,
    json: &Json,
    count: usize,
    budget: &mut Budget,
) -> Result<Vec<u32>, Problem> {
    let Some(indices) = json.get("indices")? else {
        budget.take(count, size_of::<u32>(), json)?;
        return Ok((0..count as u32).collect());
    };
    let (accessor, place) = document.accessor(&indices, &[Form::vector(1)])?;
    if !matches!(accessor.component, Component::U8 | Component::U16 | Component::U32) {
        return Err(place.problem("is used for indices, which have component type 5121, 5123 or 5125"));
    }
    budget.take(accessor.count, size_of::<u32>(), json)?;
    let reader = accessor.reader(&document.buffers, &place)?;
    let mut corners = Vec::with_capacity(accessor.count);
    for element in 0..accessor.count {
        let index = reader.index(element);
        if index as usize >= count {
            let message = format!("element {element} is {index}, but {} has {count} vertices", json.path());
            return Err(place.problem(message));
        }
        corners.push(index);
    }
    Ok(corners)
}

fn triangle_count(mode: u64, corners: usize) -> usize {
    if mode == 4 { corners / 3 } else { corners.saturating_sub(2) }
}

/// Triangles, strips and fans (section 3.7.2.1); strips and fans repeat corners to jump, such triangles are dropped.
fn assemble(mode: u64, corners: &[u32]) -> Vec<[u32; 3]> {
    let is_whole = |[a, b, c]: &[u32; 3]| a != b && b != c && c != a;
    match mode {
        4 => corners.chunks_exact(3).map(|c| [c[0], c[1], c[2]]).collect(),
        5 => {
            let turned = |(place, c): (usize, &[u32])| {
                if place % 2 == 0 { [c[0], c[1], c[2]] } else { [c[0], c[2], c[1]] }
            };
            corners.windows(3).enumerate().map(turned).filter(is_whole).collect()
        }
        _ => match corners.split_first() {
            Some((&hub, rim)) => rim.windows(2).map(|c| [c[0], c[1], hub]).filter(is_whole).collect(),
            None => Vec::new(),
        },
    }
}

#[cfg(test)]
mod tests {
    use super::assemble;

    #[test]
    fn modes_keep_the_winding() {
        // Glossary of primitives in the specification, section 3.7.2.1.
        assert_eq!(assemble(4, &[0, 1, 2, 3, 4, 5, 6]), [[0, 1, 2], [3, 4, 5]]);
        assert_eq!(assemble(5, &[0, 1, 2, 3, 4]), [[0, 1, 2], [1, 3, 2], [2, 3, 4]]);
        assert_eq!(assemble(6, &[0, 1, 2, 3]), [[1, 2, 0], [2, 3, 0]]);
        assert_eq!(assemble(5, &[0, 1, 2, 2, 4, 4, 5, 6]).len(), 2);
        for mode in 4..=6 {
            assert!(assemble(mode, &[0, 1]).is_empty());
            assert!(assemble(mode, &[]).is_empty());
        }
    }
}
