//! OBJ and MTL by hand: every form of line, and what errors say.

use glam::{Vec3, Vec4};
use luch_mesh::codec::{mtl, obj};
use luch_mesh::measure;

fn decode(text: &str) -> obj::ObjFile {
    obj::decode(text.as_bytes()).unwrap()
}

fn error(text: &str) -> String {
    obj::decode(text.as_bytes()).unwrap_err().to_string()
}

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

#[test]
fn faces_in_every_form() {
    let lists = "vt 0 0\nvt 1 0 0\nvt 1 1\nvn 0 0 2\n";
    for face in [
        "f 1 2 3",
        "f 1/1 2/2 3/3",
        "f 1//1 2//1 3//1",
        "f 1/1/1 2/2/1 3/3/1",
        "f -4 -3 -2",
        "f 1/ 2/ 3/ # x",
    ] {
        let file = decode(&format!("{SQUARE}{lists}{face}\r\n"));
        assert_eq!(file.mesh.corners, [0, 1, 2], "{face}");
        assert_eq!(file.mesh.uv_sets.is_empty(), !face.contains("1/1") && !face.contains("/2"), "{face}");
        // Normals are brought to length one.
        let normals: &[Vec3] = if face.ends_with("/1") { &[Vec3::Z] } else { &[] };
        assert_eq!(file.mesh.normals.values, normals, "{face}");
    }
    // Tabs, continued lines, references to what comes later.
    let file = decode(&format!("f\t1  2\\\n 3 4\n{SQUARE}"));
    assert_eq!(file.mesh.corners, [0, 1, 2, 3]);
}

#[test]
fn errors_say_where_and_what() {
    assert_eq!(
        error("v 0 0\n"),
        "line 1, column 3: found “0 0”, expected three numbers after “v”, perhaps a weight or a colour"
    );
    assert_eq!(error("v 0 0 0\n  v 1 x 2\n"), "line 2, column 7: found “x”, expected a number");
    assert_eq!(
        error(&format!("{SQUARE}f 1 2 9\n")),
        "line 5, column 7: found “9”, expected a vertex from 1 to 4"
    );
    assert_eq!(
        error(&format!("{SQUARE}f 1 2 -9\n")),
        "line 5, column 7: found “-9”, expected a reference to one of the 4 vertices above"
    );
    assert!(error(&format!("{SQUARE}f 1 2 0\n")).contains("numbers from 1"));
    assert!(error(&format!("{SQUARE}f 1 2/1/1/1 3\n")).contains("a corner as v, v/vt, v//vn or v/vt/vn"));
}

#[test]
fn groups_objects_and_materials() {
    let text = format!(
        "{SQUARE}f 1 2 3\no body\ng left part\nusemtl red\nf 1 2 3\nf 1 3 4\ng empty\ng right part\nusemtl green\nf 2 3 4\nusemtl red\nf 2 3 1\n"
    );
    let file = decode(&text);
    let named =
        |list: &[obj::NamedFaces]| list.iter().map(|n| (n.name.clone(), n.faces.clone())).collect::<Vec<_>>();
    assert_eq!(named(&file.objects), [("body".to_owned(), 1..5)]);
    assert_eq!(named(&file.groups), [("left part".to_owned(), 1..3), ("right part".to_owned(), 3..5)]);
    assert_eq!(file.materials, ["", "red", "green"]);
    assert_eq!(file.mesh.slots, [0, 1, 1, 2, 1]);
}

#[test]
fn material_files_with_and_without_spaces() {
    let file = decode(
        "mtllib a.mtl b c.MTL\nmtllib d\\ e.mtl\nmtllib \"f g.mtl\"\nmtllib noending here\nmtllib a.mtl\n",
    );
    assert_eq!(file.libraries, ["a.mtl", "b c.MTL", "d e.mtl", "f g.mtl", "noending here"]);
}

#[test]
fn colours_weights_and_numbers_that_are_none() {
    let file = decode("v 0 0 0\nv 1 0 0 0.5 0.25 1\nv 0 1 0 7\nv inf 0 0\nf 1 2 3\nf 1 2 4\n");
    assert_eq!(file.mesh.colors.values[1], Vec4::new(0.5, 0.25, 1.0, 1.0));
    assert_eq!(file.mesh.colors.values[0], Vec4::ONE);
    assert_eq!(file.mesh.positions[2], Vec3::Y);
    assert_eq!(file.mesh.face_count(), 1);
    assert_eq!(file.warnings[0].message, "1 faces with a vertex that is not finite are left out");
}

