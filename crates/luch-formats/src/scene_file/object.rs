//! What stands in the world: `object`, `group`, `import`, and lamps.

use super::decoder::Decoder;
use super::fields::{Field, Fields};
use super::transform::is_invertible;
use super::value::Range;
use super::{ImportSource, ObjectSource, ShapeSource, Spanned};
use glam::{Affine3A, Vec3};
use luch_formula::Formula;
use luch_scene::{Frustum, Implicit, Traced};

/// What may stand in a group.
const MEMBERS: [&str; 6] = ["object", "group", "point-light", "spot-light", "sun", "import"];

/// What an object may be made of.
const SHAPES: [&str; 9] =
    ["mesh", "sphere", "cylinder", "cone", "disc", "plane", "implicit", "height-map", "terrain"];

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
            let help = "write mesh=\"name\", `mesh { … }`, `sphere radius=1`, `cylinder`, `cone`, `disc radius=1` or `plane`";
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
        if ["height-map", "terrain"].contains(&name) {
            return self.step(field).map(ShapeSource::HeightField);
        }
        let mut fields = field.fields();
        let shape = match name {
            "implicit" => self.implicit(&mut fields),
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
            "cylinder" | "cone" => {
                let bottom_radius = self.number_or(&mut fields, "radius", Range::POSITIVE, 1.0);
                let top_radius = match name {
                    "cone" => self.number_or(&mut fields, "top-radius", Range::NOT_NEGATIVE, 0.0),
                    _ => bottom_radius,
                };
                let height = self.number_or(&mut fields, "height", Range::POSITIVE, 2.0);
                let capped = self.flag_or(&mut fields, "capped", true);
                Some(ShapeSource::Traced(Traced::Frustum(Frustum {
                    bottom_radius,
                    top_radius,
                    height,
                    capped,
                })))
            }
            _ => Some(ShapeSource::Plane),
        };
        fields.finish(self, "option");
        shape
    }

    /// `implicit "x^2 + y^2 + z^2 = 1" { from -1 -1 -1; to 1 1 1; closed; parameter "a" 2 }`.
    fn implicit(&mut self, fields: &mut Fields) -> Option<ShapeSource> {
        let Some(text) = fields.text_argument() else {
            let help = "write `implicit \"x^2 + y^2 + z^2 - 1\"`";
            self.problem(&fields.span, "`implicit` lacks its formula", Some(help.into()));
            return None;
        };
        let mut formula = Formula::new(text.value.clone());
        for field in fields.take_nodes(self, &["parameter"]) {
            let mut inner = field.fields();
            let (name, value) = (inner.text_argument(), inner.argument());
            match (name, value) {
                (Some(name), Some(value)) => {
                    if let Some(value) = self.number("`parameter`", &value, Range::ANY) {
                        formula = formula.with(name.value, f64::from(value));
                    }
                }
                _ => self.problem(
                    &inner.span,
                    "`parameter` has a name and a number",
                    Some("write `parameter \"a\" 1.5`".into()),
                ),
            }
            inner.finish(self, "option");
        }
        let low = self.corner(fields, "from", -1.0);
        let high = self.corner(fields, "to", 1.0);
        let closed = self.flag_or(fields, "closed", false);
        match Implicit::new(formula, [low, high], closed) {
            Ok(surface) => Some(ShapeSource::Traced(Traced::Implicit(surface))),
            Err(error) => {
                self.problem(&text.span, error.to_string(), None);
                None
            }
        }
    }

    /// Three numbers, or one for all.
    fn corner(&mut self, fields: &mut Fields, name: &'static str, default: f32) -> Vec3 {
        let Some(field) = fields.take(self, name) else { return Vec3::splat(default) };
        let mut inner = field.fields();
        let arguments = inner.all_arguments();
        let corner = match arguments.as_slice() {
            [one] => self.number(&format!("`{name}`"), one, Range::ANY).map(Vec3::splat),
            _ => self.array(&format!("`{name}`"), &inner.span, &arguments, Range::ANY).map(Vec3::from_array),
        };
        inner.finish(self, "option");
        corner.unwrap_or(Vec3::splat(default))
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
