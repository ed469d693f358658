//! Places and directions of the sampling library.

use super::Routine;
use glam::{Vec2, Vec3};
use luch_sampling::check::Area;
use luch_sampling::warp::{self, Cone, SphericalRectangle, SphericalTriangle};

fn directions() -> Vec<Routine> {
    let about = |name: &str, draw: fn([f32; 2]) -> Vec3, pdf: fn(Vec3) -> f32| {
        Routine::directions(name, "", Vec3::Z, move |u| Some(draw([u[0], u[1]])), pdf)
    };
    let mut all = vec![
        about("whole-sphere", warp::sphere, |_| warp::sphere_pdf()),
        about("hemisphere", warp::hemisphere, warp::hemisphere_pdf),
        about("cosine-hemisphere", warp::cosine_hemisphere, warp::cosine_hemisphere_pdf),
    ];
    for half_angle in [2.5, 1.0, 0.05, 1e-3] {
        if let Some(cone) = Cone::from_half_angle(half_angle) {
            let parameters = format!("half-angle {half_angle}");
            let draw = move |u: [f32; 4]| Some(cone.sample([u[0], u[1]]));
            all.push(Routine::directions("cone", parameters, Vec3::Z, draw, move |d| cone.pdf(d)));
        }
    }
    all
}

fn flat() -> Vec<Routine> {
    let disc = Routine::places(
        "unit-disc",
        "",
        Area { low: [-1.0; 2], high: [1.0; 2] },
        ["x", "y"],
        |u| Some(warp::disc([u[0], u[1]]).to_array().map(f64::from)),
        |[x, y]| f64::from(warp::disc_pdf_area(Vec2::new(x as f32, y as f32))),
    );
    // Two of the weights are the coordinates of a triangle of area one half.
    let triangle = Routine::places(
        "flat-triangle",
        "",
        Area::UNIT_SQUARE,
        ["first weight", "second weight"],
        |u| {
            let weights = warp::triangle([u[0], u[1]]);
            Some([f64::from(weights.x), f64::from(weights.y)])
        },
        |[x, y]| if x + y <= 1.0 { f64::from(warp::triangle_pdf_area(0.5)) } else { 0.0 },
    );
    vec![disc, triangle]
}

/// Pairs of numbers of one density each.
fn lines() -> Vec<Routine> {
    let area = Area { low: [0.0, -3.0], high: [10.0, 5.0] };
    let line = Routine::places(
        "exponential-and-normal",
        "rate 2; mean 1, deviation 0.5",
        area,
        ["exponential", "normal"],
        |u| Some([warp::exponential(f64::from(u[0]), 2.0), warp::normal(f64::from(u[1]), 1.0, 0.5)]),
        |[x, y]| warp::exponential_pdf(x, 2.0) * warp::normal_pdf(y, 1.0, 0.5),
    );
    let tent = Routine::places(
        "tent",
        "radius 1; radius 1.5",
        Area { low: [-1.0, -1.5], high: [1.0, 1.5] },
        ["radius 1", "radius 1.5"],
        |u| Some([f64::from(warp::tent(u[0], 1.0)), f64::from(warp::tent(u[1], 1.5))]),
        |[x, y]| f64::from(warp::tent_pdf(x as f32, 1.0)) * f64::from(warp::tent_pdf(y as f32, 1.5)),
    );
    vec![line, tent]
}

/// Uniform by solid angle, a point of a surface has the density cos/distance² over the solid angle, per area.
fn density_on_surface(point: Vec3, normal_times_area: Vec3, solid_angle: f32) -> f64 {
    let distance2 = point.length_squared();
    f64::from(point.dot(normal_times_area).abs() / (distance2 * distance2.sqrt() * solid_angle))
}

fn spherical_rectangles() -> Vec<Routine> {
    [
        ("above the middle", [-0.5, -0.5, 1.0, 1.0, 1.0]),
        ("above a corner", [0.0, 0.0, 1.0, 2.0, -0.7]),
        ("aside", [1.0, -3.0, 2.0, 1.5, 1.0]),
        ("huge", [-3.0, -2.0, 6.0, 5.0, 0.6]),
        ("small and far", [0.5, 0.3, 0.02, 0.01, 5.0]),
    ]
    .into_iter()
    .filter_map(|(parameters, [x, y, width, height, distance])| {
        let (corner, edges) = (Vec3::new(x, y, distance), [Vec3::X * width, Vec3::Y * height]);
        let rectangle = SphericalRectangle::new(Vec3::ZERO, corner, edges[0], edges[1])?;
        Some(Routine::places(
            "spherical-rectangle",
            parameters,
            Area::UNIT_SQUARE,
            ["along the first edge", "along the second edge"],
            move |u| Some(rectangle.sample([u[0], u[1]]).position.map(f64::from)),
            move |[s, t]| {
                let at = corner + edges[0] * s as f32 + edges[1] * t as f32;
                density_on_surface(at, edges[0].cross(edges[1]), rectangle.solid_angle())
            },
        ))
    })
    .collect()
}

fn spherical_triangles() -> Vec<Routine> {
    [
        ("octant", [Vec3::X, Vec3::Y, Vec3::Z]),
        ("oblique", [Vec3::new(2.0, 0.3, 1.0), Vec3::new(-0.5, 1.5, 0.7), Vec3::new(0.1, -0.8, 3.0)]),
        ("thin", [Vec3::new(-2.0, 0.0, 1.0), Vec3::new(2.0, 0.1, 1.0), Vec3::new(2.0, 0.0, 1.0)]),
        (
            "nearly half of all",
            [Vec3::new(-2.0, -2.0, 0.5), Vec3::new(2.0, -1.5, 0.5), Vec3::new(0.0, 3.0, 0.5)],
        ),
        ("far", [Vec3::new(0.0, 1.0, 1e4), Vec3::new(1.0, 0.0, 1e4), Vec3::new(-1.0, -1.0, 1e4)]),
        ("tiny", [Vec3::new(0.0, 0.0, 1.0), Vec3::new(1e-6, 0.0, 1.0), Vec3::new(0.0, 1e-6, 1.0)]),
    ]
    .into_iter()
    .filter_map(|(parameters, corners)| {
        let triangle = SphericalTriangle::new(Vec3::ZERO, corners)?;
        let [a, b, c] = corners;
        Some(Routine::places(
            "spherical-triangle",
            parameters,
            Area::UNIT_SQUARE,
            ["second weight", "third weight"],
            move |u| {
                let weights = triangle.sample([u[0], u[1]]).barycentrics;
                Some([f64::from(weights.y), f64::from(weights.z)])
            },
            move |[s, t]| {
                if s + t > 1.0 {
                    return 0.0;
                }
                // A unit of the weights' plane is twice the triangle.
                let at = a + (b - a) * s as f32 + (c - a) * t as f32;
                density_on_surface(at, (b - a).cross(c - a), triangle.solid_angle())
            },
        ))
    })
    .collect()
}

pub(super) fn routines() -> Vec<Routine> {
    [directions(), flat(), lines(), spherical_rectangles(), spherical_triangles()]
        .into_iter()
        .flatten()
        .collect()
}
