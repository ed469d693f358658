//! Height maps: sheets, bodies, reduction, displacement, and their verbs.

use glam::{DVec2, Vec2, Vec3};
use luch_image::codec::{Metadata, encode_pfm, encode_png16};
use luch_image::{Bitmap, Encoding, Image, Pixels, Rgb};
use luch_mesh::height_map::{
    self, Channel, Displacement, HeightField, Landform, Reduction, Terrain, reduced, sheet, solid,
};
use luch_mesh::workshop::{Files, Pipeline, WorkshopError};
use luch_mesh::{PolygonMesh, TriangleMesh, generate, measure};

fn land(columns: u32, rows: u32, seed: u64) -> HeightField {
    height_map::terrain(&Terrain { seed, columns, rows, ..Terrain::default() }).unwrap()
}

/// Land with single holes, a lake, a hole at a corner, and two that touch in a point.
fn holed(columns: u32, rows: u32, seed: u64) -> HeightField {
    let mut field = land(columns, rows, seed);
    for row in 0..rows {
        for column in 0..columns {
            let lake = Vec2::new(column as f32 - 13.0, row as f32 - 11.0).length() < 5.0;
            let single = matches!((column, row), (0, 0) | (25, 20) | (26, 21) | (27, 4));
            if lake || single {
                field.heights[(row * columns + column) as usize] = f32::NAN;
            }
        }
    }
    field
}

#[test]
fn every_pixel_is_a_vertex() {
    let field = land(33, 21, 1);
    let mesh = sheet(&field);
    assert_eq!((mesh.positions.len(), mesh.triangles.len()), (33 * 21, 32 * 20 * 2));
    assert_eq!(mesh.validate(), []);
    for (point, place) in mesh.positions.iter().enumerate() {
        assert_eq!(*place, field.place(point as u32 % 33, point as u32 / 33));
        assert_eq!(place.y, field.heights[point]);
    }
    for t in 0..mesh.triangles.len() {
        assert!(mesh.area_normal(t).y > 0.0);
        let [a, b, c] = mesh.corner_uvs(t, 0).unwrap();
        assert!((b - a).perp_dot(c - a) > 0.0);
    }
    let report = measure::closedness(&mesh);
    assert_eq!((report.components, report.euler_characteristic), (1, 1));
}

/// The field and its sheet are one surface.
#[test]
fn heights_of_the_field_lie_on_the_sheet() {
    let field = land(9, 7, 3);
    let mesh = sheet(&field);
    for t in 0..mesh.triangles.len() {
        let corners = mesh.corners(t);
        for weights in [[0.5, 0.25, 0.25], [0.2, 0.3, 0.5], [0.1, 0.8, 0.1]] {
            let point: Vec3 = corners.iter().zip(weights).map(|(p, w)| *p * w).sum();
            let height = field.height_at(point.x, point.z).unwrap();
            // Rounding of places to f32, times the steepest slope.
            assert!((height - point.y).abs() < 1e-6, "{height} {point}");
        }
    }
}

/// Volume between the surface and the floor, cell by cell: each triangle stands on a third of its corners' heights.
fn volume_over(field: &HeightField, base: f64) -> f64 {
    let (columns, rows) = (field.width - 1, field.height - 1);
    let triangle = field.size.as_dvec2() / DVec2::new(f64::from(columns), f64::from(rows));
    let third = triangle.x * triangle.y / 2.0 / 3.0;
    let mut volume = 0.0;
    for row in 0..rows {
        for column in 0..columns {
            let at = |i, j| field.at(column + i, row + j).map(|h| f64::from(h) - base);
            for corners in [[at(0, 0), at(0, 1), at(1, 0)], [at(1, 1), at(0, 1), at(1, 0)]] {
                if let [Some(a), Some(b), Some(c)] = corners {
                    volume += (a + b + c) * third;
                }
            }
        }
    }
    volume
}

