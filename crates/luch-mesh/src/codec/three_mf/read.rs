//! The reader: from the packet to one mesh.

use std::collections::BTreeMap;

use glam::{DAffine3, DVec3};

use super::ThreeMfFile;
use super::model::{Model, Reference};
use super::packet::Packet;
use crate::PolygonMesh;
use crate::codec::error::{DecodeError, ErrorKind, Place, Warnings};

/// Components within components.
const DEEPEST: usize = 32;
/// Triangles and vertices of everything that is built, copies included, for each byte of the file, and for any file.
const MOST_COPIED: [usize; 2] = [64, 1 << 20];

/// Reads a 3MF file: everything that is to be built, as one mesh. A file without a build gives all its objects.
///
/// Errors: a packet that is damaged, XML that is not what it should be, references that lead nowhere or in circles.
/// Warnings: colours and textures (skipped), triangles with two equal corners (left out).
pub fn decode(bytes: &[u8]) -> Result<ThreeMfFile, DecodeError> {
    let packet = Packet::open(bytes)?;
    let mut models = BTreeMap::new();
    let names: Vec<&str> =
        packet.names().filter(|name| name.to_ascii_lowercase().ends_with(".model")).collect();
    for &name in &names {
        let content = packet.part(name)?.unwrap_or_default();
        models.insert(name.to_owned(), Model::parse(name, &content)?);
    }
    let start = start_part(&packet)?.filter(|start| models.contains_key(start));
    let start = start.or_else(|| {
        names.iter().find(|name| name.eq_ignore_ascii_case("3D/3dmodel.model")).map(|n| (*n).to_owned())
    });
    let start = start.or_else(|| names.first().map(|name| (*name).to_owned())).ok_or_else(|| {
        let place = Place::Byte { offset: bytes.len() as u64 };
        DecodeError::new(ErrorKind::Syntax, place, "a ZIP file without a model", "a part “3D/3dmodel.model”")
    })?;
    let model = &models[&start];
    let whole = |&object: &u32| Reference { part: None, object, placement: DAffine3::IDENTITY };
    let everything: Vec<Reference> = model.objects.keys().map(whole).collect();
    let most = bytes.len().saturating_mul(MOST_COPIED[0]).saturating_add(MOST_COPIED[1]);
    let mut builder = Builder {
        models: &models,
        mesh: PolygonMesh::default(),
        slots: BTreeMap::new(),
        names: Vec::new(),
        left: most,
        visits_left: MOST_COPIED[1],
        collapsed: 0,
        not_finite: 0,
    };
    let scale = DAffine3::from_scale(DVec3::splat(model.unit.meters()));
    for item in if model.build.is_empty() { &everything } else { &model.build } {
        builder.add(&start, item, scale, 0)?;
    }
    let mut warnings = Warnings::default();
    if models.values().any(|model| model.has_other_properties) {
        warnings.add(None, "colours and textures are skipped");
    }
    if builder.collapsed > 0 {
        warnings.add(None, &format!("{} triangles with two equal corners are left out", builder.collapsed));
    }
    if builder.not_finite > 0 {
        warnings.add(
            None,
            &format!("{} triangles with a corner that is not finite are left out", builder.not_finite),
        );
    }
    if builder.mesh.face_ends.is_empty() {
        warnings.add(None, "the file has no triangles");
    }
    if builder.names.len() <= 1 {
        builder.mesh.slots.clear();
    }
    Ok(ThreeMfFile { mesh: builder.mesh, materials: builder.names, warnings: warnings.into_list() })
}

/// The part that the packet's relations name as its model.
fn start_part(packet: &Packet) -> Result<Option<String>, DecodeError> {
    let Some(content) = packet.part("_rels/.rels")? else { return Ok(None) };
    let text = String::from_utf8_lossy(&content);
    let Ok(document) = roxmltree::Document::parse(text.trim_start_matches('\u{feff}')) else {
        return Ok(None);
    };
    let is_model =
        |node: &roxmltree::Node| node.attribute("Type").is_some_and(|kind| kind.ends_with("/3dmodel"));
    let target = document.descendants().find(is_model).and_then(|node| node.attribute("Target"));
    Ok(target.map(|target| target.trim_start_matches('/').to_owned()))
}

