use super::*;

fn near(curve: Curve, light: f32, expected: f64, tolerance: f64) {
    let shown = curve.apply(Rgb::gray(light));
    for channel in shown.to_array() {
        assert!(
            (f64::from(channel) - expected).abs() < tolerance,
            "{curve} of {light}: {channel}, not {expected}"
        );
    }
}

/// The published formulas worked out by hand in exact fractions or double precision.
#[test]
fn published_values() {
    near(Curve::Linear, 0.25, 0.25, 1e-9);
    // L (1 + L/16) / (1 + L)
    near(Curve::Reinhard, 1.0, 17.0 / 32.0, 1e-6);
    near(Curve::Reinhard, 4.0, 1.0, 1e-6);
    // White of the paper: 11.2 through exposure bias 2.
    near(Curve::Hable, 5.6, 1.0, 1e-6);
    near(Curve::Hable, 0.0, 0.0, 1e-7);
    // curve(2) = (2·0.35 + 0.004)/(2·0.8 + 0.06) − 1/15; curve(11.2) = (11.2·1.73 + 0.004)/(11.2·2.18 + 0.06) − 1/15
    near(Curve::Hable, 1.0, (0.704 / 1.66 - 1.0 / 15.0) / (19.38 / 24.476 - 1.0 / 15.0), 1e-6);
    // (1.0245786 − 0.000090537) / (0.983729 + 0.432951 + 0.238081); the matrices keep gray to four digits.
    near(Curve::AcesFitted, 1.0, 1.024_488_063 / 1.654_761, 3e-4);
    // Middle gray is log2 0.18 = −2.473931 stops, 0.6060606 of the range; the polynomial, to the power 2.2. The rows of the
    // published inset sum to 1 within 1.4e-4.
    near(Curve::Agx, 0.18, agx_by_hand(0.606_060_6), 1e-4);
    near(Curve::Agx, 1e6, 1.0, 0.015);
    // Below 0.08 only 6.25 x² is left; above, 0.04 less; beyond the start of compression 1 − d²/(p + d − s).
    near(Curve::PbrNeutral, 0.04, 0.01, 1e-6);
    near(Curve::PbrNeutral, 0.5, 0.46, 1e-6);
    near(Curve::PbrNeutral, 1.0, 1.0 - 0.24 * 0.24 / (0.96 + 0.24 - 0.76), 1e-6);
}

fn agx_by_hand(x: f64) -> f64 {
    let terms = [-0.00232, 0.1191 * x, 0.4298 * x * x, -6.868 * x * x * x, 31.96 * x * x * x * x];
    let high = x * x * x * x * x * (15.5 * x - 40.14);
    libm::pow(terms.iter().sum::<f64>() + high, 2.2)
}

#[test]
fn gray_never_gets_darker_with_more_light() {
    for curve in Curve::ALL {
        let mut before = -1.0;
        for step in 0..4000 {
            // 2^-16 to 2^16, four thousand steps
            let light = libm::exp2f(-16.0 + step as f32 * 0.008);
            let shown = curve.apply(Rgb::gray(light));
            assert!(shown.g >= before - 1e-6, "{curve}: {light} gives {} after {before}", shown.g);
            assert!(
                (shown.r - shown.g).abs() < 1e-3 && (shown.b - shown.g).abs() < 1e-3,
                "{curve} tints gray"
            );
            before = shown.g;
        }
        assert!(before > 0.98, "{curve} ends at {before}");
    }
}

#[test]
fn any_light_gives_a_color_between_0_and_1() {
    let values = [0.0, -1.0, 1e-30, 0.5, 7.0, 3e38, f32::INFINITY, f32::NEG_INFINITY, f32::NAN];
    for curve in Curve::ALL {
        for r in values {
            for g in values {
                for b in values {
                    let shown = Tone { exposure: 3.0, curve }.apply(Rgb::new(r, g, b));
                    for channel in shown.to_array() {
                        assert!((0.0..=1.0).contains(&channel), "{curve} of {r}, {g}, {b}: {shown:?}");
                    }
                }
            }
        }
    }
}

#[test]
fn exposure_counts_stops() {
    let tone = Tone { exposure: -2.0, curve: Curve::Linear };
    assert_eq!(tone.apply(Rgb::new(1.0, 2.0, 8.0)), Rgb::new(0.25, 0.5, 1.0));
}

#[test]
fn names_lead_back() {
    for curve in Curve::ALL {
        assert_eq!(Curve::from_name(curve.name()), Some(curve));
    }
    assert_eq!(Curve::from_name("filmic"), None);
}

#[test]
fn dithering_keeps_the_mean_and_the_extremes() {
    let tone = Tone::default();
    // Between the bytes 100 and 101, at 0.3.
    let light = srgb::decode(100.3 / 255.0);
    let image = Image::filled(200, 200, Rgb::gray(light));
    let dithered = tone.to_u8_dithered(&image);
    let values: Vec<u8> = dithered.pixels().as_flattened().to_vec();
    assert!(values.iter().all(|v| (100..=101).contains(v)));
    // 120 000 coins of 0.3: standard error 0.0013.
    let mean = values.iter().map(|&v| f64::from(v)).sum::<f64>() / values.len() as f64;
    assert!((mean - 100.3).abs() < 4.0 * 0.0014, "{mean}");
    assert_eq!(dithered, tone.to_u8_dithered(&image));
    for (light, byte) in [(0.0, 0), (1.0, 255)] {
        let flat = tone.to_u8_dithered(&Image::filled(64, 64, Rgb::gray(light)));
        assert!(flat.pixels().as_flattened().iter().all(|&v| v == byte));
    }
}
