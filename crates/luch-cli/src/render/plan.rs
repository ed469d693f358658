//! From what was typed to what is done: the scene is loaded, options are settled, files are known to be writable.

use super::resume;
use super::saver::{Files, Sources};
use crate::args::RenderArgs;
use crate::failure::Failure;
use crate::film_file;
use crate::layers::LayerChoice;
use crate::outputs::{self, Outputs};
use crate::recipe::{GoalWords, Recipe};
use crate::reproduce::find_scene;
use crate::same_file::{place, refuse_replacing};
use crate::terminal;
use luch::formats::Loaded;
use luch::render::{Checkpoint, Film, Fingerprint, Goal, Provenance, View, World};
use luch::scene::Integrator;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Warnings that are told before a rendering; `luch check` tells all.
const MOST_WARNINGS: usize = 12;

/// A rendering that can begin.
pub(super) struct Plan {
    pub(super) world: Arc<World>,
    pub(super) view: Arc<View>,
    pub(super) film: Film,
    pub(super) goal: Goal,
    pub(super) endless: bool,
    pub(super) sources: Sources,
    pub(super) files: Files,
}

/// Where things are read from and written to.
struct Places {
    scene: PathBuf,
    outputs: Outputs,
    /// Where the film is kept.
    film: PathBuf,
    /// The film to go on with.
    resumed: Option<Checkpoint>,
    resumed_from: PathBuf,
}

impl Plan {
    pub(super) fn make(args: &RenderArgs) -> Result<Self, Failure> {
        let Places { scene: source, outputs, film: film_path, resumed, resumed_from } = Places::find(args)?;
        let files = Files::new(args, outputs, film_path)?;
        refuse_replacing(&files.paths(), &[&source])?;
        files.paths().into_iter().try_for_each(outputs::probe)?;

        let disk = luch::formats::Files::disk();
        // Options: the film's before the scene's, those that were typed before both.
        let kept = match &resumed {
            Some(film) => Some(Recipe::from_json(&film.provenance.options)?),
            None => None,
        };
        let mut parameters = kept.as_ref().map(|kept| kept.parameters.clone()).unwrap_or_default();
        parameters.extend(args.parameters.values()?);
        let loaded = luch::formats::load_with_parameters(&source, &disk, &parameters)?;
        refuse_replacing(&files.paths(), &disk.taken())?;
        if !args.work.quiet {
            announce(&loaded);
            announce_replaced(&files, resumed.is_some());
        }
        let Loaded { mut scene, wishes, .. } = loaded;

        let mut recipe = kept.unwrap_or_else(|| Recipe::of_scene(&scene.settings, &wishes.tone));
        recipe.parameters = parameters;
        recipe.change(&args.picture)?;
        recipe.change_display(&args.display);
        let typed = goal_words(args);
        if !typed.is_endless() {
            recipe.goal = typed;
        }
        if recipe.goal.is_endless() {
            recipe.goal.samples = wishes.samples.map(|count| format!("0..{count}"));
        }
        refuse_error_of_properties(&recipe)?;
        let camera = recipe.apply(&mut scene)?;
        let fingerprint = Fingerprint::of(&scene, &camera);
        if let Some(film) = &resumed {
            resume::verify(&resumed_from, film, &fingerprint, &recipe, &scene)?;
        }

        let view = Arc::new(View::new(&camera, &scene.settings));
        let provenance = Provenance {
            source: source.to_string_lossy().into_owned(),
            command: this_command(),
            version: env!("CARGO_PKG_VERSION").to_owned(),
            options: recipe.to_json(),
        };
        Ok(Self {
            world: Arc::new(World::build(scene)?),
            film: resumed
                .map_or_else(|| Film::new(view.width(), view.height()), |checkpoint| checkpoint.film),
            view,
            goal: recipe.goal.to_goal()?,
            endless: recipe.goal.is_endless(),
            sources: Sources { tone: recipe.tone()?, fingerprint, provenance },
            files,
        })
    }
}