#[test]
fn bodies_are_closed_and_have_the_volume_under_the_surface() {
    for (field, genus) in [(land(17, 12, 5), 0), (holed(41, 31, 5), 2)] {
        let lowest = field.range().unwrap()[0];
        let base = lowest - 0.1;
        let body = solid(&field, &sheet(&field), base).unwrap();
        let report = measure::closedness(&body);
        assert!(report.is_closed(), "{report}");
        assert_eq!(body.validate(), []);
        assert_eq!(report.components, 1, "{genus}");
        let truth = volume_over(&field, f64::from(base));
        assert!((measure::volume(&body) / truth - 1.0).abs() < 1e-5, "{} {truth}", measure::volume(&body));
        let few =
            solid(&field, &reduced(&field, &Reduction { error: 0.01, most_triangles: None }), base).unwrap();
        assert!(measure::closedness(&few).is_closed(), "{}", measure::closedness(&few));
        // The surface moves by at most the error.
        let area = f64::from(field.size.x * field.size.y);
        assert!((measure::volume(&few) - truth).abs() <= 0.01 * area + 1e-6);
        assert!(
            solid(&field, &sheet(&field), lowest).is_err()
                && solid(&field, &sheet(&field), f32::NAN).is_err()
        );
    }
}

#[test]
fn a_flat_body_is_a_box() {
    let field = HeightField::new(5, 4, vec![0.5; 20], Vec2::new(2.0, 3.0)).unwrap();
    let few = reduced(&field, &Reduction::default());
    assert_eq!(few.triangles.len(), 2);
    for top in [sheet(&field), few] {
        let body = solid(&field, &top, -0.5).unwrap();
        assert!((measure::volume(&body) - 6.0).abs() < 1e-5);
        assert!((measure::area(&body) - 22.0).abs() < 1e-5);
        for t in 0..body.triangles.len() {
            let facet = body.area_normal(t).normalize();
            assert!(body.corner_normals(t).unwrap().iter().all(|n| n.distance(facet) < 1e-5));
        }
    }
}

/// The height of a reduced sheet over each point of the field, by rasterising its triangles; and whether it is covered.
fn heights_of(mesh: &TriangleMesh, field: &HeightField) -> Vec<Vec<f64>> {
    let last = DVec2::new(f64::from(field.width - 1), f64::from(field.height - 1));
    let cell = |p: Vec3| ((DVec2::new(p.x.into(), p.z.into()) / field.size.as_dvec2() + 0.5) * last).round();
    let mut found = vec![Vec::new(); field.heights.len()];
    for t in 0..mesh.triangles.len() {
        let corners = mesh.corners(t);
        let [a, b, c] = corners.map(cell);
        let (low, high) = (a.min(b).min(c), a.max(b).max(c));
        let area = (b - a).perp_dot(c - a);
        for y in low.y as usize..=high.y as usize {
            for x in low.x as usize..=high.x as usize {
                let p = DVec2::new(x as f64, y as f64);
                let weights = [(b - p).perp_dot(c - p), (c - p).perp_dot(a - p), (a - p).perp_dot(b - p)]
                    .map(|w| w / area);
                // Whole numbers: zero is exact.
                if weights.iter().all(|w| *w >= 0.0) {
                    let height = corners.iter().zip(weights).map(|(p, w)| f64::from(p.y) * w).sum();
                    found[y * field.width as usize + x].push(height);
                }
            }
        }
    }
    found
}

#[test]
fn reduction_keeps_its_error_at_every_pixel_and_all_holes() {
    for field in [land(65, 40, 2), holed(48, 33, 9)] {
        let full = sheet(&field);
        let mut before = usize::MAX;
        for error in [0.0, 0.0005, 0.003, 0.01, 0.05, 10.0] {
            let mesh = reduced(&field, &Reduction { error, most_triangles: None });
            assert_eq!(mesh.validate(), []);
            assert!(mesh.triangles.len() <= before, "more triangles for a larger error");
            before = mesh.triangles.len();
            for (point, heights) in heights_of(&mesh, &field).iter().enumerate() {
                let truth = f64::from(field.heights[point]);
                // Planes are computed twice, in two ways, in f64.
                assert!(heights.iter().all(|h| (h - truth).abs() <= error + 1e-12), "{error} at {point}");
            }
            let covered = |mesh: &TriangleMesh| {
                (0..mesh.triangles.len())
                    .map(|t| {
                        let normal = mesh.area_normal(t);
                        assert!(normal.y > 0.0);
                        f64::from(normal.y)
                    })
                    .sum::<f64>()
            };
            assert!((covered(&mesh) / covered(&full) - 1.0).abs() < 1e-6, "{error}");
            let (one, other) = (measure::closedness(&mesh), measure::closedness(&full));
            assert_eq!(
                (one.components, one.euler_characteristic),
                (other.components, other.euler_characteristic)
            );
        }
    }
}

