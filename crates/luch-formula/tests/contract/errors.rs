//! Every error names its place, and no text is too odd to be answered.

use luch_formula::{Formula, FormulaErrorKind, parse, parse_equation};
use proptest::prelude::*;

#[test]
fn places_are_exact() {
    // Text, the marked part with what stands before it, and words of the message.
    let table = [
        ("x + ", "x + |", "expected a value, found the end"),
        ("", "|", "expected a value, found the end"),
        ("x + * 2", "x + |*|", "expected a value, found `*`"),
        ("2 * (x + 1", "2 * (x + 1|", "an operator or `)`"),
        ("x)", "x|)|", "there is no ( to it"),
        ("(x", "(x|", "`)`"),
        ("x y", "x |y|", "write * between factors"),
        ("x (y)", "x |(|", "write x*(…)"),
        ("(x)(y)", "(x)|(|", "write * between factors"),
        ("2 3", "2 |3|", "write * between factors"),
        ("1/2x", "1/2|x|", "two things"),
        ("2^3x", "2^3|x|", "two things"),
        ("2^-3(x)", "2^-3|(|", "two things"),
        ("x + raduis", "x + |raduis|", "did you mean `radius`?"),
        ("x + X", "x + |X|", "did you mean `x`?"),
        ("sinn(x)", "|sinn|(x)", "did you mean `sin`?"),
        ("Sqrt(x)", "|Sqrt|(x)", "did you mean `sqrt`?"),
        ("x + sin", "x + sin|", "write sin(x)"),
        ("qwertz + 1", "|qwertz| + 1", "known are x, y, radius"),
        ("atan2(x)", "|atan2(x)|", "takes 2 arguments, not 1"),
        ("sin()", "|sin()|", "takes 1 argument, not 0"),
        ("1 + min() + 2", "1 + |min()| + 2", "takes 1 or more arguments"),
        ("noise(1, 2, 3, 4)", "|noise(1, 2, 3, 4)|", "takes 1 to 3 arguments"),
        ("fbm(x, y, 0, x)", "|fbm(x, y, 0, x)|", "constant whole number, 1 to 16"),
        ("fbm(x, y, 0, 17)", "|fbm(x, y, 0, 17)|", "constant whole number, 1 to 16"),
        ("normal(x, 1)", "|normal(x, 1)|", "normal(x, mean, deviation)"),
        ("x $ y", "x |$| y", "unknown character `$`"),
        ("x ** 2", "x |**| 2", "write ^"),
        ("x && y", "x |&&| y", "write and"),
        ("x | y", "x ||| y", "write or"),
        ("!x", "|!|x", "write not"),
        ("x % 2", "x |%| 2", "mod(a, b)"),
        ("x²", "x|²|", "write ^2"),
        ("[x]", "|[|x]", "write ("),
        ("1.2.3", "|1.2.3|", "is not a number"),
        (". + 1", "|.| + 1", "is not a number"),
        ("0 < x < 1", "0 < x |<| 1", "a < b and b < c"),
        ("x = 1", "x |=| 1", "== compares"),
        ("x = 1; x", "|x| = 1; x", "has a meaning already"),
        ("a = 1; a = 2; a", "a = 1; |a| = 2; a", "has a meaning already"),
        ("and = 1; x", "|and| = 1; x", "word of the language"),
        ("a = 1;", "a = 1;|", "expected a value"),
        ("x; y", "x|;| y", "name = value;"),
        ("; y", "|;| y", "name = value;"),
        ("a = x y; a", "a = x |y|; a", "write * between factors"),
        ("1 + not x", "1 + |not| x", "in parentheses"),
        ("x and", "x and|", "expected a value"),
        ("sin(x,)", "sin(x,|)|", "expected a value"),
        ("sin(x; y)", "sin(x|;| y)", "`)`"),
    ];
    let variables = ["x", "y", "radius"];
    for (text, marked, words) in table {
        let error = parse(text, &variables).expect_err(text);
        // The marks: before the place and after it; an empty place has one.
        let before = marked.find('|').unwrap();
        let length = marked.len() - text.len();
        let end = if length == 1 { before } else { marked.rfind('|').unwrap() - 1 };
        assert_eq!(error.span(), before..end, "{text}: {error}");
        assert!(error.to_string().contains(words), "{text}: {error}");
        assert_eq!(error.column(), text[..before].chars().count() + 1, "{text}");
    }
    let error = parse_equation("x = 1 = 2", &variables).unwrap_err();
    assert_eq!(error.span(), 6..7);
}

