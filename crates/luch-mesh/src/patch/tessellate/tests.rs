use super::*;
use crate::measure;
use crate::patch::{ControlPoint, Curve, Keeps, Surface, TrimLoop, Trimming, shapes};
use crate::screen::{OnScreen, ScreenView};
use std::f64::consts::PI;

fn noise(seed: u64, k: u64) -> f64 {
    2.0 * luch_sampling::hash::unit_f64((luch_sampling::hash::word(seed, k) >> 32) as u32) - 1.0
}

/// A patch over the unit square with waves and uneven weights.
fn odd_patch(seed: u64) -> Surface {
    let degrees = [1 + seed % 4, 1 + seed / 4 % 4].map(|d| d as usize);
    let counts = [degrees[0] + 1 + (seed % 3) as usize, degrees[1] + 1 + (seed % 2) as usize];
    let points: Vec<_> = (0..(counts[0] * counts[1]) as u64)
        .map(|k| {
            let (i, j) = (k % counts[0] as u64, k / counts[0] as u64);
            let share = |at: u64, count: usize| at as f64 / (count - 1) as f64;
            let place = DVec3::new(
                share(i, counts[0]) + 0.1 * noise(seed, 4 * k),
                share(j, counts[1]) + 0.1 * noise(seed, 4 * k + 1),
                noise(seed, 4 * k + 2),
            );
            let weight = if seed.is_multiple_of(2) { 1.0 } else { 1.0 + 0.5 * noise(seed, 4 * k + 3) };
            ControlPoint::weighted(place, weight)
        })
        .collect();
    Surface::b_spline(degrees, counts, &points).unwrap()
}

/// The largest distance between triangles and the surface at the same parameters, found by dense sampling.
fn largest_error(surface: &Surface, mesh: &TriangleMesh) -> f64 {
    let mut most = 0.0f64;
    for t in 0..mesh.triangles.len() {
        let corners = mesh.corners(t).map(|p| p.as_dvec3());
        let uvs = mesh.corner_uvs(t, 0).unwrap().map(|uv| uv.as_dvec2());
        for i in 0..=4 {
            for j in 0..=4 - i {
                let weights = [f64::from(i) / 4.0, f64::from(j) / 4.0, f64::from(4 - i - j) / 4.0];
                let uv: DVec2 = uvs.iter().zip(weights).map(|(uv, w)| *uv * w).sum();
                let point: DVec3 = corners.iter().zip(weights).map(|(p, w)| *p * w).sum();
                most = most.max(surface.position(uv.x, uv.y).distance(point));
            }
        }
    }
    most
}

#[test]
fn triangles_stay_within_the_tolerance() {
    for seed in 0..16 {
        let surface = odd_patch(seed);
        for tolerance in [0.1, 0.03] {
            let mesh = PatchModel::from(surface.clone()).tessellate(Fineness::Tolerance(tolerance)).unwrap();
            let error = largest_error(&surface, &mesh);
            // Positions and uvs are rounded to f32: 10⁻⁶ at this size.
            assert!(error <= tolerance + 1e-6, "{seed}: {error} > {tolerance}");
            let coarse = surface.knots()[0].degree() == 1 && surface.knots()[1].degree() == 1;
            // The bound is not far from the truth, either.
            assert!(coarse || error > 0.02 * tolerance, "{seed}: {error} for {tolerance}");
        }
    }
}

#[test]
fn round_bodies_are_closed_with_the_right_genus() {
    let bodies = [
        (
            PatchModel::from(shapes::sphere(1.0).unwrap()),
            "closed (1 piece, genus 0)",
            4.0 / 3.0 * PI,
            4.0 * PI,
        ),
        (
            PatchModel::from(shapes::torus(2.0, 0.5).unwrap()),
            "closed (1 piece, genus 1)",
            PI * PI,
            4.0 * PI * PI,
        ),
        (shapes::cylinder(1.0, 2.0).unwrap(), "closed (1 piece, genus 0)", 2.0 * PI, 6.0 * PI),
    ];
    for (model, closedness, volume, area) in bodies {
        for fineness in [
            Fineness::Tolerance(0.1),
            Fineness::Tolerance(0.003),
            Fineness::Divisions(1),
            Fineness::Divisions(5),
        ] {
            let mesh = model.tessellate(fineness.clone()).unwrap();
            assert_eq!(measure::closedness(&mesh).to_string(), closedness, "{fineness:?}");
            assert_eq!(mesh.validate(), []);
            assert!(measure::volume(&mesh) > 0.0);
            assert_eq!(crate::clean::remove_degenerate(&mesh).removed, 0);
        }
        // Errors fall with the square of the resolution.
        let errors = [8, 16, 32].map(|n| {
            let mesh = model.tessellate(Fineness::Divisions(n)).unwrap();
            [1.0 - measure::area(&mesh) / area, 1.0 - measure::volume(&mesh) / volume]
        });
        for pair in errors.windows(2) {
            for (coarse, fine) in pair[0].iter().zip(pair[1]) {
                assert!((3.6..4.4).contains(&(coarse / fine)), "{errors:?}");
            }
        }
    }
}

