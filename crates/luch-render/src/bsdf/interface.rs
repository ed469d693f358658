//! What a single scattering at a rough interface loses, and the lobes that put it back.
//!
//! Let m_a(μ) be the share of light that reaches side a at cosine μ and is neither reflected nor refracted out by one scattering, and
//! M_a = ∫ m_a cos over the hemisphere. After Kulla and Conty 2017 two lobes restore it: f_aa = c_aa m_a(o) m_a(i), and
//! f_ab = c_ab m_a(o) m_b(i) across. All light comes back if c_aa M_a + ĉ_ab M_b = 1, where ĉ_ab = c_ab (η_b / η_a)² counts flux.
//! Reciprocity (f / η² symmetric) asks ĉ_ab η_a² = ĉ_ba η_b². As η_a² (1 − F̄_a) = η_b² (1 − F̄_b) for Fresnel's means, the choice
//! ĉ_ab = x (1 − F̄_a) keeps it for every x; x = 1 / max(M_a, M_b) is the largest that crosses no more than Fresnel's mean.
//!
//! Tables stand at fixed steps of √|log η|, each filled when first asked for and always with the same values; values between steps are
//! interpolated. So memory is bounded, and reading takes no lock.

use super::albedo::{Column, Row, SIZE, at_cosine, cosine_mean, row_alpha};
use super::fresnel::{dielectric_reflectance, dielectric_reflectance_mean};
use super::microfacet::Ggx;
use super::quadrature::VisibleNormals;
use super::{dielectric::refract, flip};
use std::f32::consts::{LN_10, PI};
use std::sync::OnceLock;

/// Number of tables over |log η| from 0 to log 10.
const STEPS: usize = 64;
/// Points per dimension of the integral over the visible normals.
const NORMALS: usize = 24;

/// Index of the side with the lower index of refraction in a table.
const RARE: usize = 0;
/// Index of the other side.
const DENSE: usize = 1;

/// Table for one index of refraction.
struct Table {
    missing: [[[f32; SIZE]; SIZE]; 2],
    missing_mean: [[f32; SIZE]; 2],
    /// Fresnel's mean from the rare side.
    reflectance_mean: f32,
}

static TABLES: [OnceLock<Box<Table>>; STEPS] = [const { OnceLock::new() }; STEPS];

/// The table at a step, filled if need be.
fn table(step: usize) -> &'static Table {
    TABLES[step].get_or_init(|| {
        let place = step as f32 / (STEPS - 1) as f32;
        let eta = libm::expf(LN_10 * place * place);
        let normals = VisibleNormals::new(NORMALS);
        let mut table = Box::new(Table {
            missing: [[[0.0; SIZE]; SIZE]; 2],
            missing_mean: [[0.0; SIZE]; 2],
            reflectance_mean: dielectric_reflectance_mean(f64::from(eta)) as f32,
        });
        for (side, eta) in [(RARE, eta), (DENSE, 1.0 / eta)] {
            for index in 0..SIZE {
                let ggx = Ggx::new(row_alpha(index));
                for column in 0..SIZE {
                    let cosine = Column::cosine(column, ggx.alpha());
                    table.missing[side][index][column] = missing(&normals, ggx, cosine, eta).max(0.0);
                }
                let row = Row::new(ggx);
                table.missing_mean[side][index] = cosine_mean(|cosine| row.at(&table.missing[side], cosine));
            }
        }
        table
    })
}

/// Share of light from `cosine` that one scattering loses; `eta` is far over near.
pub(super) fn missing(normals: &VisibleNormals, ggx: Ggx, cosine: f32, eta: f32) -> f32 {
    let outgoing = at_cosine(cosine);
    1.0 - normals.mean(ggx, outgoing, |normal| {
        let facet_cosine = outgoing.dot(normal);
        let reflectance = dielectric_reflectance(facet_cosine, eta);
        let reflected = 2.0 * facet_cosine * normal - outgoing;
        let back = if reflected.z > 0.0 { ggx.shadowing_given_masking(outgoing, reflected) } else { 0.0 };
        let through = refract(outgoing, normal, eta)
            .filter(|refracted| refracted.z < 0.0)
            .map_or(0.0, |refracted| ggx.shadowing_given_masking(outgoing, flip(refracted)));
        reflectance * back + (1.0 - reflectance) * through
    })
}

