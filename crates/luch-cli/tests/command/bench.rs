//! `luch bench`.

use crate::workplace::{Said, Workplace};
use serde_json::Value;

/// A mesh of a few hundred triangles, none of them seen edge-on: a bumpy plane.
fn bumpy() -> String {
    let mut text = String::new();
    for z in 0..16 {
        for x in 0..16 {
            let height = f64::from((x * 7 + z * 13) % 5) * 0.3;
            text.push_str(&format!("v {x} {height} {z}\n"));
        }
    }
    for z in 0..15 {
        for x in 0..15 {
            let [a, b] = [z * 16 + x + 1, z * 16 + x + 17];
            text.push_str(&format!("f {a} {b} {}\nf {} {b} {}\n", a + 1, a + 1, b + 1));
        }
    }
    text
}

fn objects(said: &Said, event: &str) -> Vec<Value> {
    let all = said.out.lines().map(|line| serde_json::from_str::<Value>(line).unwrap());
    all.filter(|object| object["event"] == event).collect()
}

#[test]
fn rays_are_traced_in_every_way() {
    let place = Workplace::empty();
    place.write("bumpy.obj", &bumpy());
    let line =
        "bench rays bumpy.obj --size 64 --repeat 2 --quality all --kernel all --level all --threads 1,2";
    let said = place.done(&format!("{line} --json"));
    let builds = objects(&said, "build");
    assert_eq!(builds.len(), 3);
    for build in &builds {
        assert_eq!(build["triangles"], 450);
        assert!(build["memory_bytes"].as_u64().unwrap() > 450 * 36);
    }
    let rows = objects(&said, "trace");
    // Qualities, kernels and numbers of threads at least; how many levels there are depends on the machine.
    assert!(rows.len() >= 4 * 3 * 4 * 2 && rows.len().is_multiple_of(4 * 3 * 4 * 2));
    for row in &rows {
        assert_eq!((&row["other_bits"], row["reference"].is_null()), (&Value::from(0), true));
        assert_eq!(row["mrays_by_clock"].as_array().unwrap().len(), 2);
        assert!(row["mrays_by_clock"][0].as_f64().unwrap() > 0.0);
        // From above every ray into the plane ends there.
        let share = row["hits"].as_f64().unwrap() / row["rays"].as_f64().unwrap();
        assert!((0.02..=0.98).contains(&share), "{row}");
    }
    assert_eq!(rows[0]["rays"], 64 * 64);
    let table = place.done("bench rays bumpy.obj --size 16 --repeat 1");
    assert!(table.out.contains("450 triangles") && table.out.contains("shuffled"), "{}", table.out);
}

#[test]
fn rays_that_were_written_are_traced_again() {
    let place = Workplace::empty();
    place.write("bumpy.obj", &bumpy());
    place.done("bench rays bumpy.obj --size 32 --repeat 1 --kernel single --write out --fov 30 --eye 8,9,-9");
    let sets = ["diffuse", "primary", "shadow", "shuffled"];
    let mut expected = vec!["bumpy.obj".to_owned()];
    expected.extend(sets.iter().flat_map(|set| ["hits", "rays"].map(|kind| format!("out.{set}.{kind}"))));
    expected.push("out.tri".to_owned());
    assert_eq!(place.files(), expected);
    let said = place.done("bench rays out.tri --rays out --repeat 1 --json");
    let rows = objects(&said, "trace");
    assert_eq!(rows.len(), 4 * 2);
    for row in &rows {
        let reference = &row["reference"];
        let counts = ["hit_or_miss", "primitive", "distance"].map(|key| reference[key].as_u64().unwrap());
        assert_eq!((counts, reference["worst"].as_f64()), ([0, 0, 0], Some(0.0)), "{row}");
    }
    // Another program's answer: the first ray of the camera meets something at half the distance.
    let mut hits = place.bytes("out.primary.hits");
    let met = hits[16..].chunks_exact(16).position(|record| record[12..] != [0xff; 4]).unwrap();
    let at = 16 + 16 * met;
    let t = f32::from_le_bytes(hits[at..at + 4].try_into().unwrap());
    hits[at..at + 4].copy_from_slice(&(t / 2.0).to_le_bytes());
    std::fs::write(place.path("out.primary.hits"), hits).unwrap();
    let said = place.done("bench rays out.tri --rays out --repeat 1 --sets primary --kernel single");
    assert!(said.out.contains("0 hit or miss, 0 triangle, 1 distance (worst 1.00)"), "{}", said.out);
    assert!(said.out.contains(&format!("primary: ray {met} meets triangle")), "{}", said.out);
}

#[test]
fn what_cannot_be_measured_is_said() {
    let place = Workplace::new();
    place.write("bumpy.obj", &bumpy());
    place.write("cut.tri", "TRIS0001");
    for (line, code, part) in [
        ("bench rays nothing.tri", 1, "no such file"),
        ("bench rays cut.tri", 1, "ends inside its header"),
        ("bench rays bumpy.obj --rays out", 1, "out.primary.rays: no such file"),
        ("bench rays bumpy.obj --quality good", 2, "accepted are fast, balanced, best, all"),
        ("bench rays bumpy.obj --threads 0", 2, "accepted are 1 to 1024"),
        ("bench rays bumpy.obj --eye 1,2", 2, "write three numbers"),
        ("bench rays bumpy.obj --eye 1,2,3 --at 1,2,3", 2, "somewhere else"),
        ("bench rays bumpy.obj --eye 1,2,3 --at 1,9,3", 2, "straight above"),
        ("bench rays bumpy.obj --write missing/out", 1, "does not exist"),
    ] {
        let said = place.fails(line, code);
        assert!(said.err.contains(part), "luch {line}\n{}", said.err);
    }
    // A scene is its meshes, without spheres.
    let said = place.done("bench rays scene.kdl --size 16 --repeat 1 --json");
    assert_eq!(objects(&said, "build")[0]["triangles"], 4);
}
