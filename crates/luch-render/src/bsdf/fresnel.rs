//! How much a smooth interface reflects: exact formulas, Schlick's approximation, and their means over the hemisphere.
//!
//! A *mean* is ∫ 2 μ F(μ) dμ over μ = cos θ from 0 to 1: the share of diffuse light that is reflected.

use luch_image::Rgb;

/// Unpolarised reflectance of a dielectric interface; `cosine` ≥ 0 is that of the incident side, `eta` the index of the far side over
/// the near side. 1 under total internal reflection.
pub fn dielectric_reflectance(cosine: f32, eta: f32) -> f32 {
    let cosine = cosine.clamp(0.0, 1.0);
    let sine_squared = (1.0 - cosine * cosine) / (eta * eta);
    if sine_squared >= 1.0 {
        return 1.0;
    }
    reflectance_of_cosines(cosine, (1.0 - sine_squared).sqrt(), eta)
}

/// [`dielectric_reflectance`] where the cosine `refracted` of the far side is known as well: the same number from either side.
pub(super) fn reflectance_of_cosines(cosine: f32, refracted: f32, eta: f32) -> f32 {
    let parallel = (eta * cosine - refracted) / (eta * cosine + refracted);
    let perpendicular = (cosine - eta * refracted) / (cosine + eta * refracted);
    0.5 * (parallel * parallel + perpendicular * perpendicular)
}

/// Mean reflectance of a dielectric interface with far side over near side `eta`, in closed form (Walsh 1926; Duntley 1942).
pub fn dielectric_reflectance_mean(eta: f64) -> f64 {
    if (eta - 1.0).abs() < 1e-4 {
        return 0.0;
    }
    if eta < 1.0 {
        // From the dense side: n² (1 − F_in) = 1 − F_out.
        return 1.0 - (1.0 - dielectric_reflectance_mean(1.0 / eta)) * eta * eta;
    }
    let n = eta;
    let n2 = n * n;
    let n4 = n2 * n2;
    let sum = n2 + 1.0;
    let difference = n2 - 1.0;
    let quartic = n4 - 1.0;
    0.5 + (n - 1.0) * (3.0 * n + 1.0) / (6.0 * (n + 1.0) * (n + 1.0))
        + n2 * difference * difference / (sum * sum * sum) * libm::log((n - 1.0) / (n + 1.0))
        - 2.0 * n * n2 * (n2 + 2.0 * n - 1.0) / (sum * quartic)
        + 8.0 * n4 * (n4 + 1.0) / (sum * quartic * quartic) * libm::log(n)
}

/// Unpolarised reflectance of a metal with complex index `eta` + i `k` (one channel) seen from vacuum.
#[inline(always)]
pub fn conductor_reflectance(cosine: f32, eta: f32, k: f32) -> f32 {
    // Exact: Born and Wolf, Principles of Optics, in the real form of de Greve.
    let cosine = cosine.clamp(0.0, 1.0);
    let cosine2 = cosine * cosine;
    let sine2 = 1.0 - cosine2;
    let difference = eta * eta - k * k - sine2;
    let modulus = (difference * difference + 4.0 * eta * eta * k * k).sqrt();
    let real = (0.5 * (modulus + difference)).max(0.0).sqrt();
    let perpendicular = (modulus + cosine2 - 2.0 * cosine * real) / (modulus + cosine2 + 2.0 * cosine * real);
    let far = cosine2 * modulus + sine2 * sine2;
    let mixed = 2.0 * cosine * sine2 * real;
    let parallel = perpendicular * (far - mixed) / (far + mixed);
    (0.5 * (perpendicular + parallel)).clamp(0.0, 1.0)
}

/// Mean reflectance of a metal (one channel), by five-point Gauss–Legendre quadrature.
pub fn conductor_reflectance_mean(eta: f32, k: f32) -> f32 {
    const NODES: [(f32, f32); 5] = [
        (0.046_910_08, 0.118_463_44),
        (0.230_765_34, 0.239_314_33),
        (0.5, 0.284_444_45),
        (0.769_234_66, 0.239_314_33),
        (0.953_089_9, 0.118_463_44),
    ];
    NODES.iter().map(|&(cosine, weight)| 2.0 * weight * cosine * conductor_reflectance(cosine, eta, k)).sum()
}

/// Schlick's weight (1 − cos θ)⁵.
pub(super) fn schlick_weight(cosine: f32) -> f32 {
    let below_one = (1.0 - cosine).clamp(0.0, 1.0);
    let square = below_one * below_one;
    square * square * below_one
}

/// Schlick 1994: `f0` at normal incidence rising to `f90` at grazing.
pub fn schlick_reflectance(cosine: f32, f0: Rgb, f90: f32) -> Rgb {
    f0.lerp(Rgb::gray(f90), schlick_weight(cosine))
}

/// Mean of Schlick's formula: f0 + (f90 − f0) / 21.
pub fn schlick_reflectance_mean(f0: Rgb, f90: f32) -> Rgb {
    f0.lerp(Rgb::gray(f90), 1.0 / 21.0)
}

#[cfg(test)]
mod tests;