/// The lobes for a viewer on one side.
#[derive(Clone, Copy, Debug)]
pub(super) struct Crossing {
    /// Index of the far side over the near one.
    pub(super) eta: f32,
    /// The viewer's side in the tables.
    pub(super) near: usize,
    /// The other side.
    pub(super) far: usize,
    /// c_aa.
    pub(super) same: f32,
    /// ĉ_ab, which counts flux.
    pub(super) across: f32,
    /// Share of the restored light that goes across, ĉ_ab M_b.
    pub(super) probability: f32,
}

/// A GGX interface with what a single scattering on it loses.
#[derive(Clone, Copy, Debug)]
pub(super) struct CompensatedInterface {
    pub(super) ggx: Ggx,
    row: Row,
    ior: f32,
    step: u8,
    step_weight: f32,
    /// M of both sides.
    lost: [f32; 2],
    /// ĉ of both sides.
    across: [f32; 2],
}

impl CompensatedInterface {
    /// `None` where it is smooth.
    pub(super) fn new(ior: f32, roughness: f32) -> Option<Self> {
        let ggx = Ggx::from_roughness(roughness)?;
        let position = ((libm::logf(ior).abs() / LN_10).sqrt() * (STEPS - 1) as f32).min((STEPS - 1) as f32);
        let step = (position as usize).min(STEPS - 2);
        let mut interface = Self {
            ggx,
            row: Row::new(ggx),
            ior,
            step: step as u8,
            step_weight: position - step as f32,
            lost: [0.0; 2],
            across: [0.0; 2],
        };
        let lower = table(step);
        let upper = table(step + 1);
        for side in [RARE, DENSE] {
            interface.lost[side] = PI
                * interface.between(
                    interface.row.mean(&lower.missing_mean[side]),
                    interface.row.mean(&upper.missing_mean[side]),
                );
        }
        let rare = 1.0 - interface.between(lower.reflectance_mean, upper.reflectance_mean);
        let dense_eta = ior.max(1.0 / ior);
        let largest = interface.lost[RARE].max(interface.lost[DENSE]).max(f32::MIN_POSITIVE);
        interface.across = [rare / largest, rare / (dense_eta * dense_eta) / largest];
        Some(interface)
    }

    fn between(&self, lower: f32, upper: f32) -> f32 {
        lower + (upper - lower) * self.step_weight
    }

    /// Share of light from a side and cosine that one scattering loses.
    pub(super) fn missing(&self, side: usize, cosine: f32) -> f32 {
        let step = usize::from(self.step);
        self.between(
            self.row.at(&table(step).missing[side], cosine),
            self.row.at(&table(step + 1).missing[side], cosine),
        )
    }

    /// For a viewer outside.
    pub(super) fn outward(&self) -> Crossing {
        let near = if self.ior < 1.0 { DENSE } else { RARE };
        self.crossing(near, self.ior)
    }

    /// For a viewer inside.
    pub(super) fn inward(&self) -> Crossing {
        let near = if self.ior < 1.0 { RARE } else { DENSE };
        self.crossing(near, 1.0 / self.ior)
    }

    fn crossing(&self, near: usize, eta: f32) -> Crossing {
        let far = 1 - near;
        let across = self.across[near];
        let probability = across * self.lost[far];
        let same = (1.0 - probability) / self.lost[near].max(f32::MIN_POSITIVE);
        Crossing { eta, near, far, same, across, probability }
    }
}

#[cfg(test)]
mod tests;
