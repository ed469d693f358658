//! One picture of each kind: `gallery FOLDER [FILE.obj]` writes them as PNG files.

use glam::{Affine3A, Vec3};
use luch_image::codec::{self, Metadata};
use luch_image::{Image, Rgb, srgb};
use luch_mesh::{PolygonMesh, generate};
use luch_preview::{
    Antialiasing, Dots, EdgeSet, Fill, Hidden, Lines, Marks, Size, StandardView, Style, Subject,
    contact_sheet, draw, frame_all, frame_all_parallel,
};
use luch_scene::{Material, Normals, Scene, Shape, preset};
use std::error::Error;
use std::path::Path;

const SIZE: Size = Size { width: 640, height: 400 };
const ASPECT: f32 = 1.6;
/// Radians.
const FIELD_OF_VIEW: f32 = 0.6;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let folder = Path::new(arguments.first().ok_or("which folder?")?);
    std::fs::create_dir_all(folder)?;
    let smooth = Style { antialiasing: Antialiasing::Sixteen, ..Style::default() };

    // A torus in every fill, seen from the same side.
    let torus = generate::torus(1.0, 0.4, 48, 24);
    let subject = Subject::triangles(&torus);
    let view = |subject: &Subject| {
        frame_all(&subject.bounds(), StandardView::ThreeQuarter.direction(), FIELD_OF_VIEW, ASPECT)
    };
    for fill in Fill::ALL.into_iter().filter(|&fill| fill != Fill::Nothing) {
        let picture = draw(&subject, &view(&subject), SIZE, &Style { fill, ..smooth })?;
        write(folder, &format!("torus-{}", fill.name()), &picture.color)?;
    }
    let flat = Style { normals: Normals::Flat, lines: Some(Lines::default()), ..smooth };
    write(folder, "torus-flat-edges", &draw(&subject, &view(&subject), SIZE, &flat)?.color)?;

    // A cylinder as wires, all of them, those in sight, and creases alone.
    let cylinder = PolygonMesh::from(&generate::cylinder(1.0, 2.0, 32, 4, true));
    let subject = Subject::polygons(&cylinder);
    for (name, hidden) in [("removed", Hidden::Removed), ("faint", Hidden::Faint), ("shown", Hidden::Shown)] {
        let picture = draw(&subject, &view(&subject), SIZE, &Style::wireframe(hidden))?;
        write(folder, &format!("cylinder-hidden-{name}"), &picture.color)?;
    }
    let creases = Lines { edges: EdgeSet::Features { crease_angle: 0.7 }, width: 2.0, ..Lines::default() };
    let style = Style { lines: Some(creases), ..smooth };
    write(folder, "cylinder-creases", &draw(&subject, &view(&subject), SIZE, &style)?.color)?;

    // An open mesh with a fin: its borders, the edge of three faces, its vertices, its inside.
    let mut open = generate::sphere(1.0, 24, 12);
    open.triangles.drain(30..110);
    open.normals = Default::default();
    let [a, b, _] = open.triangles[125];
    open.positions.push(open.positions[a as usize] * 1.4);
    open.triangles.push([a, b, open.positions.len() as u32 - 1]);
    let subject = Subject::triangles(&open);
    let style =
        Style { fill: Fill::Facing, marks: Some(Marks::default()), dots: Some(Dots::default()), ..smooth };
    let below = frame_all(&subject.bounds(), Vec3::new(-0.7, 0.8, -1.0), FIELD_OF_VIEW, ASPECT);
    write(folder, "open-marks", &draw(&subject, &below, SIZE, &style)?.color)?;

    // A scene with exact shapes, and one with its own camera.
    let scene = exact_shapes();
    let subject = Subject::scene(&scene);
    let camera = frame_all_parallel(&subject.bounds(), StandardView::ThreeQuarter.direction(), ASPECT);
    let lines = Some(Lines { width: 0.7, ..Lines::default() });
    write(folder, "exact-shapes", &draw(&subject, &camera, SIZE, &Style { lines, ..smooth })?.color)?;
    let room = preset::cornell_box();
    let camera = room.camera(None).ok_or("a scene with a camera")?;
    let size = Size { width: 256, height: 256 };
    write(folder, "cornell-box", &draw(&Subject::scene(&room), camera, size, &smooth)?.color)?;

    // All sides of one mesh on one sheet.
    let mesh = match arguments.get(1) {
        Some(file) => codec_mesh(file)?,
        None => PolygonMesh::from(&torus),
    };
    let subject = Subject::polygons(&mesh);
    let bounds = subject.bounds();
    let cameras = StandardView::ALL.map(|view| frame_all(&bounds, view.direction(), FIELD_OF_VIEW, 1.0));
    let tile = Size { width: 240, height: 240 };
    for (name, fill) in [("shaded", Fill::Shaded), ("checker", Fill::Checker)] {
        let sheet = contact_sheet(&subject, &cameras, tile, 4, &Style { fill, ..smooth })?;
        write(folder, &format!("sheet-{name}"), &sheet)?;
    }
    let sheet = contact_sheet(&subject, &cameras, tile, 4, &Style::wireframe(Hidden::Removed))?;
    write(folder, "sheet-wireframe", &sheet)
}

/// A sphere and a mirrored, stretched one on a disc over a plane.
fn exact_shapes() -> Scene {
    let mut scene = Scene::default();
    let clay = scene.add_material(Material::diffuse(Rgb::new(0.8, 0.4, 0.2)));
    let slate = scene.add_material(Material::diffuse(Rgb::new(0.2, 0.3, 0.4)));
    let ball = scene.add_shape(Shape::Sphere { radius: 1.0 });
    let disc = scene.add_shape(Shape::Disc { radius: 2.5 });
    let plane = scene.add_shape(Shape::Plane);
    scene.add_instance(ball, clay, Affine3A::from_translation(Vec3::new(-0.8, 1.0, 0.0)));
    let stretch = Affine3A::from_scale(Vec3::new(-0.5, 1.5, 0.5));
    scene.add_instance(ball, slate, Affine3A::from_translation(Vec3::new(1.2, 1.5, 0.5)) * stretch);
    scene.add_instance(disc, clay, Affine3A::IDENTITY);
    scene.add_instance(plane, slate, Affine3A::from_translation(Vec3::new(0.0, -0.5, 0.0)));
    scene
}

fn codec_mesh(file: &str) -> Result<PolygonMesh, Box<dyn Error>> {
    Ok(luch_mesh::codec::obj::decode(&std::fs::read(file)?)?.mesh)
}

fn write(folder: &Path, name: &str, image: &Image<Rgb>) -> Result<(), Box<dyn Error>> {
    let bytes = image.map(|light| light.to_array().map(srgb::encode_u8));
    let file = codec::encode_png8(&bytes, &Metadata::default())?;
    Ok(std::fs::write(folder.join(name).with_extension("png"), file)?)
}
