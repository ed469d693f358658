//! `array` and `scatter`: one object, many places.

use super::decoder::Decoder;
use super::fields::{Field, Fields};
use super::transform::{TRANSFORMS, is_invertible};
use super::value::Range;
use glam::{Affine3A, DAffine3, DMat3, Quat, Vec3};
use luch_sampling::hash;

/// Most objects that a scene file may make, each copy counted.
pub(crate) const MOST_COPIES: usize = 1 << 22;

/// What an object is placed by: transforms, and what makes many of one.
const PLACINGS: [&str; 9] = {
    let [translate, rotate, x, y, z, scale, matrix] = TRANSFORMS;
    [translate, rotate, x, y, z, scale, matrix, "array", "scatter"]
};

impl Decoder<'_> {
    /// Where an object and its copies stand, inside what `outer` places; never empty. The first line is done first, `array` and
    /// `scatter` like transforms that have several results.
    pub(super) fn placements(&mut self, fields: &mut Fields, outer: &Affine3A) -> Vec<Affine3A> {
        let mut places = vec![Affine3A::IDENTITY];
        for field in fields.take_nodes(self, &PLACINGS) {
            let steps = match field.name {
                "array" => self.array_steps(field, places.len()),
                "scatter" => self.scatter_steps(field, places.len()),
                _ => vec![self.transform(field)],
            };
            places = steps.iter().flat_map(|step| places.iter().map(move |place| *step * *place)).collect();
        }
        for place in &mut places {
            *place = *outer * *place;
        }
        if is_invertible(outer) && !places.iter().all(is_invertible) {
            let message = format!("{} is placed by transforms that leave the range of numbers", fields.owner);
            self.problem(&fields.span, message, None);
        }
        self.copies += places.len();
        places
    }

    /// `array 10 { translate 1 0 0 }`: copy k is moved k times, the first not at all.
    fn array_steps(&mut self, field: Field, before: usize) -> Vec<Affine3A> {
        let mut fields = field.fields();
        let count = self.count_of_copies(&mut fields, before);
        let has_transforms = fields.has_fields();
        let step = self.placement(&mut fields);
        if !has_transforms {
            let help = "write `array 10 { translate 1 0 0 }`";
            self.problem(&fields.span, "`array` does not say where the next copy stands", Some(help.into()));
        }
        fields.finish(self, "transform");
        // In double precision, so that the hundredth copy is where a hundred steps lead.
        let step = DAffine3 {
            matrix3: DMat3::from_cols(
                step.matrix3.x_axis.as_dvec3(),
                step.matrix3.y_axis.as_dvec3(),
                step.matrix3.z_axis.as_dvec3(),
            ),
            translation: step.translation.as_dvec3(),
        };
        let steps = std::iter::successors(Some(DAffine3::IDENTITY), |place| Some(step * *place));
        steps.take(count).map(|place| place.as_affine3a()).collect()
    }

    /// `scatter 1000 { size 20 0 20; seed 1; turn 360; scale 0.8 1.2 }`: copies at random places of a box about the origin.
    fn scatter_steps(&mut self, field: Field, before: usize) -> Vec<Affine3A> {
        let mut fields = field.fields();
        let count = self.count_of_copies(&mut fields, before);
        let size = fields.take(self, "size").map(|field| self.numbers(field, Range::NOT_NEGATIVE));
        if size.is_none() {
            let help = "write `scatter 1000 { size 20 0 20 }`, the sides of a box about the origin";
            self.problem(&fields.span, "`scatter` lacks the `size` of its box", Some(help.into()));
        }
        let size = Vec3::from_array(size.flatten().unwrap_or_default());
        let seed = fields.take(self, "seed").and_then(|field| {
            let argument = self.single(field, "a whole number")?;
            self.whole("`seed`", &argument, 0, u64::MAX)
        });
        let turn = self.number_or(&mut fields, "turn", Range::between(-1e6, 1e6), 0.0);
        let scale = fields.take(self, "scale").and_then(|field| self.range_of_scales(field));
        let [least, most] = scale.unwrap_or([1.0, 1.0]);
        fields.finish(self, "option");
        let copy = |copy: u64| {
            let key = hash::combine(seed.unwrap_or(0), copy);
            let chance = |purpose: u64| hash::unit_f32((hash::combine(key, purpose) >> 32) as u32);
            let place = (Vec3::new(chance(0), chance(1), chance(2)) - Vec3::splat(0.5)) * size;
            let turned = Quat::from_axis_angle(Vec3::Y, (turn * chance(3)).to_radians());
            let scale = least + (most - least) * chance(4);
            Affine3A::from_scale_rotation_translation(Vec3::splat(scale), turned, place)
        };
        (0..count as u64).map(copy).collect()
    }

    /// The least and the most of the factors of `scale 0.8 1.2`.
    fn range_of_scales(&mut self, field: Field) -> Option<[f32; 2]> {
        let span = field.span.clone();
        let [least, most] = self.numbers(field, Range::between(1e-9, 1e9))?;
        if least > most {
            let message = format!("the least `scale` is {least}, which is more than the most, {most}");
            self.problem(&span, message, None);
            return None;
        }
        Some([least, most])
    }

    /// The number of copies, of `before` places each; 1 if it is wrong.
    fn count_of_copies(&mut self, fields: &mut Fields, before: usize) -> usize {
        let owner = fields.owner.clone();
        let Some(argument) = fields.argument() else {
            let help = format!("write {} and a whole number", owner);
            self.problem(&fields.span, format!("{owner} lacks the number of copies"), Some(help));
            return 1;
        };
        let Some(count) = self.whole(&owner, &argument, 1, MOST_COPIES as u64) else { return 1 };
        let count = count as usize;
        if count.saturating_mul(before).saturating_add(self.copies) > MOST_COPIES {
            let message = format!("with these copies the scene has more than {MOST_COPIES} objects");
            self.problem(&argument.span, message, None);
            return 1;
        }
        count
    }
}
