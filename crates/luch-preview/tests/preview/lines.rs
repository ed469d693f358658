//! Edges where they are, as wide as they should be, hidden where something is before them.

use glam::Vec3;
use luch_image::{Image, Rgb};
use luch_mesh::{PolygonMesh, TriangleMesh, generate};
use luch_preview::{
    Dots, EdgeSet, Fill, Hidden, Lines, Marks, Size, StandardView, Style, Subject, draw, frame_all,
};
use luch_scene::{Camera, Projection};

const SIZE: Size = Size { width: 120, height: 120 };

/// From +Z, 3 metres high: 40 pixels to the metre.
fn front() -> Camera {
    Camera {
        projection: Projection::Orthographic { height: 3.0 },
        ..Camera::looking_at(Vec3::Z * 5.0, Vec3::ZERO, Vec3::Y, 1.0)
    }
}

/// White lines on black.
fn wires(hidden: Hidden, width: f32) -> Style {
    let lines = Lines { hidden, width, color: Rgb::WHITE, edges: EdgeSet::All };
    Style { fill: Fill::Nothing, lines: Some(lines), background: Rgb::BLACK, ..Style::default() }
}

fn light(image: &Image<Rgb>) -> f64 {
    image.pixels().iter().map(|color| f64::from(color.r)).sum()
}

fn cube() -> PolygonMesh {
    let positions =
        (0..8).map(|i| Vec3::new((i & 1) as f32, (i >> 1 & 1) as f32, (i >> 2) as f32) * 2.0 - 1.0);
    let mut mesh = PolygonMesh { positions: positions.collect(), ..Default::default() };
    for face in [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]] {
        mesh.add_face(&face);
    }
    mesh
}

/// An edge 80 pixels long covers 80 w pixels, and half a round end of diameter w or so on each side.
#[test]
fn lines_are_as_wide_as_they_should_be() {
    for angle in [0.0f32, 0.2, 0.7, 1.1, 1.5] {
        let end = Vec3::new(libm::cosf(angle), libm::sinf(angle), 0.0);
        let mesh = TriangleMesh::new(vec![-end, end, -end], vec![[0, 1, 2]]);
        let subject = Subject::triangles(&mesh);
        for width in [0.25f32, 1.0, 2.0, 5.0] {
            let picture = draw(&subject, &front(), SIZE, &wires(Hidden::Shown, width)).unwrap();
            let (covered, width) = (light(&picture.color), f64::from(width));
            let longest = 80.0 * width + (width + 1.0) * (width + 1.0);
            // Sampling a distance instead of an area errs by some hundredths of a pixel for each unit of length.
            assert!(covered > 76.0 * width && covered < longest * 1.05, "{angle} {width}: {covered}");
        }
    }
}

/// Polygons have no diagonals, triangles have.
#[test]
fn polygons_show_their_own_edges() {
    let mesh = cube();
    let at_middle = |subject: &Subject| {
        *draw(subject, &front(), SIZE, &wires(Hidden::Removed, 2.0)).unwrap().color.get(75, 60)
    };
    assert_eq!(at_middle(&Subject::polygons(&mesh)), Rgb::BLACK);
    let triangles = mesh.triangulate();
    let style = wires(Hidden::Removed, 2.0);
    let diagonal = draw(&Subject::triangles(&triangles), &front(), SIZE, &style).unwrap();
    let outline = draw(&Subject::polygons(&mesh), &front(), SIZE, &style).unwrap();
    assert!(light(&diagonal.color) > light(&outline.color) + 100.0);
}

/// Of a cube in perspective the nine edges of the three faces in sight are seen, and all twelve without hiding. The length of
/// a line in the picture is its light.
#[test]
fn hidden_lines_are_removed() {
    let mesh = cube();
    let subject = Subject::polygons(&mesh);
    let camera = Camera::looking_at(Vec3::new(3.0, 2.5, 4.0), Vec3::ZERO, Vec3::Y, 0.8);
    let size = Size { width: 400, height: 400 };
    let picture = |hidden| light(&draw(&subject, &camera, size, &wires(hidden, 1.0)).unwrap().color);
    let place = |index: u32| {
        let p = camera.orientation.transpose() * (mesh.positions[index as usize] - camera.position);
        glam::Vec2::new(p.x, p.y) / -p.z * (200.0 / libm::tanf(0.4))
    };
    let corners =
        [[0, 1], [2, 3], [4, 5], [6, 7], [0, 2], [1, 3], [4, 6], [5, 7], [0, 4], [1, 5], [2, 6], [3, 7]];
    // Corner 0 is the farthest: its three edges are hidden.
    let length = |is_drawn: &dyn Fn(&[u32; 2]) -> bool| -> f64 {
        let drawn = corners.iter().filter(|ends| is_drawn(ends));
        drawn.map(|&[a, b]| f64::from(place(a).distance(place(b)))).sum()
    };
    let (all, seen) = (length(&|_| true), length(&|ends| !ends.contains(&0)));
    assert!((picture(Hidden::Shown) / all - 1.0).abs() < 0.03, "{} {all}", picture(Hidden::Shown));
    assert!((picture(Hidden::Removed) / seen - 1.0).abs() < 0.03, "{} {seen}", picture(Hidden::Removed));
    let faint = seen + (all - seen) / 4.0;
    assert!((picture(Hidden::Faint) / faint - 1.0).abs() < 0.03, "{} {faint}", picture(Hidden::Faint));
}

