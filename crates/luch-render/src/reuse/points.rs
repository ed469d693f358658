//! Points of a bundle side by side, and the densities between all of them.

use super::Table;
use crate::surface::Exit;
use glam::Vec3;
use luch_bvh::simd::Task;
use std::f32::consts::FRAC_1_PI;

/// Points side by side.
pub(super) const LANES: usize = 16;

/// Least cosine at which a shading normal is not tilted toward the viewer.
const LEAST_COSINE: f32 = 1e-3;

type Lanes = [f32; LANES];

/// Points of surfaces, `[axis][lane]`; places that are not set stand nowhere.
#[derive(Clone, Debug)]
#[repr(C, align(64))]
pub(super) struct Points {
    position: [Lanes; 3],
    geometric_normal: [Lanes; 3],
    normal: [Lanes; 3],
    near: [Lanes; 3],
    /// 1 where smooth shading lifts the point.
    lifted: Lanes,
    /// How often the path scattered before.
    depth: [u32; LANES],
    set: u32,
}

impl Default for Points {
    fn default() -> Self {
        let none = [[0.0; LANES]; 3];
        Self {
            position: none,
            geometric_normal: none,
            normal: none,
            near: none,
            lifted: [0.0; LANES],
            depth: [0; LANES],
            set: 0,
        }
    }
}

impl Points {
    pub(super) fn set(&mut self, lane: usize, exit: &Exit, depth: u32) {
        for axis in 0..3 {
            self.position[axis][lane] = exit.position[axis];
            self.geometric_normal[axis][lane] = exit.geometric_normal[axis];
            self.normal[axis][lane] = exit.normal[axis];
            self.near[axis][lane] = exit.near[axis];
        }
        self.lifted[lane] = f32::from(u8::from(exit.lifted));
        self.depth[lane] = depth;
        self.set |= 1 << lane;
    }

    pub(super) fn depth(&self, lane: usize) -> u32 {
        self.depth[lane]
    }

    /// Cosine of a direction against the shading normal; 0 where no light may pass.
    pub(super) fn cosine(&self, lane: usize, direction: Vec3) -> f32 {
        let along = |rows: &[Lanes; 3]| Vec3::from_array(rows.map(|axis| axis[lane])).dot(direction);
        let honest = along(&self.geometric_normal) > 0.0 || self.lifted[lane] > 0.0;
        if honest { along(&self.normal).max(0.0) } else { 0.0 }
    }

    pub(super) fn is_set(&self, lane: usize) -> bool {
        self.set >> lane & 1 == 1
    }

    /// Where rays on the viewer's side start and end.
    pub(super) fn near(&self, lane: usize) -> Vec3 {
        Vec3::from_array(self.near.map(|axis| axis[lane]))
    }
}

/// Fills in, for each second point (row) and each first point (column), the density per area at the second with which the
/// first finds it if it sees it: cos / π · |cos| / distance².
pub(super) struct Densities<'a> {
    pub(super) firsts: &'a Points,
    pub(super) seconds: &'a Points,
    pub(super) table: &'a mut Table,
}

impl Task for Densities<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Self { firsts, seconds, table } = self;
        for (j, row) in table.iter_mut().enumerate() {
            if !seconds.is_set(j) {
                *row = [0.0; LANES];
                continue;
            }
            let at = |rows: &[Lanes; 3]| rows.map(|axis| axis[j]);
            let (to, geometric, shading) =
                (at(&seconds.position), at(&seconds.geometric_normal), at(&seconds.normal));
            for k in 0..LANES {
                let x = to[0] - firsts.position[0][k];
                let y = to[1] - firsts.position[1][k];
                let z = to[2] - firsts.position[2][k];
                let squared = x * x + y * y + z * z;
                let inverse = 1.0 / squared.sqrt();
                let (x, y, z) = (x * inverse, y * inverse, z * inverse);
                let along = |rows: &[Lanes; 3]| x * rows[0][k] + y * rows[1][k] + z * rows[2][k];
                let against = |normal: [f32; 3]| -(x * normal[0] + y * normal[1] + z * normal[2]);
                let leaving = along(&firsts.normal);
                let honest = (along(&firsts.geometric_normal) > 0.0) | (firsts.lifted[k] > 0.0);
                let (arriving, shaded) = (against(geometric), against(shading));
                // Who looks at a flatter angle would see another shading frame.
                let alike = (shaded >= LEAST_COSINE) | (shaded >= arriving);
                let seen = (leaving > 0.0) & (arriving > 0.0) & alike & honest;
                // Not a number where both points are one.
                let density = leaving * FRAC_1_PI * arriving / squared;
                let density = if seen { density } else { 0.0 };
                row[k] = if density < f32::INFINITY { density } else { 0.0 };
            }
            for (k, density) in row.iter_mut().enumerate() {
                // Only paths of one length so far: how much longer they may get is then the same for all.
                let alike = firsts.depth[k] + 1 == seconds.depth[j];
                *density = if firsts.is_set(k) & alike { *density } else { 0.0 };
            }
            // Who found the point sees it, whatever was rounded.
            row[j] = if row[j] > 0.0 { row[j] } else { f32::MIN_POSITIVE };
        }
    }
}
