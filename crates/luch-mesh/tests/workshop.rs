//! What every verb promises, over everything that can be made and over meshes that are broken.

use glam::{Vec2, Vec3};
use luch_mesh::polygon_mesh::{CornerAttribute, Crease};
use luch_mesh::workshop::{Action, Files, Pipeline, Step, Verb, verbs};
use luch_mesh::{PolygonMesh, measure};

/// The files of examples: a mesh under any name.
struct Examples;

impl Files for Examples {
    fn bytes(&mut self, name: &str) -> Result<Vec<u8>, String> {
        Err(format!("no file {name}"))
    }

    fn mesh(&mut self, _: &str) -> Result<PolygonMesh, String> {
        Pipeline::parse("cuboid --size 0.75,1.5,0.5 | translate 0.1,0.2,0.3")
            .and_then(|p| p.run(self))
            .map_err(|e| e.to_string())
    }
}

fn example(verb: &'static Verb) -> Step {
    let line = format!("{} {}", verb.name, verb.example);
    let steps = Pipeline::parse(&line).unwrap_or_else(|error| panic!("{line}: {error}")).steps;
    steps.into_iter().next().expect("one step")
}

fn needs_files(verb: &Verb) -> bool {
    verb.parameters.iter().any(|p| {
        p.kind == luch_mesh::workshop::Kind::File && p.default == luch_mesh::workshop::Fallback::Required
    })
}

/// The results of all verbs that make meshes.
fn makes() -> Vec<(&'static Verb, PolygonMesh)> {
    let makers = verbs().filter(|verb| matches!(verb.action, Action::Make { .. }) && !needs_files(verb));
    makers
        .map(|verb| {
            let mesh = example(verb).run(None, &mut Examples);
            (verb, mesh.unwrap_or_else(|error| panic!("{} {}: {error}", verb.name, verb.example)))
        })
        .collect()
}

fn assert_sound(mesh: &PolygonMesh, context: &str) {
    let triangles = mesh.triangulate();
    assert_eq!(triangles.validate(), [], "{context}");
    assert_eq!(mesh.face_ends.last().map_or(0, |end| *end as usize), mesh.corners.len(), "{context}");
    let parallel = |length: usize| length == 0 || length == mesh.corners.len();
    assert!(parallel(mesh.normals.corners.len()) && parallel(mesh.colors.corners.len()), "{context}");
    assert!(mesh.uv_sets.iter().all(|uvs| parallel(uvs.corners.len())), "{context}");
    assert!(mesh.slots.is_empty() || mesh.slots.len() == mesh.face_count(), "{context}");
    assert!(
        mesh.creases.iter().flat_map(|c| c.vertices).all(|v| (v as usize) < mesh.positions.len()),
        "{context}"
    );
}

#[test]
fn makers_make_sound_meshes_closed_as_declared() {
    for (verb, mesh) in makes() {
        assert_sound(&mesh, verb.name);
        let Action::Make { closed, .. } = verb.action else { continue };
        let report = measure::closedness(&mesh.triangulate());
        assert_eq!(report.is_closed(), closed, "{} {}: {report}", verb.name, verb.example);
    }
}

#[test]
fn makers_wind_bodies_outward() {
    for (verb, mesh) in makes() {
        let triangles = mesh.triangulate();
        if measure::closedness(&triangles).is_closed() {
            assert!(measure::volume(&triangles) > 0.0, "{} {}", verb.name, verb.example);
        }
    }
}

#[test]
fn changes_keep_what_they_promise() {
    let changers: Vec<_> =
        verbs().filter(|verb| matches!(verb.action, Action::Change { .. }) && !needs_files(verb)).collect();
    let mut opened = Vec::new();
    for (maker, mesh) in makes() {
        let mut mesh = mesh;
        // A crease along the first edge, to be kept.
        if mesh.creases.is_empty() && mesh.corners.len() > 1 {
            mesh.creases.push(Crease { vertices: [mesh.corners[0], mesh.corners[1]], sharpness: 2.0 });
        }
        let was_closed = measure::closedness(&mesh.triangulate()).is_closed();
        for &verb in &changers {
            let Action::Change { keeps, .. } = verb.action else { continue };
            let context = format!("{} {} | {} {}", maker.name, maker.example, verb.name, verb.example);
            // An operation may refuse, saying why; what it gives must be as promised.
            let Ok(changed) = example(verb).run(Some(mesh.clone()), &mut Examples) else { continue };
            assert_sound(&changed, &context);
            // A face with holes is cut in its plane: once it is bent, its triangles may miss some of its corners.
            if keeps.closed && was_closed && mesh.holes.is_empty() {
                let report = measure::closedness(&changed.triangulate());
                if !report.is_closed() {
                    opened.push(format!("{context}: {report}"));
                }
            }
            if keeps.uvs && changed.face_count() > 0 {
                assert!(mesh.uv_sets.len() <= changed.uv_sets.len(), "{context}");
            }
            if keeps.creases {
                assert_eq!(mesh.creases.is_empty(), changed.creases.is_empty(), "{context}");
            }
            if keeps.faces {
                assert_eq!(mesh.face_count(), changed.face_count(), "{context}");
            }
            if keeps.positions {
                assert_eq!(mesh.positions.len(), changed.positions.len(), "{context}");
            }
        }
    }
    assert!(opened.is_empty(), "{}", opened.join("\n"));
}

