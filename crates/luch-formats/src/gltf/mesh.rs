//! Meshes: primitives become shapes, one for each set of attributes (nearly always one for the whole mesh).

use super::Import;
use super::json::Json;
use super::primitive::{Attributes, Layout, Primitive};
use super::vertices;
use crate::Problem;
use luch_mesh::{Attribute, TriangleMesh};
use luch_scene::{Id, Material, Shape};
use std::collections::BTreeMap;
use std::rc::Rc;

/// A shape of a mesh with the materials of its slots.
#[derive(Clone, Debug)]
pub(super) struct Part {
    pub(super) shape: Id<Shape>,
    pub(super) materials: Vec<Id<Material>>,
}

/// Primitives by their layout, in the order of the file.
#[derive(Default)]
struct Groups<'a> {
    list: Vec<Group<'a>>,
    by_layout: BTreeMap<Layout, usize>,
}

/// Primitives of one layout.
#[derive(Default)]
struct Group<'a> {
    uv_sets: u32,
    blocks: Vec<Block<'a>>,
    by_attributes: BTreeMap<Attributes, usize>,
    /// Materials of the document by slot.
    slots: Vec<Option<usize>>,
    by_material: BTreeMap<Option<usize>, u16>,
}

/// Triangles over the same vertices.
struct Block<'a> {
    attributes: Attributes,
    triangles: Vec<[u32; 3]>,
    triangle_slots: Vec<u16>,
    owner: Json<'a>,
}

impl<'a> Import<'a> {
    /// The shapes of a mesh, made when first asked for.
    pub(super) fn mesh(&mut self, index: usize) -> Result<Rc<Vec<Part>>, Problem> {
        if let Some(parts) = &self.meshes[index] {
            return Ok(Rc::clone(parts));
        }
        let json = self.document.meshes.at(index);
        let mut groups = Groups::default();
        let primitives = json.need("primitives")?;
        for primitive_json in primitives.as_list()?.iter() {
            let parsed =
                Primitive::parse(&self.document, &primitive_json, &mut self.budget, &mut self.notices)?;
            if let Some(primitive) = parsed {
                groups.add(primitive, primitive_json)?;
            }
        }
        let parts = groups.list.into_iter().map(|group| self.finish(group)).collect::<Result<Vec<_>, _>>()?;
        let parts = Rc::new(parts);
        self.meshes[index] = Some(Rc::clone(&parts));
        Ok(parts)
    }

    fn finish(&mut self, group: Group<'a>) -> Result<Part, Problem> {
        let mut whole = TriangleMesh::default();
        for block in group.blocks {
            let Block { attributes, triangles, triangle_slots, owner } = block;
            let (budget, notices) = (&mut self.budget, &mut self.notices);
            let mesh = vertices::build(&self.document, &attributes, triangles, &owner, budget, notices)?;
            if group.slots.len() > 1 {
                whole.slots.extend(triangle_slots);
            }
            append(&mut whole, mesh)
                .map_err(|()| owner.problem("makes a mesh of more than 2^32 - 1 vertices"))?;
        }
        let sets = group.uv_sets;
        let materials = group.slots.into_iter().map(|material| self.material(material, sets));
        let materials = materials.collect::<Result<_, _>>()?;
        Ok(Part { shape: self.scene.add_shape(Shape::Mesh(whole)), materials })
    }
}

impl<'a> Groups<'a> {
    /// Puts a primitive with those of its layout and, if it shares their vertices, into their block.
    fn add(&mut self, primitive: Primitive, owner: Json<'a>) -> Result<(), Problem> {
        let Primitive { attributes, triangles, material } = primitive;
        let layout = attributes.layout();
        let place = *self.by_layout.entry(layout).or_insert_with(|| {
            self.list.push(Group { uv_sets: layout.uv_sets, ..Group::default() });
            self.list.len() - 1
        });
        let group = &mut self.list[place];
        let slot = match group.by_material.get(&material) {
            Some(&slot) => slot,
            None => {
                let slot = u16::try_from(group.slots.len())
                    .map_err(|_| owner.problem("is of the 65537th material of its mesh; 65536 are read"))?;
                group.slots.push(material);
                group.by_material.insert(material, slot);
                slot
            }
        };
        let slots = std::iter::repeat_n(slot, triangles.len());
        if let Some(&block) = group.by_attributes.get(&attributes) {
            group.blocks[block].triangle_slots.extend(slots);
            group.blocks[block].triangles.extend(triangles);
        } else {
            group.by_attributes.insert(attributes.clone(), group.blocks.len());
            group.blocks.push(Block { attributes, triangles, triangle_slots: slots.collect(), owner });
        }
        Ok(())
    }
}

/// Joins meshes of the same layout.
fn append(whole: &mut TriangleMesh, part: TriangleMesh) -> Result<(), ()> {
    if whole.positions.is_empty() {
        *whole = TriangleMesh { slots: std::mem::take(&mut whole.slots), ..part };
        return Ok(());
    }
    let first = u32::try_from(whole.positions.len()).map_err(|_| ())?;
    u32::try_from(whole.positions.len() + part.positions.len()).map_err(|_| ())?;
    whole.positions.extend(part.positions);
    whole.triangles.extend(part.triangles.into_iter().map(|triangle| triangle.map(|corner| corner + first)));
    whole.normals.values.extend(part.normals.values);
    for (set, more) in whole.uv_sets.iter_mut().zip(part.uv_sets) {
        set.values.extend(more.values);
    }
    // Tangents without length were dropped in one of the two: then the joined mesh has none.
    if whole.tangents.is_empty() || part.tangents.is_empty() {
        whole.tangents = Attribute::default();
    } else {
        whole.tangents.values.extend(part.tangents.values);
    }
    whole.colors.values.extend(part.colors.values);
    Ok(())
}
