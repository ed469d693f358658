//! Nothing that can be described makes a preview panic or hang.

use glam::{Affine3A, Mat3, Vec2, Vec3, Vec4};
use luch_bvh::Aabb;
use luch_image::{Bitmap, Encoding, Pixels};
use luch_mesh::{Attribute, PolygonMesh, TriangleMesh, generate};
use luch_preview::{
    Antialiasing, Dots, EdgeSet, Fill, Hidden, Lines, Marks, NOTHING, PreviewError, Size, StandardView,
    Style, Subject, contact_sheet, draw, frame_all, frame_all_parallel,
};
use luch_scene::{
    Camera, ColorValue, Id, Instance, Material, Opacity, Projection, ScalarValue, Scene, Shape, Surface,
    Texture, TextureFilter, TextureUse, Wrap,
};

const SIZE: Size = Size { width: 40, height: 30 };

fn camera() -> Camera {
    Camera::looking_at(Vec3::new(2.0, 1.5, 3.0), Vec3::ZERO, Vec3::Y, 0.8)
}

/// One style for each fill, with everything on.
fn styles() -> Vec<Style> {
    let hidden = [Hidden::Removed, Hidden::Faint, Hidden::Shown];
    let style = |(i, fill): (usize, Fill)| Style {
        fill,
        hides_back_faces: i % 3 == 1,
        lines: Some(Lines {
            hidden: hidden[i % 3],
            edges: EdgeSet::Features { crease_angle: 0.5 },
            ..Lines::default()
        }),
        marks: Some(Marks { width: f32::INFINITY, hidden: hidden[i % 3], ..Marks::default() }),
        dots: Some(Dots { diameter: if i % 2 == 0 { 3.0 } else { f32::NAN }, ..Dots::default() }),
        antialiasing: if i % 2 == 0 { Antialiasing::None } else { Antialiasing::Four },
        ..Style::default()
    };
    Fill::ALL.into_iter().enumerate().map(style).collect()
}

fn broken_meshes() -> Vec<TriangleMesh> {
    let sound = || generate::torus(1.0, 0.4, 12, 8);
    let mut meshes = vec![TriangleMesh::default(), TriangleMesh::new(vec![], vec![[0, 1, 2]])];
    for value in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, f32::MAX, f32::MIN_POSITIVE, 1e-42] {
        let mut mesh = sound();
        for (i, position) in mesh.positions.iter_mut().enumerate() {
            position[i % 3] = if i % 4 == 0 { value } else { position[i % 3] };
        }
        meshes.push(mesh);
        let mut all = sound();
        all.positions.fill(Vec3::splat(value));
        meshes.push(all);
    }
    let mut indices = sound();
    indices.triangles[3] = [0, u32::MAX, 7];
    indices.triangles[5] = [1, 1, 1];
    indices.triangles[6] = [2, 2, 3];
    meshes.push(indices);
    let mut lists = sound();
    lists.normals = Attribute::per_position(vec![Vec3::NAN; 3]);
    lists.uv_sets = vec![Attribute { values: vec![Vec2::INFINITY], triangles: vec![[0, 5, 0]] }];
    lists.colors = Attribute::per_position(vec![Vec4::splat(f32::NAN); 2]);
    lists.slots = vec![9; 4];
    meshes.push(lists);
    let mut many = sound();
    many.triangles.extend_from_within(..);
    meshes.push(many);
    meshes
}

#[test]
fn broken_meshes_are_drawn_as_far_as_they_go() {
    for (number, mesh) in broken_meshes().iter().enumerate() {
        for style in styles() {
            let picture = draw(&Subject::triangles(mesh), &camera(), SIZE, &style).unwrap();
            assert!(
                picture.color.pixels().iter().all(|color| color.is_finite()),
                "{number} {:?}",
                style.fill
            );
            let sound = PolygonMesh::from(mesh);
            draw(&Subject::polygons(&sound), &camera(), SIZE, &style).unwrap();
        }
    }
}

#[test]
fn what_is_broken_is_left_out_and_the_rest_is_there() {
    let mut mesh = generate::torus(1.0, 0.4, 24, 12);
    let whole = draw(&Subject::triangles(&mesh), &camera(), SIZE, &Style::default()).unwrap();
    let count = mesh.triangles.len() as u32;
    mesh.positions.push(Vec3::NAN);
    mesh.triangles.push([0, 1, mesh.positions.len() as u32 - 1]);
    mesh.triangles.push([0, 1, u32::MAX]);
    let more = draw(&Subject::triangles(&mesh), &camera(), SIZE, &Style::default()).unwrap();
    assert_eq!(whole.faces, more.faces);
    assert!(more.faces.pixels().iter().any(|&face| face < count));
}

