//! `camera { … }`.

use super::decoder::Decoder;
use super::fields::Fields;
use super::value::Range;
use super::{Spanned, source::Span};
use glam::Vec3;
use luch_scene::{Camera, NamedCamera, Projection};

/// Vertical field of view of a camera that says nothing, radians: about that of a 35 mm lens.
const USUAL_FIELD_OF_VIEW: f32 = 40.0 * std::f32::consts::PI / 180.0;

/// Degrees between the lower and the upper edge that make sense.
const FIELD_OF_VIEW: Range = Range { least: 0.0, most: 180.0, with_least: false, with_most: false };

impl Decoder<'_> {
    pub(super) fn camera(&mut self, mut fields: Fields) {
        let name = fields.text_argument();
        let span = name.as_ref().map_or_else(|| fields.span.clone(), |name| name.span.clone());
        let from = fields.take(self, "from");
        let from_span = from.as_ref().map_or_else(|| fields.span.clone(), |field| field.span.clone());
        let has_from = from.is_some();
        let from = from.and_then(|field| self.numbers(field, Range::ANY)).map(Vec3::from_array);
        let has_target = fields.has("to") || fields.has("direction");
        let to = self.optional_point(&mut fields, "to");
        let direction = self.optional_direction(&mut fields, "direction");
        let up = self.optional_direction(&mut fields, "up").unwrap_or(Vec3::Y);
        let projection = self.projection(&mut fields);
        let lens_radius = self.number_or(&mut fields, "lens-radius", Range::NOT_NEGATIVE, 0.0);
        let focus = self.optional_number(&mut fields, "focus", Range::POSITIVE);
        if !has_from && fields.nothing_left() {
            self.problem(
                &fields.span,
                "`camera` lacks its place",
                Some("write `from x y z` in its block".into()),
            );
        }
        if !has_target && fields.nothing_left() {
            let help = "write `to x y z` or `direction x y z` in its block";
            self.problem(&fields.span, "`camera` looks nowhere", Some(help.into()));
        }
        let target = self.target(&fields, from, to, direction, &from_span);
        fields.finish(self, "option");
        let (Some(position), Some(target)) = (from, target) else { return };
        let mut camera = Camera::looking_at(position, target, up, USUAL_FIELD_OF_VIEW);
        camera.projection = projection;
        camera.lens_radius = lens_radius;
        camera.focus_distance = focus.unwrap_or(camera.focus_distance);
        let name = name.map(|name| name.value).unwrap_or_default();
        let first = self.scene.cameras.iter().find(|other| !name.is_empty() && other.value.name == name);
        if let Some(first) = first.map(|camera| camera.span.clone()) {
            return self.twice(&span, &first, &format!("camera \"{}\"", super::source::clip(&name)));
        }
        self.scene.cameras.push(Spanned { value: NamedCamera { name, camera }, span });
    }

    /// The point that is looked at.
    fn target(
        &mut self,
        fields: &Fields,
        from: Option<Vec3>,
        to: Option<Vec3>,
        direction: Option<Vec3>,
        from_span: &Span,
    ) -> Option<Vec3> {
        match (to, direction) {
            (Some(_), Some(_)) => self.problem(&fields.span, "`camera` has both `to` and `direction`", None),
            (Some(to), None) if from == Some(to) => {
                self.problem(
                    from_span,
                    "`camera` looks at the point where it stands: `from` and `to` are equal",
                    None,
                );
            }
            (Some(to), None) => return Some(to),
            (None, Some(direction)) => return from.map(|from| from + direction),
            (None, None) => {}
        }
        None
    }

    fn projection(&mut self, fields: &mut Fields) -> Projection {
        let field_of_view = fields.take(self, "fov");
        let Some(orthographic) = fields.take(self, "orthographic") else {
            let angle = field_of_view
                .and_then(|field| self.single(field, "an angle in degrees"))
                .and_then(|argument| self.number("`fov`", &argument, FIELD_OF_VIEW))
                .map_or(USUAL_FIELD_OF_VIEW, f32::to_radians);
            return Projection::Perspective { field_of_view_y: angle };
        };
        if field_of_view.is_some() {
            self.problem(&orthographic.span, "`camera` has both `fov` and `orthographic`", None);
        }
        let mut inner = orthographic.fields();
        let height = self.optional_number(&mut inner, "height", Range::POSITIVE);
        if height.is_none() && inner.nothing_left() {
            let help =
                "write `orthographic height=3`: how many metres fit into the picture from bottom to top";
            self.problem(&inner.span, "`orthographic` lacks its height", Some(help.into()));
        }
        inner.finish(self, "option");
        Projection::Orthographic { height: height.unwrap_or(1.0) }
    }
}