#[test]
fn normals_are_those_of_the_sphere_also_at_the_poles() {
    let mesh = PatchModel::from(shapes::sphere(2.0).unwrap()).tessellate(Fineness::Tolerance(0.01)).unwrap();
    for t in 0..mesh.triangles.len() {
        for (place, normal) in mesh.corners(t).into_iter().zip(mesh.corner_normals(t).unwrap()) {
            assert!((place / 2.0).distance(normal) < 1e-5, "{place} {normal}");
        }
        let [a, b, c] = mesh.corner_uvs(t, 0).unwrap();
        assert!((b - a).perp_dot(c - a) > 0.0);
    }
}

/// Two patches that share a straight side, one flat, the other strongly bent: no T-junctions.
#[test]
fn neighbours_of_different_bend_have_no_cracks() {
    let flat = |x: f64, y: f64, z: f64| ControlPoint::new(DVec3::new(x, y, z));
    let mut bent = Vec::new();
    for j in 0..4 {
        for i in 0..4 {
            let bump = if (1..3).contains(&i) && j > 0 { 2.0 } else { 0.0 };
            // Equal steps make the side at j = 0 a straight line of degree 3.
            bent.push(flat(f64::from(i) / 3.0, f64::from(j) / 3.0, bump));
        }
    }
    let side: Vec<_> = bent[..4].to_vec();
    let mut level = side.clone();
    level.reverse();
    level.extend(side.iter().rev().map(|p| flat(p.position.x, -1.0, 0.0)));
    let bent = Surface::bezier([3, 3], &bent).unwrap();
    // Runs against its neighbour: from right to left, then down.
    let level = Surface::bezier([3, 1], &level).unwrap();
    let model = PatchModel::from_iter([bent, level]);
    let mesh = model.tessellate(Fineness::Tolerance(0.002)).unwrap();
    let report = measure::closedness(&mesh);
    // One sheet with one border: a disc.
    assert_eq!((report.components, report.euler_characteristic, report.pinched), (1, 1, 0));
    assert!(report.inconsistent.is_none() && report.non_manifold.is_none());
    let inner = mesh.positions.iter().filter(|p| p.y == 0.0).count();
    assert!(inner > 20, "{inner}");
}

#[test]
fn a_flat_disc_and_its_complement_have_their_areas() {
    let points = [(0.0, 0.0), (2.0, 0.0), (0.0, 2.0), (2.0, 2.0)]
        .map(|(x, y)| ControlPoint::new(DVec3::new(x, y, 0.0)));
    let plane = Surface::bezier([1, 1], &points).unwrap();
    let disc = || TrimLoop::from(shapes::circle_in_plane(DVec2::splat(0.5), 0.3).unwrap());
    for tolerance in [0.01, 0.001] {
        for (keeps, truth) in [(Keeps::Inside, PI * 0.36), (Keeps::Outside, 4.0 - PI * 0.36)] {
            let trimming = Some(Trimming { loops: vec![disc()], keeps });
            let model = PatchModel { patches: vec![Patch { surface: plane.clone(), trimming }] };
            let mesh = model.tessellate(Fineness::Tolerance(tolerance)).unwrap();
            // The border is off by at most the tolerance.
            let error = (measure::area(&mesh) - truth).abs();
            assert!(error <= 2.0 * PI * 0.6 * tolerance, "{error}");
            assert_eq!(mesh.validate(), []);
            let report = measure::closedness(&mesh);
            let holes = if keeps == Keeps::Inside { 1 } else { 0 };
            assert_eq!((report.components, report.euler_characteristic), (1, holes));
        }
    }
}

/// A sphere with a window, and a lid cut from the same sphere: area of both together, tolerance of each.
#[test]
fn trimmed_surfaces_keep_the_tolerance_over_all_breaks() {
    let sphere = shapes::sphere(1.0).unwrap();
    let window = || TrimLoop::from(shapes::circle_in_plane(DVec2::splat(0.5), 0.31).unwrap());
    for tolerance in [0.02, 0.004] {
        let mut area = 0.0;
        for keeps in [Keeps::Inside, Keeps::Outside] {
            let trimming = Some(Trimming { loops: vec![window()], keeps });
            let model = PatchModel { patches: vec![Patch { surface: sphere.clone(), trimming }] };
            let mesh = model.tessellate(Fineness::Tolerance(tolerance)).unwrap();
            assert!(largest_error(&sphere, &mesh) <= tolerance + 1e-6);
            area += measure::area(&mesh);
            let report = measure::closedness(&mesh);
            assert!(
                report.non_manifold.is_none() && report.inconsistent.is_none() && report.boundary.is_some()
            );
            assert_eq!((report.components, report.euler_characteristic), (1, 1), "{keeps:?}");
        }
        assert!((area - 4.0 * PI).abs() < 4.0 * PI * 2.0 * tolerance, "{area}");
    }
}

