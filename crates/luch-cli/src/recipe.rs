//! Everything that shapes a picture besides the scene file: kept as JSON in films and pictures, so that work can be
//! resumed and results reproduced.

use crate::args::{DisplayArgs, PictureArgs};
use crate::failure::Failure;
use crate::parse::{self, IntegratorChoice, Size};
use luch::image::tone::Tone;
use luch::render::Goal;
use luch::scene::{Camera, Integrator, Normals, Scene, Settings};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::time::Duration;

/// How a picture is made and shown, in words that people can read.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Recipe {
    size: String,
    /// `None` for the first camera.
    camera: Option<String>,
    integrator: String,
    sequence: String,
    filter: String,
    seed: u64,
    normals: String,
    cull_back_faces: bool,
    texture_filter: String,
    exposure: f32,
    tone: String,
    /// Values for what the scene leaves open.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub(crate) parameters: BTreeMap<String, String>,
    /// When it was to be done.
    pub(crate) goal: GoalWords,
}

/// A goal in words.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct GoalWords {
    /// `0..256`
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) samples: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) seconds: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) relative_error: Option<f64>,
}

impl GoalWords {
    /// True if only Ctrl-C ends the work.
    pub(crate) fn is_endless(&self) -> bool {
        *self == Self::default()
    }

    /// The goal for a job.
    pub(crate) fn to_goal(&self) -> Result<Goal, Failure> {
        let mut goal = Goal::default();
        if let Some(samples) = &self.samples {
            goal.samples = parse::samples(samples).map_err(Failure::new)?;
        }
        goal.time = self.seconds.and_then(|seconds| Duration::try_from_secs_f64(seconds).ok());
        goal.relative_error = self.relative_error;
        Ok(goal)
    }
}

impl Recipe {
    /// What a scene file says.
    pub(crate) fn of_scene(settings: &Settings, tone: &Tone) -> Self {
        Self {
            size: format!("{}x{}", settings.width, settings.height),
            camera: None,
            integrator: IntegratorChoice::from(settings.integrator).to_string(),
            sequence: settings.sequence.name().to_owned(),
            filter: parse::filter_text(settings.filter),
            seed: settings.seed,
            normals: normals_name(settings.normals).to_owned(),
            cull_back_faces: settings.cull_back_faces,
            texture_filter: settings.texture_filter.name().to_owned(),
            exposure: tone.exposure,
            tone: tone.curve.name().to_owned(),
            parameters: BTreeMap::new(),
            goal: GoalWords::default(),
        }
    }

    /// What a film or picture keeps.
    pub(crate) fn from_json(json: &str) -> Result<Self, Failure> {
        serde_json::from_str(json)
            .map_err(|error| Failure::new(format!("the options kept in the file cannot be read: {error}")))
    }

    /// One line.
    pub(crate) fn to_json(&self) -> String {
        serde_json::to_string(self).expect("plain data is always written to memory")
    }

    /// What was typed goes before what was there.
    pub(crate) fn change(&mut self, picture: &PictureArgs) -> Result<(), Failure> {
        let PictureArgs {
            size,
            seed,
            camera,
            integrator,
            max_depth,
            sequence,
            filter,
            normals,
            texture_filter,
            cull_back_faces,
        } = picture;
        if let Some(Size { width, height }) = size {
            self.size = format!("{width}x{height}");
        }
        self.seed = seed.unwrap_or(self.seed);
        if camera.is_some() {
            self.camera.clone_from(camera);
        }
        if integrator.is_some() || max_depth.is_some() {
            self.integrator = self.changed_integrator(*integrator, *max_depth)?;
        }
        if let Some(sequence) = sequence {
            self.sequence = sequence.name().to_owned();
        }
        if let Some(filter) = filter {
            self.filter = parse::filter_text(*filter);
        }
        if let Some(normals) = normals {
            self.normals = normals_name(*normals).to_owned();
        }
        if let Some(texture_filter) = texture_filter {
            self.texture_filter = texture_filter.name().to_owned();
        }
        self.cull_back_faces |= cull_back_faces;
        Ok(())
    }

    /// Exposure and curve that were typed go before what was there.
    pub(crate) fn change_display(&mut self, display: &DisplayArgs) {
        self.exposure = display.exposure.unwrap_or(self.exposure);
        if let Some(tone) = display.tone {
            self.tone = tone.name().to_owned();
        }
    }