/// On a smooth ball, too, no edge in sight is lost and none behind is seen: as many edges as on the half ball.
#[test]
fn half_of_a_balls_edges_are_hidden() {
    let ball = generate::icosphere(1.0, 3);
    let subject = Subject::triangles(&ball);
    let size = Size { width: 600, height: 600 };
    let picture =
        |hidden, mesh: &Subject| light(&draw(mesh, &front(), size, &wires(hidden, 1.0)).unwrap().color);
    // The front half alone: triangles that face the camera.
    let mut half = ball.clone();
    half.triangles.retain(|&corners| {
        let [a, b, c] = corners.map(|i| ball.positions[i as usize]);
        (b - a).cross(c - a).z > 0.0
    });
    let expected = picture(Hidden::Shown, &Subject::triangles(&half));
    assert!((picture(Hidden::Removed, &subject) / expected - 1.0).abs() < 0.01);
}

#[test]
fn creases_borders_and_faults_are_told_apart() {
    let cylinder = generate::cylinder(1.0, 2.0, 32, 1, true);
    let only = |edges, mesh: &TriangleMesh| {
        let lines = Lines { edges, color: Rgb::WHITE, hidden: Hidden::Shown, ..Lines::default() };
        let style = Style { lines: Some(lines), ..wires(Hidden::Shown, 1.0) };
        light(&draw(&Subject::triangles(mesh), &front(), SIZE, &style).unwrap().color)
    };
    // Seen from the side: two rims of 80 pixels, each drawn once as far as light goes.
    let rims = only(EdgeSet::Features { crease_angle: 0.7 }, &cylinder);
    assert!((160.0..170.0).contains(&rims), "{rims}");
    assert!(only(EdgeSet::Features { crease_angle: 0.1 }, &cylinder) > 1000.0);

    // A fin on an open sheet: five borders and one edge of three faces; a turned triangle disagrees with its neighbour.
    let positions = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0), (0.2, -0.2)];
    let positions: Vec<_> = positions.map(|(x, y)| Vec3::new(x, y, 0.0)).to_vec();
    let fin = TriangleMesh::new(positions.clone(), vec![[0, 1, 2], [0, 2, 3], [0, 2, 4]]);
    let turned = TriangleMesh::new(positions.clone(), vec![[0, 1, 2], [0, 3, 2]]);
    let sound = TriangleMesh::new(positions, vec![[0, 1, 2], [0, 2, 3]]);
    let marks =
        Marks { border: Rgb::new(1.0, 0.0, 0.0), non_manifold: Rgb::new(0.0, 0.0, 1.0), ..Marks::default() };
    let style = Style { lines: None, marks: Some(marks), ..wires(Hidden::Shown, 1.0) };
    let at = |mesh: &TriangleMesh, x, y| {
        *draw(&Subject::triangles(mesh), &front(), SIZE, &style).unwrap().color.get(x, y)
    };
    for mesh in [&fin, &turned] {
        assert_eq!(at(mesh, 50, 70), marks.non_manifold);
    }
    assert_eq!(at(&sound, 50, 70), Rgb::BLACK);
    for mesh in [&fin, &turned, &sound] {
        assert_eq!((at(mesh, 60, 100), at(mesh, 20, 60)), (marks.border, marks.border));
    }
}

#[test]
fn dots_stand_on_vertices_in_sight() {
    let mesh = cube();
    let dots = Dots { diameter: 6.0, hidden: Hidden::Removed, color: Rgb::WHITE };
    let style = Style { lines: None, dots: Some(dots), ..wires(Hidden::Removed, 1.0) };
    let camera = Camera::looking_at(Vec3::new(3.0, 2.5, 4.0), Vec3::ZERO, Vec3::Y, 0.8);
    let covered = light(&draw(&Subject::polygons(&mesh), &camera, SIZE, &style).unwrap().color);
    let seven = 7.0 * std::f64::consts::PI * 9.0;
    assert!((covered / seven - 1.0).abs() < 0.05, "{covered} {seven}");
}

/// Lines that run behind the eye, or far beyond the picture, are cut and cost no more than the picture is wide.
#[test]
fn endless_lines_end() {
    let ends = [Vec3::new(-1e30, -1e29, -3.0), Vec3::new(1e30, 1e29, -1.0), Vec3::new(0.5, 0.1, 1e6)];
    let mesh = TriangleMesh::new(ends.to_vec(), vec![[0, 1, 2]]);
    let camera = frame_all(&luch_bvh::Aabb::empty(), StandardView::Front.direction(), 0.8, 1.0);
    let style = wires(Hidden::Shown, 1.0);
    assert!(light(&draw(&Subject::triangles(&mesh), &camera, SIZE, &style).unwrap().color) > 50.0);
}