#[test]
fn reduction_stops_at_a_number_of_triangles() {
    let field = land(65, 65, 11);
    for most in [2, 3, 10, 101, 1000] {
        let mesh = reduced(&field, &Reduction { error: 0.0, most_triangles: Some(most) });
        assert!(mesh.triangles.len() as u64 <= most && mesh.triangles.len() as u64 + 2 > most, "{most}");
    }
    let senseless = Reduction { error: f64::NAN, most_triangles: Some(0) };
    assert_eq!(reduced(&field, &senseless).triangles.len(), 2);
    // Nothing but holes, and a field that is not sound.
    let none = HeightField { heights: vec![f32::NAN; 9], width: 3, height: 3, size: Vec2::ONE };
    assert!(reduced(&none, &Reduction::default()).triangles.is_empty() && sheet(&none).triangles.is_empty());
    let broken = HeightField { width: 4, ..none };
    assert!(
        reduced(&broken, &Reduction::default()).triangles.is_empty() && sheet(&broken).triangles.is_empty()
    );
}

/// A plane takes two triangles; a ridge line along a diagonal few.
#[test]
fn simple_land_takes_few_triangles() {
    let of = |height: fn(u32, u32) -> f32| {
        let heights = (0..33 * 33).map(|k| height(k % 33, k / 33)).collect();
        let field = HeightField::new(33, 33, heights, Vec2::ONE).unwrap();
        reduced(&field, &Reduction { error: 1e-6, most_triangles: None }).triangles.len()
    };
    assert_eq!(of(|x, y| 0.25 * x as f32 - 0.5 * y as f32), 2);
    assert!(of(|x, _| (x as f32 - 16.0).abs()) <= 8);
    assert!(of(|x, y| if x + y < 20 { 0.0 } else { 1.0 }) < 200);
}

#[test]
fn displacement_by_a_gray_image_is_an_offset() {
    let bitmap = |value: f32| Bitmap::from_rgb(&Image::filled(3, 2, Rgb::gray(value)));
    let by =
        Displacement { scale: 0.5, middle: 0.25, channel: Channel::Luminance, encoding: Encoding::Linear };
    let mut mesh = PolygonMesh::from(&generate::sphere(1.0, 24, 12));
    let moved = height_map::displace(&mut mesh, &bitmap(0.65), &by);
    assert_eq!(moved, mesh.positions.len());
    assert!(mesh.positions.iter().all(|p| (p.length() - 1.2).abs() < 1e-6));
    assert!(measure::closedness(&mesh.triangulate()).is_closed());
    // The middle moves nothing, up to the rounding of the value.
    let still = height_map::displace(&mut mesh, &bitmap(0.25), &by);
    assert_eq!(still, 0);
    assert_eq!(height_map::displace(&mut PolygonMesh::default(), &bitmap(1.0), &by), 0);
}

#[test]
fn displacement_reads_the_image_upright_and_between_pixels() {
    // Left to right 0 to 1 in two columns, upper row twice as much.
    let pixels = vec![[0.0, 0.0, 0.0, 1.0], [2.0, 2.0, 2.0, 1.0], [0.0, 0.0, 0.0, 1.0], [1.0, 1.0, 1.0, 1.0]];
    let bitmap = Bitmap {
        width: 2,
        height: 2,
        pixels: Pixels::F32(pixels),
        encoding: Encoding::Linear,
        has_alpha: false,
    };
    let by = Displacement { scale: 1.0, middle: 0.0, channel: Channel::Red, encoding: Encoding::Linear };
    let mut mesh = PolygonMesh::from(&generate::plane(Vec2::ONE, [4, 4]));
    height_map::displace(&mut mesh, &bitmap, &by);
    let at = |u: usize, v: usize| mesh.positions[v * 5 + u].y;
    // Centres of pixels lie at a quarter and three quarters.
    assert_eq!([at(1, 1), at(3, 1), at(1, 3), at(3, 3)], [0.0, 1.0, 0.0, 2.0]);
    assert_eq!([at(2, 1), at(3, 2), at(2, 2)], [0.5, 1.5, 0.75]);
}

