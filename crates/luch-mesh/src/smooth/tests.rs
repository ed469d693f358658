//! Shrinking at known rates, volumes kept, edges of the wanted length.

use glam::Vec3;

use super::*;
use crate::{Generator, TriangleMesh, generate, measure};

fn volume(mesh: &PolygonMesh) -> f64 {
    measure::volume(&mesh.triangulate())
}

/// On a regular polygon as a border, Laplace multiplies by 1 − λ (1 − cos(2π/n)).
#[test]
fn a_border_shrinks_as_the_cosine_says() {
    let disc = PolygonMesh::from(&generate::cone(1.0, 0.0, 0.0, 16, 1, false));
    let settings = Settings { iterations: 3, keeps_borders: false, ..Settings::default() };
    let small = smooth(&disc, &settings);
    let rate = 1.0 - 0.5 * (1.0 - libm::cos(std::f64::consts::TAU / 16.0));
    for (before, after) in disc.positions.iter().zip(&small.positions) {
        let expected = before.as_dvec3().length() * rate * rate * rate;
        assert!((after.as_dvec3().length() - expected).abs() < 1e-6, "{before} {after}");
    }
    let kept = smooth(&disc, &Settings { iterations: 3, ..Settings::default() });
    assert_eq!(kept.positions[..16], disc.positions[..16]);
}

#[test]
fn taubin_keeps_the_volume_and_takes_the_noise() {
    let ball = PolygonMesh::from(&generate::icosphere(1.0, 4));
    let mut rough = ball.clone();
    let mut state = 3u32;
    for position in &mut rough.positions {
        state = state.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
        *position *= 1.0 + ((state >> 8) as f32 / (1 << 24) as f32 - 0.5) * 0.06;
    }
    let roughness = |mesh: &PolygonMesh| {
        let mean = mesh.positions.iter().map(|p| p.length()).sum::<f32>() / mesh.positions.len() as f32;
        mesh.positions.iter().map(|p| (p.length() - mean).abs()).sum::<f32>() / mesh.positions.len() as f32
    };
    for weights in [Weights::Uniform, Weights::Cotangent] {
        let taubin = Settings { iterations: 20, factor: 0.5, back: 0.53, weights, ..Settings::default() };
        let smooth_ball = smooth(&rough, &taubin);
        assert!(roughness(&smooth_ball) < roughness(&rough) * 0.4, "{weights:?}");
        assert!((volume(&smooth_ball) / volume(&ball) - 1.0).abs() < 0.01, "{weights:?}");
        let laplace = smooth(&rough, &Settings { back: 0.0, ..taubin });
        assert!(volume(&laplace) < volume(&smooth_ball), "{weights:?}");
        // Laplace by cotangents is the gradient of the area: it falls.
        assert!(measure::area(&laplace.triangulate()) < measure::area(&ball.triangulate()));
    }
}

fn edge_lengths(mesh: &TriangleMesh) -> Vec<f64> {
    let edges = crate::edges::Edges::new(&mesh.triangles, mesh.positions.len());
    let length =
        |[a, b]: [u32; 2]| f64::from(mesh.positions[a as usize].distance(mesh.positions[b as usize]));
    edges.iter(&mesh.triangles).map(|edge| length(edge.vertices)).collect()
}

#[test]
fn remeshed_edges_have_the_wanted_length() {
    // Equal places are one here; the teapot has one twice, where its handle touches the body.
    for generator in Generator::examples().into_iter().filter(|g| !matches!(g, Generator::Teapot { .. })) {
        let mesh = generator.refined(2).mesh();
        // Tubes want enough edges around them to stay tubes.
        let is_thin = matches!(generator, Generator::TorusKnot { .. } | Generator::Spring { .. });
        let length = measure::area(&mesh).sqrt() / if is_thin { 60.0 } else { 25.0 };
        let even = remesh(&mesh, &Remesh { length, ..Remesh::default() }).expect("fine enough");
        assert_eq!(even.validate(), [], "{generator:?}");
        let report = measure::closedness(&even);
        assert_eq!(report.euler_characteristic, generator.euler_characteristic(), "{generator:?}: {report}");
        assert_eq!(report.is_closed(), generator.is_closed(), "{generator:?}: {report}");
        let ratio = measure::area(&even) / measure::area(&mesh);
        // Of five chords around a tube 5/π · sin(π/5) = 93.5 % of its area is left.
        let has_tube = is_thin || matches!(generator, Generator::KleinBottle { .. });
        let least = if has_tube { 0.935 } else { 0.97 };
        assert!((least..1.01).contains(&ratio), "{generator:?}: {ratio}");
        let lengths = edge_lengths(&even);
        let good = lengths.iter().filter(|l| (0.6..1.5).contains(&(**l / length))).count();
        assert!(good * 100 > lengths.len() * 90, "{generator:?}: {good} of {}", lengths.len());
    }
}

#[test]
fn sharp_edges_stay() {
    let cube = generate::cuboid(Vec3::ONE, [1; 3]);
    let even = remesh(&cube, &Remesh { length: 0.1, ..Remesh::default() }).unwrap();
    assert!((measure::volume(&even) - 1.0).abs() < 1e-6);
    assert!((measure::area(&even) - 6.0).abs() < 1e-5);
    assert!(even.triangles.len() > 1000);
}

#[test]
fn what_cannot_be_remeshed_is_refused() {
    let cube = generate::cuboid(Vec3::ONE, [1; 3]);
    let with = |length| remesh(&cube, &Remesh { length, ..Remesh::default() });
    assert!(matches!(with(0.0), Err(RemeshError::Length { .. })));
    assert!(matches!(with(f64::NAN), Err(RemeshError::Length { .. })));
    assert!(matches!(with(1e-9), Err(RemeshError::TooFine { .. })));
}
