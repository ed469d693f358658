//! What surfaces of fields promise.

use std::f64::consts::PI;

use glam::{DQuat, DVec3};
use luch_mesh::implicit::{
    Field, FunctionField, Grid, ImplicitError, Method, Region, Sampling, marching_cubes, sample, surface,
};
use luch_mesh::{TriangleMesh, measure};

/// Uniform numbers, the same on every machine.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        self.0 >> 33
    }

    fn unit(&mut self) -> f32 {
        self.next() as f32 / (1u64 << 31) as f32
    }
}

fn assert_closed_manifold(mesh: &TriangleMesh, context: &str) {
    if mesh.triangles.is_empty() {
        return;
    }
    assert_eq!(mesh.validate(), [], "{context}");
    let report = measure::closedness(mesh);
    assert!(report.is_closed(), "{context}: {report}");
    assert_eq!((report.pinched, report.duplicates, report.collapsed), (0, 0, 0), "{context}");
}

/// Random grids of six cells a side with a layer outside all round, of several kinds.
fn random_grids() -> impl Iterator<Item = Grid> {
    let mut numbers = Numbers(1);
    (0..1000).map(move |n| {
        let counts = [5 + n % 3, 5, 5 + n % 2];
        let values = (0..counts.iter().product::<usize>()).map(|_| match n % 4 {
            // Any numbers; few whole numbers, so that many samples lie at the level; signs; oddities.
            0 => numbers.unit() - 0.5,
            1 => (numbers.next() % 5) as f32 - 2.0,
            2 => (numbers.next() % 2) as f32 * 2.0 - 1.0,
            _ => match numbers.next() % 8 {
                0 => f32::NAN,
                1 => f32::INFINITY,
                2 => f32::NEG_INFINITY,
                3 => 1e-40,
                _ => numbers.unit() - 0.5,
            },
        });
        Grid::new(counts, values.collect()).and_then(|grid| grid.closed()).expect("a small grid")
    })
}

#[test]
fn marching_cubes_of_random_grids_are_closed_manifolds_without_shared_places() {
    for (n, grid) in random_grids().enumerate() {
        let mesh = marching_cubes(&grid, 0.0).unwrap();
        assert!(!mesh.triangles.is_empty());
        assert_closed_manifold(&mesh, &format!("grid {n}"));
        assert!(measure::volume(&mesh) > 0.0, "grid {n}");
        // Middles of loops may coincide with nothing either.
        assert_eq!(luch_mesh::weld::weld_exact(&mesh).merged, 0, "grid {n}");
    }
}

#[test]
fn both_methods_give_closed_manifolds_of_random_fields() {
    for (n, grid) in random_grids().enumerate() {
        let mut numbers = Numbers(n as u64);
        let last = grid.counts().map(|count| count - 1);
        let region = Region { min: grid.origin, max: grid.position(last) };
        let resolution = last.into_iter().max().unwrap() as u32;
        // The samples themselves, or others.
        let resolution = resolution + (numbers.next() % 3) as u32;
        for method in [Method::MarchingCubes, Method::DualContouring] {
            let mesh = surface(&grid, &Sampling { region, resolution, closed: true }, method).unwrap();
            assert_closed_manifold(&mesh, &format!("grid {n}, {method:?}"));
        }
    }
}

/// A unit sphere by its exact distance.
const SPHERE: FunctionField<fn(DVec3) -> f64> = FunctionField(|p| p.length() - 1.0);

#[test]
fn spheres_approach_the_truth_with_the_square_of_the_resolution() {
    let (area, volume) = (4.0 * PI, 4.0 / 3.0 * PI);
    for method in [Method::MarchingCubes, Method::DualContouring] {
        let errors = [16, 32, 64].map(|resolution| {
            let sampling = Sampling { region: Region::cube(1.2), resolution, closed: false };
            let mesh = surface(&SPHERE, &sampling, method).unwrap();
            assert_eq!(measure::closedness(&mesh).to_string(), "closed (1 piece, genus 0)");
            [(measure::area(&mesh) / area - 1.0).abs(), (measure::volume(&mesh) / volume - 1.0).abs()]
        });
        for measure in 0..2 {
            let order = libm::log2(errors[0][measure] / errors[2][measure]) / 2.0;
            assert!((1.8..2.4).contains(&order), "{method:?} {errors:?}");
        }
        assert!(errors[2][1] < 2e-3, "{errors:?}");
    }
}

#[test]
fn vertices_of_marching_cubes_lie_on_the_surface_and_normals_are_true() {
    let sampling = Sampling { region: Region::cube(1.3), resolution: 20, closed: false };
    let mesh = surface(&SPHERE, &sampling, Method::MarchingCubes).unwrap();
    for (position, normal) in mesh.positions.iter().zip(&mesh.normals.values) {
        assert!((position.length() - 1.0).abs() < 3e-7);
        assert!((*normal - *position).length() < 1e-5);
    }
    // From samples alone normals are right to the second order.
    let grid = sample(&SPHERE, &sampling).unwrap();
    let mesh = marching_cubes(&grid, 0.0).unwrap();
    for (position, normal) in mesh.positions.iter().zip(&mesh.normals.values) {
        assert!((position.length() - 1.0).abs() < 5e-3);
        assert!((*normal - position.normalize()).length() < 0.02);
    }
}

