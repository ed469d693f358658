//! What a single bounce on GGX facets loses, in tables.
//!
//! A rough mirror in which light bounces once swallows light that a real one lets bounce again. Kulla and Conty (*Revisiting physically
//! based shading at Imageworks*, 2017) put it back with a second, smooth lobe, for which they need the share that is missing.
//! The tables are filled at first use by quadrature over the visible normals, always with the same values.

use super::fresnel::schlick_weight;
use super::microfacet::Ggx;
use super::quadrature::VisibleNormals;
use glam::Vec3;
use luch_image::Rgb;
use std::sync::LazyLock;

/// Number of widths and of angles in a table.
pub(super) const SIZE: usize = 32;
/// Points per dimension of the integral over the visible normals.
const NORMALS: usize = 20;
/// Number of steps of the integral over all angles.
const MEAN_STEPS: usize = 512;

/// Place of a width on the roughness axis of a table: between rows `index` and `index + 1`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Row {
    alpha: f32,
    index: u8,
    weight: f32,
}

/// Least roughness √α in a table.
fn least_roughness() -> f32 {
    super::microfacet::SMALLEST_ALPHA.sqrt()
}

/// The width of a table's row.
pub(super) fn row_alpha(index: usize) -> f32 {
    let least = least_roughness();
    let roughness = least + (1.0 - least) * index as f32 / (SIZE - 1) as f32;
    roughness * roughness
}

impl Row {
    /// The place of a distribution's width.
    pub(super) fn new(ggx: Ggx) -> Self {
        let least = least_roughness();
        let position = (ggx.alpha().sqrt() - least) / (1.0 - least) * (SIZE - 1) as f32;
        let index = (position as usize).min(SIZE - 2);
        Self { alpha: ggx.alpha(), index: index as u8, weight: (position - index as f32).clamp(0.0, 1.0) }
    }

    /// A value per width.
    pub(super) fn mean(self, values: &[f32; SIZE]) -> f32 {
        let index = usize::from(self.index);
        values[index] + (values[index + 1] - values[index]) * self.weight
    }

    /// A value per width and angle.
    pub(super) fn at(self, rows: &[[f32; SIZE]; SIZE], cosine: f32) -> f32 {
        self.at_column(rows, Column::at_cosine(cosine, self.alpha))
    }

    /// The same where the place on the other axis is known.
    fn at_column(self, rows: &[[f32; SIZE]; SIZE], column: Column) -> f32 {
        let index = usize::from(self.index);
        let lower = column.value(&rows[index]);
        lower + (column.value(&rows[index + 1]) - lower) * self.weight
    }
}

/// Place of an angle on the other axis.
#[derive(Clone, Copy, Debug)]
pub(super) struct Column {
    index: usize,
    weight: f32,
}

impl Column {
    /// A place on the axis, 0 to 1.
    fn new(position: f32) -> Self {
        let position = position.clamp(0.0, 1.0) * (SIZE - 1) as f32;
        let index = (position as usize).min(SIZE - 2);
        Self { index, weight: position - index as f32 }
    }

    /// Masking changes at the scale of α, Fresnel's reflectance at that of μ: half of the axis looks at each, by the mean of
    /// μ (1 + α) / (μ + α) and √μ.
    pub(super) fn at_cosine(cosine: f32, alpha: f32) -> Self {
        Self::new(0.5 * (cosine * (1.0 + alpha) / (cosine + alpha) + cosine.max(0.0).sqrt()))
    }

    /// The cosine of a column of the table: the inverse of [`Column::at_cosine`] by halving √μ.
    pub(super) fn cosine(index: usize, alpha: f32) -> f32 {
        let wanted = index as f32 / (SIZE - 1) as f32;
        let (mut low, mut high) = (0.0_f32, 1.0_f32);
        for _ in 0..24 {
            let root = 0.5 * (low + high);
            let cosine = root * root;
            if 0.5 * (cosine * (1.0 + alpha) / (cosine + alpha) + root) < wanted {
                low = root;
            } else {
                high = root;
            }
        }
        if index + 1 == SIZE { 1.0 } else { low * low }
    }

    fn value(self, values: &[f32; SIZE]) -> f32 {
        values[self.index] + (values[self.index + 1] - values[self.index]) * self.weight
    }
}

/// 2 ∫ μ f(μ) dμ from 0 to 1.
pub(super) fn cosine_mean(f: impl Fn(f32) -> f32) -> f32 {
    let step = 1.0 / MEAN_STEPS as f32;
    // μ = t², so that the steps are fine at grazing.
    let sum: f64 = (0..MEAN_STEPS)
        .map(|index| {
            let t = (index as f32 + 0.5) * step;
            f64::from(4.0 * t * t * t * f(t * t))
        })
        .sum();
    (sum / MEAN_STEPS as f64) as f32
}