#[test]
fn broken_polygons_are_drawn_as_far_as_they_go() {
    let mut mesh = PolygonMesh::from(&generate::torus(1.0, 0.4, 12, 8));
    mesh.corners[7] = u32::MAX;
    mesh.face_ends[5] = 3;
    mesh.face_ends.push(u32::MAX);
    for style in styles() {
        draw(&Subject::polygons(&mesh), &camera(), SIZE, &style).unwrap();
    }
}

#[test]
fn broken_scenes_are_drawn_as_far_as_they_go() {
    let mut scene = Scene::default();
    let mesh = scene.add_shape(Shape::Mesh(generate::torus(1.0, 0.4, 12, 8)));
    for radius in [0.0, -1.0, f32::NAN, f32::INFINITY, 1e30, 1e-30] {
        for shape in [Shape::Sphere { radius }, Shape::Disc { radius }] {
            let shape = scene.add_shape(shape);
            scene.add_instance(shape, Id::new(0), Affine3A::IDENTITY);
        }
    }
    let pixels = Pixels::U8(vec![[1; 4]; 3]);
    let image = Bitmap { width: 5, height: 7, pixels, encoding: Encoding::Srgb, has_alpha: true };
    let image = scene.add_image(image);
    let wrap = [Wrap::Mirror; 2];
    let picture =
        |image| Texture::Image { image, encoding: Encoding::Srgb, wrap, filter: TextureFilter::Bilinear };
    let textures = [scene.add_texture(picture(image)), scene.add_texture(picture(Id::new(9))), Id::new(77)];
    let itself =
        Surface::Mix { first: Id::new(0), second: Id::new(55), weight: ScalarValue::constant(f32::NAN) };
    scene.add_material(Material::new(itself));
    for texture in textures {
        let color = ColorValue { vertex_color: true, ..ColorValue::textured(TextureUse::new(texture)) };
        let mut material = Material::new(Surface::Diffuse { color });
        let alpha = ScalarValue::textured(TextureUse::new(texture), luch_scene::Channel::Alpha);
        material.opacity = Opacity::Mask { alpha, cutoff: 0.1 };
        let material = scene.add_material(material);
        scene.add_instance(mesh, material, Affine3A::IDENTITY);
    }
    let placements = [
        Affine3A::from_scale(Vec3::new(1.0, 0.0, 1.0)),
        Affine3A::from_scale(Vec3::splat(f32::NAN)),
        Affine3A::from_scale(Vec3::splat(1e30)),
        Affine3A::from_scale(Vec3::splat(1e-30)),
        Affine3A::from_translation(Vec3::splat(f32::MAX)),
    ];
    for placement in placements {
        scene.add_instance(mesh, Id::new(1), placement);
    }
    scene.add_instance(Id::new(1000), Id::new(0), Affine3A::IDENTITY);
    scene.add_instance(mesh, Id::new(1000), Affine3A::IDENTITY);
    let name = String::new();
    let bare = Instance { name, shape: mesh, materials: Vec::new(), placement: Affine3A::IDENTITY };
    scene.instances.push(bare);
    for style in styles() {
        let subject = Subject::scene(&scene);
        let picture = draw(&subject, &camera(), SIZE, &style).unwrap();
        assert!(picture.color.pixels().iter().all(|color| color.is_finite()), "{:?}", style.fill);
        let _ = subject.bounds();
    }
}

#[test]
fn nothing_is_an_empty_picture() {
    let scene = Scene::default();
    for style in styles() {
        let subject = Subject::scene(&scene);
        assert!(subject.bounds().is_empty());
        let picture = draw(&subject, &camera(), SIZE, &style).unwrap();
        assert!(picture.faces.pixels().iter().all(|&face| face == NOTHING));
        assert!(picture.instances.pixels().iter().all(|&instance| instance == NOTHING));
        assert!(picture.depth.pixels().iter().all(|&depth| depth == f32::INFINITY));
        assert!(picture.color.pixels().iter().all(|&color| color == style.background));
    }
}

#[test]
fn one_pixel_is_a_picture_and_none_is_not() {
    let mesh = generate::icosphere(1.0, 1);
    let subject = Subject::triangles(&mesh);
    for style in styles() {
        let picture = draw(&subject, &camera(), Size { width: 1, height: 1 }, &style).unwrap();
        assert!(*picture.faces.get(0, 0) != NOTHING);
        for (width, height) in [(0, 0), (0, 5), (5, 0), (65_536, 65_536), (65_536, 1), (u32::MAX, u32::MAX)] {
            let refused = draw(&subject, &camera(), Size { width, height }, &style).unwrap_err();
            assert!(matches!(refused, PreviewError::Size { .. }));
            let tile = Size { width, height };
            assert!(contact_sheet(&subject, &[camera()], tile, 3, &style).is_err());
        }
    }
    assert!(contact_sheet(&subject, &[], SIZE, 0, &Style::default()).is_err());
    assert!(contact_sheet(&subject, &[camera(); 2], SIZE, 0, &Style::default()).is_ok());
    let many = vec![camera(); 3000];
    assert!(contact_sheet(&subject, &many, SIZE, 1, &Style::default()).is_err());
}

