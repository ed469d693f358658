//! The tables against published and finer integrals.

use super::*;

fn lobe(alpha: f32) -> CompensatedGgx {
    CompensatedGgx::from_roughness(alpha.sqrt()).expect("rough")
}

#[test]
fn albedo_of_a_single_bounce() {
    // Height-correlated masking, reflectance 1: cosines 0.1, 0.25, 0.5, 0.75, 1 and the mean.
    let known = [
        (0.1, [0.88346, 0.92162, 0.96920, 0.98314, 0.98831], 0.97205),
        (0.25, [0.89162, 0.84008, 0.85726, 0.89153, 0.91580], 0.88232),
        (0.5, [0.86011, 0.76520, 0.69825, 0.68208, 0.68785], 0.70024),
        (0.75, [0.81071, 0.68025, 0.56462, 0.50141, 0.46391], 0.53630),
        (1.0, [0.76021, 0.59764, 0.45070, 0.36453, 1.0 - std::f32::consts::LN_2], 0.40914),
    ];
    for (alpha, row, mean) in known {
        let lobe = lobe(alpha);
        for (cosine, albedo) in [0.1, 0.25, 0.5, 0.75, 1.0].into_iter().zip(row) {
            let difference = 1.0 - lobe.missing(cosine) - albedo;
            assert!(difference.abs() < 1e-3, "alpha {alpha}, cosine {cosine}: off by {difference}");
        }
        let difference = 1.0 - lobe.missing_mean() - mean;
        assert!(difference.abs() < 1e-3, "alpha {alpha}: mean off by {difference}");
    }
}

#[test]
fn reading_between_the_lines() {
    let fine = VisibleNormals::new(64);
    for alpha in [0.001, 0.0023, 0.01, 0.09, 0.2, 0.43, 0.77, 1.0] {
        let lobe = lobe(alpha);
        for step in 0..40 {
            let root = (step as f32 + 0.5) / 40.0;
            let bounce = single_bounce(&fine, lobe.ggx, root * root);
            let albedo = 1.0 - lobe.missing(root * root) - bounce.albedo;
            let grazing = lobe.bounce(root * root).grazing - bounce.grazing;
            // Within a thousandth of a radian of the horizon the slope is infinite.
            let limit = if root < 0.05 { 5e-3 } else { 1.5e-3 };
            assert!(albedo.abs() < limit, "alpha {alpha}, √μ {root}: albedo off by {albedo}");
            assert!(grazing.abs() < 5e-3, "alpha {alpha}, √μ {root}: grazing part off by {grazing}");
        }
    }
}

#[test]
fn a_smooth_mirror_loses_nothing() {
    let lobe = lobe(0.001);
    assert!(lobe.missing_mean() < 1e-4);
    // Schlick's mean: 1/21.
    assert!((lobe.bounce_mean().grazing - 1.0 / 21.0).abs() < 1e-3);
}

#[test]
fn columns_are_inverted() {
    for alpha in [0.001, 0.1, 1.0] {
        for index in 0..SIZE {
            let column = Column::at_cosine(Column::cosine(index, alpha), alpha);
            let position = column.index as f32 + column.weight;
            assert!((position - index as f32).abs() < 1e-3, "alpha {alpha}: {position} for {index}");
        }
    }
}
