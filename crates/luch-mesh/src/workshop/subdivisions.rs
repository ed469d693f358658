//! Subdivision surfaces.

use super::{Action, Arguments, Keeps, Kind, Parameter, Verb, WorkshopError};
use crate::PolygonMesh;
use crate::polygon_mesh::SharpVertex;
use crate::screen::OnScreen;
use crate::subdivide::{self, Border, Scheme, Settings, UvRule};
use glam::{DVec3, Vec3};

/// Creases become less sharp with each level, and end.
const KEEPS: Keeps = Keeps { closed: true, uvs: true, creases: false, faces: false, positions: false };

/// The verbs of this group.
pub(super) const VERBS: &[Verb] = &[
    Verb {
        name: "subdivide",
        summary: "Divide the faces and smooth the surface, except at creases",
        parameters: &[
            Parameter::new(
                "scheme",
                Kind::Choice(&["catmull-clark", "loop", "midpoint", "sqrt3"]),
                "catmull-clark",
                "the rule: quads, triangles, without smoothing, triangles by three",
            ),
            Parameter::new("levels", Kind::Count { least: 0, most: 12 }, "1", "how often"),
            Parameter::optional(
                "pixels",
                Kind::Pixels,
                "divide where edges are longer than so many pixels on the screen, in place of levels; in scenes",
            ),
            Parameter::new("limit", Kind::Flag, "false", "move the vertices onto the limit surface"),
            Parameter::new("normals", Kind::Flag, "false", "add the normals of the limit surface"),
            Parameter::new("border", Kind::Choice(&["smooth", "corners"]), "smooth", "what stays at borders"),
            Parameter::new(
                "uvs",
                Kind::Choice(&["linear", "seams", "corners", "smooth"]),
                "corners",
                "how uvs are smoothed: not, seams fixed, corners of seams fixed, all",
            ),
        ],
        example: "--scheme loop --levels 1",
        action: Action::Change { keeps: KEEPS, run: subdivide },
    },
    Verb {
        name: "crease-edges",
        summary: "Set how many levels of subdivision edges stay sharp",
        parameters: &[
            Parameter::new(
                "sharpness",
                Kind::NOT_NEGATIVE,
                "1000000",
                "for how many levels; a fraction blends, 0 takes creases away",
            ),
            Parameter::optional(
                "angle",
                Kind::Angle,
                "only edges where faces meet at this angle or a sharper one",
            ),
            Parameter::optional("vertices", Kind::Numbers, "also make these vertices as sharp, by number"),
        ],
        example: "--angle 30deg --sharpness 2",
        action: Action::Change {
            keeps: Keeps { closed: true, uvs: true, creases: false, faces: true, positions: true },
            run: crease,
        },
    },
];

fn subdivide(mesh: PolygonMesh, arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    let settings = Settings {
        scheme: match arguments.choice("scheme") {
            "loop" => Scheme::Loop,
            "midpoint" => Scheme::Midpoint,
            "sqrt3" => Scheme::Sqrt3,
            _ => Scheme::CatmullClark,
        },
        levels: arguments.count("levels"),
        uvs: match arguments.choice("uvs") {
            "linear" => UvRule::Linear,
            "seams" => UvRule::SeamsFixed,
            "smooth" => UvRule::Smooth,
            _ => UvRule::CornersFixed,
        },
        border: if arguments.choice("border") == "corners" { Border::CornersFixed } else { Border::Smooth },
        limit: arguments.flag("limit"),
        normals: arguments.flag("normals"),
    };
    if let Some(screen) = arguments.on_screen("pixels") {
        if !matches!(settings.scheme, Scheme::CatmullClark | Scheme::Loop) {
            return Err(WorkshopError::of("pixels", "is for the schemes catmull-clark and loop"));
        }
        let is_fine = |corners: &[Vec3]| is_fine(corners, screen);
        return subdivide::subdivide_adaptively(&mesh, &settings, &is_fine)
            .map_err(|error| WorkshopError::of("pixels", error.to_string()));
    }
    subdivide::subdivide(&mesh, &settings).map_err(|error| WorkshopError::of("levels", error.to_string()))
}

/// Whether no edge is longer on the screen than it may be.
fn is_fine(corners: &[Vec3], screen: &OnScreen) -> bool {
    let place = |corner: &Vec3| corner.as_dvec3();
    let centre = corners.iter().map(place).sum::<DVec3>() / corners.len().max(1) as f64;
    let radius = corners.iter().map(|corner| place(corner).distance(centre)).fold(0.0, f64::max);
    let most = screen.length(centre, radius);
    let ends = corners.iter().zip(corners.iter().cycle().skip(1));
    ends.map(|(a, b)| place(a).distance(place(b))).all(|length| length <= most)
}

fn crease(mut mesh: PolygonMesh, arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    let sharpness = arguments.number("sharpness");
    // A number that no level count reaches stands for ever.
    let sharpness = if sharpness >= 1e6 { f32::INFINITY } else { sharpness as f32 };
    match arguments.number_if_given("angle") {
        Some(angle) => subdivide::crease_by_angle(&mut mesh, angle, sharpness),
        None if arguments.numbers("vertices").is_empty() => subdivide::crease_all(&mut mesh, sharpness),
        None => {}
    }
    for &number in arguments.numbers("vertices") {
        if !(number >= 0.0 && number < mesh.positions.len() as f64 && number.fract() == 0.0) {
            let message = format!(
                "there is no vertex {number}; vertices have the numbers 0 to {}, without the last",
                mesh.positions.len()
            );
            return Err(WorkshopError::of("vertices", message));
        }
        mesh.sharp_vertices.retain(|sharp| f64::from(sharp.vertex) != number);
        if sharpness > 0.0 {
            mesh.sharp_vertices.push(SharpVertex { vertex: number as u32, sharpness });
        }
    }
    Ok(mesh)
}
