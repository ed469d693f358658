//! What covers what: closed surfaces, turned faces, holes cut by materials, threads.

use crate::views::{cameras, crumpled};
use glam::{Affine3A, Vec2, Vec3};
use luch_image::{Image, Rgb};
use luch_mesh::{Attribute, PolygonMesh, TriangleMesh, generate};
use luch_preview::{Antialiasing, Dots, Fill, Lines, Marks, NOTHING, Picture, Size, Style, Subject, draw};
use luch_scene::{Material, Opacity, ScalarValue, Scene, Shape, Sides, Texture, TextureUse, preset};

const SIZE: Size = Size { width: 150, height: 100 };

fn covered(picture: &Picture) -> Vec<bool> {
    picture.faces.pixels().iter().map(|&face| face != NOTHING).collect()
}

fn turned(mut mesh: TriangleMesh) -> TriangleMesh {
    mesh.triangles.iter_mut().for_each(|corners| corners.swap(1, 2));
    mesh
}

/// A line of sight from outside enters a closed surface as often as it leaves it, however crumpled it is. With any sample
/// covered twice or not at all along an edge this would fail.
#[test]
fn fronts_and_backs_of_closed_meshes_cover_the_same_pixels() {
    let style = Style { hides_back_faces: true, ..Style::default() };
    for seed in 0..8 {
        let sphere = generate::icosphere(1.0, 4);
        let mesh = crumpled(
            if seed < 4 { sphere } else { generate::torus(0.7, 0.3, 90, 50) },
            seed,
            0.02 * seed as f32,
        );
        let inside_out = turned(mesh.clone());
        // From outside; within, there are backs without fronts.
        for camera in [&cameras()[0], &cameras()[3], &cameras()[4]] {
            let see = |mesh: &TriangleMesh, style| {
                covered(&draw(&Subject::triangles(mesh), camera, SIZE, style).unwrap())
            };
            let fronts = see(&mesh, &style);
            assert!(fronts == see(&inside_out, &style), "{seed}");
            assert!(fronts == see(&mesh, &Style::default()), "{seed}");
            assert!(fronts.iter().filter(|&&covered| covered).count() > 300);
        }
    }
}

#[test]
fn hidden_backs_leave_the_inside_of_the_far_wall_only() {
    let mesh = turned(generate::icosphere(1.0, 3));
    let hiding = Style { hides_back_faces: true, ..Style::default() };
    let subject = Subject::triangles(&mesh);
    let all = draw(&subject, &cameras()[0], SIZE, &Style::default()).unwrap();
    let far = draw(&subject, &cameras()[0], SIZE, &hiding).unwrap();
    let mut deeper = 0;
    for (near, far) in all.depth.pixels().iter().zip(far.depth.pixels()) {
        assert!(far >= near);
        deeper += u32::from(far > near);
    }
    assert!(deeper > 1000, "{deeper}");
}

/// Red where the inside is seen, for mirrored placements as well.
#[test]
fn facing_follows_the_outside() {
    for (scale, inside_out) in [(Vec3::ONE, false), (Vec3::ONE, true), (Vec3::new(-1.0, 1.0, 2.0), false)] {
        let mesh = generate::icosphere(1.0, 2);
        let mut scene = Scene::default();
        let shape = scene.add_shape(Shape::Mesh(if inside_out { turned(mesh) } else { mesh }));
        let material = scene.add_material(Material::diffuse(Rgb::WHITE));
        scene.add_instance(shape, material, Affine3A::from_scale(scale));
        let picture =
            draw(&Subject::scene(&scene), &cameras()[0], SIZE, &Style::filled(Fill::Facing)).unwrap();
        for (color, face) in picture.color.pixels().iter().zip(picture.faces.pixels()) {
            assert!(*face == NOTHING || (color.r > color.b) == inside_out);
        }
    }
}

/// A chessboard as alpha, and a material with one side.
#[test]
fn gaps_of_materials_are_gaps() {
    let mut scene = Scene::default();
    let mut mesh = preset::parallelogram(Vec3::new(-1.0, -1.0, 0.0), Vec3::X * 2.0, Vec3::Y * 2.0);
    let uv = |p: &Vec3| Vec2::new(p.x, p.y) * 2.0 + 0.001;
    mesh.uv_sets.push(Attribute::per_position(mesh.positions.iter().map(uv).collect()));
    let shape = scene.add_shape(Shape::Mesh(mesh));
    let texture = scene.add_texture(Texture::Checker { even: Rgb::WHITE, odd: Rgb::BLACK });
    let used = (TextureUse::new(texture), luch_scene::Channel::Red);
    let alpha = ScalarValue { factor: 0.8, texture: Some(used), vertex_alpha: false };
    let size = Size { width: 64, height: 64 };
    let front = luch_scene::Camera {
        projection: luch_scene::Projection::Orthographic { height: 2.0 },
        ..luch_scene::Camera::looking_at(Vec3::Z * 2.0, Vec3::ZERO, Vec3::Y, 1.0)
    };
    let back = luch_scene::Camera {
        projection: front.projection,
        ..luch_scene::Camera::looking_at(Vec3::Z * -2.0, Vec3::ZERO, Vec3::Y, 1.0)
    };
    let count = |opacity: Opacity, sides: Sides, camera| {
        let mut scene = scene.clone();
        let material = Material { opacity, sides, ..Material::diffuse(Rgb::WHITE) };
        let material = scene.add_material(material);
        scene.add_instance(shape, material, Affine3A::IDENTITY);
        let picture = draw(&Subject::scene(&scene), camera, size, &Style::default()).unwrap();
        covered(&picture).iter().filter(|&&covered| covered).count()
    };
    let whole = 64 * 64;
    assert_eq!(count(Opacity::Opaque, Sides::Both, &back), whole);
    assert_eq!(count(Opacity::Opaque, Sides::Front, &front), whole);
    assert_eq!(count(Opacity::Opaque, Sides::Front, &back), 0);
    for opacity in [Opacity::Mask { alpha, cutoff: 0.5 }, Opacity::Blend { alpha }] {
        // Half of the squares, which are 16 pixels wide; they are moved by 0.03 pixels.
        assert_eq!(count(opacity, Sides::Both, &front), whole / 2);
    }
    assert_eq!(count(Opacity::Mask { alpha, cutoff: 0.9 }, Sides::Both, &front), 0);
}

