//! Files made to do harm, and good ones with random damage.

use crate::text::{files, load_files, load_text};
use proptest::prelude::*;

/// A scene with most of what the importer reads.
const EVERYTHING: &str = r##"<scene version="2.1.0"><default name="spp" value="16"/><path value="x"/>
<integrator type="path"><integer name="max_depth" value="8"/></integrator>
<sensor type="thinlens"><string name="fov_axis" value="smaller"/><float name="fov" value="45"/><float name="aperture_radius" value="0.1"/>
<transform name="to_world"><scale x="-1"/><rotate y="1" angle="10"/><lookat origin="1, 2, 3" target="0, 0, 0" up="0, 1, 0"/></transform>
<film type="hdrfilm"><integer name="width" value="64"/><integer name="height" value="48"/><rfilter type="gaussian"/></film>
<sampler type="independent"><integer name="sample_count" value="$spp"/></sampler></sensor>
<bsdf type="twosided" id="a"><bsdf type="roughplastic"><float name="alpha" value="0.2"/><string name="int_ior" value="bk7"/>
<texture type="bitmap" name="diffuse_reflectance"><string name="filename" value="p.png"/><transform name="to_uv"><scale value="3"/></transform></texture></bsdf></bsdf>
<bsdf type="blendbsdf" id="b"><float name="weight" value="0.3"/><ref id="a"/><bsdf type="roughconductor"><string name="material" value="Au"/></bsdf></bsdf>
<bsdf type="mask" id="c"><texture type="checkerboard" name="opacity"/><bsdf type="dielectric"/></bsdf>
<shape type="obj"><string name="filename" value="t.obj"/><ref id="b"/></shape>
<shape type="shapegroup" id="g"><shape type="cube"><ref id="c"/></shape><shape type="disk"/></shape>
<shape type="instance"><ref id="g"/><transform name="to_world"><matrix value="1 0 0 1 0 1 0 0 0 0 1 0 0 0 0 1"/></transform></shape>
<shape type="sphere"><point name="center" x="1" y="2" z="3"/><emitter type="area"><spectrum name="radiance" value="400:1, 700:2"/></emitter></shape>
<shape type="cylinder"><boolean name="flip_normals" value="true"/></shape>
<emitter type="envmap"><string name="filename" value="p.png"/><float name="scale" value="0.5"/></emitter>
<emitter type="spot"><rgb name="intensity" value="#ff8000"/></emitter>
<emitter type="point"><blackbody name="intensity" temperature="4000"/></emitter></scene>"##;

/// An error or a sound scene.
fn survives(text: &str) -> bool {
    match load_text(text) {
        Ok(loaded) => {
            assert!(loaded.scene.problems().is_empty());
            true
        }
        Err(error) => {
            assert!((1..=101).contains(&error.problems.len()));
            for problem in &error.problems {
                assert!(problem.to_string().len() < 4000, "{problem}");
            }
            false
        }
    }
}

#[test]
fn the_scene_that_is_damaged_below_is_good() {
    assert!(survives(EVERYTHING));
}

#[test]
fn entities_and_document_types_are_refused() {
    let bomb = r#"<!DOCTYPE b [<!ENTITY a "aaaaaaaaaa"><!ENTITY b "&a;&a;&a;&a;&a;&a;&a;&a;">]><scene version="3.0.0">&b;</scene>"#;
    let error = load_text(bomb).unwrap_err().to_string();
    assert!(error.contains("DTD"), "{error}");
    let outside = r#"<!DOCTYPE s SYSTEM "file:///etc/passwd"><scene version="3.0.0"/>"#;
    assert!(!survives(outside));
}

#[test]
fn deep_nesting_is_refused() {
    for (open, close) in [
        ("<bsdf type=\"twosided\">", "</bsdf>"),
        ("<shape type=\"merge\">", "</shape>"),
        ("<x>", "</x>"),
        ("<transform name=\"t\">", "</transform>"),
    ] {
        for depth in [70, 100_000] {
            let text =
                format!("<scene version=\"3.0.0\">{}{}</scene>", open.repeat(depth), close.repeat(depth));
            assert!(!survives(&text), "{depth} times {open}");
        }
        assert!(!survives(&format!("<scene version=\"3.0.0\">{}", open.repeat(100_000))));
    }
}

