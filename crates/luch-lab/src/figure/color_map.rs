//! From a number between 0 and 1 to a colour.

use serde::{Deserialize, Serialize};

/// A row of colours. Lightness grows along [`Night`](Self::Night) and [`Gray`](Self::Gray), so that order is seen without colour vision too.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ColorMap {
    /// From dark blue over violet and orange to light yellow.
    #[default]
    Night,
    /// From blue over white to vermilion: for what has a sign.
    Signed,
    /// From black to white.
    Gray,
    /// From white to black: ink on paper.
    Paper,
}

impl ColorMap {
    /// The colour at a fraction, which is cut to 0 … 1; red, green, blue in sRGB.
    pub fn color(self, fraction: f64) -> [u8; 3] {
        let fraction = if fraction.is_nan() { 0.0 } else { fraction.clamp(0.0, 1.0) };
        let stops: &[[f64; 3]] = match self {
            // Chosen by eye, with even steps of lightness.
            Self::Night => &[
                [11.0, 12.0, 38.0],
                [43.0, 26.0, 96.0],
                [98.0, 31.0, 122.0],
                [156.0, 44.0, 113.0],
                [208.0, 72.0, 85.0],
                [240.0, 120.0, 60.0],
                [250.0, 178.0, 74.0],
                [250.0, 233.0, 160.0],
            ],
            Self::Signed => &[
                [0.0, 62.0, 110.0],
                [0.0, 114.0, 178.0],
                [126.0, 182.0, 218.0],
                [244.0, 244.0, 242.0],
                [240.0, 170.0, 116.0],
                [213.0, 94.0, 0.0],
                [128.0, 48.0, 0.0],
            ],
            Self::Gray => &[[0.0; 3], [255.0; 3]],
            Self::Paper => &[[255.0; 3], [20.0; 3]],
        };
        let place = fraction * (stops.len() - 1) as f64;
        let at = (place as usize).min(stops.len() - 2);
        let rest = place - at as f64;
        std::array::from_fn(|c| (stops[at][c] + (stops[at + 1][c] - stops[at][c]) * rest).round() as u8)
    }
}
