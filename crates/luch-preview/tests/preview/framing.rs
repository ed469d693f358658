//! Cameras around everything, sheets of several views, text.

use crate::views::random_point;
use glam::{Vec2, Vec3};
use luch_bvh::Aabb;
use luch_image::{Image, Rgb};
use luch_mesh::generate;
use luch_preview::{
    Fill, NOTHING, Size, StandardView, Style, Subject, TerminalDepth, contact_sheet, draw, frame_all,
    frame_all_parallel, to_terminal,
};
use luch_scene::{Camera, Projection};

/// Where a point lies in the picture, −1 to 1 along both sides.
fn place(camera: &Camera, aspect: f32, point: Vec3) -> Vec2 {
    let p = camera.orientation.transpose() * (point - camera.position);
    assert!(p.z < 0.0, "in front of the camera");
    let flat = Vec2::new(p.x, p.y);
    let upright = match camera.projection {
        Projection::Perspective { field_of_view_y } => flat / -p.z / libm::tanf(field_of_view_y / 2.0),
        Projection::Orthographic { height } => flat / (height / 2.0),
    };
    upright / Vec2::new(aspect, 1.0)
}

/// All corners lie inside, and the outermost at the margin.
#[test]
fn boxes_fill_the_picture() {
    for seed in 0..100 {
        let bounds = Aabb::of_points([random_point(seed, 0) * 5.0, random_point(seed, 1) * 5.0]);
        let aspect = [0.4, 1.0, 1.7, 3.0][seed as usize % 4];
        let directions = StandardView::ALL.map(StandardView::direction).into_iter();
        for direction in directions.chain([random_point(seed, 2)]) {
            for camera in [
                frame_all(&bounds, direction, 0.2 + 0.02 * seed as f32, aspect),
                frame_all_parallel(&bounds, direction, aspect),
            ] {
                let corners = (0..8).map(|i| {
                    let pick =
                        |axis: usize| if i >> axis & 1 == 0 { bounds.min[axis] } else { bounds.max[axis] };
                    place(&camera, aspect, Vec3::new(pick(0), pick(1), pick(2))).abs().max_element()
                });
                let outermost = corners.fold(0.0, f32::max);
                assert!((outermost - 0.96).abs() < 1e-3, "{outermost} {direction}");
            }
        }
    }
}

#[test]
fn standard_views_stand_where_their_names_say() {
    let bounds = Aabb { min: Vec3::splat(-1.0), max: Vec3::ONE };
    let axes = |view: StandardView| {
        let camera = frame_all_parallel(&bounds, view.direction(), 1.0);
        (camera.orientation.x_axis.round(), camera.orientation.y_axis.round(), camera.position.normalize())
    };
    assert_eq!(axes(StandardView::Front), (Vec3::X, Vec3::Y, Vec3::Z));
    assert_eq!(axes(StandardView::Back), (Vec3::NEG_X, Vec3::Y, Vec3::NEG_Z));
    assert_eq!(axes(StandardView::Right), (Vec3::NEG_Z, Vec3::Y, Vec3::X));
    assert_eq!(axes(StandardView::Left), (Vec3::Z, Vec3::Y, Vec3::NEG_X));
    assert_eq!(axes(StandardView::Top), (Vec3::X, Vec3::NEG_Z, Vec3::Y));
    assert_eq!(axes(StandardView::Bottom), (Vec3::X, Vec3::Z, Vec3::NEG_Y));
    for view in StandardView::ALL {
        assert_eq!(StandardView::from_name(view.name()), Some(view));
    }
    for fill in Fill::ALL {
        assert_eq!(Fill::from_name(fill.name()), Some(fill));
    }
}

#[test]
fn a_sheet_holds_the_views() {
    let mesh = generate::torus(1.0, 0.3, 16, 8);
    let subject = Subject::triangles(&mesh);
    let tile = Size { width: 30, height: 20 };
    let cameras = StandardView::ALL.map(|view| frame_all(&subject.bounds(), view.direction(), 0.6, 1.5));
    let sheet = contact_sheet(&subject, &cameras, tile, 3, &Style::default()).unwrap();
    // Three columns, three rows, gaps of four.
    assert_eq!((sheet.width(), sheet.height()), (98, 68));
    for (i, camera) in (0..).zip(&cameras) {
        let view = draw(&subject, camera, tile, &Style::default()).unwrap();
        assert!(view.faces.pixels().iter().any(|&face| face != NOTHING));
        for y in 0..20 {
            for x in 0..30 {
                assert_eq!(sheet.get(i % 3 * 34 + x, i / 3 * 24 + y), view.color.get(x, y));
            }
        }
    }
}

fn ramp() -> Image<Rgb> {
    let row = [Rgb::BLACK, Rgb::new(1.0, 0.0, 0.0), Rgb::WHITE, Rgb::WHITE];
    let below = [Rgb::new(0.0, 1.0, 0.0), Rgb::BLACK, Rgb::WHITE, Rgb::WHITE];
    Image::from_pixels(4, 2, [row, below].concat()).unwrap()
}

#[test]
fn pixels_become_half_blocks() {
    let text = to_terminal(&ramp(), 4, TerminalDepth::TrueColor);
    let expected = "\x1b[38;2;0;0;0m\x1b[48;2;0;255;0m▀\x1b[38;2;255;0;0m\x1b[48;2;0;0;0m▀\
                    \x1b[38;2;255;255;255m\x1b[48;2;255;255;255m▀▀\x1b[0m\n";
    assert_eq!(text, expected);
    let text = to_terminal(&ramp(), 4, TerminalDepth::Palette);
    let expected =
        "\x1b[38;5;16m\x1b[48;5;46m▀\x1b[38;5;196m\x1b[48;5;16m▀\x1b[38;5;231m\x1b[48;5;231m▀▀\x1b[0m\n";
    assert_eq!(text, expected);
}

#[test]
fn letters_grow_brighter() {
    let pixels = (0..10).map(|i| Rgb::gray(luch_image::srgb::decode((i as f32 + 0.5) / 10.0))).collect();
    let image = Image::from_pixels(10, 1, pixels).unwrap();
    assert_eq!(to_terminal(&image, 10, TerminalDepth::Letters), " .:-=+*#%@\n");
    // Two pixels of height make one letter, means of what they cover.
    let image = Image::filled(100, 60, Rgb::WHITE);
    let text = to_terminal(&image, 20, TerminalDepth::Letters);
    assert_eq!(text, format!("{}\n", "@".repeat(20)).repeat(6));
}

#[test]
fn odd_pictures_are_text_too() {
    for (width, height) in [(0, 0), (1, 1), (1, 5000), (5000, 1), (3, 2)] {
        let image = Image::filled(width, height, Rgb::gray(f32::NAN));
        for depth in [TerminalDepth::TrueColor, TerminalDepth::Palette, TerminalDepth::Letters] {
            for columns in [0, 1, 80, u32::MAX] {
                let text = to_terminal(&image, columns, depth);
                assert_eq!(text.is_empty(), width == 0);
                assert!(text.len() < 50_000_000);
            }
        }
    }
}
