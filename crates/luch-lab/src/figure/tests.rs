//! Figures of all kinds of numbers, in all kinds of output.

use super::*;

/// One layer of every kind.
fn everything() -> Figure {
    let points = vec![[1.0, 2.0], [2.0, 1.0], [3.0, 4.0]];
    Figure::new("Every kind <of> \"layer\" & more")
        .with_caption("A caption, which is long enough to be wrapped into several lines of text below the figure, as captions are.")
        .with_x(Axis::linear("across"))
        .with_y(Axis::linear("up"))
        .heat("heat", Raster { low: [1.0, 1.0], high: [3.0, 4.0], ..Raster::unit_square(2, vec![0.0, 1.0, f64::NAN, 3.0]) })
        .band("band", Ink::Sky, vec![Between { x: 1.0, low: 1.0, high: 2.0 }, Between { x: 3.0, low: 2.0, high: 3.0 }])
        .bars("bars", Ink::Orange, vec![1.0, 2.0, 3.0], vec![1.0, 2.0])
        .step("step", Ink::Green, vec![1.0, 2.0, 3.0], vec![2.0, 3.0])
        .line("line", Ink::Blue, points.clone())
        .dashed("dashed", Ink::Purple, points.clone())
        .points("points", Ink::Text, points.clone(), 4.0)
        .with("weights", Ink::Yellow, Mark::Weighted { points: points.clone(), weights: vec![1.0, 2.0, 3.0], size: 8.0 })
        .with("arrows", Ink::Vermilion, Mark::Arrows(vec![Arrow { from: [1.0, 1.0], to: [2.0, 2.0] }]))
        .with("polygon", Ink::Green, Mark::Polygon { points, opacity: 0.2 })
        .errors("errors", Ink::Blue, vec![ErrorBar { x: 2.0, y: 2.0, low: 1.5, high: 2.5 }])
        .reference("slope", [1.0, 1.0], 1.0)
        .level("level", 3.5)
        .place("place", 2.5)
        .note("note", [1.5, 3.0], Anchor::Middle)
}

#[test]
fn json_leads_back() {
    let mut figure = everything();
    if let Mark::Heat(raster) = &mut figure.layers[0].mark {
        raster.values[2] = 2.0;
    }
    assert_eq!(Figure::from_json(&figure.to_json()).unwrap(), figure);
    let back = Figure::from_json(&everything().to_json()).unwrap();
    let Mark::Heat(raster) = &back.layers[0].mark else { panic!() };
    assert!(raster.values[2].is_nan(), "what is not finite is null and comes back as undefined");
    assert!(Figure::from_json("{\"title\": 3}").is_err());
}

#[test]
fn csv_has_every_number() {
    let csv = everything().to_csv();
    assert_eq!(csv.lines().next(), Some("layer,name,kind,x,y,low,high"));
    assert_eq!(csv.lines().count(), 1 + 4 + 2 + 2 + 2 + 3 + 3 + 3 + 3 + 1 + 3 + 1 + 1 + 1 + 1 + 1);
    assert!(csv.contains("\n2,bars,bar,1.5,1,1,2\n"), "{csv}");
    assert!(csv.lines().all(|line| line.split(',').count() == 7), "{csv}");
    let sheet = Sheet::new("two", 2, vec![everything(), everything()]);
    assert_eq!(sheet.to_csv().lines().count(), 2 * csv.lines().count() - 1);
}

#[test]
fn svg_knows_both_themes_and_escapes_text() {
    let svg = everything().to_svg();
    assert!(
        svg.contains("prefers-color-scheme:dark") && svg.contains("&lt;of&gt; &quot;layer&quot; &amp; more")
    );
    assert!(!svg.contains("<of>") && svg.contains("<text"), "text is text");
    assert!(svg.contains("0072b2") && svg.contains("d55e00"), "colours of Okabe and Ito");
    assert!(!everything().to_svg_in(Theme::Dark).contains("prefers-color-scheme"));
    // As many tags are opened as are closed.
    let opened = svg.matches('<').count() - svg.matches("</").count() - svg.matches("/>").count();
    let selfclosed = svg.matches("/>").count();
    assert_eq!(svg.matches('<').count(), opened + selfclosed + svg.matches("</").count());
    assert_eq!(opened, svg.matches("</").count());
}

