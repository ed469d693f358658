//! Text: with a font made here, and with one of the system if there is any.

use luch_mesh::outline::{Alignment, Extrusion, Outline, OutlineError, TextLayout, text};
use luch_mesh::workshop::{Files, Pipeline};
use luch_mesh::{PolygonMesh, measure};

/// Bytes of numbers of 16 bits, high byte first, as fonts have them.
fn words(numbers: &[i32]) -> Vec<u8> {
    numbers.iter().flat_map(|n| (*n as u16).to_be_bytes()).collect()
}

/// A glyph of straight borders.
fn glyph(borders: &[&[[i32; 2]]]) -> Vec<u8> {
    let all: Vec<[i32; 2]> = borders.concat();
    let bound =
        |axis: usize, pick: fn(i32, i32) -> i32| all.iter().map(|p| p[axis]).reduce(pick).unwrap_or(0);
    let mut bytes = words(&[
        borders.len() as i32,
        bound(0, i32::min),
        bound(1, i32::min),
        bound(0, i32::max),
        bound(1, i32::max),
    ]);
    let mut end = -1;
    for border in borders {
        end += border.len() as i32;
        bytes.extend(words(&[end]));
    }
    // No instructions; every point is on the border, its coordinates in 16 bits.
    bytes.extend(words(&[0]));
    bytes.extend(vec![1; all.len()]);
    for axis in 0..2 {
        let mut before = 0;
        for point in &all {
            bytes.extend(words(&[point[axis] - before]));
            before = point[axis];
        }
    }
    bytes.resize(bytes.len().next_multiple_of(4), 0);
    bytes
}

/// Four glyphs: none, `A`, a square with a square hole, `B`, two squares that cross, and a blank. The em is 1000, all
/// advance by 600, and `A` after `A` is drawn in by 100.
fn font() -> Vec<u8> {
    let a = glyph(&[
        &[[0, 0], [0, 500], [500, 500], [500, 0]],
        &[[100, 100], [400, 100], [400, 400], [100, 400]],
    ]);
    let b = glyph(&[
        &[[0, 0], [0, 300], [300, 300], [300, 0]],
        &[[200, 200], [200, 500], [500, 500], [500, 200]],
    ]);
    let ends = [0, 0, a.len(), a.len() + b.len(), a.len() + b.len()];
    let loca = words(&ends.map(|end| end as i32 / 2));
    let mut head = words(&[1, 0, 0, 0, 0, 0, 0x5F0F, 0x3CF5, 0, 1000]);
    head.extend([0; 16]);
    head.extend(words(&[0, 0, 500, 500, 0, 8, 2, 0, 0]));
    let hhea = words(&[1, 0, 800, -200, 0, 600, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 4]);
    let maxp = words(&[0, 0x5000, 4]);
    let hmtx = words(&[600, 0, 600, 0, 600, 0, 600, 0]);
    // One table of format 4 with three segments: the blank, A and B, and the end that must be.
    let cmap = words(&[
        0,
        1,
        3,
        1,
        0,
        12,
        4,
        40,
        0,
        6,
        4,
        1,
        2,
        0x20,
        0x42,
        0xFFFF,
        0,
        0x20,
        0x41,
        0xFFFF,
        3 - 0x20,
        1 - 0x41,
        1,
        0,
        0,
        0,
    ]);
    let kern = words(&[0, 1, 0, 20, 1, 1, 6, 0, 0, 1, 1, -100]);
    let glyf = [a, b].concat();
    let tables: [(&[u8; 4], Vec<u8>); 8] = [
        (b"cmap", cmap),
        (b"glyf", glyf),
        (b"head", head),
        (b"hhea", hhea),
        (b"hmtx", hmtx),
        (b"kern", kern),
        (b"loca", loca),
        (b"maxp", maxp),
    ];
    let mut bytes = words(&[1, 0, tables.len() as i32, 128, 3, 0]);
    let mut offset = bytes.len() + 16 * tables.len();
    for (name, table) in &tables {
        bytes.extend(*name);
        bytes.extend([0; 4]);
        bytes.extend((offset as u32).to_be_bytes());
        bytes.extend((table.len() as u32).to_be_bytes());
        offset += table.len().next_multiple_of(4);
    }
    for (_, table) in &tables {
        bytes.extend(table);
        bytes.resize(bytes.len().next_multiple_of(4), 0);
    }
    bytes
}

fn left(outline: &Outline) -> f64 {
    outline.outer.iter().map(|p| p.x).fold(f64::INFINITY, f64::min)
}

