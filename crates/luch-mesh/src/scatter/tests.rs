use super::*;
use crate::generate;

#[test]
fn uniform_points_lie_in_proportion_to_area() {
    // A box of sides 1, 2, 3: six faces, chi-square over them and over each face's quarters. The sequence is more even than
    // chance, so the statistic stays below that of chance.
    let mesh = generate::cuboid(Vec3::new(1.0, 2.0, 3.0), [2, 2, 2]);
    let count = 4800;
    let points = uniform(&mesh, count, 3);
    let mut counts = vec![0.0; mesh.triangles.len()];
    points.iter().for_each(|point| counts[point.triangle as usize] += 1.0);
    let areas: Vec<f64> = (0..counts.len()).map(|t| f64::from(mesh.area_normal(t).length()) / 2.0).collect();
    let chi_square: f64 = counts
        .iter()
        .zip(&areas)
        .map(|(seen, area)| {
            let expected = count as f64 * area / 22.0;
            (seen - expected) * (seen - expected) / expected
        })
        .sum();
    // 47 degrees of freedom: 4σ above the mean is 47 + 4 √94.
    assert!(chi_square < 86.0, "{chi_square}");
    // Independent weights: only one side of the box.
    let top = |t: usize| f64::from(u8::from(mesh.area_normal(t).y > 0.0));
    assert!(
        weighted(&mesh, 500, 1, top)
            .iter()
            .all(|point| (point.position.y - 1.0).abs() < 1e-6 && point.normal == Vec3::Y)
    );
}

#[test]
fn points_lie_on_their_triangles_with_their_attributes() {
    let mesh = generate::torus(2.0, 0.5, 24, 12);
    for point in uniform(&mesh, 300, 9) {
        let weights = point.weights;
        assert!(
            weights.iter().all(|weight| *weight >= 0.0) && (weights.iter().sum::<f32>() - 1.0).abs() < 1e-6
        );
        let [a, b, c] = mesh.corners(point.triangle as usize);
        assert!((a * weights[0] + b * weights[1] + c * weights[2] - point.position).length() < 1e-6);
        let flat = mesh.area_normal(point.triangle as usize).normalize();
        assert!(point.normal.dot(flat) > 0.9 && (point.normal.length() - 1.0).abs() < 1e-6);
        assert!(point.uv.is_some());
    }
}

#[test]
fn blue_points_keep_apart() {
    let mesh = generate::icosphere(1.0, 3);
    let least = |points: &[Scattered]| {
        let mut least = f32::INFINITY;
        for (i, one) in points.iter().enumerate() {
            for other in &points[..i] {
                least = least.min(one.position.distance(other.position));
            }
        }
        least
    };
    let thrown = apart(&mesh, 0.1, 1 << 16, 5);
    // The densest lattice would hold 8π / (√3 0.1²) = 1451; discs thrown at random jam at 0.60 of that (0.547 of the area, Feder
    // 1980), which is approached slowly.
    assert!(least(&thrown) >= 0.1 && (726..871).contains(&thrown.len()), "{}", thrown.len());
    assert_eq!(apart(&mesh, 0.1, 10, 5), thrown[..10]);
    let even = even(&mesh, 500, 5);
    assert_eq!(even.len(), 500);
    // The hexagonal lattice would keep 2 r = √(2 A / (√3 N)); Yuksel finds about 0.7 to 0.8 of that.
    let lattice = (2.0 * 4.0 * std::f32::consts::PI / (3f32.sqrt() * 500.0)).sqrt();
    assert!(least(&even) > 0.6 * lattice, "{} of {lattice}", least(&even));
    assert!(least(&uniform(&mesh, 500, 5)) < 0.3 * lattice);
}

#[test]
fn odd_meshes_and_numbers_do_no_harm() {
    let dot = TriangleMesh::new(vec![Vec3::ZERO, Vec3::NAN, Vec3::X], vec![[0, 0, 0], [0, 1, 2], [0, 2, 9]]);
    assert!(
        uniform(&dot, 10, 0).is_empty() && even(&dot, 10, 0).is_empty() && apart(&dot, 0.1, 9, 0).is_empty()
    );
    let sheet = generate::plane(glam::Vec2::ONE, [1, 1]);
    for distance in [0.0, -1.0, f32::NAN, f32::INFINITY] {
        assert!(apart(&sheet, distance, 9, 0).is_empty());
    }
    assert_eq!(apart(&sheet, 1e30, 9, 0).len(), 1);
    assert!(even(&sheet, 0, 0).is_empty());
    assert!(weighted(&sheet, 9, 0, |_| f64::NAN).is_empty());
}
