//! The values of one attribute in the making.

use std::collections::HashMap;

use glam::{DVec4, Vec2, Vec3, Vec4};

use super::{Mix, NewCorner, Uv};
use crate::polygon_mesh::CornerAttribute;

/// One attribute in the making.
pub(super) struct Lane<'a, T> {
    source: &'a CornerAttribute<T>,
    pub(super) out: CornerAttribute<T>,
    /// The values that were mixed, by their bits.
    known: HashMap<[u32; 4], u32>,
}

/// Values that can be mixed.
pub(super) trait Mixable: Copy {
    fn widen(self) -> DVec4;
    fn narrow(sum: DVec4) -> Self;
}

impl Mixable for Vec2 {
    fn widen(self) -> DVec4 {
        self.as_dvec2().extend(0.0).extend(0.0)
    }
    fn narrow(sum: DVec4) -> Self {
        sum.as_vec4().truncate().truncate()
    }
}

impl Mixable for Vec3 {
    fn widen(self) -> DVec4 {
        self.as_dvec3().extend(0.0)
    }
    fn narrow(sum: DVec4) -> Self {
        // These are normals.
        sum.truncate().try_normalize().map_or(Vec3::Z, |unit| unit.as_vec3())
    }
}

impl Mixable for Vec4 {
    fn widen(self) -> DVec4 {
        self.as_dvec4()
    }
    fn narrow(sum: DVec4) -> Self {
        sum.as_vec4()
    }
}

impl<'a, T: Mixable> Lane<'a, T> {
    pub(super) fn new(source: &'a CornerAttribute<T>) -> Self {
        let out = CornerAttribute {
            values: source.values.clone(),
            corners: Vec::with_capacity(source.corners.len()),
        };
        Self { source, out, known: HashMap::new() }
    }

    pub(super) fn is_present(&self) -> bool {
        !self.source.is_empty()
    }

    pub(super) fn copy(&mut self, corners: std::ops::Range<usize>) {
        if self.is_present() {
            self.out.corners.extend_from_slice(&self.source.corners[corners]);
        }
    }

    fn value(&self, corner: u32) -> DVec4 {
        self.source.values[self.source.corners[corner as usize] as usize].widen()
    }

    fn mixed(&self, mix: &Mix) -> DVec4 {
        match mix {
            Mix::One(corner) => self.value(*corner),
            Mix::Many(parts) => parts.iter().map(|&(corner, weight)| self.value(corner) * weight).sum(),
        }
    }

    /// `later` leaves the place open for a value that is known at the end.
    pub(super) fn push(&mut self, corner: &NewCorner, later: bool) {
        if !self.is_present() {
            return;
        }
        let number = match &corner.mix {
            _ if later => 0,
            Mix::One(corner) => self.source.corners[*corner as usize],
            mix => self.number(T::narrow(self.mixed(mix))),
        };
        self.out.corners.push(number);
    }

    pub(super) fn number(&mut self, value: T) -> u32 {
        let key = value.widen().as_vec4().to_array().map(f32::to_bits);
        let values = &mut self.out.values;
        *self.known.entry(key).or_insert_with(|| {
            values.push(value);
            values.len() as u32 - 1
        })
    }

    /// The attribute without the values that no corner names.
    pub(super) fn finish(mut self) -> CornerAttribute<T> {
        const UNUSED: u32 = u32::MAX;
        let mut numbers = vec![UNUSED; self.out.values.len()];
        self.out.corners.iter().for_each(|&number| numbers[number as usize] = 0);
        let used = numbers.iter_mut().filter(|number| **number != UNUSED);
        used.zip(0..).for_each(|(number, place)| *number = place);
        let mut flags = numbers.iter();
        self.out.values.retain(|_| flags.next().is_some_and(|&number| number != UNUSED));
        self.out.corners.iter_mut().for_each(|number| *number = numbers[*number as usize]);
        self.out
    }
}

impl Lane<'_, Vec2> {
    pub(super) fn push_uv(&mut self, corner: &NewCorner) {
        if !self.is_present() {
            return;
        }
        let uv = match corner.uv {
            Uv::Mixed => return self.push(corner, false),
            Uv::At(uv) => uv,
            Uv::Unfolded { from, to, ratio } => {
                let way = self.value(to) - self.value(from);
                let aside = DVec4::new(way.y, -way.x, 0.0, 0.0) * ratio;
                Vec2::narrow(self.mixed(&corner.mix) + aside)
            }
        };
        let uv = if uv.is_finite() { uv } else { Vec2::ZERO };
        let number = self.number(uv);
        self.out.corners.push(number);
    }
}
