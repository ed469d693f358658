//! The tables against finer integrals, and the lobes against their laws.

use super::*;

#[test]
fn reading_between_the_lines() {
    let fine = VisibleNormals::new(48);
    for ior in [1.1, 1.33, 1.5, 2.4] {
        for roughness in [0.05, 0.22, 0.5, 1.0] {
            let interface = CompensatedInterface::new(ior, roughness).expect("rough");
            for (side, eta) in [(RARE, ior), (DENSE, 1.0 / ior)] {
                for step in 0..20 {
                    let root = 0.05 + 0.95 * (step as f32 + 0.5) / 20.0;
                    let known = missing(&fine, interface.ggx, root * root, eta);
                    let difference = interface.missing(side, root * root) - known;
                    assert!(
                        difference.abs() < 0.01,
                        "ior {ior}, roughness {roughness}, side {side}, √μ {root}: off by {difference}"
                    );
                }
            }
        }
    }
}

#[test]
fn what_is_lost_comes_back() {
    for ior in [0.5, 0.75, 1.1, 1.5, 3.0] {
        for roughness in [0.1, 0.5, 1.0] {
            let interface = CompensatedInterface::new(ior, roughness).expect("rough");
            let (out, back) = (interface.outward(), interface.inward());
            for crossing in [out, back] {
                let total = crossing.same * interface.lost[crossing.near]
                    + crossing.across * interface.lost[crossing.far];
                assert!((total - 1.0).abs() < 1e-4, "ior {ior}, roughness {roughness}: {total}");
                assert!((0.0..=1.0).contains(&crossing.probability));
                assert!(crossing.same >= 0.0 && crossing.across >= 0.0);
            }
            // ĉ_ab η_a² = ĉ_ba η_b².
            let ratio = out.across / (back.across * ior * ior);
            assert!((ratio - 1.0).abs() < 1e-4, "ior {ior}: {ratio}");
        }
    }
}

#[test]
fn smooth_has_none() {
    assert!(CompensatedInterface::new(1.5, 0.0).is_none());
}