/// A box of half side 0.7, turned, so that nothing lies along the lattice.
fn turned_box() -> FunctionField<impl Fn(DVec3) -> f64 + Sync> {
    let turn = DQuat::from_euler(glam::EulerRot::XYZ, 0.5, 0.3, 0.2);
    FunctionField(move |p: DVec3| {
        let q = (turn * p).abs() - 0.7;
        q.max(DVec3::ZERO).length() + q.max_element().min(0.0)
    })
}

#[test]
fn dual_contouring_keeps_the_corners_of_a_box() {
    let sampling = Sampling { region: Region::cube(1.5), resolution: 40, closed: false };
    let mesh = surface(&turned_box(), &sampling, Method::DualContouring).unwrap();
    assert_eq!(measure::closedness(&mesh).to_string(), "closed (1 piece, genus 0)");
    let (area, volume) = (6.0 * 1.4 * 1.4, 1.4 * 1.4 * 1.4);
    // As exact as single precision of the positions.
    assert!((measure::area(&mesh) / area - 1.0).abs() < 1e-6, "{} {area}", measure::area(&mesh));
    assert!((measure::volume(&mesh) / volume - 1.0).abs() < 1e-6);
    let back = DQuat::from_euler(glam::EulerRot::XYZ, 0.5, 0.3, 0.2).inverse();
    for corner in 0..8 {
        let corner = DVec3::from([0, 1, 2].map(|axis| if corner >> axis & 1 == 1 { 0.7 } else { -0.7 }));
        let corner = back * corner;
        let nearest = mesh.positions.iter().map(|p| (p.as_dvec3() - corner).length()).fold(9.0, f64::min);
        assert!(nearest < 1e-6, "{corner} is {nearest} away");
    }
    // Marching cubes cuts them off.
    let cut = surface(&turned_box(), &sampling, Method::MarchingCubes).unwrap();
    assert!(measure::volume(&cut) < volume * (1.0 - 1e-4));
}

#[test]
fn forms_have_their_genus() {
    let heart = FunctionField(|p: DVec3| {
        let DVec3 { x, y, z } = p;
        let round = x * x + 2.25 * y * y + z * z - 1.0;
        round * round * round - x * x * z * z * z - 0.1125 * y * y * z * z * z
    });
    let ring = FunctionField(|p: DVec3| {
        let around = (p.x * p.x + p.z * p.z).sqrt() - 1.0;
        (around * around + p.y * p.y).sqrt() - 0.35
    });
    let forms: [(&dyn Field, u64); 2] = [(&heart, 0), (&ring, 1)];
    for (field, genus) in forms {
        for method in [Method::MarchingCubes, Method::DualContouring] {
            let sampling = Sampling { region: Region::cube(1.5), resolution: 50, closed: false };
            let report = measure::closedness(&surface(field, &sampling, method).unwrap());
            assert!(report.is_closed() && report.components == 1 && report.pinched == 0, "{report}");
            assert_eq!(report.genus, Some(genus));
        }
    }
}

#[test]
fn regions_that_make_no_sense_are_refused() {
    let attempt = |region: Region, resolution: u32| {
        surface(&SPHERE, &Sampling { region, resolution, closed: true }, Method::MarchingCubes)
    };
    assert!(matches!(attempt(Region::cube(1.0), u32::MAX), Err(ImplicitError::TooManySamples { .. })));
    let flat = Region { min: DVec3::ZERO, max: DVec3::new(1.0, 0.0, 1.0) };
    for region in
        [flat, Region::cube(0.0), Region::cube(-1.0), Region::cube(f64::NAN), Region::cube(f64::INFINITY)]
    {
        assert!(matches!(attempt(region, 8), Err(ImplicitError::Region { .. })), "{region:?}");
    }
    let far = Region { min: DVec3::splat(1e9), max: DVec3::splat(1e9 + 1.0) };
    assert!(attempt(far, 8).is_err());
    // One cell is enough.
    assert_closed_manifold(&attempt(Region::cube(0.5), 0).unwrap(), "one cell");
}

#[test]
fn threads_change_nothing() {
    let sampling = Sampling { region: Region::cube(1.5), resolution: 60, closed: false };
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let grid = sample(&turned_box(), &sampling).unwrap();
            let marched = marching_cubes(&grid, 0.1).unwrap();
            [marched, surface(&turned_box(), &sampling, Method::DualContouring).unwrap()]
        })
    };
    assert_eq!(run(1), run(3));
}