#[test]
fn odd_cameras_are_refused_or_see_something() {
    let mesh = generate::icosphere(1.0, 2);
    let subject = Subject::triangles(&mesh);
    let good = camera();
    let angle = |field_of_view_y| Camera { projection: Projection::Perspective { field_of_view_y }, ..good };
    let height = |height| Camera { projection: Projection::Orthographic { height }, ..good };
    let place = |position| Camera { position, ..good };
    let axes = |orientation| Camera { orientation, ..good };
    let refused = [
        angle(0.0),
        angle(-1.0),
        angle(f32::NAN),
        angle(3.2),
        height(0.0),
        height(-1.0),
        height(f32::INFINITY),
        place(Vec3::NAN),
        place(Vec3::INFINITY),
        axes(Mat3::ZERO),
        axes(Mat3::NAN),
    ];
    for camera in refused {
        let error = draw(&subject, &camera, SIZE, &Style::default()).unwrap_err();
        assert!(matches!(error, PreviewError::Camera { .. }), "{camera:?}");
    }
    let seen = [
        angle(1e-6),
        angle(std::f32::consts::PI.next_down()),
        height(1e-20),
        height(1e20),
        place(Vec3::ZERO),
        // In a vertex, in an edge, in a face.
        place(mesh.positions[0]),
        place((mesh.corners(0)[0] + mesh.corners(0)[1]) / 2.0),
        place(mesh.corners(0).into_iter().sum::<Vec3>() / 3.0),
        place(Vec3::splat(1e30)),
    ];
    for camera in seen {
        for style in styles() {
            draw(&subject, &camera, SIZE, &style).unwrap();
        }
    }
    // From within, every pixel shows something.
    let picture = draw(&subject, &place(Vec3::splat(0.1)), SIZE, &Style::default()).unwrap();
    assert!(picture.faces.pixels().iter().all(|&face| face != NOTHING));
}

/// A triangle as large as single precision allows, and one as small, each seen by a camera of its own scale.
#[test]
fn scale_does_not_matter() {
    let mesh = generate::torus(1.0, 0.4, 24, 12);
    let pictures = [1e-18f32, 1e-6, 1.0, 1e6, 1e18].map(|scale| {
        let mut scaled = mesh.clone();
        scaled.positions.iter_mut().for_each(|position| *position *= scale);
        let camera = Camera { position: camera().position * scale, ..camera() };
        draw(&Subject::triangles(&scaled), &camera, SIZE, &Style::default()).unwrap().faces
    });
    for faces in &pictures {
        let differ = faces.pixels().iter().zip(pictures[2].pixels()).filter(|(a, b)| a != b).count();
        assert!(differ <= 3, "{differ}");
    }
}

#[test]
fn cameras_are_found_for_odd_boxes() {
    let boxes = [
        Aabb::empty(),
        Aabb { min: Vec3::ZERO, max: Vec3::ZERO },
        Aabb { min: Vec3::splat(f32::MIN), max: Vec3::splat(f32::MAX) },
        Aabb { min: Vec3::splat(f32::NEG_INFINITY), max: Vec3::INFINITY },
        Aabb { min: Vec3::NAN, max: Vec3::NAN },
        Aabb { min: Vec3::splat(1e6), max: Vec3::splat(1e6) },
        Aabb { min: Vec3::ZERO, max: Vec3::splat(1e-40) },
    ];
    let directions =
        [Vec3::ZERO, Vec3::NAN, Vec3::Y, Vec3::NEG_Y, Vec3::splat(1e-30), StandardView::Left.direction()];
    for bounds in &boxes {
        for direction in directions {
            for number in [0.5, 0.0, -1.0, f32::NAN, f32::INFINITY, 1e-30] {
                for camera in [
                    frame_all(bounds, direction, number, 1.5),
                    frame_all(bounds, direction, 0.6, number),
                    frame_all_parallel(bounds, direction, number),
                ] {
                    assert!(
                        camera.orientation.is_finite()
                            && (camera.orientation.determinant() - 1.0).abs() < 1e-4
                    );
                }
            }
        }
    }
}
