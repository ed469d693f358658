//! Named planes of numbers: what a render holds besides its colour.

use crate::{Image, Rgb};

/// Layers of one size: beauty, albedo, normals, depth, errors, sample counts.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Layers {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// The layers.
    pub layers: Vec<Layer>,
}

/// One named group of channels.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Layer {
    /// Name, `""` for the picture itself (channels `R`, `G`, `B`); `albedo` makes `albedo.R` and so on.
    pub name: String,
    /// Channels by name (`R`, `X`, `Z`, `N`), each with one number a pixel, top row first.
    pub channels: Vec<(String, Vec<f32>)>,
}

impl Layer {
    /// A layer of the channels `R`, `G`, `B`.
    pub fn from_rgb(name: impl Into<String>, image: &Image<Rgb>) -> Self {
        let plane = |channel: fn(&Rgb) -> f32| image.pixels().iter().map(channel).collect();
        let channels = vec![
            ("R".to_owned(), plane(|p| p.r)),
            ("G".to_owned(), plane(|p| p.g)),
            ("B".to_owned(), plane(|p| p.b)),
        ];
        Self { name: name.into(), channels }
    }

    /// A layer of one channel.
    pub fn from_plane(name: impl Into<String>, channel: impl Into<String>, plane: Vec<f32>) -> Self {
        Self { name: name.into(), channels: vec![(channel.into(), plane)] }
    }

    /// The numbers of a channel.
    pub fn channel(&self, name: &str) -> Option<&[f32]> {
        self.channels.iter().find(|channel| channel.0 == name).map(|channel| channel.1.as_slice())
    }
}

impl Layers {
    /// The layer of a name.
    pub fn layer(&self, name: &str) -> Option<&Layer> {
        self.layers.iter().find(|layer| layer.name == name)
    }

    /// A layer's channels `R`, `G`, `B` (or `X`, `Y`, `Z`) as one image; `None` if the layer or a channel is missing
    /// or of another size.
    pub fn rgb(&self, name: &str) -> Option<Image<Rgb>> {
        let layer = self.layer(name)?;
        let find = |names: [&str; 2]| names.iter().find_map(|name| layer.channel(name));
        let (r, g, b) = (find(["R", "X"])?, find(["G", "Y"])?, find(["B", "Z"])?);
        let pixels = r.iter().zip(g).zip(b).map(|((&r, &g), &b)| Rgb::new(r, g, b)).collect();
        Image::from_pixels(self.width, self.height, pixels)
    }
}
