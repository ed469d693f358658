//! `luch develop`: a film becomes pictures.

use crate::args::DevelopArgs;
use crate::display::Display;
use crate::failure::{Failure, Outcome};
use crate::film_file;
use crate::interrupt::Interrupt;
use crate::layers::LayerChoice;
use crate::outputs::{self, Content, Outputs};
use crate::provenance;
use crate::recipe::Recipe;
use crate::same_file::refuse_replacing;
use crate::terminal;
use luch::render::Checkpoint;
use std::path::Path;

pub(crate) fn run(args: &DevelopArgs) -> Result<Outcome, Failure> {
    let pen = Interrupt::install()?.pen();
    let outputs = Outputs::new(&args.output, args.display.depth)?;
    if let Some(film) = outputs.films().next() {
        return Err(Failure::usage(format!(
            "{}: a film is developed into pictures, not into films",
            film.display()
        )));
    }
    let targets: Vec<&Path> = outputs.pictures().map(|output| output.path.as_path()).collect();
    refuse_replacing(&targets, &[&args.film])?;
    args.output.iter().try_for_each(|path| outputs::probe(path))?;
    let Checkpoint { fingerprint, mut provenance, film } = film_file::read(&args.film)?;
    let mut recipe = Recipe::from_json(&provenance.options)?;
    recipe.change_display(&args.display);
    provenance.options = recipe.to_json();
    let image = film.to_image();
    let metadata = provenance::metadata(&provenance, &fingerprint, &film);
    let display = Display { tone: recipe.tone()?, integrator: recipe.settings()?.integrator };
    let layers = LayerChoice::USUAL.iter().filter_map(|layer| layer.of_film(&film)).collect();
    let content = Content { image: &image, layers, display, metadata: &metadata };
    for output in outputs.pictures() {
        outputs.write(output, &content, &pen)?;
        terminal::say(&format!(
            "{}: {} samples per pixel",
            output.path.display(),
            terminal::samples(film.mean_samples())
        ));
    }
    Ok(Outcome::Done)
}
