//! What is chosen where a file says nothing: camera, light, material, normals.

use glam::Vec3;
use luch_formats::{Files, Loaded, bounding_sphere, framing_camera, load_with, neutral_sky};
use luch_image::{Image, Rgb};
use luch_mesh::{TriangleMesh, codec, generate};
use luch_scene::{Environment, Projection, Scene, Shape, Surface};
use std::path::{Path, PathBuf};

fn load(path: &str, bytes: Vec<u8>) -> Loaded {
    let files = Files::memory([(PathBuf::from(path), bytes)]);
    load_with(Path::new(path), &files).unwrap_or_else(|error| panic!("{error}"))
}

/// Where a point is in the picture: x and y from −1 to 1 within it.
fn in_picture(scene: &Scene, point: Vec3) -> (f32, f32) {
    let camera = scene.cameras[0].camera;
    let Projection::Perspective { field_of_view_y } = camera.projection else { panic!() };
    let local = camera.orientation.transpose() * (point - camera.position);
    let half = libm::tanf(field_of_view_y / 2.0);
    let aspect = scene.settings.width as f32 / scene.settings.height as f32;
    (local.x / -local.z / half / aspect, local.y / -local.z / half)
}

#[test]
fn everything_is_in_the_picture_and_fills_it() {
    for (width, height) in [(960, 540), (300, 900), (100, 100)] {
        let mesh = generate::sphere(3.0, 64, 32);
        let text = format!(
            "luch 1\nsettings {{ size {width} {height} }}\nobject {{ mesh {{ sphere radius=3 }}; translate 100 20 -7 }}"
        );
        let scene = load("a.kdl", text.into_bytes()).scene;
        let mut widest = 0f32;
        for &position in &mesh.positions {
            let (x, y) = in_picture(&scene, position + Vec3::new(100.0, 20.0, -7.0));
            assert!(x.abs() <= 1.0 && y.abs() <= 1.0, "{x} {y} at {width}×{height}");
            widest = widest.max(x.abs()).max(y.abs());
        }
        assert!(widest > 0.93, "only {widest} of the picture is used at {width}×{height}");
        let camera = scene.cameras[0].camera;
        assert!(camera.position.y > 20.0 && camera.position.x > 100.0, "from above and the right");
    }
}

#[test]
fn the_bounding_ball_holds_stretched_instances() {
    let text = "luch 1\nobject { sphere radius=1; scale 3 1 0.5; rotate-z 30; translate 5 0 0 }\nobject { disc radius=2; translate -4 1 0 }\nobject { plane }";
    let scene = load("a.kdl", text.into()).scene;
    let ball = bounding_sphere(&scene).unwrap();
    let placement = scene.instances[0].placement;
    for i in 0..1000 {
        let (a, b) = (i as f32 * 0.1, i as f32 * 0.0031);
        let unit = Vec3::new(libm::cosf(a) * libm::sinf(b), libm::cosf(b), libm::sinf(a) * libm::sinf(b));
        assert!(placement.transform_point3(unit).distance(ball.center) <= ball.radius * (1.0 + 1e-5));
    }
    for x in [-6.0, -2.0] {
        assert!(Vec3::new(x, 1.0, 0.0).distance(ball.center) <= ball.radius * (1.0 + 1e-5));
    }
}

#[test]
fn scenes_without_an_end_or_without_anything_get_a_camera_too() {
    for text in [
        "luch 1",
        "luch 1\nobject { plane }",
        "luch 1\nobject { sphere radius=1e18 }",
        "luch 1\nobject { sphere radius=1e-18 }",
    ] {
        let scene = load("a.kdl", text.into()).scene;
        assert!(scene.cameras[0].camera.position.is_finite(), "{text}");
        assert_eq!(scene.problems(), [] as [String; 0]);
    }
    assert_eq!(framing_camera(&Scene::default()).1.radius, 1.0);
}

#[test]
fn a_bare_mesh_is_clay_under_a_neutral_sky() {
    let mesh = generate::sphere(1.0, 64, 32);
    let bare = TriangleMesh::new(mesh.positions.clone(), mesh.triangles.clone());
    let loaded = load("ball.stl", codec::stl::encode_binary(&bare));
    let scene = &loaded.scene;
    assert!(matches!(scene.environment, Some(Environment::LatLong { .. })));
    let Surface::Diffuse { color } = &scene.materials[0].surface else { panic!() };
    assert!((color.factor.luminance() - 0.7).abs() < 0.02);
    let Shape::Mesh(read) = &*scene.shapes[0] else { panic!() };
    // All edges of the ball are bent by less than 30°: one normal for each position, near the true one.
    assert_eq!(read.normals.values.len(), read.positions.len());
    for triangle in 0..read.triangles.len() {
        let (corners, normals) = (read.corners(triangle), read.corner_normals(triangle).unwrap());
        for (corner, normal) in corners.into_iter().zip(normals) {
            assert!(corner.dot(normal) > 0.99, "{corner} {normal}");
        }
    }
    assert_eq!(loaded.notes.len(), 4, "{:?}", loaded.notes);
}