struct OneFile(Vec<u8>);

impl Files for OneFile {
    fn bytes(&mut self, _: &str) -> Result<Vec<u8>, String> {
        Ok(self.0.clone())
    }

    fn mesh(&mut self, _: &str) -> Result<PolygonMesh, String> {
        Err("no mesh".into())
    }
}

fn run(line: &str, file: &[u8]) -> Result<PolygonMesh, WorkshopError> {
    Pipeline::parse(line)?.run(&mut OneFile(file.to_vec()))
}

#[test]
fn verbs_read_images_and_grids() {
    let gradient = Image::from_pixels(40, 30, (0..1200).map(|k| [(k * 50) as u16; 3]).collect()).unwrap();
    let png = encode_png16(&gradient, &Metadata::default()).unwrap();
    let mesh = run("height-map a.png --scale 65535", &png).unwrap();
    assert_eq!(mesh.positions.len(), 1200);
    for (k, place) in mesh.positions.iter().enumerate() {
        // k · 50 / 65535 · 65535, each rounded once to f32.
        assert!((place.y - (k * 50) as f32).abs() <= 0.01, "{k}");
    }
    let body =
        run("height-map a.png --crop 3,4,20,10 --invert --blur 1 --solid 0.1 --error 0.001", &png).unwrap();
    assert!(measure::closedness(&body.triangulate()).is_closed());
    assert_eq!(run("height-map a.png --cells", &png).unwrap().positions.len(), 41 * 31);
    let light = Image::from_pixels(3, 2, (0..6).map(|k| Rgb::gray(k as f32 * 7.0)).collect()).unwrap();
    let pfm = encode_pfm(&light).unwrap();
    let heights = run("height-map a.pfm --scale 2 --offset 1 --size 10", &pfm).unwrap().positions;
    assert_eq!(heights.iter().map(|p| p.y).collect::<Vec<_>>(), [1.0, 15.0, 29.0, 43.0, 57.0, 71.0]);
    assert_eq!(heights[0].x, -5.0);

    let grid = b"ncols 3\nnrows 3\ncellsize 25\nNODATA_value -1\n5 6 7\n5 6 7\n5 6 -1\n";
    let mesh = run("height-map a.asc", grid).unwrap();
    assert_eq!(
        (mesh.positions.len(), mesh.face_count(), mesh.positions[0]),
        (8, 7, Vec3::new(-25.0, 5.0, -25.0))
    );
    assert_eq!(run("height-map a.asc --fill 7", grid).unwrap().face_count(), 8);
    for (line, file, message) in [
        ("height-map a.asc", &b"ncols 3 nrows"[..], "line 1, column 14"),
        ("height-map a.png", b"", "file"),
        ("height-map a.asc --crop 1,1", grid, "four numbers"),
        ("height-map a.asc --crop -5,1,1e30,2", grid, "does not lie in the field"),
        ("height-map a.asc --blur 2000", grid, "from 0 to 1000"),
        ("cuboid | displace-by-image a.png", grid, "file"),
    ] {
        let error = run(line, file).unwrap_err().to_string();
        assert!(error.contains(message), "{line}: {error}");
    }
    let displaced =
        run("terrain --columns 9 --rows 9 --relief 0 | displace-by-image a.png --scale 1 --middle 0", &png)
            .unwrap();
    assert!(displaced.positions.iter().any(|p| p.y > 0.2));
}

#[test]
fn terrains_differ_by_form_and_are_closed_on_demand() {
    for form in ["hills", "ridges", "plasma"] {
        let line = format!("terrain --form {form} --columns 33 --rows 20 --triangles 300");
        let mesh = run(&line, b"").unwrap();
        assert!(mesh.face_count() <= 300 && mesh.face_count() > 100, "{form}");
        let body = run(&format!("{line} --solid 0.1"), b"").unwrap();
        assert!(measure::closedness(&body.triangulate()).is_closed());
    }
    let land = height_map::terrain(&Terrain { landform: Landform::Ridges, ..Terrain::default() }).unwrap();
    assert_eq!(land.heights.len(), 129 * 129);
}
