//! Sensors, films, filters, samplers and integrators.

use crate::text::{honoured, sound, warnings};
use glam::Vec3;
use luch_scene::{Camera, Filter, Integrator, Projection};

/// The camera of a sensor of 200 × 100 pixels.
fn camera(kind: &str, inside: &str) -> Camera {
    let loaded = honoured(&format!(
        r#"<sensor type="{kind}">{inside}<film type="hdrfilm"><integer name="width" value="200"/><integer name="height" value="100"/></film></sensor>"#
    ));
    assert_eq!((loaded.scene.settings.width, loaded.scene.settings.height), (200, 100));
    loaded.scene.cameras[0].camera
}

fn angle(camera: &Camera) -> f32 {
    match camera.projection {
        Projection::Perspective { field_of_view_y } => field_of_view_y,
        Projection::Orthographic { .. } => panic!("is perspective"),
    }
}

#[test]
fn a_sensor_looks_along_z_with_x_to_the_left() {
    let camera = camera("perspective", "");
    let orientation = camera.orientation;
    assert_eq!(
        (orientation.x_axis, orientation.y_axis, orientation.z_axis),
        (Vec3::NEG_X, Vec3::Y, Vec3::NEG_Z)
    );
    assert_eq!((camera.position, camera.lens_radius), (Vec3::ZERO, 0.0));
}

#[test]
fn lookat_and_mirror() {
    let view = r#"<lookat origin="1, 2, 3" target="1, 2, -5" up="0, 1, 0"/>"#;
    let plain = camera("perspective", &format!(r#"<transform name="to_world">{view}</transform>"#));
    assert_eq!(plain.position, Vec3::new(1.0, 2.0, 3.0));
    assert!(plain.orientation.x_axis.abs_diff_eq(Vec3::X, 1e-6));
    assert!(plain.orientation.z_axis.abs_diff_eq(Vec3::Z, 1e-6));
    let mirrored =
        camera("perspective", &format!(r#"<transform name="to_world"><scale x="-1"/>{view}</transform>"#));
    assert!(mirrored.orientation.x_axis.abs_diff_eq(Vec3::NEG_X, 1e-6));
    assert!(mirrored.orientation.y_axis.abs_diff_eq(Vec3::Y, 1e-6));
}

#[test]
fn fields_of_view_along_all_axes() {
    let of = |axis: &str| {
        let fov = r#"<float name="fov" value="90"/>"#;
        let camera = camera("perspective", &format!(r#"{fov}<string name="fov_axis" value="{axis}"/>"#));
        libm::tanf(angle(&camera) / 2.0)
    };
    for (axis, half) in
        [("x", 0.5), ("y", 1.0), ("smaller", 1.0), ("larger", 0.5), ("diagonal", 1.0 / 5_f32.sqrt())]
    {
        assert!((of(axis) - half).abs() < 1e-5, "{axis}: {}", of(axis));
    }
    // 43.267 mm across the film, 50 mm from the lens.
    let standard = libm::tanf(angle(&camera("perspective", "")) / 2.0);
    assert!((standard - 0.432_666 / 5_f32.sqrt()).abs() < 1e-5, "{standard}");
}

#[test]
fn lenses_and_parallel_rays() {
    let lens = camera(
        "thinlens",
        r#"<float name="aperture_radius" value="0.1"/><float name="focus_distance" value="3"/><float name="fov" value="40"/>"#,
    );
    assert_eq!((lens.lens_radius, lens.focus_distance), (0.1, 3.0));
    let parallel = camera("orthographic", r#"<transform name="to_world"><scale x="3" y="3"/></transform>"#);
    // The film spans −1 to 1 across, times 3.
    assert_eq!(parallel.projection, Projection::Orthographic { height: 3.0 });
}

#[test]
fn filters_samples_and_seeds() {
    for (filter, expected) in [
        (r#"<rfilter type="box"/>"#, Filter::Box { radius: 0.5 }),
        (r#"<rfilter type="tent"/>"#, Filter::Tent { radius: 1.0 }),
        (r#"<rfilter type="gaussian"/>"#, Filter::Gaussian { radius: 2.0, deviation: 0.5 }),
        ("", Filter::Gaussian { radius: 2.0, deviation: 0.5 }),
    ] {
        let loaded = honoured(&format!(
            r#"<sensor type="perspective"><film type="hdrfilm">{filter}</film>
            <sampler type="multijitter"><integer name="sample_count" value="12"/><integer name="seed" value="7"/></sampler></sensor>"#
        ));
        assert_eq!((loaded.scene.settings.filter, loaded.scene.settings.seed), (expected, 7));
        assert_eq!((loaded.wishes.samples, loaded.scene.settings.width), (Some(12), 768));
    }
    let loaded = sound(
        r#"<sensor type="perspective"><film type="hdrfilm"><rfilter type="lanczos"/><integer name="crop_width" value="9"/></film></sensor>"#,
    );
    assert!(warnings(&loaded).contains("`lanczos` has negative weights"));
    assert!(warnings(&loaded).contains("crop window"));
}

#[test]
fn paths_are_counted_from_the_first_surface() {
    let depth = |inside: &str| sound(inside).scene.settings.integrator;
    let path = |depth: i32| {
        format!(r#"<integrator type="path"><integer name="max_depth" value="{depth}"/></integrator>"#)
    };
    assert_eq!(depth(&path(2)), Integrator::Path { max_depth: 1 });
    assert_eq!(depth(&path(1)), Integrator::Path { max_depth: 0 });
    assert_eq!(depth(&path(-1)), Integrator::Path { max_depth: 1 << 20 });
    assert_eq!(depth(""), Integrator::Path { max_depth: 1 << 20 });
    assert_eq!(depth(r#"<integrator type="direct"/>"#), Integrator::Direct);
    assert_eq!(depth(r#"<integrator type="ao"/>"#), Integrator::Occlusion { distance: f32::INFINITY });
    let inner = format!(r#"<integrator type="moment">{}</integrator>"#, path(3));
    assert_eq!(depth(&inner), Integrator::Path { max_depth: 2 });
    let hidden =
        sound(r#"<integrator type="path"><boolean name="hide_emitters" value="True"/></integrator>"#);
    assert!(warnings(&hidden).contains("`hide_emitters` is not supported"));
    let other = sound(r#"<integrator type="bdpt"/>"#);
    assert!(warnings(&other).contains("another way to the same picture"));
}

#[test]
fn several_sensors_have_names() {
    let loaded = honoured(
        r#"<sensor type="perspective" id="near"><film type="hdrfilm"><integer name="width" value="10"/><integer name="height" value="20"/></film></sensor>
        <sensor type="perspective" id="far"/>"#,
    );
    let names: Vec<&str> = loaded.scene.cameras.iter().map(|camera| camera.name.as_str()).collect();
    assert_eq!((names, loaded.scene.settings.width), (vec!["near", "far"], 10));
    let left = sound(r#"<sensor type="radiancemeter"/>"#);
    assert!(warnings(&left).contains("sensor `radiancemeter` is not supported"));
}