#[test]
fn png_has_the_size_and_ground_of_its_theme() {
    for (theme, ground) in [(Theme::Light, [255u8; 3]), (Theme::Dark, [0x16, 0x18, 0x1d])] {
        let png = everything().to_png(PngOptions { theme, scale: 1.0 });
        let bitmap = luch_image::codec::decode(&png, None).unwrap();
        assert_eq!(bitmap.width, 720);
        let corner = bitmap.raw(1, 1);
        assert_eq!([corner[0], corner[1], corner[2]].map(|v| (v * 255.0).round() as u8), ground);
        assert_eq!(png, everything().to_png(PngOptions { theme, scale: 1.0 }), "the same bytes every time");
    }
}

#[test]
fn terminals_get_lines_of_their_width() {
    for columns in [20, 60, 100] {
        for depth in [Depth::Letters, Depth::Palette, Depth::TrueColor] {
            let text = everything().to_terminal(columns, depth);
            assert_eq!(text.contains('\x1b'), depth != Depth::Letters);
            if depth == Depth::Letters {
                let widest = text.lines().map(|line| line.chars().count()).max().unwrap();
                assert!(widest <= columns + 2, "{widest} of {columns}:\n{text}");
            }
        }
    }
}

#[test]
fn nothing_breaks_it() {
    let strange = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 0.0, -0.0, 1e308, -1e308, 1e-320, 5.0];
    let points: Vec<[f64; 2]> = strange.iter().flat_map(|&x| strange.iter().map(move |&y| [x, y])).collect();
    let long = "long ".repeat(3000);
    for (x, y) in [
        (Axis::linear(&*long), Axis::linear("")),
        (Axis::log10(""), Axis::log2("")),
        (Axis::log2(""), Axis::log10("")),
    ] {
        for few in [0, 1, 2, points.len()] {
            let some: Vec<[f64; 2]> = points[..few].to_vec();
            let heights: Vec<f64> = some.iter().map(|p| p[1]).collect();
            let edges: Vec<f64> = some.iter().map(|p| p[0]).collect();
            let figure = Figure::new(&*long)
                .with_caption(&*long)
                .with_x(x.clone())
                .with_y(y.clone())
                .line(&*long, Ink::Blue, some.clone())
                .points("\u{0}\u{7}", Ink::Blue, some.clone(), f64::NAN)
                .bars("b", Ink::Blue, edges.clone(), heights.clone())
                .step("s", Ink::Blue, edges, heights.clone())
                .heat("h", Raster { is_logarithmic: true, ..Raster::unit_square(3, heights.clone()) })
                .heat("none", Raster::unit_square(0, heights.clone()))
                .with("w", Ink::Blue, Mark::Weighted { points: some.clone(), weights: heights, size: 1e9 })
                .with("p", Ink::Blue, Mark::Polygon { points: some, opacity: f64::NAN })
                .reference(&*long, [f64::NAN, 1.0], 1.0)
                .reference("r", [1.0, 1.0], 1e300)
                .level("l", f64::INFINITY);
            for figure in [figure.clone(), figure.squared()] {
                assert!(figure.to_svg().len() < 1 << 22);
                let svg = figure.to_svg();
                let wrong = svg.find("NaN").or_else(|| svg.find("inf\"")).or_else(|| svg.find("inf "));
                assert_eq!(wrong.map(|at| &svg[at.saturating_sub(200)..at + 20]), None);
                assert!(!figure.to_png(PngOptions { scale: 0.5, ..PngOptions::default() }).is_empty());
                assert!(figure.to_terminal(70, Depth::Letters).len() < 1 << 20);
                assert!(Figure::from_json(&figure.to_json()).is_ok());
            }
        }
    }
}

#[test]
fn a_million_points_are_thinned() {
    let many: Vec<[f64; 2]> = (0..1_000_000u64)
        .map(|i| {
            [luch_sampling::hash::word(1, i), luch_sampling::hash::word(2, i)].map(|w| w as f64 * 5.4e-20)
        })
        .collect();
    let figure =
        Figure::unit_square("many").points("", Ink::Blue, many.clone(), 1.0).line("", Ink::Green, many);
    assert!(figure.to_svg().len() < 2_000_000, "{}", figure.to_svg().len());
}