#[test]
fn the_line_is_shown_with_the_place_marked() {
    let error = parse("r = hypot(x, y);\n  r + ßz +\tqq + 1", &["x", "y", "ßz"]).unwrap_err();
    assert_eq!((error.line(), error.column()), (2, 12));
    let expected = "unknown name `qq`; known are x, y, ßz, r\n 2 |   r + ßz + qq + 1\n   |            ^^";
    assert_eq!(error.to_string(), expected);
    let far = format!("{}+ q + {}", "x+x".repeat(100), "1".repeat(300));
    let shown = parse(&far.replace("xx", "x+x"), &["x"]).unwrap_err().to_string();
    assert!(shown.lines().all(|line| line.chars().count() < 120), "{shown}");
    let lines: Vec<&str> = shown.lines().collect();
    let mark = lines[2].chars().position(|character| character == '^').unwrap();
    assert_eq!(lines[1].chars().nth(mark), Some('q'), "{shown}");
}

#[test]
fn names_of_the_caller_are_checked() {
    for (name, words) in
        [("", "is not a name"), ("2x", "is not a name"), ("a b", "is not a name"), ("not", "word")]
    {
        let error = parse("1", &[name]).unwrap_err();
        assert!(matches!(error.kind(), FormulaErrorKind::BadName { .. }) && error.message().contains(words));
    }
    assert!(parse("x", &["x", "x"]).unwrap_err().message().contains("given twice"));
    assert!(Formula::new("x").with("x", 1.0).parse(&["x"]).unwrap_err().message().contains("given twice"));
}

#[test]
fn hostile_texts_are_refused_in_bounded_depth() {
    let many = 100_000;
    let texts = [
        "(".repeat(many),
        "-".repeat(many) + "1",
        "2^".repeat(many) + "1",
        "not ".repeat(many) + "1",
        "sin(".repeat(many),
        "2(".repeat(many),
        "if(1,".repeat(many),
        format!("{}1{}", "(".repeat(many), ")".repeat(many)),
    ];
    for text in texts {
        let error = parse(&text, &[]).unwrap_err();
        assert!(matches!(error.kind(), FormulaErrorKind::TooDeep { .. }), "{}", error.message());
        assert!(error.to_string().len() < 1000);
    }
    let long = "1".repeat((1 << 20) + 1);
    assert!(matches!(parse(&long, &[]).unwrap_err().kind(), FormulaErrorKind::TooLong { .. }));
    // Long is not deep: rows of operators are read by a loop.
    let row = vec!["x"; 100_000].join("+");
    assert_eq!(parse(&row, &["x"]).unwrap().operations(), 99_999);
    let arguments = format!("min({})", vec!["x"; 100_000].join(","));
    assert_eq!(parse(&arguments, &["x"]).unwrap().operations(), 0);
    // Definitions double what they stand for; the calculation grows by one step each.
    let doubling: String = (1..1000).map(|i| format!("a{i} = a{} * a{};", i - 1, i - 1)).collect();
    assert_eq!(parse(&format!("a0 = x; {doubling} a999"), &["x"]).unwrap().operations(), 999);
    // The greatest depth is reached, and works.
    let deep = format!("{}x{}", "(".repeat(150), ")".repeat(150));
    assert!(parse(&deep, &["x"]).is_ok());
}

proptest! {
    #![proptest_config(crate::samples::cases(2000))]

    #[test]
    fn any_text_is_answered(text in "\\PC{0,60}") {
        if let Err(error) = parse(&text, &["x", "y"]) {
            prop_assert!(error.span().end <= text.len() && error.to_string().contains('^'));
            prop_assert!(text.is_char_boundary(error.span().start) && text.is_char_boundary(error.span().end));
        }
    }

    #[test]
    fn any_soup_of_pieces_is_answered(pieces in prop::collection::vec(prop::sample::select(&[
        "x", "y", "2", "1e3", ".5", "+", "-", "*", "/", "^", "(", ")", "(", ")", ",", ";", "=", "==", "<", ">=", "!=",
        "and", "or", "not", "sin(", "if(", "min(", "noise(", "fbm(", "a", "a =", "pi", "\n", " ", "normal(",
    ][..]), 0..24)) {
        for text in [pieces.concat(), pieces.join(" ")] {
            for error in [parse(&text, &["x", "y"]).err(), parse_equation(&text, &["x", "y"]).err()].into_iter().flatten() {
                prop_assert!(error.span().start <= error.span().end && error.span().end <= text.len());
                prop_assert!(error.line() >= 1 && error.column() >= 1 && !error.to_string().is_empty());
            }
        }
    }
}
