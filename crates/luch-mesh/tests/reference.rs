//! The reference in `docs/` is that of the verbs there are.

#[test]
fn the_reference_is_up_to_date() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/mesh-verbs.md");
    let text = std::fs::read_to_string(path).expect("docs/mesh-verbs.md");
    let wanted = luch_mesh::workshop::reference();
    if std::env::var_os("LUCH_BLESS").is_some() {
        let head = text.split("## Verbs that make").next().unwrap_or_default();
        std::fs::write(path, format!("{head}{}\n", wanted.trim_end())).expect("docs/mesh-verbs.md");
        return;
    }
    let start = text.find("## Verbs that make").expect("the verbs");
    assert!(
        text[start..].trim_end() == wanted.trim_end(),
        "docs/mesh-verbs.md is old: run this test with LUCH_BLESS=1"
    );
}
