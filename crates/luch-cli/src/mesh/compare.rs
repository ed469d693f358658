//! `luch mesh compare`: how far two surfaces are apart.

mod exact;
mod pictures;

use super::input::read_or_run;
use crate::args::CompareMeshesArgs;
use crate::failure::{Failure, Outcome};
use crate::terminal::{say, short};
use luch::mesh::measure;
use luch::mesh::query::{DeviationOptions, hausdorff};
use serde_json::json;

pub(super) fn run(args: &CompareMeshesArgs) -> Result<Outcome, Failure> {
    let Some(b) = &args.b else { return exact::run(args) };
    let [a, b] = [&args.a, b].map(|text| read_or_run(text).map(|mesh| mesh.triangulate()));
    let (a, b) = (a?, b?);
    let options = DeviationOptions {
        samples: args.samples as usize,
        tolerance: args.tolerance,
        ..DeviationOptions::default()
    };
    let empty = || Failure::new("one of the meshes has no triangles");
    let [there, back] = hausdorff(&a, &b, &options).ok_or_else(empty)?;
    let distance = there.greatest.max(back.greatest);
    let bound = there.upper_bound.max(back.upper_bound);
    let bounds = measure::bounds(&b);
    let diagonal = f64::from((bounds.max - bounds.min).length());
    let measures = [&a, &b].map(|mesh| (mesh.triangles.len(), measure::area(mesh), measure::volume(mesh)));
    if args.json {
        let [(triangles_a, area_a, volume_a), (triangles_b, area_b, volume_b)] = measures;
        say(&json!({
            "hausdorff": distance, "upper_bound": bound, "diagonal": diagonal,
            "a_to_b": there, "b_to_a": back,
            "a": { "triangles": triangles_a, "area": area_a, "volume": volume_a },
            "b": { "triangles": triangles_b, "area": area_b, "volume": volume_b },
        })
        .to_string());
    } else {
        let part = if diagonal > 0.0 { 100.0 * distance / diagonal } else { 0.0 };
        say(&format!(
            "Hausdorff distance: {} m, at most {} m ({} % of the diagonal)",
            short(distance),
            short(bound),
            short(part)
        ));
        for (name, one) in [("a to b", there), ("b to a", back)] {
            let [x, y, z] = one.at;
            say(&format!(
                "{name}: greatest {} m at {x} {y} {z}, mean {} m, root mean square {} m",
                short(one.greatest),
                short(one.mean),
                short(one.root_mean_square)
            ));
        }
        for (name, (triangles, area, volume)) in ["a", "b"].into_iter().zip(measures) {
            say(&format!("{name}: {triangles} triangles, area {area} m², volume {volume} m³"));
        }
    }
    match args.max_distance {
        Some(limit) if bound > limit => {
            crate::terminal::complain(&format!("the distance may be {bound} m, more than {limit} m"));
            Ok(Outcome::Unmet)
        }
        _ => Ok(Outcome::Done),
    }
}
