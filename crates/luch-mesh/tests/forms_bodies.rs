//! Bodies of outlines against closed forms.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3};
use luch_mesh::outline::{
    Extrusion, Lathe, Loft, Outline, OutlineError, Stand, Sweep, bezier_chain, flat, nested, notation, shapes,
};
use luch_mesh::{PolygonMesh, TriangleMesh, measure};
use proptest::prelude::*;

fn outlines(text: &str) -> Vec<Outline> {
    notation::outlines(text, 0.001).unwrap_or_else(|error| panic!("{text}: {error}"))
}

fn closed(mesh: &PolygonMesh, context: &str) -> TriangleMesh {
    let triangles = mesh.triangulate();
    assert_eq!(triangles.validate(), [], "{context}");
    let report = measure::closedness(&triangles);
    assert!(report.is_closed(), "{context}: {report}");
    triangles
}

/// Positions are rounded to single precision, and volumes are sums over all of them.
fn close(found: f64, truth: f64, context: &str) {
    assert!((found / truth - 1.0).abs() < 1e-5, "{context}: {found} is not {truth}");
}

const FORMS: [&str; 7] = [
    "rectangle 2 1",
    "circle 1 24; circle 0.5 12",
    "rectangle 4 4; rectangle 2 2; rectangle 1 1; circle 0.2 5 at 1.5 1.5",
    "star 7 1 0.3",
    "gear 12 0.1",
    "rounded-rectangle 3 2 0.5 6; circle 0.25 9 at -0.75 0; circle 0.25 9 at 0.75 0",
    "M0 0 L4 0 L4 3 L3 3 L3 1 L1 1 L1 3 L0 3 Z",
];

#[test]
fn prisms_over_outlines() {
    for text in FORMS {
        let outlines = outlines(text);
        let area: f64 = outlines.iter().map(Outline::area).sum();
        let perimeter: f64 = outlines.iter().map(Outline::perimeter).sum();
        for stand in [Stand::Lying, Stand::Upright] {
            let mesh =
                Extrusion { height: 0.75, layers: 2, stand, ..Extrusion::default() }.of(&outlines).unwrap();
            let triangles = closed(&mesh, text);
            close(measure::volume(&triangles), area * 0.75, text);
            close(measure::area(&triangles), 2.0 * area + perimeter * 0.75, text);
            let report = measure::closedness(&triangles);
            let holes = outlines.iter().map(|o| o.holes.len()).sum::<usize>();
            assert_eq!((report.components, report.genus), (outlines.len(), Some(holes as u64)), "{text}");
            // The ends are one face each, with holes.
            let ends = mesh.face_count() - 2 * outlines.iter().map(Outline::point_count).sum::<usize>();
            assert_eq!((ends, mesh.holes.len()), (2 * outlines.len(), 2 * holes), "{text}");
        }
        let face = flat(&outlines, Stand::Lying).unwrap().triangulate();
        close(measure::area(&face), area, text);
        assert!((0..face.triangles.len()).all(|t| face.area_normal(t).y > 0.0), "{text}");
    }
}

