//! What an EXR holds besides the picture: properties of what is seen, the error, the number of samples.

use crate::failure::Failure;
use luch::image::codec::Layer;
use luch::image::{Image, Rgb};
use luch::render::{Film, Goal, Inspect, JobPlan, RenderJob, View, World};
use luch::scene::Property;
use std::str::FromStr;
use std::sync::Arc;
use std::time::Duration;

/// Samples of a pixel in a layer of a property.
const SAMPLES: u64 = 16;

/// Longer than any work takes, and still a moment that clocks know.
pub(crate) const NEVER: Duration = Duration::from_secs(366 * 86400);

/// The same when somebody waits for the end.
const HASTY_SAMPLES: u64 = 1;

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

    /// The layer read from the film itself; `None` for properties, which need films of their own.
    pub(crate) fn of_film(self, film: &Film) -> Option<Layer> {
        match self {
            Self::StandardError => Some(Layer::from_rgb("stderr", &film.standard_error())),
            Self::Samples => Some(Layer::from_plane("samples", "N", film.sample_counts().pixels().to_vec())),
            Self::None | Self::Property(_) => None,
        }
    }
}

/// Renders the layers of properties; few samples if somebody waits.
pub(crate) fn render_properties(
    world: &Arc<World>,
    view: &Arc<View>,
    choices: &[LayerChoice],
    threads: Option<usize>,
    hasty: bool,
) -> Result<Vec<Layer>, Failure> {
    let properties = choices.iter().filter_map(|choice| match choice {
        LayerChoice::Property(property) => Some(*property),
        _ => None,
    });
    properties
        .map(|property| {
            let plan = JobPlan {
                world: Arc::clone(world),
                view: Arc::clone(view),
                integrator: Box::new(Inspect::new(property, view)),
                film: Film::new(view.width(), view.height()),
                goal: Goal::samples(if hasty { HASTY_SAMPLES } else { SAMPLES }),
                threads,
                snapshot_every: NEVER,
                on_snapshot: Box::new(|_, _| ()),
            };
            Ok(property_layer(property, &RenderJob::start(plan)?.join().film.to_image()))
        })
        .collect()
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
