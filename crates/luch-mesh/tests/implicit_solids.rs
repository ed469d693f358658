//! What solids promise.

use std::f64::consts::PI;

use glam::{DAffine3, DQuat, DVec3};
use luch_formula::Formula;
use luch_mesh::implicit::{
    Ball, Field, Method, PointList, Region, Sampling, Solid, SolidError, SolidField, surface,
};
use luch_mesh::{TriangleMesh, measure};

fn boxed(solid: Solid) -> Box<Solid> {
    Box::new(solid)
}

fn ball(radius: f64) -> Solid {
    Solid::Sphere { radius }
}

fn moved(solid: Solid, by: DVec3) -> Solid {
    Solid::Place { solid: boxed(solid), map: DAffine3::from_translation(by) }
}

fn tilted(solid: Solid) -> Solid {
    let turn = DQuat::from_euler(glam::EulerRot::XYZ, 0.4, 0.7, 0.2);
    Solid::Place {
        solid: boxed(solid),
        map: DAffine3::from_rotation_translation(turn, DVec3::new(0.1, 0.2, 0.05)),
    }
}

/// One of each kind.
fn examples() -> Vec<Solid> {
    let cube = || Solid::Cuboid { size: DVec3::new(1.0, 1.2, 0.8), rounding: 0.0 };
    let ring = || Solid::Torus { major_radius: 0.8, minor_radius: 0.25 };
    vec![
        ball(1.0),
        cube(),
        Solid::Cuboid { size: DVec3::new(1.0, 1.2, 0.8), rounding: 0.2 },
        Solid::Cylinder { radius: 0.6, height: 1.5 },
        Solid::Capsule { radius: 0.5, height: 1.0 },
        ring(),
        Solid::HalfSpace { normal: DVec3::new(1.0, 2.0, 3.0), distance: 0.3 },
        Solid::Gyroid { period: 1.1, thickness: 0.0 },
        Solid::Gyroid { period: 1.1, thickness: 0.2 },
        Solid::Metaballs {
            balls: vec![
                Ball { center: DVec3::ZERO, radius: 1.0 },
                Ball { center: DVec3::X * 0.7, radius: 0.8 },
            ],
        },
        Solid::Formula(Formula::new("x^4 + y^4 + z^4 = r^4").with("r", 0.9)),
        Solid::Union { parts: vec![cube(), ring()], blend: 0.0 },
        Solid::Union { parts: vec![cube(), ring(), moved(ball(0.4), DVec3::Y)], blend: 0.2 },
        Solid::Intersection { parts: vec![cube(), ball(0.7)], blend: 0.1 },
        Solid::Difference { from: boxed(cube()), parts: vec![ball(0.6)], blend: 0.0 },
        Solid::Offset { solid: boxed(cube()), distance: 0.1 },
        Solid::Shell { solid: boxed(ball(0.9)), thickness: 0.1 },
        tilted(cube()),
        Solid::Place { solid: boxed(ball(0.5)), map: DAffine3::from_scale(DVec3::new(1.0, 2.0, 0.5)) },
        Solid::Twist { solid: boxed(cube()), turn: 1.0 },
        Solid::Bend { solid: boxed(cube()), curvature: 0.5 },
        Solid::Repeat { solid: boxed(ball(0.3)), period: DVec3::new(0.9, 0.0, 0.8) },
        Solid::Mirror { solid: boxed(moved(ball(0.5), DVec3::X * 0.4)), normal: DVec3::X },
    ]
}

fn mesh(solid: &Solid, half_side: f64, resolution: u32, method: Method) -> TriangleMesh {
    let sampling = Sampling { region: Region::cube(half_side), resolution, closed: true };
    surface(&solid.field().unwrap(), &sampling, method).unwrap()
}

#[test]
fn every_kind_gives_closed_manifolds_by_both_methods() {
    for solid in examples() {
        for method in [Method::MarchingCubes, Method::DualContouring] {
            let mesh = mesh(&solid, 1.5, 24, method);
            let report = measure::closedness(&mesh);
            assert!(report.is_closed() && report.pinched == 0, "{solid:?} {method:?}: {report}");
            assert!(measure::volume(&mesh) > 0.0, "{solid:?}");
            assert_eq!(mesh.validate(), [], "{solid:?}");
        }
    }
}