/// Every operation works on a plain cube.
#[test]
fn changes_do_something_sound_to_a_cube() {
    let cube = Pipeline::parse("cuboid").and_then(|p| p.run(&mut Examples)).expect("a cube");
    for verb in verbs().filter(|verb| matches!(verb.action, Action::Change { .. }) && !needs_files(verb)) {
        let changed = example(verb).run(Some(cube.clone()), &mut Examples);
        let changed = changed.unwrap_or_else(|error| panic!("{} {}: {error}", verb.name, verb.example));
        assert_sound(&changed, verb.name);
    }
}

/// Meshes that no one should make.
fn odd_meshes() -> Vec<(&'static str, PolygonMesh)> {
    let of = |positions: &[[f32; 3]], faces: &[&[u32]]| {
        let mut mesh = PolygonMesh {
            positions: positions.iter().map(|p| Vec3::from(*p)).collect(),
            ..Default::default()
        };
        for face in faces {
            mesh.add_face(face);
        }
        mesh
    };
    let square = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0], [0.5, 0.5, 1.0]];
    let mut bow = of(&square, &[&[0, 2, 1, 3]]);
    bow.uv_sets.push(CornerAttribute::per_position(vec![Vec2::ZERO; 5]));
    let mut holed = of(&square, &[]);
    holed.add_face_with_holes(&[0, 1, 2, 3], &[&[4, 4, 4], &[]]);
    let mut stray = of(&square, &[&[0, 1, 2]]);
    stray.creases.push(Crease { vertices: [3, 4], sharpness: f32::INFINITY });
    vec![
        ("nothing", PolygonMesh::default()),
        ("points only", of(&square, &[])),
        ("an empty face, a point, an edge", of(&square, &[&[], &[0], &[0, 1]])),
        ("one triangle", of(&square, &[&[0, 1, 2]])),
        ("repeated corners", of(&square, &[&[0, 0, 1, 1, 2], &[3, 3, 3]])),
        ("three faces at an edge", of(&square, &[&[0, 1, 2], &[0, 1, 3], &[1, 0, 4], &[0, 1, 4]])),
        ("two fans at a vertex", of(&square, &[&[0, 1, 4], &[2, 3, 4]])),
        ("the same face twice and once reversed", of(&square, &[&[0, 1, 2], &[0, 1, 2], &[2, 1, 0]])),
        ("a bow tie", bow),
        ("a hole without area", holed),
        ("a crease where no face is", stray),
        ("coincident points", of(&[[1.0; 3]; 5], &[&[0, 1, 2], &[2, 1, 3], &[4, 3, 2, 1]])),
        (
            "huge",
            of(
                &[[3e38, 0.0, 0.0], [-3e38, 1.0, 0.0], [0.0, 3e38, 1.0], [0.0, 0.0, -3e38]],
                &[&[0, 1, 2], &[0, 2, 3]],
            ),
        ),
        (
            "not finite",
            of(
                &[[f32::NAN, 0.0, 0.0], [f32::INFINITY, 1.0, 0.0], [0.0, 1.0, 1.0], [0.0, 0.0, 0.0]],
                &[&[0, 1, 2], &[0, 2, 3]],
            ),
        ),
    ]
}

/// An answer or a refusal, never a panic.
#[test]
fn changes_survive_odd_meshes() {
    for (name, mesh) in odd_meshes() {
        for verb in verbs().filter(|verb| matches!(verb.action, Action::Change { .. }) && !needs_files(verb))
        {
            let step = example(verb);
            let mesh = mesh.clone();
            let result = std::panic::catch_unwind(move || {
                step.run(Some(mesh), &mut Examples).map(|changed| changed.triangulate())
            });
            assert!(result.is_ok(), "{} {} panics on: {name}", verb.name, verb.example);
        }
    }
}