impl Places {
    fn find(args: &RenderArgs) -> Result<Self, Failure> {
        let checkpoint = args.work.checkpoint.clone();
        if let Some(path) = checkpoint.as_ref().filter(|path| !film_file::is_film(path)) {
            let path = path.display();
            return Err(Failure::usage(format!("{path}: --checkpoint keeps a film: let it end in .luch")));
        }
        let typed = args.work.resume.clone();
        let resumes = typed.is_some();
        // `--resume X` takes X with it even if X is the scene.
        let (scene, resumed_from) = match (args.file.clone(), typed.flatten()) {
            (Some(scene), film) => (Some(scene), film),
            (None, Some(word)) if !film_file::is_film(&word) => (Some(word), None),
            (None, film) => (None, film),
        };
        let resumed_from = resumed_from.or_else(|| checkpoint.clone().filter(|_| resumes));
        let usual_output = match (&scene, &resumed_from) {
            (Some(scene), _) => {
                Path::new(scene.file_stem().unwrap_or(scene.as_os_str())).with_added_extension("png")
            }
            (None, Some(film)) => film.with_extension("png"),
            (None, None) => return Err(Failure::usage("name the scene to render, or a film to go on with")),
        };
        let outputs = if args.output.is_empty() { vec![usual_output] } else { args.output.clone() };
        let outputs = Outputs::new(&outputs, args.display.depth)?;
        let beside = outputs.first().unwrap_or(Path::new("luch")).with_extension(film_file::EXTENSION);
        let usual_film = outputs.films().next().map_or(beside, Path::to_owned);
        let resumed_from = resumed_from.unwrap_or_else(|| usual_film.clone());
        let film = checkpoint.unwrap_or_else(|| if resumes { resumed_from.clone() } else { usual_film });
        let resumed = if resumes { Some(read_film(&resumed_from)?) } else { None };
        let scene = match (scene, &resumed) {
            (Some(scene), _) => scene,
            (None, Some(film)) => {
                find_scene(&film.provenance.source, &resumed_from, "name the scene before --resume")?
            }
            (None, None) => return Err(Failure::usage("name the scene to render")),
        };
        Ok(Self { scene, outputs, film, resumed, resumed_from })
    }
}

fn read_film(path: &Path) -> Result<Checkpoint, Failure> {
    if !path.exists() {
        let path = path.display();
        return Err(Failure::new(format!(
            "{path}: no such file: there is nothing to resume; begin without --resume"
        )));
    }
    film_file::read(path)
}

fn goal_words(args: &RenderArgs) -> GoalWords {
    let goal = &args.goal;
    let range = goal.samples.clone().or(goal.spp.map(|count| 0..count));
    GoalWords {
        samples: range.map(|range| format!("{}..{}", range.start, range.end)),
        seconds: goal.time.map(|time| time.as_secs_f64()),
        relative_error: goal.error,
    }
}

/// Properties may be negative and have a mean of zero: no error is relative to that.
fn refuse_error_of_properties(recipe: &Recipe) -> Result<(), Failure> {
    match recipe.settings()?.integrator {
        Integrator::Inspect(property) if recipe.goal.relative_error.is_some() => {
            let name = property.name();
            Err(Failure::usage(format!(
                "--error is for light; `{name}` is a property and has no relative error: use --spp or --time"
            )))
        }
        _ => Ok(()),
    }
}

/// The command as anybody could type it.
fn this_command() -> String {
    let words = std::env::args_os().skip(1).map(|word| word.to_string_lossy().into_owned());
    terminal::command_line(std::iter::once("luch".to_owned()).chain(words))
}

/// What loading had to say, each sentence once.
pub(crate) fn announce(loaded: &Loaded) {
    let mut told: Vec<String> = Vec::new();
    for warning in &loaded.warnings {
        let text = warning.to_string();
        if !told.contains(&text) {
            told.push(text);
        }
    }
    for text in told.iter().take(MOST_WARNINGS) {
        terminal::complain(&format!("warning: {text}"));
    }
    if let Some(more) = told.len().checked_sub(MOST_WARNINGS).filter(|more| *more > 0) {
        terminal::complain(&format!("warning: {more} more; `luch check` tells all"));
    }
    for note in &loaded.notes {
        terminal::complain(&format!("note: {note}"));
    }
}

/// A film may hold hours of work.
fn announce_replaced(files: &Files, resumes: bool) {
    for film in files.films.iter().filter(|film| !resumes && film.exists()) {
        terminal::complain(&format!(
            "note: {} of an earlier run will be replaced (--resume would have continued it)",
            film.display()
        ));
    }
}

impl Files {
    fn new(args: &RenderArgs, outputs: Outputs, film: PathBuf) -> Result<Self, Failure> {
        let layers = match &args.layers {
            Some(layers) if layers.contains(&LayerChoice::None) && layers.len() > 1 => {
                return Err(Failure::usage("--layers is either `none` or a list of layers"));
            }
            Some(_) if !outputs.have_layers() => {
                return Err(Failure::usage("--layers is for EXR, and no output ends in .exr"));
            }
            // Each layer once, in the order they were named in.
            Some(layers) => layers.iter().fold(Vec::new(), |mut once, layer| {
                if !once.contains(layer) {
                    once.push(*layer);
                }
                once
            }),
            None => LayerChoice::USUAL.to_vec(),
        };
        let mut films: Vec<PathBuf> = outputs.films().map(Path::to_owned).collect();
        let is_film = |other: &Path| place(other) == place(&film);
        if !args.work.no_checkpoint && !films.iter().any(|other| is_film(other)) {
            if let Some(picture) = outputs.pictures().find(|picture| is_film(&picture.path)) {
                let (picture, film) = (picture.path.display(), film.display());
                return Err(Failure::usage(format!("{picture} and the film {film} are one file; name two")));
            }
            films.push(film);
        }
        Ok(Self { outputs, films, layers })
    }
}
