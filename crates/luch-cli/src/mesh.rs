//! `luch mesh`: the workshop on the command line.

mod compare;
mod info;
mod input;
mod output;
mod query;
mod sample;
mod table;

use crate::args::{ConvertArgs, MeshArgs, RunArgs, StepArgs};
use crate::failure::{Failure, Outcome};
pub(crate) use input::read_or_run;
use input::{Disk, read};
use luch::formats::MeshFile;
use luch::mesh::workshop::{Action, Pipeline, Step};

pub(crate) fn run(args: &MeshArgs) -> Result<Outcome, Failure> {
    match args {
        MeshArgs::Info(args) => info::run(args),
        MeshArgs::Convert(args) => convert(args),
        MeshArgs::Run(args) => pipeline(args),
        MeshArgs::Compare(args) => compare::run(args),
        MeshArgs::Sample(args) => sample::run(args),
        MeshArgs::Query(args) => query::run(args),
        MeshArgs::Verbs(args) => table::run(args),
        MeshArgs::Step(args) => step(args),
    }
}

fn convert(args: &ConvertArgs) -> Result<Outcome, Failure> {
    output::write(&read(args.input.as_deref())?, &args.output)
}

fn pipeline(args: &RunArgs) -> Result<Outcome, Failure> {
    let pipeline = Pipeline::parse(&args.pipeline)?;
    let changes =
        pipeline.steps.first().is_some_and(|step| matches!(step.verb.action, Action::Change { .. }));
    let file = if changes || args.input.is_some() { Some(read(args.input.as_deref())?) } else { None };
    work(file, &args.output, |mesh| Ok(pipeline.run_on(mesh, &mut Disk)?))
}

fn step(args: &StepArgs) -> Result<Outcome, Failure> {
    let step = Step { verb: args.verb, given: args.given.clone() };
    let file = match args.verb.action {
        Action::Make { .. } => None,
        Action::Change { .. } => Some(read(args.input.as_deref())?),
    };
    work(file, &args.output, |mesh| Ok(step.run(mesh, &mut Disk)?))
}

/// Changes the mesh of a file, or makes one; names of materials stay.
fn work(
    file: Option<MeshFile>,
    output: &crate::args::MeshOutputArgs,
    change: impl FnOnce(Option<luch::mesh::PolygonMesh>) -> Result<luch::mesh::PolygonMesh, Failure>,
) -> Result<Outcome, Failure> {
    let (mesh, file) = match file {
        None => (None, MeshFile::default()),
        Some(mut file) => (Some(std::mem::take(&mut file.mesh)), file),
    };
    output::write(&MeshFile { mesh: change(mesh)?, ..file }, output)
}