#[test]
fn includes_that_multiply_are_refused() {
    // Each file includes the next one four times.
    let mut all = files(r#"<scene version="3.0.0"><include filename="0.xml"/></scene>"#);
    for file in 0..12 {
        let next = format!("<include filename=\"{}.xml\"/>", file + 1).repeat(4);
        all.push((format!("{file}.xml").into(), format!("<scene version=\"3.0.0\">{next}</scene>").into()));
    }
    all.push(("12.xml".into(), b"<scene version=\"3.0.0\"/>".to_vec()));
    let error = load_files(all, &[]).unwrap_err().to_string();
    assert!(error.contains("more than 256 files are included"), "{error}");
    // Two files that include each other.
    let mut all = files(r#"<scene version="3.0.0"><include filename="a.xml"/></scene>"#);
    all.push(("a.xml".into(), br#"<scene version="3.0.0"><include filename="b.xml"/></scene>"#.to_vec()));
    all.push(("b.xml".into(), br#"<scene version="3.0.0"><include filename="a.xml"/></scene>"#.to_vec()));
    let error = load_files(all, &[]).unwrap_err().to_string();
    assert!(error.contains("b.xml:1:24: this file includes itself"), "{error}");
}

#[test]
fn parameters_cannot_grow_without_bound() {
    let mut text = String::from("<scene version=\"3.0.0\"><default name=\"a0\" value=\"xxxxxxxxxxxxxxxx\"/>");
    for step in 1..64 {
        let before = format!("$a{}", step - 1).repeat(8);
        text += &format!("<default name=\"a{step}\" value=\"{before}\"/>");
    }
    assert!(!survives(&(text + "</scene>")));
}

#[test]
fn huge_numbers_and_counts_do_no_harm() {
    for inside in [
        r#"<sensor type="perspective"><film type="hdrfilm"><integer name="width" value="65536"/><integer name="height" value="65536"/></film></sensor>"#,
        r#"<shape type="cube"><transform name="to_world"><scale value="1e18"/><scale value="1e18"/><scale value="1e18"/></transform></shape>"#,
        r#"<shape type="cube"><transform name="to_world"><scale value="1e-18"/><scale value="1e-18"/></transform></shape>"#,
        r#"<shape type="sphere"><float name="radius" value="1e18"/><point name="center" value="1e18, 1e18, 1e18"/></shape>"#,
        r#"<emitter type="point"><rgb name="intensity" value="1e18"/></emitter>"#,
        r#"<emitter type="point"><blackbody name="intensity" temperature="1000000" scale="1e12"/></emitter>"#,
        r#"<sensor type="perspective"><sampler type="independent"><integer name="sample_count" value="9223372036854775807"/></sampler></sensor>"#,
        r#"<shape type="obj"><string name="filename" value="/dev/zero"/></shape>"#,
        r#"<sensor type="perspective"><string name="focal_length" value="1e300mm"/></sensor>"#,
    ] {
        survives(&format!("<scene version=\"3.0.0\">{inside}</scene>"));
    }
}

/// Words to put in the place of others.
const WORDS: [&str; 26] = [
    "0",
    "-1",
    "1e18",
    "-1e18",
    "nan",
    "inf",
    "1e-40",
    "999999999999999999999",
    "\"\"",
    "$spp",
    "$",
    "#",
    "<",
    ">",
    "/>",
    "&amp;",
    "value",
    "name",
    "id=\"a\"",
    "<ref id=\"b\"/>",
    "<include filename=\"s.xml\"/>",
    "sphere",
    "bitmap",
    "roughconductor",
    "<shape type=\"merge\">",
    "é\u{0}",
];

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn changed_words_do_no_harm(at in 0..EVERYTHING.len(), word in prop::sample::select(&WORDS[..])) {
        let tokens: Vec<&str> = EVERYTHING.split_inclusive(|c: char| !c.is_alphanumeric() && c != '_').collect();
        let mut tokens: Vec<String> = tokens.into_iter().map(str::to_owned).collect();
        let at = at % tokens.len();
        let end = tokens[at].chars().last().filter(|c| !c.is_alphanumeric()).map(String::from).unwrap_or_default();
        tokens[at] = format!("{word}{end}");
        survives(&tokens.concat());
    }

    #[test]
    fn cut_and_swapped_bytes_do_no_harm(cut in 0..EVERYTHING.len(), at in 0..EVERYTHING.len(), byte in any::<u8>()) {
        let mut bytes = EVERYTHING.as_bytes().to_vec();
        bytes[at] = byte;
        let mut all = files("");
        all[0].1 = bytes.clone();
        let _ = load_files(all, &[]);
        bytes.truncate(cut);
        let mut all = files("");
        all[0].1 = bytes;
        assert!(load_files(all, &[]).is_err());
    }
}
