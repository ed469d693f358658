//! The textbook test against the watertight one and against a solver that knows nothing of triangles.

use crate::meshes;
use crate::random::Random;
use luch_bvh::triangle::{ShearedRay, cramer, solve};
use luch_bvh::{BruteForce, Ray, Triangle, TriangleTest};

/// Gauss's elimination with the largest pivot, in double precision.
fn eliminate(mut rows: [[f64; 4]; 3]) -> [f64; 3] {
    for column in 0..3 {
        let pivot =
            (column..3).max_by(|a, b| rows[*a][column].abs().total_cmp(&rows[*b][column].abs())).unwrap();
        rows.swap(column, pivot);
        for row in 0..3 {
            if row != column {
                let factor = rows[row][column] / rows[column][column];
                let other = rows[column];
                for (entry, other) in rows[row].iter_mut().zip(other) {
                    *entry -= factor * other;
                }
            }
        }
    }
    [0, 1, 2].map(|row| rows[row][3] / rows[row][row])
}

#[test]
fn mixed_products_solve_the_system() {
    let mut random = Random::new(31);
    let mut solved = 0;
    for _ in 0..20_000 {
        let triangle = Triangle { a: random.vector(), b: random.vector(), c: random.vector() };
        let ray = Ray::new(random.vector() * 3.0, random.vector());
        let Some(found) = solve(&ray, &triangle) else { continue };
        let columns =
            [triangle.b - triangle.a, triangle.c - triangle.a, -ray.direction, ray.origin - triangle.a];
        let expected = eliminate([0, 1, 2].map(|row| columns.map(|column| f64::from(column[row]))));
        // The error of Cramer's rule is that of its determinants: a few ulp of the products, over the determinant.
        let sizes = columns.map(|column| column.length());
        let rounding = 16.0 * f32::EPSILON / found.determinant.abs();
        let tolerance = [
            rounding * sizes[3] * sizes[1] * sizes[2],
            rounding * sizes[0] * sizes[3] * sizes[2],
            rounding * sizes[0] * sizes[1] * sizes[3],
        ];
        for (index, value) in [found.lambda2, found.lambda3, found.gamma].into_iter().enumerate() {
            let relative = 1.0 + rounding * sizes[0] * sizes[1] * sizes[2];
            let error = (f64::from(value) - expected[index]).abs();
            let allowed =
                tolerance[index] * relative + value.abs() * rounding * sizes[0] * sizes[1] * sizes[2];
            assert!(
                error <= f64::from(allowed),
                "{value} instead of {}: {ray:?} {triangle:?}",
                expected[index]
            );
        }
        solved += 1;
    }
    assert!(solved > 19_900);
}

#[test]
fn both_tests_agree_away_from_edges() {
    let mut random = Random::new(32);
    let mut hits = 0;
    for _ in 0..100_000 {
        let triangle = Triangle { a: random.vector(), b: random.vector(), c: random.vector() };
        let target = triangle.at(random.signed(), random.signed());
        let origin = random.vector() * 2.0;
        let ray = Ray::new(origin, target - origin);
        let Some(solution) = solve(&ray, &triangle) else { continue };
        // How far a coordinate may be off, by the same reckoning as above.
        let size = (triangle.b - triangle.a).length().max((triangle.c - triangle.a).length()).max(1.0);
        let margin = 64.0 * f32::EPSILON * size * size * 4.0 / solution.determinant.abs();
        let weights = [solution.lambda2, solution.lambda3, 1.0 - solution.lambda2 - solution.lambda3];
        if margin > 0.01
            || weights.iter().any(|weight| weight.abs() < margin)
            || solution.gamma.abs() < margin
        {
            continue;
        }
        let found = ShearedRay::new(&ray).unwrap().hit(&triangle);
        let expected = cramer(&ray, &triangle);
        assert_eq!(found.is_some(), expected.is_some(), "{ray:?} {triangle:?}");
        if let (Some(found), Some(expected)) = (found, expected) {
            assert_eq!(found.front, expected.front);
            let differences = [found.t - expected.t, found.u - expected.u, found.v - expected.v];
            assert!(
                differences.iter().all(|difference| difference.abs() <= margin),
                "{found:?} {expected:?}"
            );
            hits += 1;
        }
    }
    assert!(hits > 5_000, "{hits}");
}

#[test]
fn both_loops_find_the_same_triangle() {
    let mesh = meshes::sphere(12, 20);
    let loops = [TriangleTest::Watertight, TriangleTest::Cramer]
        .map(|test| BruteForce::new(&mesh.positions, &mesh.triangles, test));
    let mut random = Random::new(33);
    for _ in 0..2_000 {
        let ray = Ray::new(random.vector() * 4.0, random.vector());
        let [watertight, textbook] = loops.each_ref().map(|loops| loops.nearest(&ray));
        let edge = |hit: luch_bvh::Hit| hit.u.min(hit.v).min(1.0 - hit.u - hit.v) < 1e-4;
        if watertight.is_some_and(edge) || textbook.is_some_and(edge) {
            continue;
        }
        assert_eq!(watertight.map(|hit| hit.primitive), textbook.map(|hit| hit.primitive), "{ray:?}");
    }
}
