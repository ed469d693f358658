//! Known answers: closed-form limits, splines on borders, symmetry, counts.

use glam::{Vec2, Vec3};

use super::*;
use crate::{generate, measure};

fn cube() -> PolygonMesh {
    let corner = |i: u32| Vec3::new((i & 1) as f32, (i >> 1 & 1) as f32, (i >> 2) as f32) * 2.0 - Vec3::ONE;
    let mut mesh = PolygonMesh { positions: (0..8).map(corner).collect(), ..PolygonMesh::default() };
    for face in [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]] {
        mesh.add_face(&face);
    }
    mesh
}

/// A grid of quads in a wavy plane, with uvs equal to its plan.
fn sheet(count: u32) -> PolygonMesh {
    let mut mesh = PolygonMesh::default();
    let mut uvs = Vec::new();
    for z in 0..=count {
        for x in 0..=count {
            let y = (x * 7 + z * 3) % 5;
            mesh.positions.push(Vec3::new(x as f32, y as f32 * 0.3, -(z as f32)));
            uvs.push(Vec2::new(x as f32, z as f32));
        }
    }
    for z in 0..count {
        for x in 0..count {
            let first = z * (count + 1) + x;
            mesh.add_face(&[first, first + 1, first + count + 2, first + count + 1]);
        }
    }
    mesh.uv_sets.push(CornerAttribute::per_position(uvs));
    mesh
}

fn with(scheme: Scheme, levels: u32, limit: bool) -> Settings {
    Settings { scheme, levels, limit, ..Settings::default() }
}

fn run(mesh: &PolygonMesh, settings: &Settings) -> PolygonMesh {
    let result = subdivide(mesh, settings).expect("small enough");
    assert_eq!(result.triangulate().validate(), []);
    result
}

fn close(one: &[Vec3], other: &[Vec3], most: f32) {
    assert_eq!(one.len(), other.len());
    for (a, b) in one.iter().zip(other) {
        assert!((*a - *b).length() <= most, "{a} and {b}");
    }
}

/// Meshes with borders, creases, valences from 3 up.
fn examples() -> Vec<PolygonMesh> {
    let mut creased = cube();
    crease_by_angle(&mut creased, 1.0, f32::INFINITY);
    creased.creases.truncate(5);
    let mut sharp = sheet(4);
    sharp.creases.push(Crease { vertices: [6, 7], sharpness: f32::INFINITY });
    sharp.creases.push(Crease { vertices: [7, 12], sharpness: f32::INFINITY });
    sharp.sharp_vertices.push(SharpVertex { vertex: 18, sharpness: f32::INFINITY });
    let ball = PolygonMesh::from(&generate::sphere(1.0, 9, 5));
    vec![
        cube(),
        creased,
        sheet(3),
        sharp,
        ball,
        PolygonMesh::from(&generate::cone(1.0, 0.0, 1.0, 7, 1, false)),
    ]
}

#[test]
fn a_cube_in_the_limit_is_at_the_closed_form() {
    let limit = run(&cube(), &with(Scheme::CatmullClark, 0, true));
    // (n² v + 4 Σe + Σf) / (n (n + 5)), n = 3; the neighbours e sum to the corner v, those across faces f to −v.
    let expected: Vec<Vec3> = cube().positions.iter().map(|p| *p * (12.0 / 24.0)).collect();
    close(&limit.positions, &expected, 1e-6);
    assert_eq!(limit.face_count(), 6);
    let directions: Vec<Vec3> = expected.iter().map(|p| p.normalize()).collect();
    close(&limit.normals.values, &directions, 1e-6);
}

#[test]
fn limit_places_do_not_depend_on_the_level() {
    for (number, mesh) in examples().iter().enumerate() {
        for scheme in [Scheme::CatmullClark, Scheme::Loop] {
            let coarse = run(mesh, &with(scheme, 1, true));
            let fine = run(mesh, &with(scheme, 4, true));
            // Vertices of before come first.
            close(&coarse.positions, &fine.positions[..coarse.positions.len()], 2e-6);
            // And deep subdivision arrives there, at least twice as close with each level, here four.
            let deep = run(mesh, &with(scheme, 5, false));
            let gap = |mesh: &PolygonMesh| {
                let pairs = coarse.positions.iter().zip(&mesh.positions);
                pairs.map(|(a, b)| (*a - *b).length()).fold(0.0, f32::max)
            };
            let start = gap(&run(mesh, &with(scheme, 1, false)));
            assert!(gap(&deep) < start / 16.0 + 1e-6, "{number} {scheme:?}: {} of {start}", gap(&deep));
        }
    }
}