/// Values lie in their intervals, and gradients are those of differences.
#[test]
fn intervals_hold_values_and_gradients_are_slopes() {
    for solid in examples() {
        let field = solid.field().unwrap();
        for n in 0..60 {
            let at = |k: f64| libm::sin(f64::from(n) * k) * 1.4;
            let middle = DVec3::new(at(1.1), at(2.3), at(3.7));
            let half = 0.02 * f64::from(n % 20);
            let region = Region { min: middle - half, max: middle + half };
            let list: PointList = (0..8)
                .map(|c| {
                    let side = |bit: u32| if c >> bit & 1 == 1 { half } else { -half };
                    middle + DVec3::new(side(0), side(1), side(2)) * 0.9
                })
                .collect();
            let mut values = [0.0; 8];
            field.values(list.points(), &mut values);
            let range = field.range(&region);
            assert!(values.iter().all(|v| range.low <= *v && *v <= range.high), "{solid:?} {region:?}");
            let mut gradients = [DVec3::ZERO; 8];
            field.gradients(list.points(), &mut gradients);
            let step = 1e-6;
            for (point, gradient) in list.points().iter().zip(gradients) {
                let value = |p: DVec3| field.tape().value(&p.to_array());
                for axis in 0..3 {
                    let mut along = DVec3::ZERO;
                    along[axis] = step;
                    let (back, here, ahead) = (value(point - along), value(point), value(point + along));
                    // Kinks within the step tell nothing.
                    if ((ahead - here) - (here - back)).abs() < 1e-9 {
                        let slope = (ahead - back) / (2.0 * step);
                        assert!(
                            (slope - gradient[axis]).abs() < 1e-3 * slope.abs().max(1.0),
                            "{solid:?} {point}"
                        );
                    }
                }
            }
        }
    }
}

/// The distance to a body is the distance of the nearest point of its mesh, as far as the mesh goes.
#[test]
fn distances_of_bodies_are_exact() {
    let bodies = [
        tilted(ball(0.7)),
        tilted(Solid::Cuboid { size: DVec3::new(1.0, 1.2, 0.8), rounding: 0.0 }),
        tilted(Solid::Cuboid { size: DVec3::new(1.0, 1.2, 0.8), rounding: 0.2 }),
        tilted(Solid::Cylinder { radius: 0.6, height: 1.1 }),
        tilted(Solid::Capsule { radius: 0.4, height: 0.8 }),
        tilted(Solid::Torus { major_radius: 0.6, minor_radius: 0.25 }),
    ];
    for solid in bodies {
        let mesh = mesh(&solid, 1.5, 90, Method::DualContouring);
        let field = solid.field().unwrap();
        for n in 0..40 {
            let at = |k: f64| libm::sin(f64::from(n) * k + 0.3) * 1.4;
            let point = DVec3::new(at(1.3), at(2.1), at(3.9));
            let nearest =
                mesh.positions.iter().map(|p| (p.as_dvec3() - point).length()).fold(f64::INFINITY, f64::min);
            let distance = field.tape().value(&point.to_array()).abs();
            // Vertices lie a cell of 1/30 apart: the nearest is hardly farther than the surface where that is far.
            let slack = (distance * distance + 0.03 * 0.03).sqrt() + 2e-3;
            assert!(nearest >= distance - 2e-3 && nearest <= slack, "{solid:?}: {nearest} {distance}");
        }
    }
}

#[test]
fn volumes_of_combinations_add_up() {
    let a = || Solid::Cuboid { size: DVec3::splat(1.3), rounding: 0.0 };
    let b = || moved(ball(0.8), DVec3::new(0.4, 0.3, 0.5));
    let volume = |solid: Solid, resolution| {
        measure::volume(&mesh(&tilted(solid), 1.8, resolution, Method::DualContouring))
    };
    let error = |resolution| {
        let union = volume(Solid::Union { parts: vec![a(), b()], blend: 0.0 }, resolution);
        let both = volume(Solid::Intersection { parts: vec![a(), b()], blend: 0.0 }, resolution);
        let rest = volume(Solid::Difference { from: boxed(a()), parts: vec![b()], blend: 0.0 }, resolution);
        let (one, other) = (volume(a(), resolution), volume(b(), resolution));
        assert!((one / (1.3 * 1.3 * 1.3) - 1.0).abs() < 1e-3);
        [(one + other - union - both).abs() / union, (one - both - rest).abs() / one]
    };
    let (coarse, fine) = (error(24), error(96));
    for (coarse, fine) in coarse.into_iter().zip(fine) {
        // Second order would be a sixteenth; where both cancel by chance little is left of either.
        assert!(fine < 2e-4 && fine < coarse.max(1e-4), "{coarse} {fine}");
    }
}

