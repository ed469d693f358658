//! Emitters.

use crate::text::{honoured, load, near, only, sound, warnings};
use glam::Vec3;
use luch_image::Rgb;
use luch_scene::{Environment, Light};

#[test]
fn points_spots_and_directions() {
    let loaded = sound(
        r#"<emitter type="point"><point name="position" x="1" y="2" z="3"/><rgb name="intensity" value="4, 5, 6"/></emitter>
        <emitter type="point"><transform name="to_world"><translate x="7"/></transform></emitter>
        <emitter type="spot"><float name="cutoff_angle" value="30"/><float name="beam_width" value="30"/>
          <transform name="to_world"><lookat origin="0, 5, 0" target="0, 0, 0" up="0, 0, 1"/></transform></emitter>
        <emitter type="directional"><vector name="direction" value="0, -2, 0"/><rgb name="irradiance" value="3"/></emitter>"#,
    );
    assert_eq!(loaded.warnings, []);
    let [first, second, spot, sun] = loaded.scene.lights[..] else { panic!("has four lights") };
    let intensity = Rgb::new(4.0, 5.0, 6.0);
    assert_eq!(first, Light::Point { position: Vec3::new(1.0, 2.0, 3.0), intensity });
    assert_eq!(second, Light::Point { position: Vec3::X * 7.0, intensity: Rgb::WHITE });
    let Light::Spot { position, direction, outer_angle, inner_angle, .. } = spot else { panic!("is a spot") };
    assert!(position.abs_diff_eq(Vec3::Y * 5.0, 1e-6) && direction.abs_diff_eq(Vec3::NEG_Y, 1e-6));
    assert!((outer_angle - 30_f32.to_radians()).abs() < 1e-6 && inner_angle == outer_angle);
    let Light::Sun { direction, irradiance, angular_radius } = sun else { panic!("is a sun") };
    assert_eq!((direction, irradiance, angular_radius), (Vec3::NEG_Y, Rgb::gray(3.0), 0.0));
}

#[test]
fn light_spectra_have_the_colour_of_equal_energy() {
    let loaded = honoured(r#"<emitter type="constant"><spectrum name="radiance" value="3"/></emitter>"#);
    let Some(Environment::Constant { radiance }) = loaded.scene.environment else { panic!("is constant") };
    // What Mitsuba 3.9 makes of it in its RGB variants.
    for (have, expected) in radiance.to_array().into_iter().zip([3.614_38, 2.844_87, 2.726_75]) {
        assert!((have / expected - 1.0).abs() < 1e-3, "{radiance:?}");
    }
    let loaded = honoured(r#"<emitter type="constant"><rgb name="radiance" value="3"/></emitter>"#);
    assert_eq!(loaded.scene.environment, Some(Environment::Constant { radiance: Rgb::gray(3.0) }));
}

#[test]
fn the_sky_is_turned_half_about() {
    let loaded = honoured(
        r#"<emitter type="envmap"><string name="filename" value="p.png"/><float name="scale" value="2"/></emitter>"#,
    );
    let Some(Environment::LatLong { scale, rotation, .. }) = loaded.scene.environment else {
        panic!("is a picture")
    };
    near(scale, [2.0; 3]);
    // Mitsuba: u = atan2(x, −z) / 2π. Ours: u = 1/2 + that of the turned direction.
    for direction in [Vec3::new(1.0, 0.2, 0.3), Vec3::new(-0.4, -0.2, 0.9), Vec3::new(-0.3, 0.7, -0.6)] {
        let theirs = (libm::atan2f(direction.x, -direction.z) / std::f32::consts::TAU).rem_euclid(1.0);
        let own = rotation.transpose() * direction;
        let ours = (0.5 + libm::atan2f(own.x, -own.z) / std::f32::consts::TAU).rem_euclid(1.0);
        assert!((theirs - ours).abs() < 1e-6 && (own.y - direction.y).abs() < 1e-6, "{direction}: {ours}");
    }
    let turned = honoured(
        r#"<emitter type="envmap"><string name="filename" value="p.png"/><transform name="to_world"><rotate x="1" angle="90"/></transform></emitter>"#,
    );
    let Some(Environment::LatLong { rotation, .. }) = turned.scene.environment else {
        panic!("is a picture")
    };
    // The top of the picture goes where +Y goes.
    assert!((rotation * Vec3::Y).abs_diff_eq(Vec3::Z, 1e-6));
}

#[test]
fn area_lamps_shine_from_the_front() {
    let loaded = honoured(
        r#"<shape type="sphere"><emitter type="area"><rgb name="radiance" value="1, 2, 3"/></emitter></shape>"#,
    );
    let emission = loaded.scene.materials[only(&loaded).0.materials[0].index()].emission.unwrap();
    near(emission.radiance.factor, [1.0, 2.0, 3.0]);
    assert!(!emission.two_sided);
}

#[test]
fn what_lights_nothing_is_named() {
    let error = load(r#"<emitter type="area"/>"#).unwrap_err();
    assert!(error.to_string().contains("inside no shape"));
    let error = load(r#"<emitter type="constant"/><emitter type="constant"/>"#).unwrap_err();
    assert!(error.to_string().contains("two environments"));
    let loaded = sound(r#"<emitter type="sunsky"><float name="turbidity" value="3"/></emitter>"#);
    assert_eq!(warnings(&loaded), "emitter `sunsky` is not supported: it is left out\n");
    let loaded = sound(r#"<emitter type="spot"/>"#);
    assert!(warnings(&loaded).contains("the rim of a spot"));
    let loaded = sound(r#"<shape type="cube"><emitter type="projector"/></shape>"#);
    assert!(warnings(&loaded).contains("emitter `projector`"));
    let loaded = sound(r#"<shape type="cube"><medium type="homogeneous" name="interior"/></shape>"#);
    assert!(warnings(&loaded).contains("media are left out"));
}

#[test]
fn a_black_body_is_warm_and_bright() {
    let loaded = honoured(
        r#"<emitter type="point"><blackbody name="intensity" temperature="3000K" scale="2"/></emitter>"#,
    );
    let Light::Point { intensity, .. } = loaded.scene.lights[0] else { panic!("is a point") };
    assert!(intensity.r > intensity.g && intensity.g > intensity.b && intensity.r > 100.0, "{intensity:?}");
}
