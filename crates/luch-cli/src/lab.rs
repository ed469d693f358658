//! `luch lab`: Monte Carlo made visible.

mod chi2;
mod explain;
mod integrate;
mod lamp;
mod lecture;
mod live;
mod output;
mod points;
mod prng;
mod problem;
mod render;
mod saving;
mod study;
mod ticker;
mod truth;
mod watched;

use crate::args::{LabArgs, LabVerb};
use crate::failure::{Failure, Outcome};

pub(crate) fn run(args: &LabArgs) -> Result<Outcome, Failure> {
    match &args.verb {
        LabVerb::Problems(_) => problem::list(),
        LabVerb::Problem(words) if lamp::is_meant(words) => lamp::run(words),
        LabVerb::Problem(words) => problem::run(words),
        LabVerb::Integrate(args) => integrate::run(args),
        LabVerb::Points(args) => points::show(args),
        LabVerb::Measure(args) => points::measure(args),
        LabVerb::Slopes(args) => study::slopes(args),
        LabVerb::Density(args) => study::density(args),
        LabVerb::Dimensions(args) => study::dimensions(args),
        LabVerb::Prng(args) => prng::run(args),
        LabVerb::Explain(args) => explain::run(args),
        LabVerb::Chi2(args) => chi2::run(args),
        LabVerb::Mis(args) => saving::mis(args),
        LabVerb::Control(args) => saving::control(args),
        LabVerb::Roulette(args) => saving::roulette(args),
        LabVerb::Width(args) => saving::width(args),
        LabVerb::Strata(args) => saving::strata(args),
        LabVerb::Truth(args) => truth::run(args),
        LabVerb::Lecture(args) => lecture::run(args),
        LabVerb::Render(args) => render::run(args),
        LabVerb::Coverage(args) => render::coverage(args),
    }
}