#[test]
fn what_is_skipped_is_named_with_its_line() {
    let file = decode(&format!(
        "{SQUARE}l 1 2\nl 2 3\np 1\ncurv 0 1 1 2\nbogus\nf 1 2\nf 1 2 3\nf 1//7 2//7 3//7\n"
    ));
    let told: Vec<String> = file.warnings.iter().map(ToString::to_string).collect();
    assert_eq!(
        told,
        [
            "line 5: lines (“l”) are skipped (2 times)",
            "line 7: points (“p”) are skipped",
            "line 8: free-form geometry (“curv”) is skipped",
            "line 9: unknown keyword “bogus” is skipped",
            "line 10: a face with fewer than three corners is left out",
            "line 12: “1//7” refers to number 7 of 0 normals: corners like it are treated as having none",
        ]
    );
}

#[test]
fn smoothing_groups_make_normals() {
    // Two squares at right angles along the y axis.
    let shape = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 -1\nv 0 1 -1\n";
    let normals = |groups: [&str; 2]| {
        let text = format!("{shape}s {}\nf 1 2 3 4\ns {}\nf 5 1 4 6\n", groups[0], groups[1]);
        let mesh = decode(&text).mesh;
        let number = |c: usize| *mesh.normals.corners.get(c).unwrap_or(&mesh.corners[c]);
        (0..8).map(|c| mesh.normals.values[number(c) as usize]).collect::<Vec<_>>()
    };
    let smooth = normals(["1", "1"]);
    let middle = Vec3::new(-1.0, 0.0, 1.0).normalize();
    assert!((smooth[0] - middle).length() < 1e-6 && smooth[0] == smooth[5]);
    assert_eq!(smooth[1], Vec3::Z);
    for groups in [["1", "2"], ["off", "1"], ["1", "0"]] {
        let hard = normals(groups);
        assert!(
            hard[..4].iter().all(|n| *n == Vec3::Z) && hard[4..].iter().all(|n| *n == Vec3::NEG_X),
            "{groups:?}"
        );
    }
    // Without any group there are no normals: flat.
    assert!(decode(&format!("{shape}s off\nf 1 2 3 4\n")).mesh.normals.is_empty());
}

#[test]
fn concave_faces_keep_their_area() {
    let mesh = decode("v 0 0 0\nv 4 0 0\nv 4 4 0\nv 2 1 0\nv 0 4 0\nf 1 2 3 4 5\n").mesh.triangulate();
    assert_eq!(measure::area(&mesh), 10.0);
}

#[test]
fn many_oddities_do_not_fill_the_memory() {
    let text: String = (0..5000).map(|i| format!("key{i} x\n")).collect();
    assert_eq!(decode(&text).warnings.len(), 101);
}

#[test]
fn material_keys_and_options() {
    let text = "newmtl m\nKd 0.5\n Ks 1 2 3\nTr 0.25\nd 0.5\nTr 0.9\nNs 10 # shiny\nillum 2\nPr .2\naniso 0.7\n\
                map_Kd -s 2 2 -o 0.1 some picture.png\nmap_bump -imfchan r bump 2.jpg -bm 1.5\nnorm 1.png\n\
                map_Kd -colorspace sRGB d.jpg\nbogus 1\nKa spectral x.rfl 1\nmap_Ks -s 1\n";
    let error = mtl::decode(text.as_bytes()).unwrap_err();
    assert!(
        error.to_string().starts_with("line 17, column 11: found “1”, expected a number after “-s”"),
        "{error}"
    );
    let file = mtl::decode(text.trim_end_matches("map_Ks -s 1\n").as_bytes()).unwrap();
    let m = &file.materials[0];
    assert_eq!((m.diffuse, m.specular), (Some(Vec3::splat(0.5)), Some(Vec3::new(1.0, 2.0, 3.0))));
    assert_eq!(
        (m.opacity, m.shininess, m.roughness, m.anisotropy),
        (Some(0.5), Some(10.0), Some(0.2), Some(0.7))
    );
    assert_eq!(m.illumination_model, Some(2));
    let color = m.diffuse_map.as_ref().unwrap();
    assert_eq!((color.file.as_str(), color.color_space.as_deref()), ("d.jpg", Some("sRGB")));
    let bump = m.bump_map.as_ref().unwrap();
    assert_eq!((bump.file.as_str(), bump.bump_multiplier), ("bump 2.jpg", 1.5));
    assert_eq!(bump.channel, Some(mtl::Channel::Red));
    assert_eq!(m.normal_map.as_ref().unwrap().file, "1.png");
    assert_eq!(file.warnings.len(), 2);
    assert!(mtl::decode(b"Kd 1 1 1\n").unwrap_err().to_string().contains("newmtl"));
}