    /// A path that says no length takes that of the path it replaces.
    fn changed_integrator(
        &self,
        typed: Option<IntegratorChoice>,
        max_depth: Option<u32>,
    ) -> Result<String, Failure> {
        let before = self.integrator()?;
        let depth = match before {
            Integrator::Path { max_depth } | Integrator::PlainPath { max_depth } => max_depth,
            _ => match Integrator::default() {
                Integrator::Path { max_depth } => max_depth,
                _ => 64,
            },
        };
        let mut chosen = typed.map_or(before, |typed| typed.with_depth(depth));
        if let Some(wanted) = max_depth {
            match &mut chosen {
                Integrator::Path { max_depth } | Integrator::PlainPath { max_depth } => *max_depth = wanted,
                other => {
                    let name = IntegratorChoice::from(*other);
                    return Err(Failure::usage(format!("--max-depth is for paths; `{name}` has no depth")));
                }
            }
        }
        Ok(IntegratorChoice::from(chosen).to_string())
    }

    fn integrator(&self) -> Result<Integrator, Failure> {
        let choice: IntegratorChoice = self.integrator.parse().map_err(Failure::new)?;
        Ok(choice.with_depth(64))
    }

    /// The settings of the rendering.
    pub(crate) fn settings(&self) -> Result<Settings, Failure> {
        let Size { width, height } = parse::size(&self.size).map_err(Failure::new)?;
        Ok(Settings {
            width,
            height,
            integrator: self.integrator()?,
            sequence: parse::sequence(&self.sequence).map_err(Failure::new)?,
            filter: parse::filter(&self.filter).map_err(Failure::new)?,
            seed: self.seed,
            normals: parse::normals(&self.normals).map_err(Failure::new)?,
            cull_back_faces: self.cull_back_faces,
            texture_filter: parse::texture_filter(&self.texture_filter).map_err(Failure::new)?,
        })
    }

    /// What differs from another recipe among the things that shape samples, such as `size is 64x64, was 32x32`.
    pub(crate) fn differences(&self, before: &Self) -> Vec<String> {
        let now = serde_json::to_value(self).unwrap_or_default();
        let before = serde_json::to_value(before).unwrap_or_default();
        let fields = now.as_object().into_iter().flatten();
        fields
            .filter(|(name, value)| {
                !["exposure", "tone", "goal"].contains(&name.as_str()) && before[*name] != **value
            })
            .map(|(name, value)| format!("{name} is {value}, was {}", before[name]))
            .collect()
    }

    /// How light becomes what a screen shows.
    pub(crate) fn tone(&self) -> Result<Tone, Failure> {
        Ok(Tone { exposure: self.exposure, curve: parse::curve(&self.tone).map_err(Failure::new)? })
    }

    /// Puts the settings into a scene and finds the camera.
    pub(crate) fn apply(&self, scene: &mut Scene) -> Result<Camera, Failure> {
        // A camera that was chosen because the file has none shows everything in any shape of picture.
        let is_framing = |scene: &Scene| {
            scene.cameras.len() == 1 && luch::formats::framing_camera(scene).0 == scene.cameras[0].camera
        };
        let reframe = is_framing(scene);
        scene.settings = self.settings()?;
        if reframe {
            scene.cameras[0].camera = luch::formats::framing_camera(scene).0;
        }
        let pixels = u64::from(scene.settings.width) * u64::from(scene.settings.height);
        let most = luch::image::codec::MAX_PIXELS;
        if pixels > most {
            return Err(Failure::new(format!(
                "a picture of {} has {pixels} pixels, at most {most} are made",
                self.size
            )));
        }
        scene.camera(self.camera.as_deref()).copied().ok_or_else(|| {
            let name = self.camera.as_deref().unwrap_or("");
            let named = |camera: &luch::scene::NamedCamera| match camera.name.as_str() {
                "" => "one without a name".to_owned(),
                name => format!("\"{name}\""),
            };
            let names: Vec<String> = scene.cameras.iter().map(named).collect();
            Failure::new(format!("there is no camera \"{name}\" in the scene; it has {}", names.join(", ")))
        })
    }
}

fn normals_name(normals: Normals) -> &'static str {
    match normals {
        Normals::Flat => "flat",
        Normals::Interpolated => "smooth",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use luch::scene::Filter;

    #[test]
    fn settings_survive_as_json() {
        let settings = Settings {
            width: 33,
            height: 7,
            integrator: Integrator::Occlusion { distance: f32::INFINITY },
            sequence: luch::sampling::Sequence::Halton,
            filter: Filter::Gaussian { radius: 1.1, deviation: 0.3 },
            seed: u64::MAX,
            normals: Normals::Flat,
            cull_back_faces: true,
            texture_filter: luch::scene::Minification::None,
        };
        let json = Recipe::of_scene(&settings, &Tone::default()).to_json();
        assert_eq!(Recipe::from_json(&json).unwrap().settings().unwrap(), settings);
    }
}
