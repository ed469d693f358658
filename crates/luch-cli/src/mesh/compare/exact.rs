//! A form as it is against its meshes: distance and pictures, for one resolution after another.

use super::super::input::Disk;
use super::pictures::{Stage, sheet};
use crate::args::CompareMeshesArgs;
use crate::failure::{Failure, Outcome};
use crate::terminal::{complain, say, short};
use luch::formats::save_image;
use luch::image::compare::compare;
use luch::mesh::query::{DeviationOptions, hausdorff};
use luch::mesh::workshop::{Arguments, NoFiles, Pipeline, Step, find};
use luch::mesh::{TriangleMesh, measure};
use luch::sampling::check::fit_slope;
use luch::scene::{Frustum, Implicit, Shape, Traced};
use serde_json::json;

/// By how much finer than the finest mesh the one is that distances are measured to.
const FINER: u32 = 4;

/// A form that rays can meet without triangles, and how its meshes are made.
struct Form {
    shape: Shape,
    step: Step,
    /// The parameter that counts pieces.
    parameter: &'static str,
    /// Whether a step of it doubles the pieces.
    doubles: bool,
}

/// One mesh against the form.
struct Row {
    resolution: u32,
    triangles: usize,
    /// The greatest distance of either surface from the other, in metres.
    distance: f64,
    /// Root of the mean square of the difference of pictures, over their mean.
    difference: f64,
}

pub(super) fn run(args: &CompareMeshesArgs) -> Result<Outcome, Failure> {
    let form = Form::read(&args.a)?;
    let resolutions = match args.resolutions.as_slice() {
        [] if form.doubles => vec![1, 2, 3, 4],
        [] => vec![8, 16, 32, 64],
        given => given.to_vec(),
    };
    let finest = resolutions.iter().copied().max().unwrap_or(1);
    let reference = form.mesh(if form.doubles { finest + FINER / 2 } else { finest * FINER })?;
    let stage = Stage::around(&reference);
    let exact = stage.picture(form.shape.clone())?;
    let mean = exact.pixels().iter().map(|pixel| f64::from(pixel.luminance())).sum::<f64>();
    let mean = (mean / exact.pixels().len() as f64).max(f64::MIN_POSITIVE);
    let options = DeviationOptions {
        samples: args.samples as usize,
        tolerance: args.tolerance,
        ..DeviationOptions::default()
    };
    let mut rows = Vec::new();
    let mut pictures = Vec::new();
    for resolution in resolutions {
        let mesh = form.mesh(resolution)?;
        let triangles = mesh.triangles.len();
        let [there, back] = hausdorff(&mesh, &reference, &options)
            .ok_or_else(|| Failure::new("the mesh has no triangles"))?;
        let picture = stage.picture(Shape::Mesh(mesh))?;
        let difference =
            compare(&picture, &exact).map_err(|error| Failure::new(error.to_string()))?.rmse / mean;
        rows.push(Row { resolution, triangles, distance: there.greatest.max(back.greatest), difference });
        pictures.push(picture);
    }
    tell(args, &form, &rows, &reference);
    if let Some(path) = &args.output {
        save_image(path, &sheet(&exact, &pictures), &Default::default(), &Default::default())?;
        complain(&format!("wrote {}", path.display()));
    }
    let worst = rows.last().map_or(0.0, |row| row.distance);
    Ok(match args.max_distance {
        Some(limit) if worst > limit => Outcome::Unmet,
        _ => Outcome::Done,
    })
}

