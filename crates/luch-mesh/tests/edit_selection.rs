//! Selections: what rules mean, and what is said of rules that mean nothing.

use luch_mesh::edit::Selection;
use luch_mesh::{PolygonMesh, generate};

fn cube() -> PolygonMesh {
    PolygonMesh::from(&generate::cuboid(glam::Vec3::splat(2.0), [2; 3]))
}

fn faces(mesh: &PolygonMesh, rule: &str) -> usize {
    let rule = Selection::parse(rule).unwrap_or_else(|error| panic!("{rule}: {error}"));
    rule.faces(mesh).iter().filter(|flag| **flag).count()
}

#[test]
fn rules_count_the_faces_of_a_cube() {
    let mesh = cube();
    // Six sides of four squares of two triangles.
    let cases = [
        ("all", 48),
        ("none", 0),
        ("faces(0-5,9)", 7),
        ("faces(40-4000000000)", 8),
        ("faces()", 0),
        ("normal(0,2,0, 30deg)", 8),
        ("normal(0,1,0, 1.5708rad)", 40),
        ("not normal(0,1,0,0.25turn) and not normal(0,-1,0, 10)", 0),
        ("normal(1,0,0,5) or normal(0,1,0,5) or normal(0,0,1,5)", 24),
        ("faces(0-3) or faces(4-7) and faces(4)", 5),
        ("box(-1,-1,-1, 1,0,1)", 24 - 8 + 8),
        ("box(1,0,1, -1,-1,-1)", 24),
        ("sphere(0,2,0, 1.8)", 8),
        ("component(0)", 48),
        ("component(1)", 0),
        ("material(0)", 48),
        ("border", 0),
        ("corners(3)", 48),
        ("corners(4-9)", 0),
        ("where(y > 0.5)", 8),
        ("where(max(x, y) < 0.5) and not where((x) < -2)", 12),
        ("grow(normal(0,1,0,5), 1)", 8 + 16 + 8),
        ("shrink(not normal(0,1,0,5), 1)", 48 - 32),
        ("(all)", 48),
        ("not not all", 48),
    ];
    for (rule, count) in cases {
        // Triangulated squares touch the rim by one or two triangles each: growing is counted by its vertices.
        if rule.contains("grow") || rule.contains("shrink") {
            let grown = faces(&mesh, rule);
            assert!(grown.abs_diff(count) <= 8, "{rule}: {grown}");
            continue;
        }
        assert_eq!(faces(&mesh, rule), count, "{rule}");
    }
}

#[test]
fn kinds_convert() {
    let mesh = cube();
    let rule = Selection::parse("normal(0,1,0, 5)").unwrap();
    assert_eq!(rule.vertices(&mesh).iter().filter(|flag| **flag).count(), 9);
    // Twelve edges of squares and four diagonals.
    assert_eq!(rule.edges(&mesh).len(), 16);
    assert_eq!(Selection::parse("sharp(30deg)").unwrap().edges(&mesh).len(), 24);
    let edge = rule.edges(&mesh)[0];
    let rule = Selection::Edges(vec![[edge[1], edge[0]]]);
    assert_eq!((rule.edges(&mesh), rule.faces(&mesh).iter().filter(|flag| **flag).count()), (vec![edge], 2));
    let open = PolygonMesh::from(&generate::plane(glam::Vec2::ONE, [3, 3]));
    assert_eq!(Selection::Border.edges(&open).len(), 12);
}

#[test]
fn errors_point() {
    let error = |text: &str| Selection::parse(text).unwrap_err().to_string();
    assert!(error("fases(1)").starts_with("column 1: found “fases”, expected all"));
    assert_eq!(error("faces(1-)"), "column 9: found “)”, expected a whole number");
    assert_eq!(error("faces(1"), "column 8: found the end, expected `)`");
    assert_eq!(error("all all"), "column 5: found “all”, expected `and`, `or` or the end");
    assert_eq!(error("box(0,0,0, 1,x,1)"), "column 14: found “x”, expected a number");
    assert_eq!(error("normal(0,1,0, 30grad)"), "column 17: found “grad”, expected `deg`, `rad` or `turn`");
    assert_eq!(error("material(70000)"), "column 10: slots go up to 65535");
    assert!(error(&"(".repeat(1000)).contains("64 deep"));
    assert!(error(&"not ".repeat(1000)).contains("64 deep"));
    assert_eq!(error("where(x > )").split(':').next(), Some("column 11"));
    assert_eq!(error("all and where(w > 1)").split(':').next(), Some("column 15"));
    assert!(error("").contains("found the end"));
    assert!(error("sphere(1e999,0,0,1)").contains("expected a number"));
}
