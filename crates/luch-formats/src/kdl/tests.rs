//! The reader against the `kdl` crate, and against texts made to break it.

use super::{Node, Value, parse};
use proptest::prelude::*;

/// A document of the `kdl` crate in our terms; of a property that is given twice that crate keeps all.
fn theirs(document: &::kdl::KdlDocument) -> Vec<Plain> {
    let value = |value: &::kdl::KdlValue| match value {
        ::kdl::KdlValue::String(text) => Value::Text(text.clone()),
        ::kdl::KdlValue::Integer(number) => Value::Integer(*number),
        ::kdl::KdlValue::Float(number) => Value::Float(*number),
        ::kdl::KdlValue::Bool(truth) => Value::Bool(*truth),
        ::kdl::KdlValue::Null => Value::Null,
    };
    let nodes = document.nodes().iter();
    nodes
        .map(|node| Plain {
            name: node.name().value().to_owned(),
            entries: node
                .entries()
                .iter()
                .map(|entry| (entry.name().map(|name| name.value().to_owned()), value(entry.value())))
                .collect(),
            children: node.children().map(theirs).unwrap_or_default(),
        })
        .collect()
}

fn ours(nodes: &[Node]) -> Vec<Plain> {
    let entry =
        |entry: &super::Entry| (entry.name.as_ref().map(|name| name.text.clone()), entry.value.clone());
    nodes
        .iter()
        .map(|node| Plain {
            name: node.name.text.clone(),
            entries: node.entries.iter().map(entry).collect(),
            children: ours(&node.children),
        })
        .collect()
}

/// A node without places.
#[derive(Debug, PartialEq)]
struct Plain {
    name: String,
    entries: Vec<(Option<String>, Value)>,
    children: Vec<Plain>,
}

const GOOD: [&str; 22] = [
    "",
    "a",
    "a;b;c",
    "a 1 2.5 -3 +4 1e3 -1.5E-2 0xff 0o17 0b101 1_000 -0x1F",
    "a b=1 \"c d\"=2 e = 3",
    "a { b; c { d 1 } }\nf",
    "a #true #false #null #inf #-inf",
    "a \"x\\n\\t\\\\\\\"\\u{1f600}\\s|\"",
    "a #\"raw \\n \"quoted\" \"#  ##\"one \"# two\"##",
    "a \"\"\"\n    one\n      two\n\n    three\n    \"\"\"",
    "a #\"\"\"\n  x \\n\n  \"\"\"#",
    "a /* comment /* inside */ */ 1 // to the end\nb",
    "a \\\n  1 \\ // why not\n  2\nb",
    "/- a 1 { b }\nc /-1 2 /-{ d } { e }",
    "/-\na\nb",
    "a-b.c_d?!<>*&^%$@~`|,:' -x .y + - --",
    "\u{feff}a 1",
    "a\r\nb\rc\u{85}d\u{2028}e",
    "a\u{3000}1\u{a0}2",
    "a \"one \\\n     line\"",
    "a 170141183460469231731687303715884105727",
    "привет мир=\"да\"",
];

#[test]
fn good_texts_mean_what_the_kdl_crate_says() {
    for text in GOOD {
        let expected =
            theirs(&::kdl::KdlDocument::parse_v2(text).unwrap_or_else(|e| panic!("{text:?}: {e:?}")));
        assert_eq!(ours(&parse(text).unwrap_or_else(|e| panic!("{text:?}: {e:?}"))), expected, "{text:?}");
    }
}

#[test]
fn the_scenes_mean_what_the_kdl_crate_says() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|extension| extension != "kdl") {
            continue;
        }
        let text = std::fs::read_to_string(path).unwrap();
        let expected = theirs(&::kdl::KdlDocument::parse_v2(&text).unwrap());
        assert_eq!(ours(&parse(&text).unwrap()), expected);
    }
}

#[test]
fn bad_texts_are_refused_by_both() {
    let bad = [
        "{",
        "}",
        "a {",
        "a }",
        "a = 1",
        "a b=",
        "a (t)",
        "a \"x",
        "a \"x\ny\"",
        "a true",
        "a null",
        "a #maybe",
        "a 1x",
        "a 0xg",
        "a 1..2",
        "a .5",
        "a +.5",
        "a \\ 1",
        "/* x",
        "a [",
        "a \"\\q\"",
        "a \"\\u{110000}\"",
        "a \"\"\"x\"\"\"",
        "a \"\"\"\n x\n  \"\"\"",
        "1 2",
        "a\"b\"",
        "a {} {}",
        "a\u{0}",
        "/-",
        "a \u{200e}",
        "a \u{feff}",
    ];
    for text in bad {
        assert!(::kdl::KdlDocument::parse_v2(text).is_err(), "the kdl crate accepts {text:?}");
        assert!(parse(text).is_err(), "we accept {text:?}");
    }
}

#[test]
fn spans_are_the_bytes_of_names_and_values() {
    let text = "é { node 12 key=\"välue\" }";
    let nodes = parse(text).unwrap();
    let child = &nodes[0].children[0];
    assert_eq!(&text[nodes[0].name.span.clone()], "é");
    assert_eq!(&text[child.name.span.clone()], "node");
    assert_eq!(&text[child.entries[0].span.clone()], "12");
    assert_eq!(&text[child.entries[1].name.as_ref().unwrap().span.clone()], "key");
    assert_eq!(&text[child.entries[1].span.clone()], "\"välue\"");
}

#[test]
fn every_line_that_is_wrong_is_told() {
    let errors = parse("a 1x\nb 2\nc #maybe\nd { e \"open\n}\n").unwrap_err();
    assert_eq!(errors.len(), 3, "{errors:?}");
}

/// Where the `kdl` crate overflows its stack or takes exponential time.
#[test]
fn nesting_is_bounded_and_long_texts_take_linear_time() {
    let nested = |open: &str, count: usize| format!("{}{}", open.repeat(count), "}".repeat(count));
    assert!(parse(&nested("a {", super::DEEPEST)).is_ok());
    assert!(parse(&nested("a /- {", super::DEEPEST)).is_ok());
    assert!(parse(&nested("a; /- b {", super::DEEPEST)).is_ok());
    for text in [
        nested("a {", super::DEEPEST + 1),
        nested("a {", 200_000),
        nested("a /- {", 200_000),
        "{".repeat(200_000),
        "}".repeat(200_000),
        "/*".repeat(200_000),
        "(".repeat(200_000),
        ")\n".repeat(200_000),
        "\"".repeat(200_001),
        "#".repeat(200_000),
        "\\".repeat(200_000),
    ] {
        let errors = parse(&text).unwrap_err();
        assert!((1..=60).contains(&errors.len()));
    }
    assert_eq!(parse(&"a 1 { b 2; c x=3 }\n".repeat(100_000)).unwrap().len(), 100_000);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, rng_seed: proptest::test_runner::RngSeed::Fixed(7), ..ProptestConfig::default() })]

    /// Any text made of the format's own signs: never a panic, and agreement wherever both accept.
    #[test]
    fn random_texts_mean_what_the_kdl_crate_says(text in "([ab1.\"#{}();=\\\\/*\\-+_ \n]|\\{ |#true|0x1|/-|//|/\\*|\\*/|\"\"\"\n|é|\r\n){0,24}") {
        let own = parse(&text);
        let other = ::kdl::KdlDocument::parse_v2(&text);
        if let (Ok(own), Ok(other)) = (own, other) {
            prop_assert_eq!(ours(&own), theirs(&other));
        }
    }

    #[test]
    fn any_text_is_survived(text in any::<String>()) {
        let _ = parse(&text);
    }
}