#[test]
fn narrowing_twisting_and_bevelled_ends() {
    for text in FORMS {
        let outlines = outlines(text);
        let area: f64 = outlines.iter().map(Outline::area).sum();
        let narrow =
            Extrusion { height: 2.0, top_scale: 0.25, ..Extrusion::default() }.of(&outlines).unwrap();
        close(measure::volume(&closed(&narrow, text)), area * 2.0 * (1.0 + 0.25 + 0.0625) / 3.0, text);
        // A twist keeps every section. The skewed quads are cut into triangles, all along the same diagonal, which
        // takes off as much as a layer is turned.
        let twisted = |layers| {
            let body = Extrusion { height: 2.0, twist: 1.0, layers, ..Extrusion::default() };
            (measure::volume(&closed(&body.of(&outlines).unwrap(), text)) - area * 2.0).abs()
        };
        assert!(twisted(256) < 0.005 * area * 2.0, "{text}: {}", twisted(256));
        if text == "rectangle 2 1" {
            let ratio = twisted(8) / twisted(16);
            assert!((1.8..2.2).contains(&ratio), "{text}: {ratio}");
        }
    }
    let (a, b, c, h) = (3.0, 2.0, 0.25, 1.0);
    let mesh =
        Extrusion { height: h, bevel: c, ..Extrusion::default() }.of(&outlines("rectangle 3 2")).unwrap();
    let ends = 2.0 * (a * b * c - (a + b) * c * c + 4.0 / 3.0 * c * c * c);
    close(measure::volume(&closed(&mesh, "bevel")), a * b * (h - 2.0 * c) + ends, "bevel");
    // Holes grow where the body shrinks: a frame 1 wide in all, with bevels of ¼.
    let frame = outlines("rectangle 4 4; rectangle 2 2");
    let mesh = Extrusion { height: h, bevel: c, ..Extrusion::default() }.of(&frame).unwrap();
    let section = h - 2.0 * c * c;
    close(measure::volume(&closed(&mesh, "frame")), section * 12.0, "frame");
    // Borders that meet, and those that have passed one another: a frame is gone, a corner is, a bridge is.
    for text in [
        "rectangle 4 4; rectangle 2 2",
        "points 0 0 9 0 0 1",
        "rectangle 4 4; circle 0.9 8 at 1 0; circle 0.9 8 at -1 0",
    ] {
        for bevel in [0.51, 0.6, 0.9] {
            let wide = Extrusion { height: 2.0, bevel, ..Extrusion::default() }.of(&outlines(text)).err();
            assert!(
                matches!(wide, Some(OutlineError::OutOfRange { name: "the bevel", .. })),
                "{text}: {wide:?}"
            );
        }
    }
}

/// Pappus: the volume is the area times the way of its centre. Around the axis circles are polygons, which take
/// sin δ / δ of the area of the circle's sectors for pieces of δ.
#[test]
fn bodies_of_revolution() {
    let profiles = [
        "circle 0.5 16 at 2 0",
        "points 0 0 1 0 0.5 1 0 1",
        "rectangle 2 4 at 3 0; circle 0.5 8 at 3 1",
        "points 0 -1 2 0 0 1",
        "points 1 0 2 0 1 1; points 1 3 2 3 1.5 4",
    ];
    for text in profiles {
        let outlines = outlines(text);
        let moment: f64 = outlines.iter().map(|o| o.area() * o.centroid().unwrap().x).sum();
        for (angle, segments) in [(TAU, 24), (TAU, 3), (1.0, 4), (4.5, 30), (TAU + 1.0, 12)] {
            let lathe = Lathe { angle, segments, ..Lathe::default() };
            let mesh = lathe.of(&outlines).unwrap();
            let context = format!("{text} by {angle} in {segments}");
            let turned = angle.min(TAU);
            let step = turned / f64::from(segments);
            close(
                measure::volume(&closed(&mesh, &context)),
                moment * f64::from(segments) * libm::sin(step),
                &context,
            );
        }
    }
    // The area is the length times the way of its centre.
    let ring = outlines("circle 0.5 64 at 2 0");
    let error = |segments| {
        let mesh = Lathe { segments, ..Lathe::default() }.of(&ring).unwrap().triangulate();
        (measure::area(&mesh) - ring[0].perimeter() * TAU * 2.0).abs()
    };
    let ratio = error(32) / error(64);
    assert!((3.8..4.2).contains(&ratio), "{ratio}");
}

#[test]
fn lines_turn_into_surfaces() {
    // From pole to pole it is closed, whichever way the line runs.
    for text in ["points 0 -1 1 0 0 1", "points 0 1 1 0 0 -1"] {
        let line = notation::line(text, 0.01).unwrap();
        let mesh = Lathe { segments: 4, ..Lathe::default() }.of_line(&line).unwrap();
        close(measure::volume(&closed(&mesh, text)), 4.0 / 3.0, text);
    }
    // A line that comes back is a ring.
    let ring = [(1.0, 0.0), (2.0, 0.0), (2.0, 1.0), (1.0, 1.0), (1.0, 0.0)].map(DVec2::from);
    let mesh = Lathe { segments: 4, ..Lathe::default() }.of_line(&ring).unwrap();
    let report = measure::closedness(&closed(&mesh, "ring"));
    assert_eq!(report.genus, Some(1));
    // A vase: open above, smooth around, hard at its foot.
    let vase = [(0.0, 0.0), (1.0, 0.0), (1.0, 2.0)].map(DVec2::from);
    let vase = Lathe { segments: 32, ..Lathe::default() }.of_line(&vase).unwrap();
    let triangles = vase.triangulate();
    assert_eq!(measure::closedness(&triangles).euler_characteristic, 1);
    for t in 0..triangles.triangles.len() {
        for (corner, normal) in triangles.corners(t).iter().zip(triangles.corner_normals(t).unwrap()) {
            let is_foot = triangles.corners(t).iter().all(|p| p.y == 0.0);
            let truth = if is_foot { -glam::Vec3::Y } else { glam::Vec3::new(corner.x, 0.0, corner.z) };
            assert!((normal - truth).length() < 1e-5, "{normal} is not {truth}");
        }
    }
}

