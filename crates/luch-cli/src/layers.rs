//! What an EXR holds besides the picture: properties of what is seen, the error, the number of samples.

use crate::failure::Failure;
use crate::interrupt::Pen;
use luch::image::codec::Layer;
use luch::image::{Image, Rgb};
use luch::render::{Film, Goal, Inspect, JobPlan, RenderJob, View, World};
use luch::scene::Property;
use std::str::FromStr;
use std::sync::Arc;
use std::time::Duration;

/// Samples of a pixel in a layer of a property.
const THOROUGH_SAMPLES: u64 = 16;

/// The same in a sketch.
const QUICK_SAMPLES: u64 = 1;

/// Time between two looks at a job.
const LOOK: Duration = Duration::from_millis(2);

/// Longer than any work takes, and still a moment that clocks know.
pub(crate) const NEVER: Duration = Duration::from_secs(366 * 86400);

/// One layer that can be asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum LayerChoice {
    /// No layers at all.
    None,
    /// Standard error of each pixel: channels R, G, B.
    StandardError,
    /// Samples of each pixel: channel N.
    Samples,
    /// A property of the surface seen.
    Property(Property),
}

impl FromStr for LayerChoice {
    type Err = String;

    fn from_str(name: &str) -> Result<Self, String> {
        match name {
            "none" => Ok(Self::None),
            "stderr" => Ok(Self::StandardError),
            "samples" => Ok(Self::Samples),
            _ => Property::from_name(name).map(Self::Property).ok_or_else(|| {
                let names = Property::ALL.map(Property::name).join(", ");
                format!("`{name}` is no layer; accepted are stderr, samples, {names}, none")
            }),
        }
    }
}

impl LayerChoice {
    /// What is written unless something else is asked for.
    pub(crate) const USUAL: [Self; 5] = [
        Self::Property(Property::Albedo),
        Self::Property(Property::Normal),
        Self::Property(Property::Depth),
        Self::StandardError,
        Self::Samples,
    ];

    /// The property, if it is one.
    pub(crate) fn property(self) -> Option<Property> {
        match self {
            Self::Property(property) => Some(property),
            Self::None | Self::StandardError | Self::Samples => None,
        }
    }

    /// The layer read from the film itself; `None` for properties, which need films of their own.
    pub(crate) fn of_film(self, film: &Film) -> Option<Layer> {
        match self {
            Self::StandardError => Some(Layer::from_rgb("stderr", &film.standard_error())),
            Self::Samples => Some(Layer::from_plane("samples", "N", film.sample_counts().pixels().to_vec())),
            Self::None | Self::Property(_) => None,
        }
    }
}

/// What layers of properties are rendered from.
pub(crate) struct PropertyStudio {
    pub(crate) world: Arc<World>,
    pub(crate) view: Arc<View>,
    pub(crate) threads: Option<usize>,
    pub(crate) properties: Vec<Property>,
}

/// How much time a layer may take.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Care {
    /// One sample: a sketch to have something at once.
    Quick,
    /// Smooth edges.
    Thorough,
}

impl PropertyStudio {
    /// Renders the layers; `None` if the end was asked for meanwhile.
    pub(crate) fn render(&self, care: Care, pen: &Pen) -> Result<Option<Vec<Layer>>, Failure> {
        let samples = match care {
            Care::Quick => QUICK_SAMPLES,
            Care::Thorough => THOROUGH_SAMPLES,
        };
        let mut layers = Vec::new();
        for property in &self.properties {
            let job = RenderJob::start(JobPlan {
                world: Arc::clone(&self.world),
                view: Arc::clone(&self.view),
                integrator: Box::new(Inspect::new(*property, &self.view)),
                film: Film::new(self.view.width(), self.view.height()),
                goal: Goal::samples(samples),
                threads: self.threads,
                snapshot_every: NEVER,
                on_snapshot: Box::new(|_, _| ()),
            })?;
            while !job.is_finished() {
                if pen.is_interrupted() {
                    return Ok(None);
                }
                std::thread::sleep(LOOK);
            }
            layers.push(property_layer(*property, &job.join().film.to_image()));
        }
        Ok(Some(layers))
    }
}

/// Vectors have the channels X, Y, Z, depth has Z, colours have R, G, B.
fn property_layer(property: Property, image: &Image<Rgb>) -> Layer {
    let plane = |channel: fn(&Rgb) -> f32| image.pixels().iter().map(channel).collect::<Vec<f32>>();
    let name = property.name();
    match property {
        Property::Depth => Layer::from_plane(name, "Z", plane(|p| p.r)),
        Property::Normal | Property::GeometricNormal => {
            let channels = vec![
                ("X".to_owned(), plane(|p| p.r)),
                ("Y".to_owned(), plane(|p| p.g)),
                ("Z".to_owned(), plane(|p| p.b)),
            ];
            Layer { name: name.to_owned(), channels }
        }
        _ => Layer::from_rgb(name, image),
    }
}
