//! `luch lab render` and `luch lab coverage`: the laboratory in the renderer.

use super::output::{check, give, report};
use super::watched::{watched, what_time};
use crate::args::{CoverageArgs, LabOutputArgs, LabSceneArgs, PictureArgs, ReferenceArgs, RenderStudyArgs};
use crate::failure::{Failure, Outcome};
use crate::film_file;
use crate::parse::{IntegratorChoice, Size};
use crate::recipe::Recipe;
use crate::render::announce;
use crate::same_file::refuse_replacing;
use luch::formats::{Files, Loaded};
use luch::image::codec::{self, Format};
use luch::image::tone::Tone;
use luch::scene::Integrator;
use luch_lab::rendering::{CoveragePlan, StudyPlan, Subject, Truth, coverage as cover, study};
use std::path::Path;

/// Most pixels of a picture here: numbers of many pictures are held at once.
const MOST_PIXELS: u64 = 1 << 22;

/// A scene ready to be rendered.
struct Ready {
    subject: Subject,
    /// The scene's own, a path if it shows a property.
    integrator: Integrator,
    tone: Tone,
    name: String,
}

pub(super) fn run(args: &RenderStudyArgs) -> Result<Outcome, Failure> {
    let truth = match (args.truth_value, &args.truth) {
        (Some(value), _) => Truth::Value(value),
        (None, typed) => truth(typed, args.spp.0.last().map_or(2, |most| most.saturating_mul(16)))?,
    };
    let usual = Size { width: 128, height: 96 };
    let ready = ready(&args.scene, size_of(&truth).unwrap_or(usual), &args.truth, &args.output)?;
    let mut integrators = chosen(&args.integrator, &ready);
    let mut sequences = args.sampler.iter().flat_map(|samplers| samplers.0.iter().copied()).collect();
    once_each(&mut integrators);
    once_each(&mut sequences);
    let plan = StudyPlan {
        sequences,
        integrators,
        samples: args.spp.0.clone(),
        replicates: args.replicates,
        seed: args.scene.seed,
        truth,
    };
    let Some(found) =
        watched(plan.work(&ready.subject), &args.output, |work| study(&ready.subject, &plan, work))?
    else {
        return Ok(Outcome::Interrupted);
    };
    // Pictures are for those who look.
    let looks = args
        .output
        .output
        .iter()
        .any(|path| path.extension().is_some_and(|e| e.eq_ignore_ascii_case("html")));
    let page = found.page(
        report(format!("How {} converges", ready.name)),
        what_time(),
        looks.then_some(&ready.tone),
    );
    give(&page, &args.output)
}

pub(super) fn coverage(args: &CoverageArgs) -> Result<Outcome, Failure> {
    let truth = truth(&args.truth, args.spp.saturating_mul(64))?;
    let usual = Size { width: 64, height: 48 };
    let ready = ready(&args.scene, size_of(&truth).unwrap_or(usual), &args.truth, &args.output)?;
    let chosen = chosen(args.integrator.as_slice(), &ready);
    let mut levels = args.levels.clone();
    levels.sort_by(f64::total_cmp);
    levels.dedup();
    let plan = CoveragePlan {
        sequence: args.sampler,
        integrator: chosen.first().copied(),
        renders: args.renders,
        samples: args.spp,
        levels,
        seed: args.scene.seed,
        truth,
    };
    match watched(plan.work(&ready.subject), &args.output, |work| cover(&ready.subject, &plan, work))? {
        Some(found) => {
            give(&found.page(report(format!("What {} says of its error", ready.name))), &args.output)
        }
        None => Ok(Outcome::Interrupted),
    }
}

/// A list without repetitions, in its order.
fn once_each<T: PartialEq + Copy>(list: &mut Vec<T>) {
    *list = list.iter().fold(Vec::new(), |mut once, one| {
        if !once.contains(one) {
            once.push(*one);
        }
        once
    });
}