/// A section whose centre is on the path keeps its volume through every mitre.
#[test]
fn mitred_tubes_hold_area_times_length() {
    let paths: [(&[[f64; 3]], bool); 4] = [
        (&[[0.0, 0.0, 0.0], [3.0, 0.0, 0.0]], false),
        (&[[0.0, 0.0, 0.0], [3.0, 0.0, 0.0], [3.0, 3.0, 0.0], [3.0, 3.0, 4.0], [6.0, 5.0, 5.0]], false),
        (&[[0.0, 0.0, 0.0], [0.0, 5.0, 0.0], [0.0, 9.0, 3.0]], false),
        (&[[-2.0, 0.0, -2.0], [-2.0, 0.0, 2.0], [2.0, 0.0, 2.0], [2.0, 0.0, -2.0]], true),
    ];
    for text in ["circle 0.25 12", "rectangle 0.5 0.25", "rectangle 0.5 0.5; rectangle 0.25 0.25"] {
        let outlines = outlines(text);
        let area: f64 = outlines.iter().map(Outline::area).sum();
        for (points, is_closed) in paths {
            let path: Vec<DVec3> = points.iter().map(|p| DVec3::from(*p)).collect();
            let ring = is_closed.then(|| path[0]);
            let all: Vec<DVec3> = path.iter().copied().chain(ring).collect();
            let length: f64 = all.windows(2).map(|p| p[0].distance(p[1])).sum();
            let mesh = Sweep { is_closed, ..Sweep::default() }.of(&outlines, &path).unwrap();
            let triangles = closed(&mesh, text);
            close(measure::volume(&triangles), area * length, text);
            let genus = measure::closedness(&triangles).genus;
            let holes = outlines[0].holes.len() as u64;
            assert_eq!(genus, if is_closed { Some(1 + holes) } else { Some(holes) }, "{text}");
        }
    }
}

#[test]
fn tubes_along_curves_approach_area_times_length() {
    // A curve in space that comes back to itself: its frames must be turned to meet.
    let closed_path = |count: u32| -> Vec<DVec3> {
        let angle = |k: u32| f64::from(k) / f64::from(count) * TAU;
        (0..count)
            .map(|k| {
                let t = angle(k);
                DVec3::new(3.0 * libm::cos(t), libm::sin(2.0 * t), 3.0 * libm::sin(t))
            })
            .collect()
    };
    let length = |path: &[DVec3]| -> f64 {
        (0..path.len()).map(|k| path[k].distance(path[(k + 1) % path.len()])).sum()
    };
    let exact = length(&closed_path(1 << 16));
    let section = outlines("rectangle 0.5 0.25");
    for is_mitred in [true, false] {
        for twist in [0.0, TAU] {
            let error = |count| {
                let sweep = Sweep { is_closed: true, is_mitred, twist, ..Sweep::default() };
                let mesh = sweep.of(&section, &closed_path(count)).unwrap();
                let triangles = closed(&mesh, "closed path");
                assert_eq!(measure::closedness(&triangles).genus, Some(1));
                (measure::volume(&triangles) / (0.125 * exact) - 1.0).abs()
            };
            let (coarse, fine) = (error(64), error(128));
            // Skewed quads are cut along one diagonal: only without a twist are they flat enough for the square.
            let order = if twist == 0.0 { 3.5..4.5 } else { 1.7..4.5 };
            assert!(
                coarse < 0.05 && order.contains(&(coarse / fine)),
                "{is_mitred} {twist}: {coarse} {fine}"
            );
        }
    }
    let half_turn = Sweep { is_closed: true, twist: PI, ..Sweep::default() };
    assert!(half_turn.of(&section, &closed_path(16)).is_err());
}

