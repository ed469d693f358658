//! One model part: its objects, as XML has them.

use std::collections::BTreeMap;

use glam::{DAffine3, DMat3, DVec3};
use roxmltree::{Document, Node, ParsingOptions};

use super::LengthUnit;
use crate::codec::error::{DecodeError, ErrorKind, Place, quote};

/// The most elements and texts of a part.
const MOST_NODES: u32 = 1 << 25;

/// What a model part holds.
pub(super) struct Model {
    pub(super) unit: LengthUnit,
    pub(super) objects: BTreeMap<u32, Object>,
    pub(super) build: Vec<Reference>,
    /// The names of each group of base materials.
    pub(super) materials: BTreeMap<u32, Vec<String>>,
    /// Properties that are no base materials are there.
    pub(super) has_other_properties: bool,
}

#[derive(Default)]
pub(super) struct Object {
    pub(super) vertices: Vec<DVec3>,
    pub(super) triangles: Vec<[u32; 3]>,
    /// For each triangle group and place of its material; empty if none has any.
    pub(super) materials: Vec<Option<[u32; 2]>>,
    pub(super) components: Vec<Reference>,
}

/// An object put somewhere.
pub(super) struct Reference {
    /// The part it is in, if another.
    pub(super) part: Option<String>,
    pub(super) object: u32,
    pub(super) placement: DAffine3,
}

impl Model {
    pub(super) fn parse(part: &str, bytes: &[u8]) -> Result<Self, DecodeError> {
        let fail = |place: Place, found: String, expected: &str| {
            Err(DecodeError::new(ErrorKind::Syntax, place, format!("in {part} {found}"), expected))
        };
        let text = match std::str::from_utf8(bytes) {
            Ok(text) => text.trim_start_matches('\u{feff}'),
            Err(error) => {
                return fail(
                    Place::Byte { offset: error.valid_up_to() as u64 },
                    "other bytes".into(),
                    "text in UTF-8",
                );
            }
        };
        let options = ParsingOptions { nodes_limit: MOST_NODES, ..ParsingOptions::default() };
        let document = match Document::parse_with_options(text, options) {
            Ok(document) => document,
            Err(error) => {
                let at = error.pos();
                let place = Place::Text { line: at.row.into(), column: at.col.into() };
                return fail(place, error.to_string(), "XML");
            }
        };
        let reader = Reader { part, document: &document };
        let root = document.root_element();
        if root.tag_name().name() != "model" {
            return Err(reader.error(root, &quote(root.tag_name().name().as_bytes()), "the element model"));
        }
        let unit = match root.attribute("unit") {
            None => LengthUnit::Millimeter,
            Some(name) => LengthUnit::from_name(name).ok_or_else(|| {
                reader.error(
                    root,
                    &quote(name.as_bytes()),
                    "micron, millimeter, centimeter, inch, foot or meter",
                )
            })?,
        };
        let mut model = Self {
            unit,
            objects: BTreeMap::new(),
            build: Vec::new(),
            materials: BTreeMap::new(),
            has_other_properties: false,
        };
        for node in children(root, "resources").flat_map(|resources| resources.children()) {
            match node.tag_name().name() {
                "object" => {
                    let object = reader.object(node)?;
                    model.objects.insert(reader.number(node, "id")?, object);
                }
                "basematerials" => {
                    let names =
                        children(node, "base").map(|base| base.attribute("name").unwrap_or("").to_owned());
                    model.materials.insert(reader.number(node, "id")?, names.collect());
                }
                "colorgroup" | "texture2d" | "texture2dgroup" | "compositematerials" | "multiproperties" => {
                    model.has_other_properties = true;
                }
                _ => {}
            }
        }
        for item in children(root, "build").flat_map(|build| children(build, "item")) {
            model.build.push(reader.reference(item)?);
        }
        Ok(model)
    }
}

fn children<'a>(node: Node<'a, 'a>, name: &'static str) -> impl Iterator<Item = Node<'a, 'a>> {
    node.children().filter(move |child| child.tag_name().name() == name)
}

struct Reader<'a> {
    part: &'a str,
    document: &'a Document<'a>,
}

