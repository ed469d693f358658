//! Every warp draws what its density says; areas and solid angles are the known ones.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::Vec3;
use luch_sampling::check::{
    DensityFit, directions_match_pdf, kolmogorov_smirnov, sidak, square_matches_pdf, uniformity,
};
use luch_sampling::warp::{self, Cone, SphericalRectangle, SphericalTriangle};
use luch_sampling::{Domain, Estimate, Frame, Sampler, Sequence};

const COUNT: u64 = 1 << 19;

/// Judged with forty tests in mind.
fn assert_fits(name: &str, fit: &DensityFit, integral_tolerance: f64) {
    assert!(fit.chi_square.p_value > sidak(0.01, 40), "{name}: {fit:?}");
    assert!((fit.integral - 1.0).abs() < integral_tolerance, "{name}: {fit:?}");
    assert_eq!(fit.drawn, COUNT, "{name}");
}

/// Even points, for moments: 2¹⁴ of them for each of 32 randomisations; the estimate is over the randomisations.
fn mean_of(f: impl Fn([f32; 2]) -> f64) -> Estimate {
    (0..32)
        .map(|pixel| {
            let sum: f64 = (0..1 << 14)
                .map(|index| Sampler::at(Sequence::Sobol, 8, [pixel, 0], 2 * index).group(Domain::new(0, 0)))
                .map(|u| f([u[0], u[1]]))
                .sum();
            sum / f64::from(1 << 14)
        })
        .collect()
}

fn assert_mean(name: &str, truth: f64, f: impl Fn([f32; 2]) -> f64) {
    let estimate = mean_of(f);
    let distance = estimate.mean().unwrap() - truth;
    // Numbers cut to 24 bits and results rounded to single precision move a mean by less than 2⁻²².
    let limit = 4.0 * estimate.standard_error().unwrap() + 1.0 / 4_194_304.0;
    assert!(distance.abs() < limit, "{name}: {distance} from {truth}, allowed {limit}");
}

#[test]
fn directions_fit_their_densities() {
    let cone = Cone::from_half_angle(1.01).unwrap();
    let fits = [
        (
            "sphere",
            directions_match_pdf(COUNT, 1, |u| Some(warp::sphere([u[0], u[1]])), |_| warp::sphere_pdf()),
        ),
        ("cone", directions_match_pdf(COUNT, 4, |u| Some(cone.sample([u[0], u[1]])), |d| cone.pdf(d))),
        (
            "cosine hemisphere",
            directions_match_pdf(
                COUNT,
                3,
                |u| Some(warp::cosine_hemisphere([u[0], u[1]])),
                warp::cosine_hemisphere_pdf,
            ),
        ),
        (
            "hemisphere",
            directions_match_pdf(COUNT, 2, |u| Some(warp::hemisphere([u[0], u[1]])), warp::hemisphere_pdf),
        ),
    ];
    for (name, fit) in &fits {
        assert_fits(name, fit, 1e-4);
    }
}

#[test]
fn turned_directions_fit_too() {
    let frame = Frame::from_normal(Vec3::new(2.0, -1.0, 0.5).normalize());
    let fit = directions_match_pdf(
        COUNT,
        5,
        |u| Some(frame.to_world(warp::cosine_hemisphere([u[0], u[1]]))),
        |direction| warp::cosine_hemisphere_pdf(frame.to_local(direction)),
    );
    assert_fits("turned cosine", &fit, 1e-4);
}

/// A wrong density must be found: the checks above can fail.
#[test]
fn a_wrong_density_is_found() {
    let fit = directions_match_pdf(
        COUNT,
        3,
        |u| Some(warp::hemisphere([u[0], u[1]])),
        |direction| 0.9 * warp::hemisphere_pdf(direction) + 0.1 * warp::cosine_hemisphere_pdf(direction),
    );
    assert!(fit.chi_square.p_value < 1e-6, "{fit:?}");
}

