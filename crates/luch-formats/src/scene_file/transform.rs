//! `translate`, `rotate`, `scale`, `matrix`: the first line is done first.

use super::decoder::Decoder;
use super::fields::{Field, Fields};
use super::value::Range;
use glam::{Affine3A, Mat3, Quat, Vec3};

/// The nodes that move things.
pub(super) const TRANSFORMS: [&str; 7] =
    ["translate", "rotate", "rotate-x", "rotate-y", "rotate-z", "scale", "matrix"];

/// The nodes that turn things.
const ROTATIONS: [&str; 4] = ["rotate", "rotate-x", "rotate-y", "rotate-z"];

/// Factors of a scale: not so small that the scale could not be undone.
const FACTOR: Range = Range::between(-1e9, 1e9);

impl Decoder<'_> {
    /// All transforms of a node, one after another.
    pub(super) fn placement(&mut self, fields: &mut Fields) -> Affine3A {
        let nodes = fields.take_nodes(self, &TRANSFORMS);
        nodes.into_iter().fold(Affine3A::IDENTITY, |so_far, field| self.transform(field) * so_far)
    }

    /// All rotations of a node, one after another.
    pub(super) fn rotation(&mut self, fields: &mut Fields) -> Mat3 {
        let nodes = fields.take_nodes(self, &ROTATIONS);
        nodes
            .into_iter()
            .fold(Mat3::IDENTITY, |so_far, field| Mat3::from(self.transform(field).matrix3) * so_far)
    }

    /// One transform; nothing happens if it is wrong.
    pub(super) fn transform(&mut self, field: Field) -> Affine3A {
        let transform = match field.name {
            "translate" => {
                self.numbers(field, Range::ANY).map(|by| Affine3A::from_translation(Vec3::from_array(by)))
            }
            "rotate-x" => self.turn(field, Vec3::X),
            "rotate-y" => self.turn(field, Vec3::Y),
            "rotate-z" => self.turn(field, Vec3::Z),
            "rotate" => self.rotate(field),
            "scale" => self.scale(field),
            _ => self.matrix(field),
        };
        transform.unwrap_or(Affine3A::IDENTITY)
    }

    /// `rotate-x 30`.
    fn turn(&mut self, field: Field, axis: Vec3) -> Option<Affine3A> {
        let [degrees] = self.numbers(field, Range::between(-1e6, 1e6))?;
        Some(Affine3A::from_quat(turned(axis, degrees)))
    }

    /// `rotate 0 1 0 angle=30`.
    fn rotate(&mut self, field: Field) -> Option<Affine3A> {
        let mut fields = field.fields();
        let angle = self.optional_number(&mut fields, "angle", Range::between(-1e6, 1e6));
        let arguments = fields.all_arguments();
        let axis =
            self.array("the axis of `rotate`", &fields.span, &arguments, Range::ANY).map(Vec3::from_array);
        let direction = axis.and_then(Vec3::try_normalize);
        if axis.is_some() && direction.is_none() {
            self.problem(&fields.span, "the axis of `rotate` has no direction: its length is zero", None);
        }
        if angle.is_none() && fields.nothing_left() && axis.is_some() {
            let help = "write `rotate 0 1 0 angle=30`, in degrees";
            self.problem(&fields.span, "`rotate` lacks its angle", Some(help.into()));
        }
        fields.finish(self, "option");
        Some(Affine3A::from_quat(turned(direction?, angle?)))
    }

    /// `scale 2` or `scale 1 2 1`.
    fn scale(&mut self, field: Field) -> Option<Affine3A> {
        let mut fields = field.fields();
        let arguments = fields.all_arguments();
        let factors = match arguments.as_slice() {
            [one] => self.number("`scale`", one, FACTOR).map(Vec3::splat),
            [_, _, _] => self.array("`scale`", &fields.span, &arguments, FACTOR).map(Vec3::from_array),
            _ => {
                self.problem(&fields.span, "`scale` has one number, or three for x, y and z", None);
                None
            }
        };
        let span = fields.span.clone();
        fields.finish(self, "option");
        let factors = factors?;
        if factors.abs().min_element() < 1e-9 {
            self.problem(&span, "`scale` makes everything flat: a factor is zero or as good as zero", None);
            return None;
        }
        Some(Affine3A::from_scale(factors))
    }

    /// `matrix` and three rows of four numbers.
    fn matrix(&mut self, field: Field) -> Option<Affine3A> {
        let span = field.span.clone();
        let m: [f32; 12] = self.numbers(field, Range::ANY)?;
        let column = |at: usize| glam::Vec3A::new(m[at], m[at + 4], m[at + 8]);
        let map = Affine3A {
            matrix3: glam::Mat3A::from_cols(column(0), column(1), column(2)),
            translation: column(3),
        };
        if !is_invertible(&map) {
            self.problem(&span, "`matrix` cannot be inverted", None);
            return None;
        }
        Some(map)
    }
}

/// A rotation; whole quarters are exact.
fn turned(axis: Vec3, degrees: f32) -> Quat {
    // Reduced before it becomes radians: a turn and a half is as exact as a half.
    Quat::from_axis_angle(axis, (degrees % 360.0).to_radians())
}

/// True if a placement can be undone.
pub(crate) fn is_invertible(map: &Affine3A) -> bool {
    let determinant = map.matrix3.determinant();
    map.is_finite() && determinant.is_normal() && map.inverse().is_finite()
}
