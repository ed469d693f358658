//! `luch bench`: how fast this machine does what rendering rests on.

mod agree;
mod geometry;
mod rays;
mod report;
mod sets;
mod trace;

use crate::args::{BenchArgs, BenchVerb};
use crate::failure::{Failure, Outcome};
pub(crate) use report::quality_name;
pub(crate) use sets::SetKind;
pub(crate) use trace::Kernel;

pub(crate) fn run(args: &BenchArgs) -> Result<Outcome, Failure> {
    match &args.what {
        BenchVerb::Rays(args) => rays::run(args),
    }
}