#[test]
fn edges_bent_by_more_than_30_degrees_stay_hard() {
    let mesh = generate::cuboid(Vec3::ONE, [1; 3]);
    let bare = TriangleMesh::new(mesh.positions.clone(), mesh.triangles.clone());
    let Shape::Mesh(read) = &*load("box.stl", codec::stl::encode_binary(&bare)).scene.shapes[0] else {
        panic!()
    };
    for triangle in 0..read.triangles.len() {
        let facet = read.area_normal(triangle).normalize();
        assert!(read.corner_normals(triangle).unwrap().iter().all(|normal| normal.dot(facet) > 0.999));
    }
}

#[test]
fn vertex_colours_of_a_ply_file_are_used() {
    let text = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
        property uchar red\nproperty uchar green\nproperty uchar blue\nelement face 1\nproperty list uchar int vertex_indices\n\
        end_header\n0 0 0 255 0 0\n1 0 0 0 255 0\n0 1 0 0 0 255\n3 0 1 2\n";
    let scene = load("a.ply", text.into()).scene;
    let Surface::Diffuse { color } = &scene.materials[0].surface else { panic!() };
    assert!(color.vertex_color && color.factor == Rgb::WHITE);
    let Shape::Mesh(mesh) = &*scene.shapes[0] else { panic!() };
    assert_eq!(mesh.colors.values[0], glam::Vec4::new(1.0, 0.0, 0.0, 1.0));
}

#[test]
fn content_tells_the_format_where_the_name_does_not() {
    let mesh = generate::cuboid(Vec3::ONE, [1; 3]);
    for (bytes, instances) in [
        (codec::stl::encode_binary(&mesh), 1),
        (codec::ply::encode(&mesh, codec::ply::Encoding::LittleEndian), 1),
        (codec::obj::encode(&mesh, &Default::default()).into_bytes(), 1),
        (b"// a scene\nluch 1\nobject { sphere }\nobject { plane }".to_vec(), 2),
        (b"<?xml version=\"1.0\"?><scene version=\"3.0.0\"><shape type=\"cube\"/></scene>".to_vec(), 1),
    ] {
        assert_eq!(load("thing", bytes).scene.instances.len(), instances);
    }
}

/// A gray ball in the sky is lit well: the irradiance of every direction, over π, times its albedo.
#[test]
fn the_neutral_sky_neither_blinds_nor_starves() {
    let sky: Image<Rgb> = neutral_sky().to_rgb();
    let (width, height) = (sky.width(), sky.height());
    assert!(width <= 128 && height <= 64);
    let mut brightness = Vec::new();
    for normal in
        [Vec3::X, Vec3::NEG_X, Vec3::Y, Vec3::NEG_Y, Vec3::Z, Vec3::new(-0.55, 0.65, 0.52).normalize()]
    {
        let mut irradiance = Rgb::BLACK;
        for row in 0..height {
            for column in 0..width {
                let polar = (row as f32 + 0.5) / height as f32 * std::f32::consts::PI;
                let longitude = ((column as f32 + 0.5) / width as f32 - 0.5) * std::f32::consts::TAU;
                let (ring, up) = (libm::sinf(polar), libm::cosf(polar));
                let direction = Vec3::new(ring * libm::sinf(longitude), up, -ring * libm::cosf(longitude));
                let solid_angle =
                    ring * std::f32::consts::PI / height as f32 * std::f32::consts::TAU / width as f32;
                irradiance += *sky.get(column, row) * (direction.dot(normal).max(0.0) * solid_angle);
            }
        }
        brightness.push(irradiance * (0.7 / std::f32::consts::PI));
    }
    let [right, left, above, below, front, key] = brightness[..] else { panic!() };
    assert!(key.luminance() > 0.7 && key.luminance() < 1.2, "{key:?}");
    assert!(key.r > key.b && right.b > right.r, "a warm key and a cool fill: {key:?} {right:?}");
    for side in [right, left, above, below, front] {
        assert!(side.luminance() > 0.1 && side.luminance() < 1.0, "{side:?}");
    }
    assert!(below.luminance() < above.luminance() / 2.0);
}
