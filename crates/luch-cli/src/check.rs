//! `luch check`: what is in a scene file, and what is wrong with it.

mod meshes;
mod place;
mod report;
mod used;

use crate::args::CheckArgs;
use crate::failure::{Failure, Outcome};
use crate::terminal;
use luch::bvh::Aabb;
use luch::formats::{Files, Loaded};
use luch::render::Film;
use luch::scene::{Scene, Shape};
use meshes::MeshReport;
use report::{CameraReport, Counts, Memory, Report, TextureReport};

pub(crate) fn run(args: &CheckArgs) -> Result<Outcome, Failure> {
    let loaded = args.parameters.load(&args.file, &Files::disk())?;
    let report = examine(&loaded, &args.file.display().to_string());
    if args.json {
        terminal::say(&serde_json::to_string(&report)?);
    } else {
        report.lines().iter().for_each(|line| terminal::say(line));
    }
    Ok(Outcome::Done)
}

fn examine(loaded: &Loaded, file: &str) -> Report {
    let scene = &loaded.scene;
    let bounds = bounds(scene);
    let meshes = meshes::examine(scene);
    let mut advice = used::advice(scene);
    advice.extend(meshes::open_glass(scene, &meshes));
    advice.extend(place::advice(scene, &bounds));
    let texts = |problems: &[luch::formats::Warning]| problems.iter().map(ToString::to_string).collect();
    Report {
        file: file.to_owned(),
        counts: count(scene),
        bounds: (!bounds.is_empty()).then(|| [bounds.min.to_array(), bounds.max.to_array()]),
        memory: memory(scene, &meshes),
        picture: [scene.settings.width, scene.settings.height],
        samples: loaded.wishes.samples,
        cameras: scene.cameras.iter().map(CameraReport::of).collect(),
        textures: scene.images.iter().map(|image| TextureReport::of(image)).collect(),
        meshes,
        warnings: texts(&loaded.warnings),
        notes: loaded.notes.clone(),
        advice,
    }
}

/// A box around everything in the world that has an end.
fn bounds(scene: &Scene) -> Aabb {
    let mut all = Aabb::empty();
    for instance in &scene.instances {
        let own = match &*scene.shapes[instance.shape.index()] {
            Shape::Mesh(mesh) => mesh.bounds(),
            Shape::Sphere { radius } => {
                Aabb::of_points([-glam::Vec3::splat(*radius), glam::Vec3::splat(*radius)])
            }
            Shape::Disc { radius } => {
                let corner = glam::Vec3::new(*radius, 0.0, *radius);
                Aabb::of_points([-corner, corner])
            }
            Shape::Traced(form) => Aabb::of_points(form.corners()),
            Shape::Plane => continue,
        };
        if !own.is_empty() {
            all = all.union(&own.transformed(&instance.placement));
        }
    }
    all
}

fn count(scene: &Scene) -> Counts {
    let triangles = |shape: &Shape| match shape {
        Shape::Mesh(mesh) => mesh.triangles.len() as u64,
        _ => 0,
    };
    let emits = |instance: &&luch::scene::Instance| {
        instance.materials.iter().any(|material| scene.materials[material.index()].emission.is_some())
    };
    Counts {
        shapes: scene.shapes.len(),
        triangles: scene.shapes.iter().map(|shape| triangles(shape)).sum(),
        instances: scene.instances.len(),
        triangles_seen: scene.instances.iter().map(|i| triangles(&scene.shapes[i.shape.index()])).sum(),
        materials: scene.materials.len(),
        textures: scene.textures.len(),
        images: scene.images.len(),
        lights: scene.lights.len(),
        shining_objects: scene.instances.iter().filter(emits).count(),
        has_environment: scene.environment.is_some(),
        cameras: scene.cameras.len(),
    }
}

/// Bytes of a triangle in the trees: three corners and, spread over its leaf, its share of the boxes above it.
const TREE_BYTES: u64 = 100;

fn memory(scene: &Scene, meshes: &[MeshReport]) -> Memory {
    let film = Film::new(1, 1).memory() as u64;
    let pixels = u64::from(scene.settings.width) * u64::from(scene.settings.height);
    Memory {
        meshes: meshes.iter().map(|mesh| mesh.bytes).sum(),
        trees: meshes.iter().map(|mesh| mesh.triangles as u64 * TREE_BYTES).sum(),
        images: scene.images.iter().map(|image| image.memory_bytes() as u64).sum(),
        // A film of one pixel is a tile's head and one pixel's sums; heads do not count among a thousand pixels.
        film: pixels * film.min(72),
    }
}