#[test]
fn letters_stand_where_they_should() {
    let layout = TextLayout { size: 2.0, ..TextLayout::default() };
    let set = |written: &str, layout: &TextLayout| text(&font(), written, layout).unwrap();
    let one = set("A", &layout);
    assert_eq!((one.len(), one[0].holes.len()), (1, 1));
    // Half an em square, three tenths of it a hole, and the em is two metres.
    assert!((one[0].area() - (1.0 - 0.36)).abs() < 1e-6, "{}", one[0].area());
    let starts = |outlines: &[Outline]| outlines.iter().map(left).collect::<Vec<_>>();
    let near = |found: Vec<f64>, truth: &[f64]| {
        let fits = found.len() == truth.len() && found.iter().zip(truth).all(|(a, b)| (a - b).abs() < 1e-6);
        assert!(fits, "{found:?} is not {truth:?}");
    };
    near(starts(&set("A A", &layout)), &[0.0, 2.4]);
    near(starts(&set("AA", &layout)), &[0.0, 1.0]);
    let spaced = TextLayout { letter_spacing: 0.5, ..layout };
    near(starts(&set("AA", &spaced)), &[0.0, 2.0]);
    near(starts(&set("AA", &TextLayout { alignment: Alignment::Center, ..layout })), &[-1.1, -0.1]);
    near(starts(&set("A", &TextLayout { alignment: Alignment::Right, ..layout })), &[-1.2]);
    // The next line is an em lower.
    let lines = set("A\nA", &layout);
    near(
        lines.iter().map(|o| o.outer.iter().map(|p| p.y).fold(f64::INFINITY, f64::min)).collect(),
        &[0.0, -2.0],
    );
    // Borders that cross are bodies of their own.
    let crossed = set("B", &layout);
    assert_eq!((crossed.len(), crossed[0].holes.len()), (2, 0));
}

#[test]
fn what_is_no_text_is_refused() {
    let layout = TextLayout::default();
    assert_eq!(text(&font(), "AZ", &layout), Err(OutlineError::MissingCharacter { character: 'Z' }));
    assert_eq!(text(&font(), "  ", &layout), Err(OutlineError::Empty));
    assert_eq!(text(&font(), "", &layout), Err(OutlineError::Empty));
    assert!(matches!(text(b"no font", "A", &layout), Err(OutlineError::Font { .. })));
    assert!(text(&font(), "A", &TextLayout { size: f64::NAN, ..layout }).is_err());
    assert!(text(&font(), "A", &TextLayout { tolerance: 0.0, ..layout }).is_err());
    let long = "A".repeat(1 << 17);
    assert!(matches!(text(&font(), &long, &layout), Err(OutlineError::TooManyPoints { .. })));
    // Fonts that are cut anywhere are read or refused.
    let whole = font();
    for length in 0..whole.len() {
        let _ = text(&whole[..length], "AB A", &layout);
    }
    for place in 0..whole.len() {
        let mut broken = whole.clone();
        broken[place] ^= 0xFF;
        let _ = text(&broken, "AB A", &layout);
    }
}

struct OneFont(Vec<u8>);

impl Files for OneFont {
    fn bytes(&mut self, _: &str) -> Result<Vec<u8>, String> {
        Ok(self.0.clone())
    }

    fn mesh(&mut self, _: &str) -> Result<PolygonMesh, String> {
        Err("there are no meshes".into())
    }
}

#[test]
fn the_verb_makes_bodies() {
    let run =
        |line: &str| Pipeline::parse(line).and_then(|p| p.run(&mut OneFont(font()))).unwrap().triangulate();
    let body = run("text 'A\\nA' --font f.ttf --depth 0.5");
    let report = measure::closedness(&body);
    assert_eq!((report.components, report.genus), (2, Some(2)));
    assert!((measure::volume(&body) - 2.0 * 0.5 * 0.16).abs() < 1e-6);
    // Upright: the letters look along z, and each line runs along x.
    let bounds = measure::bounds(&body);
    assert_eq!((bounds.min.z, bounds.max.z), (-0.25, 0.25));
    let flat = run("text A --font f.ttf --depth 0 --lying");
    assert!((0..flat.triangles.len()).all(|t| flat.area_normal(t).y > 0.0));
    assert!((measure::area(&flat) - 0.16).abs() < 1e-6);
}

#[test]
fn letters_of_a_real_font_are_closed_bodies() {
    let candidates = [
        "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
        "/usr/share/fonts/TTF/DejaVuSans.ttf",
        "/usr/share/fonts/dejavu/DejaVuSans.ttf",
        "/System/Library/Fonts/Supplemental/Arial.ttf",
        "C:\\Windows\\Fonts\\arial.ttf",
    ];
    let Some(font) = candidates.iter().find_map(|name| std::fs::read(name).ok()) else {
        #[expect(clippy::print_stdout, reason = "whoever reads the output should know")]
        {
            println!("skipped: no font of the system");
        }
        return;
    };
    // Every printable letter of Latin-1 by itself; %, 8 and B have two holes, i and ä several pieces.
    let layout = TextLayout::default();
    let mut holes = 0;
    for character in (0x21..0x7F).chain(0xA1..0x100).filter_map(char::from_u32) {
        let outlines = match text(&font, &character.to_string(), &layout) {
            Err(OutlineError::MissingCharacter { .. } | OutlineError::Empty) => continue,
            other => other.unwrap_or_else(|error| panic!("{character}: {error}")),
        };
        holes += outlines.iter().map(|outline| outline.holes.len()).sum::<usize>();
        let body = Extrusion::default().of(&outlines).unwrap().triangulate();
        let report = measure::closedness(&body);
        assert!(report.is_closed(), "{character}: {report}");
        let area: f64 = outlines.iter().map(Outline::area).sum();
        assert!((measure::volume(&body) / area - 1.0).abs() < 1e-4, "{character}");
    }
    assert!(holes > 60, "{holes}");
    let genus = |written: &str| {
        let outlines = text(&font, written, &layout).unwrap();
        measure::closedness(&Extrusion::default().of(&outlines).unwrap().triangulate()).genus
    };
    assert_eq!((genus("l"), genus("O"), genus("8"), genus("B8")), (Some(0), Some(1), Some(2), Some(4)));
}
