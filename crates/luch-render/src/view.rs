//! How a pixel and an index become a ray: camera, size, filter, sequence and seed.

use crate::cone::Cone;
use crate::film::BUNDLE;
use crate::filter::FilterSampler;
use crate::purpose;
use glam::Vec2;
use luch_bvh::Ray;
use luch_sampling::warp::disc;
use luch_sampling::{Sampler, Sequence};
use luch_scene::{Camera, Projection, Settings};

/// Everything that turns a pixel into rays. It is not part of the [`World`](crate::World), so turning the camera costs a new
/// film and nothing else; only where a scene culls back faces, its world is made for the scene's own cameras.
#[derive(Debug)]
pub struct View {
    camera: Camera,
    width: u32,
    height: u32,
    filter: FilterSampler,
    sequence: Sequence,
    seed: u64,
    /// Half the height of the picture plane: at distance 1, or in metres if rays are parallel.
    half_height: f32,
}

/// A ray into the scene and the random numbers of everything that follows.
#[derive(Clone, Copy, Debug)]
pub struct CameraSample {
    /// From the lens, with unit direction.
    pub ray: Ray,
    /// How wide the ray is: as a pixel.
    pub cone: Cone,
    /// The numbers of this sample.
    pub sampler: Sampler,
    /// The numbers of this sample where its bundle works together: points of one sequence that all of the bundle share, so that
    /// together they are as even as the samples of one pixel.
    pub together: Sampler,
    /// Samples that follow one another with the same number are a bundle: the pixels of a small block, with one index.
    pub bundle: u32,
}

impl View {
    /// What `camera` sees, by the settings' size, filter, sequence and seed.
    pub fn new(camera: &Camera, settings: &Settings) -> Self {
        let half_height = match camera.projection {
            Projection::Perspective { field_of_view_y } => libm::tanf(field_of_view_y / 2.0),
            Projection::Orthographic { height } => height / 2.0,
        };
        Self {
            camera: *camera,
            width: settings.width,
            height: settings.height,
            filter: FilterSampler::new(settings.filter),
            sequence: settings.sequence,
            seed: settings.seed,
            half_height,
        }
    }

    /// The camera.
    pub fn camera(&self) -> &Camera {
        &self.camera
    }

    /// Pixels in a row.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Rows.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// Sample `index` of a pixel.
    pub fn start(&self, pixel: [u32; 2], index: u64) -> CameraSample {
        let sampler = Sampler::at(self.sequence, self.seed, pixel, index);
        let [x, y, lens_u, lens_v] = sampler.group(purpose::CAMERA);
        let column = pixel[0] as f32 + 0.5 + self.filter.offset(x);
        let row = pixel[1] as f32 + 0.5 + self.filter.offset(y);
        let ray = self.ray(Vec2::new(column, row), [lens_u, lens_v]);
        CameraSample { ray, cone: self.cone(), sampler, together: sampler, bundle: 0 }
    }

    /// What a pixel covers, in the middle of the picture.
    fn cone(&self) -> Cone {
        let pixel = 2.0 * self.half_height / self.height as f32;
        match self.camera.projection {
            Projection::Perspective { .. } => Cone { width: 0.0, spread: pixel },
            Projection::Orthographic { .. } => Cone { width: pixel, spread: 0.0 },
        }
    }

    /// Sample `index` of all pixels of the bundle that `pixel` belongs to, row by row.
    pub fn bundle(&self, pixel: [u32; 2], index: u64) -> Vec<CameraSample> {
        let corner = pixel.map(|place| place - place % BUNDLE);
        let end = [(corner[0] + BUNDLE).min(self.width), (corner[1] + BUNDLE).min(self.height)];
        let size = (end[0] - corner[0]) * (end[1] - corner[1]);
        let pixels = (corner[1]..end[1]).flat_map(|y| (corner[0]..end[0]).map(move |x| [x, y]));
        (0..)
            .zip(pixels)
            .map(|(lane, pixel)| self.start_bundled(pixel, index, 0, corner, [lane, size]))
            .collect()
    }

    /// Sample `index` of a pixel that is number `lane` of `size` in the bundle of that number; `corner` is the first pixel of
    /// the bundle.
    pub fn start_bundled(
        &self,
        pixel: [u32; 2],
        index: u64,
        bundle: u32,
        corner: [u32; 2],
        [lane, size]: [u32; 2],
    ) -> CameraSample {
        /// Sets the sequences of bundles apart from those of pixels.
        const BUNDLES: u64 = 0x6275_6e64_6c65;
        // The stream stays the sample's own: its lowest bit.
        let within = (index >> 1).wrapping_mul(u64::from(size)).wrapping_add(u64::from(lane));
        let together = Sampler::at(self.sequence, self.seed ^ BUNDLES, corner, (within << 1) | (index & 1));
        CameraSample { together, bundle, ..self.start(pixel, index) }
    }

    /// The ray through a place of the picture, in pixels from its upper left corner; `lens` in the unit square.
    pub fn ray(&self, place: Vec2, lens: [f32; 2]) -> Ray {
        let scale = 2.0 * self.half_height / self.height as f32;
        let x = (place.x - self.width as f32 / 2.0) * scale;
        let y = (self.height as f32 / 2.0 - place.y) * scale;
        let lens =
            if self.camera.lens_radius > 0.0 { disc(lens) * self.camera.lens_radius } else { Vec2::ZERO };
        // In the camera's own axes: from the lens to the point that is sharp, as slopes against the viewing axis.
        let tilt = lens / self.camera.focus_distance;
        let (start, slope) = match self.camera.projection {
            Projection::Perspective { .. } => (lens, Vec2::new(x, y) - tilt),
            Projection::Orthographic { .. } => (Vec2::new(x, y) + lens, -tilt),
        };
        let start = start.extend(0.0);
        let direction = (self.camera.orientation * slope.extend(-1.0)).normalize();
        Ray::new(self.camera.position + self.camera.orientation * start, direction)
    }
}