#[test]
fn a_sweep_narrows_and_starts_upright() {
    let path = [DVec3::ZERO, DVec3::X * 2.0];
    let mesh = Sweep { end_scale: 0.5, ..Sweep::default() }.of(&outlines("rectangle 2 1"), &path).unwrap();
    close(measure::volume(&closed(&mesh, "cone")), 2.0 * 2.0 * (1.0 + 0.5 + 0.25) / 3.0, "cone");
    // The outline's y stays up on a level path: 1 high, 2 wide.
    let bounds = measure::bounds(&mesh.triangulate());
    assert_eq!((bounds.max - bounds.min).to_array(), [2.0, 1.0, 2.0]);
    // Upward it lies as an extrusion does.
    let up = Sweep::default().of(&outlines("gear 9 0.1"), &[DVec3::NEG_Y * 0.5, DVec3::Y * 0.5]).unwrap();
    let body = Extrusion::default().of(&outlines("gear 9 0.1")).unwrap();
    assert_eq!(up.positions, body.positions);
}

#[test]
fn curves_in_space_become_chords() {
    // A quarter of a circle nearly: chords stay within the tolerance of it.
    let k = 4.0 / 3.0 * (2f64.sqrt() - 1.0);
    let controls = [[1.0, 0.0, 0.0], [1.0, k, 0.0], [k, 1.0, 0.0], [0.0, 1.0, 0.0]].map(DVec3::from);
    let points = bezier_chain(&controls, 1e-4);
    assert!(points.len() > 10 && points[0] == controls[0] && points[points.len() - 1] == controls[3]);
    for pair in points.windows(2) {
        let middle = (pair[0] + pair[1]) / 2.0;
        // The curve itself is within 2.8e-4 of the circle.
        assert!((middle.length() - 1.0).abs() < 1e-4 + 2.8e-4, "{middle}");
    }
    assert_eq!(bezier_chain(&controls[..3], 0.1), [controls[0]]);
}

#[test]
fn lofts() {
    let (wide, narrow) = (outlines("circle 2 32"), outlines("circle 1 32"));
    let mesh = Loft { height: 3.0, ..Loft::default() }.between(&wide[0], &narrow[0]).unwrap();
    close(measure::volume(&closed(&mesh, "loft")), wide[0].area() * 3.0 * (1.0 + 0.5 + 0.25) / 3.0, "loft");
    let other = Loft::default().between(&wide[0], &outlines("circle 1 31")[0]);
    assert_eq!(other, Err(OutlineError::Unequal { border: 0, first: 32, second: 31 }));
}

#[test]
fn smooth_walls_and_hard_rims() {
    let mesh = Extrusion::default().of(&outlines("circle 1 32")).unwrap().triangulate();
    for t in 0..mesh.triangles.len() {
        let facet = mesh.area_normal(t).normalize();
        for (corner, normal) in mesh.corners(t).iter().zip(mesh.corner_normals(t).unwrap()) {
            let truth = if facet.y.abs() > 0.5 { facet } else { glam::Vec3::new(corner.x, 0.0, corner.z) };
            assert!((normal - truth).length() < 1e-5, "{normal} is not {truth}");
        }
    }
}