#[test]
fn solids_have_their_measures() {
    let close = |found: f64, truth: f64| assert!((found / truth - 1.0).abs() < 4e-3, "{found} {truth}");
    let volume = |solid: &Solid| measure::volume(&mesh(solid, 1.6, 80, Method::DualContouring));
    close(volume(&ball(1.0)), 4.0 / 3.0 * PI);
    close(volume(&Solid::Cylinder { radius: 0.6, height: 1.5 }), PI * 0.36 * 1.5);
    close(volume(&Solid::Torus { major_radius: 1.0, minor_radius: 0.4 }), 2.0 * PI * PI * 0.16);
    // Steiner: a box grown by a distance.
    let (size, d) = (DVec3::new(1.0, 1.2, 0.8), 0.2);
    let grown = Solid::Offset { solid: boxed(Solid::Cuboid { size, rounding: 0.0 }), distance: d };
    let area = 2.0 * (size.x * size.y + size.y * size.z + size.z * size.x);
    let steiner =
        size.element_product() + area * d + PI * size.element_sum() * d * d + 4.0 / 3.0 * PI * d * d * d;
    close(volume(&grown), steiner);
    // Twisting and bending about the own axis keep volumes; the second to the first order of the moment, which is none.
    let bar = || Solid::Cuboid { size: DVec3::new(1.6, 0.4, 0.4), rounding: 0.0 };
    close(volume(&Solid::Bend { solid: boxed(bar()), curvature: 0.8 }), 1.6 * 0.16);
    let upright = Solid::Cuboid { size: DVec3::new(0.4, 1.6, 0.4), rounding: 0.0 };
    close(volume(&Solid::Twist { solid: boxed(upright), turn: 1.5 }), 1.6 * 0.16);
    // A ball stretched is an ellipsoid.
    let stretched =
        Solid::Place { solid: boxed(ball(0.5)), map: DAffine3::from_scale(DVec3::new(1.0, 2.0, 3.0)) };
    close(volume(&stretched), 4.0 / 3.0 * PI * 0.125 * 6.0);
    // Three in a row.
    let row = Solid::Repeat { solid: boxed(ball(0.3)), period: DVec3::X };
    let cut = Solid::Intersection {
        parts: vec![row, Solid::Cuboid { size: DVec3::splat(2.8), rounding: 0.0 }],
        blend: 0.0,
    };
    // These balls are 7.5 cells in radius: of second order, (1 / 7.5)² = 1.8 % times about a quarter.
    let (found, truth) = (volume(&cut), 3.0 * 4.0 / 3.0 * PI * 0.027);
    assert!((found / truth - 1.0).abs() < 0.0178 / 2.0, "{found} {truth}");
}

#[test]
fn a_gyroid_wall_has_its_thickness() {
    // A gyroid of period 1 has an area of 3.0915 in a unit cube (Schoen, 1970). The part of space that a wall takes is less than that
    // times its thickness by the second order, 1 % here.
    let field = Solid::Gyroid { period: 1.0, thickness: 0.05 };
    let mesh = mesh(&field, 0.5, 80, Method::MarchingCubes);
    let part = measure::volume(&mesh) / 0.05;
    assert!((part / 3.0915 - 1.0).abs() < 0.02, "{part}");
    assert!(measure::closedness(&mesh).is_closed());
}

#[test]
fn numbers_that_make_no_sense_are_refused() {
    let refused = [
        ball(-1.0),
        ball(f64::NAN),
        Solid::Cuboid { size: DVec3::new(1.0, 0.0, 1.0), rounding: 0.0 },
        Solid::HalfSpace { normal: DVec3::ZERO, distance: 0.0 },
        Solid::Place { solid: boxed(ball(1.0)), map: DAffine3::from_scale(DVec3::new(1.0, 0.0, 1.0)) },
        Solid::Place { solid: boxed(ball(1.0)), map: DAffine3::from_translation(DVec3::NAN) },
        Solid::Union { parts: vec![ball(1.0)], blend: -1.0 },
        Solid::Formula(Formula::new("x +")),
        Solid::Formula(Formula::new("w")),
        Solid::Metaballs { balls: vec![Ball { center: DVec3::NAN, radius: 1.0 }] },
    ];
    for solid in refused {
        assert!(solid.field().is_err(), "{solid:?}");
    }
    let deep = (0..1000).fold(ball(1.0), |solid, _| Solid::Offset { solid: boxed(solid), distance: 0.0 });
    assert!(matches!(deep.expression(), Err(SolidError::TooDeep { .. })));
    let many: Vec<Solid> = (0..30_000).map(|n| moved(ball(1.0), DVec3::X * f64::from(n))).collect();
    assert!(matches!(Solid::Union { parts: many, blend: 0.0 }.field(), Err(SolidError::TooLong { .. })));
    // Nothing is in no part, everything in all of none.
    let value = |solid: Solid| solid.field().map(|field: SolidField| field.tape().value(&[0.0; 3])).unwrap();
    assert_eq!(value(Solid::Union { parts: vec![], blend: 0.1 }), f64::INFINITY);
    assert_eq!(value(Solid::Intersection { parts: vec![], blend: 0.0 }), f64::NEG_INFINITY);
}
