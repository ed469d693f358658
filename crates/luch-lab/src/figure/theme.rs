//! Colours: those of Okabe and Ito ("Color Universal Design", 2008), told apart by all kinds of colour vision.

use serde::{Deserialize, Serialize};

/// Light or dark ground.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Theme {
    /// Dark ink on white.
    #[default]
    Light,
    /// Light ink on near-black.
    Dark,
}

/// The colour of a layer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Ink {
    /// Blue, the first choice.
    #[default]
    Blue,
    /// Vermilion.
    Vermilion,
    /// Bluish green.
    Green,
    /// Reddish purple.
    Purple,
    /// Orange.
    Orange,
    /// Sky blue.
    Sky,
    /// Yellow; on light ground only for areas.
    Yellow,
    /// That of the text: black or nearly white.
    Text,
    /// That of what explains: gray.
    Muted,
}

impl Ink {
    /// Those for series, in the order in which they should be taken.
    pub const SERIES: [Self; 8] = [
        Self::Blue,
        Self::Vermilion,
        Self::Green,
        Self::Purple,
        Self::Orange,
        Self::Sky,
        Self::Text,
        Self::Yellow,
    ];

    /// An ink for each number; they repeat after eight.
    pub const fn of(index: usize) -> Self {
        Self::SERIES[index % Self::SERIES.len()]
    }

    /// Red, green and blue in sRGB. On dark ground the deep ones are a little lighter.
    pub const fn color(self, theme: Theme) -> [u8; 3] {
        let [light, dark] = match self {
            Self::Blue => [[0x00, 0x72, 0xb2], [0x2f, 0x93, 0xd4]],
            Self::Vermilion => [[0xd5, 0x5e, 0x00], [0xe8, 0x74, 0x20]],
            Self::Green => [[0x00, 0x9e, 0x73], [0x1f, 0xb5, 0x8a]],
            Self::Purple => [[0xcc, 0x79, 0xa7], [0xd8, 0x8b, 0xb6]],
            Self::Orange => [[0xe6, 0x9f, 0x00], [0xe6, 0x9f, 0x00]],
            Self::Sky => [[0x56, 0xb4, 0xe9], [0x84, 0xcd, 0xf5]],
            Self::Yellow => [[0xf0, 0xe4, 0x42], [0xf0, 0xe4, 0x42]],
            Self::Text => [[0x1b, 0x1f, 0x24], [0xe8, 0xea, 0xed]],
            Self::Muted => [[0x63, 0x6b, 0x74], [0x9b, 0xa3, 0xad]],
        };
        match theme {
            Theme::Light => light,
            Theme::Dark => dark,
        }
    }
}

/// What is to be coloured.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Paint {
    Ink(Ink),
    Ground,
    Panel,
    Grid,
    Frame,
}

impl Paint {
    pub(super) const fn color(self, theme: Theme) -> [u8; 3] {
        let [light, dark] = match self {
            Self::Ink(ink) => return ink.color(theme),
            Self::Ground => [[0xff; 3], [0x16, 0x18, 0x1d]],
            Self::Panel => [[0xfa, 0xfb, 0xfc], [0x1c, 0x1f, 0x25]],
            Self::Grid => [[0xe6, 0xe9, 0xed], [0x2e, 0x33, 0x3b]],
            Self::Frame => [[0xb4, 0xba, 0xc2], [0x5a, 0x62, 0x6d]],
        };
        match theme {
            Theme::Light => light,
            Theme::Dark => dark,
        }
    }

    /// The name of its class in SVG.
    pub(super) const fn class(self) -> &'static str {
        match self {
            Self::Ink(ink) => match ink {
                Ink::Blue => "blue",
                Ink::Vermilion => "vermilion",
                Ink::Green => "green",
                Ink::Purple => "purple",
                Ink::Orange => "orange",
                Ink::Sky => "sky",
                Ink::Yellow => "yellow",
                Ink::Text => "text",
                Ink::Muted => "muted",
            },
            Self::Ground => "ground",
            Self::Panel => "panel",
            Self::Grid => "grid",
            Self::Frame => "frame",
        }
    }

    pub(super) const ALL: [Self; 13] = [
        Self::Ink(Ink::Blue),
        Self::Ink(Ink::Vermilion),
        Self::Ink(Ink::Green),
        Self::Ink(Ink::Purple),
        Self::Ink(Ink::Orange),
        Self::Ink(Ink::Sky),
        Self::Ink(Ink::Yellow),
        Self::Ink(Ink::Text),
        Self::Ink(Ink::Muted),
        Self::Ground,
        Self::Panel,
        Self::Grid,
        Self::Frame,
    ];
}
