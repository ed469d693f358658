use std::f64::consts::PI;

use super::*;
use crate::generate::{self, Generator};
use crate::{measure, unify};

fn with_everything() -> Options {
    Options { weld: true, self_intersections: true }
}

#[test]
fn agrees_with_the_plain_measures_on_everything() {
    for generator in Generator::examples() {
        // Welding joins the two vertices of the teapot where its handle touches the body.
        if matches!(generator, Generator::Teapot { .. }) {
            continue;
        }
        for mesh in [generator.mesh(), unify::split_positions(&generator.mesh())] {
            let report = inspect(&mesh, &with_everything());
            let plain = measure::closedness(&generator.mesh());
            assert_eq!(report.verdict, plain.to_string(), "{generator:?}");
            assert_eq!(report.closed, generator.is_closed());
            assert_eq!(report.euler_characteristic, generator.euler_characteristic());
            assert_eq!((report.genus, report.components), (plain.genus, plain.components));
            assert_eq!(report.boundary_edges, plain.boundary.map_or(0, |fault| fault.count));
            assert!((report.area - measure::area(&mesh)).abs() <= 1e-12 * report.area);
            assert!((report.volume - measure::volume(&mesh)).abs() <= 1e-12 * report.volume.abs());
            let found = report.self_intersections.unwrap();
            assert!(!found.is_lower_bound);
            // In space a Klein bottle crosses itself.
            let crosses = matches!(generator, Generator::KleinBottle { .. });
            assert_eq!(found.triangles > 0, crosses, "{generator:?} {:?}", found.first);
            assert_eq!(
                report.aspects.iter().map(|class| class.count).sum::<u64>(),
                mesh.triangles.len() as u64
            );
            assert_eq!(
                report.edge_lengths.iter().map(|class| class.count).sum::<u64>(),
                3 * mesh.triangles.len() as u64
            );
            assert_eq!(report.duplicate_positions, mesh.positions.len() - generator.mesh().positions.len());
        }
    }
}

#[test]
fn inertia_of_a_box_and_a_ball() {
    let mut mesh = generate::cuboid(Vec3::new(1.0, 2.0, 3.0), [2, 1, 3]);
    mesh.positions.iter_mut().for_each(|p| *p += Vec3::new(1024.0, 0.0, -512.0));
    let report = inspect(&mesh, &Options::default());
    assert_eq!(report.center_of_mass, Some([1024.0, 0.0, -512.0]));
    let inertia = report.inertia.unwrap();
    // m/12 (b² + c²) with m = 6.
    let expected = [[6.5, 0.0, 0.0], [0.0, 5.0, 0.0], [0.0, 0.0, 2.5]];
    for (one, other) in inertia.as_flattened().iter().zip(expected.as_flattened()) {
        assert!((one - other).abs() < 1e-12, "{inertia:?}");
    }
    let ball = inspect(&generate::icosphere(1.0, 5), &Options::default());
    let inertia = ball.inertia.unwrap();
    // 2/5 m r²; the mesh is smaller by a few thousandths.
    assert!((inertia[0][0] / (0.4 * 4.0 / 3.0 * PI) - 1.0).abs() < 5e-3, "{inertia:?}");
}

#[test]
fn faults_are_counted() {
    let mut mesh = generate::cuboid(Vec3::ONE, [1, 1, 1]);
    mesh.triangles[0].swap(1, 2);
    (mesh.normals, mesh.uv_sets) = Default::default();
    let again = mesh.triangles[5];
    mesh.triangles.extend([again, [0, 0, 1]]);
    mesh.positions.push(Vec3::ONE * 9.0);
    let report = inspect(&mesh, &Options::default());
    assert_eq!((report.duplicate_triangles, report.collapsed_triangles, report.unused_positions), (1, 1, 1));
    assert_eq!((report.degenerate_triangles, report.non_manifold_edges), (1, 3));
    assert!(report.flipped_edges >= 1 && !report.closed);
    assert_eq!(report.most, [0.5; 3]);
    let broken = TriangleMesh::new(vec![Vec3::ZERO], vec![[0, 1, 2]]);
    let report = inspect(&broken, &Options::default());
    assert_eq!((report.problems.len(), report.closed), (1, false));
}

#[test]
fn border_loops_of_a_tube_and_a_sheet() {
    let tube = inspect(&generate::cylinder(1.0, 2.0, 12, 3, false), &Options::default());
    assert_eq!((tube.boundary_loops, tube.most_boundary_edges), (2, 12));
    let side = 2.0 * libm::sin(PI / 12.0);
    assert!((tube.longest_boundary - 12.0 * side).abs() < 1e-6);
    let sheet = inspect(&generate::plane(glam::Vec2::new(2.0, 3.0), [4, 2]), &Options::default());
    assert_eq!((sheet.boundary_loops, sheet.most_boundary_edges, sheet.longest_boundary), (1, 12, 10.0));
}

