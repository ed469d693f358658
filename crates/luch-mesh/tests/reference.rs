//! The reference in `docs/` is that of the verbs there are.

#[test]
fn the_reference_is_up_to_date() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/mesh-verbs.md");
    let text = std::fs::read_to_string(path).expect("docs/mesh-verbs.md");
    let start = text.find("## Verbs that make").expect("the verbs");
    let wanted = luch_mesh::workshop::reference();
    assert!(
        text[start..].trim_end() == wanted.trim_end(),
        "docs/mesh-verbs.md is old: put what `luch mesh verbs --markdown` prints below its head"
    );
}
