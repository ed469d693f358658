//! `luch reproduce`: is the picture what it says it is?

use crate::args::ReproduceArgs;
use crate::failure::{Failure, Outcome};
use crate::film_file;
use crate::layers::NEVER;
use crate::provenance::{self, Claim, TileRun};
use crate::terminal;
use luch::formats::{Files, load_with_parameters};
use luch::image::codec::{self, Format};
use luch::image::compare::compare;
use luch::image::{Image, Rgb};
use luch::render::{Film, Fingerprint, Goal, JobPlan, Ranges, RenderJob, TILE, View, World, from_settings};
use std::path::{Path, PathBuf};
use std::sync::Arc;

pub(crate) fn run(args: &ReproduceArgs) -> Result<Outcome, Failure> {
    let claim = Claim::read(&args.file)?;
    let source = args
        .scene
        .clone()
        .map_or_else(|| find_scene(&claim.scene, &args.file, "say with --scene where it is now"), Ok)?;
    let mut scene = load_with_parameters(&source, &Files::disk(), &claim.recipe.parameters)?.scene;
    let camera = claim.recipe.apply(&mut scene)?;
    let fingerprint = Fingerprint::of(&scene, &camera).to_hex();
    if fingerprint != claim.fingerprint {
        let mut reason = format!("{} is not the scene of the picture any more", source.display());
        if claim.version != env!("CARGO_PKG_VERSION") {
            reason += &format!(", or the program has changed since version {}", claim.version);
        }
        terminal::say(&format!(
            "different: {reason} (fingerprint {} then, {} now)",
            head(&claim.fingerprint),
            head(&fingerprint)
        ));
        return Ok(Outcome::Unmet);
    }
    let view = Arc::new(View::new(&camera, &scene.settings));
    let world = Arc::new(World::build(scene)?);
    let again = Again { world, view, threads: args.threads.map(usize::from) }.render(&claim.samples)?;
    let digest = provenance::digest(&again);
    if digest == claim.digest {
        terminal::say(&format!("equal: the light has the same bits (digest {})", head(&digest)));
        return Ok(Outcome::Done);
    }
    let mut text = format!(
        "different: the light has other bits (digest {} then, {} now)",
        head(&claim.digest),
        head(&digest)
    );
    if claim.version != env!("CARGO_PKG_VERSION") {
        text +=
            &format!("; the program was version {} then, {} now", claim.version, env!("CARGO_PKG_VERSION"));
    }
    if let Some(stored) = stored_light(&args.file)
        && let Ok(comparison) = compare(&again, &stored)
        && let Some(place) = comparison.largest
    {
        text += &format!(
            "; largest difference {} at pixel ({}, {}), root mean square {}",
            terminal::short(place.difference),
            place.x,
            place.y,
            terminal::short(comparison.rmse)
        );
    }
    terminal::say(&text);
    Ok(Outcome::Unmet)
}

/// Enough digits to tell two apart by eye.
fn head(digits: &str) -> &str {
    digits.get(..16).unwrap_or(digits)
}

/// The scene where it was, or else beside the picture or film; `advice` is for when it is in neither place.
pub(crate) fn find_scene(named: &str, picture: &Path, advice: &str) -> Result<PathBuf, Failure> {
    let named = PathBuf::from(named);
    let beside = named.file_name().map(|name| picture.with_file_name(name));
    let places = [Some(named.clone()), beside];
    places.into_iter().flatten().find(|path| path.is_file()).ok_or_else(|| {
        let (named, picture) = (named.display(), picture.display());
        Failure::new(format!("{picture}: its scene {named} is not there; {advice}"))
    })
}

/// The light that the file itself holds, if it holds light exactly.
fn stored_light(path: &Path) -> Option<Image<Rgb>> {
    if film_file::is_film(path) {
        return Some(film_file::read(path).ok()?.film.to_image());
    }
    let bytes = Files::disk().read(path).ok()?;
    let holds_light = matches!(Format::from_magic(&bytes), Some(Format::Exr | Format::Pfm | Format::Npy));
    if holds_light { codec::decode(&bytes, None).ok().map(|bitmap| bitmap.to_rgb()) } else { None }
}

/// The same samples once more.
struct Again {
    world: Arc<World>,
    view: Arc<View>,
    threads: Option<usize>,
}

impl Again {
    /// The picture whose tiles hold these samples: the whole film is rendered for each set, and each tile taken from its set's.
    fn render(&self, runs: &[TileRun]) -> Result<Image<Rgb>, Failure> {
        let mut sets: Vec<&Ranges> = Vec::new();
        for run in runs {
            if !sets.contains(&&run.samples) {
                sets.push(&run.samples);
            }
        }
        sets.sort_by_key(|set| set.count());
        let of_tiles: Vec<&Ranges> = runs.iter().flat_map(|run| vec![&run.samples; run.tiles]).collect();
        let (width, height) = (self.view.width(), self.view.height());
        let mut picture = Image::filled(width, height, Rgb::BLACK);
        let mut film = Film::new(width, height);
        let mut held = Ranges::default();
        for set in sets {
            if !held.as_slice().iter().all(|range| set.first_overlap(&one(range)) == Some(range.clone())) {
                film = Film::new(width, height);
            }
            for range in set.as_slice() {
                film = self.add(film, range.clone())?;
            }
            held = set.clone();
            let image = film.to_image();
            let columns = width.div_ceil(TILE) as usize;
            for (index, (pixel, new)) in picture.pixels_mut().iter_mut().zip(image.pixels()).enumerate() {
                let (x, y) = (index % width as usize, index / width as usize);
                let tile = y / TILE as usize * columns + x / TILE as usize;
                if of_tiles[tile] == set {
                    *pixel = *new;
                }
            }
        }
        Ok(picture)
    }

    fn add(&self, film: Film, samples: std::ops::Range<u64>) -> Result<Film, Failure> {
        let integrator = from_settings(self.world.scene.settings.integrator, &self.view);
        let plan = JobPlan {
            world: Arc::clone(&self.world),
            view: Arc::clone(&self.view),
            integrator,
            film,
            goal: Goal { samples, ..Goal::default() },
            threads: self.threads,
            snapshot_every: NEVER,
            on_snapshot: Box::new(|_, _| ()),
        };
        Ok(RenderJob::start(plan)?.join().film)
    }
}

/// A set of one range.
fn one(range: &std::ops::Range<u64>) -> Ranges {
    let mut set = Ranges::default();
    set.insert(range.clone());
    set
}