#[test]
fn flat_targets_are_uniform() {
    // Area coordinates of the disc and of the triangle are the unit square again.
    let disc = square_matches_pdf(
        COUNT,
        6,
        |u| {
            let point = warp::disc([u[0], u[1]]);
            assert_eq!(warp::disc_pdf_area(point), std::f32::consts::FRAC_1_PI);
            let turn = libm::atan2f(point.y, point.x) / std::f32::consts::TAU;
            Some([point.length_squared().min(1.0), if turn < 0.0 { turn + 1.0 } else { turn }])
        },
        |_| 1.0,
    );
    assert_fits("disc", &disc, 1e-9);
    let triangle = square_matches_pdf(
        COUNT,
        7,
        |u| {
            let weights = warp::triangle([u[0], u[1]]);
            assert!(weights.min_element() >= 0.0 && (weights.element_sum() - 1.0).abs() < 1e-6);
            let side = 1.0 - weights.x;
            Some([side * side, if side > 0.0 { weights.y / side } else { 0.0 }])
        },
        |_| 1.0,
    );
    assert_fits("triangle", &triangle, 1e-9);
}

#[test]
fn moments_are_the_known_ones() {
    assert_mean("disc x²", 0.25, |u| square(warp::disc(u).x));
    assert_mean("disc r⁴", 1.0 / 3.0, |u| square(warp::disc(u).length_squared()));
    assert_mean("hemisphere z", 0.5, |u| f64::from(warp::hemisphere(u).z));
    assert_mean("hemisphere x²", 1.0 / 3.0, |u| square(warp::hemisphere(u).x));
    assert_mean("cosine z", 2.0 / 3.0, |u| f64::from(warp::cosine_hemisphere(u).z));
    assert_mean("cosine y²", 0.25, |u| square(warp::cosine_hemisphere(u).y));
    assert_mean("sphere z²", 1.0 / 3.0, |u| square(warp::sphere(u).z));
    assert_mean("sphere x²", 1.0 / 3.0, |u| square(warp::sphere(u).x));
    let cone = Cone::from_sin_squared(0.75).unwrap();
    assert_mean("cone z", 0.75, |u| f64::from(cone.sample(u).z));
    for corner in 0..3 {
        assert_mean("triangle weight", 1.0 / 3.0, |u| f64::from(warp::triangle(u)[corner]));
        assert_mean("triangle weight²", 1.0 / 6.0, |u| square(warp::triangle(u)[corner]));
    }
    assert_mean("triangle product", 1.0 / 12.0, |u| {
        let weights = warp::triangle(u);
        f64::from(weights.x) * f64::from(weights.z)
    });
    assert_mean("tent²", 4.0 / 6.0, |u| square(warp::tent(u[0], 2.0)));
}

fn square(x: impl Into<f64>) -> f64 {
    let x = x.into();
    x * x
}

#[test]
fn lengths_and_corners() {
    let ends = [0.0, 0.25, 0.5, 1.0 - f32::EPSILON / 2.0];
    let tiny = Cone::from_sin_squared(1e-20).unwrap();
    for u in ends.iter().flat_map(|&a| ends.map(|b| [a, b])) {
        for direction in [warp::sphere(u), warp::hemisphere(u), warp::cosine_hemisphere(u), tiny.sample(u)] {
            assert!((direction.length() - 1.0).abs() < 1e-6, "{u:?} {direction}");
        }
        assert!(warp::cosine_hemisphere(u).z > 0.0);
        assert!(warp::hemisphere(u).z >= 0.0);
        assert!(warp::disc(u).length() < 1.0 + 1e-6);
        assert!(tiny.pdf(tiny.sample(u)) > 0.0, "{u:?}");
    }
    assert_eq!(tiny.pdf(Vec3::X), 0.0);
    assert!((f64::from(tiny.solid_angle()) / (PI * 1e-20) - 1.0).abs() < 1e-6);
    for bad in [0.0, -1.0, 4.0, f32::NAN] {
        assert_eq!(Cone::from_half_angle(bad), None);
        assert_eq!(Cone::from_sin_squared(bad), None);
    }
}