fn everything() -> Style {
    Style {
        lines: Some(Lines::default()),
        marks: Some(Marks::default()),
        dots: Some(Dots::default()),
        antialiasing: Antialiasing::Four,
        ..Style::default()
    }
}

#[test]
fn the_picture_is_the_same_for_any_number_of_threads() {
    let mut scene = preset::cornell_box();
    let mesh = crumpled(generate::torus(0.5, 0.3, 120, 60), 3, 0.05);
    let shape = scene.add_shape(Shape::Mesh(mesh));
    let ball = scene.add_shape(Shape::Sphere { radius: 0.4 });
    let material = scene.add_material(Material::diffuse(Rgb::gray(0.5)));
    for i in 0..4 {
        let place = Affine3A::from_translation(Vec3::new(0.3 * i as f32 - 0.5, 0.5 + 0.2 * i as f32, 0.3));
        scene.add_instance(if i % 2 == 0 { shape } else { ball }, material, place);
        // Twice in the same place: ties go to the lower number.
        scene.add_instance(if i % 2 == 0 { shape } else { ball }, material, place);
    }
    let camera = *scene.camera(None).unwrap();
    let picture = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| draw(&Subject::scene(&scene), &camera, SIZE, &everything()).unwrap())
    };
    let one = picture(1);
    let seen: Vec<u32> = one.instances.pixels().iter().copied().filter(|&i| i != NOTHING && i >= 8).collect();
    assert!(!seen.is_empty() && seen.iter().all(|instance| instance % 2 == 0), "ties go to the lower number");
    for threads in [2, 3] {
        assert!(picture(threads) == one, "{threads} threads");
    }
}

/// Softening changes colours only, and the mean of many samples tends to the covered area.
#[test]
fn softening_leaves_numbers_and_depths_alone() {
    let mesh = generate::icosphere(1.0, 4);
    let subject = Subject::triangles(&mesh);
    let style =
        |antialiasing| Style { antialiasing, background: Rgb::BLACK, ..Style::filled(Fill::Instances) };
    let camera = &cameras()[4];
    let [hard, soft] = [Antialiasing::None, Antialiasing::Sixteen]
        .map(|antialiasing| draw(&subject, camera, SIZE, &style(antialiasing)).unwrap());
    assert_eq!((&hard.depth, &hard.faces, &hard.instances), (&soft.depth, &soft.faces, &soft.instances));
    let light = |image: &Image<Rgb>| image.pixels().iter().map(|color| f64::from(color.g)).sum::<f64>();
    let full = f64::from(hard.color.get(SIZE.width / 2, SIZE.height / 2).g);
    // A disc of radius 1 in a picture 3 high; lattice points in a disc of radius r: an error of r or so, of a perimeter of 6 r.
    let radius = f64::from(SIZE.height) / 3.0;
    let area = std::f64::consts::PI * radius * radius;
    assert!((light(&hard.color) / full - area).abs() < 20.0);
    assert!((light(&soft.color) / full - area).abs() < 5.0);
}

/// A mesh of polygons shows the numbers of its polygons.
#[test]
fn faces_are_those_of_the_polygons() {
    let mut mesh = PolygonMesh { positions: Vec::new(), ..Default::default() };
    for i in 0..3 {
        let x = i as f32 * 0.5 - 0.75;
        let start = mesh.positions.len() as u32;
        mesh.positions.extend(
            [(x, -0.5), (x + 0.5, -0.5), (x + 0.5, 0.5), (x, 0.5)].map(|(x, y)| Vec3::new(x, y, 0.0)),
        );
        mesh.add_face(&[start, start + 1, start + 2, start + 3]);
    }
    let camera = luch_scene::Camera {
        projection: luch_scene::Projection::Orthographic { height: 1.0 },
        ..luch_scene::Camera::looking_at(Vec3::Z, Vec3::ZERO, Vec3::Y, 1.0)
    };
    let picture = draw(&Subject::polygons(&mesh), &camera, SIZE, &Style::default()).unwrap();
    for y in 0..SIZE.height {
        for x in 0..SIZE.width {
            assert_eq!(*picture.faces.get(x, y), x / 50);
        }
    }
}
