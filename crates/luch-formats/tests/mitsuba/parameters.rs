//! Parameters, includes, aliases and paths.

use crate::text::{files, load_files, load_text};
use luch_scene::Integrator;

const SCENE: &str = r#"<scene version="3.0.0">
<default name="depth" value="5"/><default name="depth_of_lens" value="9"/><default name="kind" value="path"/>
<integrator type="$kind"><integer name="max_depth" value="$depth"/></integrator>
<sensor type="thinlens"><float name="aperture_radius" value="0.$depth_of_lens"/></sensor></scene>"#;

#[test]
fn defaults_hold_unless_a_value_is_given() {
    let loaded = load_text(SCENE).unwrap();
    assert_eq!(loaded.scene.settings.integrator, Integrator::Path { max_depth: 4 });
    // The longest name that fits counts.
    assert_eq!(loaded.scene.cameras[0].camera.lens_radius, 0.9);
    let loaded = load_files(files(SCENE), &[("depth", "3"), ("kind", "volpath")]).unwrap();
    assert_eq!(loaded.scene.settings.integrator, Integrator::Path { max_depth: 2 });
}

#[test]
fn parameters_that_are_not_there_are_told() {
    let error = load_files(files(SCENE), &[("dept", "3")]).unwrap_err().to_string();
    assert!(error.contains("has no parameter \"dept\"") && error.contains("did you mean depth?"), "{error}");
    let error =
        load_text("<scene version=\"3.0.0\">\n<integrator type=\"$x\"/></scene>").unwrap_err().to_string();
    assert!(error.starts_with("s.xml:2:19: the parameter \"$x\" has no value"), "{error}");
}

#[test]
fn included_files_stand_where_they_are_named() {
    let mut all = files(
        r#"<scene version="3.0.0"><default name="r" value="0.25"/><include filename="sub/materials.xml"/>
        <shape type="cube"><ref id="b"/></shape><alias id="b" as="c"/><shape type="sphere"><ref id="c"/></shape></scene>"#,
    );
    all.push((
        "sub/materials.xml".into(),
        br#"<scene version="0.6.0"><bsdf type="diffuse" id="b"><rgb name="reflectance" value="$r"/></bsdf><include filename="more.xml"/></scene>"#.to_vec(),
    ));
    all.push((
        "sub/more.xml".into(),
        br#"<scene version="3.0.0"><shape type="disk"><ref id="b"/></shape></scene>"#.to_vec(),
    ));
    let loaded = load_files(all, &[]).unwrap();
    assert_eq!(loaded.warnings, []);
    assert_eq!(loaded.scene.instances.len(), 3);
    let first = loaded.scene.instances[0].materials[0];
    assert!(loaded.scene.instances.iter().all(|instance| instance.materials == [first]));
    assert_eq!(
        loaded.scene.materials[first.index()].surface,
        luch_scene::Surface::Diffuse { color: luch_image::Rgb::gray(0.25).into() }
    );
}

#[test]
fn files_are_found_in_named_folders_and_by_their_last_part() {
    let mut all = files(
        r#"<scene version="3.0.0"><path value="models"/><shape type="obj"><string name="filename" value="far.obj"/></shape>
        <shape type="obj"><string name="filename" value="C:\old\t.obj"/></shape></scene>"#,
    );
    all.push(("models/far.obj".into(), crate::text::TRIANGLE.into()));
    let loaded = load_files(all, &[]).unwrap();
    assert_eq!(loaded.scene.instances.len(), 2);
}
