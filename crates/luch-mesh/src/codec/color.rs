//! Colours as files code them.

/// The sRGB transfer curve (IEC 61966-2-1).
pub(super) fn srgb_to_linear(stored: f32) -> f32 {
    if stored <= 0.04045 { stored / 12.92 } else { libm::powf((stored + 0.055) / 1.055, 2.4) }
}