#[test]
fn lines_fit_their_distribution_functions() {
    let u: Vec<f64> = (0..20_000)
        .map(|index| Sampler::at(Sequence::Independent, 6, [0, 0], index).group(Domain::new(0, 0)))
        .map(|u| f64::from(u[0]))
        .collect();
    let level = sidak(0.01, 4);
    let draw = |f: &dyn Fn(f64) -> f64| u.iter().map(|&u| f(u)).collect::<Vec<f64>>();
    assert!(uniformity(&u).p_value > level);
    let exponential = draw(&|u| warp::exponential(u, 2.0));
    assert!(kolmogorov_smirnov(&exponential, |x| 1.0 - libm::exp(-2.0 * x)).p_value > level);
    let normal = draw(&|u| warp::normal(u, 1.0, 0.5));
    assert!(kolmogorov_smirnov(&normal, |x| warp::normal_cumulative((x - 1.0) / 0.5)).p_value > level);
    let tent = draw(&|u| f64::from(warp::tent(u as f32, 1.0)));
    let cumulative = |x: f64| if x < 0.0 { 0.5 * square(1.0 + x) } else { 1.0 - 0.5 * square(1.0 - x) };
    assert!(kolmogorov_smirnov(&tent, cumulative).p_value > level);
    // Densities integrate to one: the midpoint rule over [−9, 11] with 2·10⁵ steps.
    let integral = |pdf: &dyn Fn(f64) -> f64| {
        (0..200_000).map(|i| pdf(-9.0 + (f64::from(i) + 0.5) * 1e-4)).sum::<f64>() * 1e-4
    };
    assert!((integral(&|x| warp::exponential_pdf(x, 2.0)) - 1.0).abs() < 1e-8);
    assert!((integral(&|x| warp::normal_pdf(x, 1.0, 0.5)) - 1.0).abs() < 1e-12);
    assert!((integral(&|x| f64::from(warp::tent_pdf(x as f32, 1.5))) - 1.0).abs() < 1e-5);
}

#[test]
fn solid_angles_are_the_known_ones() {
    let close = |name: &str, value: f32, truth: f64| {
        assert!((f64::from(value) / truth - 1.0).abs() < 1e-6, "{name}: {value}, expected {truth}");
    };
    let rectangle = |x: f32, y: f32, w: f32, h: f32, z: f32| {
        SphericalRectangle::new(Vec3::ZERO, Vec3::new(x, y, z), Vec3::X * w, Vec3::Y * h)
            .unwrap()
            .solid_angle()
    };
    close("unit square at height one", rectangle(-0.5, -0.5, 1.0, 1.0, 1.0), 0.805_431_683_161_323_3);
    close("face of a cube", rectangle(-1.0, -1.0, 2.0, 2.0, -1.0), 4.0 * PI / 6.0);
    let corner = |a: f64, b: f64, c: f64| libm::atan(a * b / (c * (a * a + b * b + c * c).sqrt()));
    close("over a corner", rectangle(0.0, 0.0, 3.0, 2.0, 1.5), corner(3.0, 2.0, 1.5));
    close("off to a side", rectangle(1.0, 0.0, 2.0, 2.0, 1.5), corner(3.0, 2.0, 1.5) - corner(1.0, 2.0, 1.5));

    let triangle = |corners| SphericalTriangle::new(Vec3::ZERO, corners).unwrap().solid_angle();
    close("octant", triangle([Vec3::X, Vec3::Y, Vec3::Z]), FRAC_PI_2);
    close("octant, other way round", triangle([Vec3::Y, Vec3::X, Vec3::Z]), FRAC_PI_2);
    let [a, b, c, d] = [
        Vec3::new(1.0, 1.0, 1.0),
        Vec3::new(1.0, -1.0, -1.0),
        Vec3::new(-1.0, 1.0, -1.0),
        Vec3::new(-1.0, -1.0, 1.0),
    ];
    for face in [[a, b, c], [a, b, d], [a, c, d], [b, c, d]] {
        close("face of a tetrahedron", triangle(face), PI);
    }
    // Small: area times cosine over distance squared, here 1e-16/2 at distance 1.
    let tiny = [Vec3::new(0.0, 0.0, 1.0), Vec3::new(1e-8, 0.0, 1.0), Vec3::new(0.0, 1e-8, 1.0)];
    close("tiny", triangle(tiny), 0.5e-16);
}