struct Builder<'a> {
    models: &'a BTreeMap<String, Model>,
    mesh: PolygonMesh,
    /// The slot of each material: part, group, place; or of none.
    slots: BTreeMap<Option<(&'a str, [u32; 2])>, u16>,
    names: Vec<String>,
    left: usize,
    visits_left: usize,
    collapsed: usize,
    not_finite: usize,
}

impl<'a> Builder<'a> {
    fn add(
        &mut self,
        part: &'a str,
        reference: &'a Reference,
        outer: DAffine3,
        depth: usize,
    ) -> Result<(), DecodeError> {
        let part = reference.part.as_deref().unwrap_or(part);
        let wrong = |kind, found: String, expected| {
            Err(DecodeError::new(kind, Place::Byte { offset: 0 }, format!("in {part} {found}"), expected))
        };
        let found = self.models.get(part).and_then(|model| model.objects.get(&reference.object));
        let Some(object) = found else {
            return wrong(
                ErrorKind::IndexOutOfRange,
                format!("object {}", reference.object),
                "an object that exists",
            );
        };
        if depth > DEEPEST {
            return wrong(
                ErrorKind::Syntax,
                "components within components".into(),
                "at most 32 levels, and no circles",
            );
        }
        let size = object.vertices.len() + object.triangles.len();
        if size > self.left || self.visits_left == 0 {
            return wrong(
                ErrorKind::TooLarge,
                "too many copies of objects".into(),
                "copies in proportion to the file",
            );
        }
        self.left -= size;
        self.visits_left -= 1;
        let placement = outer * reference.placement;
        let is_mirrored = placement.matrix3.determinant() < 0.0;
        let first = self.mesh.positions.len() as u32;
        self.mesh
            .positions
            .extend(object.vertices.iter().map(|vertex| placement.transform_point3(*vertex).as_vec3()));
        let mut is_broken = false;
        for position in &mut self.mesh.positions[first as usize..] {
            is_broken |= !position.is_finite();
        }
        for (t, &corners) in object.triangles.iter().enumerate() {
            let [a, b, c] = corners.map(|corner| corner + first);
            if a == b || b == c || c == a {
                self.collapsed += 1;
                continue;
            }
            if is_broken && ![a, b, c].iter().all(|&i| self.mesh.positions[i as usize].is_finite()) {
                self.not_finite += 1;
                continue;
            }
            let corners = if is_mirrored { [a, c, b] } else { [a, b, c] };
            self.mesh.add_face(&corners);
            let material = object.materials.get(t).copied().flatten();
            let slot = self.slot(part, material)?;
            self.mesh.slots.push(slot);
        }
        if is_broken {
            let new = self.mesh.positions[first as usize..].iter_mut();
            new.filter(|p| !p.is_finite()).for_each(|p| *p = glam::Vec3::ZERO);
        }
        for component in &object.components {
            self.add(part, component, placement, depth + 1)?;
        }
        Ok(())
    }

    /// The slot of a base material. Those of one group are numbered at once, in their order.
    fn slot(&mut self, part: &'a str, material: Option<[u32; 2]>) -> Result<u16, DecodeError> {
        let materials = &self.models[part].materials;
        // Properties of other kinds are no materials.
        let material = material.filter(|[group, place]| {
            materials.get(group).is_some_and(|names| (*place as usize) < names.len())
        });
        let key = material.map(|material| (part, material));
        if let Some(&slot) = self.slots.get(&key) {
            return Ok(slot);
        }
        match material {
            None => self.add_slot(None, "")?,
            Some([group, _]) => {
                for (place, name) in materials[&group].iter().enumerate() {
                    self.add_slot(Some((part, [group, place as u32])), name)?;
                }
            }
        }
        Ok(self.slots[&key])
    }

    fn add_slot(&mut self, key: Option<(&'a str, [u32; 2])>, name: &str) -> Result<(), DecodeError> {
        let slot = u16::try_from(self.names.len()).map_err(|_| {
            let place = Place::Byte { offset: 0 };
            DecodeError::new(ErrorKind::TooLarge, place, "more than 65536 materials", "fewer")
        })?;
        self.slots.insert(key, slot);
        self.names.push(name.to_owned());
        Ok(())
    }
}