#[test]
fn touching_pieces_voids_and_pinches() {
    // Two tetrahedra that touch in a corner.
    let mut mesh = TriangleMesh::new(
        [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [-1, 0, 0], [0, -1, 0], [0, 0, -1]]
            .map(|[x, y, z]: [i32; 3]| Vec3::new(x as f32, y as f32, z as f32))
            .to_vec(),
        vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3], [0, 4, 5], [0, 5, 6], [0, 6, 4], [4, 6, 5]],
    );
    let report = inspect(&mesh, &with_everything());
    assert_eq!((report.components, report.non_manifold_positions, report.genus), (2, 1, Some(0)));
    assert_eq!(report.self_intersections.unwrap().triangles, 0);
    // A hollow ball: the inner skin looks inward.
    let inner = generate::sphere(0.5, 12, 6);
    let shift = mesh.positions.len() as u32;
    mesh.positions.extend(&inner.positions);
    mesh.triangles.extend(inner.triangles.iter().map(|[a, b, c]| [a + shift, c + shift, b + shift]));
    assert_eq!(inspect(&mesh, &Options::default()).inward_components, 1);
}

#[test]
fn crossing_faces_are_found_exactly() {
    let triangle = |a: [f32; 3], b: [f32; 3], c: [f32; 3]| [a, b, c].map(Vec3::from);
    let crossing = |other: [Vec3; 3]| {
        let base = triangle([0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]);
        let mesh = TriangleMesh::new([base, other].concat(), vec![[0, 1, 2], [3, 4, 5]]);
        inspect(&mesh, &with_everything()).self_intersections.unwrap().triangles
    };
    assert_eq!(crossing(triangle([1.0, 1.0, -1.0], [1.0, 1.0, 1.0], [9.0, 9.0, 1.0])), 2);
    assert_eq!(crossing(triangle([1.0, 1.0, 1.0], [2.0, 1.0, 1.0], [1.0, 2.0, 1.0])), 0);
    // In one plane: inside, crossing, apart.
    assert_eq!(crossing(triangle([1.0, 1.0, 0.0], [1.5, 1.0, 0.0], [1.0, 1.5, 0.0])), 2);
    assert_eq!(crossing(triangle([-1.0, 1.0, 0.0], [5.0, 1.0, 0.0], [5.0, 1.5, 0.0])), 2);
    assert_eq!(crossing(triangle([3.0, 3.0, 0.0], [4.0, 3.0, 0.0], [3.0, 4.0, 0.0])), 0);
    // By one unit in the last place above, and touching.
    assert_eq!(crossing(triangle([1.0, 1.0, f32::MIN_POSITIVE], [1.0, 1.0, 1.0], [9.0, 9.0, 1.0])), 0);
    assert_eq!(crossing(triangle([1.0, 1.0, 0.0], [1.0, 1.0, 1.0], [9.0, 9.0, 1.0])), 2);
    // Two balls that overlap cross in a ring of faces; a fold lies on its neighbour.
    let mut balls = generate::icosphere(1.0, 3);
    let mut second = balls.clone();
    second.positions.iter_mut().for_each(|p| *p += Vec3::new(1.0, 0.01, 0.02));
    balls.append(&second, 0);
    let found = inspect(&balls, &with_everything()).self_intersections.unwrap();
    assert!(found.triangles > 60 && found.triangles < 300 && found.first.len() == 16, "{found:?}");
    let fold = TriangleMesh::new(
        vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::new(0.2, 0.5, 0.0)],
        vec![[0, 1, 2], [1, 0, 3]],
    );
    assert_eq!(inspect(&fold, &with_everything()).self_intersections.unwrap().triangles, 2);
}

#[test]
fn coarser_values_keep_what_is_promised() {
    let report = inspect(&generate::sphere(1.0, 48, 24), &Options::default());
    let normals = &report.quantization.normals;
    // Cigolle et al. ("A survey of efficient representations for independent unit vectors", 2014) find 0.96° for 8 bits each.
    let eight = normals.iter().find(|p| p.bits == 8).unwrap().error.to_degrees();
    assert!(eight < 0.96 && eight > 0.2, "{eight}");
    assert!(normals.windows(2).all(|pair| pair[1].error < pair[0].error));
    let sixteen = report.quantization.positions.iter().find(|p| p.bits == 16).unwrap();
    assert!((sixteen.error - 12f64.sqrt() / 65535.0 / 2.0).abs() < 1e-12);
}

#[test]
fn the_same_report_on_one_thread_and_on_many() {
    let mesh = generate::sphere(1.0, 700, 800);
    let on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| inspect(&mesh, &Options::default()))
    };
    assert_eq!(on(1), on(3));
    assert_eq!((on(1).genus, on(1).edges * 2), (Some(0), 3 * mesh.triangles.len()));
}