fn tell(args: &CompareMeshesArgs, form: &Form, rows: &[Row], reference: &TriangleMesh) {
    let bounds = measure::bounds(reference);
    let diagonal = f64::from((bounds.max - bounds.min).length());
    if args.json {
        let list: Vec<_> = rows
            .iter()
            .map(|row| {
                json!({ form.parameter: row.resolution, "triangles": row.triangles,
                    "hausdorff": row.distance, "image_difference": row.difference })
            })
            .collect();
        say(&json!({ "form": form.step.verb.name, "diagonal": diagonal, "meshes": list }).to_string());
        return;
    }
    say(&format!(
        "{:>12}  {:>9}  {:>12}  {:>6}  {:>12}  {:>6}",
        form.parameter, "triangles", "distance m", "order", "image", "order"
    ));
    for (k, row) in rows.iter().enumerate() {
        let before = k.checked_sub(1).map(|k| &rows[k]);
        let order = |value: fn(&Row) -> f64| {
            let pieces = |row: &Row| match form.doubles {
                true => (1u64 << row.resolution.min(32)) as f64,
                false => f64::from(row.resolution),
            };
            let points = before.map(|before| [before, row].map(|row| [pieces(row), value(row)]));
            let fit = points.and_then(|points| fit_slope(&points));
            fit.map_or(String::new(), |fit| format!("{:.2}", fit.slope))
        };
        say(&format!(
            "{:>12}  {:>9}  {:>12}  {:>6}  {:>12}  {:>6}",
            row.resolution,
            row.triangles,
            short(row.distance),
            order(|row| row.distance),
            format!("{} %", short(100.0 * row.difference)),
            order(|row| row.difference),
        ));
    }
}

impl Form {
    fn read(text: &str) -> Result<Self, Failure> {
        let first = text.split([' ', '|']).next().unwrap_or_default();
        let advice = "name a second mesh, or a form that is traced as it is: sphere, icosphere, cylinder, cone, frustum, disc, implicit";
        find(first).map_err(|error| Failure::new(format!("{error}; {advice}")))?;
        let mut steps = Pipeline::parse(text)?.steps;
        let (Some(step), 0) = (steps.pop(), steps.len()) else {
            return Err(Failure::new(format!("`{text}` is more than one step; {advice}")));
        };
        let (parameter, doubles) = match step.verb.name {
            "icosphere" => ("subdivisions", true),
            "implicit" => ("resolution", false),
            "sphere" | "cylinder" | "cone" | "frustum" | "disc" => ("segments", false),
            other => return Err(Failure::new(format!("`{other}` is known as a mesh only; {advice}"))),
        };
        let given = Arguments::read(step.verb, &step.given, &mut NoFiles)?;
        let frustum = |top_radius: f32| {
            Shape::Traced(Traced::Frustum(Frustum {
                bottom_radius: given.length("radius"),
                top_radius,
                height: given.length("height"),
                capped: given.flag("capped"),
            }))
        };
        let shape = match step.verb.name {
            "sphere" | "icosphere" => Shape::Sphere { radius: given.length("radius") },
            "disc" => Shape::Disc { radius: given.length("radius") },
            "cylinder" => frustum(given.length("radius")),
            "cone" | "frustum" => frustum(given.length("top-radius")),
            _ => {
                let surface = step.formula()?;
                let corners = [surface.region.min.as_vec3(), surface.region.max.as_vec3()];
                let implicit = Implicit::new(surface.formula, corners, surface.closed);
                Shape::Traced(Traced::Implicit(implicit.map_err(|error| Failure::new(error.to_string()))?))
            }
        };
        Ok(Self { shape, step, parameter, doubles })
    }

    /// The mesh of so many pieces.
    fn mesh(&self, resolution: u32) -> Result<TriangleMesh, Failure> {
        let mut step = self.step.clone();
        let mut set = |name: &str, value: u32| {
            step.given.retain(|(known, _)| known != name);
            step.given.push((name.into(), value.to_string()));
        };
        match self.step.verb.name {
            "sphere" => {
                set("segments", resolution.max(3));
                set("rings", (resolution / 2).max(2));
            }
            "implicit" | "icosphere" => set(self.parameter, resolution),
            _ => set(self.parameter, resolution.max(3)),
        }
        Ok(step.run(None, &mut Disk)?.triangulate())
    }
}
