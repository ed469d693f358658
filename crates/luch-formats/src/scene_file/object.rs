//! What stands in the world: `object`, `group`, `import`, and lamps.

use super::decoder::Decoder;
use super::fields::{Field, Fields};
use super::transform::is_invertible;
use super::value::Range;
use super::{ImportSource, ObjectSource, ShapeSource, Spanned};
use glam::Affine3A;

/// What may stand in a group.
const MEMBERS: [&str; 6] = ["object", "group", "point-light", "spot-light", "sun", "import"];

/// What an object may be made of.
const SHAPES: [&str; 4] = ["mesh", "sphere", "disc", "plane"];

impl Decoder<'_> {
    /// A member of the world or of a group; `outer` places the group.
    pub(super) fn member(&mut self, fields: Fields, name: &str, outer: &Affine3A) {
        match name {
            "object" => self.object(fields, outer),
            "group" => self.group(fields, outer),
            "import" => self.import(fields, outer),
            _ => self.light(fields, name, outer),
        }
    }

    /// `group "name" { translate …; object …; … }`.
    fn group(&mut self, mut fields: Fields, outer: &Affine3A) {
        // The name is for the reader of the file.
        fields.text_argument();
        let placement = self.placed(&mut fields, outer);
        for field in fields.take_nodes(self, &MEMBERS) {
            let name = field.name;
            self.member(field.fields(), name, &placement);
        }
        fields.finish(self, "node");
    }

    /// The transforms of a node after those of the group it is in; a problem if they cannot be undone.
    fn placed(&mut self, fields: &mut Fields, outer: &Affine3A) -> Affine3A {
        let placement = *outer * self.placement(fields);
        if is_invertible(&placement) || !is_invertible(outer) {
            return placement;
        }
        let message = format!("{} is placed by transforms that leave the range of numbers", fields.owner);
        self.problem(&fields.span, message, None);
        *outer
    }

    /// `object "name" mesh="teapot" material="gold" { translate … }`.
    fn object(&mut self, mut fields: Fields, outer: &Affine3A) {
        let name = fields.text_argument().map(|name| name.value).unwrap_or_default();
        let shape_node = fields.take_one_of(self, &SHAPES);
        let lacks_shape = shape_node.is_none();
        let shape = shape_node.and_then(|field| self.shape(field));
        let materials =
            fields.take(self, "material").map(|field| self.material_of(field)).unwrap_or_default();
        let placements = self.placements(&mut fields, outer);
        if lacks_shape && fields.nothing_left() {
            let help = "write mesh=\"name\", `mesh { … }`, `sphere radius=1`, `disc radius=1` or `plane`";
            self.problem(&fields.span, "`object` lacks its shape", Some(help.into()));
        }
        let span = fields.span.clone();
        fields.finish(self, "option");
        if let Some(shape) = shape {
            self.scene.objects.push(ObjectSource { name, span, shape, materials, placements });
        }
    }

    fn shape(&mut self, field: Field) -> Option<ShapeSource> {
        let name = field.name;
        let mut fields = field.fields();
        let shape = match name {
            "mesh" if fields.has_fields() => return self.inline_mesh(fields).map(ShapeSource::InlineMesh),
            "mesh" => match fields.argument() {
                Some(argument) => self.text("`mesh`", &argument).map(ShapeSource::Mesh),
                None => {
                    let help = "write mesh=\"name\" or `mesh { … }`";
                    self.problem(&fields.span, "`mesh` lacks its name or its block", Some(help.into()));
                    None
                }
            },
            "sphere" => Some(ShapeSource::Sphere {
                radius: self.number_or(&mut fields, "radius", Range::POSITIVE, 1.0),
            }),
            "disc" => Some(ShapeSource::Disc {
                radius: self.number_or(&mut fields, "radius", Range::POSITIVE, 1.0),
            }),
            _ => Some(ShapeSource::Plane),
        };
        fields.finish(self, "option");
        shape
    }

    /// `import "model.glb" { translate … }`.
    fn import(&mut self, mut fields: Fields, outer: &Affine3A) {
        let path: Option<Spanned<String>> = match fields.argument() {
            Some(argument) => self.text("`import`", &argument),
            None => {
                self.problem(&fields.span, "`import` lacks the name of a file", None);
                None
            }
        };
        let placement = self.placed(&mut fields, outer);
        fields.finish(self, "option");
        if let Some(path) = path {
            self.scene.imports.push(ImportSource { path, placement });
        }
    }
}
