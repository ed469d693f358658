//! A rectangle of pixels of any kind.

/// Pixels in rows, the first row on top.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Image<P> {
    width: u32,
    height: u32,
    pixels: Vec<P>,
}

impl<P: Clone> Image<P> {
    /// An image of one value.
    pub fn filled(width: u32, height: u32, value: P) -> Self {
        Self { width, height, pixels: vec![value; width as usize * height as usize] }
    }
}

impl<P> Image<P> {
    /// An image from its rows, top row first; `None` if the count of pixels is not `width · height`.
    pub fn from_pixels(width: u32, height: u32, pixels: Vec<P>) -> Option<Self> {
        (pixels.len() == width as usize * height as usize).then_some(Self { width, height, pixels })
    }

    /// Pixels in a row.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Rows.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// All pixels, row by row from the top.
    pub fn pixels(&self) -> &[P] {
        &self.pixels
    }

    /// All pixels, to be changed in place.
    pub fn pixels_mut(&mut self) -> &mut [P] {
        &mut self.pixels
    }

    /// The pixel in column `x` of row `y`.
    ///
    /// # Panics
    /// If the place is outside the image.
    pub fn get(&self, x: u32, y: u32) -> &P {
        assert!(
            x < self.width && y < self.height,
            "pixel ({x}, {y}) is outside {}×{}",
            self.width,
            self.height
        );
        &self.pixels[y as usize * self.width as usize + x as usize]
    }

    /// The image with `f` applied to each pixel.
    pub fn map<Q>(&self, f: impl FnMut(&P) -> Q) -> Image<Q> {
        Image { width: self.width, height: self.height, pixels: self.pixels.iter().map(f).collect() }
    }
}