fn degenerate_triangles() -> Vec<[Vec3; 3]> {
    vec![
        [Vec3::X, Vec3::X, Vec3::Y],
        [Vec3::ZERO, Vec3::X, Vec3::Y],
        [Vec3::X, Vec3::X * 2.0, Vec3::X * 3.0],
        [Vec3::X, Vec3::Y, Vec3::X + Vec3::Y],
        [Vec3::NAN, Vec3::X, Vec3::Y],
        [Vec3::INFINITY, Vec3::X, Vec3::Y],
    ]
}

#[test]
fn nothing_to_see_is_none() {
    for corners in degenerate_triangles() {
        assert!(SphericalTriangle::new(Vec3::ZERO, corners).is_none(), "{corners:?}");
    }
    let rectangle = |corner, u, v| SphericalRectangle::new(Vec3::ZERO, corner, u, v).is_none();
    assert!(rectangle(Vec3::Z, Vec3::ZERO, Vec3::Y));
    assert!(rectangle(Vec3::Z, Vec3::X, Vec3::X + Vec3::Y));
    assert!(rectangle(Vec3::X, Vec3::X, Vec3::Y));
    assert!(rectangle(Vec3::NAN, Vec3::X, Vec3::Y));
    assert!(rectangle(Vec3::Z * 1e6, Vec3::X, Vec3::Y));
}

/// Uniform by solid angle, a surface point has the density cos/distance² over the solid angle, per area.
fn density_on_surface(point: Vec3, normal_times_area: Vec3, solid_angle: f32) -> f32 {
    let distance2 = point.length_squared();
    point.dot(normal_times_area).abs() / (distance2 * distance2.sqrt() * solid_angle)
}

#[test]
fn spherical_triangles_are_uniform_from_tiny_to_huge() {
    let cases = [
        ("octant", [Vec3::X, Vec3::Y, Vec3::Z]),
        ("oblique", [Vec3::new(2.0, 0.3, 1.0), Vec3::new(-0.5, 1.5, 0.7), Vec3::new(0.1, -0.8, 3.0)]),
        ("thin", [Vec3::new(-2.0, 0.0, 1.0), Vec3::new(2.0, 0.1, 1.0), Vec3::new(2.0, 0.0, 1.0)]),
        (
            "nearly half of all",
            [Vec3::new(-2.0, -2.0, 0.5), Vec3::new(2.0, -1.5, 0.5), Vec3::new(0.0, 3.0, 0.5)],
        ),
        ("far", [Vec3::new(0.0, 1.0, 1e4), Vec3::new(1.0, 0.0, 1e4), Vec3::new(-1.0, -1.0, 1e4)]),
        ("tiny", [Vec3::new(0.0, 0.0, 1.0), Vec3::new(1e-6, 0.0, 1.0), Vec3::new(0.0, 1e-6, 1.0)]),
    ];
    for (name, corners) in cases {
        let triangle = SphericalTriangle::new(Vec3::ZERO, corners).unwrap();
        let [a, b, c] = corners;
        let at = |weights: Vec3| a * weights.x + b * weights.y + c * weights.z;
        let normal = (b - a).cross(c - a) * 0.5;
        let fit = square_matches_pdf(
            COUNT,
            13,
            |u| {
                let drawn = triangle.sample([u[0], u[1]]);
                let (weights, direction) = (drawn.barycentrics, drawn.direction);
                assert!(weights.min_element() >= 0.0 && (weights.element_sum() - 1.0).abs() < 1e-6);
                assert!((direction.length() - 1.0).abs() < 1e-6);
                assert!((at(weights).normalize() - direction).length() < 1e-5, "{name}: {drawn:?}");
                let side = 1.0 - weights.x;
                Some([(side * side).min(1.0), if side > 0.0 { (weights.y / side).min(1.0) } else { 0.0 }])
            },
            |[square, share]| {
                let side = square.sqrt();
                let weights = Vec3::new(1.0 - side, side * share, side * (1.0 - share));
                density_on_surface(at(weights), normal, triangle.solid_angle())
            },
        );
        assert_fits(name, &fit, 1e-4);
    }
}