#[test]
fn what_cannot_be_made_is_refused() {
    let square = Outline { outer: shapes::rectangle(DVec2::ONE), holes: Vec::new() };
    let with = |point| Outline { outer: vec![DVec2::ZERO, DVec2::X, point], holes: Vec::new() };
    let all = |outline: &Outline| {
        let outlines = std::slice::from_ref(outline);
        let path = [DVec3::ZERO, DVec3::X];
        [
            Extrusion::default().of(outlines).err(),
            Lathe::default().of(outlines).err(),
            Sweep::default().of(outlines, &path).err(),
            Loft::default().between(outline, outline).err(),
            flat(outlines, Stand::Lying).err(),
        ]
    };
    for bad in [DVec2::NAN, DVec2::INFINITY, DVec2::splat(1e300)] {
        let errors = all(&with(bad));
        assert!(errors.iter().all(|e| matches!(e, Some(OutlineError::NotFinite { .. }))), "{errors:?}");
    }
    let short = Outline { outer: vec![DVec2::ZERO, DVec2::X], holes: Vec::new() };
    assert!(all(&short).iter().all(|e| *e == Some(OutlineError::TooFewPoints { count: 2 })));
    let many = Outline { outer: vec![DVec2::ZERO; (1 << 14) + 1], holes: Vec::new() };
    assert!(all(&many).iter().all(|e| matches!(e, Some(OutlineError::TooManyPoints { .. }))));
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e300] {
        let slice = std::slice::from_ref(&square);
        assert!(Extrusion { height: bad, ..Extrusion::default() }.of(slice).is_err());
        assert!(Extrusion { top_scale: bad, ..Extrusion::default() }.of(slice).is_err());
        assert!(Lathe { angle: bad, ..Lathe::default() }.of(slice).is_err());
        assert!(Sweep { end_scale: bad, ..Sweep::default() }.of(slice, &[DVec3::ZERO, DVec3::X]).is_err());
        assert!(
            Extrusion { bevel: if bad == 0.0 { 0.5 } else { bad }, ..Extrusion::default() }
                .of(slice)
                .is_err()
        );
    }
    // The square reaches behind the axis.
    let behind = Lathe::default().of(std::slice::from_ref(&square));
    assert!(matches!(behind, Err(OutlineError::BehindAxis { .. })));
    let sweep = |path: &[DVec3], is_closed| {
        Sweep { is_closed, ..Sweep::default() }.of(std::slice::from_ref(&square), path).err()
    };
    assert_eq!(sweep(&[DVec3::X; 5], false), Some(OutlineError::ShortPath { count: 1, least: 2 }));
    assert_eq!(sweep(&[DVec3::X, DVec3::Y], true), Some(OutlineError::ShortPath { count: 2, least: 3 }));
    let back = sweep(&[DVec3::ZERO, DVec3::X, DVec3::ZERO], false);
    assert_eq!(back, Some(OutlineError::TurnsBack { place: DVec3::X }));
    let large = Extrusion { layers: u32::MAX, ..Extrusion::default() };
    let ring = Outline { outer: shapes::polygon(4096, 1.0), holes: Vec::new() };
    assert!(matches!(large.of(&[ring]), Err(OutlineError::TooManyFaces { .. })));
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, ..ProptestConfig::default() })]

    /// Rough stars, one within another, always make closed bodies of the right volume.
    #[test]
    fn random_outlines_make_closed_bodies(
        radii in prop::collection::vec(0.2f64..1.0, 3..60),
        inner in prop::collection::vec(0.2f64..1.0, 3..20),
        bend in -3.0f64..3.0,
    ) {
        let border = |radii: &[f64], scale: f64| -> Vec<DVec2> {
            let turns = shapes::polygon(radii.len() as u32, scale);
            turns.iter().zip(radii).map(|(p, r)| *p * *r).collect()
        };
        // The hole reaches at most to half the inscribed circle of three corners at 0.2.
        let borders = [border(&radii, 10.0), border(&inner, 0.4)];
        let outlines = nested(&borders, Default::default()).unwrap();
        let area: f64 = outlines.iter().map(Outline::area).sum();
        let context = format!("{borders:?}");
        let body = Extrusion::default().of(&outlines).unwrap();
        close(measure::volume(&closed(&body, &context)), area, &context);
        let twisted = Extrusion { twist: bend, layers: 3, ..Extrusion::default() }.of(&outlines).unwrap();
        closed(&twisted, &context);
        let path = [DVec3::ZERO, DVec3::new(20.0, 0.0, 0.0), DVec3::new(40.0, bend * 5.0, bend)];
        closed(&Sweep::default().of(&outlines, &path).unwrap(), &context);
        let moved: Vec<Vec<DVec2>> =
            borders.iter().map(|b| b.iter().map(|p| *p + DVec2::X * 10.0).collect()).collect();
        let turned = Lathe { segments: 5, angle: bend.abs() + 0.1, ..Lathe::default() };
        closed(&turned.of(&nested(&moved, Default::default()).unwrap()).unwrap(), &context);
    }
}