/// The unit vector of the xz plane at a cosine from +Z.
pub(super) fn at_cosine(cosine: f32) -> Vec3 {
    Vec3::new((1.0 - cosine * cosine).max(0.0).sqrt(), 0.0, cosine)
}

/// What a single bounce gives back.
struct SingleBounce {
    /// Albedo at reflectance 1.
    albedo: f32,
    /// Albedo where the facets reflect Schlick's weight.
    grazing: f32,
}

fn single_bounce(normals: &VisibleNormals, ggx: Ggx, cosine: f32) -> SingleBounce {
    let outgoing = at_cosine(cosine);
    let reflect = |normal: Vec3| 2.0 * outgoing.dot(normal) * normal - outgoing;
    let mean = |f: &dyn Fn(Vec3) -> f32| {
        normals.mean_above(
            ggx,
            outgoing,
            |normal| reflect(normal).z,
            |normal| {
                let incoming = reflect(normal);
                if incoming.z > 0.0 {
                    f(normal) * ggx.shadowing_given_masking(outgoing, incoming)
                } else {
                    0.0
                }
            },
        )
    };
    SingleBounce {
        albedo: mean(&|_| 1.0).min(1.0),
        grazing: mean(&|normal| schlick_weight(outgoing.dot(normal))),
    }
}

struct Tables {
    missing: [[f32; SIZE]; SIZE],
    missing_mean: [f32; SIZE],
    grazing: [[f32; SIZE]; SIZE],
    grazing_mean: [f32; SIZE],
}

static TABLES: LazyLock<Box<Tables>> = LazyLock::new(|| {
    let normals = VisibleNormals::new(NORMALS);
    let mut tables = Box::new(Tables {
        missing: [[0.0; SIZE]; SIZE],
        missing_mean: [0.0; SIZE],
        grazing: [[0.0; SIZE]; SIZE],
        grazing_mean: [0.0; SIZE],
    });
    for index in 0..SIZE {
        let ggx = Ggx::new(row_alpha(index));
        for column in 0..SIZE {
            let bounce = single_bounce(&normals, ggx, Column::cosine(column, ggx.alpha()));
            tables.missing[index][column] = 1.0 - bounce.albedo;
            tables.grazing[index][column] = bounce.grazing;
        }
        let row = Row::new(ggx);
        tables.missing_mean[index] = cosine_mean(|cosine| row.at(&tables.missing, cosine));
        tables.grazing_mean[index] = cosine_mean(|cosine| row.at(&tables.grazing, cosine));
    }
    tables
});

/// A GGX distribution with what a single bounce on it loses.
#[derive(Clone, Copy, Debug)]
pub(super) struct CompensatedGgx {
    pub(super) ggx: Ggx,
    row: Row,
}

impl CompensatedGgx {
    pub(super) fn from_roughness(roughness: f32) -> Option<Self> {
        Ggx::from_roughness(roughness).map(|ggx| Self { ggx, row: Row::new(ggx) })
    }

    /// Share of light from `cosine` that a single bounce loses.
    pub(super) fn missing(&self, cosine: f32) -> f32 {
        self.row.at(&TABLES.missing, cosine)
    }

    /// Mean of [`CompensatedGgx::missing`] over the hemisphere.
    pub(super) fn missing_mean(&self) -> f32 {
        self.row.mean(&TABLES.missing_mean)
    }

    /// What a single bounce gives back to `cosine`, split for Schlick's formula.
    pub(super) fn bounce(&self, cosine: f32) -> Bounce {
        let column = Column::at_cosine(cosine, self.row.alpha);
        Bounce {
            missing: self.row.at_column(&TABLES.missing, column),
            grazing: self.row.at_column(&TABLES.grazing, column),
        }
    }

    /// Means of [`CompensatedGgx::bounce`] over the hemisphere.
    pub(super) fn bounce_mean(&self) -> Bounce {
        Bounce { missing: self.missing_mean(), grazing: self.row.mean(&TABLES.grazing_mean) }
    }
}

/// A single bounce on facets with Schlick's reflectance: its albedo is f0 (1 − missing − grazing) + f90 grazing.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounce {
    /// Share that is lost at reflectance 1.
    pub(super) missing: f32,
    /// Part that goes with f90.
    pub(super) grazing: f32,
}

impl Bounce {
    /// A smooth mirror, where Schlick's weight is `grazing`.
    pub(super) fn smooth(grazing: f32) -> Self {
        Self { missing: 0.0, grazing }
    }

    /// Albedo of facets that reflect from `f0` to `f90`.
    pub(super) fn albedo(self, f0: Rgb, f90: f32) -> Rgb {
        f0 * (1.0 - self.missing - self.grazing) + Rgb::gray(f90 * self.grazing)
    }
}

#[cfg(test)]
mod tests;