impl<'a> Reader<'a> {
    fn object(&self, node: Node<'a, 'a>) -> Result<Object, DecodeError> {
        let mut object = Object::default();
        let own = self.material(node, "pid", "pindex", None)?;
        for mesh in children(node, "mesh") {
            for vertex in children(mesh, "vertices").flat_map(|list| children(list, "vertex")) {
                let mut numbers = [0.0; 3];
                for (number, name) in numbers.iter_mut().zip(["x", "y", "z"]) {
                    *number = self.float(vertex, name)?;
                }
                object.vertices.push(DVec3::from(numbers));
            }
            let mut any_material = false;
            for triangle in children(mesh, "triangles").flat_map(|list| children(list, "triangle")) {
                let mut corners = [0; 3];
                for (corner, name) in corners.iter_mut().zip(["v1", "v2", "v3"]) {
                    *corner = self.number(triangle, name)?;
                    if *corner as usize >= object.vertices.len() {
                        let expected =
                            format!("the number of one of {} vertices, from 0", object.vertices.len());
                        let mut error =
                            self.error(triangle, &quote(corner.to_string().as_bytes()), &expected);
                        error.kind = ErrorKind::IndexOutOfRange;
                        return Err(error);
                    }
                }
                let material = self.material(triangle, "pid", "p1", own)?;
                any_material |= material.is_some();
                object.triangles.push(corners);
                object.materials.push(material);
            }
            if !any_material {
                object.materials.clear();
            }
        }
        for component in children(node, "components").flat_map(|list| children(list, "component")) {
            object.components.push(self.reference(component)?);
        }
        Ok(object)
    }

    /// Group and place of a material; what is not said is that of the object.
    fn material(
        &self,
        node: Node<'a, 'a>,
        group: &str,
        place: &str,
        of_object: Option<[u32; 2]>,
    ) -> Result<Option<[u32; 2]>, DecodeError> {
        let number = |name| node.attribute(name).map(|_| self.number(node, name)).transpose();
        Ok(match (number(group)?, number(place)?, of_object) {
            (Some(group), place, _) => Some([group, place.unwrap_or(0)]),
            (None, Some(place), Some([group, _])) => Some([group, place]),
            (None, _, of_object) => of_object,
        })
    }

    fn reference(&self, node: Node<'a, 'a>) -> Result<Reference, DecodeError> {
        let part = node.attributes().find(|attribute| attribute.name() == "path");
        let part = part.map(|path| path.value().trim_start_matches('/').to_owned());
        let mut placement = DAffine3::IDENTITY;
        if let Some(text) = node.attribute("transform") {
            // Four rows of three: the images of the axes, then the shift.
            let numbers: Vec<f64> =
                text.split_ascii_whitespace().filter_map(|word| word.parse().ok()).collect();
            let Ok(numbers) = <[f64; 12]>::try_from(numbers) else {
                return Err(self.error(node, &quote(text.as_bytes()), "twelve numbers in transform"));
            };
            let row = |k: usize| DVec3::new(numbers[3 * k], numbers[3 * k + 1], numbers[3 * k + 2]);
            placement = DAffine3::from_mat3_translation(DMat3::from_cols(row(0), row(1), row(2)), row(3));
        }
        Ok(Reference { part, object: self.number(node, "objectid")?, placement })
    }

    fn number(&self, node: Node<'a, 'a>, name: &str) -> Result<u32, DecodeError> {
        let text = node.attribute(name).unwrap_or("").trim();
        text.parse().map_err(|_| {
            let found = if text.is_empty() { "nothing".to_owned() } else { quote(text.as_bytes()) };
            self.error(node, &found, &format!("a whole number in {name}"))
        })
    }

    fn float(&self, node: Node<'a, 'a>, name: &str) -> Result<f64, DecodeError> {
        let text = node.attribute(name).unwrap_or("").trim();
        text.parse().ok().filter(|number: &f64| number.is_finite()).ok_or_else(|| {
            let found = if text.is_empty() { "nothing".to_owned() } else { quote(text.as_bytes()) };
            self.error(node, &found, &format!("a number in {name}"))
        })
    }

    fn error(&self, node: Node, found: &str, expected: &str) -> DecodeError {
        let at = self.document.text_pos_at(node.range().start);
        let place = Place::Text { line: at.row.into(), column: at.col.into() };
        DecodeError::new(ErrorKind::Syntax, place, format!("in {} {found}", self.part), expected)
    }
}