#[test]
fn spherical_rectangles_are_uniform() {
    let turn = Frame::from_normal(Vec3::new(1.0, 2.0, -0.5).normalize());
    let cases = [
        ("above the middle", [-0.5, -0.5, 1.0, 1.0, 1.0]),
        ("above a corner", [0.0, 0.0, 1.0, 2.0, -0.7]),
        ("aside", [1.0, -3.0, 2.0, 1.5, 1.0]),
        ("huge", [-3.0, -2.0, 6.0, 5.0, 0.6]),
        ("small and far", [0.5, 0.3, 0.02, 0.01, 5.0]),
    ];
    for (name, [x, y, width, height, distance]) in cases {
        let corner = turn.to_world(Vec3::new(x, y, distance));
        let (u_edge, v_edge) = (turn.tangent * width, turn.bitangent * height);
        let point = Vec3::new(0.2, -0.1, 0.3);
        let rectangle = SphericalRectangle::new(point, corner + point, u_edge, v_edge).unwrap();
        let at = |[s, t]: [f32; 2]| corner + u_edge * s + v_edge * t;
        let fit = square_matches_pdf(
            COUNT,
            17,
            |u| {
                let drawn = rectangle.sample([u[0], u[1]]);
                assert!(
                    (at(drawn.position).normalize() - drawn.direction).length() < 1e-5,
                    "{name}: {drawn:?}"
                );
                Some(drawn.position)
            },
            |place| density_on_surface(at(place), u_edge.cross(v_edge), rectangle.solid_angle()),
        );
        assert_fits(name, &fit, 1e-4);
    }
}

/// Rounding at the ends of the square must not lead out of the target.
#[test]
fn corners_of_the_square_stay_inside() {
    let triangle = SphericalTriangle::new(Vec3::ZERO, [Vec3::X, Vec3::Y, Vec3::Z]).unwrap();
    let rectangle =
        SphericalRectangle::new(Vec3::ZERO, Vec3::new(-1.0, -1.0, 1.0), Vec3::X * 2.0, Vec3::Y * 2.0)
            .unwrap();
    let ends = [0.0, 1e-7, 0.5, 1.0 - f32::EPSILON / 2.0, 1.0];
    for u in ends.iter().flat_map(|&a| ends.map(|b| [a, b])) {
        let direction = triangle.sample(u).direction;
        assert!(direction.min_element() > -1e-6 && direction.is_normalized(), "{u:?} {direction}");
        let drawn = rectangle.sample(u);
        assert!(drawn.position.iter().all(|x| (0.0..=1.0).contains(x)), "{u:?} {drawn:?}");
        assert!(drawn.direction.is_normalized(), "{u:?} {drawn:?}");
    }
}

/// Numbers outside the square are a mistake of the caller, but no reason to panic.
#[test]
fn hostile_numbers_do_no_harm() {
    let triangle = SphericalTriangle::new(Vec3::ZERO, [Vec3::X, Vec3::Y, Vec3::Z]).unwrap();
    let rectangle = SphericalRectangle::new(Vec3::ZERO, Vec3::Z, Vec3::X, Vec3::Y).unwrap();
    let cone = Cone::from_half_angle(0.3).unwrap();
    let numbers = [f32::NAN, f32::INFINITY, -1.0, 2.0, f32::MIN];
    for u in numbers.iter().flat_map(|&a| numbers.map(|b| [a, b])) {
        assert!(triangle.sample(u).pdf > 0.0 && rectangle.sample(u).pdf > 0.0);
        let _ = (warp::disc(u), warp::sphere(u), warp::hemisphere(u), warp::cosine_hemisphere(u));
        let _ =
            (cone.sample(u), warp::triangle(u), warp::tent(u[0], 1.0), warp::normal(u[0].into(), 0.0, 1.0));
    }
}
