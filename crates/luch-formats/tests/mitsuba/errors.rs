//! What is wrong is told with its place.

use crate::text::{load, load_text};
use luch_formats::Place;

/// The problems of a scene, each as `line:column message`.
fn problems(text: &str) -> Vec<String> {
    let error = load_text(text).expect_err("is wrong");
    let told = |problem: &luch_formats::Problem| match &problem.place {
        Some(Place::Text { line, column, .. }) => format!("{line}:{column} {}", problem.message),
        _ => problem.message.clone(),
    };
    error.problems.iter().map(told).collect()
}

#[test]
fn every_mistake_has_its_line_and_column() {
    let text = r#"<scene version="3.0.0">
  <shape type="cube"><ref id="clya"/></shape>
  <bsdf type="diffuse" id="clay"><rgb name="reflectance" value="1, x, 3"/></bsdf>
  <bsdf type="diffuse" id="clay"/>
  <shpae type="cube"/>
  <sensor type="perspective"><float name="fov" value="270"/><integer name="focus_distance"/></sensor>
  <emitter/>
</scene>"#;
    assert_eq!(
        problems(text),
        [
            "2:22 nothing has the id \"clya\"",
            "3:65 \"x\" is no number",
            "4:3 the id \"clay\" is given twice",
            "5:3 unknown element `shpae`",
            "6:30 `fov` of sensor `perspective` is 270, expected a number from 0.001 to 179.999",
            "6:61 this `integer` lacks its attribute `value`",
            "7:3 this `emitter` lacks its attribute `type`",
        ]
    );
    let shown = load_text(text).unwrap_err().to_string();
    assert!(shown.contains("help: did you mean \"clay\"? defined: \"clay\""), "{shown}");
    assert!(shown.contains("help: did you mean `shape`?"), "{shown}");
}

#[test]
fn what_is_no_xml_or_no_scene_says_so() {
    for (text, expected) in [
        (
            "<scene version=\"3.0.0\">\n<shape",
            "1:1 is no well-formed XML: the root node was opened but never closed",
        ),
        ("<scene>\n</scen>", "2:1 is no well-formed XML"),
        ("<html/>", "1:1 the document is a `html`, expected a `scene` of Mitsuba"),
        ("", "is no well-formed XML"),
        ("<scene><a></scene>", "is no well-formed XML"),
        ("<scene>&nope;</scene>", "is no well-formed XML"),
        ("<scene>hello</scene>", "1:8 the text \"hello\" has no meaning here"),
    ] {
        let all = problems(text);
        assert!(all[0].contains(expected), "{text}: {all:?}");
    }
}

#[test]
fn values_of_another_type_say_what_is_expected() {
    for (inside, expected) in [
        (
            r#"<shape type="sphere"><string name="radius" value="1"/></shape>"#,
            "is a string, expected a number",
        ),
        (
            r#"<shape type="sphere"><float name="radius" value="0"/></shape>"#,
            "is 0, expected a number above 0",
        ),
        (
            r#"<shape type="sphere"><float name="radius" value="1e30"/></shape>"#,
            "is no number of at most 1e18",
        ),
        (r#"<shape type="sphere"><float name="radius" value="nan"/></shape>"#, "is no number of at most"),
        (
            r#"<shape type="cube"><boolean name="flip_normals" value="maybe"/></shape>"#,
            "neither true nor false",
        ),
        (
            r#"<shape type="cube"><float name="to_world" value="1"/></shape>"#,
            "is a number, expected a transform",
        ),
        (
            r#"<integrator type="path"><float name="max_depth" value="3"/></integrator>"#,
            "expected a whole number",
        ),
        (
            r#"<integrator type="path"><integer name="max_depth" value="-2"/></integrator>"#,
            "from -1 to 2147483647",
        ),
        (
            r#"<emitter type="point"><point name="position" value="1 2"/></emitter>"#,
            "has 2 numbers, expected 3",
        ),
        (
            r#"<emitter type="point"><rgb name="intensity" value="-1"/></emitter>"#,
            "is negative or not finite",
        ),
        (r#"<emitter type="point"><string name="intensity" value="a"/></emitter>"#, "expected a colour"),
        (r#"<shape type="cube"><bsdf type="twosided"/></shape>"#, "lacks the bsdf inside it"),
        (
            r#"<shape type="cube"><bsdf type="blendbsdf"><bsdf type="diffuse"/></bsdf></shape>"#,
            "has 1 bsdfs inside it, expected 2",
        ),
        (r#"<shape type="cube"><bsdf type="mask" id="m"><ref id="m"/></bsdf></shape>"#, "without end"),
        (
            r#"<shape type="cube"><bsdf type="dielectric"><string name="int_ior" value="watre"/></bsdf></shape>"#,
            "cannot be \"watre\"",
        ),
        (
            r#"<sensor type="perspective"><transform name="to_world"><matrix value="1 2 3"/></transform></sensor>"#,
            "has 9 or 16 numbers",
        ),
        (
            r#"<sensor type="perspective"><transform name="to_world"><lookat origin="0,0,0" target="0,1,0" up="0,1,0"/></transform></sensor>"#,
            "along the view",
        ),
        (
            r#"<sensor type="perspective"><transform name="to_world"><spin x="1"/></transform></sensor>"#,
            "unknown step `spin`",
        ),
        (
            r#"<sensor type="perspective"><string name="focal_length" value="long"/></sensor>"#,
            "no focal length",
        ),
        (r#"<shape type="obj"><string name="filename" value="none.obj"/></shape>"#, "none.obj: no such file"),
        (r#"<include filename="none.xml"/>"#, "cannot include this file"),
        (r#"<include filename="s.xml"/>"#, "includes itself"),
        (r#"<rgb name="x" value="1 2"/>"#, "has 2 numbers"),
        (r#"<float value="1"/>"#, "lacks its attribute `name`"),
    ] {
        let error = load(inside).expect_err(inside).to_string();
        assert!(error.contains(expected), "{inside}: {error}");
    }
}

#[test]
fn a_word_that_is_not_known_is_a_warning_with_advice() {
    let loaded =
        load(r#"<sensor type="perspective"><string name="fov_axis" value="diagnoal"/></sensor>"#).unwrap();
    assert!(loaded.warnings[0].message.contains("`fov_axis` of sensor `perspective` cannot be \"diagnoal\""));
    assert!(loaded.warnings[0].help.as_ref().unwrap().starts_with("did you mean \"diagonal\"?"));
}
