//! Puts films and pictures on the disk, whole or not at all.

use crate::display::Display;
use crate::failure::Failure;
use crate::interrupt::Pen;
use crate::layers::LayerChoice;
use crate::outputs::{Content, Outputs};
use crate::provenance;
use crate::terminal;
use luch::formats::{SaveError, write_atomically};
use luch::image::codec::Layer;
use luch::image::tone::Tone;
use luch::render::{Checkpoint, Film, Fingerprint, Provenance};
use luch::scene::Integrator;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
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
    pen: Pen,
    pace: Mutex<Pace>,
}

/// When was saved last, and how long it took.
struct Pace {
    ended: Instant,
    cost: Duration,
    has_complained: bool,
}

impl Saver {
    pub(crate) fn new(
        files: Files,
        sources: Sources,
        integrator: Integrator,
        pen: Pen,
    ) -> Result<Self, Failure> {
        let display = Display { tone: sources.tone, integrator };
        let pace = Mutex::new(Pace { ended: Instant::now(), cost: Duration::ZERO, has_complained: false });
        Ok(Self { files, sources, display, pen, pace })
    }

    /// Every file that is written.
    pub(crate) fn paths(&self) -> Vec<&Path> {
        self.files.paths()
    }

    /// Whether the work can be continued.
    pub(crate) fn keeps_films(&self) -> bool {
        !self.files.films.is_empty()
    }

    /// Whether layers of properties are to be rendered.
    pub(crate) fn wants_layers(&self) -> bool {
        self.files.outputs.have_layers()
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
            troubles.extend(self.save_pictures(film, Vec::new()));
        }
        // A full disk may have room again later; rendering goes on.
        if let Some(trouble) = troubles.first()
            && !pace.has_complained
        {
            terminal::complain(&format!("warning: {trouble}; rendering goes on"));
            pace.has_complained = true;
        }
        pace.ended = Instant::now();
        pace.cost = pace.ended - started;
    }

    /// Writes the films; what went wrong comes back.
    pub(crate) fn save_films(&self, film: &Film) -> Vec<String> {
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
    pub(crate) fn save_pictures(&self, film: &Film, properties: Vec<Layer>) -> Vec<String> {
        let mut layers = properties;
        if self.wants_layers() {
            layers.extend(self.files.layers.iter().filter_map(|layer| layer.of_film(film)));
        }
        let image = film.to_image();
        let metadata = provenance::metadata(&self.sources.provenance, &self.sources.fingerprint, film);
        let content = Content { image: &image, layers, display: self.display, metadata: &metadata };
        let outputs = &self.files.outputs;
        let written = outputs.pictures().map(|output| outputs.write(output, &content, &self.pen));
        written.filter_map(Result::err).map(|error| error.to_string()).collect()
    }
}