/// Integrators that were typed, or the scene's.
fn chosen(typed: &[IntegratorChoice], ready: &Ready) -> Vec<Integrator> {
    let depth = match ready.integrator {
        Integrator::Path { max_depth } | Integrator::PlainPath { max_depth } => max_depth,
        _ => 64,
    };
    if typed.is_empty() {
        vec![ready.integrator]
    } else {
        typed.iter().map(|choice| choice.with_depth(depth)).collect()
    }
}

/// Loads the scene as `luch render` does.
fn ready(
    args: &LabSceneArgs,
    size: Size,
    truth: &ReferenceArgs,
    output: &LabOutputArgs,
) -> Result<Ready, Failure> {
    check(output)?;
    let disk = Files::disk();
    let loaded = args.parameters.load(&args.file, &disk)?;
    let mut taken = disk.taken();
    taken.extend(truth.reference.clone());
    let outputs: Vec<&Path> = output.output.iter().map(AsRef::as_ref).collect();
    refuse_replacing(&outputs, &taken)?;
    if !output.json {
        announce(&loaded);
    }
    let Loaded { mut scene, wishes, .. } = loaded;
    let mut recipe = Recipe::of_scene(&scene.settings, &wishes.tone);
    recipe.change(&PictureArgs {
        size: args.size.or(Some(size)),
        camera: args.camera.clone(),
        ..PictureArgs::default()
    })?;
    let camera = recipe.apply(&mut scene)?;
    let pixels = u64::from(scene.settings.width) * u64::from(scene.settings.height);
    if pixels > MOST_PIXELS {
        return Err(Failure::usage(format!(
            "--size: {pixels} pixels; the laboratory takes at most {MOST_PIXELS}"
        )));
    }
    let integrator = match scene.settings.integrator {
        Integrator::Inspect(_) => Integrator::default(),
        light => light,
    };
    let name = args.file.file_name().unwrap_or(args.file.as_os_str()).to_string_lossy().into_owned();
    Ok(Ready {
        subject: Subject::new(scene, Some(camera), wishes.tone)?,
        integrator,
        tone: wishes.tone,
        name,
    })
}

/// The truth that was asked for, or a rendering of so many samples.
fn truth(args: &ReferenceArgs, usual: u64) -> Result<Truth, Failure> {
    let Some(path) = &args.reference else { return Ok(Truth::Samples(args.reference_spp.unwrap_or(usual))) };
    if film_file::is_film(path) {
        return Ok(Truth::Film(Box::new(film_file::read(path)?.film)));
    }
    let bytes = Files::disk().read(path).map_err(|problem| Failure::new(problem.to_string()))?;
    let told = |error: &dyn std::fmt::Display| Failure::new(format!("{}: {error}", path.display()));
    match Format::from_magic(&bytes) {
        Some(Format::Exr) => {
            let layers = codec::decode_exr_layers(&bytes).map_err(|error| told(&error))?;
            let light = match layers.rgb("") {
                Some(light) => light,
                None => codec::decode(&bytes, None).map_err(|error| told(&error))?.to_rgb(),
            };
            Ok(Truth::Picture { light, standard_error: layers.rgb("stderr") })
        }
        Some(Format::Hdr | Format::Pfm | Format::Npy) => {
            let light = codec::decode(&bytes, None).map_err(|error| told(&error))?.to_rgb();
            Ok(Truth::Picture { light, standard_error: None })
        }
        _ => Err(told(&"is no picture of light; a reference is .luch, .exr, .hdr, .pfm or .npy")),
    }
}

/// The size of a truth that has one.
fn size_of(truth: &Truth) -> Option<Size> {
    match truth {
        Truth::Film(film) => Some(Size { width: film.width(), height: film.height() }),
        Truth::Picture { light, .. } => Some(Size { width: light.width(), height: light.height() }),
        Truth::Samples(_) | Truth::Value(_) => None,
    }
}