/// A loop along the border of the patch takes the vertices that the neighbour has there.
#[test]
fn a_trimmed_patch_meets_its_whole_neighbour() {
    let torus = shapes::torus(2.0, 0.5).unwrap();
    let [mut left, mut right] = [Vec::new(), Vec::new()];
    // Two half tori with common circles.
    for (k, piece) in torus.bezier_pieces().into_iter().enumerate() {
        if k % 4 < 2 { left.push(piece) } else { right.push(piece) }
    }
    let all = |surface: Surface| {
        let corners =
            [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0), (0.0, 0.0)].map(|(u, v)| DVec3::new(u, v, 0.0));
        let loops = vec![TrimLoop::from(Curve::polyline(&corners).unwrap())];
        Patch { surface, trimming: Some(Trimming { loops, keeps: Keeps::Inside }) }
    };
    let mut model = PatchModel::from_iter(left);
    model.patches.extend(right.into_iter().map(all));
    for fineness in [Fineness::Tolerance(0.01), Fineness::Divisions(3)] {
        let mesh = model.tessellate(fineness).unwrap();
        assert_eq!(measure::closedness(&mesh).to_string(), "closed (1 piece, genus 1)");
    }
}

#[test]
fn loops_that_are_open_or_cross_are_refused() {
    let plane = odd_patch(0);
    let with = |corners: &[(f64, f64)]| {
        let corners: Vec<_> = corners.iter().map(|&(u, v)| DVec3::new(u, v, 0.0)).collect();
        let loops = vec![TrimLoop::from(Curve::polyline(&corners).unwrap())];
        let trimming = Some(Trimming { loops, keeps: Keeps::Inside });
        PatchModel { patches: vec![Patch { surface: plane.clone(), trimming }] }
            .tessellate(Fineness::Tolerance(0.1))
    };
    assert!(matches!(with(&[(0.1, 0.1), (0.9, 0.1), (0.5, 0.9)]), Err(PatchError::OpenLoop { .. })));
    let bow = [(0.1, 0.1), (0.9, 0.93), (0.9, 0.1), (0.1, 0.9), (0.1, 0.1)];
    assert!(matches!(with(&bow), Err(PatchError::Crossing { .. })));
    // Far outside the patch nothing is left.
    let outside = [(5.0, 5.0), (6.0, 5.0), (6.0, 7.0), (5.0, 5.0)];
    assert!(with(&outside).unwrap().triangles.is_empty());
}

#[test]
fn a_far_camera_asks_for_less() {
    let model = PatchModel::from(shapes::sphere(1.0).unwrap());
    let view = |distance: f64| {
        let view = ScreenView::perspective(DVec3::new(0.0, 0.0, distance), 0.8, 720, 0.01);
        Fineness::Screen(OnScreen { views: vec![view], pixels: 0.5 })
    };
    let count = |distance: f64| {
        let mesh = model.tessellate(view(distance)).unwrap();
        assert!(measure::closedness(&mesh).is_closed());
        mesh.triangles.len()
    };
    let counts = [3.0, 6.0, 12.0, 100.0].map(count);
    assert!(counts.windows(2).all(|pair| pair[0] > pair[1]), "{counts:?}");
    // A pixel is about 0.0012 rad: half of one at distance 11 is 6.5 mm.
    let pixel = 2.0 * libm::tan(0.4) / 720.0 * 0.5;
    let mesh = model.tessellate(view(12.0)).unwrap();
    for t in 0..mesh.triangles.len() {
        let centre = mesh.corners(t).into_iter().sum::<glam::Vec3>().as_dvec3() / 3.0;
        assert!(1.0 - centre.length() <= pixel * (13.0 - centre.z), "{centre}");
    }
}

#[test]
fn senseless_wishes_are_refused() {
    let model = PatchModel::from(shapes::sphere(1.0).unwrap());
    for tolerance in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(model.tessellate(Fineness::Tolerance(tolerance)).is_err());
    }
    for fineness in [Fineness::Tolerance(1e-300), Fineness::Tolerance(1e-12), Fineness::Divisions(u32::MAX)] {
        assert!(
            matches!(model.tessellate(fineness.clone()), Err(PatchError::TooFine { .. })),
            "{fineness:?}"
        );
    }
    let huge = PatchModel::from(shapes::sphere(1e17).unwrap());
    assert!(huge.tessellate(Fineness::Tolerance(0.001)).is_err());
    assert!(measure::closedness(&huge.tessellate(Fineness::Tolerance(1e15)).unwrap()).is_closed());
    // All points in one place: nothing, but no error.
    let point = Surface::bezier([2, 2], &[ControlPoint::new(DVec3::ONE); 9]).unwrap();
    assert!(PatchModel::from(point).tessellate(Fineness::Tolerance(0.1)).unwrap().triangles.is_empty());
    assert!(PatchModel::default().tessellate(Fineness::Divisions(3)).unwrap().triangles.is_empty());
}