/// The normal of a facet fan about a vertex tends to the normal in the limit.
#[test]
fn limit_normals_agree_with_deep_subdivision() {
    for (number, mesh) in examples().iter().enumerate() {
        for scheme in [Scheme::CatmullClark, Scheme::Loop] {
            let coarse = run(mesh, &with(scheme, 1, true));
            let fine = run(mesh, &with(scheme, 6, true));
            let normals = |mesh: &PolygonMesh, corner: usize| {
                let index = mesh.normals.corners.get(corner).unwrap_or(&mesh.corners[corner]);
                mesh.normals.values[*index as usize]
            };
            let mut checked = 0;
            for face in 0..fine.face_count() {
                let corners = fine.face(face);
                for corner in corners.clone() {
                    let vertex = fine.corners[corner] as usize;
                    // A sharp vertex is the tip of a cone.
                    let is_tip = mesh.sharp_vertices.iter().any(|sharp| sharp.vertex as usize == vertex);
                    if vertex >= coarse.positions.len() || is_tip {
                        continue;
                    }
                    let [own, next, previous] = [
                        corner,
                        if corner + 1 == corners.end { corners.start } else { corner + 1 },
                        if corner == corners.start { corners.end - 1 } else { corner - 1 },
                    ]
                    .map(|c| fine.positions[fine.corners[c] as usize].as_dvec3());
                    let (e, f) = (next - own, previous - own);
                    let facet = e.cross(f);
                    // Slits where the surface has no tangent plane tell nothing.
                    if facet.length() < 0.05 * e.length() * f.length() {
                        continue;
                    }
                    let normal = normals(&fine, corner).as_dvec3();
                    let cosine = facet.normalize().dot(normal);
                    assert!(cosine > 0.97, "{number} {scheme:?}: vertex {vertex}: {cosine}");
                    checked += 1;
                }
            }
            assert!(checked > 0);
        }
    }
}

#[test]
fn borders_are_cubic_b_splines() {
    let mesh = sheet(3);
    let limit = run(&mesh, &with(Scheme::CatmullClark, 0, true));
    for x in 1..3 {
        let [a, b, c] = [x - 1, x, x + 1].map(|i| mesh.positions[i]);
        assert!((limit.positions[x] - (a + b * 4.0 + c) / 6.0).length() < 1e-6);
    }
    // Between two of them: the spline at a half is (1 + 23 + 23 + 1) / 48.
    let limit = run(&mesh, &with(Scheme::CatmullClark, 1, true));
    let middle =
        mesh.positions[..4].iter().zip([1.0, 23.0, 23.0, 1.0]).map(|(p, w)| *p * w).sum::<Vec3>() / 48.0;
    assert!(limit.positions.iter().any(|p| (*p - middle).length() < 1e-6));
}

#[test]
fn a_cube_with_sharp_edges_stays_a_cube() {
    for scheme in [Scheme::CatmullClark, Scheme::Loop, Scheme::Sqrt3] {
        let mut mesh = cube();
        crease_by_angle(&mut mesh, 1.0, f32::INFINITY);
        assert_eq!(mesh.creases.len(), 12);
        let fine = run(&mesh, &with(scheme, 4, true)).triangulate();
        assert!((measure::volume(&fine) - 8.0).abs() < 1e-5, "{scheme:?}");
        assert!((measure::area(&fine) - 24.0).abs() < 1e-5, "{scheme:?}");
        assert!(measure::closedness(&fine).is_closed());
    }
    let mut mesh = cube();
    crease_all(&mut mesh, 3.0);
    crease_all(&mut mesh, 0.0);
    assert!(mesh.creases.is_empty());
}

#[test]
fn sharpness_lies_between_smooth_and_sharp_and_runs_out() {
    let volume = |sharpness: f32| {
        let mut mesh = cube();
        crease_all(&mut mesh, sharpness);
        measure::volume(&run(&mesh, &with(Scheme::CatmullClark, 4, false)).triangulate())
    };
    let volumes: Vec<f64> = [0.0, 0.5, 1.0, 1.5, 2.0, 3.0, 9.0].map(volume).into();
    assert!(volumes.windows(2).all(|pair| pair[0] < pair[1] - 1e-3), "{volumes:?}");
    assert!((volumes[6] - 8.0).abs() < 1e-5);
    // A crease of sharpness 1 is one sharp level, then none.
    let mut mesh = cube();
    crease_all(&mut mesh, 1.0);
    let mut sharp = cube();
    crease_all(&mut sharp, f32::INFINITY);
    let mut one = run(&sharp, &with(Scheme::CatmullClark, 1, false));
    one.creases.clear();
    let two = run(&one, &with(Scheme::CatmullClark, 1, false)).triangulate();
    let at_once = run(&mesh, &with(Scheme::CatmullClark, 2, false)).triangulate();
    assert!((measure::volume(&at_once) - measure::volume(&two)).abs() < 1e-6);
    assert!((measure::area(&at_once) - measure::area(&two)).abs() < 1e-6);
}

