//! Files of versions 0.4 to 0.6.

use crate::text::load_text;
use glam::Vec2;
use luch_scene::{Integrator, Reflectance, Surface};

#[test]
fn names_in_camel_case_are_renewed() {
    let loaded = load_text(
        r##"<?xml version="1.0" encoding="utf-8"?>
<scene version="0.5.0">
  <integrator type="path"><integer name="maxDepth" value="65"/></integrator>
  <sensor type="perspective">
    <transform name="toWorld"><lookAt origin="0, 0, 5" target="0, 0, 0" up="0, 1, 0"/></transform>
    <string name="fovAxis" value="smaller"/><float name="nearClip" value="1"/>
    <film type="hdrfilm"><string name="pixelFormat" value="rgb"/><boolean name="banner" value="false"/><rfilter name="rfilter" type="tent"/></film>
    <sampler type="ldsampler"><integer name="sampleCount" value="8"/></sampler>
  </sensor>
  <texture type="checkerboard" id="t"><float name="uscale" value="8"/><float name="vscale" value="4"/><float name="uoffset" value="0.5"/></texture>
  <bsdf type="roughplastic" id="p"><float name="intIOR" value="1.5"/><float name="extIOR" value="1"/><string name="distribution" value="ggx"/>
    <ref name="diffuseReflectance" id="t"/></bsdf>
  <shape type="obj"><string name="filename" value="t.obj"/><boolean name="faceNormals" value="true"/><ref name="bsdf" id="p"/></shape>
  <shape type="sphere"><point name="center" x="1" y="2" z="3"/><bsdf type="conductor"/></shape>
  <emitter type="constant"><srgb name="radiance" value="#ffffff"/></emitter>
</scene>"##,
    )
    .unwrap();
    assert_eq!(loaded.warnings, []);
    let scene = &loaded.scene;
    assert_eq!(
        (scene.settings.integrator, loaded.wishes.samples),
        (Integrator::Path { max_depth: 64 }, Some(8))
    );
    let Surface::Principled(plastic) = &scene.materials[scene.instances[0].materials[0].index()].surface
    else {
        panic!("is principled")
    };
    assert_eq!(plastic.ior, 1.5);
    // Mitsuba's (0.25, 0.5) times the scale is (2.5, 2); a unit has two squares.
    let place = plastic.base_color.texture.unwrap().place(Vec2::new(0.25, 0.5));
    assert!(place.abs_diff_eq(Vec2::new(5.0, 4.0), 1e-5), "{place}");
    let Surface::Conductor { reflectance, .. } =
        scene.materials[scene.instances[1].materials[0].index()].surface
    else {
        panic!("is a conductor")
    };
    // Copper, which is what old versions take.
    assert!(matches!(reflectance, Reflectance::Index { eta, .. } if eta.r < 0.5 * eta.g && eta.g < eta.b));
}
