//! Puts films and pictures on the disk, whole or not at all.

use crate::display::Display;
use crate::failure::Failure;
use crate::interrupt::Pen;
use crate::layers::{Care, LayerChoice, PropertyStudio};
use crate::outputs::{Content, Outputs};
use crate::provenance;
use crate::terminal;
use luch::formats::{SaveError, write_atomically};
use luch::image::codec::Layer;
use luch::image::tone::Tone;
use luch::render::{Checkpoint, Film, Fingerprint, Provenance, View, World};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

/// Saving takes at most one part of so many of the time.
const SHARE: u32 = 20;

/// What is written.
pub(crate) struct Files {
    /// Everything that was asked for.
    pub(crate) outputs: Outputs,
    /// Every film: those asked for, and the one to resume from.
    pub(crate) films: Vec<PathBuf>,
    /// Layers of EXR files.
    pub(crate) layers: Vec<LayerChoice>,
}

impl Files {
    /// Every file that is written.
    pub(crate) fn paths(&self) -> Vec<&Path> {
        let pictures = self.outputs.pictures().map(|output| output.path.as_path());
        pictures.chain(self.films.iter().map(PathBuf::as_path)).collect()
    }
}

/// What is written about where it comes from.
pub(crate) struct Sources {
    pub(crate) tone: Tone,
    pub(crate) fingerprint: Fingerprint,
    pub(crate) provenance: Provenance,
}

/// Writes files, from the rendering's thread and at its end.
pub(crate) struct Saver {
    pub(crate) files: Files,
    pub(crate) sources: Sources,
    display: Display,
    studio: PropertyStudio,
    pen: Pen,
    pace: Mutex<Pace>,
}

/// When was saved last, and how long it took.
struct Pace {
    ended: Instant,
    cost: Duration,
    has_complained: bool,
    /// Layers of properties with few samples, once there are any.
    sketches: Option<Vec<Layer>>,
}

impl Saver {
    pub(crate) fn new(
        files: Files,
        sources: Sources,
        world: &Arc<World>,
        view: &Arc<View>,
        threads: Option<usize>,
        pen: Pen,
    ) -> Self {
        let display = Display { tone: sources.tone, integrator: world.scene.settings.integrator };
        let wanted = files.layers.iter().filter(|_| files.outputs.have_layers());
        let properties = wanted.filter_map(|layer| layer.property()).collect();
        let studio = PropertyStudio { world: Arc::clone(world), view: Arc::clone(view), threads, properties };
        let pace =
            Pace { ended: Instant::now(), cost: Duration::ZERO, has_complained: false, sketches: None };
        Self { files, sources, display, studio, pen, pace: Mutex::new(pace) }
    }

    /// Every file that is written.
    pub(crate) fn paths(&self) -> Vec<&Path> {
        self.files.paths()
    }

    /// Whether the work can be continued.
    pub(crate) fn keeps_films(&self) -> bool {
        !self.files.films.is_empty()
    }

    /// The film and its pictures as they are now, unless the last saving was so slow that it is too early.
    pub(crate) fn snapshot(&self, film: &Film) {
        let mut pace = self.pace.lock().unwrap_or_else(PoisonError::into_inner);
        let started = Instant::now();
        if pace.cost * SHARE > started.duration_since(pace.ended) {
            return;
        }
        let mut troubles = self.save_films(film);
        if !self.pen.is_interrupted() {
            troubles.extend(self.save_pictures(film, pace.sketches.clone().unwrap_or_default()));
        }
        pace.cost = started.elapsed();
        if pace.sketches.is_none() {
            // After the first picture is there; used until the end, and at an early one.
            match self.studio.render(Care::Quick, &self.pen) {
                Ok(sketches) => pace.sketches = sketches,
                Err(failure) => troubles.push(failure.to_string()),
            }
        }
        // A full disk may have room again later; rendering goes on.
        if let Some(trouble) = troubles.first()
            && !pace.has_complained
        {
            terminal::complain(&format!("warning: {trouble}; rendering goes on"));
            pace.has_complained = true;
        }
        pace.ended = Instant::now();
    }

    /// Everything as it is at the end; what went wrong comes back.
    pub(crate) fn finish(&self, film: &Film) -> Result<Vec<String>, Failure> {
        // Films first: with them everything else can be made again.
        let mut troubles = self.save_films(film);
        let sketches = self.pace.lock().unwrap_or_else(PoisonError::into_inner).sketches.take();
        let layers = self.studio.render(Care::Thorough, &self.pen)?.or(sketches).unwrap_or_default();
        troubles.extend(self.save_pictures(film, layers));
        Ok(troubles)
    }

    /// Writes the films; what went wrong comes back.
    fn save_films(&self, film: &Film) -> Vec<String> {
        if self.files.films.is_empty() {
            return Vec::new();
        }
        let Sources { fingerprint, provenance, .. } = &self.sources;
        let checkpoint =
            Checkpoint { fingerprint: *fingerprint, provenance: provenance.clone(), film: film.clone() };
        let bytes = checkpoint.encode();
        let write = |path: &PathBuf| -> Result<(), SaveError> {
            let _held = self.pen.hold();
            write_atomically(path, &bytes)
        };
        self.files.films.iter().filter_map(|path| write(path).err()).map(|error| error.to_string()).collect()
    }

    /// Writes the pictures; what went wrong comes back.
    fn save_pictures(&self, film: &Film, properties: Vec<Layer>) -> Vec<String> {
        let mut layers = properties;
        if self.files.outputs.have_layers() {
            layers.extend(self.files.layers.iter().filter_map(|layer| layer.of_film(film)));
        }
        let image = film.to_image();
        let metadata = provenance::metadata(&self.sources.provenance, &self.sources.fingerprint, film);
        let content = Content { image: &image, layers, display: self.display, metadata: &metadata };
        let outputs = &self.files.outputs;
        // Each on a thread of its own: somebody may be waiting.
        let written: Vec<Result<(), SaveError>> = std::thread::scope(|scope| {
            let write = |output| {
                let content = &content;
                scope.spawn(move || outputs.write(output, content, &self.pen))
            };
            let threads: Vec<_> = outputs.pictures().map(write).collect();
            threads.into_iter().map(|thread| thread.join().expect("encoders do not panic")).collect()
        });
        written.into_iter().filter_map(Result::err).map(|error| error.to_string()).collect()
    }
}