#[test]
fn an_icosahedron_keeps_its_symmetry() {
    let mut mesh = PolygonMesh::from(&generate::icosphere(1.0, 0));
    mesh.uv_sets.clear();
    for scheme in [Scheme::Loop, Scheme::Sqrt3] {
        let limit = run(&mesh, &with(scheme, 2, true));
        let radii: Vec<f32> = limit.positions[..12].iter().map(|p| p.length()).collect();
        assert!(radii.iter().all(|r| (r - radii[0]).abs() < 1e-6), "{scheme:?}: {radii:?}");
        let frame = |a: usize, b: usize| {
            let x = mesh.positions[a].normalize();
            let z = x.cross(mesh.positions[b]).normalize();
            glam::Mat3::from_cols(x, z.cross(x), z)
        };
        // Edges of the icosahedron are 1.05 long, its diagonals 1.7.
        let edge = 1.2;
        let mut turns = 0;
        for a in 0..12 {
            for b in (0..12).filter(|&b| b != a && mesh.positions[a].distance(mesh.positions[b]) < edge) {
                let first = mesh.corners[1] as usize;
                let turn = frame(a, b) * frame(mesh.corners[0] as usize, first).transpose();
                for p in &limit.positions {
                    let image = turn * *p;
                    assert!(limit.positions.iter().any(|q| q.distance(image) < 3e-6), "{scheme:?}");
                }
                turns += 1;
            }
        }
        assert_eq!(turns, 60);
    }
}

#[test]
fn counts_are_as_predicted_and_closed_stays_closed() {
    for generator in generate::Generator::examples() {
        let mesh = PolygonMesh::from(&generator.mesh());
        for (scheme, one, two) in [
            (Scheme::CatmullClark, 3, 12),
            (Scheme::Loop, 4, 16),
            (Scheme::Midpoint, 4, 16),
            (Scheme::Sqrt3, 3, 9),
        ] {
            for (levels, factor) in [(1, one), (2, two)] {
                let fine = run(&mesh, &with(scheme, levels, false));
                assert_eq!(fine.face_count(), mesh.face_count() * factor, "{generator:?} {scheme:?}");
                let report = measure::closedness(&fine.triangulate());
                assert_eq!(
                    report.euler_characteristic,
                    generator.euler_characteristic(),
                    "{generator:?} {scheme:?}: {report}"
                );
                assert_eq!(report.is_closed(), generator.is_closed(), "{generator:?} {scheme:?}");
                assert_eq!(fine.uv_sets.len(), mesh.uv_sets.len());
            }
        }
    }
}

#[test]
fn midpoint_moves_nothing() {
    for generator in generate::Generator::examples() {
        let mesh = generator.mesh();
        let fine = run(&PolygonMesh::from(&mesh), &with(Scheme::Midpoint, 3, false)).triangulate();
        assert!((measure::area(&fine) / measure::area(&mesh) - 1.0).abs() < 1e-6, "{generator:?}");
        assert!((measure::volume(&fine) - measure::volume(&mesh)).abs() < 1e-5, "{generator:?}");
    }
}

#[test]
fn areas_converge_with_the_square_of_the_width() {
    for scheme in [Scheme::CatmullClark, Scheme::Loop] {
        let area = |levels| measure::area(&run(&cube(), &with(scheme, levels, true)).triangulate());
        let steps = [area(3) - area(2), area(4) - area(3), area(5) - area(4)];
        // Errors fall by four each level, so differences do too.
        for pair in steps.windows(2) {
            let ratio = pair[0] / pair[1];
            assert!((3.0..5.0).contains(&ratio), "{scheme:?}: {ratio}");
        }
    }
}

#[test]
fn uvs_follow_their_rules() {
    let mesh = sheet(3);
    let uv_area = |mesh: &PolygonMesh| {
        let triangles = mesh.triangulate();
        let area = |t: usize| {
            let [a, b, c] = triangles.corner_uvs(t, 0).expect("uvs");
            f64::from((b - a).perp_dot(c - a)) / 2.0
        };
        (0..triangles.triangles.len()).map(area).sum::<f64>()
    };
    let of = |uvs| run(&mesh, &Settings { levels: 3, uvs, ..Settings::default() });
    // Whatever keeps the border keeps the area of the plan; smooth corners lose some.
    assert!((uv_area(&of(UvRule::Linear)) - 9.0).abs() < 1e-4);
    assert!((uv_area(&of(UvRule::SeamsFixed)) - 9.0).abs() < 1e-4);
    assert!((uv_area(&of(UvRule::CornersFixed)) - 9.0).abs() < 1e-4);
    assert!(uv_area(&of(UvRule::Smooth)) < 8.9);
    // The rule of smooth uvs is that of positions: with equal values they stay equal.
    let smooth = of(UvRule::Smooth);
    for (corner, &vertex) in smooth.corners.iter().enumerate() {
        let uv = smooth.uv_sets[0].values[smooth.uv_sets[0].corners[corner] as usize];
        let position = smooth.positions[vertex as usize];
        assert!((uv - Vec2::new(position.x, -position.z)).length() < 1e-5);
    }
}

#[test]
fn one_thread_gives_the_same_bits_as_many() {
    let mesh = PolygonMesh::from(&generate::torus(1.0, 0.3, 40, 30));
    let results = [1, 3].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        pool.install(|| run(&mesh, &with(Scheme::Loop, 2, true)))
    });
    assert_eq!(results[0], results[1]);
}

#[test]
fn too_much_is_refused() {
    let error = subdivide(&cube(), &with(Scheme::CatmullClark, 40, false)).unwrap_err();
    assert_eq!(error, SubdivideError::TooLarge { levels: 40, allowed: 11 });
}
