//! What holds for every verb without running it.

use super::*;

#[test]
fn names_are_unique_and_well_formed() {
    let mut names: Vec<_> = verbs().map(|verb| verb.name).collect();
    names.sort_unstable();
    let all = names.len();
    names.dedup();
    assert_eq!(names.len(), all);
    let well_formed = |name: &str| {
        !name.is_empty() && name.bytes().all(|b| b.is_ascii_lowercase() || b.is_ascii_digit() || b == b'-')
    };
    for verb in verbs() {
        assert!(well_formed(verb.name) && !verb.summary.ends_with('.'), "{}", verb.name);
        for (place, parameter) in verb.parameters.iter().enumerate() {
            assert!(
                well_formed(parameter.name) && !parameter.summary.ends_with('.'),
                "{} {}",
                verb.name,
                parameter.name
            );
            assert!(
                verb.parameters[..place].iter().all(|other| other.name != parameter.name),
                "{}",
                verb.name
            );
        }
    }
}

#[test]
fn mistakes_are_told() {
    let message = |text: &str| {
        Pipeline::parse(text).and_then(|pipeline| pipeline.run(&mut NoFiles)).unwrap_err().to_string()
    };
    assert_eq!(message("cuboit"), "there is no verb `cuboit`; did you mean `cuboid`?");
    assert_eq!(
        message("cuboid --sice 2"),
        "`sice`: cuboid: is no parameter of `cuboid`; did you mean `size`?"
    );
    assert!(message("flip").contains("one must come before it"));
    assert!(message("cuboid | cuboid").contains("can only come first"));
    assert!(message("cuboid |").contains("empty"));
    assert!(message("cuboid --size '2").contains("quote"));
    assert!(message("cuboid --size").contains("lacks its value"));
    assert!(message("cuboid --size 0").contains("positive"));
    assert!(message("cuboid --size 1 --size 2").contains("twice"));
}
