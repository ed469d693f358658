//! `luch mesh info`: everything there is to say about a mesh.

use super::input;
use crate::args::InfoArgs;
use crate::failure::{Failure, Outcome};
use crate::terminal::say;
use luch::mesh::inspect::{Options, inspect};
use luch::mesh::{PolygonMesh, measure};

pub(super) fn run(args: &InfoArgs) -> Result<Outcome, Failure> {
    let mesh = input::read(args.input.as_deref())?.mesh.triangulate();
    let options = Options { weld: !args.no_weld, self_intersections: !args.no_self_intersections };
    let report = inspect(&mesh, &options);
    if args.json {
        say(&serde_json::to_string(&report)?);
    } else {
        say(report.to_string().trim_end());
    }
    Ok(Outcome::Done)
}

/// A line about what was made, for those who look at a terminal.
pub(super) fn summarise(mesh: &PolygonMesh) {
    let triangles = mesh.triangulate();
    let bounds = measure::bounds(&triangles);
    let size = if bounds.is_empty() { glam::Vec3::ZERO } else { bounds.max - bounds.min };
    say(&format!(
        "{} faces, {} triangles, {} positions, {} × {} × {} m, {}",
        mesh.face_count(),
        triangles.triangles.len(),
        mesh.positions.len(),
        size.x,
        size.y,
        size.z,
        measure::closedness(&triangles)
    ));
    say("write it with -o FILE, or pipe it into another verb");
}
